"""Errors of classes, names and attributes: the text names the real cause, and not what looks like it."""

from __future__ import annotations

import textwrap

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


def code(text: str) -> str:
    return textwrap.dedent(text).lstrip("\n")


def texts(found: RecognisedMistake | None) -> tuple[str, str, str]:
    """Return the kind with its variant, the reason and the fix."""
    assert found is not None
    kind, values = CATALOGUE[found.kind], {**found.params, **found.words}
    why, fix = kind.rationale(values, found.variant), kind.fix_text(values, found.variant)
    return f"{found.kind}/{found.variant}", str(why), str(fix)


def at_error(error: str, text: str, part: str, inside: str = "") -> RecognisedMistake | None:
    return raised(error, text, line_of(text, part), inside)


def test_a_helper_that_passes_a_value_to_object_is_not_to_become_a_node() -> None:
    helper = "class Counter:\n    def __init__(self, start):\n        super().__init__(start)\n\n\n"
    error = "TypeError: object.__init__() takes exactly one argument (the instance to initialize)"
    kind, why, fix = texts(
        at_error(error, HEAD + helper + START + CALLBACK + MAIN, "__init__(start)")
    )
    assert kind == "node.value_for_object/"
    assert "Counter" in why
    assert fix.startswith("Write super().__init__() instead of super().__init__(start)")
    base = helper.replace("Counter", "Base").replace("start", "name")
    text = HEAD + base + START.replace("(Node)", "(Base)") + CALLBACK + MAIN
    kind, _, fix = texts(at_error(error, text, "__init__(name)"))
    assert kind == "node.not_a_node/"
    assert fix == "Write: class Base(Node):"


def test_a_set_up_that_main_calls_becomes_init_and_its_call_goes() -> None:
    text = HEAD + START.replace("__init__(self)", "setup(self)") + CALLBACK + MAIN
    text = text.replace("    rclpy.spin(node)", "    node.setup()\n    rclpy.spin(node)")
    found = at_error(NO_NAME, text, "node = MyFirstNode()")
    kind, _, fix = texts(found)
    assert kind == "node.init_other_name/"
    assert f"(lines: {line_of(text, 'node.setup()')})" in fix
    kind, _, fix = texts(
        at_error(NO_NAME, text.replace("    node.setup()\n", ""), "node = MyFirstNode()")
    )
    assert kind == "node.init_other_name/uncalled"
    text = HEAD + START.replace("__init__(self)", "_init_(self)") + CALLBACK + MAIN
    assert texts(at_error(NO_NAME, text, "= MyFirstNode()"))[0] == "node.init_underscores/"


def test_a_set_up_with_the_name_of_its_class_is_not_called_by_the_line_that_makes_the_node() -> (
    None
):
    text = HEAD + START.replace("__init__(self)", "MyFirstNode(self)") + CALLBACK + MAIN
    kind, _, fix = texts(at_error(NO_NAME, text, "node = MyFirstNode()"))
    assert kind == "node.init_other_name/uncalled"
    assert "Delete" not in fix


def test_a_plain_node_is_not_told_to_call_super() -> None:
    text = (HEAD + START + CALLBACK + MAIN).replace("= MyFirstNode()", "= Node()")
    kind, _, fix = texts(at_error(NO_NAME, text, "= Node()"))
    assert kind == "node.super_without_name/plain_class"
    assert fix == "Write MyFirstNode() instead of Node()."


def test_a_base_class_passes_its_own_parameter_on() -> None:
    base = "class Base(Node):\n    def __init__(self, name):\n        super().__init__()\n\n\n"
    text = HEAD + base + START.replace("(Node)", "(Base)") + CALLBACK + MAIN
    kind, _, fix = texts(at_error(NO_NAME, text, "super().__init__()"))
    assert kind == "node.super_without_name/here_parameter"
    assert fix == "Write super().__init__(name) instead of super().__init__()."


def test_a_class_without_init_has_no_first_line_of_it() -> None:
    text = HEAD + "class MyFirstNode(Node):\n    counter_ = 0\n" + CALLBACK + MAIN
    kind, why, fix = texts(at_error(NO_NAME, text, "= MyFirstNode()"))
    assert kind == "node.super_without_name/no_init"
    assert "has no __init__" in why
    assert "def __init__(self):" in fix


def test_super_in_a_method_that_runs_later_is_not_missing() -> None:
    text = HEAD + START.replace("        super().__init__('my_first_node')\n", "") + CALLBACK
    text += "\n    def start(self):\n        super().__init__('my_first_node')\n" + MAIN
    error = "AttributeError: 'MyFirstNode' object has no attribute '_default_callback_group'"
    kind, why, fix = texts(at_error(error, text, "create_timer"))
    assert kind == "node.super_late/method"
    assert "only in start" in why
    assert "in start" in fix


def test_the_init_of_an_own_base_that_is_passed_over() -> None:
    base = (
        "class Counting(Node):\n    def __init__(self, name):\n        super().__init__(name)\n"
        "        self.counter_ = 0  # first\n\n\n"
    )
    init = START.replace("(Node)", "(Counting)").replace("        self.counter_ = 0\n", "")
    init = init.replace("super().__init__(", "Node.__init__(self, ")
    text = HEAD + base + init + CALLBACK + MAIN
    error = "AttributeError: 'MyFirstNode' object has no attribute 'counter_'"
    kind, why, fix = texts(at_error(error, text, "get_logger"))
    assert kind == "node.attribute_not_set/base_skipped"
    assert why.startswith(f"Line {line_of(text, '# first')}, in the __init__ of Counting")
    assert fix == (
        "Write super().__init__('my_first_node') instead of Node.__init__(self, 'my_first_node')."
    )


def test_an_attribute_that_a_line_deletes_was_set() -> None:
    text = HEAD + START + CALLBACK + "        del self.counter_\n" + MAIN
    error = "AttributeError: 'MyFirstNode' object has no attribute 'counter_'"
    kind, why, _ = texts(at_error(error, text, "get_logger"))
    assert kind == "node.attribute_not_set/deleted"
    assert f"Line {line_of(text, 'del ')} deletes" in why


def test_a_helper_that_gets_the_node_needs_only_to_keep_it() -> None:
    helper = (
        "class Ticker:\n    def __init__(self, owner):\n        self.create_timer(1.0, self.tick)\n"
        "\n    def tick(self):\n        pass\n\n\n"
    )
    text = HEAD + helper + START + "        self.ticker = Ticker(self)\n" + CALLBACK + MAIN
    error = "AttributeError: 'Ticker' object has no attribute 'create_timer'"
    kind, _, fix = texts(at_error(error, text, "self.tick)"))
    assert kind == "node.attribute_not_set/no_node_kept"
    assert fix.startswith("Write self.owner = owner in the __init__ of Ticker")


def test_a_callback_outside_with_a_parameter_for_the_node_gets_self_in_all_lines() -> None:
    outside = CALLBACK.replace("\n    ", "\n").replace("self", "node").lstrip("\n")
    text = HEAD + outside + "\n\n" + START + MAIN
    error = "AttributeError: 'MyFirstNode' object has no attribute 'timer_callback'"
    kind, _, fix = texts(at_error(error, text, "create_timer"))
    assert kind == "node.callback_outside/parameter"
    assert "write self instead of node" in fix


def test_another_node_of_main_is_not_self() -> None:
    other = (
        "class Counter(Node):\n    def __init__(self):\n        super().__init__('counter')\n\n\n"
    )
    text = HEAD + other + START + CALLBACK.replace("str(self.counter_)", "str(counter.value)")
    text += MAIN.replace("    node =", "    counter = Counter()\n    node =")
    error = "NameError: name 'counter' is not defined"
    kind, why, _ = texts(at_error(error, text, "get_logger"))
    assert kind == "node.name_local/"
    assert why.startswith(f"Line {line_of(text, '= Counter()')} defines counter")


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


def test_a_parameter_is_declared_by_another_line_and_not_by_this_one() -> None:
    text = HEAD + START + "        self.load()\n        self.declare_parameter('a', 1)  # here\n"
    text += CALLBACK + "\n    def load(self):\n        self.declare_parameter('a', 0)\n" + MAIN
    error = (
        "rclpy.exceptions.ParameterAlreadyDeclaredException: Parameter(s) already declared: ['a']"
    )
    kind, why, _ = texts(at_error(error, text, "# here"))
    assert kind == "node.declared_twice/"
    assert why.startswith(f"Line {line_of(text, 'parameter(' + repr('a') + ', 0)')} has declared a")


def test_a_static_callback_that_main_passes_is_not_called_through_self() -> None:
    text = HEAD + START.replace("        self.create_timer(1.0, self.timer_callback)\n", "")
    text += CALLBACK.replace(
        "    def timer_callback(self)", "    @staticmethod\n    def timer_callback()"
    )
    text += MAIN.replace(
        "    rclpy.spin", "    node.create_timer(1.0, MyFirstNode.timer_callback)\n    rclpy.spin"
    )
    kind, _, fix = texts(at_error("NameError: name 'self' is not defined", text, "get_logger"))
    assert kind == "node.static_self/class_outside"
    assert "elsewhere the variable that has the object" in fix


def test_a_message_callback_without_a_parameter_is_not_called_with_too_much() -> None:
    text = (
        HEAD + START + "        self.create_subscription(String, 'a', self.heard, 10)\n" + CALLBACK
    )
    text += "\n    def heard(self):\n        pass\n" + MAIN
    error = "TypeError: MyFirstNode.heard() takes 1 positional argument but 2 were given"
    kind, _, fix = texts(at_error(error, text, "rclpy.spin", "rclpy"))
    assert kind == "node.arguments_many/message"
    assert fix == "Write: def heard(self, msg):"


def test_what_is_too_much_for_an_own_method_is_joined() -> None:
    say = "\n    def say(self, text):\n        self.get_logger().info(text)\n"
    text = HEAD + START + say + "\n    def timer_callback(self):\n"
    text += "        self.say('Hello time:', self.counter_)\n" + MAIN
    error = "TypeError: MyFirstNode.say() takes 2 positional arguments but 3 were given"
    kind, why, fix = texts(at_error(error, text, "self.say("))
    assert kind == "node.arguments_many/own"
    assert f"(line {line_of(text, 'def say')})" in why
    assert "Remove" not in fix


def test_a_function_of_the_timer_gets_its_value_in_the_timer_and_not_in_spin() -> None:
    tick = "def tick(node):\n    node.get_logger().info('Hello')\n\n\n"
    text = HEAD + tick + START.replace("self.timer_callback)", "tick)") + MAIN
    error = "TypeError: tick() missing 1 required positional argument: 'node'"
    found = at_error(error, text, "rclpy.spin", "rclpy")
    kind, _, fix = texts(found)
    assert kind == "node.argument_missing/of_timer_node"
    assert "write lambda: tick(self) instead of tick" in fix
    assert found is not None
    assert found.where is not None
    assert found.where.line == line_of(text, "create_timer")


def test_a_text_in_an_attribute_is_no_part_of_a_message() -> None:
    text = (
        HEAD + START.replace("= 0", "= 'a'") + CALLBACK + "        self.counter_.info('x')\n" + MAIN
    )
    error = "AttributeError: 'str' object has no attribute 'info'"
    found = at_error(error, text, "counter_.info")
    assert found is None or found.kind != "node.field_replaced"


def test_a_logger_that_nothing_sets_is_read_with_brackets() -> None:
    text = HEAD + START + CALLBACK.replace("self.get_logger()", "self.logger") + MAIN
    error = "AttributeError: 'MyFirstNode' object has no attribute 'logger'"
    _, _, fix = texts(at_error(error, text, "self.logger"))
    assert fix == "Write self.get_logger() instead of self.logger."


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


def test_a_parameter_that_is_missing_has_not_lost_its_quotes() -> None:
    text = HEAD + START.replace("__init__('my_first_node')", "__init__(name)") + CALLBACK + MAIN
    kind, _, fix = texts(at_error("NameError: name 'name' is not defined", text, "__init__(name)"))
    assert kind == "node.name_unknown/node_name"
    assert fix.startswith("Write 'my_first_node' instead of name")
    text = text.replace("__init__(name)", "__init__(my_first_node)")
    error = "NameError: name 'my_first_node' is not defined"
    assert texts(at_error(error, text, "(my_first_node)"))[0] == "node.quotes_missing/"


def test_an_attribute_that_the_heir_sets_later_is_set_somewhere() -> None:
    base = (
        "class Base(Node):\n    def __init__(self, name):\n        super().__init__(name)\n"
        "        self.get_logger().debug(str(self.counter_))  # here\n\n\n"
    )
    text = HEAD + base + START.replace("(Node)", "(Base)") + CALLBACK + MAIN
    error = "AttributeError: 'MyFirstNode' object has no attribute 'counter_'"
    kind, why, _ = texts(at_error(error, text, "# here"))
    assert kind == "node.attribute_not_set/set_in_heir"
    assert f"Line {line_of(text, 'self.counter_ = 0')} does so" in why


def test_a_library_that_is_not_installed_is_not_misspelt() -> None:
    error = "ModuleNotFoundError: No module named 'numpy'"
    text = HEAD.replace("rclpy\n", "rclpy\nimport numpy as np\n", 1) + START + CALLBACK
    text = (text + MAIN).replace("str(self.counter_)", "str(np.abs(self.counter_))")
    kind, why, fix = texts(at_error(error, text, "import numpy"))
    assert kind == "node.import_misspelt/not_installed"
    assert "not installed" in why
    assert "spelling" not in fix


def test_an_init_without_underscores_in_a_helper_that_gets_values() -> None:
    helper = "class Counter:\n    def init(self, start):\n        self.n = start\n\n\n"
    text = HEAD + helper + START.replace("= 0", "= Counter(0).n") + CALLBACK + MAIN
    kind, _, fix = texts(at_error("TypeError: Counter() takes no arguments", text, "= Counter("))
    assert kind == "node.class_takes_nothing/near"
    assert fix.startswith("Rename init to __init__")


def not_set(name: str, text: str, part: str = "") -> tuple[str, str, str]:
    error = f"AttributeError: 'MyFirstNode' object has no attribute '{name}'"
    return texts(at_error(error, text, part or f"self.{name}"))


def test_a_parameter_a_variable_and_a_constant_are_no_attributes() -> None:
    start = START.replace("(self)", "(self, period=1.0)").replace(
        "1.0, self.t", "self.period, self.t"
    )
    kind, why, fix = not_set("period", HEAD + start + CALLBACK + MAIN)
    assert kind == "node.attribute_not_set/parameter"
    assert why.startswith("period is a parameter of __init__")
    assert fix.endswith("self.period = period")
    start = START.replace("self.create_timer", "timer = self.create_timer")
    text = HEAD + start + CALLBACK + "        self.timer.reset()\n" + MAIN
    kind, _, fix = not_set("timer", text, "self.timer.reset")
    assert kind == "node.attribute_not_set/local"
    assert fix == "Write self.timer instead of timer on that line."
    text = HEAD + "PERIOD = 1.0\n\n\n" + START.replace("1.0, self.t", "self.PERIOD, self.t")
    kind, why, fix = not_set("PERIOD", text + CALLBACK + MAIN)
    assert kind == "node.attribute_not_set/of_file"
    assert why.startswith(f"Line {line_of(text, 'PERIOD = ')} sets PERIOD outside")
    assert fix == "Write PERIOD instead of self.PERIOD."


def test_a_global_that_is_counted_through_self_gets_a_first_value() -> None:
    text = (
        HEAD + "total = 0\n\n\n" + START + CALLBACK + "        self.total = self.total + 1\n" + MAIN
    )
    assert not_set("total", text)[0] == "node.attribute_not_set/"


def test_a_class_that_is_pasted_twice_without_a_change_is_not_the_cause() -> None:
    text = HEAD + (START + CALLBACK.replace("time: ", "time ") + "\n\n") * 2 + MAIN
    found = behind_symptom(
        "run.wrong_text", Suspect(node_in(text), ASSIGNMENT, text="Hello time 0")
    )
    assert found is None or found.kind != "node.class_twice"
    text = text.replace("self.counter_ = 0", "self.counter_ = 1", 1)
    found = behind_symptom(
        "run.wrong_text", Suspect(node_in(text), ASSIGNMENT, text="Hello time 0")
    )
    assert found is not None
    assert found.kind == "node.class_twice"


def test_rclpy_init_is_no_call_of_an_init_without_underscores() -> None:
    text = HEAD + START.replace("__init__(self)", "init(self)") + CALLBACK
    text += MAIN.replace("MyFirstNode()", "MyFirstNode('my_first_node')")
    found = behind_symptom("run.no_lines", Suspect(node_in(text), ASSIGNMENT))
    assert found is not None
    assert (found.kind, found.variant) == ("node.init_underscores", "silent")
