"""Errors of classes, names and attributes: the text names the real cause, and not what looks like it."""

from __future__ import annotations

from grader.mistakes.catalogue import CATALOGUE
from grader.mistakes.recognise import SYMPTOMS, behind_symptom
from grader.mistakes.recognised import RecognisedMistake, Suspect
from grader.report.model import Where
from tests.marking import ASSIGNMENT
from tests.mistakes.test_from_source import FILE, line_of, node_in, raised

HEAD = "import rclpy\nfrom rclpy.node import Node\n\n\n"
START = """\
class MyFirstNode(Node):
    def __init__(self):
        super().__init__('my_first_node')
        self.counter_ = 0
        self.create_timer(1.0, self.timer_callback)
"""
CALLBACK = """
    def timer_callback(self):
        self.get_logger().info('Hello time: ' + str(self.counter_))
        self.counter_ += 1
"""
MAIN = """

def main(args=None):
    rclpy.init(args=args)
    node = MyFirstNode()
    rclpy.spin(node)
"""
NO_NAME = "TypeError: Node.__init__() missing 1 required positional argument: 'node_name'"


def texts(found: RecognisedMistake | None) -> tuple[str, str, str]:
    """Return the kind with its variant, the reason and the fix."""
    assert found is not None
    kind, values = CATALOGUE[found.kind], {**found.params, **found.words}
    why, fix = kind.rationale(values, found.variant), kind.fix_text(values, found.variant)
    return f"{found.kind}/{found.variant}", str(why), str(fix)


def at_error(error: str, text: str, part: str, inside: str = "") -> RecognisedMistake | None:
    return raised(error, text, line_of(text, part), inside)


def test_a_class_without_init_has_no_first_line_of_it() -> None:
    text = HEAD + "class MyFirstNode(Node):\n    counter_ = 0\n" + CALLBACK + MAIN
    kind, _, fix = texts(at_error(NO_NAME, text, "= MyFirstNode()"))
    assert kind == "node.super_without_name/no_init"
    assert "def __init__(self):" in fix


def test_super_in_a_method_that_runs_later_is_not_missing() -> None:
    text = HEAD + START.replace("        super().__init__('my_first_node')\n", "") + CALLBACK
    text += "\n    def start(self):\n        super().__init__('my_first_node')\n" + MAIN
    error = "AttributeError: 'MyFirstNode' object has no attribute '_default_callback_group'"
    kind, _, fix = texts(at_error(error, text, "create_timer"))
    assert kind == "node.super_late/"
    assert "to the first line of __init__" in fix


def test_the_same_wrong_text_in_both_definitions_is_not_from_the_second_def() -> None:
    wrong = CALLBACK.replace("time: ", "time ")
    text = HEAD + START + wrong + wrong + MAIN
    source = node_in(text)
    rows = [n for n, row in enumerate(text.splitlines(), 1) if "get_logger" in row]
    place = Where(file=FILE, line=rows[-1])
    suspect = Suspect(source, ASSIGNMENT, text="Hello time 0", place=place)
    found = behind_symptom("run.wrong_text", suspect)
    assert "run.wrong_text" in SYMPTOMS
    assert found is None or found.kind != "node.method_twice"


def test_a_message_callback_without_a_parameter_is_not_called_with_too_much() -> None:
    text = (
        HEAD + START + "        self.create_subscription(String, 'a', self.heard, 10)\n" + CALLBACK
    )
    text += "\n    def heard(self):\n        pass\n" + MAIN
    error = "TypeError: MyFirstNode.heard() takes 1 positional argument but 2 were given"
    kind, _, fix = texts(at_error(error, text, "rclpy.spin", "rclpy"))
    assert kind == "node.arguments_many/message"
    assert fix == "Write: def heard(self, msg):"


def test_a_text_in_an_attribute_is_no_part_of_a_message() -> None:
    text = (
        HEAD + START.replace("= 0", "= 'a'") + CALLBACK + "        self.counter_.info('x')\n" + MAIN
    )
    error = "AttributeError: 'str' object has no attribute 'info'"
    found = at_error(error, text, "counter_.info")
    assert found is None or found.kind != "node.field_type"


def test_an_inner_function_of_a_method_knows_self() -> None:
    text = HEAD + START.replace("self.timer_callback)", "tick)").replace(
        "        self.create_timer",
        "\n        def tick():\n            get_logger().info('Hello')\n\n        self.create_timer",
    )
    kind, _, fix = texts(
        at_error("NameError: name 'get_logger' is not defined", text + MAIN, "info(")
    )
    assert kind == "node.self_missing/"
    assert fix == "Write self.get_logger instead of get_logger."


def unknown(name: str, row: str) -> tuple[str, str, str]:
    text = HEAD + START + f"        {row}  # here\n" + CALLBACK + MAIN
    return texts(at_error(f"NameError: name '{name}' is not defined", text, "# here"))


def test_a_message_that_is_not_imported_is_no_word_of_another_language() -> None:
    for row in ("msg = String()", "self.create_publisher(String, 'a', 10)"):
        kind, _, fix = unknown("String", row)
        assert kind == "node.import_missing/"
        assert fix.endswith("from std_msgs.msg import String")
    assert unknown("String", "x = String(self.counter_)")[2] == "Write str instead of String."
    assert unknown("Int32", "x = Int32()")[2].endswith("from std_msgs.msg import Int32")


def test_a_module_is_not_what_is_called() -> None:
    for name in ("Timer", "Time", "Random"):
        kind, _, fix = unknown(name, f"x = {name}()")
        assert kind == "node.name_unknown/"
        assert name.lower() not in fix


def test_a_function_of_rclpy_is_called_through_the_module() -> None:
    assert unknown("init", "init()")[2] == "Write rclpy.init instead of init."
    assert unknown("shutdown", "shutdown()")[2] == "Write rclpy.shutdown instead of shutdown."


def test_a_library_that_is_not_installed_is_not_misspelt() -> None:
    error = "ModuleNotFoundError: No module named 'numpy'"
    text = HEAD.replace("rclpy\n", "rclpy\nimport numpy as np\n", 1) + START + CALLBACK
    text = (text + MAIN).replace("str(self.counter_)", "str(np.abs(self.counter_))")
    kind, why, fix = texts(at_error(error, text, "import numpy"))
    assert kind == "node.import_misspelt/not_installed"
    assert "not installed" in why
    assert "spelling" not in fix


def not_set(name: str, text: str, part: str = "") -> tuple[str, str, str]:
    error = f"AttributeError: 'MyFirstNode' object has no attribute '{name}'"
    return texts(at_error(error, text, part or f"self.{name}"))


def test_a_global_that_is_counted_through_self_gets_a_first_value() -> None:
    text = (
        HEAD + "total = 0\n\n\n" + START + CALLBACK + "        self.total = self.total + 1\n" + MAIN
    )
    assert not_set("total", text)[0] == "node.attribute_not_set/"
