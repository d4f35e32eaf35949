"""The `policy:` of an assignment: the deadline, and the penalty for late submissions."""

from __future__ import annotations

import re
from collections.abc import Iterator
from datetime import datetime, timezone, tzinfo
from typing import Annotated, Literal
from zoneinfo import ZoneInfo

from pydantic import BeforeValidator, Field

from grader.base.part import Part

SECONDS = {"s": 1, "min": 60, "h": 3_600, "d": 86_400}
DURATION = re.compile(r"(\d+(?:\.\d+)?) ?(s|min|h|d)")
AMOUNT = re.compile(r"(\d+(?:\.\d+)?)( ?%)?")


def _as_text(value: object) -> object:
    """Return a number as text, so that YAML needs no quotes around points."""
    is_number = isinstance(value, int | float) and not isinstance(value, bool)
    return f"{value:g}" if is_number else value


Amount = Annotated[str, BeforeValidator(_as_text)]


class Late(Part):
    """The penalty for each started day or hour; `most` is the largest penalty.

    An amount is points, or a share of the maximum score: `10%`. The score is 0 from `until` on.
    """

    per_day: Amount = ""
    per_hour: Amount = ""
    most: Amount = "100%"
    until: datetime | None = None


class Policy(Part):
    """The policy; without a due date there is no penalty.

    A student without a submission gets no grade unless `missing` is `zero`, because a submission
    that was not found may still exist.

    A due date has its offset from UTC (`2026-11-20T23:59:00+09:00`) or is in `time_zone`, a name
    of the IANA time zone database.
    """

    due: datetime | None = None
    time_zone: str = ""
    grace: str = "0 s"
    late: Late = Field(default_factory=Late)
    attempts: Literal["best", "last", "first"] = "best"
    missing: Literal["zero", "none"] = "none"

    @property
    def deadline(self) -> datetime | None:
        """The due date in UTC."""
        return self._instant(self.due)

    @property
    def end(self) -> datetime | None:
        """The time (UTC) from which no submission is accepted."""
        return self._instant(self.late.until)

    @property
    def zone(self) -> tzinfo | None:
        """The time zone of the course: `time_zone`, or else the offset of the due date."""
        if self.time_zone:
            return ZoneInfo(self.time_zone)
        return self.due.tzinfo if self.due is not None else None

    @property
    def grace_seconds(self) -> float:
        """Seconds after the due date without a penalty."""
        return duration(self.grace) or 0

    def _instant(self, value: datetime | None) -> datetime | None:
        if value is None:
            return None
        if value.tzinfo is None:
            value = value.replace(tzinfo=ZoneInfo(self.time_zone))
        # Python subtracts two times of one zone without looking at changes of their UTC offset
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
    """Yield each fault that the types do not catch: the place of its key, and the message."""
    try:
        if policy.time_zone:
            ZoneInfo(policy.time_zone)
    except (ValueError, OSError, KeyError):
        yield (
            ("time_zone",),
            f"time_zone: unknown time zone '{policy.time_zone}' (a valid one: Asia/Seoul)",
        )
        return
    places = {("due",): policy.due, ("late", "until"): policy.late.until}
    for place, instant in places.items():
        name = ".".join(place)
        if instant is not None and instant.tzinfo is None and not policy.time_zone:
            yield place, f"{name} has no time zone: add an offset such as +09:00, or set time_zone"
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
        yield ("late", "per_hour"), "late has both per_day and per_hour: keep one"
    if policy.deadline is None and (late.per_day or late.per_hour or late.until):
        yield ("late",), "late has a penalty, but there is no due date"
    if policy.deadline and policy.end and policy.end < policy.deadline:
        yield ("late", "until"), "late.until is before due"
