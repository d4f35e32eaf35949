"""The model of a corpus package: edits of the solution and the expected verdict."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from grader.validate.tree import Edit

PACKAGE = "my_robot_controller"
INNER = PACKAGE
NODE = f"{INNER}/my_first_node.py"
INIT = f"{INNER}/__init__.py"
MARKER = f"resource/{PACKAGE}"
MANIFEST = "package.xml"
SETUP = "setup.py"
CFG = "setup.cfg"

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
    (None: any). `undecided` are checks whose outcome depends on the machine's limits; if there are
    any, `expect_score` is None. Every other check passes. `wall_clock` means that the node does
    not follow `/clock`; `hostile`, that it needs a sandbox.
    """

    name: str
    edits: tuple[Edit, ...]
    expect_failed: Mapping[str, str | None] = field(default_factory=dict)
    expect_skipped: frozenset[str] = frozenset()
    expect_score: float | None = None
    undecided: frozenset[str] = frozenset()
    wall_clock: bool = False
    hostile: bool = False
    note: str = ""


def right(name: str, *edits: Edit, note: str = "", wall_clock: bool = False) -> Package:
    """Return a package that deserves full marks."""
    return Package(name=name, edits=edits, expect_score=100, note=note, wall_clock=wall_clock)


def broken(
    name: str,
    *edits: Edit,
    failed: Mapping[str, str | None],
    skipped: frozenset[str] = frozenset(),
    score: float,
    note: str = "",
) -> Package:
    """Return a package with a mistake: the failed checks, the skipped ones and the score."""
    return Package(
        name=name,
        edits=edits,
        expect_failed=failed,
        expect_skipped=skipped,
        expect_score=score,
        note=note,
    )


def hostile(
    name: str,
    *edits: Edit,
    failed: Mapping[str, str | None] | None = None,
    skipped: frozenset[str] = frozenset(),
    undecided: frozenset[str] = frozenset(),
    score: float | None = None,
    note: str = "",
) -> Package:
    """Return a package that tries to harm the grader or to gain points."""
    return Package(
        name=name,
        edits=edits,
        expect_failed=failed or {},
        expect_skipped=skipped,
        expect_score=score,
        undecided=undecided,
        hostile=True,
        note=note,
    )
