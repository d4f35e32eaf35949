"""The catalogue: why a node does not start (imports, the entry point's function, the class)."""

from __future__ import annotations

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.kind import Family

INIT = msg(
    "Node.__init__ sets up what timers, the logger and publishers need. Your class must call it "
    "first, with the node's name."
)
SUPER = msg("Write super().__init__('{node_name}') as the first line of __init__.")
LOOKED_FOR = msg(
    "The entry point ends in :{function}, so Python looks for a function {function} at the top "
    "level of the module."
)
NODES_MADE = msg("rclpy.init() connects the program to ROS; no node can be created before it.")
CLOSE = msg("Write {close} instead of {name}.")

_node = Family("node", links.FIRST_NODE)
KINDS = (
    _node("no_ros", "start", msg("The file does not use rclpy"),
          msg("A program is a ROS node only if it creates one. A loop that only prints does not "
              "appear in ros2 node list, on /rosout or to other programs."),
          msg("Write a class that inherits from Node, create a timer in it, and spin it in "
              "{function}."),
          links.NODES),
    _node("import_node", "start", msg("Node is imported from rclpy instead of rclpy.node"),
          msg("The class Node is in the module rclpy.node; rclpy itself has no Node."),
          msg("Write: from rclpy.node import Node"),
          seen=r"ImportError: cannot import name 'Node' from 'rclpy'"),
    _node("import_misspelt", "start", msg("An import names a module that does not exist"),
          msg("Python looks for a module with exactly that name, and ends the program if there is "
              "none."),
          msg("Check the spelling of the module's name; only modules of ROS and of Python are "
              "available."),
          links.PYTHON_ERRORS, close=CLOSE,
          seen=r"ModuleNotFoundError: No module named '(?P<name>(?!rclpy')\w{1,120})'"),
    _node("import_name", "start", msg("An import names something that the module does not have"),
          msg("from module import name works only for names that the module defines; case "
              "matters."),
          msg("Compare the name with the module's documentation."), links.RCLPY, close=CLOSE,
          seen=r"ImportError: cannot import name '(?P<name>\w{1,120})' from '(?P<module>[\w.]{1,200})'"),
    _node("import_missing", "start", msg("A name is used without being imported"),
          msg("Python knows only names that the file imports or defines."),
          msg("Add the import at the top of the file: {statement}")),
    _node("main_missing", "start", msg("The module does not have the entry point's function"),
          LOOKED_FOR, msg("Define it: def {function}(args=None):"), links.DEVELOPING,
          seen=r"AttributeError: module '[\w.]{1,200}' has no attribute '(?P<function>main)'"),
    _node("main_misspelt", "start", msg("The entry point's function has a different name"),
          LOOKED_FOR, msg("Rename {name} to {function}, also where it is called."),
          links.DEVELOPING),
    _node("main_wants_args", "start",
          msg("The entry point's function needs an argument, but is called without any"),
          msg("The executable calls {function}() without arguments."),
          msg("Give the argument a default: def {function}(args=None):"),
          seen=r"TypeError: (?P<function>main)\(\) missing \d{1,3} required positional argument"),
    _node("main_empty", "start", msg("The entry point's function does not create the node"),
          msg("The executable calls {function}() and ends when it returns. A class alone does "
              "nothing."),
          msg("Write in {function}: rclpy.init(args=args), then node = YourClass(), then "
              "rclpy.spin(node)."),
          links.NODES),
    _node("waits_first", "start", msg("The program waits before it creates the node"),
          msg("Until input(), sleep() or a loop is done, nothing after it runs, and there is no "
              "node."),
          msg("Remove {name}. What must happen again and again belongs in a timer's callback.")),
    _node("guard_misspelt", "start", msg("The guard does not compare with '__main__'"),
          msg("Python sets __name__ to '__main__' in a file that is started directly. With any "
              "other text the line below never runs. (ros2 run does not need it.)"),
          msg("Write: if __name__ == '__main__':")),
    _node("init_missing", "start", msg("rclpy.init() is not called"), NODES_MADE,
          msg("Write rclpy.init(args=args) as the first line of {function}."), links.RCLPY,
          seen=r"NotInitializedException"),
    _node("init_late", "start", msg("rclpy.init() is called after the node is created"), NODES_MADE,
          msg("Move rclpy.init(args=args) to the first line of {function}."), links.RCLPY),
    _node("init_twice", "start", msg("rclpy.init() is called twice"),
          msg("rclpy.init() connects the program to ROS; calling it again is an error."),
          msg("Keep only one rclpy.init(args=args), in the first line of {function}."),
          links.RCLPY, seen=r"RuntimeError: Context\.init\(\) must only be called once"),
    _node("class_not_called", "start", msg("The () after the class is missing"),
          msg("The name of a class creates no object; only calling it does."),
          msg("Write {name}() where the node is created."), links.PYTHON_CLASSES),
    _node("context_manager", "start", msg("with rclpy.init() needs a newer ROS"),
          msg("rclpy.init() works in a with statement from ROS 2 kilted on; before, it returns "
              "nothing."),
          msg("Write rclpy.init(args=args) on a line of its own, without with."), links.RCLPY,
          seen=r"'NoneType' object does not support the context manager protocol"
               r"|AttributeError: __enter__"),
    _node("not_a_node", "class", msg("The class does not inherit from Node"),
          msg("A class is a node only if it inherits from rclpy's Node. Without it, super() is "
              "Python's plain object, which takes no name."),
          msg("Write: class {name}(Node):"),
          seen=r"TypeError: object\.__init__\(\) takes exactly one argument"),
    _node("init_underscores", "class", msg("__init__ is not written with two underscores"),
          msg("Python calls __init__, with two underscores on both sides, when an object is "
              "created. A method with another name is not called, so Node gets no name."),
          msg("Rename {name} to __init__: two underscores before and after.")),
    _node("init_no_self", "class", msg("__init__ has no parameter self"),
          msg("Python passes the new object to __init__ as its first argument."),
          msg("Write: def __init__(self):"), links.PYTHON_CLASSES,
          seen=r"__init__\(\) takes 0 positional arguments but 1 was given"),
    _node("super_not_called", "class", msg("The () after super is missing"),
          msg("super is only a name in Python; calling it, super(), gives access to the class that "
              "yours inherits from."), SUPER, links.PYTHON_CLASSES,
          seen=r"TypeError: descriptor '__init__' requires a 'super' object"),
    _node("super_missing", "class", msg("super().__init__() is not called"), INIT, SUPER,
          seen=r"AttributeError: '\w{1,120}' object has no attribute '_default_callback_group'"),
    _node("super_late", "class", msg("super().__init__() is called too late"), INIT,
          msg("Move super().__init__('{node_name}') to the first line of __init__.")),
    _node("super_without_name", "class", msg("super().__init__() is called without a name"),
          msg("A node needs a name: ros2 node list and the log show it."), SUPER,
          seen=r"TypeError: Node\.__init__\(\) missing 1 required positional argument: 'node_name'"),
    _node("name_invalid", "class", msg("The node's name has a character that ROS does not allow"),
          msg("Node names contain only letters, digits and underscores, and do not begin with a "
              "digit."),
          msg("Write super().__init__('{node_name}')."), links.NAMES,
          seen=r"InvalidNodeNameException: Invalid node name"),
    _node("sleep_loop", "spin", msg("A loop with sleep() does the work of a timer"),
          msg("While your loop runs or sleeps, ROS cannot call the node's callbacks: ros2 param "
              "list and ros2 service call get no answer, no message reaches the node, and it does "
              "not follow simulated time."),
          msg("Put what the loop does into a method, call it with a timer that __init__ creates: "
              "self.create_timer({period}, self.{callback}), and write rclpy.spin(node) in "
              "{function} instead of the loop."),
          links.EXECUTORS),
)  # fmt: skip
