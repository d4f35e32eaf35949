"""What the ledger's rows are to the rest of the house."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import datetime


class AlreadyMarkedError(Exception):
    """A student has a verdict for this key, and nobody asked for another one."""


@dataclass(frozen=True)
class VerdictRow:
    """A verdict as the ledger knows it, without its report."""

    id: int
    student: str
    key: str
    submission: str
    score: float
    max_score: float


@dataclass(frozen=True)
class HandedInRow:
    """One content that a student handed in; `submitted` as the course's system tells it."""

    student: str
    submission: str
    submitted: datetime | None
    late: bool | None
    path: str
    first_seen: datetime


@dataclass(frozen=True)
class Regrade:
    """A verdict that is to be reached again, and the id of the one before."""

    student: str
    key: str
    before: int
