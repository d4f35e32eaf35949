"""Edits of a package, which is an immutable mapping from path to file."""

from __future__ import annotations

import hashlib
import posixpath
from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path

from grader.base.errors import AssignmentError
from grader.package.edit.files import EXECUTABLE, PLAIN
from grader.package.intake.model import SourceFile

SKIPPED = ("__pycache__", ".pyc")
LINK = 0o777


Tree = Mapping[str, SourceFile]
"""Files and links by their path; folders have no entries of their own."""


class EditError(Exception):
    """An edit does not fit the package it is applied to."""


@dataclass(frozen=True)
class Replace:
    """Replace a text that occurs exactly once in the file."""

    path: str
    old: str
    new: str

    def apply(self, tree: Tree) -> Tree:
        """Return the tree with the text replaced."""
        file = _there(tree, self.path)
        if (found := file.data.count(self.old.encode())) != 1:
            raise EditError(f"{self.path} contains the text {found} times, not once: {self.old!r}")
        data = file.data.replace(self.old.encode(), self.new.encode())
        return {**tree, self.path: replace(file, data=data)}


@dataclass(frozen=True)
class Write:
    """Write a file (text as UTF-8); without `mode` an existing file keeps its own."""

    path: str
    data: bytes | str
    mode: int | None = None

    def apply(self, tree: Tree) -> Tree:
        """Return the tree with the file in it."""
        old = tree.get(self.path)
        mode = self.mode if self.mode is not None else old.mode if old is not None else PLAIN
        data = self.data.encode() if isinstance(self.data, str) else self.data
        return {**tree, self.path: SourceFile(self.path, "file", mode, data)}


@dataclass(frozen=True)
class Delete:
    """Delete a file, or a folder with its content."""

    path: str

    def apply(self, tree: Tree) -> Tree:
        """Return the tree without it."""
        gone = _below(tree, self.path)
        return {path: file for path, file in tree.items() if path not in gone}


@dataclass(frozen=True)
class Copy:
    """Copy a file or folder."""

    path: str
    to: str

    def apply(self, tree: Tree) -> Tree:
        """Return the tree with the copy."""
        here = _below(tree, self.path)
        if any(path == self.to or path.startswith(f"{self.to}/") for path in tree):
            raise EditError(f"{self.to} exists already")
        copies = (replace(tree[path], path=self.to + path[len(self.path) :]) for path in here)
        return {**tree, **{file.path: file for file in copies}}


@dataclass(frozen=True)
class Move:
    """Rename or move a file or folder."""

    path: str
    to: str

    def apply(self, tree: Tree) -> Tree:
        """Return the tree with it at its new path."""
        copied = Copy(self.path, self.to).apply(tree)
        gone = _below(tree, self.path)
        return {path: file for path, file in copied.items() if path not in gone}


@dataclass(frozen=True)
class Chmod:
    """Set the permission bits of a file."""

    path: str
    mode: int

    def apply(self, tree: Tree) -> Tree:
        """Return the tree with the new mode."""
        return {**tree, self.path: replace(_there(tree, self.path), mode=self.mode)}


@dataclass(frozen=True)
class Crlf:
    """Give every line of the file Windows line endings."""

    path: str

    def apply(self, tree: Tree) -> Tree:
        """Return the tree with the new line endings."""
        file = _there(tree, self.path)
        data = file.data.replace(b"\r\n", b"\n").replace(b"\n", b"\r\n")
        return {**tree, self.path: replace(file, data=data)}


@dataclass(frozen=True)
class Link:
    """Make a symbolic link; an existing file is replaced."""

    path: str
    to: str

    def apply(self, tree: Tree) -> Tree:
        """Return the tree with the link."""
        return {**tree, self.path: SourceFile(self.path, "link", LINK, target=self.to)}


@dataclass(frozen=True)
class Nest:
    """Move the whole package into a new folder; paths of later edits start above it.

    Packages beside it (their paths begin with `..`) are beside the new folder then.
    """

    folder: str

    def apply(self, tree: Tree) -> Tree:
        """Return the tree, one folder deeper."""
        moved = {path: posixpath.normpath(f"{self.folder}/{path}") for path in tree}
        nested = (replace(file, path=moved[path]) for path, file in tree.items())
        return {file.path: file for file in nested}


Edit = Replace | Write | Delete | Copy | Move | Chmod | Crlf | Link | Nest


def apply_all(edits: tuple[Edit, ...], tree: Tree) -> Tree:
    """Apply edits in order. Raises EditError if one does not fit."""
    for edit in edits:
        tree = edit.apply(tree)
    return tree


def read_tree(folder: Path) -> Tree:
    """Read a package from disk.

    Scripts (files that begin with `#!`) are executable whatever their mode in the checkout: some
    file systems keep no permission bits.
    """
    tree = {}
    for path in sorted(folder.rglob("*")):
        if path.is_file() and not any(part.endswith(SKIPPED) for part in path.parts):
            data, name = path.read_bytes(), path.relative_to(folder).as_posix()
            mode = EXECUTABLE if data.startswith(b"#!") else PLAIN
            tree[name] = SourceFile(name, "file", mode, data)
    return tree


def text_of(tree: Tree, path: str) -> str:
    """Return a file's text. Raises AssignmentError if it is not UTF-8."""
    try:
        return tree[path].data.decode()
    except UnicodeDecodeError:
        raise AssignmentError(f"the solution's {path} is not UTF-8 text") from None


def write_tree(tree: Tree, folder: Path) -> None:
    """Write a package to a new folder; paths that begin with `..` are beside it.

    Raises FileExistsError if the folder exists.
    """
    folder.mkdir(parents=True)
    for name, file in tree.items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        if file.kind == "link":
            path.symlink_to(file.target)
        else:
            path.write_bytes(file.data)
            path.chmod(file.mode)


def digest(tree: Tree) -> str:
    """Return a hash of a package: equal hashes mean equal mutants."""
    parts = [
        f"{path}\0{file.mode:o}\0{file.target}\0{hashlib.sha256(file.data).hexdigest()}"
        for path, file in sorted(tree.items())
    ]
    return hashlib.sha256("\n".join(parts).encode()).hexdigest()


def _there(tree: Tree, path: str) -> SourceFile:
    if path not in tree:
        raise EditError(f"there is no file {path}")
    return tree[path]


def _below(tree: Tree, path: str) -> set[str]:
    found = {name for name in tree if name == path or name.startswith(f"{path}/")}
    if not found:
        raise EditError(f"there is no file or folder {path}")
    return found
