"""What a beginner does in lessons 1 and 2, typed in the lab, and what has to be named then.

Written from the lessons' texts, before anybody looked at what the guide knows. `says` are texts that
guide, check and hint must all have, in every language: names, places, commands; `@12` is line 12, `a|b` is
one of both.
"""

from __future__ import annotations

from dataclasses import dataclass

OWN = "~/ros2_ws/src/my_robot_controller"
INNER = f"{OWN}/my_robot_controller"
NODE = f"{INNER}/my_first_node.py"
SETUP = f"{OWN}/setup.py"
CIRCLE = f"{INNER}/draw_circle.py"
BUILD = "cd ~/ros2_ws && colcon build --symlink-install"
CREATE = "ros2 pkg create --build-type ament_python my_robot_controller --dependencies rclpy"
RUN = "ros2 run my_robot_controller test_node"
ENTRY = "'test_node = my_robot_controller.my_first_node:main',"
AND_BUILD = f"({BUILD})"
SOURCE = "source ~/ros2_ws/install/local_setup.bash"

HELLO = """\
#!/usr/bin/env python3
import rclpy
from rclpy.node import Node


class MyFirstNode(Node):
    def __init__(self):
        super().__init__('my_first_node')
        self.counter_ = 0
        self.create_timer(1.0, self.timer_callback)

    def timer_callback(self):
        self.get_logger().info('Hello time: ' + str(self.counter_))
        self.counter_ += 1


def main(args=None):
    rclpy.init(args=args)
    node = MyFirstNode()
    try:
        rclpy.spin(node)
    except KeyboardInterrupt:
        pass
    node.destroy_node()
    rclpy.try_shutdown()


if __name__ == '__main__':
    main()
"""
DRAW = """\
#!/usr/bin/env python3
import rclpy
from geometry_msgs.msg import Twist
from rclpy.node import Node


class DrawCircle(Node):
    def __init__(self):
        super().__init__('draw_circle')
        self.declare_parameter('radius', 2.0)
        self.publisher_ = self.create_publisher(Twist, '/turtle1/cmd_vel', 10)
        self.create_timer(0.5, self.timer_callback)

    def timer_callback(self):
        radius = self.get_parameter('radius').value
        message = Twist()
        message.linear.x = 2.0
        message.angular.z = 2.0 / radius
        self.publisher_.publish(message)


def main(args=None):
    rclpy.init(args=args)
    node = DrawCircle()
    try:
        rclpy.spin(node)
    except KeyboardInterrupt:
        pass
    node.destroy_node()
    rclpy.try_shutdown()


if __name__ == '__main__':
    main()
"""


@dataclass(frozen=True)
class State:
    """What is typed, from which point of the lesson on, and what must be named.

    `begin` is `empty`, `package` (created and built), `node` (lesson 1 up to its entry, built), or
    `circle` (lesson 2 up to its entry, built). `first` is what the guide says before the first check,
    if that is something else (a step that may be skipped). `runs` are lines that are typed after it, the last one
    stopped by a key (`ctrl`) when the node has counted to 1, `running` is what runs in another
    terminal. `korean` says whether it is played in Korean too.
    """

    begin: str
    types: str
    says: tuple[str, ...]
    korean: bool = False
    first: tuple[str, ...] = ()
    runs: tuple[str, ...] = ()
    ctrl: str = ""
    running: str = ""

    @property
    def lesson(self) -> str:
        """The lesson's id."""
        return "draw_circle" if self.begin in ("lesson 2", "circle") else "hello_time"


def sed(file: str, old: str, new: str) -> str:
    """Return the command that replaces a text in a file, which must have it."""
    return f'grep -qF -- "{old}" {file} && sed -i "s|{old}|{new}|" {file}'


WRITTEN = f"cat > {NODE} << 'END'\n{HELLO}END\nchmod +x {NODE}"
ENTERED = f"""sed -i "s/'console_scripts': \\[/&\\n            {ENTRY}/" {SETUP}"""
CIRCLE_WRITTEN = f"cat > {CIRCLE} << 'END'\n{DRAW}END\nchmod +x {CIRCLE}"
CIRCLE_ENTRY = "'draw_circle = my_robot_controller.draw_circle:main',"
CIRCLE_ENTERED = f"""sed -i "s/'console_scripts': \\[/&\\n            {CIRCLE_ENTRY}/" {SETUP}"""
DEPENDS = sed(
    f"{OWN}/package.xml",
    "<depend>rclpy</depend>",
    "<depend>rclpy</depend>\\n  <depend>geometry_msgs</depend>",
)

UNSOURCED = ("source install/local_setup.bash",)

STATES = {
    "nothing is done": State(
        "empty",
        ":",
        ("ros2 pkg create",),
        korean=True,
        first=("ros2 run turtlesim turtlesim_node",),
    ),
    "the package is in the home folder": State(
        "empty", f"cd ~ && {CREATE}", ("mv ~/my_robot_controller ",), korean=True
    ),
    "the package is beside src": State(
        "empty", f"cd ~/ros2_ws && {CREATE}", ("mv ~/ros2_ws/my_robot_controller ",)
    ),
    "a C++ package": State(
        "empty", "cd ~/ros2_ws/src && ros2 pkg create my_robot_controller", ("C++",), korean=True
    ),
    "the package's name is misspelt": State(
        "empty",
        f"cd ~/ros2_ws/src && {CREATE.replace('controller', 'controler')}",
        ("my_robot_controler", "my_robot_controller"),
        korean=True,
    ),
    "a package in the package": State(
        "empty",
        f"cd ~/ros2_ws/src && mkdir my_robot_controller && cd my_robot_controller && {CREATE}",
        ("mv ", INNER),
    ),
    "the package is not built": State(
        "empty", f"cd ~/ros2_ws/src && {CREATE}", ("colcon build",), korean=True
    ),
    "built in src": State(
        "empty",
        f"cd ~/ros2_ws/src && {CREATE} && colcon build --symlink-install",
        ("~/ros2_ws/src", "rm -r build install log"),
        korean=True,
    ),
    "built in the package": State(
        "empty",
        f"cd ~/ros2_ws/src && {CREATE} && cd my_robot_controller && colcon build",
        ("~/ros2_ws/src/my_robot_controller", "rm -r build install log"),
    ),
    "built in src, too": State(
        "node",
        "cd ~/ros2_ws/src && colcon build --symlink-install",
        ("~/ros2_ws/src", "rm -r build install log"),
    ),
    "the node is in the outer folder": State(
        "package", f"cd {OWN} && touch my_first_node.py", ("mv ", f"{OWN}/my_first_node.py")
    ),
    "the node is in src": State(
        "package",
        "cd ~/ros2_ws/src && touch my_first_node.py",
        ("mv ", "~/ros2_ws/src/my_first_node.py"),
    ),
    "the node's file is misspelt": State(
        "package",
        f"cd {INNER} && touch my_frist_node.py && chmod +x my_frist_node.py",
        ("mv ", "my_frist_node.py"),
        korean=True,
    ),
    "the node's file has no .py": State(
        "package", f"cd {INNER} && touch my_first_node", ("mv ", "/my_first_node ")
    ),
    "the node's file is not executable": State(
        "package", f"touch {NODE}", ("chmod +x",), korean=True
    ),
    "the node's file is empty": State(
        "package", f"touch {NODE} && chmod +x {NODE}", ("my_first_node.py",), korean=True
    ),
    "no super().__init__": State(
        "node", sed(NODE, "super().__init__('my_first_node')", "pass"), ("super().__init__",)
    ),
    "no colon": State(
        "node",
        sed(NODE, "def timer_callback(self):", "def timer_callback(self)"),
        ("@12",),
        korean=True,
    ),
    "a tab among spaces": State(
        "node",
        sed(NODE, "        self.counter_ += 1", "\\t    self.counter_ += 1"),
        ("@14",),
    ),
    "the first line is empty": State(
        "node", f"sed -i '1i\\\\' {NODE}", ("#!/usr/bin/env python3",)
    ),
    "the callback is called": State(
        "node", sed(NODE, "self.timer_callback)", "self.timer_callback())"), ("@10",)
    ),
    "nothing spins": State(
        "node", sed(NODE, "rclpy.spin(node)", "pass"), ("spin|스핀",), korean=True
    ),
    "a number is added to a text": State(
        "node", sed(NODE, "str(self.counter_)", "self.counter_"), ("@13",)
    ),
    "no entry": State(
        "package",
        WRITTEN,
        ("setup.py", "test_node = my_robot_controller.my_first_node:main"),
        korean=True,
    ),
    "the entry ends with .py": State(
        "node", sed(SETUP, "my_first_node:main", "my_first_node.py:main"), ("setup.py", ".py")
    ),
    "the entry names no function": State(
        "node", sed(SETUP, "my_first_node:main", "my_first_node"), ("setup.py", "main")
    ),
    "the entry has no quotes": State(
        "node", sed(SETUP, ENTRY, ENTRY.replace("'", "")), ("setup.py",)
    ),
    "not built since the entry": State("package", f"{WRITTEN}\n{ENTERED}", ("colcon build",)),
    "the overlay is not sourced": State(
        "node", ":", ("lab submit",), runs=(RUN,), korean=True, first=UNSOURCED
    ),
    "the executable's name is another one": State(
        "node",
        SOURCE,
        ("lab submit",),
        runs=("ros2 run my_robot_controller my_first_node",),
        first=("my_first_node", RUN),
    ),
    "the node runs in another terminal": State(
        "node", ":", ("lab submit",), running=RUN, first=("/my_first_node", "check")
    ),
    "Ctrl+Z": State("node", SOURCE, ("fg",), runs=(RUN,), ctrl="z", korean=True),
    "the node crashes": State(
        "node",
        f"{sed(NODE, 'str(self.counter_)', 'str(self.counter)')}\n{SOURCE}",
        ("@13",),
        runs=(RUN,),
    ),
    "the build has an older copy": State(
        "node",
        f"cd ~/ros2_ws && rm -r build install && colcon build && {sed(NODE, '= 0', '= 0  # zero')}",
        ("colcon build",),
    ),
    "the node has run": State(
        "node", SOURCE, ("lab submit",), runs=(RUN,), ctrl="c", korean=True, first=("check",)
    ),
    "another text": State(
        "node", sed(NODE, "Hello time", "Hello Time"), ("Hello time",), first=UNSOURCED
    ),
    "another period": State("node", sed(NODE, "timer(1.0", "timer(0.1"), ("@10",), first=UNSOURCED),
    "the counter stays": State("node", sed(NODE, "self.counter_ += 1", "pass"), ("counter",)),
    "files of another user": State("node", ":", ("sudo chown -R", "/ros2_ws")),
    "lesson 2, nothing is done": State(
        "lesson 2", ":", ("<depend>geometry_msgs</depend>",), korean=True
    ),
    "two entries without a comma": State(
        "circle",
        sed(SETUP, CIRCLE_ENTRY, CIRCLE_ENTRY[:-1]),
        ("setup.py",),
        korean=True,
    ),
    "geometry_msg": State(
        "circle",
        sed(f"{OWN}/package.xml", "geometry_msgs<", "geometry_msg<"),
        ("package.xml", "'geometry_msg'"),
    ),
    "package.xml is not closed": State(
        "circle",
        sed(f"{OWN}/package.xml", "geometry_msgs</depend>", "geometry_msgs<depend>"),
        ("package.xml", "@11"),
    ),
    "the node of lesson 1 was copied": State(
        "circle", sed(CIRCLE, "'draw_circle'", "'my_first_node'"), ("draw_circle", "@9")
    ),
    "Twist is not imported": State(
        "circle", sed(CIRCLE, "from geometry_msgs.msg import Twist", ""), ("Twist",)
    ),
    "a whole number": State(
        "circle", sed(CIRCLE, "linear.x = 2.0", "linear.x = 2"), ("@17",), first=UNSOURCED
    ),
    "another topic": State(
        "circle",
        sed(CIRCLE, "/turtle1/", "/turtle/"),
        ("/turtle1/cmd_vel",),
        korean=True,
        first=UNSOURCED,
    ),
    "no .value": State("circle", sed(CIRCLE, ".value", ""), (".value",), first=UNSOURCED),
    "nothing is published": State(
        "circle",
        sed(CIRCLE, "self.publisher_.publish(message)", "pass"),
        ("publish",),
        first=UNSOURCED,
    ),
    "another period of commands": State(
        "circle", sed(CIRCLE, "timer(0.5", "timer(2.0"), ("@12",), first=UNSOURCED
    ),
}
"""The states by what was done."""
