"""Compares the scores that Classroom 50 collected with those of your own machine.

Students own the runner that writes their result.json, so it says what they let it say. The same commits,
marked again by `grade-all`, say what counts.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from grader.base.errors import UsageError
from grader.base.nearest import meant, nearest
from grader.base.plain_text import one_line, points
from grader.batch.sheet import Sheet, folded_header

SCORES = "classroom50/scores/v1"
COMMIT = re.compile(r"-([0-9a-f]{7,40})$")
MOST_SHOWN = 60  # characters of a login
PACKED = re.compile(r"^([0-9a-f]{40,64}) (\S+)$", re.MULTILINE)


@dataclass(frozen=True)
class Row:
    """A student's two scores, in shares of 1; None where there is none. `commit` is "" if both are of one."""

    owner: str
    theirs: float | None
    ours: float | None
    commit: str = ""

    @property
    def differs(self) -> bool:
        """Whether somebody has to look at it."""
        known = self.theirs is not None and self.ours is not None
        return bool(self.commit) or not known or abs((self.theirs or 0) - (self.ours or 0)) > 1e-6

    @property
    def line(self) -> str:
        """The row as a line of text."""
        shares = (self.theirs, self.ours)
        shown = [f"{points(100 * one)} %" if one is not None else "-" for one in shares]
        return "  ".join([*(f"{one:>8}" for one in shown), one_line(self.owner), self.commit])


def compared(scores: bytes, gradebook: bytes, slug: str, clones: Path | None) -> list[Row]:
    """Return the students of an assignment of scores.json, each with both scores.

    `gradebook` is our gradebook.csv; `clones` the folder that was marked: then a score of another commit than
    the collected one is said. Raises UsageError if a file is not what it should be.
    """
    theirs, ours = _latest(scores, slug), _of_gradebook(gradebook)
    rows = []
    for key, (owner, tag, share) in theirs.items():
        commit = _other_commit(tag, clones, ours[key][0]) if key in ours else ""
        rows.append(Row(owner[:MOST_SHOWN], share, ours.get(key, ("", None))[1], commit))
    rows += [Row(key, None, found) for key, (_, found) in ours.items() if key not in theirs]
    return sorted(rows, key=lambda row: (not row.differs, row.owner.casefold()))


def _latest(content: bytes, slug: str) -> dict[str, tuple[str, str, float | None]]:
    """Return owner, tag and share of the points of each latest submission, by the folded owner."""
    try:
        found = json.loads(content)
        if found["schema"] != SCORES:
            raise ValueError(f"its schema is not {SCORES}")
        buckets = dict(found["assignments"])
        known = {str(name): [_entry(one) for one in buckets[name]["entries"]] for name in buckets}
    except (ValueError, TypeError, KeyError, IndexError, RecursionError) as error:
        raise UsageError(
            f"this is no scores.json of Classroom 50: {type(error).__name__}: {error}"[:200],
            remedy=f"Give the file <classroom>/scores.json of your config repository ({SCORES}).",
        ) from None
    if slug not in known and (slug or len(known) != 1):
        close = nearest(slug, known) or ""
        raise UsageError(
            f"scores.json has no assignment '{slug}'{meant(close)}"
            if slug
            else "which assignment?",
            remedy=f"Give one of these with --slug: {', '.join(sorted(known)) or 'none'}.",
        )
    return {one[0].casefold(): one for one in known[slug or next(iter(known))]}


def _entry(entry: Any) -> tuple[str, str, float | None]:
    """Return owner, tag and share of the points of an entry; ValueError if it is none."""
    latest = entry["submissions"][0]
    owner, tag, score, most = (
        entry["owner"],
        latest["submission"],
        latest["score"],
        latest["max-score"],
    )
    points_are_whole = all(type(one) is int and one >= 0 for one in (score, most))
    if not isinstance(owner, str) or not isinstance(tag, str) or not points_are_whole:
        raise ValueError("a submission needs an owner, a tag, and whole points")
    return owner, tag, score / most if most else None


def _of_gradebook(content: bytes) -> dict[str, tuple[str, float | None]]:
    """Return key and share of the points of each login in our gradebook.csv."""
    sheet = Sheet(content, name="the gradebook")
    header = [folded_header(name) for name in sheet.header]
    names = ("key", "username", "final", "max score")
    lacks = [name for name in names if name not in header]
    if lacks:
        raise UsageError(
            f"the gradebook lacks the column {lacks[0].replace(' ', '_')}",
            remedy="Give the gradebook.csv that grade-all wrote.",
        )
    keys, logins, finals, most = (sheet.column(header.index(name)) for name in names)
    return {
        (login or key).casefold(): (key, _share(final, whole))
        for key, login, final, whole in zip(keys, logins, finals, most)
    }


def _share(final: str, whole: str) -> float | None:
    try:
        return float(final) / float(whole)
    except (ValueError, ZeroDivisionError):
        return None


def _other_commit(tag: str, clones: Path | None, key: str) -> str:
    """Return what to say if a clone has another commit than the one that Classroom 50 marked."""
    wanted = COMMIT.search(tag)
    head = head_of(clones / key) if clones is not None else ""
    if wanted is None or not head or head.startswith(wanted[1]):
        return ""
    return f"marked here: commit {head[:7]}, there: {wanted[1]}"


def head_of(clone: Path) -> str:
    """Return the commit that a clone has checked out; "" if that cannot be read.

    Git itself is not asked: a folder of a student can tell it which programs to start.
    """
    git = clone / ".git"
    head = _text(git / "HEAD")
    ref = head.removeprefix("ref: ")
    if ref == head:
        return head
    if not re.fullmatch(r"refs/[\w./-]+", ref) or ".." in ref:
        return ""
    packed = {name: sha for sha, name in PACKED.findall(_text(git / "packed-refs"))}
    return _text(git / ref) or packed.get(ref, "")


def _text(path: Path) -> str:
    try:
        return "" if path.is_symlink() else path.read_text(encoding="ascii")[:1_000_000].strip()
    except (OSError, UnicodeDecodeError):
        return ""


def report_lines(rows: list[Row]) -> Iterator[str]:
    """Yield the comparison as text: those that differ, or that all are equal."""
    odd = [row for row in rows if row.differs]
    if odd:
        yield "   there      here  student"
    for row in odd:
        yield row.line.rstrip()
    yield f"{len(rows)} students: {len(rows) - len(odd)} equal, {len(odd)} to look at"
