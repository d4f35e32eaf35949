"""A page of text for a terminal, made with rich and returned as one string.

It does not depend on reports, and its output depends on its arguments alone, not on the
environment or the terminal of this process.
"""

from __future__ import annotations

import io
import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass

from rich.cells import cell_len, set_cell_size
from rich.table import Table
from rich.text import Text

from grader.base.carets import pieces, shortened
from grader.base.gated_console import Code, GatedConsole
from grader.base.plain_text import visible
from grader.report.wrap import breaks, longest_word

NARROW = 60  # columns; on a narrower page, columns are stacked
WIDEST = 100  # columns; longer lines are hard to read
LABEL = 12  # columns
MOST_NARROW = 10  # columns, of text beside its label
LINE_NUMBER = re.compile(r":\d+$")
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
    `translate` renders a `Message` in the reader's language. `links` has URLs by the text of a line
    of code (a line number after it does not count); a terminal opens them (OSC 8).
    """

    def __init__(
        self,
        *,
        width: int,
        styled: bool,
        translate: Callable[[str], str] = str,
        links: Mapping[str, str] | None = None,
    ) -> None:
        self._out = io.StringIO()
        self.translate = translate
        self._styled = styled
        self._links = dict(links or {})
        self._whole: set[str] = set()  # lines whose spaces at the end stay
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
    def width(self) -> int:
        """The columns of the page."""
        return self._width

    @property
    def columns(self) -> int:
        """The columns that a text beside a label has."""
        return self._width - (4 if self.narrow else LABEL)

    @property
    def narrow(self) -> bool:
        """Whether the page is too narrow for columns."""
        return self._width < NARROW

    def __str__(self) -> str:
        text = self._out.getvalue()
        if self._styled:
            return text
        rows = (line if line in self._whole else line.rstrip() for line in text.splitlines())
        return "".join(f"{row}\n" for row in rows)

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
        self._hang(Text("\n".join(lines), style=style), first, rest)

    def code(self, label: str, lines: Sequence[str]) -> None:
        """Write lines unwrapped: the terminal wraps long ones, so they can be copied."""
        first, rest = self._lead(label, lines)
        for number, line in enumerate(lines):
            lead = first if number == 0 else rest
            if url := self._links.get(LINE_NUMBER.sub("", line), ""):
                self._console.print(Text(lead, style="bold"), soft_wrap=True, end="")
                self._out.write(f"{linked(visible(line), url)}\n")
                continue
            code = Code((lead, "bold"), (line, _diff_style(line)))
            self._console.print(code, soft_wrap=True)
            if line[1:].strip() and line != line.rstrip():
                self._whole.add(lead + line)

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
        for lead, line in self._wrapped(Text("\n".join(lines)), QUOTED, CONTINUED, QUOTED):
            self._verbatim(Text(f"{lead}{line.plain}"))

    def table(self, rows: Sequence[CheckRow]) -> None:
        """Write the rows in columns; on a narrow page the text is below the name."""
        cells = [(self.translate(r.mark), r.name, self.translate(r.text), r.score) for r in rows]
        widths = [max(map(cell_len, column)) + 2 for column in zip(*cells)]
        free = self._width - widths[0] - widths[1] - widths[3]
        stacked = self.narrow or free < max(longest_word(text) for _, _, text, _ in cells)
        table = Table.grid(padding=(0, 2, 0, 0), expand=False)
        table.add_column(no_wrap=True)
        if not stacked:
            table.add_column(no_wrap=True)
        table.add_column(overflow="fold")
        table.add_column(justify="right", no_wrap=True)
        for row, (mark, name, text, score) in zip(rows, cells):
            both = [Text(f"{name}\n{text}")] if stacked else [Text(name), Text(text)]
            table.add_row(Text(mark, style=row.style), *both, Text(score))
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
        for number, (lead, line) in enumerate(self._wrapped(text, first, rest, rest)):
            style = "bold" if number == 0 else ""
            self._verbatim(Text.assemble((lead, style), line))

    def _wrapped(
        self, text: Text, first: str, rest: str, next_line: str
    ) -> Iterator[tuple[str, Text]]:
        """Yield the text's lines, wrapped, with their prefixes.

        `first` is the prefix of the first line, `next_line` of each other line of the text, `rest`
        of what is left of a wrapped line. Rows of marks are not wrapped (`grader.base.carets`).
        """
        lines = list(text.split("\n", allow_blank=True))
        lead = first
        for piece in pieces([line.plain for line in lines]):
            own, lines = lines[: len(piece.lines)], lines[len(piece.lines) :]
            if piece.marked:
                width = max(self._width - cell_len(lead), MOST_NARROW)
                own = [Text(line, style=text.style) for line in shortened(piece.lines, width)]
            for line in own:
                width = max(self._width - max(cell_len(lead), cell_len(rest)), MOST_NARROW)
                parts = [line] if piece.marked else line.divide(breaks(line.plain, width))
                for part in parts:
                    part.rstrip()
                    yield lead, part
                    lead = rest
                lead = next_line

    def _verbatim(self, text: Text) -> None:
        self._console.print(text, soft_wrap=True)


def _diff_style(line: str) -> str:
    return {"+": "green", "-": "red"}.get(line[:1], "")


def linked(text: str, url: str) -> str:
    """Return a text that a terminal opens as a URL (OSC 8); both must be free of control codes."""
    return f"\x1b]8;;{url}\x1b\\{text}\x1b]8;;\x1b\\"
