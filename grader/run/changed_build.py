"""The build of a package in which only modules have changed since it was built.

colcon links a module into the workspace, or setuptools copies it as it is: so the new module is put where the
old one was, in a copy of the built workspace. That takes a fraction of a second; a build takes seconds, and a
package of interfaces half a minute. What is not certain to be the same is built again.
"""

from __future__ import annotations

import re
import time
from dataclasses import dataclass, replace

from grader.package.submission import SourceFile, Submission
from grader.run.workspace import Build, Installed, put, restore
from grader.sandbox.base import Sandbox

BUILT_FROM = ("setup.py", "setup.cfg", "pyproject.toml", "conftest.py")
READS = re.compile(
    rb"\b(?:open|exec|eval|compile|__import__|import_module|import_string|run_path)\s*\("
    rb"|read_text|read_bytes|attr\s*:|file\s*:"
)
"""What a setup.py or setup.cfg may read modules with: then they decide what is built."""
MODULE = "/site-packages/"


@dataclass(frozen=True)
class BuiltPackage:
    """A package that was built: the result, its saved workspace, and what its sandbox knows of it."""

    submission: Submission
    build: Build
    saved: bytes
    overlay: str
    workspace: str
    interfaces: bytes = b""


def with_changes(
    built: BuiltPackage, submission: Submission, sandbox: Sandbox, *, package: str
) -> Build | None:
    """Make the workspace of a changed package from the built one; None if colcon has to build it."""
    begin = time.monotonic()
    changed = changed_modules(built, submission)
    if not changed or built.workspace != sandbox.workspace:
        return None
    places: dict[str, SourceFile] = {}
    files = dict(built.build.files)
    for old, new in changed:
        copies = _copies(built, old, package)
        if copies is None:
            return None
        places |= dict.fromkeys([f"src/{package}/{new.path}", *copies], new)
        files |= {copy: replace(files[copy], size=len(new.data)) for copy in copies}
    if not restore(sandbox, built.saved) or not put(sandbox, places):
        return None
    sandbox.overlay = built.overlay
    return replace(built.build, files=files, seconds=time.monotonic() - begin)


def changed_modules(
    built: BuiltPackage, submission: Submission
) -> list[tuple[SourceFile, SourceFile]]:
    """Return the modules that differ, as they were and are; none if anything else differs."""
    old = {file.path: file for file in built.submission.files}
    new = {file.path: file for file in submission.files}
    same = old.keys() == new.keys() and built.submission.packages == submission.packages
    if not same or not _is_as_declared(built):
        return []
    changed = [(old[path], file) for path, file in new.items() if file != old[path]]
    only_modules = all(_is_other_module(*pair) for pair in changed)
    return changed if only_modules and not _decided_by_setup(changed, new) else []


def _is_as_declared(built: BuiltPackage) -> bool:
    """Whether a build succeeded, was kept, and changed no module."""
    made = built.build
    return bool(built.saved) and made.status == 0 and not made.altered and not made.added


def _is_other_module(before: SourceFile, file: SourceFile) -> bool:
    """Whether a file is a module in a package's folder, of which only the text has changed."""
    is_module = file.kind == "file" and file.path.endswith(".py") and "/" in file.path
    return is_module and file == replace(before, data=file.data)


def _decided_by_setup(
    changed: list[tuple[SourceFile, SourceFile]], files: dict[str, SourceFile]
) -> bool:
    """Whether setup.py, or a file beside it, may read the modules."""
    tops = {re.escape(file.path.partition("/")[0].encode()) for _, file in changed}
    imports = [re.compile(rb"^\s*(?:from|import)\s+%b\b" % top, re.MULTILINE) for top in tops]
    texts = [files[path].data for path in BUILT_FROM if path in files]
    return any(form.search(text) for form in (READS, *imports) for text in texts)


def _copies(built: BuiltPackage, file: SourceFile, package: str) -> list[str] | None:
    """Return where a module was copied to; none if it was linked, None if that is not known."""
    name, top = file.path.rpartition("/")[2], file.path.partition("/")[0]
    found = built.build.files
    copies = [path for path in found if path.endswith(f"{MODULE}{file.path}")]
    others = [path for path in found if path.endswith(f"/{name}") and path not in copies]
    if any(found[path].kind == "f" for path in others):
        return None
    if all(_is_copy(found[path], file) for path in copies) and copies:
        return copies
    source = f"{built.workspace}/src/{package}"
    linked = {f"{source}/{top}", f"{source}/{file.path}"}
    return [] if any(one.target in linked for one in found.values()) and not copies else None


def _is_copy(installed: Installed, file: SourceFile) -> bool:
    return installed.kind == "f" and installed.size == len(file.data)
