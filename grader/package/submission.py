"""Intake: find the package in a submission without running or trusting any of it."""

from __future__ import annotations

import hashlib
from collections.abc import Iterable, Iterator
from dataclasses import replace
from pathlib import Path

from grader.package.intake.archive_kind import without_ending
from grader.package.intake.archive_limits import ArchiveLimits, Spent
from grader.package.intake.archive_nested import look_inside
from grader.package.intake.archive_problems import ArchiveError
from grader.package.intake.around import folders_around
from grader.package.intake.built import edited_copy, newer_copy
from grader.package.intake.built_inside import built_inside
from grader.package.intake.choose import Choice, choose, find_candidates
from grader.package.intake.contents import TooLargeError, read_package
from grader.package.intake.given import cannot_be_read, digest_of_file, open_place, resolved
from grader.package.intake.model import Candidate, Package, SourceFile, Submission
from grader.package.intake.naming import sanitise, submission_name
from grader.package.intake.problems import Problem, too_large
from grader.package.intake.recorded import with_modes
from grader.package.intake.tree import Tree, ancestors, join, parent
from grader.report.model import Modes, Origin

__all__ = ["Candidate", "Package", "SourceFile", "Submission", "take_in"]

MOST_NODE_FILES = 20


def take_in(
    path: Path,
    *,
    package: str,
    node_file: str,
    others: Iterable[str] = (),
    name: str | None = None,
    modes_kept: bool = True,
    at_work: bool = False,
) -> Submission:
    """Take in a folder or an archive: the package, a workspace, or a parent of the package.

    `others` are the names of other packages to take in. `modes_kept` is False if the exec bits of a
    folder's files were lost on the way (e.g. in an upload file by file). `at_work` means that the
    path is the student's own workspace and was not handed in. Raises UsageError for a path that is
    neither, does not exist or cannot be read. Any other problem is the student's and is recorded
    in the Submission.
    """
    own = resolved(path)
    name = name or submission_name(_without_ending(own), package)
    spent = Spent(ArchiveLimits())
    try:
        place = open_place(own, spent, modes_kept=modes_kept)
        tree, unopened = look_inside(place, spent)
    except ArchiveError as error:
        return _refused(own, name, error.problem)
    except OSError as error:
        raise cannot_be_read(path, error.strerror or str(error)) from None
    candidates = find_candidates(tree)
    choice = choose(tree, candidates, package=package, node_file=node_file)
    if not candidates and unopened is not None:
        choice = Choice(None, problem=unopened)
    files: tuple[SourceFile, ...] = ()
    if choice.chosen is not None:
        try:
            files = read_package(tree, choice.chosen.path)
        except TooLargeError as error:
            choice = Choice(None, problem=too_large(error.reason, choice.chosen.path))
    root = choice.chosen.path if choice.chosen else None
    packages: tuple[Package, ...] = ()
    if root is not None:
        try:
            packages = tuple(_others(tree, root, candidates, others))
        except TooLargeError as error:
            choice = Choice(None, problem=too_large(error.reason, root))
            root, files = None, ()
    copy = newer_copy(tree, root, package=package, node_file=node_file) if root else ""
    inside = built_inside(tree.made, root) if root else None
    advice = [edited_copy(copy, f"{package}/{node_file}")] if copy else []
    files, modes = with_modes(tree, root, files)
    problem, origin = choice.problem, _origin(tree, root or ".")
    around = None
    above = {*ancestors(root)} - {root} if root is not None else set()
    nested = any(one.path in above for one in candidates)
    if root is not None and not (at_work or nested or origin == "git"):
        given = own.name if own.is_dir() else ""
        roots = [root, *(one.root for one in packages)]
        around = folders_around(roots, tree.made, given=given, package=package)
    return Submission(
        path=own,
        name=sanitise(name),
        origin=origin,
        modes=modes,
        sha256=_digest(
            files if root is not None else _outline(tree), modes, choice.copies, packages
        ),
        root=root,
        files=files,
        candidates=tuple(candidates),
        notes=tuple(tree.left_out.lines()),
        problem=problem.text if problem else "",
        problem_mistake=problem.mistake if problem else "",
        problem_fix=problem.fix if problem else "",
        hints=(*choice.hints, *advice, *(text for text in (inside, around) if text)),
        node_files=_named(tree, node_file),
        links_out=tuple(tree.links_out),
        copies=choice.copies,
        newer_copy=copy,
        packages=packages,
    )


def _others(
    tree: Tree, root: str, candidates: Iterable[Candidate], names: Iterable[str]
) -> Iterator[Package]:
    """Yield the other packages with these names, the outermost of each; raises TooLargeError.

    A folder of that name beside the package at `root` is one too, if it has no package.xml.
    """
    for name in names:
        beside = join(parent(root), name)
        paths = [one.path for one in candidates if one.name == name]
        unnamed = beside not in {one.path for one in candidates}
        if not paths and unnamed and any(path.startswith(f"{beside}/") for path in tree.entries):
            paths = [beside]
        if paths:
            yield Package(name, paths[0], read_package(tree, paths[0]))


def _without_ending(path: Path) -> Path:
    return path if path.is_dir() else path.with_name(without_ending(path.name))


def _origin(tree: Tree, root: str) -> Origin:
    origin = tree.place.origin(root)
    in_git = any(place in tree.git for place in ancestors(root))
    return "git" if origin == "directory" and in_git else origin


def _refused(path: Path, name: str, problem: Problem) -> Submission:
    """Return the submission of a refused archive, identified by its bytes."""
    return Submission(
        path=path,
        name=sanitise(name),
        origin="zip" if path.suffix.lower() == ".zip" else "tar",
        modes="unknown",
        sha256=digest_of_file(path, most=ArchiveLimits().packed),
        root=None,
        files=(),
        problem=problem.text,
        problem_mistake=problem.mistake,
        problem_fix=problem.fix,
    )


def _named(tree: Tree, name: str) -> tuple[str, ...]:
    found = sorted(p for p, e in tree.entries.items() if p.rpartition("/")[2] == name)
    return tuple(path for path in found if tree.entries[path].kind == "file")[:MOST_NODE_FILES]


def _outline(tree: Tree) -> Iterable[SourceFile]:
    """Yield the entries without contents: enough to tell submissions without a package apart."""
    for path, entry in sorted(tree.entries.items()):
        yield SourceFile(path, entry.kind, entry.mode, str(entry.size).encode(), entry.target)


def _digest(
    files: Iterable[SourceFile],
    modes: Modes,
    copies: Iterable[str] = (),
    packages: Iterable[Package] = (),
) -> str:
    """Return the hash of a submission: paths, kinds, exec bits (if known) and contents.

    Copies of the package beside it are part of it, because they cost points.
    """
    digest = hashlib.sha256()
    named = [replace(f, path=f"{one.name}/{f.path}") for one in packages for f in one.files]
    for file in (*files, *named):
        bits = "x" if file.kind == "file" and file.mode & 0o100 else "-"
        bits = bits if modes == "recorded" else "?"
        for part in (file.path, file.kind, bits, file.target, file.reason):
            digest.update(f"{len(part.encode())}:{part}".encode())
        digest.update(f"{len(file.data)}:".encode() + file.data)
    for path in copies:
        digest.update(f"{len(path.encode())}:{path}copy".encode())
    return digest.hexdigest()
