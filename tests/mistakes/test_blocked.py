"""A callback that waits for ever is told with the line in which it waits."""

from __future__ import annotations

import pytest

from grader.mistakes.catalogue import CATALOGUE
from grader.mistakes.recognise import behind_symptom
from grader.mistakes.recognised import RecognisedMistake, Suspect
from tests.marking import ASSIGNMENT
from tests.mistakes.other_forms import LOG, RIGHT, START, STEP, changed
from tests.mistakes.test_period_origin import source_in

IMPORT = ("import rclpy\n", "import queue\nimport socket\nimport threading\nimport rclpy\n")
BODY = f"        {LOG}\n{STEP}"


def with_callback(made: str, body: str, more: str = "") -> str:
    """Return the node with a line in __init__, and with another callback."""
    return changed(RIGHT, IMPORT, (START, f"{START}        {made}\n"), (BODY, f"{body}{more}"))


def found(text: str, *, stuck: bool = True) -> RecognisedMistake | None:
    return behind_symptom("run.stops", Suspect(source_in(text), ASSIGNMENT, stuck=stuck))


def told(mistake: RecognisedMistake) -> str:
    kind = CATALOGUE[mistake.kind]
    return str(kind.fix_text({**mistake.params, **mistake.words}, mistake.variant))


WITH = "        with self.lock:\n"
AGAIN = f"\n    def count(self):\n{WITH}    {STEP}"
TWICE = f"{WITH}            {LOG}\n            self.count()\n"


@pytest.mark.parametrize(
    ("made", "body", "more"),
    [
        ("self.lock = threading.RLock()", TWICE, AGAIN),
        ("self.lock = threading.Lock()", f"{WITH}            {LOG}\n        self.count()\n", AGAIN),
        ("self.lock = threading.Lock()",
         TWICE.replace("self.count()", "self.lock.release()\n            self.count()\n"
                       "            self.lock.acquire()"), AGAIN),
        ("self.jobs = queue.Queue()", f"{BODY}        self.jobs.get(timeout=0.1)\n", ""),
        ("self.jobs = {}", f"{BODY}        self.jobs.get('a')\n", ""),
        ("self.words = ','", f"{BODY}        self.words.join('ab')\n", ""),
        ("self.lock = threading.Lock()",
         f"        self.lock.acquire()\n{BODY}        self.lock.release()\n", ""),
    ],
)  # fmt: skip
def test_what_ends_is_not_told(made: str, body: str, more: str) -> None:
    assert found(with_callback(made, body, more)) is None


def test_what_a_method_of_the_callback_does_is_told() -> None:
    """A shutdown in a helper ends the node; a sleep in it holds the lines back."""
    body = f"{BODY}        self.check()\n"
    ends = "\n    def check(self):\n        rclpy.shutdown()\n"
    suspect = Suspect(source_in(with_callback("pass", body, ends)), ASSIGNMENT)
    mistake = behind_symptom("run.ended_early", suspect)
    assert mistake is not None
    assert mistake.kind == "node.exits"
    sleeps = ends.replace("rclpy.shutdown()", "time.sleep(2.0)")
    text = with_callback("pass", body, sleeps)
    mistake = behind_symptom("run.wrong_period", Suspect(source_in(text), ASSIGNMENT))
    assert mistake is not None
    assert mistake.kind == "node.sleeps_in_callback"
    assert told(mistake).startswith("Remove the sleep from check:")
    chosen = text.replace("        time.sleep", "        if self.late:\n            time.sleep")
    assert behind_symptom("run.wrong_period", Suspect(source_in(chosen), ASSIGNMENT)) is None


def test_an_exit_after_spin_does_not_end_a_node_before_ctrl_c() -> None:
    text = changed(
        RIGHT, ("        rclpy.try_shutdown()\n", "        rclpy.try_shutdown()\n        exit(0)\n")
    )
    assert behind_symptom("run.ended_early", Suspect(source_in(text), ASSIGNMENT)) is None
