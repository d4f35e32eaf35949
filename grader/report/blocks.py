"""The parts of a page about checks: the words, the block of a failed check, causes of skips."""

from __future__ import annotations

import re
import statistics
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING, Literal

from grader.base.i18n.message import joined, say
from grader.base.plain_text import first_lines, last_lines, one_line
from grader.report.programs import transcript_for
from grader.report.shown_patch import shown_patch
from grader.report.tracebacks import folded

if TYPE_CHECKING:
    from grader.report.model import CheckResult, Quote, Report
    from grader.report.page import Page

MARKS = {
    "passed": (say("pass"), "green"),
    "failed": (say("FAIL"), "bold red"),
    "skipped": (say("skip"), "dim"),
    "inconclusive": ("?", "yellow"),
    "error": (say("ERR"), "magenta"),
}
WORDS = {
    "passed": say("passed"),
    "failed": say("failed"),
    "skipped": say("skipped"),
    "inconclusive": say("inconclusive"),
    "error": say("could not be checked"),
}
UNSEEN = say("a hidden check")


def all_of(names: Sequence[str]) -> str:
    """Return names as a list in words: `a`, `a and b`, `a, b and c`."""
    first, last = list(dict.fromkeys(names)), ""
    if len(first) > 1:
        last = first.pop()
    known = joined(*first, by=", ")
    return say("{names} and {last}", names=known, last=last) if last else known


def roots(check: CheckResult, checks: Sequence[CheckResult]) -> list[CheckResult]:
    """Return the checks because of which this one was skipped.

    The one that it names, else its dependencies that did not pass; a dependency that was skipped
    too is followed to its cause.
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
    """Write all that is known about a check that did not pass: what, where, why, and the fix."""
    mark, style = MARKS[check.status]
    head = joined(mark, one_line(check.id, most=60))
    page.line((head, style), joined(": ", one_line(check.title), on, by=""))
    _field(page, say("expected"), check.expected, lines)
    _field(page, say("found"), check.actual, lines)
    if check.where is not None:
        line = "" if check.where.line is None else f":{check.where.line}"
        page.code(say("where"), [one_line(check.where.file) + line])
    _field(page, say("why"), check.rationale, lines)
    if check.status == "inconclusive":
        busy = say(
            "No points given or taken: this could not be decided. Grade again; if it stays, ask the instructor."
        )
        page.field(say("points"), busy)
    elif check.status == "error":
        ours = say("No points given or taken: this is a fault of the grader. Please report it.")
        page.field(say("points"), ours)
        if check.fault:
            page.code(say("details"), last_lines(check.fault, lines=2 * lines)[0])
    _field(page, say("fix"), check.fix, lines, style="bold")
    if check.patch.strip() and not check.consequence_of:  # (that check shows the same change)
        patch = shown_patch(check.patch, page.translate)
        rows = first_lines(patch, lines=4 * lines, translate=page.translate, tabs=True)
        page.code(say("change"), rows)
    for advice in check.advice:
        _field(page, say("also"), advice, lines)
    if check.consequence_of:
        same = say("the same as {check}", check=one_line(check.consequence_of, most=60))
        page.field(say("cause"), same)
    if check.mistakes:
        names = ", ".join(one_line(mistake.id, most=80) for mistake in check.mistakes)
        page.field(say("mistake"), names, style="dim")


def _field(page: Page, label: str, text: str, lines: int, *, style: str = "") -> None:
    if text.strip():
        shown = first_lines(text, lines=lines, most=1_000, translate=page.translate)
        page.field(label, shown, style)


@dataclass(frozen=True)
class Excerpt:
    """A text of the report's evidence, or a part of it; `log` is the field that it is from."""

    log: Literal["build_log", "transcript"]
    title: str
    text: str


def evidence_of(check: CheckResult, report: Report, quotes: Mapping[str, Quote]) -> Excerpt | None:
    """Return the excerpt that shows why a check failed; None if there is none.

    `quotes` has what each check quotes, by its id. Of several programs it is that of the check.
    """
    quote = quotes.get(check.id)
    if check.status != "failed" or quote is None:
        return None
    if quote == "build_log":
        return Excerpt("build_log", say("colcon build printed"), report.evidence.build_log)
    own = transcript_for(check, report)
    text = report.evidence.transcript if own is None else own.text
    before, pressed, _ = text.partition("\n^C")
    title, late = say("ros2 run printed"), say("ros2 run printed before Ctrl+C")
    if own is not None:
        names = {"node": own.node, "run": own.run}
        title = say("ros2 run printed for {node} in the run {run}", **names)
        late = say("ros2 run printed for {node} in the run {run} before Ctrl+C", **names)
    if pressed and quote == "before_ctrl_c":
        return Excerpt("transcript", late, before)
    return Excerpt("transcript", title, text)


FASTER = say("(The grader's clock runs faster than a real one, so the times are closer together.)")
STAMPED = re.compile(r"^\[[A-Z]+\] \[(\d+\.\d{9})\]")
LEFT_OUT = re.compile(r"^… .{1,100} …\r?$", re.MULTILINE)
"""The line of an output whose middle was not kept: how many lines it had is not known."""
CLOSE = 0.5  # seconds between two lines; the grader's clock may also run as fast as a real one


def _is_close(lines: Sequence[str]) -> bool:
    """Whether log lines follow each other faster than a timer of about a second makes them."""
    found = [float(match[1]) for match in map(STAMPED.match, lines) if match]
    gaps = [after - before for before, after in pairwise(found)]
    return bool(gaps) and statistics.median(gaps) < CLOSE


def quotation(
    page: Page, text: str, title: str, *, lines: int, whole: bool, faster: bool = False
) -> None:
    """Write the end of a program's output; without `whole`, calls inside ROS are folded.

    `faster`: the node had the grader's clock, which mostly runs faster than a real one.
    """
    text = text if whole else folded(text, translate=page.translate)
    shown, count = last_lines(text, lines=lines, translate=page.translate)
    head = say("What {title}:", title=title)
    if len(shown) != count and LEFT_OUT.search(text):
        head = say("What {title} (the last {shown} lines):", title=title, shown=len(shown))
    elif len(shown) != count:
        head = say(
            "What {title} (the last {shown} of {count} lines):",
            title=title,
            shown=len(shown),
            count=f"{count:,}",
        )
    page.line((head, "bold"), indent=2)
    if faster and _is_close(shown):
        page.line((FASTER, "dim"), indent=2)
    page.quote(shown)
