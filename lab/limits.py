"""The limits of a lab: on processes, memory and /tmp, so that a mistake does not take the machine.

A build with a C++ compiler, the window and a dozen nodes fit into the defaults. A variable of the
calling terminal changes each. docker/compose.yaml and .devcontainer have the same values.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass

from grader.base.errors import UsageError
from grader.base.i18n.message import say

PROCESSES, MEMORY, TMP = "LAB_PROCESSES", "LAB_MEMORY", "LAB_TMP"
UNITS = {"": 1, "b": 1, "k": 1 << 10, "m": 1 << 20, "g": 1 << 30}  # as Docker reads them
SIZE = re.compile(r"(\d{1,15})([bkmg]?)", re.IGNORECASE)
LEAST = {PROCESSES: ("100", 100), MEMORY: ("512m", 512 << 20), TMP: ("16m", 16 << 20)}


@dataclass(frozen=True)
class LabLimits:
    """Processes and threads together; bytes of memory, /tmp and other files in memory included."""

    processes: int = 2048
    memory: int = 4 << 30
    tmp: int = 1 << 30


def lab_limits(environment: Mapping[str, str]) -> LabLimits:
    """Return the limits with those that the caller's variables set.

    UsageError for a value that is no size, or with which no lab would open.
    """
    usual = LabLimits()
    return LabLimits(
        processes=_read(environment, PROCESSES, usual.processes),
        memory=_read(environment, MEMORY, usual.memory),
        tmp=_read(environment, TMP, usual.tmp),
    )


def _read(environment: Mapping[str, str], name: str, usual: int) -> int:
    text = environment.get(name, "").strip()
    if not text:
        return usual
    given = SIZE.fullmatch(text)
    counted = name == PROCESSES
    least, at_least = LEAST[name]
    value = int(given[1]) * UNITS[given[2].lower()] if given is not None else 0
    if given is None or (counted and given[2]) or value < at_least:
        example = "4096" if counted else "6g"
        raise UsageError(
            say("{name} must be at least {least}, not {text}", name=name, least=least, text=text),
            remedy=say("For example: {command}", command=f"{name}={example} make lab"),
        )
    return value
