"""The page of several distros: the differences and their causes."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from grader.report.model import CheckResult, Report
from grader.report.terminal import render_matrix
from tests.report.samples import TITLES, check, failing_report, misspelt_module, report

DISTROS = ["humble", "jazzy", "kilted", "lyrical", "rolling"]


def report_on(distro: str, *changed: CheckResult, marked: Report | None = None) -> Report:
    clean = marked or report(*changed)
    environment = clean.environment.model_copy(update={"distro": distro})
    return clean.model_copy(update={"environment": environment})


def words(text: str) -> str:
    return " ".join(text.split())


def test_rows_are_checks_and_columns_distros() -> None:
    page = render_matrix([report_on("humble"), report_on("jazzy", marked=failing_report())])
    assert re.search(r"^ +humble +jazzy$", page, re.MULTILINE)
    for check_id in TITLES:
        status = failing_report().check(check_id).status
        mark = {"passed": "pass", "failed": "FAIL", "skipped": "skip"}[status]
        assert re.search(rf"^{check_id} +pass +{mark}$", page, re.MULTILINE)
    assert re.search(r"^Score +100 / 100 +55 / 100$", page, re.MULTILINE)


def test_differences_and_their_causes_are_listed_below() -> None:
    late = check("run.interrupt", "failed", actual="it went on for 5 s")
    reports = [
        report_on("humble"),
        report_on("jazzy", marked=failing_report()),
        report_on("kilted", late),
    ]
    page = words(render_matrix(reports).partition("What differs:")[2])
    assert (
        "entry_point.mapping humble, kilted: passed "
        "jazzy: failed: test_node = my_robot_controller.my_frist_node:main" in page
    )
    assert (
        "run.starts, run.node_name, run.output, run.logger, run.period humble, kilted: passed "
        "jazzy: skipped because entry_point.mapping did not pass" in page
    )
    assert "kilted: failed: it went on for 5 s" in page
    assert "FAIL entry_point.mapping: setup.py maps" in page
    assert misspelt_module().fix in page


def test_equal_distros_are_reported_as_equal_and_each_mistake_once() -> None:
    reports = [report_on(distro, misspelt_module(seconds=n)) for n, distro in enumerate(DISTROS)]
    page = render_matrix(reports)
    assert "The same on every distro." in page
    assert page.count("FAIL entry_point.mapping:") == 1
    assert "(on " not in page


def test_different_causes_on_different_distros_are_distinguished() -> None:
    page = words(
        render_matrix(
            [
                report_on("humble", check("run.starts", "failed", actual="no rclpy")),
                report_on("jazzy", check("run.starts", "failed", actual="no rclpy")),
                report_on("kilted", check("run.starts", "failed", actual="no main")),
            ]
        )
    )
    assert page.count("FAIL run.starts:") == 2
    assert "(on humble, jazzy) found no rclpy" in page
    assert "(on kilted) found no main" in page


@pytest.mark.parametrize("width", [40, 60, 80, 120])
def test_every_distro_has_its_column_on_every_terminal(width: int) -> None:
    page = render_matrix([report_on(distro) for distro in DISTROS], width=width)
    grid = page.partition("ros2_ws/src/my_robot_controller\n")[2].partition("The same")[0]
    for distro in DISTROS:
        assert re.search(rf"\b{distro}\b", grid)
    assert len(re.findall(r"100 / 100", grid)) == len(DISTROS)
    assert max(len(line) for line in grid.splitlines()) <= width
    assert ("\n\n" in grid.partition("Score")[2].rstrip()) == (width < 80)


def test_unknown_points_have_a_row() -> None:
    late = check("run.period", "inconclusive")
    page = render_matrix([report_on("humble"), report_on("jazzy", late)])
    assert re.search(r"^inconclusive +0 +4$", page, re.MULTILINE)


def test_a_distro_that_could_not_be_marked_is_named_with_its_reason() -> None:
    broken = report(status="error", message="no image for it", checks=[], score=0)
    page = words(render_matrix([report_on("humble"), report_on("rolling", marked=broken)]))
    assert "Not graded on rolling: no image for it" in page
    assert "rolling: not checked there" in page


def test_hidden_checks_are_counted_and_not_described() -> None:
    secret = check("secret.id", "failed", title="SECRET", actual="SECRET", visibility="hidden")
    waits = check("run.period", "skipped", blocked_by="secret.id", actual="because of: SECRET")
    reports = [report_on("humble", secret, waits), report_on("jazzy")]
    page = render_matrix(reports)
    assert "secret" not in page.lower()
    assert "1 hidden check: not shown" in page
    assert "skipped because a hidden check did not pass" in page
    assert "FAIL secret.id: SECRET" in render_matrix(reports, show_hidden=True)


def test_the_path_of_the_matrix_is_shown() -> None:
    path = Path("reports/anna/matrix.json")
    assert render_matrix([report_on("humble")], path=path).splitlines()[-1].endswith(str(path))
