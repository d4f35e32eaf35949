"""The limits of an archive, all in one place, and the counters that enforce them during reading."""

from __future__ import annotations

import time
from dataclasses import dataclass

from grader.base.i18n.message import say
from grader.package.intake.archive_problems import ArchiveError, bomb, too_large
from grader.package.intake.reading import MEGABYTE


@dataclass(frozen=True)
class ArchiveLimits:
    """Limits of one submission, including nested archives; sizes in bytes.

    `packed` is the archive's own size, `unpacked` its total unpacked size, `held` what is kept in
    memory, `file` the largest file that is kept, `nested` the same for an archive in the archive.
    The unpacked size may be `ratio` times the packed size; up to `ratio_from` any ratio is
    accepted. `directory` is a zip's table of contents, `header` the headers of one member of a
    tar, `headers` those of all. `seconds` are CPU time, so that load changes no verdict.
    """

    packed: int = 500 * MEGABYTE
    unpacked: int = 500 * MEGABYTE
    held: int = 100 * MEGABYTE
    file: int = 5 * MEGABYTE
    nested: int = 50 * MEGABYTE
    ratio: int = 100
    ratio_from: int = 20 * MEGABYTE
    members: int = 20_000
    directory: int = 4 * MEGABYTE
    header: int = 32_000
    headers: int = 32 * MEGABYTE
    name: int = 1_000
    seconds: float = 30.0
    depth: int = 3
    archives: int = 20


class Spent:
    """Counts what reading one submission has used; every count raises at its limit."""

    def __init__(self, limits: ArchiveLimits) -> None:
        self.limits = limits
        self._packed = self._members = self._unpacked = self._held = self._archives = 0
        self._until = time.thread_time() + limits.seconds

    def archive(self, what: str, size: int, *, outermost: bool) -> None:
        """Count one more archive of `size` bytes; `outermost` if it is not in another one."""
        if outermost:
            self._packed += size
        if size > self.limits.packed:
            raise ArchiveError(too_large(what, say("it has {size}", size=_in_mb(size))))
        self._archives += 1
        if self._archives > self.limits.archives:
            raise ArchiveError(
                too_large(
                    what,
                    say("it contains more than {count} other archives", count=self.limits.archives),
                )
            )

    def member(self, what: str) -> None:
        """Count one more file, folder or link."""
        self._members += 1
        if self._members > self.limits.members:
            most = f"{self.limits.members:,}"
            raise ArchiveError(
                too_large(what, say("it contains more than {count} files and folders", count=most))
            )
        self._in_time(what)

    def unpack(self, what: str, size: int) -> None:
        """Count `size` more unpacked bytes."""
        self._unpacked += size
        self.foresee(what, 0)
        self._in_time(what)

    def foresee(self, what: str, size: int) -> None:
        """Refuse an archive that declares `size` more unpacked bytes, if they are too many."""
        coming = self._unpacked + size
        if coming > self.limits.ratio_from and coming > self.limits.ratio * max(self._packed, 1):
            raise ArchiveError(bomb(what, packed=_in_mb(self._packed), unpacked=_in_mb(coming)))
        if coming > self.limits.unpacked:
            raise ArchiveError(
                too_large(what, say("it unpacks to more than {size}", size=_in_mb(coming)))
            )

    def hold(self, what: str, size: int) -> None:
        """Count `size` more bytes kept in memory."""
        self._held += size
        if self._held > self.limits.held:
            most = _in_mb(self.limits.held)
            raise ArchiveError(
                too_large(what, say("its files have more than {size} in total", size=most))
            )

    def _in_time(self, what: str) -> None:
        if time.thread_time() > self._until:
            reason = say(
                "reading it takes more than {seconds} seconds", seconds=f"{self.limits.seconds:g}"
            )
            raise ArchiveError(too_large(what, reason))


def _in_mb(size: int) -> str:
    return f"{size / MEGABYTE:.3g} MB" if size < 1000 * MEGABYTE else f"{size / 1e9:.3g} GB"
