"""The `bubblewrap` sandbox: Linux namespaces, as root or as a user.

A holder process owns a network namespace with only loopback, a read-only system and the workspace
(a tmpfs with a size limit). Every command enters the holder's namespaces and gets its own PID,
mount and IPC namespaces inside them. Each probe gets a network of its own too, which the node that
it observes enters. The holder reads a pipe from the grader: however the grader
ends, the pipe closes, the holder exits, and the kernel kills every process in its PID namespace.

It does not protect against kernel bugs.
"""

from __future__ import annotations

import contextlib
import json
import os
import select
import shutil
import signal
import subprocess
import time
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import IO

from grader.base.errors import SurroundingsError
from grader.base.i18n.message import say
from grader.ros.prefix import Ros
from grader.sandbox.base import DISCOVERY_PROFILE, HOME, WORKSPACE, Console, Pipe, Role
from grader.sandbox.cgroups import Group, open_group
from grader.sandbox.limits import PROBE_MEMORY, Limits
from grader.sandbox.local import LocalConsole, LocalPipe, LocalSandbox, require_program
from grader.sandbox.processes import adopt_orphans, collect_orphans, descendants
from grader.sandbox.seccomp import filter_path
from grader.sandbox.user_ids import new_user_ids

PROFILE = "/etc/ros/fastdds.xml"
SYSTEM = ("/usr", "/bin", "/sbin", "/lib", "/lib32", "/lib64", "/libx32")
FILES = ("/etc/ld.so.cache", "/etc/alternatives", "/etc/localtime", "/etc/os-release")
STAGED, EMPTY = "/mnt", "/media"
HOLD = f"""\
cd {STAGED} || exit
mount -t overlay -o ro,nosuid,nodev,lowerdir=.:{EMPTY} overlay "$1" 2> /dev/null ||
    mount --bind . "$1" || exit
cd / && umount {STAGED} && echo up && exec cat
"""
"""What the holder does: a bind mount names the folder that it shows, and so the grader's; a file
system with this folder as a layer has the name that the layer was given by, which is relative. Where
the kernel does not allow that (as a user, before Linux 5.11), it is a bind mount."""
FILTER = "9"  # the descriptor from which bwrap reads the filter of system calls
NEW = "new"  # a network namespace that the command makes itself
END_SECONDS = 10.0
POLL_SECONDS = 0.02
NOT_ALLOWED = say("unprivileged user namespaces are not allowed here")
FILTERED = say("namespaces are not allowed here (a container's seccomp filter?)")
USED_UP = say("the kernel's limit on user namespaces is reached")
CAUSES = (
    ("setting up uid map", NOT_ALLOWED),
    ("No permissions to create", NOT_ALLOWED),
    ("Operation not permitted", FILTERED),
    ("Creating new namespace failed", USED_UP),
)


class NetworkedPipe(LocalPipe):
    """A probe with pipes that has a network of its own."""

    _network = -1

    def hold(self, network: int) -> str:
        """Keep the descriptor of the network until the end; return a path that opens it."""
        self._network = network
        return f"/proc/{os.getpid()}/fd/{network}"

    def finish(self, seconds: float) -> None:
        super().finish(seconds)
        network, self._network = self._network, -1
        if network >= 0:
            os.close(network)


class Bubblewrap(LocalSandbox):
    """Commands in Linux namespaces made by bubblewrap."""

    name = "bubblewrap"

    def __init__(self, ros: Ros, limits: Limits) -> None:
        super().__init__(ros, limits)
        self._root = os.geteuid() == 0
        self._bwrap = require_program("bwrap", shutil.which("bwrap"))
        self._nsenter = require_program("nsenter", shutil.which("nsenter"))
        self._holder: subprocess.Popen[bytes] | None = None
        self._init_pid = 0  # of the first process in the holder's PID namespace
        self._init_pidfd = -1  # readable after that process has ended
        self._group = Group()
        student, probe = new_user_ids() if self._root else (1000, 1001)
        self._uids: dict[Role, int] = {"student": student, "probe": probe}
        self._filter = filter_path()

    def profile_path(self, role: Role) -> str:
        del role
        return PROFILE

    def open(self) -> None:
        """Start the holder; raise SurroundingsError with the cause if namespaces are refused."""
        adopt_orphans()
        texts = {
            "/etc/passwd": self._passwd(),
            "/etc/group": "root:x:0:\nstudent:x:1000:\n",
            "/etc/hosts": "127.0.0.1 localhost\n",
            "/etc/nsswitch.conf": "passwd: files\ngroup: files\nhosts: files\n",
            PROFILE: DISCOVERY_PROFILE,
        }
        descriptors = {path: memory_file(text) for path, text in texts.items()}
        info_reader, info_writer = os.pipe()
        # No --die-with-parent: the holder ends when the input of `cat` closes. If the outer bwrap
        # were killed before it releases the inner one, the inner one would wait forever.
        command = [self._bwrap, "--info-fd", str(info_writer)]
        command += ["--unshare-net", "--unshare-pid", "--unshare-ipc", "--unshare-uts"]
        command += ["--hostname", "lab"]
        if not self._root:
            command += ["--unshare-user", "--uid", "0", "--gid", "0", "--cap-add", "ALL"]
        command += self._mounts()
        for path, descriptor in descriptors.items():
            command += ["--perms", "0444", "--ro-bind-data", str(descriptor), path]
        command += ["--remount-ro", "/", "--", "/bin/sh", "-c", HOLD, "sh", self.ros.inside]
        try:
            self._holder = subprocess.Popen(
                command,
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                stderr=subprocess.PIPE,
                # the reading end too: if the grader has ended, a write would kill the outer bwrap
                pass_fds=[info_reader, info_writer, *descriptors.values()],
                start_new_session=True,  # Ctrl+C on the grader's terminal must not reach the holder
                env={"PATH": "/usr/bin:/bin"},
            )
        finally:
            for descriptor in (info_writer, *descriptors.values()):
                os.close(descriptor)
        with os.fdopen(info_reader) as stream:
            info = stream.read()
        try:
            self._init_pid = int(json.loads(info)["child-pid"])
            self._init_pidfd = os.pidfd_open(self._init_pid)
            self._wait_for_mounts(self._holder)
        except (ValueError, KeyError, ProcessLookupError):
            raise self._refused() from None
        self._group = open_group(self.limits)

    def probe(self, argv: Sequence[str]) -> Pipe:
        command = self._enter(argv, "probe", network=NEW)
        self._latest_probe = probe = NetworkedPipe(self, command, self.outer_environment("probe"))
        return probe

    def console(self, argv: Sequence[str], *, probe: Pipe | None = None) -> Console:
        if not isinstance(probe, NetworkedPipe):
            return super().console(argv)
        command = self._enter(argv, "student", network=self._network_of(probe))
        return LocalConsole(command, self.outer_environment("student"))

    def _network_of(self, probe: NetworkedPipe) -> str:
        """Return the path of the probe's network namespace, which stays open with the pipe."""
        shared = {_network(pid).stat().st_ino for pid in (os.getpid(), self._init_pid)}
        limit = self.run_clock.limit(END_SECONDS)
        while not limit.over:
            for pid in sorted(descendants(probe.pid)):
                with contextlib.suppress(OSError):
                    network = os.open(_network(pid), os.O_RDONLY | os.O_CLOEXEC)
                    if os.fstat(network).st_ino not in shared:
                        return probe.hold(network)
                    os.close(network)
            time.sleep(POLL_SECONDS)
        raise SurroundingsError("the probe has no network of its own")

    def command(self, argv: Sequence[str], *, role: Role = "student") -> list[str]:
        return self._enter(argv, role)

    def _enter(self, argv: Sequence[str], role: Role, *, network: str = "") -> list[str]:
        """Return the command line that runs `argv`.

        `network` is the path of a network namespace, NEW for one of its own, "" for the holder's.
        """
        if self._holder is None or self._holder.poll() is not None:
            raise SurroundingsError("the sandbox is closed or was killed from outside")
        inner = [self._bwrap, *self._own_namespaces(role), "--seccomp", FILTER]
        if network == NEW:
            inner.append("--unshare-net")
        for name, value in self.environment(role).items():
            inner += ["--setenv", name, value]
        if self._root:
            uid = str(self._uids[role])
            inner += ["--cap-add", "CAP_SETUID", "--cap-add", "CAP_SETGID"]
            inner += ["--cap-add", "CAP_SETPCAP", "--", "setpriv", f"--reuid={uid}"]
            inner += [f"--regid={uid}", "--clear-groups", "--inh-caps=-all", "--bounding-set=-all"]
        inner += ["--", *self._rlimits(role), "env", "--default-signal=INT", *argv]
        enter = [self._nsenter, "-t", str(self._init_pid), "-m", "-p", "-i", "-u"]
        enter.append(f"--net={network}" if network.startswith("/") else "-n")
        if not self._root:
            enter += ["-U", "--preserve-credentials"]
        # Ctrl+C would kill bwrap and lose the node's last output. bwrap ignores SIGINT; the command
        # inside gets the default handler back (env --default-signal).
        script = f"trap '' INT; exec {FILTER}< {self._filter}; "
        if role == "student":
            script += "".join(f'echo 0 > "{entry}" || exit; ' for entry in self._group.entries)
        return ["/bin/sh", "-c", script + 'exec "$@"', "sh", *enter, "--", *inner]

    def resource_limit_hit(self) -> str:
        return self._group.limit_hit()

    def held_by(self) -> dict[str, str]:
        by = {"cpu_seconds": "rlimit", "file_size": "rlimit", "workspace": "tmpfs"}
        by |= {"memory": "rlimit", "processes": "rlimit"}
        return by | dict.fromkeys(self._group.holds, "cgroup")

    def close(self) -> None:
        holder, self._holder = self._holder, None
        if holder is not None:
            for stream in (holder.stdin, holder.stdout, holder.stderr):
                if stream is not None:
                    stream.close()
            if self._init_pid > 0:  # 0 would be the grader's own process group
                with contextlib.suppress(ProcessLookupError, PermissionError):
                    # killing the first process of a PID namespace kills every process in it
                    os.kill(self._init_pid, signal.SIGKILL)
            else:  # interrupted while opening: `cat` exits at once because its input is closed
                with contextlib.suppress(subprocess.TimeoutExpired):
                    holder.wait(END_SECONDS)
            if holder.poll() is None:
                holder.kill()
            holder.wait()
            self._wait_for_the_end()
        self._group.close()

    def _wait_for_the_end(self) -> None:
        """Wait for the namespace's first process; the kernel has killed the others by then."""
        if self._init_pidfd < 0:
            return
        deadline = time.monotonic() + END_SECONDS
        while not select.select([self._init_pidfd], [], [], POLL_SECONDS)[0]:
            collect_orphans()  # a submission can kill the process that would have reaped them
            if time.monotonic() > deadline:
                break
        os.close(self._init_pidfd)
        collect_orphans()
        self._init_pidfd, self._init_pid = -1, 0

    def _passwd(self) -> str:
        uid = self._uids["student"]
        return f"root:x:0:0::/root:/bin/sh\nstudent:x:{uid}:{uid}::{HOME}:/bin/bash\n"

    def _mounts(self) -> Iterator[str]:
        interpreter = self.ros.interpreter.parent.parent
        for folder in parents_of(WORKSPACE, PROFILE, self.ros.inside, str(interpreter)):
            if not folder.startswith("/usr"):
                yield from ("--perms", "0755", "--dir", folder)
        yield from system_mounts()
        for path in FILES:
            yield from ("--ro-bind-try", path, path)
        if not interpreter.is_relative_to("/usr"):
            yield from ("--ro-bind", str(interpreter), str(interpreter))
        yield from ("--dir", self.ros.inside, "--dir", STAGED, "--dir", EMPTY)
        yield from ("--ro-bind", str(self.ros.path), STAGED)
        yield from ("--dir", "/run", "--dir", "/tmp", "--proc", "/proc", "--dev", "/dev")  # noqa: S108
        size = str(int(self.limits.workspace))
        yield from ("--perms", "0777", "--size", size, "--tmpfs", WORKSPACE)

    def _own_namespaces(self, role: Role) -> list[str]:
        """Return the mounts and namespaces of one command."""
        scratch = str(int(self.limits.workspace / 10))
        # without --die-with-parent, a background process would keep bwrap running
        options = ["--die-with-parent", "--unshare-pid", "--unshare-ipc", "--unshare-cgroup-try"]
        options += ["--ro-bind", "/", "/"]
        if not self._root:
            uid = str(self._uids[role])
            options += ["--unshare-user", "--uid", uid, "--gid", uid]
        options += ["--proc", "/proc", "--dev", "/dev"]
        for path in ("/dev/shm", "/tmp", HOME):  # noqa: S108
            options += ["--perms", "1777", "--size", scratch, "--tmpfs", path]
        if role == "student":
            options += ["--bind", WORKSPACE, WORKSPACE, "--chdir", WORKSPACE]
        else:
            options += ["--chdir", HOME]
        return [*options, "--clearenv"]

    def _rlimits(self, role: Role) -> list[str]:
        limits = self.limits
        words = ["prlimit", "--core=0", f"--fsize={int(limits.file_size)}"]
        if role == "probe":
            return [*words, f"--as={PROBE_MEMORY}"]
        words.append(f"--cpu={int(limits.cpu_seconds)}")
        if "processes" not in self._group.holds:
            words.append(f"--nproc={int(limits.processes)}")
        if "memory" not in self._group.holds:
            words.append(f"--as={int(limits.memory)}")
        return words

    def _wait_for_mounts(self, holder: subprocess.Popen[bytes]) -> None:
        """Wait until the holder says that the mounts are complete; ValueError if it ends."""
        assert holder.stdout is not None
        if holder.stdout.readline() != b"up\n":
            raise ValueError

    def _refused(self) -> SurroundingsError:
        assert self._holder is not None and self._holder.stderr is not None
        stream: IO[bytes] = self._holder.stderr
        self._holder.wait()
        said = stream.read().decode(errors="replace").strip()
        return SurroundingsError(
            say(
                "bubblewrap cannot create a sandbox: {cause}\n  its output: {output}",
                cause=_cause(said),
                output=said or "-",
            ),
            remedy=_remedy(said),
        )


def _network(pid: int) -> Path:
    return Path(f"/proc/{pid}/ns/net")


def _cause(said: str) -> str:
    for mark, cause in CAUSES:
        if mark in said:
            return cause
    return say("bubblewrap failed")


def _remedy(said: str) -> str:
    restricted = Path("/proc/sys/kernel/apparmor_restrict_unprivileged_userns")
    if restricted.is_file() and restricted.read_text().strip() == "1":
        return say(
            "This system's AppArmor blocks them (Ubuntu 24.04 and later do). Either give bwrap an "
            "AppArmor profile with `userns,` (see docs/sandboxes.md), or run the grader as root."
        )
    if Path("/.dockerenv").exists() or Path("/run/.containerenv").exists():
        return say(
            "In a container: start it with `--security-opt seccomp=unconfined "
            "--security-opt apparmor=unconfined --cap-add SYS_ADMIN`, or, if the container is "
            "discarded after each submission, use SANDBOX=account as root."
        )
    if _cause(said) in (NOT_ALLOWED, USED_UP):
        return say("Allow them (sysctl user.max_user_namespaces=15000), or run the grader as root.")
    return say("Report this error message.")


def system_mounts() -> Iterator[str]:
    """Yield the bwrap arguments that mount this machine's programs and libraries read-only."""
    for path in SYSTEM:
        place = Path(path)
        if place.is_symlink():
            yield from ("--symlink", str(place.readlink()), path)
        elif place.is_dir():
            yield from ("--ro-bind", path, path)


def parents_of(*paths: str) -> list[str]:
    """Return the parent folders of these paths, outermost first."""
    found = {str(parent) for path in paths for parent in Path(path).parents} - {"/"}
    return sorted(found, key=lambda folder: (folder.count("/"), folder))


def memory_file(text: str) -> int:
    """Return a file descriptor of an anonymous file with this text."""
    descriptor = os.memfd_create("file")
    os.write(descriptor, text.encode())
    os.lseek(descriptor, 0, os.SEEK_SET)
    return descriptor
