"""Check your own package before you hand it in: the same as the command `check`."""

from __future__ import annotations

from . import lab_program

TYPE_CHECKING = False
if TYPE_CHECKING:
    from argparse import Namespace

    from .parsing import Parser, Result


def add_arguments(parser: Parser) -> None:
    """Declare the arguments of `ros2 grade`."""
    lab_program.add_arguments(parser)


def main(args: Namespace) -> Result:
    """Run `check` with these arguments and return its exit status, or that it is missing."""
    return lab_program.run("check", args.words)
