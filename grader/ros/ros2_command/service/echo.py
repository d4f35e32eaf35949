"""Echo a service."""

from argparse import REMAINDER, Namespace

from ..absent import INSTEAD
from ..parsing import Parser


def add_arguments(parser: Parser) -> None:
    """Take any arguments: this verb only says that it is not here."""
    parser.add_argument("arguments", nargs=REMAINDER, help="Not used")


def main(_args: Namespace) -> str:
    """Return the error message."""
    return f"ros2 service echo: prints the calls of a service that has introspection; {INSTEAD}"
