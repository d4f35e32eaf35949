"""Output a list of available packages."""

from argparse import Namespace

from ..ament_index import package_names
from ..parsing import Parser


def add_arguments(_parser: Parser) -> None:
    """Declare nothing: `ros2 pkg list` takes no arguments."""


def main(_args: Namespace) -> None:
    """Print the names of all packages, sorted, one per line.

    Raises OSError if no ROS environment was sourced.
    """
    for name in package_names():
        print(name)
