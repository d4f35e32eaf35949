"""Kinds of check for files of the package: whether they exist, and what is in them."""

from __future__ import annotations

from typing import TYPE_CHECKING

from grader.base.i18n.message import say
from grader.base.nearest import nearest
from grader.course.values import Form
from grader.report.model import Where
from grader.verdict.checks.declare import INTAKE, kind
from grader.verdict.checks.parameters import Parameters
from grader.verdict.outcome import Failed, Passed

if TYPE_CHECKING:
    from grader.verdict.use import Use


class File(Parameters):
    """The path of a file in the package as it is handed in, whether it is installed or not.

    With `of:` it is the package of that node.
    """

    path: str


class Text(Parameters):
    """The form of a file's text, in the package as it is handed in; `of:` as in `files.exists`."""

    path: str
    text: Form


@kind("files.exists", File, stage=INTAKE, depends=["package.found"])
def exists(use: Use[File]) -> Passed:
    """The package has the file {path}"""
    _text(use, use.given.path)
    return Passed()


@kind("files.matches", Text, stage=INTAKE, depends=["package.found"], after=["files.exists"])
def matches(use: Use[Text]) -> Passed:
    """The file {path} has the wanted text"""
    given = use.given
    use.blocked_by("files.exists", path=given.path, of=use.use.of)
    if not given.text.fits(_text(use, given.path)):
        raise Failed(
            "files.no_match",
            expected=given.text.words,
            actual=say("the text of {path} does not fit", path=given.path),
            where=Where(file=given.path),
            params={"path": given.path},
        )
    return Passed()


def _text(use: Use[Parameters], path: str) -> str:
    """Return a file's text. Raises Failed if the package does not have the file."""
    files = {file.path: file for file in use.evidence.submission.files if file.kind == "file"}
    if path in files:
        return files[path].data.decode("utf-8", errors="replace")
    close = nearest(path, files) or ""
    raise Failed(
        "files.missing",
        expected=path,
        actual=say("there is {path}", path=close) if close else say("there is no such file"),
        where=Where(file=close) if close else None,
        params={"path": path},
    )
