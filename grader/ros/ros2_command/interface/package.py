"""Output a list of available interface types within one package."""

from argparse import Namespace

from ..interfaces import names
from ..parsing import CommandError, Parser
from . import kinds


def add_arguments(parser: Parser) -> None:
    """Declare the arguments of `ros2 interface package`."""
    parser.add_argument("package_name", help="Name of the package (e.g. 'std_msgs')")
    kinds.add_arguments(parser)


def main(args: Namespace) -> None:
    """Print the package's interfaces; raises CommandError if there is no such package."""
    found = names(args.package_name, kinds.selected(args))
    if found is None:
        raise CommandError(f"Unknown package '{args.package_name}'")
    for name in found:
        print(name)
