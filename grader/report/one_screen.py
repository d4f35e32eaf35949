"""The report on one screen: the score, the first cause with its change, the others in a line each.

It is `render_report` for a person in a terminal of 24 lines. A verdict that passed is one line and
what comes next. Everything else is in the whole page (`report_page`).
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from rich.cells import cell_len

from grader.base.i18n.message import joined, say, say_plural
from grader.base.i18n.translator import Translator
from grader.base.plain_text import first_lines, one_line, points
from grader.report.blocks import MARKS
from grader.report.commands import REMARK, broken, command_behind, is_command
from grader.report.feedback import most_stopping
from grader.report.page import Page
from grader.report.report_page import (
    counts,
    drawn_values,
    hidden_checks,
    next_step,
    place_of,
    total,
)
from grader.report.shown_patch import shown_patch
from grader.report.sketch import path_sketch, value_sketch
from grader.report.wrap import breaks, rows

if TYPE_CHECKING:
    from grader.report.model import CheckResult, Report

SCREEN = 24  # lines of a terminal
HANGING = 2  # columns that a paragraph leaves free, as its other lines begin that far in
OF_A_RUN = ("action.", "log.", "parameter.", "service.", "topic.", "world.")
"""What the mistakes begin with that are about what was observed in a scenario's run."""
OPEN = ("failed", "inconclusive", "error")
HEADERS = ("diff --git ", "index ", "similarity index ", "--- ", "+++ ", "@@ ")
NEXT, NOW = say("next"), say("now")
MARKED = re.compile(r"[\s^~]*[\^~]\s*")
"""A row of marks below a line."""


@dataclass(frozen=True, kw_only=True)
class State:
    """What is next for the student, and what was `found` of the workspace that no check looks at.

    `of_first` is whether it is about what failed first: that is explained as it always is, below what
    was `found`.
    """

    next: str
    found: str = ""
    of_first: bool = False


@dataclass(frozen=True, kw_only=True)
class Lead:
    """What the page says about commands, in the words of the place where it is read.

    `rest` says how to see everything, `more` how to get the next hint, if there is one. `own_code`
    means that a student reads it. `around` are the lines that are said before and after the page,
    with the command and the next prompt. `after` has labels and texts of what comes after a success, `report`
    is the path of the report. `links` are the URLs of paths, for a terminal that opens them. `state`
    is what comes first for the student, if somebody knows it.
    """

    rest: str
    more: str = ""
    own_code: bool = False
    around: int = 4
    report: str = ""
    state: State | None = None
    after: Sequence[tuple[str, str]] = ()
    links: Mapping[str, str] = field(default_factory=dict)


@dataclass(frozen=True)
class _Room:
    """How many lines each part gets."""

    text: int
    why: int
    change: int
    others: int
    plot: bool = False
    gaps: bool = True


ROOMS = (
    _Room(3, 4, 8, 8, plot=True),
    _Room(3, 4, 8, 8),
    _Room(3, 3, 6, 6),
    _Room(3, 3, 6, 4, gaps=False),
    _Room(2, 2, 4, 3, gaps=False),
    _Room(1, 1, 2, 2, gaps=False),
    _Room(1, 0, 2, 1, gaps=False),
)
"""From the most to the least; the first one with which the page fits on the screen is taken."""


def one_screen(
    report: Report, lead: Lead, *, width: int = 80, styled: bool = False, show_hidden: bool = False
) -> str:
    """Return the page; it depends on the arguments alone."""
    checks = [c for c in report.checks if show_hidden or c.visibility == "visible"]

    def page_in(room: _Room, *, plain: bool) -> str:
        page = Page(
            width=width,
            styled=styled and not plain,
            translate=Translator(report.lang),
            links={} if plain else lead.links,
        )
        _Screen(page, report, checks, lead, room).write()
        return str(page)

    most = SCREEN - lead.around
    fitting = (room for room in ROOMS if rows(page_in(room, plain=True), width) <= most)
    return page_in(next(fitting, ROOMS[-1]), plain=False)


@dataclass(frozen=True)
class _Screen:
    page: Page
    report: Report
    checks: Sequence[CheckResult]
    lead: Lead
    room: _Room

    def write(self) -> None:
        """Write the page."""
        if self.report.all_passed:
            self._passed()
            return
        self._score()
        first = self._first()
        state = self.lead.state
        if state is not None and not state.of_first:
            self._gap()
            self._state(state)
            self._others(None)
        elif first is not None:
            self._gap()
            if state is not None and first.actual.partition("\n")[0] not in state.found:
                self._field(NOW, state.found, 2)
            self._cause(first)
            self._others(first)
        self._gap()
        self._next(first)

    def _gap(self) -> None:
        if self.room.gaps:
            self.page.gap()

    def _passed(self) -> None:
        score = say(
            "Score {score} / {most}",
            score=points(self.report.score),
            most=points(self.report.max_score),
        )
        title = one_line(self.report.assignment.title, most=60)
        passed = joined(": ", say("every check passed"), f" ({title})", by="")
        self.page.line((score, "bold green"), passed)
        for check in self.checks:
            for advice in check.advice[:1]:
                self.page.field(say("also"), self._cut(self.page.translate(advice), 2))
        for label, text in self.lead.after:
            if self.lead.state is not None and label == NEXT:
                continue  # (the next lesson comes later)
            if text.startswith("https://"):
                self.page.code(label, [text])
            else:
                self.page.field(label, self._cut(self.page.translate(text), 2))
        if self.lead.state is not None:
            self._state(self.lead.state)
        if self.lead.report:
            self.page.code(say("report"), [one_line(self.lead.report, most=4_000)])

    def _score(self) -> None:
        page, report = self.page, self.report
        page.line((one_line(report.assignment.title, most=200), "bold"))
        if report.status == "error":
            message = self._cut(page.translate(report.message), 3)
            page.line((say("Not graded: "), "bold magenta"), *message)
            page.line(say("This is a fault of the grader or its machine, not of the submission."))
        hidden = len(report.checks) - len(self.checks)
        page.line((total(report), "bold"), counts(self.checks))
        if report.status == "graded" and report.message.strip():
            page.line("\n".join(self._cut(page.translate(report.message), 2)), indent=2)
        if hidden:
            page.line(hidden_checks(hidden))

    def _first(self) -> CheckResult | None:
        failed = [check for check in self.checks if check.status == "failed"]
        if failed:
            return most_stopping(failed, self.report.checks)
        return next((check for check in self.checks if check.status in OPEN), None)

    def _state(self, state: State) -> None:
        """Write what comes first, whatever the checks found."""
        if state.found:
            self._field(NOW, state.found, 3)
        self._step(state)

    def _step(self, state: State) -> None:
        """Write what is next: a command in lines that can be copied, with its remark below."""
        page, said = self.page, self.page.translate(state.next)
        command, begins, remark = said.partition(REMARK)
        if is_command(command):
            lines = broken(command, page.columns).split("\n")
            page.code(NEXT, [*lines, f"({remark}"] if begins else lines)
            return
        before, behind = command_behind(said)
        if behind and cell_len(said) > page.columns:
            page.field(NEXT, before, "bold")
            page.code("", broken(behind, page.columns).split("\n"))
        else:
            page.field(NEXT, said, "bold")

    def _cause(self, check: CheckResult) -> None:
        page, room = self.page, self.room
        mark, style = MARKS[check.status]
        head = joined(mark, one_line(check.id, most=60))
        title = page.translate(check.title)
        room_left = page.width - cell_len(page.translate(head)) - 2 - HANGING
        page.line((head, style), f": {_fitting(one_line(title), room_left)}")
        self._field(say("expected"), check.expected, room.text)
        self._field(say("found"), check.actual, room.text)
        if check.actual and any(one.id.startswith(OF_A_RUN) for one in check.mistakes):
            self._field(say("drawn"), drawn_values(self.report), 1)
        if check.where is not None:
            line = "" if check.where.line is None else f":{check.where.line}"
            page.code(say("where"), [one_line(check.where.file) + line])
        self._field(say("why"), check.rationale, room.why)
        if check.status == "inconclusive":
            page.field(say("points"), say("No points given or taken: grade again."))
        elif check.status == "error":
            ours = say("No points given or taken: this is a fault of the grader. Please report it.")
            page.field(say("points"), ours)
        self._field(say("fix"), check.fix, max(2, room.text), style="bold")
        change = list(changed_lines(shown_patch(check.patch, page.translate), check))
        if change:
            cut = change[: room.change]
            more = say("… {count} more lines", count=len(change) - len(cut))
            page.code(
                say("change"), cut if len(cut) == len(change) else [*cut, page.translate(more)]
            )
        if room.plot:
            self._plot(check)

    def _field(self, label: str, text: str, most: int, *, style: str = "") -> None:
        if text.strip() and most:
            self.page.field(label, self._cut(self.page.translate(text), most), style)

    def _cut(self, text: str, most: int) -> list[str]:
        """Return the beginning of a text, so that it takes at most so many lines beside a label."""
        width, left = self.page.columns, most
        kept: list[str] = []
        lines = first_lines(text.strip(), lines=most + 1, most=1_000)
        for n, line in enumerate(lines):
            if MARKED.fullmatch(line) and n + 1 < len(lines) and left < 2:
                break
            ends = [*breaks(line, width), len(line)]
            if len(ends) > left:
                begin = line[: ends[left - 1]].rstrip() if left else ""
                if begin:
                    kept.append(f"{_without_last_word(begin, width)} …")
                elif kept and not MARKED.fullmatch(kept[-1]):
                    kept[-1] = f"{_without_last_word(kept[-1], width)} …"
                break
            kept.append(line)
            left -= len(ends)
        return kept

    def _plot(self, check: CheckResult) -> None:
        """Draw once, and small, what a failed check judged: a topic's values or a turtle's path."""
        for run in [run for run in self.report.runs if check.run in ("", run.name)]:
            judged = [plot for plot in run.plots if check.id in plot.checks and plot.points]
            for plot in ([plot for plot in judged if plot.wrong] or judged)[:1]:
                name = one_line(f"{plot.topic} {plot.field}".rstrip(), most=60)
                drawn = value_sketch(plot, min(48, self.page.columns), rows=3)
                self.page.code(say("values"), [name, *drawn])
                return
            if any(found.id.startswith("world.") for found in check.mistakes):
                for turtle, driven in run.path.items():
                    drawn = path_sketch(driven, run.wanted.get(turtle, []), 12)
                    self.page.code(say("path"), [one_line(turtle, most=60), *drawn])
                    return

    def _others(self, first: CheckResult | None) -> None:
        """Write the other checks that did not pass, in a line each, and how many were skipped."""
        others = [c for c in self.checks if c.status in OPEN and c is not first]
        skipped = [c for c in self.checks if c.status == "skipped"]
        if others or skipped:
            self._gap()
        shown = others[: self.room.others]
        for check in shown:
            self._line(check)
        if len(shown) < len(others):
            more = len(others) - len(shown)
            text = say_plural(
                "and 1 more that did not pass", "and {count} more that did not pass", more
            )
            self.page.line(text)
        if skipped:
            lost = points(sum(check.max_score for check in skipped))
            text = say_plural(
                "1 check skipped ({points} points): it needs what failed",
                "{count} checks skipped ({points} points): they need what failed",
                len(skipped),
                points=lost,
            )
            self.page.line((text, "dim"))

    def _line(self, check: CheckResult) -> None:
        """Write a check that did not pass: its mark, its name, and what was found, in one line."""
        page = self.page
        mark, style = MARKS[check.status]
        name = one_line(check.id, most=60)
        found = page.translate(check.actual).strip().partition("\n")[0]
        if check.consequence_of:
            found = page.translate(
                say("the same as {check}", check=one_line(check.consequence_of, most=60))
            )
        elif not found:
            found = page.translate(check.title)
        place = page.translate(place_of(check))
        head = f"{page.translate(mark)} {name}: "
        tail = f" ({place})" if place and not check.consequence_of else ""
        room = page.width - cell_len(head) - HANGING
        fits = room - cell_len(tail) < cell_len(found) <= room  # (without the place)
        if fits or cell_len(found) > room - cell_len(tail) < page.width // 3:
            tail = ""
        room -= cell_len(tail)
        page.line((head, style), f"{_fitting(one_line(found, most=500), room)}{tail}")

    def _next(self, first: CheckResult | None) -> None:
        page, lead = self.page, self.lead
        if lead.state is not None and lead.state.of_first:
            self._step(lead.state)
        elif lead.state is None and first is not None and first.status == "failed":
            page.field(NEXT, next_step(first, own_code=lead.own_code))
        if lead.report:
            page.code(say("report"), [one_line(lead.report, most=4_000)])
        if lead.more:
            page.field(say("hint"), lead.more, style="bold")
        page.field(say("all"), lead.rest)


def changed_lines(patch: str, check: CheckResult) -> Iterator[str]:
    """Yield the lines of a diff that differ; a file's name first, unless the check's place has it."""
    files = [line[6:].rstrip() for line in patch.splitlines() if line.startswith("+++ b/")]
    here = check.where.file if check.where is not None else ""
    for line in patch.splitlines():
        if (line.startswith("+++ b/") and (len(files) > 1 or files[0] != here)) or (
            line.strip() and not line.startswith((*HEADERS, " ", "\\"))
        ):
            yield line


def _without_last_word(text: str, width: int) -> str:
    """Return a text that has room for an ellipsis after it, on its last line."""
    last = [0, *breaks(text, width)][-1]
    if cell_len(text[last:]) + 2 <= width:
        return text
    return text[: text.rindex(" ")] if " " in text[last:].strip() else text[:-2]


def _fitting(text: str, width: int) -> str:
    """Return a text of at most so many columns, cut at a word."""
    if cell_len(text) <= width:
        return text
    kept = text[: breaks(text, max(width - 2, 1))[0]].rstrip()
    return f"{kept} …"
