"""The input of the guide: the workspace, the assignment and the environment of a terminal."""

from __future__ import annotations

import copy
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path

from grader.base.i18n.translator import SOURCE
from grader.course.assignment import Assignment
from grader.package.source.node import NodeSource, read_node
from grader.package.submission import Submission
from grader.report.model import CheckResult
from grader.verdict.static import static_results
from grader.verdict.take_in import take_in_for

MAX_BYTES = 200_000


def _modified(path: Path) -> float:
    try:
        return path.stat().st_mtime
    except OSError:
        return 0.0


def unseen(*_: str) -> bool:
    """Whether a condition about the ROS graph holds, for who does not look."""
    return False


@dataclass(frozen=True)
class StudentState:
    """The input of the tests of the steps. `home` is None if only the workspace counts.

    `passed` is whether the files as they are had full marks, `lang` the student's language. `saw`
    tells whether a condition of `graph.CONDITIONS` holds, or once held, for a node or topic;
    `had_seen` whether it is known already, without a look. It reads files when they are needed and keeps what it read: make a new
    one for each look.
    """

    workspace: Path
    assignment: Assignment
    environment: Mapping[str, str]
    home: Path | None = None
    passed: bool = False
    lang: str = SOURCE
    saw: Callable[[str, str], bool] = unseen
    had_seen: Callable[[str, str], bool] = unseen
    _read: dict[Path, bytes] = field(default_factory=dict, compare=False, repr=False)

    def but(self, **changes: object) -> StudentState:
        """Return this state with other fields that no result depends on; what was read is kept."""
        other = copy.copy(self)
        other.__dict__.update(changes)
        return other

    @property
    def package(self) -> Path:
        """The package's folder."""
        return self.workspace / "src" / self.assignment.package

    @property
    def inner(self) -> Path:
        """The folder of the package's modules."""
        return self.package / self.assignment.package

    @property
    def node(self) -> Path:
        """The node's file."""
        return self.inner / self.assignment.node_file

    @cached_property
    def submission(self) -> Submission:
        """What the marking would take in from the workspace."""
        return take_in_for(self.assignment, self.workspace, at_work=True)

    @cached_property
    def results(self) -> dict[str, CheckResult]:
        """The results of the checks that the files decide, by kind of check, in `lang`."""
        if not self.workspace.is_dir():
            return {}
        found: dict[str, CheckResult] = {}
        for kind, result in self.each_result:
            if kind not in found or (result.status, found[kind].status) == ("failed", "passed"):
                found[kind] = result
        return found

    @cached_property
    def each_result(self) -> list[tuple[str, CheckResult]]:
        """The kind and the result of each check that the files decide, in `lang`."""
        kinds = {use.id: use.kind for use in self.assignment.checks}
        found = static_results(self.submission, self.assignment, lang=self.lang)
        return [(kinds[each], result) for each, result in found.items()]

    @cached_property
    def source(self) -> NodeSource | None:
        """The source of the node: its file, and the modules of the package that it imports."""
        assignment = self.assignment
        path = f"{assignment.package}/{assignment.node_file}"
        return read_node(
            lambda path: self.read(self.package / path) or None, path, assignment.function
        )

    @cached_property
    def saved(self) -> float:
        """When a file of the packages was saved last; seconds since the epoch, 0 if there is none."""
        found = self.submission
        if found.root is None:
            return 0.0
        paths = [self.workspace / found.root / file.path for file in found.files]
        for one in found.packages:
            paths += [self.workspace / one.root / file.path for file in one.files]
        return max((_modified(path) for path in paths if path.is_file()), default=0.0)

    @property
    def program(self) -> Path:
        """The executable as the isolated layout of a build has it."""
        name = self.assignment.package
        return self.workspace / "install" / name / "lib" / name / self.assignment.executable

    def installed(self, path: str, package: str = "") -> bool:
        """Whether a build has installed this path (isolated or merged install layout)."""
        install = self.workspace / "install"
        folders = (install / (package or self.assignment.package), install)
        return any((folder / path).exists() for folder in folders)

    def read(self, path: Path) -> bytes:
        """Return the first MAX_BYTES of a file; nothing if it cannot be read."""
        if path not in self._read:
            try:
                with path.open("rb") as stream:
                    self._read[path] = stream.read(MAX_BYTES)
            except OSError:
                self._read[path] = b""
        return self._read[path]
