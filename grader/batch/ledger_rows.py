"""What the ledger's rows are outside of the ledger."""

from __future__ import annotations

import os
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path


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


def path_text(path: Path) -> str:
    """Return a path as the ledger keeps it: text, whatever bytes are in it."""
    return os.fsencode(path).decode("utf-8", "backslashreplace")
