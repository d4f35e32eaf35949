"""The page of one report, from the heading to the next step."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

from grader.base.i18n.message import joined, say, say_plural
from grader.base.i18n.translator import Translator
from grader.base.plain_text import first_lines, one_line, points
from grader.report.blocks import MARKS, UNSEEN, WORDS, block, evidence_of, quotation, roots
from grader.report.feedback import most_stopping
from grader.report.page import CheckRow, Page
from grader.report.programs import command_for
from grader.report.sketch import path_sketch, value_sketch

if TYPE_CHECKING:
    from pathlib import Path

    from grader.report.model import CheckResult, Quote, Report, RunInfo

LINES, LINES_VERBOSE = 12, 200  # per text
VALUES_KEY = say("* a message, x not as wanted, - wanted")
INSTANTS_KEY = say("* a message")
DUE_KEY = say("below, | is a due instant")
PATH_KEY = say("* driven from S to E, . wanted")
CLOCKS = {"virtual": say("virtual clock"), "wall": say("wall clock"), None: ""}
COMMAND = re.compile(r"(?<![\w./-])(?:mv|chmod) \S")
"""A command in the text of a fix."""
RENAMES = ("diff --git ", "similarity index ", "rename ", "old mode ", "new mode ")
"""What the lines of a diff begin with that changes only names and modes."""


def report_page(
    report: Report,
    *,
    quotes: Mapping[str, Quote],
    width: int,
    styled: bool,
    verbose: bool,
    show_hidden: bool,
    path: Path | None,
    own_code: bool = False,
    more: str = "",
) -> str:
    """Return the page as a string; it depends on the arguments alone (see `render_report`)."""
    page = Page(width=width, styled=styled, translate=Translator(report.lang))
    checks = [c for c in report.checks if show_hidden or c.visibility == "visible"]
    lines = LINES_VERBOSE if verbose else LINES
    _head(page, report)
    _table(page, report, checks)
    quoted = _blocks(page, report, checks, quotes, lines, verbose=verbose)
    _skipped(page, report, checks)
    _advice(page, checks)
    if verbose:
        _details(page, report, checks, quoted)
    _foot(page, report, checks, path, own_code=own_code, more=more)
    return str(page)


def _head(page: Page, report: Report) -> None:
    who = report.submission
    page.line((one_line(report.assignment.title), "bold"))
    page.gap()
    number = f" ({one_line(who.student_id, most=60)})" if who.student_id else ""
    page.field(say("student"), f"{one_line(who.name, most=100)}{number}")
    none = say("none was found")
    page.field(say("package"), one_line(who.package, most=100) if who.package else none)
    page.code(say("in"), [one_line(who.path, most=4_000)])
    page.field(say("ran on"), ran_on(report))
    if values := drawn_values(report):
        page.field(say("drawn"), values)
    for note in who.notes:
        page.field(say("note"), first_lines(note, lines=3, translate=page.translate))
    page.gap()


def ran_on(report: Report) -> str:
    """Return what the package ran on: the ROS distro, the sandbox, the clock."""
    env = report.environment
    sandbox = say("sandbox {sandbox}", sandbox=env.sandbox)
    sandbox = say("no sandbox") if env.sandbox == "none" else sandbox
    ros = f"ROS 2 {one_line(env.distro, most=40)} ({env.ros})"
    return joined(ros, sandbox, CLOCKS[report.observed.clock], by=", ")


def drawn_values(report: Report) -> str:
    """Return the values that were drawn for the submission, "" if there are none."""
    found = {name: value for run in report.runs for name, value in run.drawn.items()}
    shown = [
        f"{name} = {value:g}" if isinstance(value, float) else f"{name} = {value}"
        for name, value in found.items()
    ]
    return ", ".join(one_line(text, most=60) for text in shown)


def _table(page: Page, report: Report, checks: Sequence[CheckResult]) -> None:
    if report.status == "error":
        message = "\n".join(first_lines(report.message, lines=8, translate=page.translate))
        page.line((say("Not graded: "), "bold magenta"), message)
        page.line(say("This is a fault of the grader or its machine, not of the submission."))
        page.gap()
    if checks:
        page.table([_row(check) for check in checks])
        page.gap()
    page.line((total(report), "bold"), counts(checks))
    if report.status == "graded" and report.message.strip():
        page.line(
            "\n".join(first_lines(report.message, lines=8, translate=page.translate)), indent=2
        )
    hidden = len(report.checks) - len(checks)
    if hidden:
        page.line(hidden_checks(hidden))


def hidden_checks(count: int) -> str:
    """Return how many checks are not shown."""
    return say_plural("1 hidden check: not shown", "{count} hidden checks: not shown", count)


def total(report: Report) -> str:
    """Return the score, and the points that are neither given nor lost."""
    score = say("Score {score} / {most}", score=points(report.score), most=points(report.max_score))
    open_ = say(", {points} inconclusive", points=points(report.inconclusive))
    return score + (open_ if report.inconclusive else "")


def counts(checks: Sequence[CheckResult]) -> str:
    """Return how many checks have which verdict, in brackets."""
    if checks and all(check.status == "passed" for check in checks):
        return joined("  (", say("every check passed"), ")", by="")
    count = {word: sum(c.status == status for c in checks) for status, word in WORDS.items()}
    parts = [say("{count} {word}", count=n, word=word) for word, n in count.items() if n]
    return joined("  (", joined(*parts, by=", "), ")", by="") if parts else ""


def _blocks(
    page: Page,
    report: Report,
    checks: Sequence[CheckResult],
    quotes: Mapping[str, Quote],
    lines: int,
    *,
    verbose: bool,
) -> frozenset[str]:
    """Write the block of each check that did not pass; return the titles of the quoted texts."""
    quoted: set[str] = set()
    drawn: set[tuple[str, ...]] = set()
    for check in checks:
        if check.status in ("passed", "skipped") or _follows_unknown(check):
            continue
        page.gap()
        block(page, check, lines=lines)
        _sketches(page, report, check, drawn)
        found = evidence_of(check, report, quotes)
        if found is not None and found.text.strip() and found.title not in quoted:
            quoted.add(found.title)
            faster = found.log == "transcript" and report.observed.clock == "virtual"
            quotation(page, found.text, found.title, lines=lines, whole=verbose, faster=faster)
    return frozenset(quoted)


def _sketches(page: Page, report: Report, check: CheckResult, drawn: set[tuple[str, ...]]) -> None:
    """Draw what a failed check judged in its run: values of a topic, or the path of a turtle.

    What is `drawn` already is not drawn again.
    """
    if check.status != "failed":
        return

    def is_new(*picture: str) -> bool:
        new = picture not in drawn
        drawn.add(picture)
        return new

    def heading(run: RunInfo, *names: str) -> str:
        name = one_line(" ".join(names).rstrip(), most=60)
        of = say("{what}, in the run {run}", what=name, run=one_line(run.name, most=60))
        return page.translate(of) if len(report.runs) > 1 else name

    for run in [run for run in report.runs if check.run in ("", run.name)]:
        judged = [plot for plot in run.plots if check.id in plot.checks and plot.points]
        for plot in [plot for plot in judged if plot.wrong] or judged[:1]:
            if is_new(run.name, plot.topic, plot.field):
                what = heading(run, plot.topic, plot.field)
                page.code(say("values"), [what, *value_sketch(plot, page.columns)])
                key = VALUES_KEY if plot.field else INSTANTS_KEY
                page.field("", joined(key, DUE_KEY if plot.due else "", by="; "))
        if any(found.id.startswith("world.") for found in check.mistakes):
            for turtle, driven in run.path.items():
                if is_new(run.name, turtle):
                    lines = path_sketch(driven, run.wanted.get(turtle, []), page.columns)
                    page.code(say("path"), [heading(run, turtle), *lines])
                    page.field("", PATH_KEY)


def _follows_unknown(check: CheckResult) -> bool:
    """Whether a check could not be decided because another one could not."""
    return check.status == "inconclusive" and bool(check.blocked_by)


def _skipped(page: Page, report: Report, checks: Sequence[CheckResult]) -> None:
    reasons: dict[str, list[str]] = {}
    visible = {check.id for check in checks}
    for check in checks:
        if check.status != "skipped" and not _follows_unknown(check):
            continue
        names = [
            one_line(other.id, most=60) if other.id in visible else UNSEEN
            for other in roots(check, report.checks)
        ]
        both = joined(*dict.fromkeys(names), by=", ")
        known = say("Skipped because {checks} did not pass", checks=both)
        other = say("Skipped {reason}", reason=one_line(check.actual))
        if _follows_unknown(check):
            known = say("Not decided because {checks} could not be decided", checks=both)
            other = say("Not decided: {reason}", reason=one_line(check.actual))
        reasons.setdefault(known if names else other, []).append(check.id)
    for reason, ids in reasons.items():
        page.gap()
        listed = ", ".join(one_line(check_id, most=60) for check_id in ids)
        page.line((reason, "bold"), f": {listed}")


def _advice(page: Page, checks: Sequence[CheckResult]) -> None:
    passed = [check for check in checks if check.status == "passed" and check.advice]
    if not passed:
        return
    page.gap()
    page.line((say("Advice"), "bold"), say(" (these checks passed, no points are lost)"))
    for check in passed:
        for advice in check.advice:
            text = "\n".join(first_lines(advice, lines=6, translate=page.translate))
            page.line((one_line(check.id, most=60), "cyan"), f": {text}", indent=2)


def _details(
    page: Page, report: Report, checks: Sequence[CheckResult], quoted: frozenset[str]
) -> None:
    env, timing = report.environment, report.timing
    page.gap()
    page.line((say("Details"), "bold"))
    for name in ("rclpy", "rmw", "python", "colcon", "setuptools", "image", "grader"):
        if value := getattr(env, name):
            page.field(name, one_line(str(value)))
    for name, limit in env.limits.items():
        value = one_line(f"{name} {limit.value:,.10g} {limit.unit}")
        held = say("{limit}, enforced by {holder}", limit=value, holder=one_line(limit.held_by))
        page.field(say("limit"), held)
    spent = [f"{name} {seconds:.2f} s" for name, seconds in timing.model_dump().items()]
    page.field(say("time"), ", ".join(spent))
    if report.attempts > 1:
        page.field(say("attempts"), str(report.attempts))
    for node in report.observed.nodes:
        page.field(say("node"), one_line(node))
    for tick in report.observed.ticks:
        text = one_line(tick.text)
        at = f"{tick.virtual or 0:.3f}"
        timed = say("{text}  at {seconds} s of ROS time", text=text, seconds=at)
        page.field(say("line"), text if tick.virtual is None else timed)
    for check in checks:
        if check.status == "passed" and check.actual.strip():
            page.field(say("passed"), f"{one_line(check.id, most=60)}: {one_line(check.actual)}")
    for text, title in (
        (report.evidence.build_log, say("colcon build printed")),
        (report.evidence.transcript, say("ros2 run printed")),
    ):
        if text.strip() and title not in quoted:
            page.gap()
            quotation(page, text, title, lines=LINES_VERBOSE, whole=True)


def next_step(check: CheckResult, *, own_code: bool) -> str:
    """Return what to do about a check that failed."""
    name, edited = one_line(check.id, most=60), not _is_done_by_command(check)
    if check.where is None:
        if own_code and edited:
            return say("Fix {check}, save, and run check again.", check=name)
        if own_code:
            return say("Fix {check}, then run check again.", check=name)
        if edited:
            return say("Fix {check}, save, and grade again.", check=name)
        return say("Fix {check}, then grade again.", check=name)
    place = place_of(check)
    if own_code and edited:
        return say("Fix {check} (in {place}), save, and run check again.", check=name, place=place)
    if own_code:
        return say("Fix {check} ({place}), then run check again.", check=name, place=place)
    if edited:
        return say("Fix {check} (in {place}), save, and grade again.", check=name, place=place)
    return say("Fix {check} ({place}), then grade again.", check=name, place=place)


def place_of(check: CheckResult) -> str:
    """Return the file and the line that a check names, "" if it names none."""
    if check.where is None:
        return ""
    file = one_line(check.where.file, most=100)
    if check.where.line is None:
        return file
    return say("{file}, line {line}", file=file, line=check.where.line)


def _is_done_by_command(check: CheckResult) -> bool:
    """Whether the fix edits no file, so there is nothing to save: it renames, moves or sets a mode."""
    if check.patch.strip():
        return all(line.startswith(RENAMES) for line in check.patch.splitlines() if line)
    return bool(COMMAND.search(check.fix))


def _foot(
    page: Page,
    report: Report,
    checks: Sequence[CheckResult],
    path: Path | None,
    *,
    own_code: bool,
    more: str,
) -> None:
    page.gap()
    failed = [check for check in checks if check.status == "failed"]
    first = most_stopping(failed, report.checks) if failed else None
    if first is not None:
        page.field(say("next"), next_step(first, own_code=own_code))
    if command := command_for(first, report):
        page.code(say("ran"), [one_line(command, most=4_000)])
    if path is not None:
        page.code(say("report"), [one_line(str(path), most=4_000)])
    if more:
        page.field(say("hint"), more, style="bold")


def _row(check: CheckResult) -> CheckRow:
    """Return the check's row of the table; unknown points are a dash."""
    mark, style = MARKS[check.status]
    open_ = check.status in ("inconclusive", "error")
    return CheckRow(
        mark=mark,
        style=style,
        name=one_line(check.id, most=60),
        text=one_line(check.title),
        score=f"{'-' if open_ else points(check.score)} / {points(check.max_score)}",
    )
