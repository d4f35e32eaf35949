"""Mistakes with which a node does not start: what it imports."""

from __future__ import annotations

import ast
import re
import sys
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.base.nearest import nearest
from grader.mistakes import links
from grader.mistakes.alike import meant_by
from grader.mistakes.example import INNER, NODE, example
from grader.mistakes.fixes import lines, node_imports, node_life, rename
from grader.mistakes.interfaces import of_types
from grader.mistakes.kind import Family
from grader.mistakes.recognised import Raised, RecognisedMistake, Suspect
from grader.package.edit.tree import Replace, Write
from grader.package.source.module import Module
from grader.package.source.place import statement_at
from grader.report.model import Where

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
    *(
        "numpy",
        "pandas",
        "scipy",
        "matplotlib",
        "requests",
        "serial",
        "PIL",
        "pygame",
        "torch",
        "yaml",
    ),
    *("tensorflow", "sklearn", "pynput", "transforms3d", "keyboard", "smbus", "RPi", "tqdm"),
)
"""Packages that exist, but may not be installed: their names are not misspelt."""
ROS_1 = {
    **{f"log{level}": f"get_logger().{level}" for level in ("info", "debug", "warn", "fatal")},
    **{"logerr": "get_logger().error", "Publisher": "create_publisher", "Timer": "create_timer"},
    **{"Subscriber": "create_subscription", "Service": "create_service"},
    "get_param": "get_parameter",
}
"""What the node has in ROS 2 instead of the functions and classes of rospy."""
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
INTERFACES = {
    "std_srvs.srv": ("Trigger", "SetBool", "Empty"),
    "example_interfaces.srv": ("AddTwoInts",),
    "std_msgs.msg": (
        *("String", "Bool", "Header", "ColorRGBA", "Float32", "Float64"),
        *("Int8", "Int16", "Int32", "Int64", "UInt8", "UInt16", "UInt32", "UInt64"),
    ),
    "geometry_msgs.msg": (
        *("Twist", "TwistStamped", "Point", "Vector3", "Quaternion", "PoseStamped"),
    ),
    "sensor_msgs.msg": ("Image", "LaserScan", "Imu", "JointState", "PointCloud2"),
    "nav_msgs.msg": ("Odometry",),
}
"""Common messages and services, by the module that has them."""
HOMES = {
    "Node": "rclpy.node",
    **dict.fromkeys(
        (
            "ExternalShutdownException",
            "MultiThreadedExecutor",
            "SingleThreadedExecutor",
            "Executor",
        ),
        "rclpy.executors",
    ),
    **dict.fromkeys(
        ("QoSProfile", "ReliabilityPolicy", "DurabilityPolicy", "HistoryPolicy"), "rclpy.qos"
    ),
    **dict.fromkeys(
        ("MutuallyExclusiveCallbackGroup", "ReentrantCallbackGroup"), "rclpy.callback_groups"
    ),
    **dict.fromkeys(("ActionClient", "ActionServer"), "rclpy.action"),
    **{
        name: f"rclpy.{name.lower()}"
        for name in ("Duration", "Time", "Clock", "Parameter", "Timer")
    },
    **{"Rate": "rclpy.timer", "Future": "rclpy.task", "LoggingSeverity": "rclpy.logging"},
}
"""The modules of rclpy in which its names are."""
FROM = {
    **dict.fromkeys(("Any", "Callable", "Dict", "List", "Optional", "Tuple", "Union"), "typing"),
    **dict.fromkeys(("ABC", "abstractmethod"), "abc"),
    **dict.fromkeys(("deque", "defaultdict", "namedtuple"), "collections"),
    **dict.fromkeys(("partial", "cached_property"), "functools"),
    **dict.fromkeys(("randint", "uniform"), "random"),
    **dict.fromkeys(("sqrt", "floor", "ceil"), "math"),
    **dict.fromkeys(("Thread", "Lock", "Event"), "threading"),
    **{"sleep": "time", "timedelta": "datetime", "dataclass": "dataclasses", "Path": "pathlib"},
    **dict.fromkeys(("Enum", "IntEnum"), "enum"),
}
"""Names of Python's modules that a file uses by themselves."""
STANDARD = (
    *("argparse", "asyncio", "collections", "copy", "datetime", "enum", "functools", "itertools"),
    *("json", "logging", "math", "os", "pathlib", "random", "re", "signal", "subprocess", "sys"),
    *("threading", "time", "traceback", "typing"),
)
"""Modules of Python whose names are hardly those of variables."""
OF_SEVERAL = ("Timer", "Time", "Rate", "Future")
"""Names that Python's modules or messages have too, or that a node does not need."""
NODE_IMPORT = "from rclpy.node import Node\n"
TEXT_OF = "def text_of(number):\n    return str(number)\n"
HELLO_CLASS = """\
from rclpy.node import Node


class MyFirstNode(Node):
    def __init__(self):
        super().__init__('my_first_node')
        self.counter_ = 0
        self.create_timer(1.0, self.timer_callback)

    def timer_callback(self):
        self.get_logger().info('Hello time: ' + str(self.counter_))
        self.counter_ += 1
"""
HELLO_MAIN = """\
#!/usr/bin/env python3
import rclpy
from hello_class import MyFirstNode


def main(args=None):
    rclpy.init(args=args)
    node = MyFirstNode()
    try:
        rclpy.spin(node)
    except KeyboardInterrupt:
        pass
    rclpy.try_shutdown()
"""
OF_ROS_1 = """#!/usr/bin/env python3
import rospy

counter = 0


def timer_callback(event):
    global counter
    rospy.loginfo('Hello time: ' + str(counter))
    counter += 1


def main():
    rospy.init_node('my_first_node')
    rospy.Timer(rospy.Duration(1.0), timer_callback)
    rospy.spin()
"""
OWN_NAME = msg(
    "This line imports {name} from {path}, a file of your own package. That file does not define "
    "{name}; case matters."
)
OTHER_HOME = msg("rclpy has this name, but in another of its modules.")
CLOSE = msg("Write {close} instead of {name}.")


def _no_ros(suspect: Suspect) -> RecognisedMistake | None:
    source = suspect.source
    if source.uses_ros:
        return None
    return suspect.finding("no_ros", Where(file=source.entry.path, line=1))


def _for_ros_1(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The file is written for rospy: nothing of it uses rclpy."""
    del match
    return None if raised.source.uses_ros else raised.finding("for_ros_1")


def _no_module(raised: Raised, match: re.Match[str]) -> RecognisedMistake:
    """An import names a module that is not there: a misspelt one, one of C++, or one that is not installed."""
    name = match["name"]
    head, dot, tail = name.partition(".")
    module, _, last = name.rpartition(".")
    plain = isinstance(statement_at(raised.module, raised.line), ast.Import)
    if plain and module in MODULES and last[:1].isupper():
        new = f"from {HOMES.get(last, module)} import {last}"
        found = raised.finding("import_misspelt", name=f"import {name}", written=new)
        return replace(found, variant="class")
    if (wrong_part := of_types(raised, name)) is not None:
        return wrong_part
    close = _module_of_names(raised, name)
    close = close or nearest(name, (*MODULES, *sys.stdlib_module_names), cutoff=0.75)
    if head in OTHER_CLIENTS:
        close = f"rclpy{dot}{tail}"
    if head in OTHER_PACKAGES or head == "rospy":  # (beside rclpy)
        return replace(raised.finding("import_misspelt", name=name), variant="not_installed")
    return raised.finding("import_misspelt", name=name, close=close)


def _no_name_in_module(raised: Raised, match: re.Match[str]) -> RecognisedMistake:
    name, module = match["name"], match["module"]
    home = HOMES.get(name, "") if module.partition(".")[0] == "rclpy" else ""
    statement = statement_at(raised.module, raised.line)
    if home and home != module and isinstance(statement, ast.ImportFrom):
        code, new = raised.module.text.code(statement), f"from {home} import {name}"
        alone = len(statement.names) == 1 and not statement.names[0].asname
        params = {"name": code, "written": new} if alone else {"name": name, "statement": new}
        found = raised.finding("import_name", params={**params, "module": module})
        return replace(found, variant="home" if alone else "home_too")
    there = [known for known, place in HOMES.items() if place == module]
    known = (*RCLPY, "Node") if module.startswith("rclpy") else ("String", "Twist")
    close = meant_by(name, there, cutoff=0.75) or meant_by(name, known, cutoff=0.75)
    return raised.finding("import_name", name=name, close=close, module=module)


def import_of(raised: Raised, name: str) -> str:
    """Return the import of a name that no line imports; "" if none or several can be meant."""
    if name in raised.module.imports:
        return ""
    return _of_ros(raised, name) or IMPORTS.get(name) or _of_python(raised.module, name)


def _of_ros(raised: Raised, name: str) -> str:
    """Return the import of an interface of the lesson, of a common one, or of a class of rclpy."""
    for kind in raised.assignment.types():
        package, part, interface = (*kind.split("/"), "", "")[:3]
        if interface == name:
            return f"from {package}.{part} import {name}"
    homes = [there for there, names in INTERFACES.items() if name in names]
    if len(homes) == 1 and name != "Empty":
        return f"from {homes[0]} import {name}"
    home = HOMES.get(name, "") if name not in OF_SEVERAL else ""
    return f"from {home} import {name}" if home else ""


def _of_python(module: Module, name: str) -> str:
    """Return the import of a name of Python's own modules that the file uses; "" if unknown."""
    uses = [n for n in module.nodes if isinstance(n, ast.Name) and n.id == name]
    read = [isinstance(module.parents.get(use), ast.Attribute) for use in uses]
    if name in module.names or not uses:
        return ""
    if name in FROM and not any(read):
        return f"from {FROM[name]} import {name}"
    return f"import {name}" if name in STANDARD and all(read) else ""


def _module_of_names(raised: Raised, name: str) -> str:
    """Return the module that has all the names which the line imports; "" if that is none."""
    statement = statement_at(raised.module, raised.line)
    if not isinstance(statement, ast.ImportFrom) or statement.module != name:
        return ""
    names = {alias.name for alias in statement.names}
    homes = {HOMES.get(each, "") for each in names}
    if len(homes) == 1 and (name.partition(".")[0] == "rclpy" or names == {"Node"}):
        return min(homes)
    kind = name.rpartition(".")[2]
    of_kind = [module for module in INTERFACES if module.endswith(f".{kind}")]
    homes = {module for module in of_kind if names <= {*INTERFACES[module]}}
    return min(homes) if len(homes) == 1 and homes != {name} else ""


_node = Family("node", links.FIRST_NODE)
KINDS = (
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
        "for_ros_1",
        "start",
        msg("The file is written for ROS 1"),
        msg(
            "rospy is the Python library of ROS 1. ROS 2 does not have it: its library is rclpy, "
            "which has other functions and classes. Another name in the import is not enough."
        ),
        msg(
            "Write the node anew for ROS 2. Import it: import rclpy and from rclpy.node import "
            "Node. Write a class that inherits from Node. In its __init__: "
            "super().__init__('{node_name}') and self.create_timer({period}, self.{callback}). In "
            "its method {callback}: self.get_logger().info(…). In {function}: rclpy.init(), an "
            "object of your class, and rclpy.spin(node)."
        ),
        raised={r"No module named 'rospy'": _for_ros_1},
        examples=(example("node_of_ros_1", Write(NODE, OF_ROS_1), fails="run.starts"),),
    ),
    _node(
        "own_module_alone",
        "start",
        msg("Python does not find a file of your own package under this name"),
        msg(
            "ros2 run starts the installed package. Python knows the files in it only as {package}."
            "name, also from a file in the same folder."
        ),
        msg("Write {written} instead of {name}."),
        links.PACKAGE,
        whys={
            "elsewhere": msg(
                "The build installs the folder {package} with its files, and {there} is outside of it. "
                "Python knows the files in it only as {package}.name."
            ),
            "class": msg(
                "The folder {package} and its files are different modules: a class or a function is "
                "in the file that defines it."
            ),
        },
        fixes={"elsewhere": msg("Move {there} to {path}, and write {written} instead of {name}.")},
        fixed_by=(node_imports.through_package,),
        examples=(
            example(
                "class_from_own_file",
                Write(f"{INNER}/hello_class.py", HELLO_CLASS),
                Write(NODE, HELLO_MAIN, 0o755),
                fails="run.starts",
            ),
            example(
                "own_function_from_package",
                Write(f"{INNER}/helpers.py", TEXT_OF),
                Replace(NODE, NODE_IMPORT, f"{NODE_IMPORT}\nfrom {INNER} import text_of\n"),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "own_module_missing",
        "start",
        msg("A file of your package is missing"),
        msg(
            "This line imports {path}, a file of your own package. The package that was handed in "
            "does not have it."
        ),
        msg(
            "Put {path} into the package and hand it in too. Or write what you need from it into "
            "this file, and delete the import."
        ),
        links.PACKAGE,
        close=CLOSE,
        fixes={
            "elsewhere": msg("Move {there} to {path}: Python looks for it there."),
            "init": msg(
                "Delete this line. {file} runs before every other file of its folder, and it can be "
                "empty. Or put {path} into the package, if you need it."
            ),
        },
        fixed_by=(lines.written,),
        examples=(
            example(
                "helper_not_handed_in",
                Replace(
                    NODE,
                    "from rclpy.node import Node\n",
                    "from rclpy.node import Node\n\nfrom my_robot_controller.utils import text_of\n",
                ),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "import_misspelt",
        "start",
        msg("An import names a module that Python does not find"),
        msg(
            "Python looks for a module with exactly that name, and ends the program if there is "
            "none."
        ),
        msg(
            "Check the spelling of the module's name. It must be a module of ROS, of Python, or of a "
            "package of yours. A file of this package is imported with the package's name, as in "
            "from {package}.name import …"
        ),
        links.PYTHON_ERRORS,
        close=CLOSE,
        fixes={
            "class": msg("Write {written} instead of {name}."),
            "not_installed": msg(
                "Write the node without {name}: the exercise does not need it. Delete this line, and replace "
                "what uses {name} in other lines."
            ),
        },
        whys={
            "not_installed": msg(
                "{name} is a package of its own, and it is not installed where this node was run. Python ends "
                "the program at an import of a module that it does not find."
            ),
        },
        raised={r"No module named '(?P<name>[\w.]{1,200})'": _no_module},
        fixed_by=(lines.written, rename.imported),
        examples=(
            example(
                "import_of_cpp_client",
                Replace(NODE, "import rclpy\nfrom rclpy.node", "import rclcpp\nfrom rclcpp.node"),
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
        whys={
            "own": OWN_NAME,
            "own_close": OWN_NAME,
            "own_init": OWN_NAME,
            "home": OTHER_HOME,
            "home_too": OTHER_HOME,
        },
        fixes={
            "home": msg("Write {written} instead of {name}."),
            "home_too": msg(
                "Take {name} out of this line, and add the line {statement} at the top of the file."
            ),
            "own": msg("Define {name} in {path}, or import another name from it."),
            "own_init": msg(
                "Delete this line: {file} can be empty. setup.py names the node's file, and needs no "
                "list of files here."
            ),
            "own_close": msg(
                "Write {close} instead of {name}, here and wherever this file uses it: {path} defines {close}."
            ),
        },
        seen=r"ImportError: cannot import name '(?P<name>\w{1,120})' from '(?P<module>[\w.]{1,200})'",
        raised={
            r"cannot import name '(?P<name>\w{1,120})' from '(?P<module>[\w.]{1,200})'": _no_name_in_module
        },
        fixed_by=(lines.written, rename.imported, node_life.node_import),
        examples=(
            example(
                "init_imports_a_wrong_name",
                Write(f"{INNER}/__init__.py", f"from {INNER}.my_first_node import helper\n"),
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
)
