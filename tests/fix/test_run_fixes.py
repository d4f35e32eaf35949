"""Fixes of mistakes that only a build or a run shows, as named by the real verdict."""

from __future__ import annotations

from pathlib import Path

import pytest

from grader.cli.fix_package import FixRequest, make_plan
from grader.mistakes.catalogue import CATALOGUE, fixes_for
from grader.mistakes.fixes.case import Case, Finding
from grader.package.edit.files import Files
from grader.package.edit.tree import Replace
from grader.verdict.order import make_orders
from tests.corpus.broken import BROKEN
from tests.corpus.build import SOLUTION, write
from tests.corpus.model import NODE, SETUP, Package
from tests.fix.corpus_fixes import TOOLS, edited, with_tool
from tests.fixing import first_fix, patch_for
from tests.marking import ASSIGNMENT, taken_in
from tests.recorded import mark

# The only fix of these is exactly the solution.
BACK_TO_SOLUTION = (
    *("setup_syntax_error", "setup_prints"),
    *("import_node_missing", "super_missing", "super_after_timer", "super_without_name"),
    *("init_single_underscores", "not_a_node", "dash_in_node_name"),
    *("rclpy_init_missing", "rclpy_init_after_node", "main_of_another_name", "main_misspelt"),
    *("main_wants_args", "callback_misspelt", "callback_without_self_dot"),
    *("timer_arguments_swapped", "period_missing", "period_as_text", "create_timer_misspelt"),
    *("spin_of_class", "spin_not_called", "spin_once", "callback_without_self"),
    *("callback_wants_message", "get_logger_not_called", "logger_misspelt", "logger_with_comma"),
    *("counter_not_set", "counter_without_self", "counter_local"),
    *("timer_missing", "period_in_milliseconds", "logged_as_debug", "brackets_behind_callback"),
    "wrong_node_name",
    "counter_constant",
    *("printed", "logged_as_warning"),
    *("period_half", "period_slightly_long"),
)
OTHERWISE = {
    "init_missing": "my_robot_controller/__init__.py",
    "spin_missing": "rclpy.spin(node)",
    "f_prefix_missing": "f'Hello time: {self.counter_}'",
}
# A verdict takes seconds:
# one in `make test`, one more in CI, the others in the long run
REAL_IN_CI = ("setup_prints", "counter_not_set")
# Only the student knows what these should be.
NOT_FIXED = {
    "raises_at_import",
    "text_of_another_course",
    *("setup_exits", "setup_raises", "ignores_interrupt", "main_empty"),
    "log_line_forgotten",
}
FIXED_AFTER_A_RUN = [
    kind.id
    for kind in CATALOGUE.values()
    if kind.fixed_by and kind.id.startswith(("build.", "node.", "run."))
]


def package(name: str) -> Package:
    return next(p for p in BROKEN if p.name == name)


def patches(name: str, folder: Path) -> list[str]:
    """Return the patches of a corpus package's failed checks, as in its report."""
    root = write(package(name), folder)
    report = mark(root)
    results = [report.check(check) for check in package(name).expect_failed]
    return [patch_for(result, taken_in(root), ASSIGNMENT) for result in results]


@pytest.mark.parametrize("tool", TOOLS, ids=lambda tool: str(tool[0]))
@pytest.mark.parametrize("name", BACK_TO_SOLUTION)
def test_the_patch_restores_the_solution(name: str, tool: tuple[str, ...], tmp_path: Path) -> None:
    patch = patches(name, tmp_path)[0]
    assert patch
    fixed = with_tool(tool, patch.encode(), tmp_path / name)
    for path in (NODE, SETUP):
        assert (fixed / path).read_bytes() == (SOLUTION / path).read_bytes()


@pytest.mark.parametrize("name", OTHERWISE)
def test_the_patch_holds_the_fix_and_the_verdict_is_full_after_it(
    name: str, tmp_path: Path
) -> None:
    patch = patches(name, tmp_path)[0]
    assert OTHERWISE[name] in patch
    assert mark(with_tool(TOOLS[0], patch.encode(), tmp_path / name)).all_passed


@pytest.mark.parametrize("name", sorted(NOT_FIXED))
def test_an_uncertain_mistake_has_no_patch(name: str, tmp_path: Path) -> None:
    assert set(patches(name, tmp_path)) == {""}


@pytest.mark.parametrize("mistake", FIXED_AFTER_A_RUN)
def test_right_code_is_never_changed(mistake: str, tmp_path: Path) -> None:
    files = Files.of(taken_in(edited(tmp_path)))
    case = Case(files, Finding("run.output", mistake), ASSIGNMENT)
    assert first_fix(case, fixes_for(case.finding)) is None


@pytest.mark.prefix
@pytest.mark.parametrize(
    "name",
    [
        pytest.param(name, marks=pytest.mark.full if name in REAL_IN_CI else pytest.mark.long)
        for name in (*BACK_TO_SOLUTION, *OTHERWISE)
    ],
)
def test_the_real_verdict_has_full_marks_after_the_fix(name: str, tmp_path: Path) -> None:
    root = write(package(name), tmp_path)
    limits = ("build_seconds=30", "start_seconds=15")
    (order,) = make_orders(root, "hello_time", "jazzy", "bubblewrap", limits, own_code=True)
    plan = make_plan(FixRequest(order=order), taken_in(root), notify=print)
    assert not plan.left, plan.left
    assert plan.patch


@pytest.mark.parametrize(
    "line",
    [
        "self.create_timer(PERIOD, self.timer_callback)",
        "self.create_timer(1.0, partial(self.timer_callback))",
        "self.create_timer(1.0, self.callbacks[0])",
        "self.create_timer(1.0, lambda: self.timer_callback())",
        "self.create_timer(period(), self.timer_callback())\n        self.create_timer(2.0, None)",
    ],
)
def test_unrecognised_code_is_left_unchanged(line: str, tmp_path: Path) -> None:
    root = edited(tmp_path, Replace(NODE, "self.create_timer(1.0, self.timer_callback)", line))
    files = Files.of(taken_in(root))
    for mistake in ("node.callback_called", "run.wrong_period", "node.callback_misspelt"):
        case = Case(files, Finding("run.period", mistake), ASSIGNMENT)
        assert first_fix(case, fixes_for(case.finding)) is None
