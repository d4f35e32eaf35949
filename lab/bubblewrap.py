"""The lab without Docker: the ROS prefix, the course and the workspace, put together by bubblewrap.

It is a clean room and no jail: the student's own code runs as the student, with the network and
the shared memory of this machine, so that terminals see each other's nodes. What it leaves out is
the rest of their home, so that nothing that was once installed there decides what happens.
"""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
from collections.abc import Iterator, Mapping
from pathlib import Path

from grader.base.errors import SurroundingsError
from grader.base.i18n.message import say
from grader.ros.prefix import Ros, base_interpreter
from grader.sandbox.base import HOME
from grader.sandbox.bubblewrap import FILES, Bubblewrap, memory_file, system_mounts
from grader.sandbox.bubblewrap import parents_of as parents
from grader.sandbox.limits import Limits
from grader.sandbox.local import require_program
from grader.sandbox.processes import kill_with_children
from lab.terminal import foreground_again, ignoring_interrupts
from lab.visit import BASHRC, ROOM, WORKSPACE, Visit, accounts

ROOT = Path(__file__).resolve().parent.parent
CACHE = f"{ROOM}/cache"
SETTINGS = (  # of this machine: its names, certificates, terminals and keys
    *("/etc/hosts", "/etc/resolv.conf", "/etc/host.conf", "/etc/gai.conf", "/etc/services"),
    *("/etc/protocols", "/etc/ssl", "/etc/ca-certificates", "/etc/pki", "/etc/pip.conf"),
    *("/etc/terminfo", "/etc/inputrc", "/etc/nanorc", "/etc/vim", "/etc/bash_completion.d"),
    *("/etc/manpath.config", "/etc/timezone", "/etc/locale.alias", "/etc/mime.types"),
)
SCRATCH = ("/tmp", "/var/tmp", "/run")  # noqa: S108 - the lab's own, fresh in each visit
EDITOR_VARIABLES = ("VISUAL", "EDITOR")
SHARED_MEMORY = "/dev/shm"  # noqa: S108 - Fast DDS meets the nodes of other terminals there


class BubblewrapLab:
    """The lab on a ROS installation of this machine."""

    def __init__(self, ros: Ros) -> None:
        self._ros = ros
        self._bwrap = require_program("bwrap", shutil.which("bwrap"))
        self._root = os.geteuid() == 0

    def enter(self, visit: Visit) -> int:
        """Open the lab on the calling terminal and return the exit status of what ran in it.

        Raises SurroundingsError where bubblewrap cannot make it, with cause and remedy.
        """
        descriptors = {path: memory_file(text) for path, text in self._texts(visit).items()}
        # a file and no pipe: where nobody reads any more, writing would kill the outer bwrap before
        # it lets the inner one go on, which would wait for ever
        status_file = memory_file("")
        words = self._command(visit, descriptors, status_file)
        try:
            # bwrap would die of Ctrl+C and take the lab along; the command inside gets its default
            # back (env --default-signal)
            with ignoring_interrupts(), foreground_again():
                process = subprocess.Popen(
                    words,
                    pass_fds=[status_file, *descriptors.values()],
                    env=self._environment(visit),
                )
                status = _wait(process)
            os.lseek(status_file, 0, os.SEEK_SET)
            with open(status_file, closefd=False) as stream:
                if not _has_run(stream.read()):
                    raise self._refused()
        finally:
            for descriptor in (status_file, *descriptors.values()):
                os.close(descriptor)
        return status

    def _command(self, visit: Visit, descriptors: Mapping[str, int], status_file: int) -> list[str]:
        owner = visit.workspace.owner
        words = [self._bwrap, "--die-with-parent", "--json-status-fd", str(status_file)]
        words += ["--unshare-pid", "--unshare-uts", "--hostname", visit.hostname]
        if not self._root:
            words += ["--unshare-user", "--uid", str(owner.uid), "--gid", str(owner.gid)]
        words += self._mounts(visit)
        for path, descriptor in descriptors.items():
            kind = "--file" if path.startswith(HOME) else "--ro-bind-data"
            words += ["--perms", "0666" if kind == "--file" else "0444", kind]
            words += [str(descriptor), path]
        words += ["--remount-ro", "/", "--chdir", WORKSPACE]
        if self._root:
            for capability in ("CAP_SETUID", "CAP_SETGID", "CAP_SETPCAP"):
                words += ["--cap-add", capability]
            words += ["--", "setpriv", f"--reuid={owner.uid}", f"--regid={owner.gid}"]
            words += ["--clear-groups", "--inh-caps=-all", "--bounding-set=-all"]
        return [*words, "--", "env", "--default-signal=INT", *visit.words]

    def _mounts(self, visit: Visit) -> Iterator[str]:
        pythons = {p for p in self._pythons() if not p.is_relative_to("/usr")}
        places = [self._ros.inside, WORKSPACE, f"{ROOM}/lab", self._cached, *SCRATCH]
        places.append(visit.lesson.place)
        for folder in parents(*places, *FILES, *SETTINGS, *map(str, pythons)):
            if not folder.startswith("/usr"):
                yield from ("--perms", "0755", "--dir", folder)
        yield from system_mounts()
        for path in (*FILES, *SETTINGS):
            yield from ("--ro-bind-try", path, path)
        for python in sorted(pythons):
            yield from ("--ro-bind", str(python), str(python))
        yield from ("--proc", "/proc", "--dev", "/dev")
        yield from ("--bind", os.path.realpath(SHARED_MEMORY), SHARED_MEMORY)
        for scratch in SCRATCH:
            yield from ("--perms", "1777", "--tmpfs", scratch)
        yield from ("--perms", "0777", "--tmpfs", HOME)
        yield from ("--bind", str(visit.workspace.path), WORKSPACE)
        yield from ("--ro-bind", str(self._ros.path), self._ros.inside)
        yield from self._course(visit)

    def _course(self, visit: Visit) -> Iterator[str]:
        """Yield the mounts of the lab's own programs, which `guide` and `check` are."""
        for name, place in (("lab", ROOT / "lab"), ("grader", ROOT / "grader")):
            yield from ("--ro-bind", str(place), f"{ROOM}/{name}")
        yield from ("--ro-bind", sys.prefix, f"{ROOM}/.venv")
        keys = f"{ROOM}/grader/keys"
        yield from ("--tmpfs", keys, "--remount-ro", keys)  # the solutions stay outside
        if visit.lesson.folder is not None:
            yield from ("--ro-bind", str(visit.lesson.folder), visit.lesson.place)
        if self._ros.kind == "wheels":
            # `check` looks for the prefix where the grader keeps what it has made
            yield from ("--symlink", self._ros.inside, self._cached)

    @property
    def _cached(self) -> str:
        return f"{CACHE}/prefixes/{self._ros.path.name}"

    def _pythons(self) -> set[Path]:
        """Return the folders of the Pythons that ROS and the course run on."""
        interpreters = (self._ros.interpreter, base_interpreter())
        return {python.parent.parent for python in interpreters} | {Path(sys.base_prefix)}

    def _texts(self, visit: Visit) -> dict[str, str]:
        """Return the small files that are made for the lab."""
        own = accounts(visit.workspace.owner)
        return {
            "/etc/passwd": own["passwd"],
            "/etc/group": own["group"],
            "/etc/nsswitch.conf": "passwd: files\ngroup: files\nhosts: files dns\n",
            f"{HOME}/.bashrc": f". {BASHRC}\n",
        }

    def _environment(self, visit: Visit) -> dict[str, str]:
        own = visit.environment(os.environ)
        for name, value in os.environ.items():
            if name == "LANG" or name.startswith("LC_"):
                own[name] = value  # the locales are this machine's
            elif name in EDITOR_VARIABLES and _is_inside(value.split(" ")[0]):
                own[name] = value
        own["GRADER_CACHE"] = CACHE
        return own

    def _refused(self) -> SurroundingsError:
        """Say why; the grader's own sandbox knows the causes of this and their remedies."""
        try:
            with Bubblewrap(self._ros, Limits()):
                pass
        except SurroundingsError as error:
            return error
        return SurroundingsError(
            say("bubblewrap could not make the lab (it says why above)"),
            remedy=say("With Docker: make images, then make lab SANDBOX=docker"),
        )


def _wait(process: subprocess.Popen[bytes]) -> int:
    """Wait for the lab's end, or end it if this program is to end; a signal is 128 and its number."""
    try:
        status = process.wait()
    except BaseException:
        kill_with_children(process.pid)
        process.wait()
        raise
    return status if status >= 0 else 128 - status


def _has_run(told: str) -> bool:
    """Whether bubblewrap came as far as to start the command."""
    return any("exit-code" in json.loads(line) for line in told.splitlines())


def _is_inside(program: str) -> bool:
    found = shutil.which(program)
    return found is not None and found.startswith(("/usr/", "/bin/"))
