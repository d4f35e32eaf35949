"""Do the programs of ROS run? Asked in a sandbox, where no student's code has a say.

Asked once for each prefix of wheels, before it gets its place in the cache; and again if colcon or
ros2 ended as a program does that could not be started, before that is called the student's fault.
"""

from __future__ import annotations

from grader.base.cache import Notify, discard
from grader.base.errors import SurroundingsError
from grader.base.i18n.message import Message
from grader.base.unheard import unheard
from grader.ros import prefix_texts as texts
from grader.ros.distro import Distro
from grader.ros.prefix import BrokenRosError, Ros, find_ros, is_in_cache
from grader.sandbox.base import Sandbox
from grader.sandbox.limits import Limits

SECONDS = 60.0  # of wall time; they take 0.3 s
LONGEST = 2_000  # characters of what a program said
BROKEN = "does not run"
SCRIPT = f"""
. "$1/setup.bash"
for program in 'colcon build --help' 'ros2 --help' 'python3 -c "import rclpy.node; rclpy.init"'; do
  said=$(eval "$program" 2>&1 < /dev/null) || {{
    printf '%s {BROKEN}: status %s\\n%s\\n' "$program" "$?" "$said"
    exit 1
  }}
done
"""


def proven_ros(distro: Distro, *, notify: Notify = print) -> Ros:
    """Return the ROS installation for a distro (see `find_ros`); one that is made now is proven."""
    return find_ros(distro, prove=prove_ros, notify=notify)


def prove_ros(ros: Ros) -> None:
    """Start the programs of a ROS installation as a student's commands see it.

    Without a sandbox if none works: that is told when one is opened for a student's code. Raises
    BrokenRosError if one of them does not run.
    """
    # each sandbox is loaded only when it is needed: `grader --help` must not pay for it
    from grader.sandbox.bubblewrap import Bubblewrap  # noqa: PLC0415
    from grader.sandbox.plain import Bare  # noqa: PLC0415

    try:
        with Bubblewrap(ros, Limits()) as sandbox:
            _prove(sandbox, Message(texts.REPORT))
    except BrokenRosError:
        raise
    except SurroundingsError:
        with Bare(ros, Limits()) as bare:
            _prove(bare, Message(texts.REPORT))


def prove_again(sandbox: Sandbox) -> None:
    """Do nothing if the programs of ROS run in a sandbox; student's code may have been in it.

    They are run as the probe is: as another user, in a folder of its own. Raises BrokenRosError if
    one does not run; a prefix that the grader has made is removed from the cache then.
    """
    ros = sandbox.ros
    if not is_in_cache(ros):
        anew = Message(texts.MAKE_AGAIN, {"distro": ros.distro.name})
        _prove(sandbox, Message(texts.INSTALL_TOOLS) if ros.kind == "system" else anew)
        return
    try:
        _prove(sandbox, Message(texts.REMOVED))
    except BrokenRosError:
        # waiting for another grader that makes the same prefix is no news to this user
        discard(ros.path, unless=lambda _: False, notify=unheard)
        raise


def _prove(sandbox: Sandbox, remedy: str) -> None:
    command = ["bash", "-c", SCRIPT, "bash", sandbox.ros_path]
    outcome = sandbox.run(command, role="probe", seconds=SECONDS)
    if outcome.status == 0:
        return
    said = outcome.output.decode(errors="replace").strip()[:LONGEST] or outcome.stopped_by
    values = {"distro": sandbox.ros.distro.name, "said": said}
    if BROKEN in said:
        raise BrokenRosError(Message(texts.BROKEN, values), remedy=remedy)
    raise SurroundingsError(Message(texts.UNTESTED, values), remedy=Message(texts.TRY_AGAIN))
