"""The result of intake: one package with its files, or the reason why there is none."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Literal

from grader.package.intake.links import follow
from grader.report.model import Modes, Origin


@dataclass(frozen=True)
class SourceFile:
    """One file of the package: `path` relative to the package root, POSIX style.

    `mode` holds the permission bits (e.g. 0o755), `data` the bytes, `target` where a link leads;
    only links that stay inside the package are kept. A file that cannot be read, or exceeds the
    size limit, is `unreadable`: it has no data, and `reason` gives the cause.
    """

    path: str
    kind: Literal["file", "folder", "link"]
    mode: int = 0o644
    data: bytes = b""
    target: str = ""
    unreadable: bool = False
    reason: str = ""


@dataclass(frozen=True)
class Candidate:
    """A folder that looks like a package: its path relative to the submission, and its name."""

    path: str
    name: str


@dataclass(frozen=True)
class Package:
    """Another package of a submission: its name, its folder relative to the path, its files."""

    name: str
    root: str
    files: tuple[SourceFile, ...]

    def text(self, path: str) -> str | None:
        """Return a file's text; None if there is no such file."""
        data = next((f.data for f in self.files if (f.path, f.kind) == (path, "file")), None)
        return None if data is None else data.decode("utf-8", errors="replace")


@dataclass(frozen=True)
class Submission:
    """One submission.

    `root` is the package's folder relative to `path` (`.` if it is `path` itself); None if
    nothing can be graded: then `problem` gives the reason in a sentence, `problem_fix` the fix,
    and `problem_mistake` the mistake's id in the catalogue. `notes` list what was left out;
    `hints` what the student should change although it costs no points; `node_files` all files
    with the node's name, relative to `path`; `links_out` the package's links, relative to it,
    that lead out of it and were left out; `copies` the folders of other packages with its name,
    relative to `path`, which colcon would find too; `newer_copy` a copy of the node's file in build
    or install, relative to `path`, that is newer or holds the content of an empty file; `packages`
    the other packages that the assignment asks for, as far as they are there.
    """

    path: Path
    name: str
    origin: Origin
    modes: Modes
    sha256: str
    root: str | None
    files: tuple[SourceFile, ...]
    candidates: tuple[Candidate, ...] = ()
    notes: tuple[str, ...] = ()
    problem: str = ""
    problem_mistake: str = ""
    problem_fix: str = ""
    hints: tuple[str, ...] = ()
    node_files: tuple[str, ...] = ()
    links_out: tuple[str, ...] = ()
    copies: tuple[str, ...] = ()
    newer_copy: str = ""
    packages: tuple[Package, ...] = ()

    def all_files(self) -> Iterator[tuple[str, SourceFile]]:
        """Yield the files with their paths; those of other packages begin with `../name`."""
        yield from ((file.path, file) for file in self.files)
        for one in self.packages:
            yield from ((f"../{one.name}/{file.path}", file) for file in one.files)

    def package(self, name: str) -> Package | None:
        """Return another package of the submission; None if it is not there."""
        return next((one for one in self.packages if one.name == name), None)

    @cached_property
    def _by_path(self) -> dict[str, SourceFile]:
        return {file.path: file for file in self.files}

    @cached_property
    def _links(self) -> dict[str, str]:
        return {file.path: file.target for file in self.files if file.kind == "link"}

    def file(self, path: str) -> SourceFile | None:
        """Return the package's file or folder (links inside the package resolved), or None."""
        place = follow(path, self._links).place
        return None if place is None else self._by_path.get(place)
