"""A page of text for a terminal, made with rich and returned as one string.

It does not depend on reports, and its output depends on its arguments alone, not on the
environment or the terminal of this process.
"""

from __future__ import annotations

import io
from collections.abc import Callable, Sequence
from dataclasses import dataclass

from rich.cells import cell_len, chop_cells, set_cell_size
from rich.table import Table
from rich.text import Text

from grader.base.gated_console import GatedConsole

NARROW = 60  # columns; on a narrower page, columns are stacked
WIDEST = 100  # columns; longer lines are hard to read
LABEL = 12  # columns
QUOTED, CONTINUED = "  | ", "  |   "


@dataclass(frozen=True, kw_only=True)
class CheckRow:
    """A row of the table of checks; each cell is safe to show."""

    mark: str
    style: str
    name: str
    text: str
    score: str


class Page:
    """A page of `width` columns; without `styled` it has no control sequences.

    Every string must be safe to show (see `grader.base.plain_text`); markup is never interpreted.
    `translate` renders a `Message` in the reader's language.
    """

    def __init__(self, *, width: int, styled: bool, translate: Callable[[str], str] = str) -> None:
        self._out = io.StringIO()
        self.translate = translate
        self._styled = styled
        self._width = max(20, min(width, WIDEST))
        self._console = GatedConsole(
            self._out,
            width=self._width,
            height=25,
            force_terminal=styled,
            force_jupyter=False,
            color_system="standard" if styled else None,
            no_color=not styled,
            legacy_windows=False,
        )

    @property
    def narrow(self) -> bool:
        """Whether the page is too narrow for columns."""
        return self._width < NARROW

    def __str__(self) -> str:
        text = self._out.getvalue()
        if self._styled:
            return text
        return "".join(f"{line.rstrip()}\n" for line in text.splitlines())

    def gap(self) -> None:
        """Write an empty line."""
        self._console.print()

    def line(self, *parts: str | tuple[str, str], indent: int = 0) -> None:
        """Write a paragraph of strings and (string, style) pairs, wrapped at words.

        Only its first line begins at `indent`, so quoted text cannot imitate a line of ours.
        """
        translated = [self._translated(part) for part in parts]
        self._hang(Text.assemble(*translated), " " * indent, " " * (indent + 2))

    def _translated(self, part: str | tuple[str, str]) -> str | tuple[str, str]:
        if isinstance(part, str):
            return self.translate(part)
        return self.translate(part[0]), part[1]

    def field(self, label: str, text: str | Sequence[str], style: str = "") -> None:
        """Write `text` (lines, each wrapped at words) next to its label."""
        lines = self.translate(text).split("\n") if isinstance(text, str) else text
        first, rest = self._lead(label, lines)
        for number, line in enumerate(lines):
            self._hang(Text(line, style=style), first if number == 0 else rest, rest)

    def code(self, label: str, lines: Sequence[str]) -> None:
        """Write lines unwrapped: the terminal wraps long ones, so they can be copied."""
        first, rest = self._lead(label, lines)
        for number, line in enumerate(lines):
            lead = first if number == 0 else rest
            self._verbatim(Text.assemble((lead, "bold"), (line, _diff_style(line))))

    def _lead(self, label: str, lines: Sequence[str]) -> tuple[str, str]:
        """Return the prefixes of the first line and of the others."""
        label = self.translate(label)
        if not self.narrow:
            width = max(LABEL, cell_len(label) + 4)
            return set_cell_size(f"  {label}", width), " " * width
        if len(lines) == 1 and cell_len(f"  {label}  {lines[0]}") <= self._width:
            return f"  {label}  ", "    "
        self._verbatim(Text(f"  {label}", style="bold"))
        return "    ", "    "

    def quote(self, lines: Sequence[str]) -> None:
        """Write a program's output, with a bar before each line to distinguish it from ours."""
        for line in lines:
            pieces = chop_cells(line, self._width - len(CONTINUED)) or [""]
            for number, piece in enumerate(pieces):
                self._verbatim(Text(f"{CONTINUED if number else QUOTED}{piece}"))

    def table(self, rows: Sequence[CheckRow]) -> None:
        """Write the rows in columns; on a narrow page the text is below the name."""
        table = Table.grid(padding=(0, 2, 0, 0), expand=False)
        table.add_column(no_wrap=True)
        if not self.narrow:
            table.add_column(no_wrap=True)
        table.add_column(overflow="fold")
        table.add_column(justify="right", no_wrap=True)
        for row in rows:
            mark, score = Text(self.translate(row.mark), style=row.style), Text(row.score)
            if self.narrow:
                table.add_row(mark, Text(f"{row.name}\n{row.text}"), score)
            else:
                table.add_row(mark, Text(row.name), Text(row.text), score)
        self._console.print(table)

    def grid(self, heads: Sequence[str], rows: Sequence[Sequence[tuple[str, str]]]) -> None:
        """Write a table with headings; the first column has names, a cell is (string, style).

        Columns that do not fit go into another table below.
        """
        rows = [[(self.translate(text), style) for text, style in cells] for cells in rows]
        others = [
            max(cell_len(cells[n][0]) for cells in [[(h, "") for h in heads], *rows]) + 2
            for n in range(1, len(heads))
        ]
        names = max(cell_len(text) for text in [heads[0], *(cells[0][0] for cells in rows)]) + 2
        names = min(names, max(self._width - max(others), 12))
        start = 1
        while start < len(heads):
            end, free = start + 1, self._width - names - others[start - 1]
            while end < len(heads) and others[end - 1] <= free:
                free -= others[end - 1]
                end += 1
            if start > 1:
                self.gap()
            self._grid([0, *range(start, end)], heads, rows, names=names - 2)
            start = end

    def _grid(
        self,
        columns: Sequence[int],
        heads: Sequence[str],
        rows: Sequence[Sequence[tuple[str, str]]],
        *,
        names: int,
    ) -> None:
        table = Table.grid(padding=(0, 2, 0, 0), expand=False)
        table.add_column(overflow="fold", width=names)
        for _ in columns[1:]:
            table.add_column(no_wrap=True)
        table.add_row(*(Text(heads[n], style="bold") for n in columns))
        for cells in rows:
            table.add_row(*(Text(cells[n][0], style=cells[n][1]) for n in columns))
        self._console.print(table)

    def _hang(self, text: Text, first: str, rest: str) -> None:
        width = max(self._width - max(len(first), len(rest)), 10)
        for number, line in enumerate(text.wrap(self._console, width, overflow="fold")):
            lead = Text(first if number == 0 else rest, style="bold" if number == 0 else "")
            line.rstrip()
            self._verbatim(Text.assemble(lead, line))

    def _verbatim(self, text: Text) -> None:
        self._console.print(text, soft_wrap=True)


def _diff_style(line: str) -> str:
    return {"+": "green", "-": "red"}.get(line[:1], "")
