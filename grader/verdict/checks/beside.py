"""The Python packages of other nodes, which are handed in beside the main one."""

from __future__ import annotations

from typing import TYPE_CHECKING

from grader.base.i18n.message import say
from grader.package.source.manifest import ManifestError, read_manifest
from grader.report.model import Where
from grader.verdict.checks.declare import INTAKE, kind
from grader.verdict.checks.parameters import Parameters
from grader.verdict.outcome import Failed, Passed

if TYPE_CHECKING:
    from grader.verdict.use import Use

MANIFEST = "package.xml"


class Beside(Parameters):
    """Another Python package of the assignment, with nodes of its own."""

    package: str


@kind("package.beside", Beside, stage=INTAKE, depends=["package.found"])
def beside(use: Use[Beside]) -> Passed:
    """The package {package} is there, and its build type is ament_python"""
    name = use.given.package
    found = use.evidence.submission.package(name)
    words = {"package": name}
    if found is None:
        names = [one.name for one in use.evidence.submission.candidates]
        raise Failed(
            "beside.missing",
            expected=say(
                "a package {name} beside {package}",
                name=name,
                package=use.evidence.assignment.package,
            ),
            actual=", ".join(names) or "-",
            words=words,
        )
    place = f"{name}/{MANIFEST}"
    text = found.text(MANIFEST)
    try:
        manifest = read_manifest((text or "").encode())
    except ManifestError as error:
        raise Failed(
            "beside.manifest",
            expected=say("a package.xml that can be read"),
            actual=error.text[:200] if text is not None else say("there is no such file"),
            where=Where(file=place, line=error.line),
            words=words,
        ) from None
    kinds = [one.text for one in manifest.all("build_type", "export")]
    if kinds != ["ament_python"]:
        raise Failed(
            "beside.not_python",
            expected="<build_type>ament_python</build_type>",
            actual=", ".join(kinds) or "-",
            where=Where(file=place),
            words=words,
        )
    return Passed()
