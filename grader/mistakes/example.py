"""Examples of a mistake: edits of a right package, and the checks that then fail.

The package is that of the tutorial: one node that counts, as `ros2 pkg create` and the tutorial
write it. An example states what fails and what cannot be checked any more; outcomes of all other
checks follow from the dependencies between the checks.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from grader.package.edit.tree import Edit

PACKAGE = "my_robot_controller"
INNER = PACKAGE
NODE = f"{INNER}/my_first_node.py"
INIT = f"{INNER}/__init__.py"
MARKER = f"resource/{PACKAGE}"
MANIFEST = "package.xml"
SETUP = "setup.py"
CFG = "setup.cfg"

LOG = "self.get_logger().info('Hello time: ' + str(self.counter_))"
LOG_LINE = f"        {LOG}\n"
STEP_LINE = "        self.counter_ += 1\n"
SPIN_UNTIL_CTRL_C = (
    "    try:\n"
    "        rclpy.spin(node)\n"
    "    except KeyboardInterrupt:\n"
    "        pass\n"
    "    finally:\n"
    "        node.destroy_node()\n"
    "        rclpy.try_shutdown()\n"
)
BODY_OF_MAIN = f"    rclpy.init(args=args)\n    node = MyFirstNode()\n{SPIN_UNTIL_CTRL_C}"

UNBUILT = ("build.colcon",)
UNINSTALLED = ("entry_point.executable",)
UNSTARTED = ("run.starts",)
SILENT = ("run.logger", "run.period")
DEAD = (*SILENT, "run.interrupt")
NO_FILE = ("source.exec_bit", "source.shebang")


@dataclass(frozen=True, kw_only=True)
class Example:
    """A package with one mistake.

    `fails` is the check that reports the mistake, `also` are others that fail, with the mistake
    that they report. `blocks` are checks that are skipped because of what the build or the run
    does; with them, and with a failed check, all that depend on them are skipped. If not
    `blocking`, the checks that depend on `fails` are evaluated all the same. `right_from` is the
    distro from which on the package is right, "" if there is none; `note` says why.
    """

    name: str
    edits: tuple[Edit, ...]
    fails: str
    also: Mapping[str, str] = field(default_factory=dict)
    blocks: tuple[str, ...] = ()
    blocking: bool = True
    right_from: str = ""
    note: str = ""


def example(
    name: str,
    *edits: Edit,
    fails: str,
    also: Mapping[str, str] | None = None,
    blocks: tuple[str, ...] = (),
    blocking: bool = True,
    right_from: str = "",
    note: str = "",
) -> Example:
    """Return an example; its name is a valid folder name, and unique."""
    return Example(
        name=name,
        edits=edits,
        fails=fails,
        also=also or {},
        blocks=blocks,
        blocking=blocking,
        right_from=right_from,
        note=note,
    )
