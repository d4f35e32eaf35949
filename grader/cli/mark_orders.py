"""Marks one package on one or several distros and prints the result, for `grade` and `check`."""

from __future__ import annotations

import sys
from pathlib import Path

import click

from grader.base.i18n.message import say, say_plural
from grader.base.i18n.translator import Translator
from grader.report import files, terminal
from grader.report.model import Report
from grader.verdict.checks.all import QUOTES
from grader.verdict.mark import grade
from grader.verdict.order import Order


def mark_orders(orders: list[Order], out: Path | None, *, verbose: bool, show_hidden: bool) -> int:
    """Mark each order, print the report (of several distros a matrix), return the exit status.

    The reports are written to `out` unless it is None.
    """
    translate = Translator(orders[0].lang)
    reports: list[Report] = []
    for order in orders:
        with terminal.LiveProgress(sys.stderr, lang=order.lang) as progress:
            report = grade(order, progress)
        reports.append(report)
        if out is not None:
            written = files.write_report(report, out, report.submission.name)
        if len(orders) == 1:
            terminal.print_report(
                report,
                quotes=QUOTES,
                file=sys.stdout,
                verbose=verbose,
                show_hidden=show_hidden,
                path=written if out is not None else None,
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
        if out is not None:
            matrix = files.write_matrix(reports, out, reports[0].submission.name)
        terminal.print_matrix(
            reports,
            file=sys.stdout,
            show_hidden=show_hidden,
            path=matrix if out is not None else None,
        )
    return 0 if all(report.all_passed for report in reports) else 1


def _hidden(count: int) -> str:
    if count == 0:
        return say("There are no hidden checks: your instructor's grader runs the same ones.")
    return say_plural(
        "Your instructor's grader also runs 1 hidden check.",
        "Your instructor's grader also runs {count} hidden checks.",
        count,
    )
