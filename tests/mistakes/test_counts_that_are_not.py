"""Lines that look like the cause of a wrong count, and are not."""

from __future__ import annotations

from tests.mistakes.test_diagnose import RIGHT
from tests.mistakes.test_from_source import look

STEP = next(line for line in RIGHT.splitlines(keepends=True) if "counter_ += 1" in line)


def kind(symptom: str, text: str) -> str:
    assert text != RIGHT
    found = look(symptom, text)
    return found.kind if found is not None else ""


def test_a_name_that_gets_its_own_value_is_no_other_step() -> None:
    kept = STEP.replace("+= 1", "= self.counter_")
    lost = STEP.replace("+= 1", "+ 1")
    assert kind("run.constant_counter", RIGHT.replace(STEP, kept + lost)) != "node.other_step"
    assert kind("run.wrong_step", RIGHT.replace(STEP, STEP.replace("1", "2"))) == "node.other_step"
