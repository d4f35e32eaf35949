"""Which mistakes of the files are only consequences of another one, which is fixed first."""

from __future__ import annotations

from typing import TYPE_CHECKING

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


def followed(mistake: str, evidence: Evidence) -> str:
    """Return the earlier visible check whose mistake is the cause of this one; "" if none is."""
    for check, result in evidence.results.items():
        known = result.mistakes[0].id if result.mistakes else ""
        visible = result.status == "failed" and result.visibility == "visible"
        if visible and mistake in FOLLOWS.get(known, ()):
            return check
    return ""
