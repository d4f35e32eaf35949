"""The page of one report, from the head to what to do next."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from grader.report.blocks import UNSEEN
from grader.report.blocks import WORDS
from grader.report.blocks import block
from grader.report.blocks import evidence_of
from grader.report.blocks import quotation
from grader.report.blocks import roots
from grader.report.blocks import row
from grader.report.page import Page
from grader.report.plain import first_lines
from grader.report.plain import one_line
from grader.report.plain import points

if TYPE_CHECKING:
    from pathlib import Path

    from grader.report.model import CheckResult
    from grader.report.model import Report

LINES, LINES_VERBOSE = 12, 200  # of one text
CLOCKS = {"virtual": "virtual clock", "wall": "wall clock", None: ""}


def report_page(
    report: Report,
    *,
    width: int,
    styled: bool,
    verbose: bool,
    show_hidden: bool,
    path: Path | None,
) -> str:
    """Return the page as a string; it depends on the arguments alone."""
    page = Page(width=width, styled=styled)
    checks = [c for c in report.checks if show_hidden or c.visibility == "visible"]
    lines = LINES_VERBOSE if verbose else LINES
    _head(page, report)
    _table(page, report, checks)
    quoted = _blocks(page, report, checks, lines)
    _skipped(page, report, checks)
    _advice(page, checks)
    if verbose:
        _details(page, report, checks, quoted)
    _foot(page, report, checks, path)
    return str(page)


def _head(page: Page, report: Report) -> None:
    who, env = report.submission, report.environment
    page.line((one_line(report.assignment.title), "bold"))
    page.gap()
    number = f" ({one_line(who.student_id, most=60)})" if who.student_id else ""
    page.field("student", f"{one_line(who.name, most=100)}{number}")
    page.field("package", one_line(who.package, most=100) if who.package else "none was found")
    page.code("in", [one_line(who.path, most=4_000)])
    clock = CLOCKS[report.observed.clock]
    sandbox = "no sandbox" if env.sandbox == "none" else f"sandbox {env.sandbox}"
    world = [f"ROS 2 {one_line(env.distro, most=40)} ({env.ros})", sandbox, clock]
    page.field("ran on", ", ".join(part for part in world if part))
    for note in who.notes:
        page.field("note", first_lines(note, lines=3))
    page.gap()


def _table(page: Page, report: Report, checks: Sequence[CheckResult]) -> None:
    if report.status == "error":
        page.line(("Not graded: ", "bold magenta"), "\n".join(first_lines(report.message, lines=8)))
        page.line("This is a fault of the grader or its machine, not of the submission.")
        page.gap()
    if checks:
        page.table([row(check) for check in checks])
        page.gap()
    total = f"Score {points(report.score)} / {points(report.max_score)}"
    if report.inconclusive:
        total += f", {points(report.inconclusive)} inconclusive"
    page.line((total, "bold"), _counts(checks))
    if report.status == "graded" and report.message.strip():
        page.line("\n".join(first_lines(report.message, lines=8)), indent=2)
    hidden = len(report.checks) - len(checks)
    if hidden:
        page.line(f"{hidden} hidden check{'s' if hidden > 1 else ''}: not shown")


def _counts(checks: Sequence[CheckResult]) -> str:
    if checks and all(check.status == "passed" for check in checks):
        return "  (every check passed)"
    count = {word: sum(c.status == status for c in checks) for status, word in WORDS.items()}
    said = ", ".join(f"{number} {word}" for word, number in count.items() if number)
    return f"  ({said})" if said else ""


def _blocks(
    page: Page, report: Report, checks: Sequence[CheckResult], lines: int
) -> frozenset[str]:
    """Write the block of each check that did not pass; return the texts quoted on the way."""
    quoted: set[str] = set()
    for check in checks:
        if check.status in ("passed", "skipped"):
            continue
        page.gap()
        block(page, check, lines=lines)
        text, title = evidence_of(check, report.evidence)
        if text.strip() and title not in quoted:
            quoted.add(title)
            quotation(page, text, title, lines=lines)
    return frozenset(quoted)


def _skipped(page: Page, report: Report, checks: Sequence[CheckResult]) -> None:
    reasons: dict[str, list[str]] = {}
    visible = {check.id for check in checks}
    for check in checks:
        if check.status != "skipped":
            continue
        names = [
            one_line(other.id, most=60) if other.id in visible else UNSEEN
            for other in roots(check, report.checks)
        ]
        known = f"because {' and '.join(dict.fromkeys(names))} did not pass" if names else ""
        reasons.setdefault(known or one_line(check.actual), []).append(check.id)
    for reason, ids in reasons.items():
        page.gap()
        listed = ", ".join(one_line(check_id, most=60) for check_id in ids)
        page.line((f"Skipped {reason}".rstrip(), "bold"), f": {listed}")


def _advice(page: Page, checks: Sequence[CheckResult]) -> None:
    passed = [check for check in checks if check.status == "passed" and check.advice]
    if not passed:
        return
    page.gap()
    page.line(("Advice", "bold"), " (these checks passed, no points are lost)")
    for check in passed:
        for advice in check.advice:
            text = "\n".join(first_lines(advice, lines=6))
            page.line((one_line(check.id, most=60), "cyan"), f": {text}", indent=2)


def _details(
    page: Page, report: Report, checks: Sequence[CheckResult], quoted: frozenset[str]
) -> None:
    env, timing = report.environment, report.timing
    page.gap()
    page.line(("Details", "bold"))
    for name in ("rclpy", "rmw", "python", "colcon", "setuptools", "image", "grader"):
        if value := getattr(env, name):
            page.field(name, one_line(str(value)))
    for name, limit in env.limits.items():
        value = f"{limit.value:,.10g} {limit.unit}"
        page.field("limit", one_line(f"{name} {value}, held by {limit.held_by}"))
    spent = [f"{name} {seconds:.2f} s" for name, seconds in timing.model_dump().items()]
    page.field("time", ", ".join(spent))
    if report.attempts > 1:
        page.field("attempts", str(report.attempts))
    for node in report.observed.nodes:
        page.field("node", one_line(node))
    for tick in report.observed.ticks:
        at = "" if tick.virtual is None else f"  at {tick.virtual:.3f} s of ROS time"
        page.field("line", one_line(tick.text) + at)
    for check in checks:
        if check.status == "passed" and check.actual.strip():
            page.field("passed", f"{one_line(check.id, most=60)}: {one_line(check.actual)}")
    for text, title in (
        (report.evidence.build_log, "colcon build printed"),
        (report.evidence.transcript, "ros2 run printed"),
    ):
        if text.strip() and title not in quoted:
            page.gap()
            quotation(page, text, title, lines=LINES_VERBOSE)


def _foot(page: Page, report: Report, checks: Sequence[CheckResult], path: Path | None) -> None:
    page.gap()
    first = next((check for check in checks if check.status == "failed"), None)
    if first is not None:
        place = ""
        if first.where is not None:
            line = "" if first.where.line is None else f", line {first.where.line}"
            place = f" (in {one_line(first.where.file, most=100)}{line})"
        page.field("next", f"Fix {one_line(first.id, most=60)}{place}, save, and grade again.")
    if report.observed.command:
        page.code("command", [one_line(report.observed.command, most=4_000)])
    if path is not None:
        page.code("report", [one_line(str(path), most=4_000)])
