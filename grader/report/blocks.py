"""The parts of a page about checks: the table, the block of a failed check, who blocked whom."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from grader.report.page import Row
from grader.report.plain import first_lines
from grader.report.plain import last_lines
from grader.report.plain import one_line
from grader.report.plain import points

if TYPE_CHECKING:
    from grader.report.model import CheckResult
    from grader.report.model import Evidence
    from grader.report.page import Page

MARKS = {
    "passed": ("pass", "green"),
    "failed": ("FAIL", "bold red"),
    "skipped": ("skip", "dim"),
    "inconclusive": ("?", "yellow"),
    "error": ("ERR", "magenta"),
}
WORDS = {
    "passed": "passed",
    "failed": "failed",
    "skipped": "skipped",
    "inconclusive": "inconclusive",
    "error": "could not be asked",
}
UNSEEN = "a hidden check"
# what a node says when it is stopped tells nothing of these
BEFORE_CTRL_C = ("run.node_name", "run.output", "run.logger", "run.period")


def row(check: CheckResult) -> Row:
    """Return the check's line of the table; points that nobody knows are a dash."""
    mark, style = MARKS[check.status]
    open_ = check.status in ("inconclusive", "error")
    return Row(
        mark=mark,
        style=style,
        name=one_line(check.id, most=60),
        text=one_line(check.title),
        score=f"{'-' if open_ else points(check.score)} / {points(check.max_score)}",
    )


def roots(check: CheckResult, checks: Sequence[CheckResult]) -> list[CheckResult]:
    """Return the checks because of which this one was skipped.

    What it says itself, else those of its dependencies that did not pass; one that was skipped as
    well is followed to its cause.
    """
    by_id = {other.id: other for other in checks}
    if check.blocked_by in by_id:
        return [by_id[check.blocked_by]]
    found: dict[str, CheckResult] = {}
    seen: set[str] = set()
    ahead = list(check.depends)
    while ahead:
        other = by_id.get(ahead.pop(0))
        if other is None or other.id in seen or other.status == "passed":
            continue
        seen.add(other.id)
        if other.status == "skipped" and other.depends:
            ahead += other.depends
        else:
            found[other.id] = other
    return [other for other in checks if other.id in found]


def block(page: Page, check: CheckResult, *, lines: int, on: str = "") -> None:
    """Write all that is known of a check that did not pass: what, where, why, and the fix."""
    mark, style = MARKS[check.status]
    page.line((f"{mark} {one_line(check.id, most=60)}", style), f": {one_line(check.title)}{on}")
    _field(page, "expected", check.expected, lines)
    _field(page, "found", check.actual, lines)
    if check.where is not None:
        line = "" if check.where.line is None else f":{check.where.line}"
        page.code("where", [one_line(check.where.file) + line])
    _field(page, "why", check.rationale, lines)
    if check.status == "inconclusive":
        page.field("points", "None taken, none given. Grade again when the machine is less busy.")
    elif check.status == "error":
        page.field("points", "None taken, none given: the fault is the grader's. Please report it.")
    _field(page, "fix", check.fix, lines, style="bold")
    if check.patch.strip():
        page.code("change", first_lines(check.patch, lines=2 * lines))
    for advice in check.advice:
        _field(page, "also", advice, lines)
    if check.mistakes:
        names = ", ".join(one_line(mistake.id, most=80) for mistake in check.mistakes)
        page.field("mistake", names, style="dim")


def _field(page: Page, label: str, text: str, lines: int, *, style: str = "") -> None:
    if text.strip():
        page.field(label, first_lines(text, lines=lines, most=1_000), style)


def evidence_of(check: CheckResult, evidence: Evidence) -> tuple[str, str]:
    """Return the text that shows why a check failed, and what it is; ("", "") if none does."""
    stage = check.id.partition(".")[0]
    if check.status != "failed" or stage in ("package", "source"):
        return "", ""
    if stage == "build":
        return evidence.build_log, "colcon build printed"
    before, pressed, _ = evidence.transcript.partition("\n^C")
    if pressed and check.id in BEFORE_CTRL_C:
        return before, "ros2 run printed before Ctrl+C"
    return evidence.transcript, "ros2 run printed"


def quotation(page: Page, text: str, title: str, *, lines: int) -> None:
    """Write the end of what a program printed."""
    shown, count = last_lines(text, lines=lines)
    size = "" if len(shown) == count else f" (the last {len(shown)} of {count:,} lines)"
    page.line((f"What {title}{size}:", "bold"), indent=2)
    page.quote(shown)
