"""The number of a line is followed to what makes it, and no counter is invented."""

from __future__ import annotations

import pytest

from grader.mistakes.made_by import lines_that_make
from grader.package.source.node import read_node
from tests.mistakes.test_from_source import line_of, look, node_in, raised
from tests.mistakes.test_named_exactly import STEP, changed, fix_of

NODE = "my_robot_controller/my_first_node.py"
START = "        self.counter_ = 0\n"
TEXT = "'Hello time: ' + str(self.counter_)"
CLASS = "class MyFirstNode"
STATE = """\
@dataclass(frozen=True)
class State:
    n: int = 0

    def next(self):
        return State(self.n + 1)


class MyFirstNode"""


def of_state(step: str) -> str:
    """Return a node that counts in a frozen dataclass, with this step."""
    return changed(
        ("import rclpy\n", "from dataclasses import dataclass, replace\n\nimport rclpy\n"),
        (CLASS, STATE),
        (START, "        self.state = State()\n"),
        (TEXT, "f'Hello time: {self.state.n}'"),
        (STEP, f"        {step}\n"),
    )


def test_an_object_is_not_told_to_grow_by_one() -> None:
    found = look("run.constant_counter", of_state("self.state.again()"))
    assert found is None or found.kind != "node.counter_not_increased"


def test_the_lines_that_make_the_number_are_named() -> None:
    text = of_state("self.state.next()")
    source = node_in(text)
    made = str(lines_that_make(source, None))
    for code in ("self.state = State()", "n: int = 0"):
        assert f"line {line_of(text, code)}: {code}" in made


def test_a_number_before_a_text_is_the_one_that_str_gets() -> None:
    text = changed((TEXT, "self.counter_ + self.end"))
    error = "TypeError: unsupported operand type(s) for +: 'int' and 'str'"
    found = raised(error, text, line_of(text, "self.end"))
    assert fix_of(found).startswith("Write str(self.counter_) instead of self.counter_:")


CONSTANTS = "class Texts:\n    HELLO = 'Hello time:'\n\n\ndef pad(n):\n    return str(n).rjust(3)\n"


@pytest.mark.parametrize(
    ("imported", "text", "code"),
    [
        (
            "from my_robot_controller import words as w",
            "w.Texts.HELLO + str(self.counter_)",
            "HELLO =",
        ),
        (
            "from my_robot_controller.words import Texts",
            "Texts.HELLO + str(self.counter_)",
            "HELLO =",
        ),
        ("from .words import pad", "'Hello time: ' + pad(self.counter_)", "return str(n).rjust(3)"),
    ],
)
def test_a_text_of_a_file_beside_it_is_named(imported: str, text: str, code: str) -> None:
    node = changed(("import rclpy\n", f"import rclpy\n{imported}\n"), (TEXT, text))
    files = {NODE: node.encode(), "my_robot_controller/words.py": CONSTANTS.encode()}
    source = read_node(files.get, NODE, "main")
    assert source is not None
    made = str(lines_that_make(source, None, only_texts=True))
    assert f"words.py, line {line_of(CONSTANTS, code)}: {code}" in made


def test_the_name_is_given_where_the_class_calls_its_base() -> None:
    base = "class Base(Node):\n    def __init__(self, name='base'):\n        super().__init__(name)\n\n\n"
    text = changed(
        (CLASS, f"{base}{CLASS}"),
        ("MyFirstNode(Node)", "MyFirstNode(Base)"),
        ("super().__init__('my_first_node')", "super().__init__()"),
    )
    source = read_node({NODE: text.encode()}.get, NODE, "main")
    given = source.name_given if source is not None else None
    assert given is not None
    assert given.lineno == line_of(text, "super().__init__()")
