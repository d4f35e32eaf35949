"""The file of parameters with which a run starts a node: is it installed, as a launch file needs it?"""

from __future__ import annotations

import posixpath
from typing import TYPE_CHECKING

from grader.base.i18n.message import say
from grader.base.nearest import nearest
from grader.base.shown import shown
from grader.package.source.values import Listing, Text
from grader.report.model import Where
from grader.run.workspace import PREFIX
from grader.verdict.checks.cmake import CMAKE
from grader.verdict.checks.parsed import file_of, paths_in, setup_py_of
from grader.verdict.outcome import Failed

if TYPE_CHECKING:
    from grader.verdict.evidence import Evidence

SETUP = "setup.py"


def given_file_must_be_installed(evidence: Evidence) -> None:
    """Raise Failed if the build does not install the file of parameters that a run gives to a node."""
    begin, package = evidence.begin, evidence.assignment.package
    if begin is None or not begin.params_file:
        return
    wanted = begin.shared_file(package)
    if evidence.build.installed(wanted):
        return
    path, inside = begin.params_file, f"share/{package}/"
    expected = say("the build installs {path}", path=wanted)
    name = posixpath.basename(path)
    if file_of(evidence, path) is None:
        same = [one for one in paths_in(evidence) if posixpath.basename(one) == name]
        close = next(iter(same), "") or nearest(path, paths_in(evidence)) or ""
        raise Failed(
            "files.missing",
            expected=expected,
            actual=say("there is no {path}, but {there}", path=path, there=shown(close))
            if close
            else say("there is no such file"),
            where=Where(file=shown(close)) if close else None,
            words={"path": path},
        )
    there = sorted(PREFIX.sub("", one) for one in evidence.build.files)
    others = [one for one in there if one.startswith(inside) and posixpath.basename(one) == name]
    by_cmake = file_of(evidence, SETUP) is None and file_of(evidence, CMAKE) is not None
    line = None if by_cmake else _line(evidence, path)
    actual = say("the package has {path}, but the build does not install it", path=path)
    if others:
        actual = say("the build installs it as {path}", path=shown(others[0]))
    folder = posixpath.dirname(path)
    raise Failed(
        "setup.file_not_installed",
        expected=expected,
        actual=actual,
        where=Where(file=CMAKE if by_cmake else SETUP, line=line),
        variant="cmake" if by_cmake else "moved" if others else "",
        params={"path": path},
        words={
            "folder": posixpath.dirname(wanted),
            "source": f"DIRECTORY {folder}" if folder else f"FILES {path}",
        },
    )


def _line(evidence: Evidence, path: str) -> int | None:
    """Return the line of data_files that installs the file elsewhere, else that of data_files."""
    setup = setup_py_of(evidence)
    value = setup.argument("data_files") if setup is not None else None
    for pair in value.items if isinstance(value, Listing) else ():
        files = pair.items[-1] if isinstance(pair, Listing) and pair.items else None
        texts = files.items if isinstance(files, Listing) else ()
        if any(isinstance(t, Text) and posixpath.normpath(t.value) == path for t in texts):
            return pair.line
    if value is not None:
        return value.line
    return setup.line if setup is not None else None
