"""A small change of the node's files is looked for where a mistake has no fix, and tried like one."""

from __future__ import annotations

import subprocess
from contextlib import AbstractContextManager, nullcontext
from dataclasses import replace
from pathlib import Path

import pytest

from grader.base.i18n.translator import Translator
from grader.base.unheard import unheard
from grader.change.table import BY_SORT
from grader.package.submission import Submission
from grader.report.model import CheckResult, Report, Where
from grader.run.session import Session
from grader.run.variants import KILLED, ShortRun, Watched, run_variants
from grader.sandbox.choose import open_sandbox
from grader.verdict.evaluate import evaluate_checks
from grader.verdict.evidence import Evidence
from grader.verdict.evidence_file import Judged
from grader.verdict.found_change import NEARLY, WHOLE, FoundChange, Step
from grader.verdict.mark import mark, replay
from grader.verdict.recording import Recording, evidence_of, record
from grader.verdict.search import STEP, TEXT, level, value_texts
from grader.verdict.try_fixes import with_tried_fix
from tests import marking, recorded
from tests.corpus.broken import BROKEN
from tests.corpus.build import SOLUTION, write
from tests.corpus.right import RIGHT

ENGLISH = Translator("en")
BY_NAME = {package.name: package for package in (*BROKEN, *RIGHT)}
NODE = "my_robot_controller/my_first_node.py"
OUTPUT = marking.ASSIGNMENT.output
SECOND = 10**9
UNKNOWN = "logged_as_debug"  # whose usual fix is said not to help
KNOWN = "spin_in_init"


def run_of(*lines: tuple[float, str], ended: str = "time", steps: int = 9) -> ShortRun:
    """Return a short run with lines at instants in seconds."""
    return ShortRun(tuple((round(at * SECOND), "node", text) for at, text in lines), ended, steps)


def counting(*, period: float = 1.0, step: int = 1, text: str = "Hello time: {}") -> ShortRun:
    return run_of(*(((k + 1) * period, text.format(k * step)) for k in range(8)))


LEVELS = [
    (ShortRun((), "ImportError 3", 0), 0),
    (KILLED, 0),
    (ShortRun((), "TypeError 12", 1), 1),
    (ShortRun((), "waits", 0), 2),
    (replace(counting(), ended="waits"), WHOLE),
    (run_of(), 2),
    (run_of((1, "hello"), (2, "hello")), 3),
    (counting(text="Hello Time: {}"), 3),
    (counting(step=2), TEXT),
    (run_of(*((k, f"Hello time: {k + 1}") for k in range(8))), STEP),
    (counting(period=0.5), NEARLY),
    (counting(), WHOLE),
    (replace(counting(), ended="lines"), WHOLE),
    (replace(counting(), slept=True), NEARLY),
    (run_of(*((k + 1.1, f"Hello time: {k}") for k in range(8))), NEARLY),
    (replace(counting(), ended="RecursionError 7"), 1),
    (replace(counting(), ended="killed"), 1),
    (run_of(*((k + 1, f"Hello time: {k}") for k in range(10)), ended="killed"), WHOLE),
    (run_of((0, "ready"), *((k + 1, f"Hello time: {k}") for k in range(8))), WHOLE),
]


@pytest.mark.parametrize(("run", "expected"), LEVELS)
def test_a_short_run_shows_how_far_a_node_gets(run: ShortRun, expected: int) -> None:
    assert level(run, OUTPUT) == expected


def recording_of(name: str, folder: Path) -> tuple[Recording, Submission]:
    submission = marking.taken_in(write(BY_NAME[name], folder / "tried"))
    return Recording.from_bytes(recorded.file_of(submission).read_bytes()), submission


def found_with(
    name: str, folder: Path, found: list[FoundChange], then: str, known: str = ""
) -> tuple[CheckResult, Evidence]:
    """Return a package's first failure where changes are found; each shows what `then` does.

    A known fix shows what `known` does, without it the same as the package.
    """
    recording, submission = recording_of(name, folder)
    evidence = evidence_of(recording, submission, marking.ASSIGNMENT)
    after, _ = recording_of(then, folder / "then")
    usual = recording_of(known, folder / "known")[0] if known else recording

    def with_fix(_digest: str, fixed: Submission) -> AbstractContextManager[Evidence]:
        is_found = any(b"# changed" in file.data for file in fixed.files)
        shown = after if is_found else usual
        shown = shown.model_copy(update={"submission": fixed.sha256})
        return nullcontext(evidence_of(shown, fixed, marking.ASSIGNMENT))

    evidence.with_fix = with_fix
    evidence.search = lambda _: found
    failed = next(r for r in evaluate_checks(evidence, ENGLISH) if r.status == "failed")
    return with_tried_fix(failed, evidence, ENGLISH), evidence


def change(line: int, *sorts: str) -> FoundChange:
    """Return a change of the solution's file, at a line."""
    steps = [Step(sort, NODE, line, "old", "new") for sort in sorts or ("number",)]
    text = (SOLUTION / NODE).read_text() + "# changed\n"
    row = BY_SORT[steps[-1].sort]
    return FoundChange(tuple(steps), {NODE: text}, 3, shows=row.shows, certain=row.certain)


def ids(result: CheckResult) -> list[str]:
    return [mistake.id for mistake in result.mistakes]


def texts(result: CheckResult) -> dict[str, object]:
    return result.model_dump(exclude={"seconds"})


def test_what_was_only_seen_is_replaced_by_a_change_that_helps(tmp_path: Path) -> None:
    result, _ = found_with(UNKNOWN, tmp_path, [change(14)], "solution")
    assert ids(result) == ["node.change_helps", "run.no_lines"]
    assert "+# changed" in result.patch
    assert result.where == Where(file=NODE, line=14)
    assert "Write new instead of old." in result.fix


def test_a_change_that_does_not_help_is_not_shown(tmp_path: Path) -> None:
    result, found = found_with(UNKNOWN, tmp_path, [change(14)], UNKNOWN)
    assert ids(result) == ["run.no_lines"]
    assert result.patch == ""
    assert len(found.tried) > 1


def test_a_known_mistake_keeps_its_reason_and_gets_a_change_of_its_line(tmp_path: Path) -> None:
    before, _ = found_with(KNOWN, tmp_path / "before", [], KNOWN)
    assert before.where is not None
    assert before.where.line is not None
    result, _ = found_with(KNOWN, tmp_path, [change(before.where.line)], "solution")
    assert (result.mistakes, result.rationale) == (before.mistakes, before.rationale)
    assert (result.where, result.fix) == (before.where, "Write new instead of old.")
    assert result.patch


@pytest.mark.parametrize(
    "sorts", [("deleted",), ("number", "number")], ids=["only pass", "two changes"]
)
def test_a_known_mistake_gets_no_change_that_needs_words_of_its_own(
    sorts: tuple[str, ...], tmp_path: Path
) -> None:
    before, _ = found_with(KNOWN, tmp_path / "before", [], KNOWN)
    assert before.where is not None
    result, _ = found_with(KNOWN, tmp_path, [change(before.where.line or 0, *sorts)], "solution")
    assert texts(result) == texts(before)


ELSEWHERE = {
    "that may help by chance": change(1, "number"),
    "in another period": replace(change(1, "digits"), level=NEARLY),
    "of two places": change(1, "digits", "digits"),
}


@pytest.mark.parametrize("other", ELSEWHERE.values(), ids=ELSEWHERE)
def test_a_known_mistake_gets_no_change_of_another_line(other: FoundChange, tmp_path: Path) -> None:
    before, _ = found_with(KNOWN, tmp_path / "before", [], KNOWN)
    result, _ = found_with(KNOWN, tmp_path, [other], "solution")
    assert texts(result) == texts(before)


def test_a_certain_change_of_another_line_replaces_a_known_mistake(tmp_path: Path) -> None:
    before, _ = found_with(KNOWN, tmp_path / "before", [], KNOWN)
    found = [change(1, "digits")]
    result, _ = found_with(KNOWN, tmp_path / "helps", found, "solution")
    assert ids(result) == ["node.change_helps", *ids(before)[1:]]
    assert result.where == Where(file=NODE, line=1)
    assert result.fix == "Write new instead of old."
    result, _ = found_with(KNOWN, tmp_path / "not", found, KNOWN)
    assert texts(result) == texts(before)


def test_a_certain_change_comes_before_a_costly_one_of_the_own_line(tmp_path: Path) -> None:
    before, _ = found_with(KNOWN, tmp_path / "before", [], KNOWN)
    assert before.where is not None
    own, sure = change(before.where.line or 0), change(1, "digits")
    result, _ = found_with(KNOWN, tmp_path / "costly", [own, sure], "solution")
    assert ids(result)[0] == "node.change_helps"
    assert result.where == Where(file=NODE, line=1)
    slight = replace(own, cost=2)
    result, _ = found_with(KNOWN, tmp_path / "slight", [slight, sure], "solution")
    assert ids(result) == ids(before)
    assert result.patch


def test_of_changes_that_help_the_nearest_is_shown(tmp_path: Path) -> None:
    before, _ = found_with("text_other_capital", tmp_path / "before", [], "text_other_capital")
    assert before.where is not None
    line = before.where.line or 0
    found = [change(line + far) for far in (9, -3, 5)]
    result, _ = found_with("text_other_capital", tmp_path, found, "solution")
    assert result.where == Where(file=NODE, line=line - 3)


def test_a_change_after_which_only_the_text_is_right_is_told_as_that(tmp_path: Path) -> None:
    half = replace(change(14), level=TEXT)
    result, _ = found_with("text_other_capital", tmp_path, [half], "counter_constant")
    assert ids(result)[0] == "node.one_of_two"
    assert result.fix == "Write new instead of old. Then grade again."
    result, _ = found_with("text_other_capital", tmp_path / "again", [half], "text_other_capital")
    assert ids(result) == ["run.wrong_text"]


def test_two_changes_are_told_with_their_lines(tmp_path: Path) -> None:
    result, _ = found_with(UNKNOWN, tmp_path, [change(14, "number", "out")], "solution")
    assert (
        result.fix
        == "Line 14: Write new instead of old. Line 14: Move the line old out of the block: as far to the left as the head of the block."
    )
    assert "these changes together" in result.rationale
    assert result.patch


def test_a_change_that_takes_something_away_shows_the_place_alone(tmp_path: Path) -> None:
    result, _ = found_with(UNKNOWN, tmp_path, [change(14, "deleted")], "solution")
    assert result.where is not None
    assert result.where.line == 14
    assert "Look at the line old" in result.fix
    assert result.patch == ""


def test_long_code_is_left_to_the_change(tmp_path: Path) -> None:
    long = change(14)
    long = replace(long, steps=(replace(long.steps[0], written="x" * 100),))
    result, _ = found_with(UNKNOWN, tmp_path, [long], "solution")
    assert result.fix == "Make the change below."


def test_a_recording_has_the_changes_that_were_found(tmp_path: Path) -> None:
    recording, submission = recording_of(UNKNOWN, tmp_path)
    result, found = found_with(UNKNOWN, tmp_path / "again", [change(14)], "solution")
    written = record(found, recording.environment).to_bytes()
    report = replay(Recording.from_bytes(written), submission, marking.ASSIGNMENT)
    again = {check.id: check for check in report.checks}[result.id]
    assert (again.mistakes, again.patch, again.fix) == (result.mistakes, result.patch, result.fix)


def test_a_package_is_searched_once_and_only_if_a_fix_is_missing(tmp_path: Path) -> None:
    result, found = found_with(
        "counter_not_set", tmp_path, [change(14)], "solution", known="solution"
    )
    assert result.patch
    assert found.found_changes is None
    _, found = found_with(UNKNOWN, tmp_path / "again", [change(14)], "solution")
    assert found.found_changes == [change(14)]


LATE = """\
import rclpy
from rclpy.node import Node


class MyFirstNode(Node):
    def __init__(self):
        super().__init__("my_first_node")
        self.counter_ = 0

    def begin(self):
        self.create_timer(1.0, self.timer_callback)

    def timer_callback(self):
        self.get_logger().info("Hello time: " + str(self.counter_))
        self.counter_ += 1


def main(args=None):
    rclpy.init(args=args)
    node = MyFirstNode()
    try:
        rclpy.spin(node)
        node.begin()
    except KeyboardInterrupt:
        pass
    finally:
        node.destroy_node()
        rclpy.try_shutdown()
"""


def package_with(node: str, folder: Path) -> Path:
    root = write(BY_NAME["solution"], folder)
    (root / NODE).write_text("#!/usr/bin/env python3\n" + node)
    return root


def searched(root: Path, kept: list[Judged] | None = None) -> Report:
    """Return the report of a real verdict that looks for changes; `kept` gets what was judged."""
    order = replace(marking.order(root), tries_fixes=True)
    keep = kept.append if kept is not None else None
    return mark(marking.taken_in(root), order, unheard, keep=keep)


MASKED = LATE.replace("        node.begin()\n", "").replace(
    "self.counter_ += 1", "self.counter_ = (self.counter_ + 1) & 7"
)
MASKED = MASKED.replace("= 0\n", "= 0\n        self.begin()\n")


@pytest.mark.long
def test_the_change_of_a_real_verdict_lets_the_package_pass(tmp_path: Path) -> None:
    root = package_with(MASKED, tmp_path)
    kept: list[Judged] = []
    report = searched(root, kept)
    check = next(check for check in report.checks if check.status == "failed")
    assert ids(check)[0] == "node.change_helps"
    again = replay(kept[0].recording, kept[0].submission, marking.ASSIGNMENT)
    assert [(c.id, c.mistakes, c.patch) for c in again.checks] == [
        (c.id, c.mistakes, c.patch) for c in report.checks
    ]
    subprocess.run(["git", "apply"], cwd=root, input=check.patch.encode(), check=True)
    assert marking.mark(root).score == report.max_score


@pytest.mark.full
@pytest.mark.parametrize("distro", ["jazzy", pytest.param("kilted", marks=pytest.mark.long)])
def test_variants_run_with_the_real_ros(distro: str, tmp_path: Path) -> None:
    swapped = "        node.begin()\n        rclpy.spin(node)\n"
    root = package_with(
        LATE.replace("        rclpy.spin(node)\n        node.begin()\n", swapped), tmp_path
    )
    order = marking.order(root, distro=distro)
    right = (root / NODE).read_text()
    variants = [
        right,
        right.replace("create_timer(1.0", "create_timer(0.5"),
        right.replace("        node.begin()\n", ""),
        right.replace("self.counter_ = 0", "pass"),
        right.replace("rclpy.spin(node)", "input()"),
        right.replace("rclpy.spin(node)", "while True: pass"),
        right.replace("self.counter_ += 1", "import time; time.sleep(3)"),
        right.replace("rclpy.spin(node)", "rclpy.spin_once(node)"),
    ]
    sandbox = open_sandbox(order.sandbox, order.distro, order.limits)
    with Session(sandbox, order.assignment) as session:
        session.build(marking.taken_in(root))
        seen = run_variants(
            sandbox,
            "my_robot_controller.my_first_node",
            "main",
            [{"my_robot_controller.my_first_node": text} for text in variants],
            period=1.0,
            seconds=20,
        )
    runs = [run for run in seen if run is not None]
    assert [level(run, OUTPUT) for run in runs[:4]] == [WHOLE, NEARLY, 2, 1]
    assert [at for at, _, _ in runs[0].lines[:3]] == [SECOND, 2 * SECOND, 3 * SECOND]
    assert runs[3].ended.startswith("AttributeError")
    assert [run.ended for run in runs[4:6]] == ["waits", "killed"]
    assert [text for _, _, text in runs[6].lines[:2]] == ["Hello time: 0", "Hello time: 0"]
    assert [run.slept for run in (runs[0], runs[6])] == [False, True]
    assert (runs[7].ended, len(runs[7].lines)) == ("returned", 1)


WAITS = (
    LATE.replace("        node.begin()\n", "")
    .replace("import rclpy\n", "import time\nimport rclpy\n", 1)
    .replace(
        "        self.counter_ = 0\n",
        "        self.counter_ = 0\n        self.begin()\n        self.wait()\n",
    )
    .replace(
        "    def begin(self):\n",
        "    def wait(self):\n        while not self.counter_ > 3:\n            time.sleep(0.1)\n\n    def begin(self):\n",
    )
)


@pytest.mark.long
def test_a_change_that_only_skips_a_loop_is_not_told(tmp_path: Path) -> None:
    root = package_with(WAITS, tmp_path)
    report = searched(root)
    check = next(check for check in report.checks if check.status == "failed")
    assert check.where is not None
    assert "instead of" not in check.fix
    assert "+        while" not in check.patch


BITWISE = (
    LATE.replace("        node.begin()\n", "")
    .replace(
        "        self.counter_ = 0\n",
        "        self.counter_ = 0\n        self.cycle_ = 0\n        self.on_ = True\n        self.begin()\n",
    )
    .replace("create_timer(1.0", "create_timer(0.1")
    .replace(
        '        self.get_logger().info("Hello time: " + str(self.counter_))\n        self.counter_ += 1\n',
        "        self.cycle_ += 1\n"
        "        if self.on_ & self.cycle_ % 10 == 0:\n"
        "            self.get_logger().info('Hello time: ' + str(self.counter_))\n"
        "            self.counter_ += 1\n",
    )
)


@pytest.mark.long
def test_a_condition_is_corrected_after_which_its_block_still_runs(tmp_path: Path) -> None:
    """The calls 2, 4, … of the timer log: a clock that jumps from second to second sees no fault."""
    root = package_with(BITWISE, tmp_path)
    report = searched(root)
    (check,) = [check for check in report.checks if check.status == "failed"]
    assert check.id == "run.period"
    assert "work on the bits of a number" in check.rationale
    assert "+        if self.on_ and self.cycle_ % 10 == 0:" in check.patch


@pytest.mark.full
def test_the_values_of_watched_code_are_those_before_its_line(tmp_path: Path) -> None:
    root = package_with(MASKED, tmp_path)
    line = next(
        n for n, text in enumerate((root / NODE).read_text().split("\n"), 1) if "& 7" in text
    )
    code = (
        "self.counter_",
        "(self.counter_ + 1) & 7",
        "self.get_logger()",
        "self.handle",
        "absent",
    )
    order = marking.order(root)
    sandbox = open_sandbox(order.sandbox, order.distro, order.limits)
    with Session(sandbox, order.assignment) as session:
        session.build(marking.taken_in(root))
        (run,) = run_variants(
            sandbox,
            "my_robot_controller.my_first_node",
            "main",
            [{}],
            period=1.0,
            seconds=20,
            watched=[Watched(NODE, line, line, code)],
        )
    assert run is not None
    assert run.values == (("0", "1", "2"), ("1", "2", "3"), (), (), ())


VALUES: list[tuple[FoundChange, list[str]]] = [
    (
        replace(change(14), values=(("old", ("True",)), ("new", ("False",)))),
        [
            "When the grader ran the node, old was True in this line.",
            "new has the value False there.",
        ],
    ),
    (
        replace(change(14), values=(("self.last", ("1", "2")),)),
        ["When the grader ran the node, self.last was 1, 2 in this line, one after the other."],
    ),
    (replace(change(14), values=(("old", ("1",)), ("new", ("1",)))), []),
    (replace(change(14, "digits"), values=(("old", ("1",)),)), []),
    (replace(change(14, "number", "number"), values=(("old", ("1",)),)), []),
]


@pytest.mark.parametrize(("found", "expected"), VALUES)
def test_the_values_in_a_line_explain_a_change(found: FoundChange, expected: list[str]) -> None:
    assert [str(ENGLISH(text)) for text in value_texts(found)] == expected


@pytest.mark.full
def test_changed_code_runs_only_where_it_is_isolated(tmp_path: Path) -> None:
    root = package_with(MASKED, tmp_path)
    seen: list[str] = []

    def listen(event: object) -> None:
        seen.append(str(getattr(event, "stage", "")))

    order = replace(marking.order(root, sandbox="none"), tries_fixes=True)
    report = mark(marking.taken_in(root), order, listen)
    check = next(check for check in report.checks if check.status == "failed")
    assert (ids(check), check.patch) == (["run.wrong_step"], "")
    assert "search" not in seen
