"""The workspace: `src/<package>` as the course teaches it, built by colcon in the sandbox.

`colcon build` runs the student's setup.py, that is, the student's code. The result is text and a
list of files.
"""

from __future__ import annotations

import io
import re
import tarfile
import time
from dataclasses import dataclass, field

from grader.base.errors import SurroundingsError
from grader.base.i18n.message import joined, say
from grader.package.submission import Submission
from grader.sandbox.base import UNRUNNABLE, Outcome, Sandbox

BUILD = "colcon build --symlink-install"
SUMMARY = "\nSummary: "  # at the end of colcon's output, whether the packages were built or not
MOST_LISTED = 2_000_000  # bytes of the list of built files
MOST_OUTPUT = 2_000  # characters of the output of a failed command of ours
LAY_OUT_SECONDS = 60.0
INSPECT_SECONDS = 20.0
HOOK = re.compile(r"^install/([^/]+)/share/\1/hook/ament_prefix_path\.")
PREFIX = re.compile(r"^install/[^/]+/")
INSPECT = r"""
find install build -printf '%y %m %s %p\t%l\0' 2>/dev/null | head -c 1000000
printf '\0\n'
for file in build/*/*.egg-info/entry_points.txt; do
  [ -f "$file" ] && head -c 100000 "$file"
done
true
"""


@dataclass(frozen=True)
class Installed:
    """A file in the workspace after the build; `kind` is find's %y: f, d, l (with `target`)."""

    kind: str
    mode: int
    size: int
    target: str = ""


@dataclass(frozen=True)
class Build:
    """The result of the build; `status` is None if the limit `stopped_by` ended it."""

    command: str
    status: int | None
    log: str
    seconds: float
    stopped_by: str = ""
    files: dict[str, Installed] = field(default_factory=dict, repr=False)
    entry_points: str = ""

    @property
    def doubts_colcon(self) -> bool:
        """Whether colcon itself may have failed to run (setup.py can cause this too)."""
        ended = self.status != 0 and not self.stopped_by
        return ended and (self.status in UNRUNNABLE or SUMMARY not in self.log)

    def is_installed(self, package: str) -> bool:
        """Whether ROS finds the package: its marker is in a prefix on AMENT_PREFIX_PATH.

        If colcon did not recognise a ROS package, no hook adds its prefix to AMENT_PREFIX_PATH,
        and ros2 run does not find it even if the marker is installed.
        """
        markers = self.installed(f"share/ament_index/resource_index/packages/{package}")
        hooks = [path for path in self.files if HOOK.search(path)]
        return any(hook.split("/")[1] == path.split("/")[1] for path in markers for hook in hooks)

    def installed(self, place: str) -> list[str]:
        """Return the paths at which the overlay has a file.

        colcon makes a prefix for each package, named as in its manifest; ROS looks in all of them.
        """
        return [path for path in self.files if PREFIX.sub("", path) == place]


def as_tar(submission: Submission, folder: str) -> bytes:
    """Return the package as a tar archive, at `src/<folder>`."""
    stream = io.BytesIO()
    now = int(time.time())
    with tarfile.open(fileobj=stream, mode="w", format=tarfile.PAX_FORMAT) as tar:
        for parent in ["src", f"src/{folder}"]:
            tar.addfile(_entry(parent, tarfile.DIRTYPE, 0o755, now))
        for file in submission.files:
            name = f"src/{folder}/{file.path}"
            if file.kind == "folder":
                tar.addfile(_entry(name, tarfile.DIRTYPE, 0o755, now))
            elif file.kind == "link":
                entry = _entry(name, tarfile.SYMTYPE, 0o777, now)
                entry.linkname = file.target
                tar.addfile(entry)
            else:
                entry = _entry(name, tarfile.REGTYPE, file.mode & 0o755 | 0o600, now)
                entry.size = len(file.data)
                tar.addfile(entry, io.BytesIO(file.data))
    return stream.getvalue()


def _entry(name: str, kind: bytes, mode: int, now: int) -> tarfile.TarInfo:
    entry = tarfile.TarInfo(name)
    entry.type, entry.mode, entry.mtime = kind, mode, now
    return entry


def build(sandbox: Sandbox, submission: Submission, *, package: str) -> Build:
    """Lay out the workspace and build it; SurroundingsError only if our own side failed.

    colcon and setup.py run in a command of their own, whose failure is the student's.
    """
    lay_out(sandbox, as_tar(submission, package))
    outcome = sandbox.run(
        ["bash", "-c", f"{_setup(sandbox)}; exec {BUILD} < /dev/null"],
        seconds=sandbox.limits.build_seconds,
    )
    files, entry_points = _inspect(sandbox)
    return Build(
        command=BUILD,
        status=outcome.status,
        log=_text(outcome),
        seconds=outcome.seconds,
        stopped_by=outcome.stopped_by,
        files=files,
        entry_points=entry_points,
    )


def lay_out(sandbox: Sandbox, files: bytes) -> None:
    """Unpack a tar archive into the workspace; SurroundingsError if that fails.

    No code of the student's runs here.
    """
    script = f"tar -xf - && {_setup(sandbox)}"
    outcome = sandbox.run(["bash", "-c", script], stdin=files, seconds=LAY_OUT_SECONDS)
    _check_ours(outcome, say("the workspace could not be laid out"))


def _setup(sandbox: Sandbox) -> str:
    return f'. "{sandbox.ros_path}/setup.bash"'


def _check_ours(outcome: Outcome, failed: str) -> None:
    """Raise SurroundingsError if a command that runs none of the student's code failed."""
    if outcome.status != 0:
        said = _text(outcome)[-MOST_OUTPUT:].strip() or outcome.stopped_by or f"{outcome.status}"
        raise SurroundingsError(joined(failed, said, by=":\n"))


def _text(outcome: Outcome) -> str:
    return outcome.output.decode("utf-8", errors="replace").replace("\r\n", "\n")


def _inspect(sandbox: Sandbox) -> tuple[dict[str, Installed], str]:
    outcome: Outcome = sandbox.run(
        ["sh", "-c", INSPECT], seconds=INSPECT_SECONDS, output=MOST_LISTED
    )
    if not outcome.stopped_by:  # (only what the build left behind can make it exceed a limit)
        _check_ours(outcome, say("the built files could not be listed"))
    listing, _, rest = outcome.output.decode("utf-8", errors="replace").partition("\0\0\n")
    if not rest and "\0\n" in listing:
        listing, _, rest = listing.partition("\0\n")
    files = {}
    for row in listing.split("\0"):
        head, _, target = row.partition("\t")
        parts = head.split(" ", 3)
        if len(parts) == 4 and parts[1].isdigit() and parts[2].isdigit():
            kind, mode, size, path = parts
            files[path] = Installed(kind, int(mode, 8), int(size), target)
    return files, rest
