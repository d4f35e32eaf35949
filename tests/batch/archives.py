"""Archives that students submit and instructors download, valid and hostile."""

from __future__ import annotations

import io
import os
import stat
import subprocess
import tarfile
import zipfile
from collections.abc import Iterable, Mapping
from pathlib import Path

from grader.package.submission import Submission, take_in

PACKAGE = "my_robot_controller"
NODE = "my_first_node.py"
NODE_PATH = f"{PACKAGE}/{NODE}"
EXECUTABLE = frozenset({NODE_PATH})
UNIX, WINDOWS = 3, 0  # zip: "version made by" (APPNOTE 4.4.2)


def package(node: str = "print('hello')\n", *, below: str = "") -> dict[str, bytes]:
    """Return the files of a small package by path, below the given folder."""
    start = f"{below}/" if below else ""
    files = {
        "package.xml": f"<package format='3'>\n  <name>{PACKAGE}</name>\n</package>\n",
        "setup.py": f"from setuptools import setup\nsetup(name='{PACKAGE}')\n",
        "setup.cfg": "[develop]\n",
        f"resource/{PACKAGE}": "",
        f"{PACKAGE}/__init__.py": "",
        NODE_PATH: "#!/usr/bin/env python3\n" + node,
    }
    return {start + path: text.encode() for path, text in files.items()}


def mode_of(path: str) -> int:
    return 0o755 if path.endswith(NODE) else 0o644


def write(root: Path, files: Mapping[str, bytes]) -> Path:
    """Write files into a folder, with the modes that the course requires."""
    for path, data in files.items():
        (root / path).parent.mkdir(parents=True, exist_ok=True)
        (root / path).write_bytes(data)
        (root / path).chmod(mode_of(path))
    return root


def zipped(files: Mapping[str, bytes], *, system: int = UNIX, comment: bytes = b"") -> bytes:
    """Return a zip as the given operating system makes it."""
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.comment = comment
        for path, data in files.items():
            info = zipfile.ZipInfo(path, (2026, 3, 4, 10, 20, 30))
            info.create_system = system
            info.compress_type = zipfile.ZIP_DEFLATED
            info.external_attr = (stat.S_IFREG | mode_of(path)) << 16 if system == UNIX else 0x20
            archive.writestr(info, data)
    return stream.getvalue()


def tarred(files: Mapping[str, bytes], mode: str = "w") -> bytes:
    """Return a tar; `mode` is that of tarfile: w, w:gz, w:xz, w:bz2."""
    stream = io.BytesIO()
    with tarfile.open(fileobj=stream, mode=mode) as archive:  # type: ignore[call-overload]
        for path, data in files.items():
            add_file(archive, path, data)
    return stream.getvalue()


def add_file(archive: tarfile.TarFile, path: str, data: bytes = b"") -> None:
    info = tarfile.TarInfo(path)
    info.size, info.mode = len(data), mode_of(path)
    archive.addfile(info, io.BytesIO(data))


def tar_with(*odd: tarfile.TarInfo, files: Mapping[str, bytes] | None = None) -> bytes:
    """Return a tar of a valid package and of the given odd members."""
    stream = io.BytesIO()
    with tarfile.open(fileobj=stream, mode="w", format=tarfile.PAX_FORMAT) as archive:
        for path, data in (files if files is not None else package()).items():
            add_file(archive, path, data)
        for info in odd:
            archive.addfile(info)
    return stream.getvalue()


def odd_member(name: str, kind: bytes, target: str = "", mode: int = 0o644) -> tarfile.TarInfo:
    info = tarfile.TarInfo(name)
    info.type, info.linkname, info.mode = kind, target, mode
    return info


def take(path: Path, *, modes_kept: bool = True) -> Submission:
    return take_in(path, package=PACKAGE, node_file=NODE, modes_kept=modes_kept)


def hand_in(folder: Path, data: bytes, name: str = "jane.zip") -> Submission:
    """Write an archive into a folder and run intake on it."""
    (folder / name).write_bytes(data)
    return take(folder / name)


def notes(submission: Submission) -> str:
    return "\n".join(submission.notes)


def everything_below(root: Path) -> set[str]:
    return {path.relative_to(root).as_posix() for path in root.rglob("*")}


def zip_of(entries: Iterable[tuple[zipfile.ZipInfo, bytes]]) -> bytes:
    """Return a zip of the given members, including duplicates."""
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w") as archive:
        for info, data in entries:
            archive.writestr(info, data)
    return stream.getvalue()


def git(folder: Path, *words: str, at: str = "2026-03-04T10:20:30+01:00") -> str:
    """Run git in a folder with a fixed identity and time."""
    who = {"GIT_CONFIG_GLOBAL": "/dev/null", "GIT_CONFIG_SYSTEM": "/dev/null", "HOME": "/nowhere"}
    for role in ("AUTHOR", "COMMITTER"):
        who |= {f"GIT_{role}_NAME": "A", f"GIT_{role}_EMAIL": "a@b", f"GIT_{role}_DATE": at}
    environment = {**who, "PATH": os.environ["PATH"]}
    done = subprocess.run(
        ["git", *words], cwd=folder, env=environment, check=True, capture_output=True, text=True
    )
    return done.stdout.strip()


def repository(folder: Path, *, at: str = "2026-03-04T10:20:30+01:00") -> Path:
    """Create a repository with a package in it, committed at the given time."""
    write(folder, package())
    git(folder, "init", "-q", "-b", "main")
    git(folder, "add", "-A")
    git(folder, "commit", "-q", "-m", "my package", at=at)
    return folder


def class_zip(path: Path, files: Mapping[str, bytes], *, system: int = UNIX) -> Path:
    """Write the zip of a whole class."""
    path.write_bytes(zipped(files, system=system))
    return path
