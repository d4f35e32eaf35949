"""Output a list of packages that provide interfaces."""

from argparse import Namespace

from ..interfaces import by_package
from ..parsing import Parser
from . import kinds


def add_arguments(parser: Parser) -> None:
    """Declare the arguments of `ros2 interface packages`."""
    kinds.add_arguments(parser)


def main(args: Namespace) -> None:
    """Print the names of the packages, sorted; raises OSError if no environment was sourced."""
    for name in by_package(kinds.selected(args)):
        print(name)
