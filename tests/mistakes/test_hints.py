"""The advice on what works and can be better: a second node, a timer under its callback's name."""

from __future__ import annotations

import ast

import pytest

from grader.mistakes.hints import hints

MAIN = """\
def main():
    rclpy.init()
    node = MyNode()
    {body}
    node.destroy_node()
"""


def advice(body: str) -> list[str]:
    return hints(ast.parse(MAIN.format(body=body)))


@pytest.mark.parametrize(
    "body",
    [
        "rclpy.spin(node)",
        "rclpy.spin(OtherNode())",
        "rclpy.spin(MyNode('other'))",
        "Thread(target=rclpy.spin, args=(node,)).start(); rclpy.spin(MyNode())",
        "executor.add_node(node); rclpy.spin(MyNode())",
    ],
)
def test_a_node_that_may_be_meant_gets_no_advice(body: str) -> None:
    assert advice(body) == []


@pytest.mark.parametrize(
    ("end", "title"),
    [
        ("if __name__ == '__main__':\n    main\n", "line 8: The () below the guard is missing"),
        ("    if __name__ == '__main__':\n        main()\n", "line 7: The guard is inside of a"),
        ("    if __name__ == '__main__':\n        run()\n", ""),
        ("if __name__ == '__main__':\n    main()\n", ""),
    ],
)
def test_a_guard_that_calls_nothing(end: str, title: str) -> None:
    found = hints(ast.parse(MAIN.format(body="rclpy.spin(node)") + "\n" + end))
    assert [text[: len(title)] for text in found] == ([title] if title else [])
