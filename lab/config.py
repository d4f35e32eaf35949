"""The settings of an opened lab, and what both kinds of lab share: paths, environment, accounts."""

from __future__ import annotations

import sys
from collections.abc import Mapping
from dataclasses import dataclass, field

from grader.base.errors import UsageError
from grader.base.i18n.message import say
from grader.base.i18n.translator import OWN, SOURCE
from grader.base.shown import shown
from grader.course.find import GONE_ON
from grader.ros.distro import Distro
from grader.sandbox.base import HOME, PATH
from lab.guide.progress import FOLDER, LESSON_FILE
from lab.lesson import OpenedLesson
from lab.limits import LabLimits
from lab.workspace import Student, Workspace

WORKSPACE = f"{HOME}/ros2_ws"
HIDDEN_HOME = f"{WORKSPACE}/.lab/home"  # the folder in the workspace that is mounted as HOME
LAB_ROOT = "/opt/ros2_teaching_lab"
SHELL_FILES = f"{LAB_ROOT}/lab/shell"
PROXIES = ("HTTP_PROXY", "HTTPS_PROXY", "FTP_PROXY", "ALL_PROXY", "NO_PROXY")
PASSED = (
    *("TERM", "COLORTERM", "NO_COLOR", "TZ"),
    *("ROS_DOMAIN_ID", "ROS_AUTOMATIC_DISCOVERY_RANGE", "ROS_LOCALHOST_ONLY", "ROS_STATIC_PEERS"),
    *("PIP_INDEX_URL", *PROXIES, *(name.lower() for name in PROXIES)),
)
"""The only variables of the calling terminal that are passed to the lab."""


PAGE = ("window",)
"""The command of a lab in the browser: all of its terminals are in the page."""
NETWORK = "LAB_NETWORK"
OWN_NETWORK, THIS_NETWORK = "own", "host"
"""A network that no other lab sees, and that of this machine."""


@dataclass(frozen=True)
class LabConfig:
    """The settings of an opened lab; an empty `command` is an interactive shell.

    `network` counts for a page, which has all terminals of a lab: OWN_NETWORK or THIS_NETWORK.
    """

    distro: Distro
    workspace: Workspace
    lesson: OpenedLesson
    command: tuple[str, ...] = ()
    lang: str = SOURCE
    limits: LabLimits = field(default_factory=LabLimits)
    network: str = OWN_NETWORK

    @property
    def is_page(self) -> bool:
        """Whether the lab is opened in the browser."""
        return self.command == PAGE

    @property
    def hostname(self) -> str:
        """The host name in the lab."""
        return f"lab-{self.distro.name}"

    @property
    def words(self) -> list[str]:
        """The command line to start in the lab. Only a shell on a terminal reads ~/.bashrc."""
        if not self.command and sys.stdin.isatty():
            return ["bash"]
        script = f'. {SHELL_FILES}/environment.bash; exec "$@"'
        return ["bash", "--norc", "-c", script, "lab", *(self.command or ("bash", "--norc"))]

    def environment(self, caller: Mapping[str, str]) -> dict[str, str]:
        """Return the environment of a terminal: the lab's and the PASSED variables of `caller`."""
        return self.own_environment | {name: caller[name] for name in PASSED if caller.get(name)}

    @property
    def own_environment(self) -> dict[str, str]:
        """The lab's variables, which every command in it has, however it is started."""
        return {
            "HOME": HOME,
            "USER": "student",
            "LOGNAME": "student",
            "SHELL": "/bin/bash",
            "PATH": PATH,
            "LANG": "C.UTF-8",
            "TERM": "xterm-256color",
            "ROS_DISTRO": self.distro.name,
            "LAB_WORKSPACE": str(self.workspace.path),
            "LAB_HOME_KEPT": "1",
            OWN: self.lang,
            **self.lesson.environment,
            **({GONE_ON: f"{WORKSPACE}/{FOLDER}/{LESSON_FILE}"} if self.lesson.chosen else {}),
        }


def lab_network(environment: Mapping[str, str]) -> str:
    """Return the network of a page's lab. UsageError for an unknown one."""
    found = environment.get(NETWORK) or OWN_NETWORK
    if found not in (OWN_NETWORK, THIS_NETWORK):
        raise UsageError(
            say("{name} must be own or host, not {text}", name=NETWORK, text=shown(found)),
            remedy=say("For example: {command}", command=f"{NETWORK}=host make lab PAGE=1"),
        )
    return found


def accounts(owner: Student) -> dict[str, str]:
    """Return passwd and group for /etc of a lab in which `student` has the owner's ids."""
    users = ["root:x:0:0:root:/root:/bin/sh"]
    users += [f"student:x:{owner.uid}:{owner.gid}:student:{HOME}:/bin/bash"]
    users += ["nobody:x:65534:65534:nobody:/nonexistent:/usr/sbin/nologin"]
    groups = ["root:x:0:", f"student:x:{owner.gid}:", "nogroup:x:65534:"]
    return {"passwd": "\n".join(users) + "\n", "group": "\n".join(groups) + "\n"}
