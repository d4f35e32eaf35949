"""The page of one report: its content and its usefulness to a student."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from grader.report.page import Page
from tests.report.samples import (
    COMMAND,
    TITLES,
    check,
    failing_report,
    misspelt_module,
    render_report,
    report,
)


def words(text: str) -> str:
    """Return the text without its line breaks and indentation."""
    return " ".join(text.split())


def line_of(text: str, start: str) -> str:
    return next(line for line in text.splitlines() if line.lstrip().startswith(start))


def test_the_head_names_student_package_and_folder() -> None:
    page = render_report(failing_report())
    assert page.splitlines()[0] == "Your first ROS 2 node: Hello time"
    for output in ("anna", "my_robot_controller", "jazzy", "bubblewrap", "virtual clock"):
        assert output in page.partition("package.found")[0]


@pytest.mark.parametrize("width", [40, 80, 200])
def test_every_check_has_a_line_with_mark_and_points(width: int) -> None:
    page = render_report(failing_report(), width=width)
    for check_id, (title, most) in TITLES.items():
        result = failing_report().check(check_id)
        mark = {"passed": "pass", "failed": "FAIL", "skipped": "skip"}[result.status]
        given = most if result.status == "passed" else 0
        assert re.search(rf"^{mark} +{check_id} .* ?{given} / {most}$", page, re.MULTILINE)
        assert title in words(re.sub(r" [0-9]+ / [0-9]+$", "", page, flags=re.MULTILINE))


def test_the_total_is_a_line_of_its_own() -> None:
    assert line_of(render_report(report()), "Score").startswith("Score 100 / 100")
    # 100 - 15 for the failed check - 30 for the skipped ones
    assert line_of(render_report(failing_report()), "Score").startswith("Score 55 / 100 ")


def test_unknown_points_are_shown_and_are_not_zero() -> None:
    late = check("run.period", "inconclusive", actual="3 of 10 lines came late")
    page = render_report(report(late, score=96))
    assert line_of(page, "Score").startswith("Score 96 / 100, 4 inconclusive")
    assert re.search(r"^\? +run\.period .* - / 4$", page, re.MULTILINE)
    assert "3 of 10 lines came late" in page
    assert "No points given or taken" in page
    assert "next" not in page  # there is nothing for the student to fix


def test_fractions_of_points_are_written_naturally() -> None:
    page = render_report(report(check("run.output", "failed", score=2.5), score=92.5))
    assert "Score 92.5 / 100" in page
    assert "2.5 / 10" in page
    thirds = render_report(report(score=100 / 3))
    assert "Score 33.33 / 100" in thirds


def test_a_check_with_an_internal_error_is_the_graders_fault() -> None:
    page = render_report(report(check("run.logger", "error", actual="KeyError: 'x'"), score=97))
    assert "ERR run.logger" in page
    assert "this is a fault of the grader" in words(page)


@pytest.mark.parametrize("width", [40, 80, 200])
def test_a_failed_check_has_all_details(width: int) -> None:
    page = render_report(failing_report(), width=width)
    failed = misspelt_module()
    block = page.partition("FAIL entry_point.mapping:")[2].partition("Skipped because")[0]
    for output in (failed.title, failed.rationale, failed.fix):
        assert output in words(block)
    # a narrow page may break these, which have no spaces to break at
    assert failed.expected.replace(" ", "") in re.sub(r"\s", "", block)
    assert failed.actual.replace(" ", "") in re.sub(r"\s", "", block)
    assert "setup.py:23" in block
    assert "entry_point.module_misspelt" in block
    assert [line.strip() for line in block.splitlines() if ":main'," in line] == [
        "change    -            'test_node = my_robot_controller.my_frist_node:main',"
        if width > 40
        else "-            'test_node = my_robot_controller.my_frist_node:main',",
        "+            'test_node = my_robot_controller.my_first_node:main',",
    ]


def test_the_evidence_of_the_stage_that_failed_is_shown_once_with_a_bar() -> None:
    page = render_report(failing_report())
    assert "  | ModuleNotFoundError: No module named 'my_robot_controller.my_frist_node'" in page
    assert "Summary: 1 package finished" not in page  # the build went well
    more = failing_report(
        checks=[
            check("build.colcon", "failed"),
            check("run.starts", "failed"),
            check("run.output", "failed"),
        ]
    )
    page = render_report(more)
    assert page.count("ModuleNotFoundError") == 1
    assert page.index("| Summary: 1 package finished") < page.index("FAIL run.starts:")


def test_a_long_log_is_shown_from_its_traceback_to_its_end() -> None:
    failed = check("build.colcon", "failed")
    log = "\n".join(f"line {number}" for number in range(500))
    page = render_report(report(failed, evidence={"build_log": log, "transcript": ""}))
    assert "of 500 lines" in page
    assert "| line 499" in page
    assert "| line 400" not in page
    frames = "\n".join(f"  frame {number}" for number in range(20))
    log += f"\nTraceback (most recent call last):\n{frames}\nValueError: no"
    page = render_report(report(failed, evidence={"build_log": log, "transcript": ""}))
    assert "| Traceback (most recent call last):" in page
    assert "|   frame 0" in page
    assert "| ValueError: no" in page


def test_a_mistake_in_the_count_is_shown_without_what_ctrl_c_made_the_node_print() -> None:
    output = "[INFO] [1.0] [my_first_node]: Hello World\n^CTraceback: KeyboardInterrupt"
    evidence = {"build_log": "B", "transcript": output}
    page = render_report(report(check("run.output", "failed"), evidence=evidence))
    assert "| [INFO] [1.0] [my_first_node]: Hello World" in page
    assert "KeyboardInterrupt" not in page
    page = render_report(report(check("run.interrupt", "failed"), evidence=evidence))
    assert "KeyboardInterrupt" in page


def test_a_static_mistake_shows_no_logs() -> None:
    failed = check("source.shebang", "failed")
    page = render_report(report(failed, evidence={"build_log": "B", "transcript": "T"}))
    assert "printed" not in page


def test_logs_are_shown_for_failed_and_not_for_inconclusive_checks() -> None:
    late = check("run.period", "inconclusive", actual="3 of 10 lines came late")
    page = render_report(report(late, evidence={"build_log": "B", "transcript": "T"}))
    assert "printed" not in page


def test_skipped_checks_name_their_cause() -> None:
    page = words(render_report(failing_report()))
    assert (
        "Skipped because entry_point.mapping did not pass: run.starts, run.node_name, run.output, "
        "run.logger, run.period, run.interrupt" in page
    )


def test_without_blocked_by_the_cause_is_found_through_the_dependencies() -> None:
    page = words(
        render_report(
            report(
                check("build.colcon", "failed"),
                check("run.starts", "skipped", depends=["build.colcon", "package.found"]),
                check("run.output", "skipped", depends=["run.starts"]),
            )
        )
    )
    assert "Skipped because build.colcon did not pass: run.starts, run.output" in page


def test_circular_dependencies_are_handled() -> None:
    page = render_report(
        report(
            check("run.starts", "skipped", depends=["run.output"], actual="never asked"),
            check("run.output", "skipped", depends=["run.starts"], actual="never asked"),
        )
    )
    assert "Skipped never asked: run.starts, run.output" in page


def test_advice_of_passed_checks_is_shown_and_costs_nothing() -> None:
    page = words(render_report(failing_report()))
    assert "no points are lost) source.exec_bit: The bit is not needed by ros2 run" in page


def test_the_end_says_what_to_do_next_and_where_the_files_are() -> None:
    path = Path("reports/anna/jazzy/report.json")
    end = render_report(failing_report(), path=path).splitlines()[-4:]
    assert "Fix entry_point.mapping (in setup.py, line 23)" in end[0]
    assert end[-2].endswith(COMMAND)
    assert end[-1].endswith(str(path))


def test_next_is_the_failure_that_stops_the_most() -> None:
    minor = check("source.exec_bit", "failed", where={"file": "node.py", "line": None})
    page = words(render_report(failing_report(checks=[minor, *failing_report().checks[6:]])))
    assert "next Fix entry_point.mapping (in setup.py, line 23), save, and grade again." in page
    consequence = check("run.starts", "failed", consequence_of="run.output")
    page = words(render_report(report(consequence, check("run.output", "failed"))))
    assert "next Fix run.output, save" in page


RENAMED = "diff --git a/a.txt b/a\nsimilarity index 100%\nrename from a.txt\nrename to a\n"
MODE = "diff --git a/n.py b/n.py\nold mode 100644\nnew mode 100755\n"
EDITED = f"{RENAMED}--- a/a.txt\n+++ b/a\n@@ -1 +1 @@\n-x\n+y\n"


@pytest.mark.parametrize(
    ("fields", "said"),
    [
        ({"patch": RENAMED}, "(n.py), then grade again."),
        ({"patch": MODE, "fix": "Run: chmod +x n.py"}, "(n.py), then grade again."),
        ({"fix": "Rename it. In the package's folder, run: mv a b"}, "(n.py), then grade again."),
        ({"patch": EDITED}, "(in n.py), save, and grade again."),
        ({"fix": "Write my_mv instead"}, "(in n.py), save, and grade again."),
    ],
)
def test_next_asks_to_save_only_after_an_edit(fields: dict[str, str], said: str) -> None:
    where = {"file": "n.py", "line": None}
    found = check("source.node_file", "failed", where=where, **fields)
    assert f"next Fix source.node_file {said}" in words(render_report(report(found)))


def test_a_student_is_told_to_check_again_and_not_to_grade() -> None:
    end = words(render_report(failing_report(), own_code=True))
    assert "next Fix entry_point.mapping (in setup.py, line 23), save, and run check again." in end
    assert "grade again" not in end
    nowhere = report(check("run.starts", "failed"))
    assert "Fix run.starts, save, and run check again." in words(
        render_report(nowhere, own_code=True)
    )


@pytest.mark.parametrize("width", [40, 80])
def test_commands_paths_and_patches_are_not_wrapped(width: int) -> None:
    path = Path("/home/anna/a rather long folder name/reports/anna/jazzy/report.json")
    lines = [line.strip() for line in render_report(failing_report(), width=width, path=path)
             .splitlines()]  # fmt: skip
    assert any(line.endswith(COMMAND) for line in lines)
    assert any(line.endswith(str(path)) for line in lines)


def test_a_change_of_a_whole_function_is_shown_whole_and_once() -> None:
    lines = [f"+line {number}" for number in range(40)]
    first = check("run.spins", "failed", patch="\n".join(lines))
    second = check("run.output", "failed", patch="\n".join(lines), consequence_of="run.spins")
    page = render_report(report(first, second))
    for line in lines:
        assert page.count(f"{line}\n") == 1


def test_a_grader_failure_is_not_shown_as_the_students() -> None:
    page = render_report(
        report(status="error", message="no sandbox\nInstall bubblewrap.", checks=[], score=0)
    )
    assert "Not graded: no sandbox" in page
    assert "Install bubblewrap." in page
    assert "fault of the grader" in page


def test_a_submission_without_a_package_is_shown() -> None:
    gone = check("package.found", "failed", actual="no package.xml below this folder")
    submission = failing_report().submission.model_copy(
        update={"package": None, "student_id": "s-17", "notes": ["2 files were too large"]}
    )
    page = render_report(report(gone, submission=submission, observed={}))
    assert "none was found" in page
    assert "anna (s-17)" in page
    assert "2 files were too large" in page
    assert "ros2 run" not in page.partition("Score")[2]


def test_verbose_adds_versions_limits_times_ticks_and_all_evidence() -> None:
    page = words(render_report(failing_report(), verbose=True))
    for output in (
        "rclpy 7.1.6",
        "memory 1,000,000,000 bytes, enforced by cgroup",
        "build 2.10 s",
        "/my_first_node",
        "Hello time: 0 at 1.000 s",
        "| Summary: 1 package finished [1.90s]",
    ):
        assert output in page
        assert output not in words(render_report(failing_report()))
    assert page.count("ModuleNotFoundError") == 1


def test_hidden_checks_are_counted_and_not_described() -> None:
    secret = check(
        "secret.id",
        "failed",
        title="SECRET title",
        visibility="hidden",
        expected="SECRET expected",
        actual="SECRET actual",
        rationale="SECRET why",
        fix="SECRET fix",
        patch="SECRET patch",
        advice=["SECRET advice"],
        mistakes=[{"id": "secret.mistake"}],
        where={"file": "SECRET.py", "line": 1},
    )
    later = check("secret.later", visibility="after_due_date", title="SECRET later",
                  advice=["SECRET advice"], actual="SECRET")  # fmt: skip
    waits = check("run.period", "skipped", blocked_by="secret.id", depends=["secret.id"],
                  actual="skipped because of: SECRET title")  # fmt: skip
    marked = report(secret, later, waits)
    for verbose in (False, True):
        page = render_report(marked, verbose=verbose)
        assert "secret" not in page.lower()
        assert "2 hidden checks: not shown" in page
        assert "Skipped because a hidden check did not pass: run.period" in page
    shown = render_report(marked, show_hidden=True)
    assert "FAIL secret.id: SECRET title" in shown
    assert "not shown" not in shown


@pytest.mark.parametrize("status", ["passed", "failed", "skipped", "inconclusive", "error"])
def test_the_page_depends_only_on_its_arguments(
    status: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    marked = report(check("run.output", status, expected="a", actual="b"))
    before = [render_report(marked, styled=styled) for styled in (False, True)]
    for name, value in {
        "COLUMNS": "33", "LINES": "3", "TERM": "dumb", "NO_COLOR": "1", "FORCE_COLOR": "1",
        "JUPYTER_COLUMNS": "20", "COLORTERM": "truecolor", "LANG": "C",
    }.items():  # fmt: skip
        monkeypatch.setenv(name, value)
    assert [render_report(marked, styled=styled) for styled in (False, True)] == before


def test_a_heading_over_short_names_stays_on_one_line() -> None:
    page = Page(width=80, styled=False)
    page.grid(["student", "points"], [[("ann", ""), ("3", "")], [("bo", ""), ("12", "")]])
    assert [line.split() for line in str(page).splitlines()] == [
        ["student", "points"],
        ["ann", "3"],
        ["bo", "12"],
    ]


@pytest.mark.parametrize("styled", [False, True])
def test_a_diff_keeps_what_a_tool_compares(*, styled: bool) -> None:
    rows = (
        "--- a/node.py",
        "+++ b/node.py",
        "@@ -1,2 +1,2 @@",
        " x = 1  ",
        "-\ty = 2",
        "+    y = 2",
    )
    failed = check("source.node_file", "failed", patch="\n".join(rows) + "\n")
    page = render_report(report(failed), styled=styled)
    for row in rows:
        assert row in page
