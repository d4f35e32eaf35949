"""The lab without Docker: bubblewrap mounts the ROS prefix, the course and the workspace.

It is a clean environment, not a security boundary: the student's own code runs as the student, with
this machine's network and shared memory, so that terminals see each other's nodes. A lab in the browser
has a network and shared memory of its own: its page has all of its terminals. The rest of the
home folder is hidden, so that software installed there has no effect.
"""

from __future__ import annotations

import json
import os
import re
import shutil
import subprocess
import sys
from collections.abc import Collection, Iterator, Mapping
from pathlib import Path

from grader.base.errors import SurroundingsError
from grader.base.i18n.message import say
from grader.ros.prefix import Ros, base_interpreter
from grader.sandbox.base import HOME
from grader.sandbox.bubblewrap import FILES, Bubblewrap, memory_file, parents_of, system_mounts
from grader.sandbox.cgroups import Group, open_group
from grader.sandbox.limits import Limits
from grader.sandbox.local import require_program
from grader.sandbox.processes import kill_with_children
from lab.config import HIDDEN_HOME, LAB_ROOT, OWN_NETWORK, WORKSPACE, LabConfig, accounts
from lab.door import Door
from lab.limits import LabLimits
from lab.terminal import ignoring_interrupts, restoring_foreground

ROOT = Path(__file__).resolve().parent.parent
CACHE = f"{LAB_ROOT}/cache"
SETTINGS = (  # of this machine: host names, certificates, terminals and editors
    *("/etc/hosts", "/etc/resolv.conf", "/etc/host.conf", "/etc/gai.conf", "/etc/services"),
    *("/etc/protocols", "/etc/ssl", "/etc/ca-certificates", "/etc/pki", "/etc/pip.conf"),
    *("/etc/terminfo", "/etc/inputrc", "/etc/nanorc", "/etc/vim", "/etc/bash_completion.d"),
    *("/etc/manpath.config", "/etc/timezone", "/etc/locale.alias", "/etc/mime.types"),
)
SCRATCH = ("/tmp", "/var/tmp", "/run")  # noqa: S108 - private and empty at the start
EDITOR_VARIABLES = ("VISUAL", "EDITOR")
SHARED_MEMORY = "/dev/shm"  # noqa: S108 - Fast DDS uses it between terminals


class BubblewrapLab:
    """A lab with a ROS installation of this machine."""

    def __init__(self, ros: Ros) -> None:
        self._ros = ros
        self._bwrap = require_program("bwrap", shutil.which("bwrap"))
        self._root = os.geteuid() == 0

    def enter(self, config: LabConfig) -> int:
        """Open the lab on the calling terminal and return the exit status of its command.

        Raises SurroundingsError with cause and remedy if bubblewrap cannot open it.
        """
        descriptors = {path: memory_file(text) for path, text in self._texts(config).items()}
        # a file instead of a pipe: writing to a pipe without a reader would kill the outer bwrap
        # before it releases the inner one, which would wait forever
        status_file = memory_file("")
        group = open_group(
            Limits().override(
                {"memory": config.limits.memory, "processes": config.limits.processes}
            )
        )
        try:
            words = in_group(group, self._command(config, descriptors, status_file, group.holds))
            door = Door() if config.is_page else None
            opened = {} if door is None else door.variables
            # Ctrl+C would kill bwrap and the lab; the command inside gets the default handler back
            # (env --default-signal)
            with ignoring_interrupts(), restoring_foreground():
                process = subprocess.Popen(
                    words,
                    pass_fds=[
                        *(status_file, *descriptors.values()),
                        *([] if door is None else [door.descriptor]),
                    ],
                    env={**self._environment(config), **opened},
                )
                if door is not None:
                    door.show()
                status = _wait(process)
            os.lseek(status_file, 0, os.SEEK_SET)
            with open(status_file, closefd=False) as stream:
                if not _has_run(stream.read()):
                    raise self._refused()
        finally:
            for descriptor in (status_file, *descriptors.values()):
                os.close(descriptor)
            group.close()
        return status

    def _command(
        self,
        config: LabConfig,
        descriptors: Mapping[str, int],
        status_file: int,
        held: Collection[str],
    ) -> list[str]:
        owner = config.workspace.owner
        words = [self._bwrap, "--die-with-parent", "--json-status-fd", str(status_file)]
        words += ["--unshare-pid", "--unshare-uts", "--hostname", config.hostname]
        if not self._root:
            words += ["--unshare-user", "--uid", str(owner.uid), "--gid", str(owner.gid)]
        if has_own_network(config):
            words += ["--unshare-net", "--unshare-ipc"]
        words += self._mounts(config)
        for path, descriptor in descriptors.items():
            words += ["--perms", "0444", "--ro-bind-data", str(descriptor), path]
        words += ["--remount-ro", "/", "--chdir", WORKSPACE]
        if self._root:
            for capability in ("CAP_SETUID", "CAP_SETGID", "CAP_SETPCAP"):
                words += ["--cap-add", capability]
            words += ["--", "setpriv", f"--reuid={owner.uid}", f"--regid={owner.gid}"]
            words += ["--clear-groups", "--inh-caps=-all", "--bounding-set=-all"]
        words += ["--", *rlimits(config.limits, held, root=self._root)]
        return [*words, "env", "--default-signal=INT", *config.words]

    def _mounts(self, config: LabConfig) -> Iterator[str]:
        pythons = {p for p in self._pythons() if not p.is_relative_to("/usr")}
        targets = [self._ros.inside, WORKSPACE, f"{LAB_ROOT}/lab", self._cached_prefix, *SCRATCH]
        targets.append(config.lesson.path_inside)
        for folder in parents_of(*targets, *FILES, *SETTINGS, *map(str, pythons)):
            if not folder.startswith("/usr"):
                yield from ("--perms", "0755", "--dir", folder)
        yield from system_mounts()
        for path in (*FILES, *SETTINGS):
            yield from ("--ro-bind-try", path, path)
        for python in sorted(pythons):
            yield from ("--ro-bind", str(python), str(python))
        yield from ("--proc", "/proc", "--dev", "/dev")
        scratches: tuple[str, ...] = SCRATCH
        if has_own_network(config):
            scratches = (*SCRATCH, SHARED_MEMORY)
        else:
            yield from ("--bind", os.path.realpath(SHARED_MEMORY), SHARED_MEMORY)
        for scratch in scratches:
            yield from ("--perms", "1777", "--size", str(config.limits.tmp), "--tmpfs", scratch)
        yield from ("--bind", str(config.workspace.home), HOME)
        yield from ("--bind", str(config.workspace.path), WORKSPACE)
        # it is in the workspace too: without this, `find ~` would never end
        yield from ("--perms", "0555", "--tmpfs", HIDDEN_HOME, "--remount-ro", HIDDEN_HOME)
        yield from ("--ro-bind", str(self._ros.path), self._ros.inside)
        yield from self._course(config)

    def _course(self, config: LabConfig) -> Iterator[str]:
        """Yield the mounts of the lab's programs (`guide`, `check`, …) and of the lesson."""
        for name in ("lab", "grader"):
            yield from ("--ro-bind", str(ROOT / name), f"{LAB_ROOT}/{name}")
        yield from ("--ro-bind", sys.prefix, f"{LAB_ROOT}/.venv")
        keys = f"{LAB_ROOT}/grader/keys"
        yield from ("--tmpfs", keys, "--remount-ro", keys)  # the solutions stay outside
        if config.lesson.folder is not None:
            yield from ("--ro-bind", str(config.lesson.folder), config.lesson.path_inside)
        if self._ros.kind == "wheels":
            # `check` looks for the prefix in the grader's cache
            yield from ("--symlink", self._ros.inside, self._cached_prefix)

    @property
    def _cached_prefix(self) -> str:
        return f"{CACHE}/prefixes/{self._ros.path.name}"

    def _pythons(self) -> set[Path]:
        """Return the folders of the Pythons that ROS and the lab's programs use."""
        interpreters = (self._ros.interpreter, base_interpreter())
        return {python.parent.parent for python in interpreters} | {Path(sys.base_prefix)}

    def _texts(self, config: LabConfig) -> dict[str, str]:
        """Return the contents of the files that are generated for the lab, by path."""
        own = accounts(config.workspace.owner)
        return {
            "/etc/passwd": own["passwd"],
            "/etc/group": own["group"],
            "/etc/nsswitch.conf": "passwd: files\ngroup: files\nhosts: files dns\n",
        }

    def _environment(self, config: LabConfig) -> dict[str, str]:
        own = config.environment(os.environ)
        for name, value in os.environ.items():
            if name == "LANG" or name.startswith("LC_"):
                own[name] = value  # the lab has this machine's locales
            elif name in EDITOR_VARIABLES and _is_inside(value.split(" ")[0]):
                own[name] = value
        own["GRADER_CACHE"] = CACHE
        return own

    def _refused(self) -> SurroundingsError:
        """Return the error with cause and remedy, which the grader's sandbox determines."""
        try:
            with Bubblewrap(self._ros, Limits()):
                pass
        except SurroundingsError as error:
            return error
        return SurroundingsError(
            say("bubblewrap could not open the lab (see its message above)"),
            remedy=say("With Docker: make images, then make lab SANDBOX=docker"),
        )


def has_own_network(config: LabConfig) -> bool:
    """Whether the lab has a network and shared memory of its own.

    A page has all terminals of its lab; other terminals have to see each other's nodes.
    """
    return config.is_page and config.network == OWN_NETWORK


def in_group(group: Group, words: list[str]) -> list[str]:
    """Return a command line that enters a control group first, if it may."""
    script = "".join(f'echo 0 2> /dev/null > "{entry}"; ' for entry in group.entries)
    return ["/bin/sh", "-c", script + 'exec "$@"', "sh", *words] if script else words


def rlimits(limits: LabLimits, held: Collection[str], *, root: bool) -> list[str]:
    """Return the words that set the limits which no control group holds, as far as they can be.

    Memory: of each process. Processes: from Linux 5.14 on the kernel counts those of the lab's own
    user namespace; before, and where root has none, it would count all processes of the student.
    """
    words = [] if "memory" in held else [f"--data={limits.memory}"]
    numbers = re.match(r"(\d+)\.(\d+)", os.uname().release)
    counted = numbers is not None and (int(numbers[1]), int(numbers[2])) >= (5, 14)
    if "processes" not in held and counted and not root:
        words.append(f"--nproc={limits.processes}")
    return ["prlimit", *words] if words else []


def _wait(process: subprocess.Popen[bytes]) -> int:
    """Return the lab's exit status (128 + N for signal N); kill the lab if this program ends."""
    try:
        status = process.wait()
    except BaseException:
        kill_with_children(process.pid)
        process.wait()
        raise
    return status if status >= 0 else 128 - status


def _has_run(status_lines: str) -> bool:
    """Whether bubblewrap started the command."""
    return any("exit-code" in json.loads(line) for line in status_lines.splitlines())


def _is_inside(program: str) -> bool:
    found = shutil.which(program)
    return found is not None and found.startswith(("/usr/", "/bin/"))
