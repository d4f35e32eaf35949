"""Output a list of package specific executables."""

from argparse import Namespace
from pathlib import PurePath

from ..ament_index import package_executables, package_names
from ..parsing import Parser


def add_arguments(parser: Parser) -> None:
    """Declare the arguments of `ros2 pkg executables`."""
    parser.add_argument("package_name", nargs="?", help="The package name")
    parser.add_argument(
        "--full-path",
        action="store_true",
        default=False,
        help="Show full path of each executable",
    )


def main(args: Namespace) -> str | None:
    """Print the executables of one or all packages; return the message for an unknown package.

    Raises OSError if no ROS environment was sourced.
    """
    names = package_names() if args.package_name is None else [args.package_name]
    for name in names:
        paths = package_executables(name)
        if paths is None:
            return f"Package '{name}' not found"
        for path in sorted(paths):
            print(path if args.full_path else f"{name} {PurePath(path).name}")
    return None
