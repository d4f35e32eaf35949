"""Intake: find the package in what was handed in, without running or trusting any of it."""

from __future__ import annotations

import hashlib
import os
import stat
from collections.abc import Iterable
from dataclasses import replace
from pathlib import Path

from grader.errors import UsageError
from grader.intake.choose import Choice
from grader.intake.choose import choose
from grader.intake.choose import find_candidates
from grader.intake.contents import TooLargeError
from grader.intake.contents import read_package
from grader.intake.model import Candidate
from grader.intake.model import SourceFile
from grader.intake.model import Submission
from grader.intake.modes import git_ignores_modes
from grader.intake.modes import git_modes
from grader.intake.modes import keeps_modes
from grader.intake.naming import sanitise
from grader.intake.naming import submission_name
from grader.intake.notes import shown
from grader.intake.problems import too_large
from grader.intake.tree import Tree
from grader.intake.tree import ancestors
from grader.intake.tree import join
from grader.intake.tree import look
from grader.report.model import Modes

__all__ = ["Candidate", "SourceFile", "Submission", "take_in"]

MOST_NODE_FILES = 20


def take_in(path: Path, *, package: str, node_file: str, name: str | None = None) -> Submission:
    """Take in a directory that is the package, a workspace, or holds the package below.

    Raises UsageError for a path that is no directory, does not exist or cannot be read. All else
    that is wrong is the student's, and is said in the Submission.
    """
    folder = _directory(path)
    try:
        tree = look(folder)
    except OSError as error:
        raise UsageError(f"{shown(str(path))} cannot be read: {error.strerror}") from None
    candidates = find_candidates(tree)
    choice = choose(tree, candidates, package=package, node_file=node_file)
    files: tuple[SourceFile, ...] = ()
    if choice.chosen is not None:
        try:
            files = read_package(tree, choice.chosen.path)
        except TooLargeError as error:
            choice = Choice(None, problem=too_large(str(error), choice.chosen.path))
    root = choice.chosen.path if choice.chosen else None
    files, modes = _with_modes(tree, root, files)
    problem = choice.problem
    return Submission(
        path=folder,
        name=sanitise(name) if name else submission_name(folder, package),
        origin="git" if any(place in tree.git for place in ancestors(root or ".")) else "directory",
        modes=modes,
        sha256=_digest(files if root is not None else _outline(tree)),
        root=root,
        files=files,
        candidates=tuple(candidates),
        notes=tuple(tree.left_out.lines()),
        problem=problem.text if problem else "",
        problem_mistake=problem.mistake if problem else "",
        problem_fix=problem.fix if problem else "",
        hints=choice.hints,
        node_files=_named(tree, node_file),
        links_out=tuple(tree.links_out),
    )


def _directory(path: Path) -> Path:
    """Return the resolved path of a directory that exists."""
    name = shown(str(path))
    try:
        kind = os.stat(path).st_mode  # noqa: PTH116 - one look tells all
        if stat.S_ISDIR(kind):
            return path.resolve()
    except FileNotFoundError:
        raise UsageError(f"there is no folder {name}") from None
    except (OSError, ValueError) as error:
        reason = error.strerror if isinstance(error, OSError) else str(error)
        raise UsageError(f"{name} cannot be read: {reason}") from None
    if stat.S_ISREG(kind):
        raise UsageError(
            f"{name} is a file, not a folder",
            remedy="Give the folder that holds the package; archives come with class marking.",
        )
    raise UsageError(f"{name} is neither a folder nor a file")


def _with_modes(
    tree: Tree, root: str | None, files: tuple[SourceFile, ...]
) -> tuple[tuple[SourceFile, ...], Modes]:
    """Return the files with the exec bits that the student gave them, as far as that is known.

    A checkout whose git ignores them, or on a file system that has none, still has those of its
    index.
    """
    if root is None:
        return files, "recorded"
    above = [place for place in ancestors(root) if place in tree.git]
    repository = tree.root / above[0] if above else None
    ignored = repository is not None and git_ignores_modes(repository)
    if not ignored and keeps_modes(tree.root):
        return files, "recorded"
    known = git_modes(repository) if repository is not None else {}
    inside = (tree.root / root).relative_to(repository).as_posix() if repository else "."
    told = [known.get(join(inside, file.path)) for file in files]
    told = [None if file.kind != "file" else mode for file, mode in zip(files, told, strict=True)]
    python = [m for f, m in zip(files, told, strict=True) if f.path.endswith(".py")]
    if not python or any(mode is None for mode in python):
        return files, "unknown"
    given = [
        file if m is None else replace(file, mode=m) for file, m in zip(files, told, strict=True)
    ]
    return tuple(given), "recorded"


def _named(tree: Tree, name: str) -> tuple[str, ...]:
    found = sorted(p for p, e in tree.entries.items() if p.rpartition("/")[2] == name)
    return tuple(path for path in found if tree.entries[path].kind == "file")[:MOST_NODE_FILES]


def _outline(tree: Tree) -> Iterable[SourceFile]:
    """Return what is there, without contents: enough to tell two packageless hand-ins apart."""
    for path, entry in sorted(tree.entries.items()):
        yield SourceFile(path, entry.kind, entry.mode, str(entry.size).encode(), entry.target)


def _digest(files: Iterable[SourceFile]) -> str:
    """Return the hash of what was handed in: paths, kinds, exec bits and contents."""
    digest = hashlib.sha256()
    for file in files:
        bits = "x" if file.kind == "file" and file.mode & 0o100 else "-"
        for part in (file.path, file.kind, bits, file.target, file.reason):
            digest.update(f"{len(part.encode())}:{part}".encode())
        digest.update(f"{len(file.data)}:".encode() + file.data)
    return digest.hexdigest()
