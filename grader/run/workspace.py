"""The workspace: `src/<package>` as the course teaches it, built by colcon in the sandbox.

`colcon build` runs the student's setup.py, that is, the student's code. The result is text and a
list of files.
"""

from __future__ import annotations

import base64
import contextlib
import hashlib
import io
import re
import shlex
import tarfile
import time
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field

from grader.base.errors import SurroundingsError
from grader.base.i18n.message import joined, say
from grader.package.submission import SourceFile, Submission
from grader.run.overlay import Fault, Overlay, read_overlay
from grader.sandbox.base import UNRUNNABLE, Outcome, Sandbox

BUILD = "colcon build --symlink-install"
SUMMARY = "\nSummary: "  # at the end of colcon's output, whether the packages were built or not
MOST_LISTED = 2_000_000  # bytes of the list of built files
MOST_OUTPUT = 2_000  # characters of the output of a failed command of ours
LAY_OUT_SECONDS = 60.0
MOST_SAVED = 30_000_000  # bytes of a workspace that is kept to be restored
INSPECT_SECONDS = 20.0
HOOK = re.compile(r"^install/([^/]+)/share/\1/hook/ament_prefix_path\.")
METADATA = re.compile(r"build/[^/]+/[^/]+\.egg-info/entry_points\.txt")
MOST_HASHES = 150_000  # characters; a list that was cut proves nothing
PREFIX = re.compile(r"^install/[^/]+/")
INSPECT = r"""
find install build -printf '%y %m %s %p\t%l\0' 2>/dev/null | head -c 1000000
printf '\0\n'
contents() {
  head -n 20 | while read -r file; do
    case $file in *[!A-Za-z0-9_./+-]*) continue;; esac
    [ -f "$file" ] && printf '%s %s ' "$1" "$file" && head -c 20000 "$file" | base64 -w 0 && echo
  done
}
find build install -name entry_points.txt | contents E
find install/*/lib/* -maxdepth 1 -type f 2>/dev/null | contents S
for file in install/*/lib/*.so*; do
  for folder in "$0/lib" /lib/*-linux-* /usr/lib/*-linux-* /usr/local/lib; do
    [ -e "$folder/${file##*/}" ] && printf 'L %s\n' "$(printf %s "$file" | base64 -w 0)" && break
  done
done
printf 'D - '
find -L install build \( -name '*.dsv' -o -path '*/colcon-core/packages/*' \) -type f -print0 \
  2>/dev/null | head -c 200000 | tar -ch --null -T - 2>/dev/null | head -c 400000 | base64 -w 0
printf '\nH - '
find src -type f -print0 2>/dev/null | head -c 200000 | xargs -0 sha256sum -z 2>/dev/null | base64 -w 0
echo
"""
# With base64, no content of a file can be taken for another line of this output.


@dataclass(frozen=True)
class Installed:
    """A file in the workspace after the build; `kind` is find's %y: f, d, l (with `target`)."""

    kind: str
    mode: int
    size: int
    target: str = ""


@dataclass(frozen=True)
class Build:
    """The result of the build; `status` is None if the limit `stopped_by` ended it.

    `entry_points` is the text of the entry point metadata, `entry_files` that of each of its files,
    `scripts` the text of each installed executable. `altered` has the Python files of the package
    that the build changed or removed, `added` those that it made. `faults` has what would run, or be
    found, instead of what the sources say, if a shell took over the environment of the workspace.
    """

    command: str
    status: int | None
    log: str
    seconds: float
    stopped_by: str = ""
    files: dict[str, Installed] = field(default_factory=dict, repr=False)
    entry_points: str = ""
    entry_files: dict[str, str] = field(default_factory=dict, repr=False)
    scripts: dict[str, str] = field(default_factory=dict, repr=False)
    altered: tuple[str, ...] = ()
    added: tuple[str, ...] = ()
    faults: tuple[Fault, ...] = ()

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
    """Return the packages as a tar archive, the main one at `src/<folder>`."""
    stream = io.BytesIO()
    now = int(time.time())
    others = [(one.name, one.files) for one in submission.packages]
    with tarfile.open(fileobj=stream, mode="w", format=tarfile.PAX_FORMAT) as tar:
        tar.addfile(_entry("src", tarfile.DIRTYPE, 0o755, now))
        for package, files in [(folder, submission.files), *others]:
            _add(tar, f"src/{package}", files, now)
    return stream.getvalue()


def _add(tar: tarfile.TarFile, folder: str, files: Iterable[SourceFile], now: int) -> None:
    tar.addfile(_entry(folder, tarfile.DIRTYPE, 0o755, now))
    for file in files:
        name = f"{folder}/{file.path}"
        if file.kind == "folder":
            tar.addfile(_entry(name, tarfile.DIRTYPE, 0o755, now))
        elif file.kind == "link":
            entry = _entry(name, tarfile.SYMTYPE, 0o777, now)
            entry.linkname = file.target
            tar.addfile(entry)
        else:
            _add_file(tar, name, file, now)


def _add_file(tar: tarfile.TarFile, name: str, file: SourceFile, now: int) -> None:
    entry = _entry(name, tarfile.REGTYPE, file.mode & 0o755 | 0o600, now)
    entry.size = len(file.data)
    tar.addfile(entry, io.BytesIO(file.data))


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
    files, contents = _inspect(sandbox)
    entry_files = {path: text for (kind, path), text in contents.items() if kind == "E"}
    altered, added = _changes(submission, package, contents.get(("H", "-"), ""))
    overlay = _overlay(sandbox, files, contents)
    sandbox.overlay = overlay.commands()
    return Build(
        command=BUILD,
        status=outcome.status,
        log=_text(outcome),
        seconds=outcome.seconds,
        stopped_by=outcome.stopped_by,
        files=files,
        entry_points="".join(
            text for path, text in sorted(entry_files.items()) if METADATA.fullmatch(path)
        ),
        entry_files=entry_files,
        scripts={path: text for (kind, path), text in contents.items() if kind == "S"},
        altered=altered,
        added=added,
        faults=overlay.faults,
    )


def lay_out(sandbox: Sandbox, files: bytes) -> None:
    """Unpack a tar archive into the workspace; SurroundingsError if that fails.

    No code of the student's runs here.
    """
    script = f"find . -mindepth 1 -delete; tar -xf - && {_setup(sandbox)}"
    outcome = sandbox.run(["bash", "-c", script], stdin=files, seconds=LAY_OUT_SECONDS)
    _check_ours(outcome, say("the workspace could not be laid out"))


def save(sandbox: Sandbox) -> bytes:
    """Return the built workspace as a tar archive; b"" if it is too large to be kept."""
    script = "exec 2>/dev/null; chmod -R u+rwX src build install; exec tar -cf - src build install"
    outcome = sandbox.run(["sh", "-c", script], seconds=INSPECT_SECONDS, output=MOST_SAVED)
    return outcome.output if outcome.status == 0 else b""


def restore(sandbox: Sandbox, saved: bytes) -> bool:
    """Make the workspace what it was after the build: nothing that a run left is in it.

    Return False if that fails, which only what a run left behind can cause.
    """
    place = shlex.quote(sandbox.workspace)
    script = (
        f"chmod -R u+rwX {place}/* 2>/dev/null; find {place} -mindepth 1 -delete && exec tar -xpf -"
    )
    return sandbox.run(["sh", "-c", script], stdin=saved, seconds=LAY_OUT_SECONDS).status == 0


def put(sandbox: Sandbox, files: Mapping[str, SourceFile]) -> bool:
    """Write files into the workspace, by their places in it; return whether that worked.

    No code of the student's runs here.
    """
    stream = io.BytesIO()
    with tarfile.open(fileobj=stream, mode="w", format=tarfile.PAX_FORMAT) as tar:
        for place, file in files.items():
            _add_file(tar, place, file, int(time.time()))
    words = ["tar", "-xf", "-", "-C", sandbox.workspace]
    return sandbox.run(words, stdin=stream.getvalue(), seconds=LAY_OUT_SECONDS).status == 0


def _setup(sandbox: Sandbox) -> str:
    return f'. "{sandbox.ros_path}/setup.bash"'


def _check_ours(outcome: Outcome, failed: str) -> None:
    """Raise SurroundingsError if a command that runs none of the student's code failed."""
    if outcome.status != 0:
        said = _text(outcome)[-MOST_OUTPUT:].strip() or outcome.stopped_by or f"{outcome.status}"
        raise SurroundingsError(joined(failed, said, by=":\n"))


def _text(outcome: Outcome) -> str:
    return outcome.output.decode("utf-8", errors="replace").replace("\r\n", "\n")


def _changes(
    submission: Submission, package: str, hashes: str
) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """Return the Python files that the build changed or removed, and those that it made."""
    rows = [row.partition("  ") for row in hashes.split("\0") if row]
    after = {path.removeprefix(f"src/{package}/"): digest for digest, _, path in rows}
    if not after or len(hashes) > MOST_HASHES:
        return (), ()
    before = {
        file.path: hashlib.sha256(file.data).hexdigest()
        for file in submission.files
        if file.kind == "file" and file.path.endswith(".py")
    }
    altered = sorted(path for path, digest in before.items() if after.get(path) != digest)
    added = sorted(path for path in after if path.endswith(".py") and path not in before)
    return tuple(altered), tuple(added)


def _inspect(sandbox: Sandbox) -> tuple[dict[str, Installed], dict[tuple[str, str], str]]:
    outcome: Outcome = sandbox.run(
        ["sh", "-c", INSPECT, sandbox.ros_path], seconds=INSPECT_SECONDS, output=MOST_LISTED
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
    contents: dict[tuple[str, str], str] = {}
    for line in rest.splitlines():
        kind, path, encoded = ([*line.split(" ", 2), "", ""])[:3]
        with contextlib.suppress(ValueError):
            data = base64.b64decode(path if kind == "L" else encoded)
            if kind == "D":
                contents |= {(kind, name): text for name, text in _texts_in(data)}
            elif kind == "L":
                contents[kind, data.decode("utf-8", errors="replace")] = ""
            else:
                contents[kind, path] = data.decode("utf-8", errors="replace")
    return files, contents


def _texts_in(archive: bytes) -> Iterator[tuple[str, str]]:
    """Yield the names and texts of the files in a tar archive, which may be cut."""
    with contextlib.suppress(tarfile.TarError), tarfile.open(fileobj=io.BytesIO(archive)) as tar:
        for entry in tar:
            file = tar.extractfile(entry) if entry.isfile() else None
            if file is not None:
                yield entry.name, file.read().decode("utf-8", errors="replace")


def _overlay(
    sandbox: Sandbox, files: Mapping[str, Installed], contents: Mapping[tuple[str, str], str]
) -> Overlay:
    return read_overlay(
        {path: file.kind for path, file in files.items()},
        {path: text for (kind, path), text in contents.items() if kind == "D"},
        workspace=sandbox.workspace,
        hidden=sorted(path for kind, path in contents if kind == "L"),
    )
