"""Start the daemon if it is not running."""

from argparse import Namespace

from ..parsing import Parser


def add_arguments(_parser: Parser) -> None:
    """Declare nothing: `ros2 daemon start` takes no arguments."""


def main(_args: Namespace) -> None:
    """Print that there is no daemon."""
    print("There is no daemon to start, each command looks at the graph itself")
