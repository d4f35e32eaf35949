"""Instants, durations and states as texts for people."""

from __future__ import annotations

from datetime import datetime, timezone, tzinfo

from grader.base.i18n.message import Message, joined, msg, say
from grader.base.plain_text import one_line, points
from grader.batch.model import EntryStatus, LapsedOverride

MINUTE, HOUR, DAY = 60, 3_600, 86_400  # seconds
UNITS = (
    (DAY, msg("{count} d")),
    (HOUR, msg("{count} h")),
    (MINUTE, msg("{count} min")),
    (1, msg("{count} s")),
)

STATES: dict[EntryStatus, str] = {
    "graded": say("graded"),
    "ungradable": say("to be looked at by hand"),
    "error": say("not marked, a fault of the grader"),
    "missing": say("nothing handed in"),
    "elsewhere": say("submitted elsewhere"),
    "unclear": say("not known whose submission it is"),
    "pending": say("not marked yet"),
}
# a sign for each state of a check: colour is never the only difference
SIGNS = {"passed": "✓", "failed": "✗", "skipped": "–", "inconclusive": "?", "error": "!"}


def instant(value: datetime | None) -> str:
    """Return an instant in UTC to the minute, "" for None; without a zone it is taken as UTC."""
    if value is None:
        return ""
    zoned = value if value.tzinfo else value.replace(tzinfo=timezone.utc)
    return f"{zoned.astimezone(timezone.utc):%Y-%m-%d %H:%M} UTC"


def local_instant(value: datetime | None, zone: tzinfo | None = None) -> str:
    """Return an instant to the minute in a zone (None: its own), with the offset from UTC."""
    if value is None:
        return ""
    zoned = value if zone is None or value.tzinfo is None else value.astimezone(zone)
    if not zoned.utcoffset():
        return instant(zoned)
    return f"{zoned:%Y-%m-%d %H:%M} ({offset_words(zoned)})"


def offset_words(value: datetime) -> str:
    """Return the offset of an instant's own zone: UTC, UTC+09:00; without a zone it is UTC."""
    offset = value.utcoffset()
    if not offset:
        return "UTC"
    minutes = int(offset.total_seconds()) // 60
    sign, (hours, rest) = "-" if minutes < 0 else "+", divmod(abs(minutes), 60)
    return f"UTC{sign}{hours:02}:{rest:02}"


def has_grade(system: str, cell: str) -> Message:
    """Return that a system has a grade for the assignment already."""
    return say("{system} has the grade {grade}", system=system, grade=one_line(cell, most=20))


def duration(seconds: float) -> str:
    """Return a duration in its two largest units: 4.2 s, 12 min, 2 h 10 min, 3 d 4 h."""
    if seconds < MINUTE:
        return say("{count} s", count=f"{seconds:.1f}")
    for (unit, words), (less, less_words) in zip(UNITS, UNITS[1:]):
        if seconds >= unit:
            great, rest = divmod(int(seconds), unit)
            small = rest // less
            return joined(_counted(words, great), _counted(less_words, small) if small else "")
    return ""


def _counted(words: str, count: int) -> Message:
    return Message(words, {"count": count})


def lapsed_words(lapsed: LapsedOverride) -> str:
    """Return a correction that no longer applies, as one line for the instructor."""
    made = lapsed.override
    what, given, why = made.check or say("the total"), points(made.points), one_line(made.because)
    text = say(
        "{what} of an earlier verdict was corrected to {points}, because: {why}",
        what=what,
        points=given,
        why=why,
    )
    if lapsed.attempt:
        text = say(
            "{what} of attempt {number} was corrected to {points}, because: {why}",
            what=what,
            number=lapsed.attempt,
            points=given,
            why=why,
        )
    signed = ", ".join(part for part in (made.by, instant(made.at)) if part)
    return joined(text, f"({signed})" if signed else "")


def plural(count: int, one: str, many: str = "") -> str:
    """Return a count with its noun: 1 student, 3 students."""
    return f"{count} {one if count == 1 else many or one + 's'}"
