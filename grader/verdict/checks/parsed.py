"""Access to the package's files for the static checks."""

from __future__ import annotations

from typing import TYPE_CHECKING

from grader.base.i18n.message import Message
from grader.base.shown import shown
from grader.package.edit.text import read_source
from grader.package.source.entry_points import EntryPoints, from_setup_cfg, from_setup_py
from grader.package.source.python import PythonFault
from grader.package.source.setup_cfg import SetupCfgFault, read_setup_cfg
from grader.package.source.setup_py import SetupPy, read_setup_py
from grader.package.source.values import Table

if TYPE_CHECKING:
    from grader.package.intake.model import SourceFile
    from grader.report.model import Where
    from grader.verdict.evidence import Evidence

CONSOLE = "console_scripts"


def file_of(evidence: Evidence, path: str) -> SourceFile | None:
    """Return a file of the package; None if it does not exist or is a folder.

    A file of a package beside it has that package's name before its path.
    """
    found = evidence.submission.file(path)
    if found is None:
        name, _, rest = path.partition("/")
        beside = (one for one in evidence.submission.packages if one.name == name)
        if name != evidence.assignment.package:
            files = (file for package in beside for file in package.files)
            found = next((file for file in files if file.path == rest), None)
    return found if found is not None and found.kind == "file" else None


def data_of(evidence: Evidence, path: str) -> bytes | None:
    """Return the bytes of a file of the package; None if there is none that can be read."""
    file = file_of(evidence, path)
    return file.data if file is not None and not file.unreadable else None


def line_at(evidence: Evidence, where: Where) -> str:
    """Return a line of the submission without its indentation; "" if there is none."""
    text = read_source(data_of(evidence, where.file))
    return text.line(where.line or 0).strip() if text is not None else ""


def setup_py_of(evidence: Evidence) -> SetupPy | None:
    """Return the parsed setup.py; None if it is missing or Python cannot read it."""
    found = data_of(evidence, "setup.py")
    if found is None:
        return None
    try:
        return read_setup_py(found)
    except PythonFault:
        return None


def entry_points_of(evidence: Evidence, setup: SetupPy) -> EntryPoints | None:
    """Return the effective entry points: setup.py's, or setup.cfg's if setup.py has none.

    setuptools uses setup.cfg only for arguments that setup() was not given. None if they are
    unknown, because pyproject.toml may have them.
    """
    value = setup.argument("entry_points")
    empty = isinstance(value, Table) and not value.pairs
    if value is not None and not empty:
        return from_setup_py(setup)
    cfg = file_of(evidence, "setup.cfg")
    if cfg is not None:
        try:
            found = from_setup_cfg(read_setup_cfg(cfg.data))
        except SetupCfgFault:
            found = EntryPoints()
        if found.groups:
            return found
    project = file_of(evidence, "pyproject.toml")
    if project is not None and b"[project" in project.data:
        return None
    return from_setup_py(setup)


def in_inner_folder(evidence: Evidence, name: str) -> str:
    """Return the path of a file of the package's folder that is in the inner folder; "" if not.

    An inner folder with its own package.xml and setup.py is a package, and the file belongs to it.
    """
    inner = evidence.assignment.folder
    parts = ("package.xml", "setup.py")
    package = all(file_of(evidence, f"{inner}/{part}") is not None for part in parts)
    path = f"{inner}/{name}"
    return "" if package or data_of(evidence, path) is None else path


def has_subpackages(evidence: Evidence) -> bool:
    """Whether the inner folder contains Python packages."""
    inner = f"{evidence.assignment.folder}/"
    return any(
        file.path.startswith(inner) and file.path.count("/") > 1
        for file in evidence.submission.files
        if file.path.endswith("/__init__.py")
    )


def node_path(evidence: Evidence) -> str:
    """Return the path of the node's file in the package, as the assignment requires it."""
    return f"{evidence.assignment.folder}/{evidence.assignment.node_file}"


def paths_in(evidence: Evidence) -> list[str]:
    """Return the paths of all files of the package."""
    return [file.path for file in evidence.submission.files if file.kind != "folder"]


def names_in(evidence: Evidence, folder: str) -> list[str]:
    """Return the names of the files directly in a folder of the package."""
    start = f"{folder}/" if folder else ""
    rest = [
        file.path[len(start) :]
        for file in evidence.submission.files
        if file.path.startswith(start) and file.kind != "folder"
    ]
    return [name for name in rest if "/" not in name]


def printable_reason(text: str) -> str:
    """Return why a file could not be read, with the student's and other foreign text escaped."""
    if not isinstance(text, Message):
        return shown(text)
    values = {name: shown(v) if isinstance(v, str) else v for name, v in text.params.items()}
    return Message(text.template, values)
