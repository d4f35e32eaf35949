"""How much an archive may hold: every number in one place, and what counts them while it is read."""

from __future__ import annotations

import time
from dataclasses import dataclass

from grader.base.i18n.message import say
from grader.package.intake.archive_problems import ArchiveError
from grader.package.intake.archive_problems import bomb
from grader.package.intake.archive_problems import too_large
from grader.package.intake.reading import MEGABYTE


@dataclass(frozen=True)
class ArchiveLimits:
    """Limits of one thing handed in, whatever is nested in it; sizes in bytes.

    `packed` is the archive's own size, `unpacked` what comes out of it in all, `held` what is
    kept in memory, `file` what one file may have to be kept, `nested` the same for an archive in
    the archive. What comes out may be `ratio` times the size of what goes in; below `ratio_from`
    nobody asks. `directory` is a zip's table of contents, `header` what describes one member of a
    tar, and `headers` all of them. `seconds` are processor time, so that load changes no verdict.
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
    """What the reading of one thing handed in has come to; every count raises at its limit."""

    def __init__(self, limits: ArchiveLimits) -> None:
        self.limits = limits
        self._packed = self._members = self._unpacked = self._held = self._archives = 0
        self._until = time.thread_time() + limits.seconds

    def archive(self, what: str, size: int, *, handed_in: bool) -> None:
        """One more archive of `size` bytes is opened; `handed_in` if it lay in no other one."""
        if handed_in:
            self._packed += size
        if size > self.limits.packed:
            raise ArchiveError(too_large(what, say("it has {size}", size=_in_mb(size))))
        self._archives += 1
        if self._archives > self.limits.archives:
            raise ArchiveError(
                too_large(
                    what, say("it holds more than {count} others", count=self.limits.archives)
                )
            )

    def member(self, what: str) -> None:
        """One more file, folder or link."""
        self._members += 1
        if self._members > self.limits.members:
            most = f"{self.limits.members:,}"
            raise ArchiveError(
                too_large(what, say("it holds more than {count} files and folders", count=most))
            )
        self._in_time(what)

    def unpack(self, what: str, size: int) -> None:
        """`size` bytes more have come out."""
        self._unpacked += size
        self.foresee(what, 0)
        self._in_time(what)

    def foresee(self, what: str, size: int) -> None:
        """Refuse what says of itself that `size` bytes more will come out, if they are too many."""
        coming = self._unpacked + size
        if coming > self.limits.ratio_from and coming > self.limits.ratio * max(self._packed, 1):
            raise ArchiveError(bomb(what, packed=_in_mb(self._packed), unpacked=_in_mb(coming)))
        if coming > self.limits.unpacked:
            raise ArchiveError(
                too_large(what, say("unpacked it has more than {size}", size=_in_mb(coming)))
            )

    def hold(self, what: str, size: int) -> None:
        """`size` bytes more are kept in memory."""
        self._held += size
        if self._held > self.limits.held:
            most = _in_mb(self.limits.held)
            raise ArchiveError(
                too_large(what, say("its files have more than {size} together", size=most))
            )

    def _in_time(self, what: str) -> None:
        if time.thread_time() > self._until:
            reason = say(
                "reading it takes more than {seconds} seconds", seconds=f"{self.limits.seconds:g}"
            )
            raise ArchiveError(too_large(what, reason))


def _in_mb(size: int) -> str:
    return f"{size / MEGABYTE:.3g} MB" if size < 1000 * MEGABYTE else f"{size / 1e9:.3g} GB"
