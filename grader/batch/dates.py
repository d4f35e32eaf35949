"""Dates and times that an instructor writes into a CSV file."""

from __future__ import annotations

import re
from datetime import datetime, timezone, tzinfo

from grader.base.errors import UsageError
from grader.batch.systems.moodle.times import date_in

ISO = re.compile(
    r"(?P<day>\d{4}-\d{1,2}-\d{1,2})"
    r"(?:[T ]\s*(?P<time>\d{1,2}:\d\d)(?::(?P<seconds>\d\d))?(?:\.\d+)?\s*"
    r"(?P<zone>Z|UTC|GMT|[+-]\d\d:?\d\d)?)?"
)
OFFSET = re.compile(r"(?:UTC|GMT|\bZ\b|[+-]\d\d:?\d\d$)", re.IGNORECASE)
END_OF_DAY = (23, 59, 59)
FORMS = "write 2026-11-25 23:59, or 2026-11-25T23:59:00+09:00"


def instant_in(text: str, zone: tzinfo | None, *, end_of_day: bool = False) -> datetime:
    """Return the instant (UTC) that a cell names; without an offset it is in `zone`.

    `end_of_day` takes a date without a time as the end of that day. Raises UsageError if the text
    is no date that can be read for sure, or if it has no offset and there is no zone.
    """
    found = _read(text.strip(), end_of_day=end_of_day)
    if found is None:
        raise UsageError(f"'{text}' is not a date and time that can be read for sure: {FORMS}")
    if found.tzinfo is None and zone is None:
        raise UsageError(
            f"'{text}' has no offset from UTC, and the assignment's policy has no time_zone: {FORMS}"
        )
    zoned = found if found.tzinfo is not None else found.replace(tzinfo=zone)
    try:
        return zoned.astimezone(timezone.utc)
    except (OverflowError, ValueError):
        raise UsageError(f"'{text}' is in the year {found.year}") from None


def _read(text: str, *, end_of_day: bool) -> datetime | None:
    match = ISO.fullmatch(text)
    if match is None:
        # (an offset after another form of date would be lost)
        return None if OFFSET.search(text) else date_in(text)
    if match["time"] is None and not end_of_day:
        return None
    try:
        year, month, day = (int(part) for part in match["day"].split("-"))
        if match["time"] is None:
            return datetime(year, month, day, *END_OF_DAY)
        hour, minute = (int(part) for part in match["time"].split(":"))
        seconds = int(match["seconds"] or 0)
        return datetime(year, month, day, hour, minute, seconds, tzinfo=_zone(match["zone"]))
    except ValueError:
        return None


def _zone(text: str | None) -> tzinfo | None:
    if text is None:
        return None
    if text[0] not in "+-":
        return timezone.utc
    return datetime.strptime(text.replace(":", ""), "%z").tzinfo
