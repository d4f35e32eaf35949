"""When a class must hand in, and what a score is worth after that: an assignment's `policy:`."""

from __future__ import annotations

import re
from collections.abc import Iterator
from datetime import datetime, timezone
from typing import Annotated, Literal
from zoneinfo import ZoneInfo

from pydantic import BaseModel, BeforeValidator, ConfigDict, Field

SECONDS = {"s": 1, "min": 60, "h": 3_600, "d": 86_400}
DURATION = re.compile(r"(\d+(?:\.\d+)?) ?(s|min|h|d)")
AMOUNT = re.compile(r"(\d+(?:\.\d+)?)( ?%)?")


def _as_text(value: object) -> object:
    """Return a number as text: points need no quotes."""
    is_number = isinstance(value, int | float) and not isinstance(value, bool)
    return f"{value:g}" if is_number else value


Amount = Annotated[str, BeforeValidator(_as_text)]


class _Part(BaseModel):
    model_config = ConfigDict(extra="forbid", frozen=True)


class Late(_Part):
    """What each begun day (or hour) costs, and how much it can be in all.

    An amount is points, or a share of the maximum score: `10%`. From `until` on nothing is left.
    """

    per_day: Amount = ""
    per_hour: Amount = ""
    most: Amount = "100%"
    until: datetime | None = None


class Policy(_Part):
    """The policy; one without a due date takes nothing.

    Who handed in nothing gets no grade unless `missing` is `zero`: nothing that was found is not
    always nothing that was handed in.

    A due date has its offset from UTC (`2026-11-20T23:59:00+09:00`), or counts in `time_zone`, a
    name of the IANA time zone database.
    """

    due: datetime | None = None
    time_zone: str = ""
    grace: str = "0 s"
    late: Late = Field(default_factory=Late)
    attempts: Literal["best", "last", "first"] = "best"
    missing: Literal["zero", "none"] = "none"

    @property
    def deadline(self) -> datetime | None:
        """The due date as an instant (UTC)."""
        return self._instant(self.due)

    @property
    def end(self) -> datetime | None:
        """The instant (UTC) from which nothing is accepted any more."""
        return self._instant(self.late.until)

    @property
    def grace_seconds(self) -> float:
        """Seconds after the due date that still count as in time."""
        return duration(self.grace) or 0

    def _instant(self, value: datetime | None) -> datetime | None:
        if value is None:
            return None
        if value.tzinfo is None:
            value = value.replace(tzinfo=ZoneInfo(self.time_zone))
        # two times of one zone would be subtracted as the clocks on the wall show them
        return value.astimezone(timezone.utc)


def duration(text: str) -> float | None:
    """Return the seconds of `90 s`, `15 min`, `2 h` or `3 d`; None for anything else."""
    found = DURATION.fullmatch(text.strip())
    return float(found[1]) * SECONDS[found[2]] if found else None


def amount(text: str, max_score: float) -> float | None:
    """Return the points of `10` or of `10%` of the maximum score; None for anything else."""
    found = AMOUNT.fullmatch(text.strip())
    if found is None:
        return None
    return float(found[1]) * (max_score / 100 if found[2] else 1)


def policy_faults(policy: Policy) -> Iterator[tuple[tuple[str | int, ...], str]]:
    """Yield what is wrong beyond types: the key's place, and the words."""
    try:
        if policy.time_zone:
            ZoneInfo(policy.time_zone)
    except (ValueError, OSError, KeyError):
        yield ("time_zone",), f"time_zone: there is no '{policy.time_zone}' (as in Asia/Seoul)"
        return
    places = {("due",): policy.due, ("late", "until"): policy.late.until}
    for place, instant in places.items():
        name = ".".join(place)
        if instant is not None and instant.tzinfo is None and not policy.time_zone:
            yield place, f"{name} has no time zone: add +09:00, say, or a time_zone of its own"
            return
        if instant is not None and not 1 < instant.year < 9999:
            yield place, f"{name} is in the year {instant.year}"
            return
    if duration(policy.grace) is None:
        yield ("grace",), f"grace must be a duration such as 15 min, not '{policy.grace}'"
    late = policy.late
    for name in ("per_day", "per_hour", "most"):
        text = getattr(late, name)
        if text and amount(text, 100) is None:
            yield ("late", name), f"late.{name} must be points or a share such as 10%, not '{text}'"
    if late.per_day and late.per_hour:
        yield ("late", "per_hour"), "late has both per_day and per_hour: give one"
    if policy.deadline is None and (late.per_day or late.per_hour or late.until):
        yield ("late",), "late costs something, but there is no due date"
    if policy.deadline and policy.end and policy.end < policy.deadline:
        yield ("late", "until"), "late.until is before due"
