"""Mistakes of beginners beyond the catalogue and the corpus, and what a teacher would say.

`fails` is the check that must fail. All of it was written before the packages were marked for the
first time.
"""

from __future__ import annotations

from dataclasses import dataclass

from grader.package.edit.tree import Delete, Edit, Move, Replace, Write
from tests.corpus.model import CFG, INIT, INNER, MANIFEST, MARKER, NODE, SETUP

STARTS, OUTPUT, SOURCE = "run.starts", "run.output", "source.node_file"
BUILD, ENTRY, STOP = "build.colcon", "entry_point.mapping", "run.interrupt"
LOG = "self.get_logger().info('Hello time: ' + str(self.counter_))"
TIMER = "self.create_timer(1.0, self.timer_callback)"
COUNT = "self.counter_ = 0"
STEP = "self.counter_ += 1"
SUPER = "super().__init__('my_first_node')"
CLASS = "class MyFirstNode(Node):"
MAKE = "node = MyFirstNode()"
SPIN = "rclpy.spin(node)"
IMPORT = "from rclpy.node import Node"
TARGET = "my_robot_controller.my_first_node:main"
SHEBANG = "#!/usr/bin/env python3"


@dataclass(frozen=True)
class Invented:
    """A package with one mistake: the check that must fail, its cause, and the place to name."""

    name: str
    edits: tuple[Edit, ...]
    fails: str
    cause: str
    place: str


def _node(name: str, old: str, new: str, fails: str, cause: str, place: str) -> Invented:
    return Invented(name, (Replace(NODE, old, new),), fails, cause, place)


def _in(path: str, name: str, old: str, new: str, fails: str, cause: str) -> Invented:
    return Invented(name, (Replace(path, old, new),), fails, cause, path)


SYNTAX = (
    _node("capital_class", "class MyFirstNode", "Class MyFirstNode", SOURCE,
          "The keyword is class, with a small c.", "line of the class"),
    _node("capital_import", "import rclpy\nfrom", "Import rclpy\nfrom", SOURCE,
          "The keyword is import, with a small i.", "line of the import"),
    _node("define_for_def", "def timer_callback", "define timer_callback", SOURCE,
          "A function begins with def.", "line of timer_callback"),
    _node("arrow_of_cpp", "self.get_logger().info", "self.get_logger()->info", SOURCE,
          "Python has a dot where C++ has ->.", "line of the log"),
    _node("colon_after_super", SUPER, SUPER + ":", SOURCE,
          "The colon at the end of the call does not belong there.", "line of super"),
    _node("one_equals_in_guard", "__name__ == '", "__name__ = '", SOURCE,
          "A comparison needs two equals signs.", "line of the guard"),
    _node("brace_not_closed", "'Hello time: ' + str(self.counter_)",
          "f'Hello time: {self.counter_'", SOURCE,
          "The brace in the f-string is not closed.", "line of the log"),
    _node("one_bracket_too_many", "str(self.counter_))", "str(self.counter_)))", SOURCE,
          "There is one ) too many at the end.", "line of the log"),
    _node("quotes_do_not_match", "'Hello time: '", "'Hello time: \"", SOURCE,
          "The string begins with ' and must end with '.", "line of the log"),
    _node("docstring_not_closed", '"""Say hello once; the timer calls this for as long as the '
          'node spins."""', '"""Say hello once', SOURCE,
          "The docstring's three closing quotes are missing.", "line of that docstring"),
    _node("body_not_indented", "    rclpy.init(args=args)\n    node", "rclpy.init(args=args)\n    node",
          SOURCE, "The body of main must be indented.", "line of rclpy.init"),
    _node("class_in_square_brackets", "(Node):", "[Node]:", SOURCE,
          "The base class stands in round brackets.", "line of the class"),
)  # fmt: skip
NAMES = (
    _node("self_with_capital", STEP, "Self.counter_ += 1", OUTPUT,
          "It is self, with a small s.", "line of Self"),
    _node("this_for_self", STEP, "this.counter_ += 1", OUTPUT,
          "Python's name for the object is self, not this.", "line of this"),
    _node("none_with_small_n", "def main(args=None)", "def main(args=none)", STARTS,
          "It is None, with a capital N.", "line of main"),
    _node("spin_self", SPIN, "rclpy.spin(self)", STARTS,
          "In main there is no self: spin the node, rclpy.spin(node).", "line of spin"),
    _node("node_for_self", TIMER, "node.create_timer(1.0, self.timer_callback)", STARTS,
          "Inside the class the node is self, not node.", "line of create_timer"),
    _node("class_from_module", IMPORT, "from rclpy import node", STARTS,
          "Node is imported with: from rclpy.node import Node.", "line of the import"),
    Invented("inherits_from_module",
             (Replace(NODE, IMPORT, "from rclpy import node"), Replace(NODE, "(Node)", "(node)")),
             STARTS, "node is the module; the class is Node of rclpy.node.", "line of the class"),
    _node("module_with_capital", IMPORT, "from rclpy.Node import Node", STARTS,
          "The module is rclpy.node, with a small n.", "line of the import"),
    Invented("node_of_rclpy", (Replace(NODE, IMPORT + "\n", ""),
                               Replace(NODE, "(Node)", "(rclpy.Node)")), STARTS,
             "The class is rclpy.node.Node.", "line of the class"),
    _node("loginfo_of_ros1", "self.get_logger().info", "rclpy.loginfo", OUTPUT,
          "loginfo is ROS 1; a node logs with self.get_logger().info.", "line of the log"),
    _node("import_rospy", "import rclpy\nfrom", "import rclpy\nimport rospy\nfrom", STARTS,
          "rospy is ROS 1 and does not exist in ROS 2: remove the import.", "line of the import"),
    _node("init_node_of_ros1", MAKE, MAKE + "\n    rclpy.init_node('my_first_node')", STARTS,
          "init_node is ROS 1; the class makes the node.", "line of init_node"),
    _node("import_of_next_lesson", "import rclpy\nfrom",
          "import rclpy\nfrom turtlesim.msg import Pose\nfrom", STARTS,
          "turtlesim is not installed here, and the node does not use it: remove the import.",
          "line of the import"),
    _node("logger_method_with_capital", "().info(", "().Info(", OUTPUT,
          "The method is info, with a small i.", "line of the log"),
    _node("keyboard_interrupt_misspelt", "except KeyboardInterrupt", "except KeyboardInterupt",
          STOP, "The exception is spelt KeyboardInterrupt.", "line of except"),
)  # fmt: skip
CALLS = (
    _node("decimal_comma", "create_timer(1.0,", "create_timer(1,0,", STARTS,
          "1,0 is two numbers: a decimal point, 1.0, is meant.", "line of create_timer"),
    _node("three_arguments", "self.timer_callback)", "self.timer_callback, self)", STARTS,
          "create_timer takes the period and the callback only; remove self.",
          "line of create_timer"),
    _node("wrong_keyword", TIMER, "self.create_timer(period=1.0, callback=self.timer_callback)",
          STARTS, "The parameter is timer_period_sec; write create_timer(1.0, ...).",
          "line of create_timer"),
    _node("lambda_without_call", "self.timer_callback)", "lambda: self.timer_callback)", OUTPUT,
          "The lambda does not call the callback; pass self.timer_callback itself.",
          "line of create_timer"),
    _node("callback_of_the_class", "self.timer_callback)", "MyFirstNode.timer_callback)", OUTPUT,
          "The callback must be the object's: self.timer_callback.", "line of create_timer"),
    _node("negative_period", "create_timer(1.0", "create_timer(-1.0", STARTS,
          "A period cannot be negative.", "line of create_timer"),
    Invented("callback_named_create_timer",
             (Replace(NODE, "def timer_callback", "def create_timer"),
              Replace(NODE, "self.timer_callback)", "self.create_timer)")), STARTS,
             "The callback has the name of Node's create_timer and replaces it: rename it.",
             "line of def create_timer"),
    _node("init_not_called", "rclpy.init(args=args)", "rclpy.init", STARTS,
          "rclpy.init needs brackets: without them it is not called.", "line of rclpy.init"),
    _node("spin_without_node", SPIN, "rclpy.spin()", STARTS,
          "spin needs the node: rclpy.spin(node).", "line of spin"),
    _node("two_names_for_node", SUPER, "super().__init__('my_first_node', 'robot')", STARTS,
          "Node takes one name; remove the second argument.", "line of super"),
    _node("base_class_called", "(Node):", "(Node()):", STARTS,
          "The base class is Node without brackets.", "line of the class"),
    _node("plain_node", MAKE, "node = Node('my_first_node')", OUTPUT,
          "main makes a plain Node instead of MyFirstNode().", "line of node ="),
    _node("print_argument", "str(self.counter_))", "str(self.counter_), end='')", OUTPUT,
          "end belongs to print; the logger does not have it.", "line of the log"),
    Invented("executor_not_spun",
             (Replace(NODE, SPIN, "executor = SingleThreadedExecutor()\n        "
                      "executor.add_node(node)"),
              Replace(NODE, IMPORT, f"from rclpy.executors import SingleThreadedExecutor\n{IMPORT}")),
             STARTS, "executor.spin() is missing.", "line of add_node"),
    Invented("spin_in_guard",
             (Replace(NODE, "    try:\n        rclpy.spin(node)\n    except KeyboardInterrupt:\n"
                      "        pass\n    finally:\n        node.destroy_node()\n"
                      "        rclpy.try_shutdown()\n", "    return node\n"),
              Replace(NODE, "    main()\n", "    rclpy.spin(main())\n")), STARTS,
             "ros2 run calls main only: spin must be in main, not under the guard.",
             "line of spin"),
)  # fmt: skip
VALUES = (
    _node("counter_is_text", COUNT, "self.counter_ = '0'", OUTPUT,
          "The counter must be a number: 0 without quotes.", "line of counter_ ="),
    _node("counter_is_tuple", COUNT, "self.counter_ = 0,", OUTPUT,
          "The comma behind 0 makes a tuple: remove it.", "line of counter_ ="),
    _node("counter_is_none", COUNT, "self.counter_ = None", OUTPUT,
          "The counter must begin with 0, not None.", "line of counter_ ="),
    _node("comma_for_dot", COUNT, "self,counter_ = 0", STARTS,
          "There is a comma between self and counter_: it must be a dot.", "line of counter_ ="),
    _node("compares_for_adds", STEP, "self.counter_ == self.counter_ + 1", OUTPUT,
          "== compares; one = (or +=) assigns.", "line of =="),
    _node("timer_overwrites_counter", TIMER, f"self.counter_ = {TIMER}", OUTPUT,
          "The timer is stored in self.counter_ and overwrites the counter.",
          "line of create_timer"),
    _node("logger_overwritten", COUNT, f"{COUNT}\n        self.get_logger = self.get_logger()",
          OUTPUT, "self.get_logger is overwritten with the logger: give it another name.",
          "line of get_logger ="),
    _node("name_of_node_taken", COUNT, f"{COUNT}\n        self.timers = []", STARTS,
          "Node already has timers; give the attribute another name.", "line of self.timers"),
    _node("str_overwritten", LOG, "str = 'Hello time: '\n        self.get_logger().info(str + "
          "str(self.counter_))", OUTPUT,
          "The variable str hides Python's str(): rename it.", "line of str ="),
    _node("round_brackets_in_f_string", "'Hello time: ' + str(self.counter_)",
          "f'Hello time: (self.counter_)'", OUTPUT,
          "In an f-string, values stand in braces, not round brackets.", "line of the log"),
    _node("format_forgotten", "'Hello time: ' + str(self.counter_)", "'Hello time: {}'", OUTPUT,
          "{} is filled only by .format(self.counter_) or in an f-string.", "line of the log"),
    _node("loop_in_callback", f"        {LOG}\n        {STEP}\n", f"        for i in range(10):\n"
          f"            {LOG}\n            {STEP}\n", OUTPUT,
          "The loop logs ten lines at each call; the timer already repeats: remove the loop.",
          "line of for"),
    _node("logs_only_at_first", f"        {LOG}\n", f"        if self.counter_ < 5:\n"
          f"            {LOG}\n", OUTPUT,
          "The if stops the lines after the fifth one.", "line of if"),
    _node("increase_never_reached", f"        {STEP}\n", "        if self.counter_ > 0:\n"
          f"            {STEP}\n", OUTPUT,
          "The counter is 0, so the if is never true and nothing is added.", "line of if"),
    Invented("callback_defined_twice",
             (Replace(NODE, f"        {STEP}\n", f"        {STEP}\n\n    def timer_callback(self):\n"
                      "        pass\n"),), OUTPUT,
             "timer_callback is defined twice, and the second, empty one counts.",
             "line of the second def"),
    Invented("init_defined_twice",
             (Replace(NODE, f"        {TIMER}\n", f"        {TIMER}\n\n    def __init__(self):\n"
                      f"        {SUPER}\n"),), OUTPUT,
             "__init__ is defined twice; the second one, without a timer, counts.",
             "line of the second def"),
    _node("int_for_init", "def __init__", "def __int__", STARTS,
          "The method is __init__; __int__ is another one.", "line of __int__"),
)  # fmt: skip
PACKAGE = (
    _in(MANIFEST, "ampersand_in_manifest", "says hello", "says hello & counts", "package.manifest",
        "In XML, & must be written &amp;."),
    _in(MANIFEST, "build_type_outside_export",
        "  <export>\n    <build_type>ament_python</build_type>\n  </export>\n",
        "  <build_type>ament_python</build_type>\n", "package.manifest",
        "<build_type> must be inside <export>."),
    _in(MANIFEST, "version_with_two_numbers", "<version>0.0.0<", "<version>1.0<",
        "package.manifest", "A version has three numbers: 1.0.0."),
    _in(CFG, "section_misspelt", "[install]", "[instal]", "package.setup_cfg",
        "The section is [install]."),
    _in(CFG, "dollar_missing", "install_scripts=$base/", "install_scripts=base/",
        "package.setup_cfg", "The $ before base is missing."),
    Invented("marker_is_a_folder", (Delete(MARKER), Write(f"{MARKER}/.keep", "")),
             "package.marker", "The marker must be an empty file, and it is a folder.", MARKER),
    Invented("init_with_single_underscores", (Move(INIT, f"{INNER}/_init_.py"),), STARTS,
             "The file must be called __init__.py, with two underscores on both sides.",
             f"{INNER}/_init_.py"),
    Invented("node_saved_as_text", (Move(NODE, f"{NODE}.txt"),), SOURCE,
             "The file has the ending .txt behind .py: rename it.", f"{NODE}.txt"),
    Invented("node_in_init_file", (Delete(INIT), Move(NODE, INIT)), SOURCE,
             "The node is in __init__.py: it belongs in my_first_node.py.", INIT),
    _in(SETUP, "class_as_target", TARGET, "my_robot_controller.my_first_node:MyFirstNode", ENTRY,
        "The entry must name the function main, not the class."),
    _in(SETUP, "package_twice_in_target", TARGET, f"my_robot_controller.{TARGET}", ENTRY,
        "The package's name stands twice."),
    _in(SETUP, "tuple_comma_missing", "['resource/' + package_name]),", "['resource/' + package_name])",
        BUILD, "The comma between the two entries of data_files is missing."),
    _in(SETUP, "group_without_quotes", "'console_scripts'", "console_scripts", BUILD,
        "console_scripts needs quotes."),
    _in(SETUP, "packages_misspelt", "find_packages(exclude=['test'])", "['my_first_node']", BUILD,
        "packages must name the folder my_robot_controller, not the node's file."),
    Invented("shebang_without_mark", (Replace(NODE, SHEBANG, "#/usr/bin/env python3"),),
             "source.shebang", "The ! behind # is missing.", "line 1"),
    Invented("shebang_with_capital", (Replace(NODE, SHEBANG, "#!/usr/bin/env Python3"),),
             "source.shebang", "The program is python3, with a small p.", "line 1"),
)  # fmt: skip
INVENTED = (*SYNTAX, *NAMES, *CALLS, *VALUES, *PACKAGE)
