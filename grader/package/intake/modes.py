"""Whether the exec bits in a folder are the student's, or only those of its file system."""

from __future__ import annotations

import re
import struct
from collections.abc import Callable, Mapping
from pathlib import Path

from grader.package.intake.reading import Unread, read_bytes

MOUNTS = Path("/proc/self/mountinfo")
NO_MODES = frozenset(
    {
        *("vfat", "msdos", "fat", "exfat", "ntfs", "ntfs3", "fuseblk", "9p", "v9fs", "drvfs"),
        *("cifs", "smb3", "smbfs", "vboxsf", "prl_fs", "iso9660", "udf", "hfs"),
        *("fuse.vmhgfs-fuse", "fuse.grpcfuse", "fuse.osxfs", "fuse.exfat", "fuse.ntfs-3g"),
    }
)
MOST_CONFIG_BYTES = 100_000
MOST_INDEX_BYTES = 20_000_000
FIXED = 62  # bytes of an index entry before its path (gitformat-index(5))


def keeps_modes(path: Path, mounts: Path = MOUNTS) -> bool:
    """Whether the file system of an absolute path keeps each file's exec bit (proc(5))."""
    try:
        rows = mounts.read_text(encoding="utf-8", errors="surrogateescape").splitlines()
    except OSError:
        return True
    best, kind = "", ""
    for row in rows:
        left, _, right = row.partition(" - ")
        fields = left.split(" ")
        if len(fields) < 5:
            continue
        point = re.sub(r"\\([0-7]{3})", lambda m: chr(int(m[1], 8)), fields[4])
        inside = point == "/" or str(path) == point or str(path).startswith(f"{point}/")
        if inside and len(point) >= len(best):  # of two mounts on a folder the later is on top
            best, kind = point, right.partition(" ")[0]
    return kind not in NO_MODES


def git_ignores_modes(
    repository: Path, read: Callable[[Path, int], bytes | Unread] = read_bytes
) -> bool:
    """Whether `core.fileMode` is false in a checkout; git itself is never run.

    If it is set more than once, the last value counts (git-config(1)).
    """
    found = read(repository / ".git" / "config", MOST_CONFIG_BYTES)
    if isinstance(found, Unread):
        return False
    inside = ignored = False
    for line in found.decode("utf-8", "replace").splitlines():
        text = line.strip()
        if text.startswith("["):
            inside = text.lower().startswith("[core]")
        name, _, value = text.partition("=")
        if inside and name.strip().lower() == "filemode":
            ignored = value.partition("#")[0].strip().lower() in ("false", "no", "off", "0")
    return ignored


def git_modes(
    repository: Path, read: Callable[[Path, int], bytes | Unread] = read_bytes
) -> Mapping[str, int]:
    """Return the modes (0o644, 0o755) of a checkout's index by path; empty if it has none.

    Versions 2 and 3 of the format (gitformat-index(5)) with SHA-1 names.
    """
    found = read(repository / ".git" / "index", MOST_INDEX_BYTES)
    if isinstance(found, Unread) or len(found) < 12:
        return {}
    magic, version, count = struct.unpack(">4sII", found[:12])
    if magic != b"DIRC" or version not in (2, 3):
        return {}
    modes: dict[str, int] = {}
    at = 12
    for _ in range(min(count, len(found) // FIXED)):
        if at + FIXED > len(found):
            return {}
        (mode,) = struct.unpack_from(">I", found, at + 24)
        (flags,) = struct.unpack_from(">H", found, at + 60)
        start = at + FIXED + (2 if version == 3 and flags & 0x4000 else 0)
        end = found.find(b"\0", start)
        if end < 0 or mode not in (0o100644, 0o100755, 0o120000, 0o160000):
            return {}
        if mode >> 12 == 0o10:
            modes[found[start:end].decode("utf-8", "surrogateescape")] = mode & 0o777
        at += (end - at) // 8 * 8 + 8  # each entry is padded with 1 to 8 null bytes
    return modes
