"""`grader validate`: check that an assignment marks what it claims to mark."""

from __future__ import annotations

import fnmatch
import time
from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from pathlib import Path

from grader.base.errors import AssignmentError, UsageError
from grader.base.nearest import nearest
from grader.course.assignment import Assignment
from grader.course.shorthands import SHORTHANDS
from grader.mistakes.catalogue import CATALOGUE
from grader.package.edit.tree import Nest, Tree, digest, read_tree
from grader.package.submission import Submission
from grader.validate.automatic import generate
from grader.validate.kept import keep
from grader.validate.marking import Marked, mark_all, mark_files, submit, submit_path
from grader.validate.matrix import Matrix, MutantResult, as_json
from grader.validate.mutant import Mutant
from grader.validate.named import MUTANTS, MutantsFile, read_mutants
from grader.verdict.order import Order
from grader.verdict.own_checks import checks_of

ALL = "*"
SHOW_ALL = "all"
PROGRESS_EVERY = 10.0  # seconds between two lines of progress
SOLUTION, STARTER = "the solution", "the starter"


@dataclass(frozen=True, kw_only=True)
class ValidationOptions:
    """What to validate: `order` defines how to mark (its path is ignored).

    `keys` holds the solution and mutants.yaml, `starter` what students begin with (None: nothing).
    `static`: only mutants that their files decide; `only`: only names that match the pattern;
    `named`: only those of mutants.yaml; `workers`: how many are marked at once (0: as a class is
    marked); `keep`: a folder to which the mutants are written as packages. `show`: the one mutant
    whose report is wanted, or `SHOW_ALL`; then each is built and run, and nothing else is marked.
    """

    order: Order
    keys: Path
    starter: Path | None = None
    static: bool = False
    workers: int = 0
    only: str = ALL
    named: bool = False
    keep: Path | None = None
    show: str = ""


def validate(options: ValidationOptions, notify: Callable[[str], None]) -> Matrix:
    """Mark the solution, the starter and the mutants; `notify` receives lines of progress.

    Raises UsageError (AssignmentError for a fault in the files), SurroundingsError.
    """
    begin = time.monotonic()
    assignment = options.order.assignment
    original = solution_of(options.keys, assignment)
    mutants = collect(options, original)
    chosen = _chosen(mutants, options)
    if options.keep is not None:
        keep(chosen, original, assignment, options.keep)
        notify(f"{len(chosen)} mutants written to {options.keep}")
    if options.show:
        waiting = {m.name: submit(m.of(original), options.order) for m in chosen}
        marked = _by_running(waiting, options, notify)
    else:
        marked, waiting = _by_files(chosen, original, options.order)
        if not options.static:
            notify(f"{len(marked)} mutants decided by their files, {len(waiting)} to be run")
            marked |= _by_running({**_ends(options), **waiting}, options, notify)
    rows = tuple(MutantResult(m, marked[m.name]) for m in chosen if m.name in marked)
    return Matrix(
        assignment=assignment.id,
        checks=tuple(use.id for use in assignment.checks),
        max_score=assignment.max_score,
        rows=rows,
        left_out=len(mutants) - len(rows),
        solution=marked.get(SOLUTION),
        starter=marked.get(STARTER),
        seconds=time.monotonic() - begin,
    )


def _chosen(mutants: list[Mutant], options: ValidationOptions) -> list[Mutant]:
    """Return the mutants that the options choose. Raises UsageError if there is none."""
    if options.show not in ("", SHOW_ALL):
        chosen = [m for m in mutants if m.name == options.show]
        if not chosen:
            close = nearest(options.show, [m.name for m in mutants])
            raise UsageError(
                f"there is no mutant '{options.show}'",
                remedy=f"Did you mean '{close}'?"
                if close
                else "`validate --static` lists the names of the mutants.",
            )
        return chosen
    wanted = [m for m in mutants if m.mistake or m.named] if options.named else mutants
    chosen = [m for m in wanted if fnmatch.fnmatchcase(m.name, options.only)]
    if not chosen and options.only != ALL:
        raise UsageError(f"no mutant's name matches '{options.only}'")
    return chosen


def collect(options: ValidationOptions, original: Tree) -> list[Mutant]:
    """Return the named mutants, and the automatic ones that differ from all of them."""
    assignment = options.order.assignment
    automatic = tuple(
        _of_scenarios(mutant, assignment) for mutant in generate(original, assignment)
    )
    ids = [use.id for use in assignment.checks]
    path = options.keys / MUTANTS
    written = MutantsFile()
    if path.is_file():
        beside = bool(assignment.others)
        distro = options.order.distro
        written = read_mutants(path, checks=ids, kinds=CATALOGUE, distro=distro, beside=beside)
    seen = {digest(original), *_digests(written.mutants, original)}
    made = []
    for mutant in automatic:
        key = digest(mutant.of(original))
        if key not in seen:
            seen.add(key)
            made.append(mutant)
    whys = written.explained(mutant.name for mutant in made)
    explained = [replace(mutant, equivalent=whys.get(mutant.name, "")) for mutant in made]
    return [*written.mutants, *explained]


def _digests(mutants: Iterable[Mutant], original: Tree) -> list[str]:
    """Return the digest of each mutant; one AssignmentError for all whose edits do not fit."""
    digests, faults = [], []
    for mutant in mutants:
        try:
            digests.append(digest(mutant.of(original)))
        except AssignmentError as error:
            faults.append(str(error))
    if faults:
        raise AssignmentError("\n".join(faults))
    return digests


def _of_scenarios(mutant: Mutant, assignment: Assignment) -> Mutant:
    """Return a mutant that a check of a scenario may catch too, if one of a run is expected to."""
    known = checks_of(assignment)
    own = tuple(
        use.id
        for use in assignment.checks
        if known[use.kind].parameters is not None and use.id not in SHORTHANDS
    )
    if not own or not any(family.startswith("run.") for family in mutant.families):
        return mutant
    return replace(mutant, families=(*mutant.families, "run.stays", *own))


def starter_of(file: Path) -> Path | None:
    """Return what students of an assignment (its file) begin with."""
    starter = file.parent / "starter"
    return starter if starter.is_dir() else None


def write_json(matrix: Matrix, path: Path) -> None:
    """Write the matrix to a file. Raises UsageError if it cannot be written."""
    try:
        path.write_text(as_json(matrix), encoding="utf-8")
    except OSError as error:
        raise UsageError(f"cannot write {path}: {error.strerror}") from None


def solution_of(keys: Path, assignment: Assignment) -> Tree:
    """Return the solution's package; the files of other packages begin with `../`.

    Raises UsageError if a package is missing.
    """
    tree = _package(keys, assignment.package, assignment)
    for name in assignment.others:
        tree = {**tree, **Nest(f"../{name}").apply(_package(keys, name, assignment))}
    return tree


def _package(keys: Path, name: str, assignment: Assignment) -> Tree:
    folder = keys / "solution" / name
    if not folder.is_dir():
        raise UsageError(
            f"there is no solution of {assignment.id}: no folder {folder}",
            remedy="Put the package there, or name the folder above 'solution' with --keys.",
        )
    return read_tree(folder)


def _ends(options: ValidationOptions) -> dict[str, Submission]:
    """Return the solution, which must get full marks, and the starter, which must not."""
    ends = {SOLUTION: submit_path(options.keys / "solution", options.order)}
    if options.starter is not None:
        ends[STARTER] = submit_path(options.starter, options.order)
    return ends


def _by_files(
    mutants: list[Mutant], original: Tree, order: Order
) -> tuple[dict[str, Marked], dict[str, Submission]]:
    """Mark mutants by their files; return the decided results and the submissions left to run."""
    marked = {}
    waiting = {}
    for mutant in mutants:
        submission = submit(mutant.of(original), order)
        found = mark_files(submission, order) if mutant.may_be_static(order.assignment) else None
        if found and any(mutant.is_hit_by(check) for check in found.failed):
            marked[mutant.name] = found
        else:
            waiting[mutant.name] = submission
    return marked, waiting


def _by_running(
    waiting: dict[str, Submission], options: ValidationOptions, notify: Callable[[str], None]
) -> dict[str, Marked]:
    """Mark the submissions that need a build and a run, and report progress."""
    marked: dict[str, Marked] = {}
    begin = reported = time.monotonic()
    for name, found in mark_all(waiting.items(), options.order, workers=options.workers):
        marked[name] = found
        now = time.monotonic()
        if now - reported >= PROGRESS_EVERY:
            reported = now
            left = (now - begin) / len(marked) * (len(waiting) - len(marked))
            notify(f"{len(marked)} of {len(waiting)} run, about {left:.0f} s left")
    return marked
