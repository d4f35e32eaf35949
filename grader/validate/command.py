"""`grader validate`: does an assignment mark what it claims to mark?"""

from __future__ import annotations

import fnmatch
import os
import time
from collections.abc import Callable
from collections.abc import Sequence
from dataclasses import dataclass
from dataclasses import replace
from pathlib import Path

from grader.checks.all import CHECKS
from grader.errors import AssignmentError
from grader.errors import UsageError
from grader.mistakes.catalogue import CATALOGUE
from grader.ordering import _assignment_files as assignment_files
from grader.runner import Order
from grader.validate.automatic import generate
from grader.validate.marking import Marked
from grader.validate.marking import mark_files
from grader.validate.marking import mark_path
from grader.validate.marking import mutate
from grader.validate.matrix import Matrix
from grader.validate.matrix import Row
from grader.validate.matrix import as_json
from grader.validate.matrix import ordered
from grader.validate.mutant import Mutant
from grader.validate.named import Catalogued
from grader.validate.named import read_mutants
from grader.validate.pool import mark_all
from grader.validate.tree import Tree
from grader.validate.tree import digest
from grader.validate.tree import read_tree

KEYS = Path(__file__).resolve().parents[1] / "keys"
TELLS_EACH = 10.0  # seconds between two lines of progress


@dataclass(frozen=True, kw_only=True)
class Wish:
    """What is to be validated: `order` says how to mark (its path is not looked at).

    `keys` has the solution and mutants.yaml, `starter` what students begin with (None: nothing).
    `static`: only the mutants whose files decide them; `only`: those whose name fits the pattern.
    """

    order: Order
    keys: Path
    starter: Path | None = None
    static: bool = False
    jobs: int = 0
    only: str = "*"


def validate(wish: Wish, say: Callable[[str], None]) -> Matrix:
    """Mark the solution, the starter and the mutants; `say` is told how far it is.

    Raises UsageError (AssignmentError for a fault in the files), SurroundingsError.
    """
    begin = time.monotonic()
    assignment = wish.order.assignment
    solution = wish.keys / "solution"
    if not (solution / assignment.package).is_dir():
        raise UsageError(
            f"there is no solution of {assignment.id} in {solution}",
            remedy=f"Put the package into {solution / assignment.package}.",
        )
    original = read_tree(solution / assignment.package)
    mutants = collect(wish, original)
    chosen = [m for m in mutants if fnmatch.fnmatchcase(m.name, wish.only)]
    if not chosen:
        raise UsageError(f"no mutant has a name like '{wish.only}'")
    marked, waiting = _by_files(chosen, original, wish.order)
    ends: list[Marked | None] = [None, None]
    if wish.static:
        waiting = []
    else:
        jobs = wish.jobs or (os.cpu_count() or 1) + 1
        say(
            f"{len(marked)} mutants decided by their files, {len(waiting)} to be run, {jobs} at once"
        )
        ends = [
            mark_path(name, replace(wish.order, path=path)) if path else None
            for name, path in (("solution", solution), ("starter", wish.starter))
        ]
        marked |= _by_running(waiting, wish.order, jobs, say)
    rows = [Row(m, marked[m.name]) for m in chosen if m.name in marked]
    return Matrix(
        assignment=assignment.id,
        checks=tuple(c for c in CHECKS if c in {use.id for use in assignment.checks}),
        max_score=assignment.max_score,
        rows=ordered(rows, [m.name for m in chosen]),
        left_out=len(mutants) - len(rows),
        solution=ends[0],
        starter=ends[1],
        seconds=time.monotonic() - begin,
    )


def collect(wish: Wish, original: Tree) -> list[Mutant]:
    """Return the named mutants and the automatic ones that none of them is already."""
    assignment = wish.order.assignment
    ids = [use.id for use in assignment.checks]
    path = wish.keys / "mutants.yaml"
    written = Catalogued()
    if path.is_file():
        written = read_mutants(path, checks=ids, mistakes=CATALOGUE)
    found = list(written.mutants)
    seen = {digest(original)} | {digest(mutate(mutant, original)) for mutant in found}
    used = set()
    for mutant in generate(original, assignment):
        key = digest(mutate(mutant, original))
        if key not in seen:
            seen.add(key)
            used.add(mutant.name)
            found.append(replace(mutant, equivalent=written.equivalent.get(mutant.name, "")))
    for name in written.equivalent:
        if name not in used:
            raise AssignmentError(f"{path}: 'equivalent' explains '{name}', which is no mutant")
    return found


def starter_of(assignment: str) -> Path | None:
    """Return what students of an assignment (an id, or the path of its file) begin with."""
    file, _ = assignment_files(assignment)
    starter = file.parent / "starter"
    return starter if starter.is_dir() else None


def write_json(matrix: Matrix, path: Path) -> None:
    """Write the matrix to a file. Raises UsageError where that cannot be."""
    try:
        path.write_text(as_json(matrix), encoding="utf-8")
    except OSError as error:
        raise UsageError(f"cannot write {path}: {error.strerror}") from None


def _by_files(
    mutants: Sequence[Mutant], original: Tree, order: Order
) -> tuple[dict[str, Marked], list[tuple[str, Tree]]]:
    """Mark those whose files decide them; return what was found, and what has to be run."""
    marked = {}
    waiting = []
    for mutant in mutants:
        tree = mutate(mutant, original)
        found = mark_files(mutant.name, tree, order) if mutant.may_be_static else None
        if found and any(mutant.is_hit_by(check) for check in found.failed):
            marked[mutant.name] = found
        else:
            waiting.append((mutant.name, tree))
    return marked, waiting


def _by_running(
    waiting: Sequence[tuple[str, Tree]], order: Order, jobs: int, say: Callable[[str], None]
) -> dict[str, Marked]:
    marked: dict[str, Marked] = {}
    begin = told = time.monotonic()
    for found in mark_all(waiting, order, jobs=jobs):
        marked[found.name] = found
        now = time.monotonic()
        if now - told >= TELLS_EACH:
            told = now
            left = (now - begin) / len(marked) * (len(waiting) - len(marked))
            say(f"{len(marked)} of {len(waiting)} run, about {left:.0f} s left")
    return marked
