"""Output the prefix path of a package."""

from argparse import Namespace

from ..ament_index import package_prefix, share_directory
from ..parsing import Parser


def add_arguments(parser: Parser) -> None:
    """Declare the arguments of `ros2 pkg prefix`."""
    parser.add_argument("package_name", help="The package name")
    parser.add_argument("--share", action="store_true", help="Show share directory for the package")


def main(args: Namespace) -> str | None:
    """Print the folder; return the message if the package is not found.

    Raises OSError if no ROS environment was sourced.
    """
    find = share_directory if args.share else package_prefix
    path = find(args.package_name)
    if path is None:
        return "Package not found"
    print(path)
    return None
