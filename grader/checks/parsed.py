"""The package's own files for the static checks: there or not, readable or not, parsed or not."""

from __future__ import annotations

import difflib
from collections.abc import Iterable
from typing import TYPE_CHECKING

from grader.intake.notes import shown
from grader.source.python import PythonFault
from grader.source.setup_py import SetupPy
from grader.source.setup_py import read_setup_py

if TYPE_CHECKING:
    from grader.evidence import Evidence
    from grader.intake.model import SourceFile


def file_of(evidence: Evidence, path: str) -> SourceFile | None:
    """Return a file of the package (no folder), or None."""
    found = evidence.submission.file(path)
    return found if found is not None and found.kind == "file" else None


def setup_py_of(evidence: Evidence) -> SetupPy | None:
    """Return what setup.py says; None if it is missing or Python cannot read it."""
    file = file_of(evidence, "setup.py")
    if file is None or file.unreadable:
        return None
    try:
        return read_setup_py(file.data)
    except PythonFault:
        return None


def node_path(evidence: Evidence) -> str:
    """Return the path in the package that the assignment asks the node's file to have."""
    return f"{evidence.assignment.package}/{evidence.assignment.node_file}"


def names_in(evidence: Evidence, folder: str) -> list[str]:
    """Return the names of the files directly in a folder of the package."""
    start = f"{folder}/" if folder else ""
    rest = [
        file.path[len(start) :]
        for file in evidence.submission.files
        if file.path.startswith(start) and file.kind != "folder"
    ]
    return [name for name in rest if "/" not in name]


def nearest(word: str, words: Iterable[str], cutoff: float = 0.6) -> str:
    """Return the word that comes nearest, capitals aside; empty if none does."""
    folded = {other.lower(): other for other in words if other != word}
    close = difflib.get_close_matches(word.lower(), folded, n=1, cutoff=cutoff)
    return folded[close[0]] if close else ""


def meant(word: str) -> str:
    """Return ` (did you mean 'word'?)`, or nothing for an empty word."""
    return f" (did you mean '{shown(word)}'?)" if word else ""
