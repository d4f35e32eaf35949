"""A timer of Python that starts itself again is named, and the node's timer takes its place."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.mistakes.test_from_source import line_of, look
from tests.mistakes.test_named_exactly import STEP, changed, fix_of, patched

IMPORT = ("import rclpy\nfrom", "import threading\nimport rclpy\nfrom")
TIMER = "        self.create_timer(1.0, self.timer_callback)\n"
CALL = "        self.schedule()\n"
START = """\
        t = threading.Timer(1.0, self.timer_callback)
        t.daemon = True
        t.start()
"""
METHOD = f"\n    def schedule(self):\n        # the next second\n{START}"
ATTRIBUTE = METHOD.replace("        t", "        self.t")
CHAINED = "        threading.Timer(1.0, function=self.timer_callback).start()\n"
IF_OK = "        if rclpy.ok():\n            self.schedule()\n"
BY_HAND = "        self.timer_callback()\n"
NEW = "self.create_timer(1.0, self.timer_callback)"


@pytest.mark.parametrize(
    ("first", "again"),
    [
        (CALL + METHOD, CALL),
        (CALL + METHOD, IF_OK),
        (CALL + ATTRIBUTE, CALL),
        (START, START),
        (CHAINED, CHAINED),
        (BY_HAND, CHAINED),
        (CHAINED.replace("self.timer_callback", "lambda: self.timer_callback()"), CHAINED),
    ],
)
def test_the_timer_of_the_node_takes_its_place(first: str, again: str, tmp_path: Path) -> None:
    text = changed(IMPORT, (TIMER, first), (STEP, STEP + again))
    found = look("run.never_spins", text)
    assert found is not None
    assert found.kind == "node.thread_timer"
    assert found.where is not None
    rows = text.splitlines()
    assert "threading.Timer(" in rows[(found.where.line or 0) - 1]
    start = rows.index(first.splitlines()[0]) + 1
    assert fix_of(found).startswith(f"In __init__, write {NEW} instead of line {start}.")
    assert patched(found, text, tmp_path) == changed()


def test_all_lines_of_the_old_timer_are_named() -> None:
    text = changed(IMPORT, (TIMER, CALL + METHOD), (STEP, STEP + CALL))
    first, step = line_of(text, "def schedule"), line_of(text, "+= 1")
    imported = line_of(text, "import threading")
    assert f"(lines: {imported}, {first}-{first + 4}, {step + 1})" in fix_of(
        look("run.never_spins", text)
    )


def test_a_timer_that_main_starts_is_made_at_the_end_of_init(tmp_path: Path) -> None:
    started = ("    node = MyFirstNode()\n", "    node = MyFirstNode()\n    node.schedule()\n")
    text = changed(IMPORT, (TIMER, METHOD.lstrip("\n")), (STEP, STEP + CALL), started)
    text = text.replace("    def schedule", "\n    def schedule")
    found = look("run.never_spins", text)
    assert fix_of(found).startswith(f"Write {NEW} as the last line of __init__.")
    assert patched(found, text, tmp_path) == changed()


def test_an_attribute_that_is_cancelled_keeps_its_name(tmp_path: Path) -> None:
    cancel = (
        "        node.destroy_node()\n",
        "        node.t.cancel()\n        node.destroy_node()\n",
    )
    text = changed(IMPORT, (TIMER, CALL + ATTRIBUTE), (STEP, STEP + CALL), cancel)
    found = look("run.never_spins", text)
    assert f"write self.t = {NEW}" in fix_of(found)
    assert patched(found, text, tmp_path) == changed((NEW, f"self.t = {NEW}"), cancel)


def test_what_is_not_certain_is_not_patched(tmp_path: Path) -> None:
    kept = f"{START}        self.timers_.append(t)\n"
    text = changed(IMPORT, (TIMER, f"        self.timers_ = []\n{kept}"), (STEP, STEP + kept))
    found = look("run.never_spins", text)
    assert found is not None
    assert found.kind == "node.thread_timer"
    assert "everything that creates" in fix_of(found)
    assert patched(found, text, tmp_path) == ""


def test_a_timer_that_is_started_once_does_not_repeat() -> None:
    found = look("run.stops", changed(IMPORT, (TIMER, START)))
    assert found is not None
    assert found.kind == "node.threading_timer"


def test_a_node_that_never_spins_is_not_excused_by_its_thread() -> None:
    text = changed(IMPORT, (TIMER, CALL + METHOD), (STEP, STEP + CALL))
    found = look("run.never_spins", text.replace("rclpy.spin(node)", "wait()"))
    assert found is None or found.kind != "node.thread_timer"
