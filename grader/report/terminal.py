"""The renderer for a terminal: the live line during the work, and the report afterwards.

The output is a pure function of the report, of the width and of whether the file is a terminal
that takes styles. rich is imported when the first page is rendered, not before.
"""

from __future__ import annotations

import sys
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, TextIO

from grader.base.gate import show
from grader.base.stream import is_terminal, takes_styles, width_of
from grader.report.live import LiveProgress

if TYPE_CHECKING:
    from pathlib import Path

    from grader.report.model import Quote, Report
    from grader.report.one_screen import Lead

__all__ = [
    "LiveProgress",
    "print_matrix",
    "print_one_screen",
    "print_report",
    "render_matrix",
    "render_report",
]


def render_report(
    report: Report,
    *,
    quotes: Mapping[str, Quote],
    width: int = 80,
    styled: bool = False,
    verbose: bool = False,
    show_hidden: bool = False,
    path: Path | None = None,
    own_code: bool = False,
    more: str = "",
) -> str:
    """Return the page of a report, `width` columns wide; ASCII except for the report's own text.

    `quotes` has what of the evidence each check quotes, by its id. `verbose` adds versions, limits,
    times and the whole evidence. Checks that are not `visible` are only counted, unless
    `show_hidden`. `path` is where the report was written. `own_code` means that a student reads
    about their own package; `more` then says how to get the next hint.
    """
    from grader.report.report_page import report_page  # noqa: PLC0415 - rich costs 35 ms

    return report_page(
        report,
        quotes=quotes,
        width=width,
        styled=styled,
        verbose=verbose,
        show_hidden=show_hidden,
        path=path,
        own_code=own_code,
        more=more,
    )


def render_matrix(
    reports: Sequence[Report],
    *,
    width: int = 80,
    styled: bool = False,
    show_hidden: bool = False,
    path: Path | None = None,
) -> str:
    """Return the page of one submission on several distros: checks by distro, and differences.

    ValueError if there is no report, or if they are of several submissions.
    """
    from grader.report.matrix_page import matrix_page  # noqa: PLC0415 - rich costs 35 ms

    return matrix_page(reports, width=width, styled=styled, show_hidden=show_hidden, path=path)


def print_report(
    report: Report,
    *,
    quotes: Mapping[str, Quote],
    file: TextIO | None = None,
    verbose: bool = False,
    show_hidden: bool = False,
    path: Path | None = None,
    own_code: bool = False,
    more: str = "",
) -> None:
    """Print a report (see `render_report`) to `file`, by default standard output."""
    file = file or sys.stdout
    text = render_report(
        report,
        quotes=quotes,
        width=width_of(file),
        styled=takes_styles(file),
        verbose=verbose,
        show_hidden=show_hidden,
        path=path,
        own_code=own_code,
        more=more,
    )
    show(text, file)


def print_one_screen(
    report: Report, lead: Lead, *, file: TextIO | None = None, show_hidden: bool = False
) -> None:
    """Print what fits on one screen (see `grader.report.one_screen`), by default to standard output.

    Paths are links where `file` is a terminal.
    """
    from grader.report.one_screen import one_screen  # noqa: PLC0415 - rich costs 35 ms

    file = file or sys.stdout
    text = one_screen(
        report,
        lead if is_terminal(file) else replace(lead, links={}),
        width=width_of(file),
        styled=takes_styles(file),
        show_hidden=show_hidden,
    )
    show(text, file)


def print_matrix(
    reports: Sequence[Report],
    *,
    file: TextIO | None = None,
    show_hidden: bool = False,
    path: Path | None = None,
) -> None:
    """Print the reports of one submission on several distros (see `render_matrix`)."""
    file = file or sys.stdout
    text = render_matrix(
        reports,
        width=width_of(file),
        styled=takes_styles(file),
        show_hidden=show_hidden,
        path=path,
    )
    show(text, file)
