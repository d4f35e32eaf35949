"""Tests whether the programs of a ROS installation run, where student code cannot affect them.

This is done for each wheels prefix before it enters the cache, and again if colcon or ros2 ended
with a status that means "could not be started", before the student is blamed for it.
"""

from __future__ import annotations

from collections.abc import Sequence

from grader.base.cache import Notify, discard
from grader.base.errors import SurroundingsError
from grader.base.i18n.message import say
from grader.base.unheard import unheard
from grader.ros.distro import Distro
from grader.ros.interfaces import with_interfaces
from grader.ros.prefix import BrokenRosError, Ros, find_ros, is_in_cache
from grader.sandbox.base import Sandbox
from grader.sandbox.bubblewrap import Bubblewrap
from grader.sandbox.limits import Limits
from grader.sandbox.plain import NoSandbox

SECONDS = 60.0  # of wall time; the programs take 0.3 s
MAX_OUTPUT = 2_000  # characters that an error shows
BROKEN = "does not run"
OTHER_CACHE = say(
    "Set GRADER_CACHE to a folder whose file system allows programs to run, or report this error "
    "message."
)
REMOVED = say(
    "The damaged prefix was removed from the cache. Run the command again to make a new one."
)
SCRIPT = f"""
. "$1/setup.bash"
for program in 'colcon build --help' 'ros2 --help' 'python3 -c "import rclpy.node; rclpy.init"'; do
  output=$(eval "$program" 2>&1 < /dev/null) || {{
    printf '%s {BROKEN}: status %s\\n%s\\n' "$program" "$?" "$output"
    exit 1
  }}
done
"""


def proven_ros(distro: Distro, *, interfaces: Sequence[str] = (), notify: Notify = print) -> Ros:
    """Return the ROS installation for a distro (see `find_ros`); a newly made one is tested.

    It has the packages `interfaces` (see `with_interfaces`).
    """
    ros = find_ros(distro, prove=prove_ros, notify=notify)
    return with_interfaces(ros, interfaces, notify=notify) if interfaces else ros


def prove_ros(ros: Ros) -> None:
    """Start the programs of a ROS installation in a sandbox, as for a student.

    If no sandbox works, they are started without one; that is reported later, when a sandbox is
    opened for a student's code. Raises BrokenRosError if a program does not run.
    """
    try:
        with Bubblewrap(ros, Limits()) as sandbox:
            _prove(sandbox, OTHER_CACHE)
    except BrokenRosError:
        raise
    except SurroundingsError:
        with NoSandbox(ros, Limits()) as unprotected:
            _prove(unprotected, OTHER_CACHE)


def prove_again(sandbox: Sandbox) -> None:
    """Test again whether the programs of ROS run, in a sandbox that may contain student code.

    They run like the probe: as another user, in a separate folder. Raises BrokenRosError if one
    does not run; if the grader made that prefix, it is removed from the cache.
    """
    ros = sandbox.ros
    if not is_in_cache(ros):
        _prove(sandbox, _remedy_outside_the_cache(ros))
        return
    try:
        _prove(sandbox, REMOVED)
    except BrokenRosError:
        # do not report that this waits for another grader that makes the same prefix
        discard(ros.path, unless=lambda _: False, notify=unheard)
        raise


def _remedy_outside_the_cache(ros: Ros) -> str:
    if ros.kind == "system":
        return say(
            "Install what is missing (colcon: `sudo apt-get install "
            "python3-colcon-common-extensions`), or set GRADER_ROS=wheels to use PyPI's wheels."
        )
    return say(
        "Make it again. With Docker: make images DISTRO={distro}. In a lab without Docker: leave the "
        "lab and remove ROS {distro} from the grader's cache (~/.cache/ros2_teaching_lab).",
        distro=ros.distro.name,
    )


def _prove(sandbox: Sandbox, remedy: str) -> None:
    command = ["bash", "-c", SCRIPT, "bash", sandbox.ros_path]
    outcome = sandbox.run(command, role="probe", seconds=SECONDS)
    if outcome.status == 0:
        return
    distro = sandbox.ros.distro.name
    output = outcome.output.decode(errors="replace").strip()[:MAX_OUTPUT] or outcome.stopped_by
    if BROKEN in output:
        message = say("a program of ROS {distro} does not run:\n{said}", distro=distro, said=output)
        raise BrokenRosError(message, remedy=remedy)
    raise SurroundingsError(
        say(
            "cannot test whether the programs of ROS {distro} run:\n{said}",
            distro=distro,
            said=output,
        ),
        remedy=say("Run the command again. If that does not help, report this error message."),
    )
