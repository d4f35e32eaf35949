"""When a submission was handed in, as a learning management system says it in a list."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from datetime import datetime, timezone, tzinfo

from grader.batch.model import HandedIn


@dataclass(frozen=True)
class Times:
    """The time of submission, how late it is in seconds, and until when it was extended.

    `late` is what the system says, 0 if it says that the submission is not late. Each is None if
    the list does not say. A time without a zone is in that of the person who downloaded the list.
    """

    submitted: datetime | None = None
    late: float | None = None
    extension: datetime | None = None

    @property
    def shows_due_date(self) -> bool:
        """Whether only a system that has a due date says this."""
        return bool(self.late) or self.extension is not None

    @property
    def say_something(self) -> bool:
        """Whether anything is known."""
        return self != Times()

    def in_zone(self, zone: tzinfo | None) -> Times:
        """Return the times in UTC; those without a zone are in `zone`, unknown if that is None."""
        return replace(
            self, submitted=_utc(self.submitted, zone), extension=_utc(self.extension, zone)
        )


def timed(attempts: Iterable[HandedIn], times: Mapping[str, Times]) -> list[HandedIn]:
    """Return the attempts with the times of each student who has one attempt, by the key.

    What an attempt knows itself is kept.
    """
    all_attempts = list(attempts)
    keys = [one.student.key for one in all_attempts]
    single = {key for key in times if keys.count(key) == 1}
    return [
        _with_times(one, times[one.student.key]) if one.student.key in single else one
        for one in all_attempts
    ]


def _with_times(one: HandedIn, times: Times) -> HandedIn:
    return replace(
        one,
        submitted=one.submitted or times.submitted,
        late_seconds=times.late if one.late_seconds is None else one.late_seconds,
        extension=one.extension or times.extension,
    )


def _utc(at: datetime | None, zone: tzinfo | None) -> datetime | None:
    if at is None or (at.tzinfo is None and zone is None):
        return None
    zoned = at if at.tzinfo is not None else at.replace(tzinfo=zone)
    try:
        return zoned.astimezone(timezone.utc)
    except (OverflowError, ValueError):  # the year 1 or 9999
        return None
