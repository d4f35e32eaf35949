"""When the last commit of a repository was made, read from its files; git itself is never run.

(A repository's configuration may name programs that git starts: hooks, fsmonitor, pagers.)
Formats: gitrepository-layout(5), gitformat-pack(5). Nothing is read through a link.
"""

from __future__ import annotations

import os
import re
import stat
import zlib
from collections.abc import Iterator
from contextlib import contextmanager
from datetime import datetime
from datetime import timezone
from pathlib import Path

from grader.batch.systems.git_pack import in_packs

SHA = re.compile(r"[0-9a-f]{40}(?:[0-9a-f]{24})?")
REF = re.compile(r"ref: (refs/[^\0\n ]+)")
COMMITTER = re.compile(rb"^committer [^\n]* (\d{1,12}) [+-]\d{4}$", re.MULTILINE)
LARGEST_REFS = 4_000_000
LARGEST_COMMIT = 1_000_000
DEEPEST = 5  # one ref may lead to another


class NoCommitError(Exception):
    """The message says why no commit could be read."""


def commit_time(repository: Path) -> datetime:
    """Return when the last commit of what is checked out was made, by the student's own clock.

    NoCommitError if that cannot be told.
    """
    try:
        with _folder(repository / ".git") as git:
            sha = _head(git)
            commit = _loose(git, sha) or in_packs(git, bytes.fromhex(sha), most=LARGEST_COMMIT)
    except OSError as error:
        raise NoCommitError(error.strerror or "it cannot be read") from None
    except (zlib.error, ValueError, IndexError):
        raise NoCommitError("it is damaged") from None
    if commit is None:
        raise NoCommitError("the commit is not there, or stored in a way that is not read here")
    match = COMMITTER.search(commit.partition(b"\n\n")[0])
    if match is None:
        raise NoCommitError("the commit has no date")
    try:
        return datetime.fromtimestamp(int(match[1]), timezone.utc)
    except (ValueError, OverflowError, OSError):
        raise NoCommitError("the commit's date is impossible") from None


@contextmanager
def _folder(path: Path | str, below: int | None = None) -> Iterator[int]:
    flags = os.O_RDONLY | os.O_DIRECTORY | os.O_NOFOLLOW | os.O_CLOEXEC
    handle = os.open(path, flags, dir_fd=below)
    try:
        yield handle
    finally:
        os.close(handle)


def _read(git: int, path: str, most: int) -> bytes | None:
    """Return a file's bytes below an open folder; None if there is none, or a link on the way."""
    folder, _, rest = path.partition("/")
    if folder in ("", ".", ".."):
        return None
    try:
        if rest:
            with _folder(folder, git) as inner:
                return _read(inner, rest, most)
        flags = os.O_RDONLY | os.O_NOFOLLOW | os.O_NONBLOCK | os.O_CLOEXEC
        handle = os.open(folder, flags, dir_fd=git)
    except OSError:
        return None
    with os.fdopen(handle, "rb") as file:
        if not stat.S_ISREG(os.fstat(handle).st_mode):
            return None
        return file.read(most)


def _head(git: int) -> str:
    """Return the commit that HEAD leads to."""
    text = (_read(git, "HEAD", 4_096) or b"").decode("utf-8", "replace").strip()
    for _ in range(DEEPEST):
        if SHA.fullmatch(text):
            return text
        match = REF.fullmatch(text)
        if match is None:
            break
        loose = _read(git, match[1], 4_096)
        text = loose.decode("utf-8", "replace").strip() if loose else _packed_ref(git, match[1])
    raise NoCommitError("HEAD leads to no commit")


def _packed_ref(git: int, ref: str) -> str:
    lines = (_read(git, "packed-refs", LARGEST_REFS) or b"").decode("utf-8", "replace")
    for line in lines.splitlines():
        sha, _, name = line.partition(" ")
        if name == ref:
            return sha
    return ""


def _loose(git: int, sha: str) -> bytes | None:
    packed = _read(git, f"objects/{sha[:2]}/{sha[2:]}", LARGEST_COMMIT)
    if packed is None:
        return None
    header, _, content = zlib.decompressobj().decompress(packed, LARGEST_COMMIT).partition(b"\0")
    return content if header.startswith(b"commit ") else None
