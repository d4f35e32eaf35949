"""Instants, durations and states as texts for people."""

from __future__ import annotations

from datetime import datetime, timezone

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
    attempt = f"attempt {lapsed.attempt}" if lapsed.attempt else "an earlier verdict"
    signed = ", ".join(part for part in (made.by, instant(made.at)) if part)
    what = f"{made.check or 'the total'} of {attempt} was corrected to {points(made.points)}"
    return f"{what}, because: {one_line(made.because)}{f' ({signed})' if signed else ''}"


def plural(count: int, one: str, many: str = "") -> str:
    """Return a count with its noun: 1 student, 3 students."""
    return f"{count} {one if count == 1 else many or one + 's'}"
