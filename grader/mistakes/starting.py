"""The catalogue: why a node does not come to life (imports, the entry point's function, its class)."""

from __future__ import annotations

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.kind import Family

INIT = msg(
    "rclpy's Node sets up all that a node needs in its own __init__: timers, logger and "
    "publishers rest on it. Your class has to call it first, with the node's name."
)
SUPER = msg("Write super().__init__('{node_name}') as the first line of __init__.")
CLOSE = msg("Write {close} instead of {name}.")
NAMED = ("import_misspelt", "import_name")
LOOKED_FOR = msg(
    "The entry point ends in :{function}, so Python looks for a function {function} in the module, "
    "at its outermost level."
)
NODES_MADE = msg("rclpy.init() connects the program with ROS; no node can be made before it.")

_node = Family("node", links.FIRST_NODE)
KINDS = (
    _node("no_ros", "start", msg("The file does not use rclpy at all"),
          msg("A program is a ROS node only if it makes one: other programs, ros2 node list and "
              "/rosout see nothing of a loop that prints."),
          msg("Write a class that inherits Node, make a timer in it, and spin it in {function}."),
          links.NODES),
    _node("import_node", "start", msg("Node is imported from rclpy and not from rclpy.node"),
          msg("The class Node lives in the module rclpy.node; rclpy itself has no Node."),
          msg("Write: from rclpy.node import Node"),
          seen=r"ImportError: cannot import name 'Node' from 'rclpy'"),
    _node("import_misspelt", "start", msg("An import names a module that is not there"),
          msg("Python looks for a module of exactly that name, and ends the program if there is "
              "none."),
          msg("Write the module's name letter by letter; modules that are not part of ROS or "
              "Python are not there."),
          links.PYTHON_ERRORS,
          seen=r"ModuleNotFoundError: No module named '(?P<name>(?!rclpy')\w{1,120})'"),
    _node("import_name", "start", msg("An import names something that the module does not have"),
          msg("from module import name works only for a name that the module defines; capitals "
              "count."),
          msg("Compare the name with the documentation of the module."), links.RCLPY,
          seen=r"ImportError: cannot import name '(?P<name>\w{1,120})' from '(?P<module>[\w.]{1,200})'"),
    _node("import_missing", "start", msg("A name is used that is not imported"),
          msg("Python knows only names that the file imports or defines."),
          msg("Add the import at the top of the file: {statement}")),
    _node("main_missing", "start", msg("The entry point's function is not in the module"), LOOKED_FOR,
          msg("Define it: def {function}(args=None):"), links.DEVELOPING,
          seen=r"AttributeError: module '[\w.]{1,200}' has no attribute '(?P<function>main)'"),
    _node("main_misspelt", "start", msg("The entry point's function has another name"), LOOKED_FOR,
          msg("Rename {name} to {function} (also where it is called)."), links.DEVELOPING),
    _node("main_wants_args", "start",
          msg("The entry point's function needs an argument that nobody gives it"),
          msg("The executable calls {function}() without arguments."),
          msg("Give the argument a default: def {function}(args=None):"),
          seen=r"TypeError: (?P<function>main)\(\) missing \d{1,3} required positional argument"),
    _node("main_empty", "start", msg("The entry point's function does not make the node"),
          msg("The executable calls {function}() and ends with it; a class alone does nothing."),
          msg("In {function}: rclpy.init(args=args), then node = YourClass(), then "
              "rclpy.spin(node)."),
          links.NODES),
    _node("waits_first", "start", msg("The program waits before the node is made"),
          msg("Until input(), sleep() or a loop is done, nothing after it happens, and there is no "
              "node."),
          msg("Take {name} out; what is to happen again and again belongs into a timer's "
              "callback.")),
    _node("guard_misspelt", "start", msg("The guard does not compare with '__main__'"),
          msg("Python gives __name__ the value '__main__' in a file that is started itself; with "
              "another text the line below is never reached. (ros2 run does not need it.)"),
          msg("Write: if __name__ == '__main__':")),
    _node("init_missing", "start", msg("rclpy.init() is not called"), NODES_MADE,
          msg("Write rclpy.init(args=args) as the first line of {function}."), links.RCLPY,
          seen=r"NotInitializedException"),
    _node("init_late", "start", msg("rclpy.init() is called after the node is made"), NODES_MADE,
          msg("Move rclpy.init(args=args) to the first line of {function}."), links.RCLPY),
    _node("init_twice", "start", msg("rclpy.init() is called twice"),
          msg("rclpy.init() connects the program with ROS; it is an error to do so again."),
          msg("Keep one rclpy.init(args=args), the first line of {function}."), links.RCLPY,
          seen=r"RuntimeError: Context\.init\(\) must only be called once"),
    _node("class_not_called", "start", msg("The brackets are missing behind the class"),
          msg("The name of a class alone makes no object; only its call does."),
          msg("Write {name}() where the node is made."), links.PYTHON_CLASSES),
    _node("context_manager", "start", msg("with rclpy.init() is of a newer ROS"),
          msg("rclpy.init() can be used in a with statement from ROS 2 kilted on; before, it "
              "returns nothing."),
          msg("Write rclpy.init(args=args) on a line of its own, and no with."), links.RCLPY,
          seen=r"'NoneType' object does not support the context manager protocol"
               r"|AttributeError: __enter__"),
    _node("not_a_node", "class", msg("The class does not inherit Node"),
          msg("A class is a node only if it inherits rclpy's Node; without it super() is Python's "
              "plain object, which takes no name."),
          msg("Write: class {name}(Node):"),
          seen=r"TypeError: object\.__init__\(\) takes exactly one argument"),
    _node("init_underscores", "class", msg("__init__ is not written with two underscores"),
          msg("Python calls __init__, with two underscores on both sides, when an object is made. "
              "A function of another name is never called, and Node gets no name."),
          msg("Rename {name} to __init__: two underscores before and after.")),
    _node("init_no_self", "class", msg("__init__ has no parameter self"),
          msg("Python hands the new object over to __init__ as its first argument."),
          msg("Write: def __init__(self):"), links.PYTHON_CLASSES,
          seen=r"__init__\(\) takes 0 positional arguments but 1 was given"),
    _node("super_not_called", "class", msg("The brackets are missing behind super"),
          msg("super alone is a name of Python's; only super() leads to the class that yours "
              "inherits from."), SUPER, links.PYTHON_CLASSES,
          seen=r"TypeError: descriptor '__init__' requires a 'super' object"),
    _node("super_missing", "class", msg("super().__init__() is not called"), INIT, SUPER,
          seen=r"AttributeError: '\w{1,120}' object has no attribute '_default_callback_group'"),
    _node("super_late", "class", msg("super().__init__() is called too late"), INIT,
          msg("Move super().__init__('{node_name}') to the first line of __init__.")),
    _node("super_without_name", "class", msg("super().__init__() is given no name"),
          msg("A node needs a name: it is what ros2 node list and the log show."), SUPER,
          seen=r"TypeError: Node\.__init__\(\) missing 1 required positional argument: 'node_name'"),
    _node("name_invalid", "class", msg("The node's name has a character that ROS does not allow"),
          msg("Names of nodes have letters, digits and underscores only, and do not begin with a "
              "digit."),
          msg("Write super().__init__('{node_name}')."), links.NAMES,
          seen=r"InvalidNodeNameException: Invalid node name"),
)  # fmt: skip
