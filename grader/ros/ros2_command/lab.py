"""Take you through the lesson: the same as the command `lab`."""

from __future__ import annotations

from . import lab_program

TYPE_CHECKING = False
if TYPE_CHECKING:
    from argparse import Namespace

    from .parsing import Parser, Result


def add_arguments(parser: Parser) -> None:
    """Declare the arguments of `ros2 lab`."""
    lab_program.add_arguments(parser)


def main(args: Namespace) -> Result:
    """Run `lab` with these arguments and return its exit status, or the message that it is missing."""
    return lab_program.run("lab", args.words)
