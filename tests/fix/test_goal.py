"""A failed check of a scenario is told with a fact of the run, and with a change that was tried."""

from __future__ import annotations

from pathlib import Path
from shutil import copytree

import pytest

from grader.base.i18n.translator import Translator
from grader.base.unheard import unheard
from grader.package.submission import take_in
from grader.ros.distro import find_distro
from grader.run.scenes import Scene, run_scenes
from grader.run.session import Session
from grader.run.unforeseen import drawn_for
from grader.sandbox.choose import open_sandbox
from grader.verdict.mark import grade
from grader.verdict.order import Order, load_with_hidden
from tests.marking import LIMITS
from tests.processes import ROOT

PATH = "my_robot_controller/start_stop.py"
ENGLISH = Translator("en")
LOCAL = ("        self.driving_ = request.data\n", "        driving_ = request.data\n")


def package(tmp_path: Path, old: str = "", new: str = "") -> Path:
    """Write the right package of the lesson about services, with one text in place of another."""
    root = tmp_path / "start_stop"
    copytree(ROOT / "grader" / "keys" / "start_stop" / "solution", root)
    file = root / "my_robot_controller" / PATH
    text = file.read_text(encoding="utf-8")
    if old:
        assert text.count(old) == 1
        file.write_text(text.replace(old, new), encoding="utf-8")
    file.chmod(0o755)
    return root


def order(root: Path) -> Order:
    return Order(
        path=root,
        assignment=load_with_hidden("start_stop", None),
        distro=find_distro("jazzy"),
        sandbox="bubblewrap",
        limits=LIMITS,
    )


@pytest.mark.full
@pytest.mark.prefix
def test_short_runs_go_through_a_scenario(tmp_path: Path) -> None:
    root = package(tmp_path)
    assignment = load_with_hidden("start_stop", None)
    submission = take_in(root, package=assignment.package, node_file=assignment.node_file)
    distro = find_distro("jazzy")
    assignment = assignment.with_drawn(drawn_for(submission.sha256, assignment.draw)).on(distro)
    right = (root / "my_robot_controller" / PATH).read_text(encoding="utf-8")
    variants = [
        right,
        right.replace(*LOCAL),
        right.replace("call_async(pen)", "call(pen)"),
        right.replace("self.driving_ = False", "self.driving_ = None.x"),
        right.replace("linear.x = 1.0", "linear.x = 1"),
        right.replace("        if not self.driving_:\n", "        if None.x:\n"),
    ]
    sandbox = open_sandbox("bubblewrap", distro, LIMITS, interfaces=assignment.interfaces)
    with Session(sandbox, assignment) as session:
        session.build(submission)
        scene = Scene(assignment.about("driver"), assignment.runs[0], 0)
        seen = run_scenes(sandbox, scene, [{PATH: text} for text in variants], seconds=40)
        (followed,) = run_scenes(sandbox, scene, [{}], seconds=20, traced=[PATH])
    runs = [run for run in seen if run is not None]
    assert [run.ended.partition(" ")[0] for run in runs] == [
        "time",
        "time",
        "hangs",
        "AttributeError",
        "time",
        "AttributeError",
    ]
    # (its main has destroyed the node by then)
    assert runs[-1].run.started
    whole = runs[4].run.seen
    assert whole is not None
    assert 0 < whole.of_topic("/turtle1/cmd_vel")[0].values["linear"]["x"] < 1e-300
    observed = runs[0].run.seen
    assert observed is not None
    begin = observed.stimulus("start")
    assert begin is not None
    assert begin.reply == {"success": True, "message": "driving"}
    sent = observed.of_topic("/turtle1/cmd_vel")
    assert [one.at for one in sent[:2]] == [begin.at + 0.5, begin.at + 1.0]
    assert sent[0].values["linear"]["x"] == 1.0
    assert [event["off"] for event in observed.events] == [0, 0, 1]
    assert len(observed.path) == 750
    nothing = runs[1].run.seen
    assert nothing is not None
    assert nothing.of_topic("/turtle1/cmd_vel") == []
    assert followed is not None
    assert followed.trace is not None
    (service,) = followed.trace.callbacks
    assert (service.name, service.function, service.calls) == ("/drive", "drive_callback", 3)
    assert [timer.calls for timer in followed.trace.timers] == [24]
    asked = [one for one in followed.trace.done if one.how == "asked"]
    assert [one.what for one in asked] == ["/turtle1/set_pen"] * 3


@pytest.mark.full
@pytest.mark.prefix
def test_a_variable_in_place_of_an_attribute_is_told_with_the_fact_and_the_change(
    tmp_path: Path,
) -> None:
    report = grade(order(package(tmp_path, *LOCAL)), unheard)
    (failed,) = (check for check in report.checks if check.status == "failed")
    assert failed.id == "drive.publishes"
    assert failed.where is not None
    assert failed.where.line == 28
    assert "timer_callback() ran 24 times" in failed.rationale
    assert "not self.driving_" in failed.rationale
    assert "gone when the function ends" in failed.rationale
    assert failed.fix == "Write self.driving_ instead of driving_."
    assert "+        self.driving_ = request.data" in failed.patch.splitlines()
