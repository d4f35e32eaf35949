"""Where the way to the line that logs ends, as a followed run of the node shows it."""

from __future__ import annotations

import ast
import json
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, cast

import pytest

from grader.base.unheard import unheard
from grader.package.source.names import calls_in
from grader.package.source.node import NodeSource, read_node
from grader.report.model import CheckResult, Report
from grader.run import variants
from grader.run.variants import Trace, TracedCallback, TracedTimer, trace_node
from grader.verdict.evidence_file import Judged
from grader.verdict.follow import Stop, conditions_of, stop_of
from grader.verdict.mark import mark, replay
from tests import marking
from tests.corpus.build import write
from tests.corpus.right import RIGHT

if TYPE_CHECKING:
    from grader.sandbox.base import Sandbox

NODE, HELPER = "my_robot_controller/my_first_node.py", "my_robot_controller/clock.py"
LOG = 'self.get_logger().info("Hello time: " + str(self.counter_))'
HEAD = """\
import rclpy
from rclpy.node import Node

from my_robot_controller.clock import make_clock


class MyFirstNode(Node):
    def __init__(self):
        super().__init__("my_first_node")
        self.counter_ = 0
"""
TAIL = """

def main(args=None):
    rclpy.init(args=args)
    node = MyFirstNode()
    rclpy.spin(node)
"""
TIMER = "        self.create_timer(1.0, self.tick)\n"
TICK = "\n    def tick(self):\n"
STEP = "        self.counter_ += 1\n"
CLOCK = """\
import rclpy


def make_clock(callback):
    clock = rclpy.create_node("clock")
    clock.create_timer(1.0, callback)
    return clock
"""


def source_of(body: str) -> NodeSource:
    files = {NODE: (HEAD + body + TAIL).encode(), HELPER: CLOCK.encode()}
    source = read_node(files.get, NODE, "main")
    assert source is not None
    return source


def log_of(source: NodeSource) -> ast.Call:
    return next(call for call, _ in calls_in(source.entry.tree) if source.is_log(call))


def line_of(source: NodeSource, code: str) -> int:
    return source.entry.text.text.split("\n").index(code.rstrip("\n")) + 1


def stop(body: str, *not_run: str, timers: tuple[TracedTimer, ...] = ()) -> Stop | None:
    """Return where the way ends if all lines run three times, except those that are named."""
    source = source_of(body)
    lines = source.entry.text.text.split("\n")
    left_out = {line_of(source, code) for code in not_run}
    ran = {number: 3 for number in range(1, len(lines) + 1) if number not in left_out}
    return stop_of(source, Trace("time", {NODE: ran}, timers), log_of(source))


def found(at: Stop | None) -> tuple[str, int, str]:
    assert at is not None
    return at.sort, at.at.lineno, at.name


def test_a_condition_that_is_never_true_ends_it() -> None:
    inner = f"            {LOG}\n"
    body = TIMER + TICK + "        if self.counter_ > 3:\n" + inner + STEP
    line = line_of(source_of(body), "        if self.counter_ > 3:")
    assert found(stop(body, inner)) == ("never_true", line, "self.counter_ > 3")


def test_a_condition_that_is_always_true_ends_the_way_to_its_else() -> None:
    inner = f"            {LOG}\n"
    body = TIMER + TICK + "        if self.counter_ < 3:\n            pass\n        else:\n" + inner
    line = line_of(source_of(body), "        if self.counter_ < 3:")
    assert found(stop(body, inner)) == ("always_true", line, "self.counter_ < 3")


def test_of_an_elif_that_is_never_asked_the_condition_above_is_told() -> None:
    second, inner = "        elif self.counter_ > 3:\n", f"            {LOG}\n"
    body = TIMER + TICK + "        if self.counter_ == 0:\n            pass\n" + second + inner
    line = line_of(source_of(body), "        if self.counter_ == 0:")
    assert found(stop(body, second, inner)) == ("always_true", line, "self.counter_ == 0")


def test_a_loop_without_items_ends_it() -> None:
    inner = f"            {LOG}\n"
    body = TIMER + TICK + "        for _ in self.names_:\n" + inner
    line = line_of(source_of(body), "        for _ in self.names_:")
    assert found(stop(body, inner)) == ("empty", line, "self.names_")


def test_a_return_above_the_line_ends_it() -> None:
    inner = f"        {LOG}\n"
    body = TIMER + TICK + "        if self.counter_ < 3:\n            return\n" + inner + STEP
    line = line_of(source_of(body), "            return")
    assert found(stop(body, inner, STEP)) == ("leaves", line, "")


def test_a_line_in_which_a_thread_still_is_ends_it() -> None:
    wait, inner = "        self.ready_.wait()\n", f"        {LOG}\n"
    source = source_of(TIMER + TICK + wait + inner + STEP)
    line = line_of(source, wait)
    ran = dict.fromkeys(range(1, line + 1), 1)
    for stand, expected in ((((NODE, line), (NODE, 30)), "waits"), (((NODE, 30),), "")):
        trace = Trace("waits", {NODE: ran}, stand=(stand,))
        at = stop_of(source, trace, log_of(source))
        assert (at.sort if at is not None else "") == expected
        assert at is None or at.at.lineno == line


def test_the_way_goes_back_through_calls() -> None:
    call, inner = "            self.say()\n", f"        {LOG}\n"
    say = "\n    def say(self):\n" + inner
    body = TIMER + TICK + "        if self.counter_ > 3:\n" + call + STEP + say
    line = line_of(source_of(body), "        if self.counter_ > 3:")
    assert found(stop(body, call, inner)) == ("never_true", line, "self.counter_ > 3")


def test_a_function_that_nothing_calls_ends_it() -> None:
    inner = f"        {LOG}\n"
    body = "\n    def say(self):\n" + inner
    assert found(stop(body, inner))[::2] == ("not_called", "say")


@pytest.mark.parametrize(
    "head",
    [
        "\n    def on_shutdown(self):\n",  # (dunder and decorated functions are called by others)
        "\n    @staticmethod\n    def say(self):\n",
        "\n    def __call__(self):\n",
    ],
)
def test_what_others_may_call_is_not_told_to_be_without_a_call(head: str) -> None:
    inner = f"        {LOG}\n"
    at = stop(head + inner, inner)
    assert (at is None) == ("shutdown" not in head)


def timer(line: int, **more: object) -> TracedTimer:
    seen = TracedTimer(((NODE, line), (NODE, 1)), spun=True, calls=0)
    return replace(seen, **more)  # type: ignore[arg-type]


def test_a_timer_of_a_node_in_no_executor_ends_it() -> None:
    inner = f"        {LOG}\n"
    body = TIMER + TICK + inner
    line = line_of(source_of(body), TIMER)
    assert found(stop(body, inner, timers=(timer(line, spun=False),))) == ("not_spun", line, "tick")


def test_a_timer_that_is_stopped_ends_it() -> None:
    inner = f"        {LOG}\n"
    body = TIMER + TICK + inner
    line = line_of(source_of(body), TIMER)
    at = stop(body, inner, timers=(timer(line, stopped=((HELPER, 4),)),))
    assert found(at) == ("stopped", line, "tick")
    assert at is not None
    assert at.place == (HELPER, 4)


def test_a_timer_that_another_file_makes_is_told_there() -> None:
    inner, made = f"        {LOG}\n", "        self.clock_ = make_clock(self.tick)\n"
    body = made + TICK + inner
    line = line_of(source_of(body), made)
    away = TracedTimer(((HELPER, 6), (NODE, line)), spun=False, calls=0)
    at = stop(body, inner, timers=(away,))
    assert found(at) == ("not_spun", 6, "tick")


@pytest.mark.parametrize(
    "timers",
    [(), (timer(11),), (timer(11, calls=2),), (timer(11, spun=False), timer(11, spun=False))],
    ids=["none", "spun", "called", "two"],
)
def test_what_is_not_clear_is_not_told(timers: tuple[TracedTimer, ...]) -> None:
    inner = f"        {LOG}\n"
    body = TIMER + TICK + inner
    assert line_of(source_of(body), TIMER) == 11
    assert stop(body, inner, timers=timers) is None


def test_a_line_that_ran_has_no_end_of_the_way() -> None:
    assert stop(TIMER + TICK + f"        {LOG}\n") is None


AWAY = ["/etc/passwd", 1]
LIE = {
    "ended": "time",
    "trace": {
        "lines": {NODE: {"3": 1}, "/etc/passwd": {"1": 1}},
        "timers": [{"made": [AWAY], "spun": True, "calls": 0, "stopped": []}],
        "logged": [[[AWAY], 0]],
        "stand": [[AWAY, [NODE, 3]]],
        "values": [],
        "ranges": [],
        "kinds": [],
        "callbacks": [
            {"how": "timer", "name": "", "made": [AWAY], "function": "tick", "calls": 1},
        ],
        "done": [],
        "raised": None,
    },
}


def test_a_trace_has_only_places_in_the_files_that_were_asked_for(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """The trace comes from the student's process, which may say what it likes."""
    said = json.dumps({"index": 0, "seen": LIE})
    monkeypatch.setattr(variants, "answers", lambda *_args, **_named: [said])
    sandbox = cast("Sandbox", None)
    found = trace_node(sandbox, "node", "main", [NODE], period=1.0, seconds=1.0)
    timer = TracedTimer((), spun=True, calls=0)
    called = (TracedCallback("timer", "", (), "tick", 1),)
    assert found == Trace(
        "time", {NODE: {3: 1}}, (timer,), (((), 0),), (((NODE, 3),),), callbacks=called
    )


@pytest.mark.parametrize(
    "said",
    [
        "",
        "[]",
        '{"seen": null}',
        '{"seen": {"ended": "", "trace": {"timers": [], "lines": 3}}}',
        '{"seen": {"ended": "", "trace": {"timers": [], "lines": {}, "logged": [[[], Infinity]]}}}',
    ],
)
def test_what_is_no_trace_is_none(said: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(variants, "answers", lambda *_args, **_named: [said])
    sandbox = cast("Sandbox", None)
    assert trace_node(sandbox, "node", "main", [NODE], period=1.0, seconds=1.0) is None


def test_a_condition_is_watched_with_the_names_that_it_asks_for() -> None:
    body = TIMER + TICK + "        if len(self.names_) > self.limit_:\n            pass\n"
    (watched,) = conditions_of(source_of(body))
    assert set(watched.code) == {"self.names_", "self.limit_"}


def package_with(folder: Path, body: str, clock: str = CLOCK) -> Path:
    root = write(next(one for one in RIGHT if one.name == "solution"), folder)
    (root / NODE).write_text("#!/usr/bin/env python3\n" + HEAD + body + TAIL)
    (root / HELPER).write_text(clock)
    return root


def judged(root: Path) -> tuple[Report, Judged]:
    kept: list[Judged] = []
    order = replace(marking.order(root), tries_fixes=True)
    return mark(marking.taken_in(root), order, unheard, keep=kept.append), kept[0]


def failed(report: Report) -> CheckResult:
    return next(check for check in report.checks if check.status == "failed")


@pytest.mark.long
def test_a_real_verdict_tells_the_timer_that_nothing_calls(tmp_path: Path) -> None:
    body = f"        self.clock_ = make_clock(self.tick)\n{TICK}        {LOG}\n{STEP}"
    report, kept = judged(package_with(tmp_path, body))
    check = failed(report)
    assert [mistake.id for mistake in check.mistakes] == ["node.not_reached", "run.no_lines"]
    assert check.where is not None
    assert (check.where.file, check.where.line) == (HELPER, 6)
    assert "in no executor" in check.rationale
    again = failed(replay(kept.recording, kept.submission, marking.ASSIGNMENT))
    assert (again.mistakes, again.rationale, again.fix) == (
        check.mistakes,
        check.rationale,
        check.fix,
    )


TICKING = """\
from rclpy.node import Node


class Ticking(Node):
    def __init__(self, name):
        super().__init__(name)
        self.set_period(0.5)

    def set_period(self, seconds):
        self.timer_ = self.create_timer(seconds, self.tick)

    def tick(self):
        pass
"""


@pytest.mark.long
def test_a_real_verdict_tells_the_timers_that_the_lines_come_from(tmp_path: Path) -> None:
    body = f"        self.set_period(1.0)\n{TICK}        {LOG}\n{STEP}"
    root = package_with(tmp_path, body, TICKING)
    text = (root / NODE).read_text()
    text = text.replace("import make_clock", "import Ticking").replace(
        "Node(Node)", "Node(Ticking)"
    )
    (root / NODE).write_text(text)
    check = failed(judged(root)[0])
    assert [mistake.id for mistake in check.mistakes] == ["node.several_timers", "run.twice"]
    assert "line 10 (called from line 7); line 10 (called from line 12 of" in check.rationale
