"""Mistakes in the counter: an object that counts, and that each callback makes anew."""

from __future__ import annotations

from dataclasses import replace

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.example import LOG, NODE, STEP_LINE, example
from grader.mistakes.fixes import node_anew, node_worked_out
from grader.mistakes.kind import Family
from grader.mistakes.recognised import RecognisedMistake, Suspect
from grader.mistakes.worked_out import change_of
from grader.package.edit.tree import Replace
from grader.package.source.made_anew import made_anew

MOST_CODE = 80  # characters of an expression that a text shows


def _made_anew(suspect: Suspect) -> RecognisedMistake | None:
    """Look for an object that the callback makes, changes and logs in each call."""
    source = suspect.source
    inside = change_of(suspect, "anew")
    if inside is not None:
        written, attribute = inside.name, inside.written
        found_inside = suspect.finding("made_anew", inside.at, name=written, attribute=attribute)
        words = {**found_inside.words, "written": written}
        return replace(found_inside, words=words, variant="inside")
    found = made_anew(source)
    if found is None:
        return None
    value = " ".join(source.module_of(found.made).text.code(found.made.value).split())
    attribute = node_anew.attribute_for(source, found.name)
    mistake = suspect.finding(
        "made_anew",
        found.made,
        name=found.name,
        attribute=attribute,
        written=value if len(value) <= MOST_CODE else "…",
    )
    if found.is_local:
        return mistake
    there = node_anew.is_set_before(source, found.name)
    return replace(mistake, variant="there" if there else "attribute")


_node = Family("node", links.PYTHON_CLASSES)
KINDS = (
    _node(
        "made_anew",
        "counter",
        msg("The callback makes a new counter in each call"),
        msg(
            "This line runs in each callback, and each time {written} makes a new object, whose "
            "count begins again."
        ),
        msg(
            "Make it once: write {attribute} = {written} in __init__ instead of this line, and "
            "{attribute} instead of {name} in the callback."
        ),
        fixes={
            "inside": msg(
                "Make it once: write {attribute} = {written} in __init__, below super().__init__. In "
                "this line, write {attribute} instead of {written}."
            ),
            "attribute": msg("Move this line to __init__, so that the object is made only once."),
            "there": msg("Delete this line: __init__ sets {name} already."),
        },
        behind={"run.constant_counter": _made_anew},
        fixed_by=(node_anew.once, node_worked_out.change("anew")),
        deletes=("", "attribute", "there"),
        examples=(
            example(
                "helper_made_anew",
                Replace(
                    NODE,
                    "class MyFirstNode",
                    "class HelloCounter:\n"
                    "    def __init__(self):\n"
                    "        self.value = 0\n\n"
                    "    def increase(self):\n"
                    "        self.value += 1\n\n\n"
                    "class MyFirstNode",
                ),
                Replace(
                    NODE,
                    LOG,
                    "counter = HelloCounter()\n"
                    "        self.get_logger().info(f'Hello time: {counter.value}')",
                ),
                Replace(NODE, STEP_LINE, "        counter.increase()\n"),
                fails="run.output",
            ),
            example(
                "iterator_made_anew",
                Replace(NODE, "import rclpy\nfrom", "import itertools\n\nimport rclpy\nfrom"),
                Replace(
                    NODE,
                    LOG,
                    "numbers = itertools.count()\n"
                    "        self.get_logger().info('Hello time: ' + str(next(numbers)))",
                ),
                Replace(NODE, STEP_LINE, ""),
                fails="run.output",
            ),
            example(
                "generator_method_made_anew",
                Replace(
                    NODE,
                    "    def timer_callback",
                    "    def numbers(self):\n        n = 0\n        while True:\n"
                    "            yield n\n            n += 1\n\n    def timer_callback",
                ),
                Replace(
                    NODE,
                    LOG,
                    "numbers = self.numbers()\n"
                    "        self.get_logger().info('Hello time: ' + str(next(numbers)))",
                ),
                Replace(NODE, STEP_LINE, ""),
                fails="run.output",
            ),
            example(
                "generator_made_anew",
                Replace(
                    NODE,
                    "    def timer_callback",
                    "    def numbers(self):\n        n = 0\n        while True:\n"
                    "            yield n\n            n += 1\n\n    def timer_callback",
                ),
                Replace(NODE, "str(self.counter_)", "str(next(self.numbers()))"),
                Replace(NODE, STEP_LINE, ""),
                fails="run.output",
            ),
        ),
    ),
)
