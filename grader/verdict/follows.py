"""Which mistakes of the files are only consequences of another one, which is fixed first."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from grader.base.i18n.message import Message, say
from grader.base.i18n.translator import Translator
from grader.package.edit.diff import digest_of
from grader.report.model import CheckResult, Where
from grader.verdict.checks.all import STATIC

if TYPE_CHECKING:
    from grader.verdict.evidence import Evidence

FOLLOWS = {
    "package.created_inside": ("setup.no_entry",),
    "package.created_as_cmake": (
        *("package.marker_missing", "package.setup_cfg_missing", "setup.missing"),
        "source.no_node_file",
    ),
    "package.name_mismatch": ("setup.other_package",),
    "source.empty_node_file": ("source.no_shebang",),
    "source.misplaced_node_file": ("setup.other_module",),
}
"""By the mistake that is the cause: those that disappear with it, or are to be fixed after it."""

INTERFACE = "interface."
"""What is wrong with an interface is found again by each check that needs it."""
NOT_IMPORTED = "interface.not_imported"
IN_ONE_FILE = {"source.empty_node_file"}
"""The causes that have consequences only in the file that they are about."""

REPEATED = {
    "entry_point.mapping": ("", ("node.main_missing", "node.main_misspelt")),
    "source.node_file": ("/__init__.py", ("source.no_init_file", "package.created_as_cmake")),
    "package.found": ("", ("build.ignored",)),
}
"""By the kind of check: the mistakes that say the same as its advice, with more about the cause.

The text before them is in that advice in every language; "" is in any.
"""


def follow_text(cause: str) -> Message:
    """Return what to do about a failure whose cause another check tells."""
    return say("This follows from {check}. Fix {check} first.", check=cause)


def without_repeated(results: Sequence[CheckResult], evidence: Evidence) -> list[CheckResult]:
    """Return the results without the advice that a failed check replaces."""
    found = {one.id for result in results if result.status == "failed" for one in result.mistakes}
    replaced: dict[str, str] = {}
    for use in evidence.assignment.checks:
        part, mistakes = REPEATED.get(use.kind, ("", ()))
        if found.intersection(mistakes):
            replaced[use.id] = part
    return [_without(r, replaced[r.id]) if r.id in replaced else r for r in results]


def with_same_cause(
    results: Sequence[CheckResult], evidence: Evidence, translate: Translator
) -> list[CheckResult]:
    """Return the results; what the files show follows from a run's check if its change mends both.

    An import from the wrong package is such a mistake: package.xml does not need that package then.
    """
    found = list(results)
    for told in results:
        fixed = evidence.tried.get(digest_of(told.patch.encode()))
        if fixed is None or told.status != "failed" or told.id in STATIC:
            continue
        follows = translate(follow_text(told.id))
        update = {"consequence_of": told.id, "rationale": "", "patch": "", "fix": follows}
        for n, one in enumerate(found):
            after = fixed.results.get(one.id)
            passes = after is not None and after.status == "passed"
            if passes and _is_of_files(one) and _file(one) not in told.patch:
                found[n] = one.model_copy(update=update)
    return found


def _is_of_files(result: CheckResult) -> bool:
    return result.status == "failed" and result.id in STATIC and not result.consequence_of


def _file(result: CheckResult) -> str:
    """Return the file that a failure is in: a change of it is a mistake of its own."""
    return result.where.file if result.where is not None else "package.xml"


def _without(result: CheckResult, part: str) -> CheckResult:
    """Return a result without the advice that contains a text."""
    kept = [text for text in result.advice if part not in text]
    return result.model_copy(update={"advice": kept})


def followed(mistake: str, where: Where | None, evidence: Evidence) -> str:
    """Return the earlier visible check whose mistake is the cause of this one; "" if none is."""
    refused = mistake == "build.failed" and where is not None and where.line is not None
    for check, result in evidence.results.items():
        known = result.mistakes[0].id if result.mistakes else ""
        visible = result.status == "failed" and result.visibility == "visible"
        same = refused and known == "package.setup_cfg_wrong" and result.where == where
        file = result.where.file if result.where is not None else ""
        other = known in IN_ONE_FILE and where is not None and where.file != file
        same |= _of_one_interface(mistake, known, same_place=result.where == where)
        if visible and not other and (same or mistake in FOLLOWS.get(known, ())):
            return check
    return ""


def _of_one_interface(mistake: str, known: str, *, same_place: bool) -> bool:
    """Whether an earlier mistake of a package of interfaces is the cause of this one."""
    again = mistake == known and same_place
    return known.startswith(INTERFACE) and (again or mistake == NOT_IMPORTED)
