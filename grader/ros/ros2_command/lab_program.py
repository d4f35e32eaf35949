"""Starts a program of the teaching lab from `ros2`."""

from __future__ import annotations

import os
import shutil
from argparse import REMAINDER, ArgumentParser

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Sequence

    from .parsing import Result


PROGRAMS = "LAB_PROGRAMS"  # the folder of the lab's programs, set in its terminals


def add_arguments(parser: ArgumentParser) -> None:
    """Declare the words that the program gets, options and -h included."""
    parser.prefix_chars = "\0"  # no word begins with it
    parser.add_argument("words", nargs=REMAINDER, help="Arguments of the lab's own command")


def run(program: str, words: Sequence[str]) -> Result:
    """Replace this process by a program of the lab; return a message outside of a lab.

    Only the lab has these programs, so a terminal outside of it is told how to open one.
    """
    folder = os.environ.get(PROGRAMS)
    found = shutil.which(program, path=folder) if folder else None
    if found is not None:
        os.execv(found, [program, *words])  # noqa: S606 - the lab's own program
    return f"'{program}' is a command of the teaching lab: open a lab with `make lab` first"
