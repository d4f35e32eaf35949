"""Intake: find the package in what was handed in, without running or trusting any of it."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Literal

from grader.report.model import Modes
from grader.report.model import Origin


@dataclass(frozen=True)
class SourceFile:
    """One file of the package: `path` relative to the package root, POSIX style.

    `mode` holds the permission bits (e.g. 0o755), `data` the bytes (files beyond the size limit
    are left out of the submission and noted), `kind` whether it is a folder, a file or a link
    that stays inside the package (`target` then).
    """

    path: str
    kind: Literal["file", "folder", "link"]
    mode: int = 0o644
    data: bytes = b""
    target: str = ""


@dataclass(frozen=True)
class Candidate:
    """A folder that looks like a package: its path relative to the submission, and its name."""

    path: str
    name: str


@dataclass(frozen=True)
class Submission:
    """What was handed in. `root` is the package's folder relative to `path`; None if there is none."""

    path: Path
    name: str
    origin: Origin
    modes: Modes
    sha256: str
    root: str | None
    files: tuple[SourceFile, ...]
    candidates: tuple[Candidate, ...] = ()
    notes: tuple[str, ...] = ()
    problem: str = ""
    problem_mistake: str = ""
    problem_fix: str = ""

    def file(self, path: str) -> SourceFile | None:
        """Return the package's file (links inside the package resolved), or None."""
        raise NotImplementedError(path)


def take_in(path: Path, *, package: str, node_file: str, name: str | None = None) -> Submission:
    """Take in a directory that is the package, a workspace, or holds the package below."""
    raise NotImplementedError(path, package, node_file, name)
