"""A mutant: the solution with one mistake in it, and the expected result of marking it."""

from __future__ import annotations

from dataclasses import dataclass

from grader.base.errors import AssignmentError
from grader.course.assignment import Assignment
from grader.package.edit.tree import Edit, EditError, Tree, apply_all
from grader.verdict.own_checks import static_of


@dataclass(frozen=True, kw_only=True)
class Mutant:
    """One mutant.

    `families` are ids of checks, or prefixes of ids that end with a dot; at least one of these
    checks must fail. `mistake` is the one that must come first ("": any). `equivalent` is why the
    mutant is correct nevertheless: then nothing may fail. `where` is its `file:line` in
    mutants.yaml ("" for an automatic mutant).
    """

    name: str
    edits: tuple[Edit, ...]
    families: tuple[str, ...]
    mistake: str = ""
    equivalent: str = ""
    where: str = ""

    @property
    def named(self) -> bool:
        """Whether it comes from mutants.yaml, with its expected mistake."""
        return bool(self.where)

    def may_be_static(self, assignment: Assignment) -> bool:
        """Whether its files could be sufficient to decide it."""
        kinds = static_of(assignment)
        static = (use.id for use in assignment.checks if use.kind in kinds)
        return not self.equivalent and any(map(self.is_hit_by, static))

    def is_hit_by(self, check_id: str) -> bool:
        """Whether a failure of this check is expected."""
        return any(
            check_id == family or (family.endswith(".") and check_id.startswith(family))
            for family in self.families
        )

    def of(self, solution: Tree) -> Tree:
        """Return the mutated package. Raises AssignmentError if an edit does not fit."""
        try:
            return apply_all(self.edits, solution)
        except EditError as error:
            place = self.where or self.name
            raise AssignmentError(f"{place}: the edits do not fit the solution: {error}") from None
