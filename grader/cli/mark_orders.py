"""Marks one package on one or several distros and prints the result, for `grade` and `check`."""

from __future__ import annotations

import importlib
import sys
import threading
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import click

from grader.base.errors import UsageError
from grader.base.i18n.message import say, say_plural
from grader.base.i18n.translator import Translator
from grader.base.signing import own_key
from grader.course.assignment import Assignment
from grader.report import events
from grader.report.detail import HINTS
from grader.report.live import LiveProgress
from grader.report.model import Report
from grader.verdict.checks.all import QUOTES
from grader.verdict.mark import grade
from grader.verdict.order import Order

if TYPE_CHECKING:
    from grader.verdict.evidence_file import Judged

# needed after the build only, which leaves the time to import them
NEEDED_LATER = (
    "grader.report.feedback",
    "grader.report.files",
    "grader.report.report_page",
    "grader.report.terminal",
    "grader.verdict.evidence_file",
)


@dataclass(frozen=True)
class Asked:
    """What a student asks to know: hints about the first failure, or everything (`explain`).

    `command` is what shows the next hint; `{n}` in it is the number of hints to ask for.
    """

    hints: int
    explain: bool
    command: str

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

    def more(self, report: Report) -> str:
        """Return how to get the next hint, "" if there is none."""
        from grader.report.feedback import first_failure  # noqa: PLC0415 - see NEEDED_LATER

        all_seen = self.explain or self.hints >= HINTS
        if report.assignment.feedback.lab != "hints" or all_seen:
            return ""
        if first_failure(report.checks) is None:
            return ""
        return say(
            "{command}: more about this. check --explain: everything at once.",
            command=self.command.replace("{n}", str(self.hints + 1)),
        )


def mark_orders(
    orders: list[Order],
    out: Path | None,
    *,
    verbose: bool,
    show_hidden: bool,
    asked: Asked | None = None,
    heard: Callable[[Report], None] | None = None,
) -> int:
    """Mark each order, print the report (of several distros a matrix), return the exit status.

    The reports and their evidence are written to `out` unless it is None. `asked` is what a
    student asks to know; None is for instructors, who see everything. `heard` gets each report.
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
        if heard is not None:
            heard(report)
        written = None if out is None else _write(report, kept[0], order, out)
        report = report if asked is None else asked.seen(report)
        reports.append(report)
        if len(orders) == 1:
            from grader.report import terminal  # noqa: PLC0415 - see NEEDED_LATER

            terminal.print_report(
                report,
                quotes=QUOTES,
                file=sys.stdout,
                verbose=verbose,
                show_hidden=show_hidden,
                path=written,
                own_code=order.own_code,
                more="" if asked is None else asked.more(report),
            )
        if report.environment.sandbox == "none":
            bare = say(
                "No sandbox was used: the package ran as your user, with access to your files."
            )
            click.echo(translate(bare), err=True)
    if not show_hidden:
        click.echo(translate(_hidden(orders[0].assignment.hidden_checks)))
    if len(orders) > 1:
        _print_matrix(reports, out, show_hidden=show_hidden)
    return 0 if all(report.all_passed for report in reports) else 1


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


def _hidden(count: int) -> str:
    if count == 0:
        return say("There are no hidden checks: your instructor's grader runs the same ones.")
    return say_plural(
        "Your instructor's grader also runs 1 hidden check.",
        "Your instructor's grader also runs {count} hidden checks.",
        count,
    )
