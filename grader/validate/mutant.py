"""A mutant: the solution with one mistake in it, and what marking it must say."""

from __future__ import annotations

from dataclasses import dataclass

from grader.base.errors import AssignmentError
from grader.validate.tree import Edit
from grader.validate.tree import EditError
from grader.validate.tree import Tree
from grader.validate.tree import apply_all

STATIC = ("package.", "source.")


@dataclass(frozen=True, kw_only=True)
class Mutant:
    """One mutant.

    `families` begin the ids of the checks of which at least one must fail (a whole id: this one).
    `mistake` is the one that must be named first ("": any). `equivalent` says why the mutant is
    right all the same: then nothing may fail. `where` is its place in mutants.yaml, if it is there.
    """

    name: str
    edits: tuple[Edit, ...]
    families: tuple[str, ...]
    mistake: str = ""
    equivalent: str = ""
    where: str = ""

    @property
    def named(self) -> bool:
        """Whether a person wrote it down, with the mistake to be named."""
        return bool(self.where)

    @property
    def may_be_static(self) -> bool:
        """Whether looking at the files could be enough to decide it."""
        return not self.equivalent and any(
            family.startswith((*STATIC, "entry_point.mapping")) for family in self.families
        )

    def is_hit_by(self, check_id: str) -> bool:
        """Whether the failure of this check is what was expected."""
        return any(
            check_id == family or (family.endswith(".") and check_id.startswith(family))
            for family in self.families
        )

    def of(self, solution: Tree) -> Tree:
        """Return the package that it is. Raises AssignmentError where an edit does not fit."""
        try:
            return apply_all(self.edits, solution)
        except EditError as error:
            place = self.where or self.name
            raise AssignmentError(f"{place}: the edits do not fit the solution: {error}") from None
