"""Marks one package on one or several distros and prints the result, for `grade` and `check`."""

from __future__ import annotations

import importlib
import sys
import threading
from pathlib import Path
from typing import TYPE_CHECKING

import click

from grader.base.i18n.message import say, say_plural
from grader.base.i18n.translator import Translator
from grader.base.signing import own_key
from grader.report import events
from grader.report.live import LiveProgress
from grader.report.model import Report
from grader.verdict.checks.all import QUOTES
from grader.verdict.mark import grade
from grader.verdict.order import Order

if TYPE_CHECKING:
    from grader.verdict.evidence_file import Judged

# needed after the build only, which leaves the time to import them
NEEDED_LATER = (
    "grader.report.files",
    "grader.report.report_page",
    "grader.report.terminal",
    "grader.verdict.evidence_file",
)


def mark_orders(orders: list[Order], out: Path | None, *, verbose: bool, show_hidden: bool) -> int:
    """Mark each order, print the report (of several distros a matrix), return the exit status.

    The reports and their evidence are written to `out` unless it is None.
    """
    if out is not None:
        own_key()  # a key that cannot be used is said before anything is marked
    translate = Translator(orders[0].lang)
    reports: list[Report] = []
    for order in orders:
        kept: list[Judged] = []
        with LiveProgress(sys.stderr, lang=order.lang) as progress:
            report = grade(order, _Listener(progress), keep=kept.append)
        reports.append(report)
        written = None if out is None else _write(report, kept[0], order, out)
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
