"""The sandboxes without namespaces: `account` (another user id) and `none`.

`account` is for a grader that runs as root in a container that is discarded afterwards (for
example Gradescope's): student and probe are two unprivileged users, and all their processes are
killed at the end. The submission can use the network and read what every user may read. `none` does
not protect from anything: it is for your own code.
"""

from __future__ import annotations

import contextlib
import os
import random
import re
import secrets
import shutil
import signal
import socket
import stat
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator, Sequence
from pathlib import Path

from grader.base.errors import SurroundingsError
from grader.ros.prefix import Ros
from grader.sandbox.base import DISCOVERY_PROFILE, Role
from grader.sandbox.cgroups import Group, open_group
from grader.sandbox.limits import PROBE_MEMORY, Limits
from grader.sandbox.local import LocalSandbox, require_program
from grader.sandbox.processes import adopt_orphans, descendants, processes, reap, stat_fields
from grader.sandbox.user_ids import new_user_ids

MARK = "GRADER_RUN"
# without a network namespace, the profile keeps the nodes on this machine
LOOPBACK_PROFILE = DISCOVERY_PROFILE.replace(
    "<type>UDPv4</type>",
    "<type>UDPv4</type>\n      "
    "<interfaceWhiteList><address>127.0.0.1</address></interfaceWhiteList>",
)
DOMAINS = range(1, 101)  # safe on Linux according to the ROS documentation of ROS_DOMAIN_ID
END_SECONDS = 10.0
# a `#!` line allows 255 bytes and no spaces, PATH allows no colons
PLAIN_PATH = re.compile(r"/[\w./+-]{0,60}", re.ASCII)
SHORT_FOLDER = "/tmp"  # noqa: S108 - mkdtemp creates a private folder in it


class NoSandbox(LocalSandbox):
    """No sandbox: the commands run as the user that runs the grader."""

    name = "none"

    def __init__(self, ros: Ros, limits: Limits) -> None:
        super().__init__(ros, limits)
        self._folder: Path | None = None
        self._mark = secrets.token_hex(8)
        self._domain, self._domain_lock = 0, -1
        self._prlimit = require_program("prlimit", shutil.which("prlimit"))
        self._group = Group()

    @property
    def folder(self) -> Path:
        """The temporary folder that holds the workspace."""
        if self._folder is None:
            raise SurroundingsError("the sandbox is not open")
        return self._folder

    @property
    def workspace(self) -> str:
        return str(self.folder / "home" / "ros2_ws")

    @property
    def ros_path(self) -> str:
        """`/opt/ros/<distro>` if that is the installation, else a short link to it.

        (The path of colcon's Python becomes the `#!` line of the student's executables.)
        """
        is_inside = str(self.ros.path) == self.ros.inside
        return self.ros.inside if is_inside else str(self.folder / "ros")

    def profile_path(self, role: Role) -> str:
        del role
        return str(self.folder / "fastdds.xml")

    def open(self) -> None:
        adopt_orphans()
        self._domain, self._domain_lock = lock_domain()
        place = tempfile.gettempdir()
        place = place if PLAIN_PATH.fullmatch(place) else SHORT_FOLDER
        self._folder = Path(tempfile.mkdtemp(prefix="grader-", dir=place))
        self._folder.chmod(0o755)
        (self._folder / "ros").symlink_to(self.ros.path)
        for place in ("home", "home/ros2_ws", "probe", "tmp"):
            (self._folder / place).mkdir()
        (self._folder / "fastdds.xml").write_text(LOOPBACK_PROFILE, encoding="utf-8")
        self._group = open_group(self.limits)

    def extra_environment(self) -> dict[str, str]:
        return {
            "HOME": str(self.folder / "home"),
            "TMPDIR": str(self.folder / "tmp"),
            "ROS_DOMAIN_ID": str(self._domain),
            "ROS_AUTOMATIC_DISCOVERY_RANGE": "SYSTEM_DEFAULT",  # as the profile says
            MARK: self._mark,
        }

    def command(self, argv: Sequence[str], *, role: Role = "student") -> list[str]:
        environment = self.environment(role)
        place = self.workspace if role == "student" else str(self.folder / "probe")
        if role == "probe":
            environment["HOME"] = place
        words = ["env", "-i", f"--chdir={place}", "--default-signal=INT"]
        words += [f"{name}={value}" for name, value in environment.items()]
        inner = [*self._become(role), *self._rlimits(role), *words, *argv]
        entries = self._group.entries if role == "student" else []
        script = "".join(f'echo 0 > "{entry}" || exit; ' for entry in entries)
        return ["/bin/sh", "-c", script + 'exec "$@"', "sh", *inner]

    def resource_limit_hit(self) -> str:
        return self._group.limit_hit()

    def held_by(self) -> dict[str, str]:
        by = {"cpu_seconds": "rlimit", "file_size": "rlimit", "workspace": "none"}
        by |= {"memory": "rlimit", "processes": "none" if os.geteuid() == 0 else "rlimit"}
        return by | dict.fromkeys(self._group.holds, "cgroup")

    def close(self) -> None:
        self._end_all()
        if self._folder is not None:
            shutil.rmtree(self._folder, ignore_errors=True)
            self._folder = None
        if self._domain_lock >= 0:
            os.close(self._domain_lock)
            self._domain_lock = -1
        self._group.close()

    def _become(self, role: Role) -> list[str]:
        del role
        return []

    def _rlimits(self, role: Role) -> list[str]:
        limits = self.limits
        words = [self._prlimit, "--core=0", f"--fsize={int(limits.file_size)}"]
        if role == "student":
            words.append(f"--cpu={int(limits.cpu_seconds)}")
            if "memory" not in self._group.holds:
                words.append(f"--as={int(limits.memory)}")
        else:
            words.append(f"--as={PROBE_MEMORY}")
        return words

    def _end_all(self) -> None:
        """Kill all processes with our mark until none is left (children inherit the variable)."""
        deadline = time.monotonic() + END_SECONDS
        while time.monotonic() < deadline:
            alive = list(self._marked_processes())
            for pid in alive:
                try:
                    os.kill(pid, signal.SIGKILL)
                except ProcessLookupError:
                    continue
            reap(alive)
            if not alive:
                return

    def _marked_processes(self) -> Iterator[int]:
        mark = f"{MARK}={self._mark}".encode()
        own = os.getpid()
        children = descendants(own)
        for pid in processes():
            if pid == own:
                continue
            try:
                marked = mark in Path(f"/proc/{pid}/environ").read_bytes().split(b"\0")
                state = stat_fields(pid)[0]
            except OSError:
                continue
            if marked and (state != "Z" or pid in children):
                yield pid


class AccountSandbox(NoSandbox):
    """Student and probe as two unprivileged users; for root in a container that is discarded."""

    name = "account"

    def __init__(self, ros: Ros, limits: Limits) -> None:
        super().__init__(ros, limits)
        if os.geteuid() != 0:
            raise SurroundingsError(
                "the account sandbox needs root because it switches to other user ids",
                remedy="Run the grader as root in a container that is discarded afterwards, or "
                "mark with SANDBOX=bubblewrap.",
            )
        student, probe = new_user_ids()
        self._uids: dict[Role, int] = {"student": student, "probe": probe}
        self._linked: Path | None = None

    def open(self) -> None:
        super().open()
        for place, role in (("home", "student"), ("home/ros2_ws", "student"), ("tmp", "student")):
            os.chown(self.folder / place, self._uids[role], self._uids[role])  # type: ignore[index]
        os.chown(self.folder / "probe", self._uids["probe"], self._uids["probe"])
        inside = Path(self.ros.inside)
        inside.parent.mkdir(parents=True, exist_ok=True)
        with contextlib.suppress(FileExistsError):  # the system's, or another grader's
            inside.symlink_to(self.ros.path)
            self._linked = inside
        for path in (self.ros.path, self.ros.interpreter):
            _must_be_readable(path)

    def held_by(self) -> dict[str, str]:
        return (
            {"processes": "rlimit"} | super().held_by() | dict.fromkeys(self._group.holds, "cgroup")
        )

    def close(self) -> None:
        super().close()
        if self._linked is not None:
            self._linked.unlink(missing_ok=True)
            self._linked = None

    def end(self, process: subprocess.Popen[bytes]) -> None:
        super().end(process)
        self._end_user("student")

    def _become(self, role: Role) -> list[str]:
        uid = str(self._uids[role])
        return [
            "setpriv",
            f"--reuid={uid}",
            f"--regid={uid}",
            "--clear-groups",
            "--inh-caps=-all",
            "--bounding-set=-all",
            "--no-new-privs",
        ]

    def _rlimits(self, role: Role) -> list[str]:
        words = super()._rlimits(role)
        if role == "student" and "processes" not in self._group.holds:
            words.append(f"--nproc={int(self.limits.processes)}")
        return words

    def _end_all(self) -> None:
        roles: tuple[Role, ...] = ("student", "probe")
        for role in roles:
            self._end_user(role)
        super()._end_all()

    def _end_user(self, role: Role) -> None:
        """Kill every process of a user in one call, which a fork bomb cannot escape."""
        script = "import os; os.kill(-1, 9)"
        command = [*self._become(role), sys.executable, "-I", "-S", "-c", script]
        if shutil.which("setpriv") is None:
            return
        subprocess.run(command, check=False, stderr=subprocess.DEVNULL)
        reap(descendants(os.getpid()))


def lock_domain() -> tuple[int, int]:
    """Return a ROS domain id that no other grader in this network uses, and its lock.

    The lock is a descriptor, which the caller closes: a socket whose name belongs to the network, as
    the domain does (unix(7), abstract). Each lab has a /tmp of its own: a file there would not be seen
    by a check in another one. Raises SurroundingsError if all are in use.
    """
    for domain in random.sample(DOMAINS, len(DOMAINS)):
        lock = socket.socket(socket.AF_UNIX)
        try:
            lock.bind(f"\0ros2-grader-domain-{domain}")
        except OSError:  # it is taken
            lock.close()
            continue
        return domain, lock.detach()
    raise SurroundingsError("other graders use every ROS domain id of this machine")


def _must_be_readable(path: Path) -> None:
    for place in (path, *path.resolve().parents):
        if not place.stat().st_mode & stat.S_IXOTH:
            raise SurroundingsError(
                f"other users cannot read {path}: {place} is not accessible to them",
                remedy="Set GRADER_CACHE to a folder that every user can read (e.g. "
                "/var/cache/grader), and run the grader with a Python under /usr.",
            )
