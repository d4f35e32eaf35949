"""The key of a verdict: a hash of everything that decides it, so equal keys mean equal verdicts.

Hashed are the submission (contents and exec bits), the assignment, the distro and its ROS, the
limits, the report's language, and the grader's own source with its translations (not its version
number, which is easily left unchanged).
"""

from __future__ import annotations

import functools
import hashlib
import json
import os
from dataclasses import asdict
from pathlib import Path

from grader.base.project import PACKAGE
from grader.course.assignment import Assignment
from grader.ros.prefix import Ros
from grader.sandbox.limits import Limits

NOT_MARKING = ("batch", "publish", "keys")  # folders that do not affect a verdict
SOURCES = (".py", ".toml", ".json", ".yaml", ".txt", ".bash", ".in", ".j2", ".css", ".js", ".mo")


def source_digest(folder: Path = PACKAGE, leave_out: tuple[str, ...] = ()) -> str:
    """Return the hash of a folder's sources, without the subfolders in `leave_out`."""
    kept = [line for place, line in _source_lines(folder) if place.split("/")[0] not in leave_out]
    return hashlib.sha256("".join(kept).encode()).hexdigest()


@functools.cache
def _source_lines(folder: Path) -> tuple[tuple[str, str], ...]:
    """Return the path of each source below a folder, with a line that has its path and its hash.

    A run without anything to mark mostly waits for this, so each file is read once.
    """
    found = []
    for at, folders, names in os.walk(folder):
        folders[:] = [name for name in folders if name != "__pycache__"]
        found += [Path(at, name) for name in names if name.endswith(SOURCES)]
    lines = []
    for path in sorted(path for path in found if path.is_file()):
        place = path.relative_to(folder).as_posix()
        lines.append((place, f"{place}\0{hashlib.sha256(path.read_bytes()).hexdigest()}\n"))
    return tuple(lines)


def surroundings_key(assignment: Assignment, ros: Ros, limits: Limits, *, lang: str) -> str:
    """Return the hash of everything that decides a verdict except the submission."""
    made_of = [ros.distro.name, ros.kind, ros.versions]
    source = source_digest(PACKAGE, NOT_MARKING)
    parts = [assignment.sha256, made_of, asdict(limits), lang, source]
    return hashlib.sha256(json.dumps(parts, sort_keys=True).encode()).hexdigest()


def verdict_key(submission: str, surroundings: str) -> str:
    """Return the verdict key for a submission's hash and a `surroundings_key`."""
    return hashlib.sha256(f"{submission} {surroundings}".encode()).hexdigest()
