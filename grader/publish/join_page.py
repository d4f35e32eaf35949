"""The join on a terminal, before anything is marked: which file is whose, and what is not sure."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Sequence
from typing import TYPE_CHECKING

from grader.base.plain_text import one_line
from grader.batch.join_file import JoinRow
from grader.batch.lowered import GradeChange
from grader.batch.words import plural

if TYPE_CHECKING:
    from grader.report.page import Page

MOST_LINES = 10  # of each list at the beginning of a run
STYLES = {"unsure": "bold magenta", "stranger": "bold magenta", "by name": "yellow"}
STYLES |= {"missing": "yellow", "elsewhere": "yellow"}
NONE = "-"


def join_lines(rows: Sequence[JoinRow], *, quiet: bool) -> Iterator[str]:
    """Yield the first lines of a run: what a person should look at first, then who has which file.

    Each list has at most ten lines; `quiet` leaves out those that are sure.
    """
    on_list = any(row.joined != "no roster" for row in rows)
    lists: list[tuple[str, list[str]]] = [
        ("unsure, nobody gets a grade", _files(rows, "unsure")),
        ("not on the roster", _files(rows, "stranger")),
        ("joined by name only", _files(rows, "by name")),
        ("without a submission", [_who(row) for row in rows if row.joined == "missing"]),
        ("submitted elsewhere", [_who(row) for row in rows if row.joined == "elsewhere"]),
    ]
    if not quiet:
        title = "joined" if on_list else "no roster: the names are those of the files"
        lists.append((title, [*_files(rows, "yes"), *_files(rows, "no roster")]))
    for title, lines in lists:
        if lines:
            yield f"{title} ({len(lines)}):"
            yield from (f"  {line}" for line in lines[:MOST_LINES])
            if lines[MOST_LINES:]:
                yield f"  and {len(lines) - MOST_LINES} more"


def change_lines(
    changes: Sequence[GradeChange], waiting: Collection[str], names: Callable[[str], str]
) -> Iterator[str]:
    """Yield which grades change that exist in some place; `waiting` are keys still to be marked."""
    places: dict[tuple[str, str, str, str], list[str]] = {}
    for one in changes:
        if one.key not in waiting:
            change = (one.key, one.name, one.before, one.after)
            places.setdefault(change, []).append(one.where)
    decided = [
        f"{name}: {before} → {after or 'no grade'} (in {', '.join(where)})"
        for (_, name, before, after), where in places.items()
    ]
    if decided:
        yield f"{plural(len(decided), 'grade')} will change:"
        yield from (f"  {line}" for line in decided[:MOST_LINES])
        if decided[MOST_LINES:]:
            yield f"  and {len(decided) - MOST_LINES} more"
    if waiting:
        yield f"{plural(len(waiting), 'grade')} can change, because a submission is to be marked:"
        for key in [*waiting][:MOST_LINES]:
            yield f"  {names(key)}"
        if len(waiting) > MOST_LINES:
            yield f"  and {len(waiting) - MOST_LINES} more"


def join_page(
    rows: Sequence[JoinRow], marking: Callable[[str], str], *, width: int, styled: bool
) -> str:
    """Return the whole join as a table; `marking` says what happens to a file."""
    from grader.report.page import Page  # noqa: PLC0415 - slow, and only a dry run needs it

    page: Page = Page(width=width, styled=styled)
    page.grid(["file", "student", "joined", "marking"], [_cells(row, marking) for row in rows])
    return str(page)


def _cells(row: JoinRow, marking: Callable[[str], str]) -> list[tuple[str, str]]:
    style = STYLES.get(row.joined, "")
    who = _who(row) if row.name or row.student else NONE
    joined = row.joined if row.joined != "no roster" else ""
    return [
        (one_line(row.file or NONE, most=60), ""),
        (who, style),
        (joined, style),
        (marking(row.file) if row.file else "", ""),
    ]


def _files(rows: Sequence[JoinRow], joined: str) -> list[str]:
    found = [row for row in rows if row.joined == joined]
    return [
        f"{one_line(row.file, most=80)} → {_who(row)}" if row.file else _who(row) for row in found
    ]


def _who(row: JoinRow) -> str:
    if row.file and row.joined in ("unsure", "stranger"):
        return "?"
    name = one_line(row.name or row.student, most=60)
    word = one_line(row.student, most=60)
    return f"{name} ({word})" if word and word != name else name
