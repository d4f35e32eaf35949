"""A package that could tell that it is marked is also run plainly, as a person runs it."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from grader.base.unheard import unheard
from grader.course.load import load_assignment
from grader.course.scenario import RunPlan
from grader.report.model import Report
from grader.ros.distro import find_distro
from grader.run import session
from grader.run.observations import End, Message, Observations
from grader.run.plain_run import early
from grader.run.probe_link import ProbeError
from grader.run.session import BUSY
from grader.verdict.checks.all import CHECKS
from grader.verdict.mark import grade
from grader.verdict.order import Order
from tests import marking, two_nodes
from tests.marking import LIMITS
from tests.processes import ROOT

pytestmark = [pytest.mark.prefix, pytest.mark.full]
CALLBACKS = {  # of each lesson: a line before which code is put that reads the clock
    "draw_circle": ("draw_circle.py", "        message = Twist()\n"),
    "own_message": ("measure_distance.py", "        message = Distance()\n"),
    "start_stop": ("start_stop.py", "        message = Twist()\n"),
    "stay_inside": ("stay_inside.py", "        message = Twist()\n"),
}
READS = "        self.read_at_ = self.get_clock().now()\n"
IN_CI = ("draw_circle",)
TELLS = {  # conditions that hold only while the node is marked
    "parameter": "self.get_parameter('use_sim_time').value",
    "made_up_parameter": "self.get_parameter('use_' + 'sim' + '_time').value",
    "prefix": "self.get_parameters_by_prefix('use_sim')['time'].value",
    "early": "self.get_clock().now().nanoseconds < 10**18",
    "clock_on_the_graph": "self.count_publishers('/clock') > 0",
    "command_line": "'use_sim_time:=true' in __import__('sys').argv",
    "kernel": "b'use_sim_time' in open('/proc/self/cmdline', 'rb').read()",
    "formatted": "'{0._clock.ros_time_is_active}'.format(self) == 'True'",
    "private": "self._time_source._ros_time_active",
    "getattr": "getattr(self.get_clock(), 'ros_time' + '_is_active')",
    "timer": "next(self.timers).clock.ros_time_is_active",
    "who_listens": "self.get_publishers_info_by_topic('/clock') != []",
    "flies": "__import__('time').monotonic() - self.__dict__.setdefault('t', 0) < 0.3 and self.t "
    "or setattr(self, 't', __import__('time').monotonic())",
}


def lessons() -> list[object]:
    return [
        pytest.param(one, id=one, marks=[] if one in IN_CI else pytest.mark.long)
        for one in CALLBACKS
    ]


def marked(lesson: str, code: str, folder: Path) -> Report:
    """Return the report of a lesson's solution with code in its callback."""
    file, line = CALLBACKS[lesson]
    copy = folder / "handed_in"
    shutil.copytree(ROOT / "grader" / "keys" / lesson / "solution", copy)
    (node,) = copy.rglob(file)
    text = node.read_text(encoding="utf-8")
    assert text.count(line) == 1
    node.write_text(text.replace(line, code + line), encoding="utf-8")
    assignment = load_assignment(
        ROOT / "lab" / "course" / lesson / "assignment.yaml", known_checks=CHECKS
    )
    order = Order(
        path=copy,
        assignment=assignment,
        distro=find_distro("jazzy"),
        sandbox="bubblewrap",
        limits=LIMITS.override(assignment.limits),
    )
    return grade(order, unheard)


@pytest.mark.parametrize("lesson", lessons())
def test_a_node_that_works_only_in_driven_time_has_not_done_the_exercise(
    lesson: str, tmp_path: Path
) -> None:
    code = "        if not self.get_clock().ros_time_is_active:\n            return\n"
    report = marked(lesson, code, tmp_path)
    failed = {one.id: one.mistakes[0].id for one in report.checks if one.status == "failed"}
    assert failed == {"run.spins": "run.only_when_marked"}
    (spins,) = [one for one in report.checks if one.id == "run.spins"]
    assert spins.where is not None
    assert spins.where.file.endswith(CALLBACKS[lesson][0])
    assert report.score is not None and report.score <= 0.7 * report.max_score


@pytest.mark.long
@pytest.mark.parametrize("how", TELLS)
def test_however_a_node_tells_that_it_is_marked(how: str, tmp_path: Path) -> None:
    code = f"        if not ({TELLS[how]}):\n            return\n"
    report = marked("draw_circle", code, tmp_path)
    assert report.score is not None and report.score <= 0.7 * report.max_score
    assert any(one.status == "failed" for one in report.checks)


@pytest.mark.parametrize("lesson", lessons())
def test_a_node_that_reads_the_clock_for_itself_gets_full_marks(
    lesson: str, tmp_path: Path
) -> None:
    report = marked(lesson, READS, tmp_path)
    assert report.score == report.max_score
    assert report.submission.notes == []  # (a plain run showed that it works)


def no_room(*_: object, **__: object) -> bool:
    raise ProbeError(BUSY)


@pytest.mark.long
def test_a_plain_run_for_which_the_machine_is_too_busy_is_a_note(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(session, "happens", no_room)
    report = marked("draw_circle", READS, tmp_path)
    assert report.score == report.max_score
    (note,) = report.submission.notes
    assert note.startswith("To look at: ")
    assert "draw_circle.py, line " in note
    assert "self.get_clock().now" in note


@pytest.mark.long
@pytest.mark.parametrize("file", ["listener.py", "talker.py"])
def test_of_several_nodes_each_must_work_plainly(file: str, tmp_path: Path) -> None:
    """(The listener only logs.)"""
    callbacks = {
        "listener.py": "    def on_text(self, text):\n",
        "talker.py": "    def on_timer(self):\n",
    }
    stop = "        if not self.get_clock().ros_time_is_active:\n            return\n"
    callback = callbacks[file]
    root = two_nodes.write(tmp_path, (f"my_talking/{file}", callback, callback + stop))
    report = grade(marking.order(root, assignment=two_nodes.assignment(tmp_path)), unheard)
    failed = {one.id: one.mistakes[0].id for one in report.checks if one.status == "failed"}
    assert failed == {"run.spins": "run.only_when_marked"}


def message(topic: str, at: float) -> Message:
    return Message(topic, at, {})


def plan_of(*stimuli: tuple[str, float]) -> RunPlan:
    do = [
        {"name": name, "at": at, "publish": {"topic": "/in", "type": "t"}} for name, at in stimuli
    ]
    clock = {"period": 0.5, "ticks": 20}
    return RunPlan.model_validate({"name": "r", "start": [{"node": "n"}], "clock": clock, "do": do})


@pytest.mark.parametrize(
    ("messages", "topics", "stimuli"),
    [
        # the first stimulus is one to which the node must stay silent
        ([("/out", 3.0)], {"/out"}, ["silent", "loud"]),
        ([("/out", 0.5), ("/other", 3.0)], {"/out"}, []),
        ([("/out", 1.0)], {"/out"}, ["silent"]),
        ([("/ours", 1.0)], None, None),
        ([], None, None),
    ],
)
def test_what_happens_first_is_asked_for_after_the_same_stimuli(
    messages: list[tuple[str, float]], topics: set[str] | None, stimuli: list[str] | None
) -> None:
    seen = Observations(0.5)
    seen.messages = [message(*one) for one in messages]
    seen.ends = [End("/n", "publisher", name, "t") for name in ("/out", "/other")]
    found = early(plan_of(("silent", 1.0), ("loud", 3.0)), seen)
    if found is None:
        assert topics is None
    else:
        assert set(found.topics) == topics
        assert [one.name for one in found.stimuli] == stimuli
