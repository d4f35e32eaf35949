"""Builds the interfaces of a submission for the probe, from their texts alone.

The probe never loads what the student built: a CMakeLists.txt of ours builds the texts of .msg,
.srv and .action files, as the probe's user, before any of the student's code has run in the
sandbox. The result is kept in the cache under a hash of all that it depends on.
"""

from __future__ import annotations

import contextlib
import hashlib
import io
import os
import tarfile
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from grader.base.cache import cache_root
from grader.base.folder import Folder
from grader.package.source.interface_faults import interface_texts
from grader.package.submission import Package, Submission
from grader.ros.distro import HERE
from grader.ros.interface_package import BUILD, USED, interface_package
from grader.ros.prefix import Ros
from grader.sandbox.base import LOAD, Sandbox
from grader.sandbox.scheduling import StarvedError

FORMAT = 2  # increment it when something else is built
BUILD_SECONDS = 120.0
MOST_OUTPUT = 60_000_000  # bytes of what was built
SCRIPT = f"""
exec 3>&1 1>&2
cd "$(mktemp -d)"
tar -xf -
for package in $2; do
  export AMENT_PREFIX_PATH="$PWD/install" CMAKE_PREFIX_PATH="$PWD/install"
  bash -c '{BUILD}' bash "$1" "$PWD/src/$package" "$PWD/install" || exit 1
done
exec tar -cf - -C install lib share >&3 2>/dev/null
"""


@dataclass(frozen=True)
class Texts:
    """The interface texts of one package, and the packages whose types they use."""

    package: str
    texts: Mapping[str, str]
    uses: tuple[str, ...]


def texts_of(package: Package) -> Texts:
    """Return the interface texts of a package that can be used."""
    texts = interface_texts(package)
    found = {
        path: data.decode("utf-8") for path, data in texts.files.items() if not texts.fault(path)
    }
    used = {name for text in found.values() for name in USED.findall(text)}
    return Texts(package.name, found, tuple(sorted(used - {package.name})))


def interfaces_of(sandbox: Sandbox, submission: Submission) -> bytes:
    """Return the built interfaces of a submission as a tar archive; b"" if there are none.

    They are b"" too if the texts cannot be built: then the student's own build fails as well.
    Raises StarvedError if the machine is too busy to build them.
    """
    packages = [texts for texts in map(texts_of, submission.packages) if texts.texts]
    if not packages:
        return b""
    kept = cache_root() / "interfaces" / f"{_key(sandbox.ros, packages)}.tar"
    with contextlib.suppress(OSError):
        return kept.read_bytes()
    built = _build(sandbox, _in_order(packages))
    if built:
        _keep(kept, built)
    return built


def _in_order(packages: list[Texts]) -> list[Texts]:
    """Return the packages, those that others use first."""
    ordered: list[Texts] = []
    left = list(packages)
    while left:
        names = {texts.package for texts in left}
        ready = [texts for texts in left if not names & set(texts.uses)] or left
        ordered += ready
        left = [texts for texts in left if texts not in ready]
    return ordered


def _key(ros: Ros, packages: list[Texts]) -> str:
    key = hashlib.sha256(b"%d " % FORMAT + os.fsencode(ros.path.name) + repr(ros.versions).encode())
    key.update((HERE / "interfaces.cmake.in").read_bytes())
    key.update(repr([(t.package, sorted(t.texts.items()), t.uses) for t in packages]).encode())
    return key.hexdigest()


def _build(sandbox: Sandbox, packages: list[Texts]) -> bytes:
    own = {texts.package for texts in packages}
    stream = io.BytesIO()
    with tarfile.open(fileobj=stream, mode="w") as tar:
        for texts in packages:
            uses = [name for name in texts.uses if name in own or _is_in_ros(sandbox.ros, name)]
            for path, text in interface_package(texts.package, texts.texts, uses).items():
                entry = tarfile.TarInfo(f"src/{texts.package}/{path}")
                entry.size = len(text.encode())
                tar.addfile(entry, io.BytesIO(text.encode()))
    names = " ".join(texts.package for texts in packages)
    outcome = sandbox.run(
        ["bash", "-c", f"({SCRIPT}) 2>/dev/null", "bash", sandbox.ros_path, names],
        role="probe",
        stdin=stream.getvalue(),
        seconds=BUILD_SECONDS,
        output=MOST_OUTPUT,
    )
    if outcome.stopped_by == LOAD:
        raise StarvedError("the machine was too busy to build the interfaces")
    return outcome.output if outcome.status == 0 else b""


def _is_in_ros(ros: Ros, package: str) -> bool:
    """Whether ROS has a package; of an image, whose files are elsewhere, it is assumed."""
    share = ros.path / "share"
    return not share.is_dir() or (share / package).is_dir()


def _keep(file: Path, content: bytes) -> None:
    """Write a file of the cache; a cache that cannot be written costs only time."""
    with contextlib.suppress(OSError):
        file.parent.mkdir(parents=True, exist_ok=True)
        with Folder.open(file.parent) as folder:
            folder.replace(file.name, content)
