"""Programs with several nodes or executors: what is spun, in which order, and what counts twice."""

from __future__ import annotations

from pathlib import Path

import pytest

from grader.package.source.in_class import calls_of_method
from tests.mistakes.test_from_source import line_of, look
from tests.mistakes.test_named_exactly import changed, fix_of, patched, why_of

MADE, SPIN = "    node = MyFirstNode()\n", "        rclpy.spin(node)\n"
OTHER = "class Other(Node):\n\n    def __init__(self):\n        super().__init__('other')\n\n\n"
INIT = "    rclpy.init(args=args)\n"


def test_a_loop_that_spins_another_node_first() -> None:
    loop = "        for each in [Other(), node]:\n            rclpy.spin(each)\n"
    text = changed(("def main(", f"{OTHER}def main("), (SPIN, loop))
    found = look("run.no_lines", text)
    assert found is not None
    assert found.kind == "node.spun_in_turn"
    assert found.where is not None
    assert found.where.line == line_of(text, "rclpy.spin(each)")
    assert f"above line {line_of(text, 'for each in')}" in fix_of(found)


def test_a_loop_that_spins_the_counting_node_first_is_not_the_cause() -> None:
    loop = "        for each in [node, Other()]:\n            rclpy.spin(each)\n"
    found = look("run.no_lines", changed(("def main(", f"{OTHER}def main("), (SPIN, loop)))
    assert found is None or found.kind != "node.spun_in_turn"


def test_two_spins_in_a_row() -> None:
    made = f"    other = Other()\n{MADE}"
    text = changed(
        ("def main(", f"{OTHER}def main("),
        (MADE, made),
        (SPIN, f"        rclpy.spin(other)\n{SPIN}"),
    )
    found = look("run.no_lines", text)
    assert f"Line {line_of(text, 'rclpy.spin(node)')}, which spins node" in why_of(found)


def test_two_nodes_that_count() -> None:
    spin = "        executor.add_node(node)\n        executor.add_node(twin)\n        executor.spin()\n"
    text = changed(
        (MADE, f"    executor = SingleThreadedExecutor()\n{MADE}    twin = MyFirstNode()\n"),
        (SPIN, spin),
    )
    found = look("run.twice", text)
    line = line_of(text, "add_node(twin)")
    assert fix_of(found) == f"Keep one: delete this line, and delete what uses twin in line {line}."


def test_a_second_node_that_is_not_spun_makes_no_lines() -> None:
    text = changed((MADE, f"{MADE}    twin = MyFirstNode()\n"))
    found = look("run.twice", text)
    assert found is None or found.kind != "node.two_nodes_count"


def test_a_second_node_that_logs_another_text_makes_no_lines_of_the_count() -> None:
    timer = "        self.create_timer(5.0, self.tick)\n\n    def tick(self):\n"
    helper = OTHER.rstrip() + f"\n{timer}        self.get_logger().info('battery')\n\n\n"
    spin = "        executor.add_node(node)\n        executor.add_node(twin)\n        executor.spin()\n"
    text = changed(
        ("def main(", f"{helper}def main("), (MADE, f"{MADE}    twin = Other()\n"), (SPIN, spin)
    )
    for symptom in ("run.twice", "run.wrong_step"):
        found = look(symptom, text)
        assert found is None or found.kind != "node.two_nodes_count"


@pytest.mark.parametrize("condition", ["args is None", "not args", "__name__ != '__main__'"])
def test_a_condition_that_ends_main_for_ros2_run(condition: str, tmp_path: Path) -> None:
    ends = f"    if {condition}:\n        print('nothing to do')\n        return\n"
    text = changed((INIT, ends + INIT))
    found = look("run.exits_at_once", text)
    first = line_of(text, f"if {condition}:")
    assert fix_of(found) == f"Delete line {first}-{first + 2}, the if with all its lines."
    assert patched(found, text, tmp_path) == changed()


def test_a_condition_with_else_is_not_deleted() -> None:
    ends = "    if args is None:\n        return\n    else:\n        print(args)\n"
    found = look("run.exits_at_once", changed((INIT, ends + INIT)))
    assert found is None or found.kind != "node.return_early"


def test_an_executor_below_its_with() -> None:
    block = (
        "        with SingleThreadedExecutor() as executor:\n"
        "            executor.add_node(node)\n        executor.spin()\n"
    )
    text = changed((SPIN, block))
    found = look("run.exits_at_once", text)
    line = line_of(text, "executor.add_node(node)")
    assert fix_of(found).startswith(f"Indent this line as far as line {line}:")


def test_an_executor_below_the_with_that_ends_it() -> None:
    block = (
        "        executor = SingleThreadedExecutor()\n        with executor:\n"
        "            executor.add_node(node)\n        executor.spin()\n"
    )
    found = look("run.exits_at_once", changed((SPIN, block)))
    assert fix_of(found).startswith("Indent this line as far as line")


def test_a_method_of_a_helper_class_that_spins_and_is_only_named() -> None:
    app = "class App:\n\n    def start(self):\n        rclpy.spin(MyFirstNode())\n\n\ndef main("
    text = changed(
        ("def main(", app), (SPIN, "        pass\n"), (MADE, "    app = App()\n    app.start\n")
    )
    assert fix_of(look("run.exits_at_once", text)) == "Write app.start()."


def test_an_executor_in_its_with_is_not_the_cause() -> None:
    block = (
        "        with SingleThreadedExecutor() as executor:\n"
        "            executor.add_node(node)\n            executor.spin()\n"
    )
    found = look("run.exits_at_once", changed((SPIN, block)))
    assert found is None or found.kind != "node.executor_ended"


def test_an_executor_of_a_with_is_spun_by_its_own_method() -> None:
    block = (
        "        with SingleThreadedExecutor() as executor:\n"
        "            executor.add_node(node)\n            executor.spin_once()\n"
    )
    found = look("run.exits_at_once", changed((SPIN, block)))
    assert fix_of(found) == "Write executor.spin() instead of executor.spin_once()."


def test_a_function_that_spins_and_is_only_named(tmp_path: Path) -> None:
    run = "def run(node):\n    rclpy.spin(node)\n\n\ndef main("
    text = changed(("def main(", run), (SPIN, "        run\n"))
    found = look("run.exits_at_once", text)
    assert fix_of(found) == "Write run(node)."
    right = changed(("def main(", run), (SPIN, "        run(node)\n"))
    assert patched(found, text, tmp_path) == right


@pytest.mark.parametrize(
    ("call", "variant"),
    [
        ("signal.signal(signal.SIGINT, signal.SIG_IGN)", "ignored"),
        ("signal.signal(signal.SIGINT, lambda *_: None)", ""),
        ("signal.signal(signal.SIGTERM, lambda *_: None)", None),
        ("signal.signal(signal.SIGINT, signal.SIG_DFL)", None),
        ("signal.signal(signal.SIGINT, lambda *_: rclpy.shutdown())", None),
    ],
)
def test_only_what_keeps_ctrl_c_from_the_node_is_named(call: str, variant: str | None) -> None:
    text = changed(
        ("import rclpy\n", "import signal\n\nimport rclpy\n"), (MADE, f"    {call}\n{MADE}")
    )
    found = look("run.ignores_interrupt", text)
    named = found is not None and found.kind == "node.signal_handler"
    assert named == (variant is not None)
    assert not named or (found is not None and found.variant == variant)


def test_a_loop_in_a_thread_beside_a_spin_that_is_there() -> None:
    work = (
        "def work(node):\n    while True:\n        time.sleep(1.0)\n        node.timer_callback()\n"
    )
    start = f"{MADE}    threading.Thread(target=work, args=(node,)).start()\n"
    text = changed(("def main(", f"{work}\n\ndef main("), (MADE, start))
    assert fix_of(look("run.never_spins", text)).endswith("main spins the node already.")


def test_a_loop_beside_a_thread_that_spins() -> None:
    start = f"{MADE}    thread = threading.Thread(target=rclpy.spin, args=(node,))\n    thread.start()\n"
    loop = "        while rclpy.ok():\n            time.sleep(1.0)\n            node.timer_callback()\n"
    text = changed((MADE, start), (SPIN, loop))
    first = line_of(text, "thread = threading")
    fix = fix_of(look("run.never_spins", text))
    assert fix.endswith(f"delete the thread that spins the node now (lines: {first}, {first + 1}).")


def test_calls_of_a_method_that_becomes_a_function() -> None:
    text = b"class App:\n    def main(self):\n        App.main\n\n\nif True:\n    App().main()\n"
    assert calls_of_method(text, "App.main") == [(7, "App().main")]
    assert calls_of_method(b"class App:\n    pass\n\nmain()\n", "App.main") == []
