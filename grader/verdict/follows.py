"""Which mistakes of the files are only consequences of another one, which is fixed first."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from grader.report.model import CheckResult

if TYPE_CHECKING:
    from grader.verdict.evidence import Evidence

FOLLOWS = {
    "package.created_inside": ("setup.no_entry",),
    "package.created_as_cmake": (
        *("package.marker_missing", "package.setup_cfg_missing", "setup.missing"),
        "source.no_node_file",
    ),
    "source.empty_node_file": ("source.no_shebang",),
}
"""By the mistake that is the cause: those that disappear with it, or are to be fixed after it."""

REPEATED = {"entry_point.mapping": ("node.main_missing", "node.main_misspelt")}
"""By the kind of check: the mistakes that say the same as its advice, with more about the cause."""


def without_repeated(results: Sequence[CheckResult], evidence: Evidence) -> list[CheckResult]:
    """Return the results without the advice that a failed check replaces."""
    found = {one.id for result in results if result.status == "failed" for one in result.mistakes}
    replaced = {
        use.id for use in evidence.assignment.checks if found & {*REPEATED.get(use.kind, ())}
    }
    return [r.model_copy(update={"advice": []}) if r.id in replaced else r for r in results]


def followed(mistake: str, evidence: Evidence) -> str:
    """Return the earlier visible check whose mistake is the cause of this one; "" if none is."""
    for check, result in evidence.results.items():
        known = result.mistakes[0].id if result.mistakes else ""
        visible = result.status == "failed" and result.visibility == "visible"
        if visible and mistake in FOLLOWS.get(known, ()):
            return check
    return ""
