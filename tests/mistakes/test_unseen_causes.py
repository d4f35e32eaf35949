"""Causes that sets of unseen packages had, and that the grader did not know or told wrongly."""

from __future__ import annotations

from grader.mistakes.recognise import behind_symptom
from grader.mistakes.recognised import RecognisedMistake, Suspect
from grader.package.source.node import NodeSource, read_node
from tests.marking import ASSIGNMENT
from tests.mistakes.other_forms import RIGHT, changed

FOLDER = "my_robot_controller"
NODE = f"{FOLDER}/my_first_node.py"
STEP = "        self.counter_ += 1\n"


def source_of(**files: str) -> NodeSource:
    """Return the node of the files in the inner folder, by their names without the ending."""
    encoded = {f"{FOLDER}/{name}.py": text.encode() for name, text in files.items()}
    source = read_node(encoded.get, NODE, "main")
    assert source is not None
    return source


def look(symptom: str, text: str, **others: str) -> RecognisedMistake | None:
    return behind_symptom(symptom, Suspect(source_of(my_first_node=text, **others), ASSIGNMENT))


def named(found: RecognisedMistake | None) -> str:
    return "" if found is None else f"{found.kind}/{found.variant}"


def test_what_counts_and_then_calls_the_callback_counts_each_line() -> None:
    text = changed(
        RIGHT,
        ("self.timer_callback)", "self.tick)"),
        (STEP, ""),
        (
            "    def timer_callback",
            f"    def tick(self):\n{STEP}        self.timer_callback()\n\n    def timer_callback",
        ),
    )
    assert not named(look("run.wrong_start", text)).startswith("node.counts_elsewhere")
