"""Automatic mutants: reproducible, all different, and at least one of each kind of mistake."""

from __future__ import annotations

import ast

import pytest

from grader.course.find import KEYS
from grader.course.load import load_assignment
from grader.package.edit.tree import Write, apply_all, digest, read_tree
from grader.validate import in_source
from grader.validate.automatic import generate
from grader.validate.spots import Code
from tests.processes import ROOT

ASSIGNMENT = load_assignment(ROOT / "lab/course/hello_time/assignment.yaml")
SOLUTION = read_tree(KEYS / "hello_time/solution/my_robot_controller")
NODE = "my_robot_controller/my_first_node.py"
MUTANTS = {mutant.name: mutant for mutant in generate(SOLUTION, ASSIGNMENT)}


def node_of(name: str) -> str:
    return MUTANTS[name].of(SOLUTION)[NODE].data.decode()


def test_there_are_enough_mutants_and_they_are_reproducible() -> None:
    again = list(generate(SOLUTION, ASSIGNMENT))
    assert again == list(MUTANTS.values())
    assert len({digest(mutant.of(SOLUTION)) for mutant in again}) >= 120


def test_every_mutant_differs_from_the_solution_and_says_what_must_fail() -> None:
    known = {use.id for use in ASSIGNMENT.checks}
    for mutant in MUTANTS.values():
        assert digest(mutant.of(SOLUTION)) != digest(SOLUTION), mutant.name
        assert any(mutant.is_hit_by(check) for check in known), mutant.name


@pytest.mark.parametrize(
    ("name", "line"),
    [
        ("drop self.counter_ += 1", "        pass"),
        ("number 1.0 is 0.5", "        self.create_timer(0.5, self.timer_callback)"),
        ("number 0 is 1", "        self.counter_ = 1"),
        ("step =+", "        self.counter_ =+ 1"),
        ("print for the logger", "        print('Hello time: ' + str(self.counter_))"),
        ("drop rclpy.spin(node)", "        pass"),
        ("base is object, not Node", "class MyFirstNode(object):"),
        ("no default in main", "def main(args):"),
        ("no self in timer_callback", "    def timer_callback():"),
        ("guard misspelt", "if __name__ == 'main':"),
        ("text 'Hello time: ' mark added",
         "        self.get_logger().info('Hello time: !' + str(self.counter_))"),
    ],
)  # fmt: skip
def test_an_operator_changes_the_one_place_that_it_names(name: str, line: str) -> None:
    before = SOLUTION[NODE].data.decode().splitlines()
    after = node_of(name).splitlines()
    changed = [new for old, new in zip(before, after) if old != new]
    assert len(before) == len(after)
    assert changed == [line]


def test_a_node_with_a_syntax_error_must_fail_at_the_source() -> None:
    for mutant in MUTANTS.values():
        if mutant.families == ("source.node_file",):
            with pytest.raises((SyntaxError, ValueError)):
                compile(ast.parse(node_of(mutant.name)), "<node>", "exec")


def test_an_f_string_is_changed_as_a_whole_and_in_its_parts() -> None:
    source = "text = f'[{self.n}] ticks'\n"
    made = {name: text for name, text, _ in in_source.mutants_of(Code(source), ASSIGNMENT)}
    assert made["f lost f'[{self.n}] ticks'"] == "text = '[{self.n}] ticks'\n"
    assert made["text '] ticks' mark added"] == "text = f'[{self.n}] ticks!'\n"
    assert made["text '[' empty"] == "text = f'{self.n}] ticks'\n"
    assert made["misspell self.n"] == "text = f'[{self.nn}] ticks'\n"


def test_places_are_found_in_lines_with_multibyte_letters() -> None:
    code = Code("a = 'é'; b = 'ü'\nc = 3\n")
    first, second, third = (node for node in code.tree.body if isinstance(node, ast.Assign))
    assert code.of(second.value) == "'ü'"
    assert code.put(second.value, "'x'") == "a = 'é'; b = 'x'\nc = 3\n"
    assert code.put_both(first, third) == "c = 3; b = 'ü'\na = 'é'\n"


def test_a_node_whose_class_is_in_another_module_has_mutants_of_both_files() -> None:
    head, end = SOLUTION[NODE].data.decode().split("def main(")
    entry = (
        f"#!/usr/bin/env python3\nimport rclpy\nfrom .hello import MyFirstNode\n\n\ndef main({end}"
    )
    other = "my_robot_controller/hello.py"
    tree = apply_all((Write(NODE, entry), Write(other, head)), SOLUTION)
    made = {mutant.name: mutant for mutant in generate(tree, ASSIGNMENT)}
    for name, path in (("drop rclpy.spin(node)", NODE), ("drop self.counter_ += 1", other)):
        mutant = made[name]
        files = mutant.of(tree)
        assert [p for p in tree if files[p] != tree[p]] == [path]
        assert mutant.is_hit_by("run.output")
