"""Marks one package on one or several distros and prints the result, for `grade` and `check`."""

from __future__ import annotations

import importlib
import sys
import threading
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING

from grader.base.errors import UsageError
from grader.base.i18n.message import say, say_plural
from grader.base.i18n.translator import Translator
from grader.base.signing import own_key
from grader.cli.lead import lead_of
from grader.course.assignment import Assignment
from grader.report import events
from grader.report.live import LiveProgress
from grader.report.model import Report
from grader.report.notice import notice
from grader.verdict.checks.all import QUOTES
from grader.verdict.mark import grade
from grader.verdict.order import Order

if TYPE_CHECKING:
    from grader.cli.called import Commands
    from grader.report.one_screen import State
    from grader.verdict.evidence_file import Judged

# needed after the build only, which leaves the time to import them
NEEDED_LATER = (
    "grader.report.feedback",
    "grader.report.files",
    "grader.report.one_screen",
    "grader.report.report_page",
    "grader.report.terminal",
    "grader.verdict.evidence_file",
)


@dataclass(frozen=True)
class Asked:
    """What a student asks to know: hints about the first failure, or everything (`explain`)."""

    hints: int
    explain: bool

    def check(self, assignment: Assignment) -> None:
        """Raise UsageError if it asks for what the assignment does not give."""
        given = assignment.feedback.lab
        if (self.hints or self.explain) and given in ("where", "score"):
            raise UsageError(
                say("there are no hints for {assignment}", assignment=assignment.id),
                remedy=say("Your instructor has chosen that. Ask for help in class."),
            )

    def seen(self, report: Report) -> Report:
        """Return the report with what the student asks to know."""
        from grader.report.feedback import for_lab  # noqa: PLC0415 - see NEEDED_LATER

        rules = report.assignment.feedback
        return for_lab(report, rules, hints=self.hints, explain=self.explain)

    def more(self, report: Report, commands: Commands) -> str:
        """Return how to get the next hint, "" if there is none."""
        from grader.report.feedback import first_failure  # noqa: PLC0415 - see NEEDED_LATER

        if report.assignment.feedback.lab != "hints" or self.explain:
            return ""
        if first_failure(report.checks) is None:
            return ""
        return commands.next_hint(self.hints)


def mark_orders(
    orders: list[Order],
    out: Path | None,
    commands: Commands,
    *,
    whole: bool,
    verbose: bool,
    asked: Asked | None = None,
    heard: Callable[[Report], State | None] | None = None,
) -> int:
    """Mark each order, print the report (of several distros a matrix), return the exit status.

    The reports and their evidence are written to `out` unless it is None. `commands` are the ones
    that texts name. `whole` shows more than what fits on a screen, `verbose` also the evidence.
    `asked` is what a student asks to know, without the hidden checks; None is for instructors, who
    see everything. `heard` gets each report, and may return what a student has to do first.
    """
    if asked is not None:
        asked.check(orders[0].assignment)
    if out is not None:
        own_key()  # a key that cannot be used is said before anything is marked
    translate = Translator(orders[0].lang)
    reports: list[Report] = []
    for order in orders:
        kept: list[Judged] = []
        with LiveProgress(sys.stderr, lang=order.lang) as progress:
            report = grade(order, _Listener(progress), keep=kept.append)
        state = None if heard is None else heard(report)
        written = None if out is None else _write(report, kept[0], order, out)
        report = report if asked is None else asked.seen(report)
        reports.append(report)
        if len(orders) == 1:
            shown = _Shown(report, order, commands, asked, written, state)
            shown.print(whole=whole or verbose, verbose=verbose)
        if report.environment.sandbox == "none":
            bare = say(
                "No sandbox was used: the package ran as your user, with access to your files."
            )
            notice(translate(bare), sys.stderr)
    if asked is not None:
        for text in about_the_instructors_run(orders[0].assignment):
            notice(translate(text), sys.stdout)
    if len(orders) > 1:
        _print_matrix(reports, out, show_hidden=asked is None)
    return 0 if all(report.all_passed for report in reports) else 1


@dataclass(frozen=True)
class _Shown:
    """A report as it is printed: on one screen, or the whole."""

    report: Report
    order: Order
    commands: Commands
    asked: Asked | None
    written: Path | None
    state: State | None

    def print(self, *, whole: bool, verbose: bool) -> None:
        """Print it to standard output."""
        from grader.report import terminal  # noqa: PLC0415 - see NEEDED_LATER

        asked, report = self.asked, self.report
        more = "" if asked is None else asked.more(report, self.commands)
        if whole:
            terminal.print_report(
                report,
                quotes=QUOTES,
                file=sys.stdout,
                verbose=verbose,
                show_hidden=asked is None,
                path=self.written,
                own_code=self.order.own_code,
                more=more,
            )
        else:
            own = asked is not None
            lead = lead_of(report, self.commands, written=self.written, more=more, own_code=own)
            below = bool(own and self.order.assignment.draw)  # (see `about_the_instructors_run`)
            lead = replace(lead, state=self.state, around=lead.around + below)
            terminal.print_one_screen(report, lead, file=sys.stdout, show_hidden=asked is None)


class _Listener:
    """Passes events on; when the build begins, it imports what is needed after it."""

    def __init__(self, progress: events.Listener) -> None:
        self._progress = progress
        self._imports = threading.Thread(target=_import_the_rest, daemon=True)

    def __call__(self, event: events.Event) -> None:
        if isinstance(event, events.StageStarted) and event.stage == "build":
            self._imports.start()
        self._progress(event)


def _import_the_rest() -> None:
    for name in NEEDED_LATER:
        importlib.import_module(name)


def _write(report: Report, judged: Judged, order: Order, out: Path) -> Path:
    from grader.report import files  # noqa: PLC0415 - see NEEDED_LATER
    from grader.verdict.evidence_file import evidence_bytes  # noqa: PLC0415

    evidence = evidence_bytes(judged, order.assignment, report)
    return files.write_report(report, out, report.submission.name, evidence=evidence)


def _print_matrix(reports: list[Report], out: Path | None, *, show_hidden: bool) -> None:
    from grader.report import files, terminal  # noqa: PLC0415 - see NEEDED_LATER

    path = None if out is None else files.write_matrix(reports, out, reports[0].submission.name)
    terminal.print_matrix(reports, file=sys.stdout, show_hidden=show_hidden, path=path)


def about_the_instructors_run(assignment: Assignment) -> Iterator[str]:
    """Yield how the instructor's run differs from a student's own."""
    yield _hidden(assignment.hidden_checks)
    if assignment.draw:
        yield say("Your instructor's run has other values.")


def _hidden(count: int) -> str:
    if count == 0:
        return say("There are no hidden checks: your instructor's grader runs the same ones.")
    return say_plural(
        "Your instructor's grader also runs 1 hidden check.",
        "Your instructor's grader also runs {count} hidden checks.",
        count,
    )
