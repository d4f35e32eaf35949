"""`ros2 lab` and `ros2 grade` as extensions of the real ros2cli (entry point group `ros2cli.command`).

In the lab's image `grader` is found as `ros2_teaching_lab_command`, see
lab/shell/ros2cli. Where the project is installed outside of a lab, `ros2 grade` marks a package.
"""

from __future__ import annotations

import os
from argparse import ArgumentParser, Namespace

from ros2cli.command import CommandExtension  # type: ignore[import-not-found]

from ..ros.ros2_command import lab_program

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ..ros.ros2_command.parsing import Result


class LabCommand(CommandExtension):  # type: ignore[misc]
    """Take you through the lesson: the same as the command `lab`."""

    def add_arguments(self, parser: ArgumentParser, _cli_name: str) -> None:
        """Declare the arguments of `ros2 lab`."""
        lab_program.add_arguments(parser)

    def main(self, *, parser: ArgumentParser, args: Namespace) -> Result:
        """Run `lab` with these arguments; return its exit status, or the message that it is missing."""
        del parser
        return lab_program.run("lab", args.words)


class GradeCommand(CommandExtension):  # type: ignore[misc]
    """Check a package: the lab's command `check`, or `grader grade` outside of a lab."""

    def add_arguments(self, parser: ArgumentParser, _cli_name: str) -> None:
        """Declare the arguments of `ros2 grade`."""
        lab_program.add_arguments(parser)

    def main(self, *, parser: ArgumentParser, args: Namespace) -> Result:
        """Run `check` or `grader grade` with these arguments; return the exit status."""
        del parser
        if os.environ.get("LAB_PROGRAMS"):
            return lab_program.run("check", args.words)
        from grader.cli.main import main  # noqa: PLC0415 - in the lab's image it is not found

        return main(["grade", *args.words])
