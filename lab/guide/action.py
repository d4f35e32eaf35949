"""What a student does next in a step."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Action:
    """The next action of a step that is not done.

    `next` says what to do. `found` says what is there but wrong, and where; "" if nothing is wrong
    and something is only missing. `hints` say more and more, and end with the line to write.
    `where` says where to do it, if that is neither a command's folder nor `place`: a file of the
    package, with the line behind a colon. `difference` has what is there and what is expected, with marks below where they differ.
    `id` stays equal as long as the student has the same task, so that hints can be counted.
    """

    next: str
    id: str
    found: str = ""
    hints: tuple[str, ...] = ()
    difference: str = ""
    place: str = ""
    where: str = ""

    @property
    def file(self) -> str:
        """The file of `place`, "" if there is none."""
        file, _, line = self.place.rpartition(":")
        return file if line.isdecimal() else self.place

    @property
    def line(self) -> int:
        """The line of `place`, 0 if it names none."""
        line = self.place.rpartition(":")[2]
        return int(line) if line.isdecimal() and ":" in self.place else 0
