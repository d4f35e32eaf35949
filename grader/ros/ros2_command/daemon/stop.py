"""Stop the daemon if it is running."""

from argparse import Namespace

from ..parsing import Parser


def add_arguments(_parser: Parser) -> None:
    """Declare nothing: `ros2 daemon stop` takes no arguments."""


def main(_args: Namespace) -> None:
    """Print that there is no daemon."""
    print("The daemon is not running: this ros2 has none, each command looks at the graph itself")
