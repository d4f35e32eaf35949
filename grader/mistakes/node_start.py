"""Mistakes with which a node does not start: imports, the entry point's function, the class."""

from __future__ import annotations

import ast
import re
import sys
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.base.nearest import nearest
from grader.mistakes import links
from grader.mistakes.example import NODE, example
from grader.mistakes.fixes import lines, node_life, node_names, node_objects, node_scope, rename
from grader.mistakes.kind import Family
from grader.mistakes.placeholders import CLASS
from grader.mistakes.recognised import NAME_ERROR, Raised, RecognisedMistake, Suspect, always
from grader.package.edit.tree import Replace, Write
from grader.package.source.names import calls_in, dotted, last_part
from grader.report.model import Where

SLEEPS = ("time.sleep", "sleep")
WAITS = ("input", *SLEEPS)
MODULES = (
    *("rclpy", "rclpy.node", "rclpy.executors", "rclpy.qos", "std_msgs", "std_msgs.msg"),
    *("geometry_msgs", "geometry_msgs.msg", "sensor_msgs", "sensor_msgs.msg", "numpy"),
)
OTHER_CLIENTS = ("rclcpp", "rospy", "roscpp", "ros2", "ros", "ros2py", "rclpy2")
"""Names under which beginners look for the Python client library: those of C++ and of ROS 1."""
OTHER_PACKAGES = (
    *("turtlesim", "turtlesim_msgs", "nav_msgs", "tf2_ros", "tf2_msgs", "visualization_msgs"),
    *("trajectory_msgs", "shape_msgs", "stereo_msgs", "diagnostic_msgs", "example_interfaces"),
    *("action_msgs", "std_srvs", "cv_bridge", "cv2", "tf_transformations", "nav2_msgs"),
)
"""Packages that exist, but may not be installed: their names are not misspelt."""
RCLPY = ("init", "spin", "spin_once", "shutdown", "try_shutdown", "ok", "create_node", "logging")
IMPORTS = {
    "Node": "from rclpy.node import Node",
    "rclpy": "import rclpy",
    **{
        name: f"from rclpy.executors import {name}"
        for name in ("ExternalShutdownException", "MultiThreadedExecutor", "SingleThreadedExecutor")
    },
    **{name: f"import {name}" for name in ("time", "math", "random", "sys", "threading")},
}
PRIVATE = r"AttributeError: '(?P<type>\w{1,120})' object has no attribute '_\w{1,120}'"
NO_FUNCTION = r"AttributeError: module '[\w.]{1,200}' has no attribute '(?P<function>\w{1,120})'"
NO_NODE_NAME = r"Node\.__init__\(\) missing 1 required positional argument: 'node_name'"
NOT_INITIALIZED = r"NotInitializedException"

INIT_OF_NODE = msg(
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


def _class_is_spun(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    del match
    for call, name in raised.source.calls:
        given = dotted(call.args[0]) if call.args else ""
        if last_part(name) == "spin" and _is_class(raised, given):
            return raised.finding("spin_of_class", at=call, name=given)
    return None


def _is_class(raised: Raised, name: str) -> bool:
    """Return whether a name is that of a class of the files, the node's or another."""
    return name in raised.source.known_classes or last_part(name) in raised.source.class_names


def _no_ros(suspect: Suspect) -> RecognisedMistake | None:
    source = suspect.source
    if source.uses_ros:
        return None
    return suspect.finding("no_ros", Where(file=source.entry.path, line=1))


def _no_module(raised: Raised, match: re.Match[str]) -> RecognisedMistake:
    name = match["name"]
    head, dot, tail = name.partition(".")
    module, _, last = name.rpartition(".")
    plain = raised.module.line(raised.line).startswith("import ")
    if plain and module in MODULES and last[:1].isupper():
        new = IMPORTS.get(last, f"from {module} import {last}")
        found = raised.finding("import_misspelt", name=f"import {name}", written=new)
        return replace(found, variant="class")
    unused = node_names.unused_import(raised.module, raised.line)
    close = nearest(name, (*MODULES, *sys.stdlib_module_names), cutoff=0.75)
    if head in OTHER_PACKAGES:
        close = ""
    if head in OTHER_CLIENTS:
        close = "" if unused and raised.source.uses_ros else f"rclpy{dot}{tail}"
    found = raised.finding("import_misspelt", name=name, close=close)
    return replace(found, variant="unused") if unused and not close else found


def _no_name_in_module(raised: Raised, match: re.Match[str]) -> RecognisedMistake:
    name, module = match["name"], match["module"]
    known = (*RCLPY, "Node") if module.startswith("rclpy") else ("String", "Twist")
    close = nearest(name, known, cutoff=0.75)
    return raised.finding("import_name", name=name, close=close, module=module)


def _not_imported(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    name = match["name"]
    if name not in IMPORTS or name in raised.module.imports:
        return None
    found = raised.finding("import_missing", name=name, statement=IMPORTS[name])
    imports = [n for n in raised.module.nodes if isinstance(n, ast.ImportFrom)]
    for node in imports if name == "Node" else ():
        if node.module == "rclpy" and [alias.name for alias in node.names] == ["node"]:
            found = raised.finding("import_missing", at=node, name=name, statement=IMPORTS[name])
            return replace(found, variant="module")
    return found


def _close_function(raised: Raised) -> str:
    return nearest(raised.assignment.function, raised.source.entry.functions)


def _function_missing(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    if match["function"] != raised.assignment.function or _close_function(raised):
        return None
    return raised.finding("main_missing")


def _function_misspelt(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    function, close = raised.assignment.function, _close_function(raised)
    if match["function"] != function or not close:
        return None
    at = raised.source.entry.functions[close]
    return raised.finding("main_misspelt", at=at, name=close, close=function)


def _main_wants(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    if match["function"] != raised.assignment.function:
        return None
    return raised.finding("main_wants_args", at=raised.source.main)


def _main_empty(suspect: Suspect) -> RecognisedMistake | None:
    source = suspect.source
    made = source.makes_node() or any(n.endswith("create_node") for _, n in source.calls)
    if source.node_class is None or made:
        return None
    return suspect.finding("main_empty", suspect.place_of_function)


def _waits_first(suspect: Suspect) -> RecognisedMistake | None:
    main = suspect.function
    for call, name in calls_in(main) if main is not None else ():
        if suspect.source.is_node_class(call.func):
            return None
        if name in WAITS:
            return suspect.finding("waits_first", call, name=f"{name}()")
    return None


def _inits(raised: Raised) -> list[ast.Call]:
    return [call for call, name in raised.source.calls if last_part(name) == "init"]


def _init_missing(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    del match
    if _inits(raised):
        return None
    for node in raised.source.all_nodes:
        if isinstance(node, ast.Expr) and dotted(node.value) == "rclpy.init":
            return replace(raised.finding("init_missing", at=node), variant="not_called")
    return raised.finding("init_missing")


def _init_late(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    del match
    return raised.finding("init_late") if _inits(raised) else None


def _init_twice(raised: Raised, match: re.Match[str]) -> RecognisedMistake:
    del match
    inits = [call for call, name in raised.source.calls if name == "rclpy.init"]
    return raised.finding("init_twice", at=inits[1] if len(inits) > 1 else None)


def _class_not_called(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    del match
    for node in raised.source.all_nodes:
        if isinstance(node, ast.Assign) and _is_class(raised, dotted(node.value)):
            return raised.finding("class_not_called", at=node, name=dotted(node.value))
    return None


def _not_a_node(raised: Raised, match: re.Match[str]) -> RecognisedMistake:
    del match
    found = raised.source.node_class
    return raised.finding("not_a_node", at=found, name=found.name if found else CLASS)


def _underscores(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    del match
    methods = raised.source.methods
    if "__init__" in methods:
        return None
    inside = [m.name for m in methods.values() if _calls_super(m)]
    near = inside[0] if len(inside) == 1 else nearest("__init__", methods, cutoff=0.7)
    return raised.finding("init_underscores", at=methods[near], name=near) if near else None


def _calls_super(method: ast.AST) -> bool:
    return any(name == "super().__init__" for _, name in calls_in(method))


def _without_name(raised: Raised, match: re.Match[str]) -> RecognisedMistake:
    """Return that no name is passed; through the class, the first argument is self."""
    del match
    found, call = raised.finding("super_without_name"), raised.source.super_init
    if call is None or raised.line not in lines_of(call) or not call.args:
        return found
    on_class = dotted(call.func).endswith("Node.__init__")
    return replace(found, variant="on_class") if on_class else found


def _init_no_self(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    if match["function"] != "__init__":
        return None
    return raised.finding("init_no_self", at=raised.source.methods.get("__init__"))


def _super_self(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    del match
    call = raised.source.super_init
    if call is None or dotted(call.func) != "super().__init__" or not call.args:
        return None
    if dotted(call.args[0]) != "self" or raised.line not in (None, *lines_of(call)):
        return None
    return raised.finding("super_with_self", at=call)


def lines_of(node: ast.expr) -> range:
    """Return the lines of an expression."""
    return range(node.lineno, (node.end_lineno or node.lineno) + 1)


def _super_missing(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    if match["type"] not in raised.source.known_classes or raised.source.super_init is not None:
        return None
    return raised.finding("super_missing")


def _super_late(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    if match["type"] not in raised.source.known_classes:
        return None
    return raised.finding("super_late", at=raised.source.super_init)


_node = Family("node", links.FIRST_NODE)
KINDS = (
    _node(
        "spin_of_class",
        "spin",
        msg("rclpy.spin gets the class instead of the node"),
        msg("spin needs the node that was created, not its class."),
        msg("Write node = {name}() and then rclpy.spin(node)."),
        links.EXECUTORS,
        seen=r"TypeError: 'property' object is not iterable",
        raised={r"\w": _class_is_spun},
        fixed_by=(node_life.spin,),
        examples=(
            example(
                "spin_of_class",
                Replace(NODE, "rclpy.spin(node)", "rclpy.spin(MyFirstNode)"),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "no_ros",
        "start",
        msg("The file does not use rclpy"),
        msg(
            "A program is a ROS node only if it creates one. A loop that only prints does not "
            "appear in ros2 node list, on /rosout or to other programs."
        ),
        msg(
            "Write a class that inherits from Node, create a timer in it, and spin it in "
            "{function}."
        ),
        links.NODES,
        behind={"run.exits_at_once": _no_ros, "run.no_node": _no_ros, "run.never_spins": _no_ros},
        examples=(
            example(
                "loop_without_node",
                Write(
                    NODE,
                    (
                        "#!/usr/bin/env python3\n"
                        "def main():\n"
                        "    for n in range(10):\n"
                        "        print(f'Hello time: {n}')\n"
                    ),
                ),
                fails="run.starts",
                note="ten lines at once, without ROS",
            ),
            example(
                "loop_without_ros",
                Write(
                    NODE,
                    (
                        "#!/usr/bin/env python3\n"
                        "import time\n"
                        "\n"
                        "\n"
                        "def main():\n"
                        "    for n in range(10**6):\n"
                        "        print(f'Hello time: {n}')\n"
                        "        time.sleep(1)\n"
                    ),
                ),
                fails="run.starts",
                note="right lines at right instants, but no node",
            ),
        ),
    ),
    _node(
        "import_node",
        "start",
        msg("Node is imported from rclpy instead of rclpy.node"),
        msg("The class Node is in the module rclpy.node; rclpy itself has no Node."),
        msg("Write: from rclpy.node import Node"),
        seen=r"ImportError: cannot import name 'Node' from 'rclpy'",
        raised={r"cannot import name 'Node' from 'rclpy'": always("import_node")},
        fixed_by=(node_life.node_import,),
        examples=(
            example(
                "import_of_node",
                Replace(NODE, "from rclpy.node import Node", "from rclpy import Node"),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "import_misspelt",
        "start",
        msg("An import names a module that does not exist"),
        msg(
            "Python looks for a module with exactly that name, and ends the program if there is "
            "none."
        ),
        msg(
            "Check the spelling of the module's name; only modules of ROS and of Python are "
            "available."
        ),
        links.PYTHON_ERRORS,
        close=CLOSE,
        fixes={
            "unused": msg("Delete this line: {name} is not installed here, and no line uses it."),
            "class": msg("Write {written}: after a plain import, only modules can be named."),
        },
        seen=r"ModuleNotFoundError: No module named '(?P<name>(?!rclpy')\w{1,120})'",
        raised={r"No module named '(?P<name>[\w.]{1,200})'": _no_module},
        fixed_by=(lines.written, node_names.without_unused, node_names.rclpy, rename.imported),
        examples=(
            example(
                "import_of_class_in_one",
                Replace(NODE, "from rclpy.node import Node", "import rclpy.node.Node"),
                fails="run.starts",
            ),
            example(
                "import_of_other_lesson",
                Replace(
                    NODE, "import rclpy\nfrom", "import rclpy\nfrom turtlesim.msg import Pose\nfrom"
                ),
                fails="run.starts",
            ),
            example(
                "import_of_ros_1",
                Replace(NODE, "import rclpy\nfrom", "import rclpy\nimport rospy\nfrom"),
                fails="run.starts",
            ),
            example(
                "import_of_cpp_client",
                Replace(NODE, "import rclpy\nfrom rclpy.node", "import rclcpp\nfrom rclcpp.node"),
                fails="run.starts",
            ),
            example(
                "module_of_rclpy_misspelt",
                Replace(NODE, "from rclpy.node import", "from rclpy.nod import"),
                fails="run.starts",
            ),
            example(
                "import_misspelt",
                Replace(NODE, "import rclpy\nfrom", "import rclpi\nfrom"),
                fails="run.starts",
            ),
            example(
                "import_unknown",
                Replace(NODE, "import rclpy\nfrom", "import numpi as np\nimport rclpy\nfrom"),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "import_name",
        "start",
        msg("An import names something that the module does not have"),
        msg("from module import name works only for names that the module defines; case matters."),
        msg("Compare the name with the module's documentation."),
        links.RCLPY,
        close=CLOSE,
        seen=r"ImportError: cannot import name '(?P<name>\w{1,120})' from '(?P<module>[\w.]{1,200})'",
        raised={
            r"cannot import name '(?P<name>\w{1,120})' from '(?P<module>[\w.]{1,200})'": _no_name_in_module
        },
        fixed_by=(rename.imported, node_life.node_import),
        examples=(
            example(
                "import_in_lower_case",
                Replace(NODE, "from rclpy.node import Node", "from rclpy.node import node"),
                fails="run.starts",
            ),
            example(
                "import_of_misspelt_name",
                Replace(NODE, "from rclpy.node import Node", "from rclpy.node import Nod"),
                Replace(NODE, "MyFirstNode(Node)", "MyFirstNode(Nod)"),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "import_missing",
        "start",
        msg("A name is used without being imported"),
        msg("Python knows only names that the file imports or defines."),
        msg("Add the import at the top of the file: {statement}"),
        fixes={
            "module": msg("Write {statement} on this line: it imports the module, not the class.")
        },
        raised={NAME_ERROR: _not_imported},
        fixed_by=(
            node_objects.class_import,
            node_life.node_import,
            node_names.missing_import,
        ),
        examples=(
            example(
                "import_of_module_missing",
                Replace(NODE, "self.counter_ += 1", "self.counter_ += 1\n        time.sleep(0.1)"),
                fails="run.output",
                blocks=("run.interrupt",),
            ),
            example(
                "import_node_missing",
                Replace(NODE, "from rclpy.node import Node\n", ""),
                fails="run.starts",
                note="NameError while the class is defined",
            ),
        ),
    ),
    _node(
        "main_missing",
        "start",
        msg("The module does not have the entry point's function"),
        LOOKED_FOR,
        msg("Define it: def {function}(args=None):"),
        links.DEVELOPING,
        seen=r"AttributeError: module '[\w.]{1,200}' has no attribute '(?P<function>main)'",
        raised={NO_FUNCTION: _function_missing},
        fixed_by=(node_names.main,),
        examples=(
            example(
                "main_missing",
                Replace(NODE, "def main(", "def run("),
                Replace(NODE, "\n    main()\n", "\n    run()\n"),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "main_misspelt",
        "start",
        msg("The entry point's function has a different name"),
        LOOKED_FOR,
        msg("Rename {name} to {function}, also where it is called."),
        links.DEVELOPING,
        raised={NO_FUNCTION: _function_misspelt},
        fixed_by=(node_names.main,),
        examples=(
            example(
                "main_misspelt",
                Replace(NODE, "def main(", "def mein("),
                Replace(NODE, "\n    main()\n", "\n    mein()\n"),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "main_wants_args",
        "start",
        msg("The entry point's function needs an argument, but is called without any"),
        msg("The executable calls {function}() without arguments."),
        msg("Give the argument a default: def {function}(args=None):"),
        seen=r"TypeError: (?P<function>main)\(\) missing \d{1,3} required positional argument",
        raised={
            r"(?<![\w.])(?P<function>\w{1,120})\(\) missing \d{1,3} required positional": _main_wants
        },
        fixed_by=(node_life.main_arguments,),
        examples=(
            example(
                "main_wants_args",
                Replace(NODE, "def main(args=None)", "def main(args)"),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "main_empty",
        "start",
        msg("The entry point's function does not create the node"),
        msg(
            "The executable calls {function}() and ends when it returns. A class alone does "
            "nothing."
        ),
        msg(
            "Write in {function}: rclpy.init(args=args), then node = YourClass(), then "
            "rclpy.spin(node)."
        ),
        links.NODES,
        behind={
            "run.exits_at_once": _main_empty,
            "run.no_node": _main_empty,
            "run.never_spins": _main_empty,
        },
        examples=(
            example(
                "main_empty",
                Replace(
                    NODE,
                    (
                        "    rclpy.init(args=args)\n"
                        "    node = MyFirstNode()\n"
                        "    try:\n"
                        "        rclpy.spin(node)\n"
                        "    except KeyboardInterrupt:\n"
                        "        pass\n"
                        "    finally:\n"
                        "        node.destroy_node()\n"
                        "        rclpy.try_shutdown()\n"
                    ),
                    "    pass\n",
                ),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "waits_first",
        "start",
        msg("The program waits before it creates the node"),
        msg(
            "Until input(), sleep() or a loop is done, nothing after it runs, and there is no node."
        ),
        msg("Remove {name}. What must happen again and again belongs in a timer's callback."),
        behind={"run.no_node": _waits_first},
        examples=(
            example(
                "waits_for_input",
                Replace(
                    NODE,
                    "    rclpy.init(args=args)\n",
                    "    input('Press Enter to start')\n    rclpy.init(args=args)\n",
                ),
                fails="run.starts",
            ),
            example(
                "sleeps_before_init",
                Replace(
                    NODE,
                    "    rclpy.init(args=args)\n",
                    ("    import time\n    time.sleep(3600)\n    rclpy.init(args=args)\n"),
                ),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "guard_misspelt",
        "start",
        msg("The guard does not compare with '__main__'"),
        msg(
            "Python sets __name__ to '__main__' in a file that is started directly. With any "
            "other text the line below never runs. (ros2 run does not need it.)"
        ),
        msg("Write: if __name__ == '__main__':"),
    ),
    _node(
        "init_missing",
        "start",
        msg("rclpy.init() is not called"),
        NODES_MADE,
        msg("Write rclpy.init(args=args) as the first line of {function}."),
        links.RCLPY,
        fixes={"not_called": msg("Write () after rclpy.init: without them it is not called.")},
        seen=r"NotInitializedException",
        raised={NOT_INITIALIZED: _init_missing},
        fixed_by=(node_life.called_init, node_life.rclpy_init),
        examples=(
            example(
                "rclpy_init_not_called",
                Replace(NODE, "rclpy.init(args=args)", "rclpy.init"),
                fails="run.starts",
            ),
            example(
                "rclpy_init_missing",
                Replace(NODE, "    rclpy.init(args=args)\n", ""),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "init_late",
        "start",
        msg("rclpy.init() is called after the node is created"),
        NODES_MADE,
        msg("Move rclpy.init(args=args) to the first line of {function}."),
        links.RCLPY,
        raised={NOT_INITIALIZED: _init_late},
        fixed_by=(node_life.rclpy_init,),
        examples=(
            example(
                "rclpy_init_after_node",
                Replace(
                    NODE,
                    "    rclpy.init(args=args)\n    node = MyFirstNode()\n",
                    "    node = MyFirstNode()\n    rclpy.init(args=args)\n",
                ),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "init_twice",
        "start",
        msg("rclpy.init() is called twice"),
        msg("rclpy.init() connects the program to ROS; calling it again is an error."),
        msg("Keep only one rclpy.init(args=args), in the first line of {function}."),
        links.RCLPY,
        seen=r"RuntimeError: Context\.init\(\) must only be called once",
        raised={r"Context\.init\(\) must only be called once": _init_twice},
        examples=(
            example(
                "init_twice",
                Replace(
                    NODE,
                    "    rclpy.init(args=args)\n",
                    "    rclpy.init(args=args)\n    rclpy.init(args=args)\n",
                ),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "class_not_called",
        "start",
        msg("The () after the class is missing"),
        msg("The name of a class creates no object; only calling it does."),
        msg("Write {name}() where the node is created."),
        links.PYTHON_CLASSES,
        raised={"argument: 'self'|'property' object is not iterable": _class_not_called},
        examples=(
            example(
                "node_not_made",
                Replace(NODE, "node = MyFirstNode()", "node = MyFirstNode"),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "context_manager",
        "start",
        msg("with rclpy.init() needs a newer ROS"),
        msg(
            "rclpy.init() works in a with statement from ROS 2 kilted on; before, it returns "
            "nothing."
        ),
        msg("Write rclpy.init(args=args) on a line of its own, without with."),
        links.RCLPY,
        seen=r"'NoneType' object does not support the context manager protocol"
        r"|AttributeError: __enter__",
        raised={"context manager protocol|AttributeError: __enter__": always("context_manager")},
        examples=(
            example(
                "context_manager_of_kilted",
                Replace(
                    NODE,
                    (
                        "    rclpy.init(args=args)\n"
                        "    node = MyFirstNode()\n"
                        "    try:\n"
                        "        rclpy.spin(node)\n"
                        "    except KeyboardInterrupt:\n"
                        "        pass\n"
                        "    finally:\n"
                        "        node.destroy_node()\n"
                        "        rclpy.try_shutdown()\n"
                    ),
                    ("    with rclpy.init(args=args):\n        rclpy.spin(MyFirstNode())\n"),
                ),
                fails="run.starts",
                note="the newer tutorial on jazzy; right from kilted on",
            ),
        ),
    ),
    _node(
        "not_a_node",
        "class",
        msg("The class does not inherit from Node"),
        msg(
            "A class is a node only if it inherits from rclpy's Node. Without it, super() is "
            "Python's plain object, which takes no name."
        ),
        msg("Write: class {name}(Node):"),
        seen=r"TypeError: object\.__init__\(\) takes exactly one argument",
        raised={r"object\.__init__\(\) takes exactly one argument": _not_a_node},
        fixed_by=(node_life.base_class,),
        examples=(
            example(
                "not_a_node",
                Replace(NODE, "class MyFirstNode(Node)", "class MyFirstNode"),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "init_underscores",
        "class",
        msg("The class has no __init__, but a method that looks like it"),
        msg(
            "Python calls __init__, with two underscores on both sides, when an object is "
            "created. A method with another name is not called, so Node gets no name."
        ),
        msg("Rename {name} to __init__: two underscores before and after."),
        raised={NO_NODE_NAME: _underscores},
        fixed_by=(node_life.constructor,),
        examples=(
            example(
                "init_single_underscores",
                Replace(NODE, "    def __init__(self)", "    def _init_(self)"),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "init_no_self",
        "class",
        msg("__init__ has no parameter self"),
        msg("Python passes the new object to __init__ as its first argument."),
        msg("Write: def __init__(self):"),
        links.PYTHON_CLASSES,
        seen=r"__init__\(\) takes 0 positional arguments but 1 was given",
        raised={
            r"(?P<function>\w{1,120})\(\) takes 0 positional arguments but 1 was given": _init_no_self
        },
        examples=(
            example(
                "init_without_self",
                Replace(NODE, "def __init__(self)", "def __init__()"),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "super_not_called",
        "class",
        msg("The () after super is missing"),
        msg(
            "super is only a name in Python; calling it, super(), gives access to the class that "
            "yours inherits from."
        ),
        SUPER,
        links.PYTHON_CLASSES,
        seen=r"TypeError: descriptor '__init__' requires a 'super' object",
        raised={"descriptor '__init__' requires a 'super' object": always("super_not_called")},
        examples=(
            example(
                "super_without_brackets",
                Replace(NODE, "super().__init__", "super.__init__"),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "super_with_self",
        "class",
        msg("super().__init__() gets self"),
        msg("super() passes self on its own. The first argument in the () is the node's name."),
        msg("Write super().__init__('{node_name}'), without self."),
        links.PYTHON_CLASSES,
        raised={r"TypeError": _super_self},
        fixed_by=(node_scope.without_self,),
        examples=(
            example(
                "super_with_self",
                Replace(NODE, "__init__('my_first_node')", "__init__(self, 'my_first_node')"),
                fails="run.starts",
            ),
            example(
                "super_with_self_alone",
                Replace(NODE, "__init__('my_first_node')", "__init__(self)"),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "super_missing",
        "class",
        msg("super().__init__() is not called"),
        INIT_OF_NODE,
        SUPER,
        seen=r"AttributeError: '\w{1,120}' object has no attribute '_default_callback_group'",
        raised={PRIVATE: _super_missing},
        fixed_by=(node_life.name,),
        examples=(
            example(
                "super_missing",
                Replace(NODE, "        super().__init__('my_first_node')\n", ""),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "super_late",
        "class",
        msg("super().__init__() is called too late"),
        INIT_OF_NODE,
        msg("Move super().__init__('{node_name}') to the first line of __init__."),
        raised={PRIVATE: _super_late},
        fixed_by=(node_life.super_first,),
        examples=(
            example(
                "super_after_timer",
                Replace(NODE, "        super().__init__('my_first_node')\n", ""),
                Replace(
                    NODE,
                    "        self.create_timer(1.0, self.timer_callback)\n",
                    (
                        "        self.create_timer(1.0, self.timer_callback)\n"
                        "        super().__init__('my_first_node')\n"
                    ),
                ),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "super_without_name",
        "class",
        msg("No name is passed to the __init__ of Node"),
        msg("A node needs a name: ros2 node list and the log show it."),
        SUPER,
        seen=r"TypeError: Node\.__init__\(\) missing 1 required positional argument: 'node_name'",
        whys={
            "on_class": msg(
                "Node.__init__ is called on the class. There the first argument is self, so your "
                "string is taken for self, and the name is missing. super() passes self on its own."
            )
        },
        raised={NO_NODE_NAME: _without_name},
        fixed_by=(node_life.own_init, node_life.name),
        examples=(
            example(
                "init_of_node_without_self",
                Replace(NODE, "super().__init__(", "Node.__init__("),
                fails="run.starts",
            ),
            example(
                "super_without_name",
                Replace(NODE, "__init__('my_first_node')", "__init__()"),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "name_invalid",
        "class",
        msg("The node's name has a character that ROS does not allow"),
        msg(
            "Node names contain only letters, digits and underscores, and do not begin with a "
            "digit."
        ),
        msg("Write super().__init__('{node_name}')."),
        links.NAMES,
        seen=r"InvalidNodeNameException: Invalid node name",
        raised={"InvalidNodeNameException": always("name_invalid")},
        fixed_by=(node_life.name,),
        examples=(
            example(
                "dash_in_node_name",
                Replace(NODE, "'my_first_node'", "'my-first-node'"),
                fails="run.starts",
            ),
            example(
                "blank_in_node_name",
                Replace(NODE, "'my_first_node'", "'my first node'"),
                fails="run.starts",
            ),
        ),
    ),
)
