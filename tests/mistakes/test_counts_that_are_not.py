"""Lines that look like the cause of a wrong count, and are not."""

from __future__ import annotations

from tests.mistakes.test_diagnose import RIGHT
from tests.mistakes.test_from_source import look

STEP = next(line for line in RIGHT.splitlines(keepends=True) if "counter_ += 1" in line)
TIMER = "self.create_timer(1.0, self.timer_callback)"


def kind(symptom: str, text: str) -> str:
    assert text != RIGHT
    found = look(symptom, text)
    return found.kind if found is not None else ""


def test_a_name_that_gets_its_own_value_is_no_other_step() -> None:
    kept = STEP.replace("+= 1", "= self.counter_")
    lost = STEP.replace("+= 1", "+ 1")
    assert kind("run.constant_counter", RIGHT.replace(STEP, kept + lost)) != "node.other_step"
    assert kind("run.wrong_step", RIGHT.replace(STEP, STEP.replace("1", "2"))) == "node.other_step"


def test_an_iterator_that_is_made_in_the_same_line_does_not_run_out() -> None:
    ended = "        first = next({})\n"
    for made, told in (("iter(self.timers)", False), ("self.numbers", True)):
        text = RIGHT.replace(STEP, STEP + ended.format(made))
        assert (kind("run.stops", text) == "node.iterator_ended") is told


def test_a_lambda_works_out_its_arguments_in_each_call() -> None:
    text = RIGHT.replace("def timer_callback(self)", "def timer_callback(self, n)")
    text = text.replace("str(self.counter_)", "str(n)")
    given = "self.create_timer(1.0, {})"
    frozen = text.replace(TIMER, given.format("partial(self.timer_callback, self.counter_)"))
    assert kind("run.constant_counter", frozen) == "node.argument_frozen"
    anew = text.replace(TIMER, given.format("lambda: self.timer_callback(next(count()))"))
    assert kind("run.constant_counter", anew) != "node.argument_frozen"


def test_a_class_method_has_to_become_a_method_of_the_object() -> None:
    method = "    @classmethod\n    def increase(cls):\n        cls.counter_ += 1\n\n"
    text = RIGHT.replace(STEP, "        self.increase()\n")
    found = look(
        "run.constant_counter",
        text.replace("    def timer_callback", method + "    def timer_callback"),
    )
    assert found is not None
    assert (found.kind, found.variant) == ("node.counter_of_class", "of_method")
    assert found.words["method"] == "increase"
