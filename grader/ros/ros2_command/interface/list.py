"""List all interface types available."""

from argparse import Namespace

from ..interfaces import KINDS, by_package
from ..parsing import Parser
from . import kinds


def add_arguments(parser: Parser) -> None:
    """Declare the arguments of `ros2 interface list`."""
    kinds.add_arguments(parser)


def main(args: Namespace) -> None:
    """Print the interfaces of all packages, below a title for each kind.

    Raises OSError if no ROS environment was sourced.
    """
    for kind in kinds.selected(args):
        print(f"{KINDS[kind].title()}s:")
        for names in by_package([kind]).values():
            print("".join(f"    {name}\n" for name in names), end="")
