"""A small change of a package after which its node counts, as it was found by trying."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from grader.package.edit.files import Files
from grader.report.model import Where
from grader.run.variants import Values

NEARLY, WHOLE = 8, 9
"""How far a node gets that counts, and that counts in the right period without a sleep."""
FAR = 2  # lines, from which a change is of another place
ELSEWHERE = 10**6
"""The distance of a change in another file."""
SHORT = 2
"""What each step that a node does not get further is worth, in costs of a change."""


def rank_of(level: int, cost: int) -> int:
    """Return how good a change is, 0 the best, by how far a node gets with it and by its cost."""
    if level < NEARLY:
        return (WHOLE - level) * 100 + cost
    return cost + SHORT * (WHOLE - level)


@dataclass(frozen=True)
class Step:
    """One change of a file, as a text can show it."""

    sort: str
    path: str
    line: int
    name: str
    written: str


@dataclass(frozen=True)
class FoundChange:
    """One or two changes of a node: the new texts of files, by their path.

    `level` is how far the node gets with it. If it does not count, the text of its lines is right.
    `values` are code and the values that it has first at the place of the change, without it. It only
    `shows` a place if it could take away what the program is meant to do. It is `certain` if it hardly
    helps by chance.
    """

    steps: tuple[Step, ...]
    texts: Mapping[str, str]
    cost: int
    level: int = WHOLE
    values: Values = ()
    shows: bool = False
    certain: bool = False

    @property
    def counts(self) -> bool:
        """Whether the node counts with it."""
        return self.level >= NEARLY

    @property
    def rank(self) -> int:
        """How good it is, 0 the best: a small change may leave the period wrong."""
        return rank_of(self.level, self.cost)

    def of(self, files: Files) -> Files:
        """Return the files with this change."""
        for path, text in self.texts.items():
            files = files.with_data(path, text.encode())
        return files

    def distance(self, where: Where | None) -> int:
        """Return how many lines its first change is from a place."""
        step = self.steps[0]
        if where is None or where.file != step.path or not where.line:
            return ELSEWHERE
        return abs(step.line - where.line)

    @property
    def is_simple(self) -> bool:
        """Whether another diagnosis of its line can explain it, or none is needed."""
        return self.counts and len(self.steps) == 1 and not self.shows

    @property
    def is_cautious(self) -> bool:
        """Whether it only shows where the mistake is: another change may be meant."""
        return len(self.steps) == 1 and self.shows

    @property
    def is_certain(self) -> bool:
        """Whether it shows by itself where the mistake is, whatever a diagnosis says."""
        return self.level == WHOLE and len(self.steps) == 1 and self.certain


@dataclass(frozen=True)
class Fact:
    """What a rule (grader/explain/rules.py) tells of a followed run: where, and the values of its texts."""

    rule: str
    path: str
    line: int
    values: Mapping[str, int | float | str]


@dataclass(frozen=True)
class Sought:
    """What short runs show of a failed check: a fact, and changes with which it passes, the best first.

    `runs` is how many changes were run.
    """

    fact: Fact | None = None
    changes: tuple[FoundChange, ...] = ()
    runs: int = 0
