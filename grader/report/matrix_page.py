"""The page of one submission on several distros: checks by distro, differences and reasons."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from grader.base.i18n.message import joined, say
from grader.base.i18n.translator import Translator
from grader.base.plain_text import first_lines, one_line, points
from grader.report.blocks import MARKS, UNSEEN, WORDS, block, roots
from grader.report.matrix import CheckAcross, Matrix, matrix_of
from grader.report.page import Page
from grader.report.report_page import hidden_checks

if TYPE_CHECKING:
    from pathlib import Path

    from grader.report.model import CheckResult, Report

LINES = 12  # per text


def matrix_page(
    reports: Sequence[Report],
    *,
    width: int,
    styled: bool,
    show_hidden: bool,
    path: Path | None,
) -> str:
    """Return the page as a string; it depends on the arguments alone. ValueError as `matrix_of`."""
    matrix = matrix_of(reports)
    page = Page(width=width, styled=styled, translate=Translator(reports[0].lang))
    shown = [c for c in matrix.checks if show_hidden or c.visibility == "visible"]
    _head(page, matrix)
    _grid(page, matrix, shown)
    hidden = len(matrix.checks) - len(shown)
    if hidden:
        page.line(hidden_checks(hidden))
    for distro, total in matrix.distros.items():
        if total.status == "error":
            page.gap()
            page.line((say("Not graded on {distro}: ", distro=one_line(distro)), "bold magenta"))
            page.line(
                "\n".join(first_lines(total.message, lines=8, translate=page.translate)), indent=2
            )
    _differences(page, reports, shown)
    _blocks(page, reports, {check.id for check in shown})
    page.gap()
    if path is not None:
        page.code(say("report"), [one_line(str(path), most=4_000)])
    return str(page)


def _head(page: Page, matrix: Matrix) -> None:
    page.line((one_line(matrix.assignment.title), "bold"))
    page.gap()
    who = matrix.submission
    page.field(say("student"), one_line(who.name, most=100))
    none = say("none was found")
    page.field(say("package"), one_line(who.package, most=100) if who.package else none)
    page.code(say("in"), [one_line(who.path, most=4_000)])
    page.gap()


def _grid(page: Page, matrix: Matrix, shown: Sequence[CheckAcross]) -> None:
    rows = []
    for check in shown:
        cells = [(one_line(check.id, most=60), "bold" if check.differs else "")]
        for distro in matrix.distros:
            cell = check.distros.get(distro)
            cells.append(("-", "") if cell is None else MARKS[cell.status])
        rows.append(cells)
    scores: list[tuple[str, str]] = [(say("Score"), "bold")]
    scores += [
        (f"{points(t.score)} / {points(t.max_score)}", "bold") for t in matrix.distros.values()
    ]
    rows.append(scores)
    if any(total.inconclusive for total in matrix.distros.values()):
        rows.append(
            [(say("inconclusive"), "")]
            + [(points(total.inconclusive), "") for total in matrix.distros.values()]
        )
    page.grid(["", *(one_line(distro, most=20) for distro in matrix.distros)], rows)


def _differences(page: Page, reports: Sequence[Report], shown: Sequence[CheckAcross]) -> None:
    page.gap()
    differing = [check for check in shown if check.differs]
    if not differing:
        page.line(say("The same on every distro."))
        return
    page.line((say("What differs:"), "bold"))
    visible = {check.id for check in shown}
    groups: dict[tuple[str, ...], list[str]] = {}
    for check in differing:
        by_reason: dict[str, list[str]] = {}
        for report in reports:
            distro = one_line(report.environment.distro, most=40)
            by_reason.setdefault(_reason(report, check.id, visible), []).append(distro)
        lines: tuple[str, ...] = tuple(
            joined(", ".join(distros), reason, by=": ") for reason, distros in by_reason.items()
        )
        groups.setdefault(lines, []).append(one_line(check.id, most=60))
    for lines, ids in groups.items():
        page.line((", ".join(ids), "bold"), indent=2)
        for line in lines:
            page.line(line, indent=4)


def _reason(report: Report, check_id: str, shown: set[str]) -> str:
    check = next((check for check in report.checks if check.id == check_id), None)
    if check is None:
        return say("not checked there")
    if check.status == "skipped":
        names = dict.fromkeys(
            one_line(other.id, most=60) if other.id in shown else UNSEEN
            for other in roots(check, report.checks)
        )
        both = joined(*names, by=", ")
        because = say("skipped because {checks} did not pass", checks=both)
        return because if names else WORDS["skipped"]
    actual = one_line(check.actual.strip().partition("\n")[0], most=200)
    status = WORDS[check.status]
    return joined(status, actual, by=": ") if actual and check.status != "passed" else status


def _blocks(page: Page, reports: Sequence[Report], shown: set[str]) -> None:
    """Write each block once, with the distros on which it is the same."""
    groups: dict[str, tuple[CheckResult, list[str]]] = {}
    for report in reports:
        for check in report.checks:
            if check.id in shown and check.status not in ("passed", "skipped"):
                key = check.model_copy(update={"seconds": 0}).model_dump_json()
                group = groups.setdefault(key, (check, []))
                group[1].append(one_line(report.environment.distro, most=40))
    order = list(dict.fromkeys(check.id for report in reports for check in report.checks))
    for check, distros in sorted(groups.values(), key=lambda group: order.index(group[0].id)):
        page.gap()
        everywhere = len(distros) == len(reports)
        on = "" if everywhere else say(" (on {distros})", distros=", ".join(distros))
        block(page, check, lines=LINES, on=on)
