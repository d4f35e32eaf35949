"""The model of a corpus package: edits of the solution and the expected verdict."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

from grader.course.load import load_assignment
from grader.mistakes.example import CFG, INIT, INNER, MANIFEST, MARKER, NODE, PACKAGE, SETUP
from grader.package.edit.tree import Edit
from grader.verdict.evaluate import assigned_checks

__all__ = ["CFG", "INIT", "INNER", "MANIFEST", "MARKER", "NODE", "PACKAGE", "SETUP"]

ROOT = Path(__file__).parents[2]
ASSIGNMENT = load_assignment(ROOT / "lab/course/hello_time/assignment.yaml")
POINTS = {use.id: use.points for use in ASSIGNMENT.checks}

STATIC = frozenset(
    {
        "package.manifest",
        "package.marker",
        "package.setup_cfg",
        "source.node_file",
        "source.exec_bit",
        "source.shebang",
    }
)
AFTER_START = frozenset(
    {"run.spins", "run.node_name", "run.output", "run.logger", "run.period", "run.interrupt"}
)
RUN = AFTER_START | {"run.starts"}
INSTALLED = RUN | {"entry_point.executable"}
BUILT = INSTALLED | {"build.colcon"}
FOUND = STATIC | BUILT | {"entry_point.mapping"}
TICKS = frozenset({"run.logger", "run.period"})


@dataclass(frozen=True, kw_only=True)
class Package:
    """One package of the corpus.

    `expect_failed` names the checks that fail, each with the mistake that the verdict must name
    (None: any). `blocked` are checks that are skipped because of what the build or the run does;
    after a failed check in `not_blocking`, those that depend on it are evaluated.
    `undecided` are checks whose outcome depends on the machine's limits. Every other check passes,
    if none that it depends on fails. `wall_clock` means that the node does not follow `/clock`;
    `hostile`, that it needs a sandbox.
    """

    name: str
    edits: tuple[Edit, ...]
    expect_failed: Mapping[str, str | None] = field(default_factory=dict)
    blocked: frozenset[str] = frozenset()
    not_blocking: frozenset[str] = frozenset()
    undecided: frozenset[str] = frozenset()
    wall_clock: bool = False
    hostile: bool = False
    note: str = ""

    @property
    def expect_skipped(self) -> frozenset[str]:
        """The checks that are skipped: the blocked ones, and all that depend on a lost check."""
        lost = {*self.expect_failed, *self.blocked}
        for one in assigned_checks(ASSIGNMENT):  # in the order of their dependencies
            if (lost - self.not_blocking) & set(one.depends):
                lost.add(one.use.id)
        return frozenset(lost) - set(self.expect_failed) - self.undecided

    @property
    def expect_score(self) -> float | None:
        """The points of all checks that pass; None if the limits decide about some."""
        if self.undecided:
            return None
        lost = {*self.expect_failed, *self.expect_skipped}
        return sum(points for check, points in POINTS.items() if check not in lost)


def right(name: str, *edits: Edit, note: str = "", wall_clock: bool = False) -> Package:
    """Return a package that deserves full marks."""
    return Package(name=name, edits=edits, note=note, wall_clock=wall_clock)


def hostile(
    name: str,
    *edits: Edit,
    failed: Mapping[str, str | None] | None = None,
    skipped: frozenset[str] = frozenset(),
    undecided: frozenset[str] = frozenset(),
    note: str = "",
) -> Package:
    """Return a package that tries to harm the grader or to gain points."""
    return Package(
        name=name,
        edits=edits,
        expect_failed=failed or {},
        blocked=skipped,
        undecided=undecided,
        hostile=True,
        note=note,
    )
