"""The options of `ros2 interface` that select messages, services or actions."""

from argparse import Namespace

from ..interfaces import KINDS
from ..parsing import Parser

OPTIONS = {
    "msg": ("-m", "--only-msgs"),
    "srv": ("-s", "--only-srvs"),
    "action": ("-a", "--only-actions"),
}


def add_arguments(parser: Parser) -> None:
    """Declare the options."""
    for kind, names in OPTIONS.items():
        parser.add_argument(*names, action="store_true", help=f"Only {KINDS[kind]}s")


def selected(args: Namespace) -> list[str]:
    """Return the kinds that the options select: all without an option."""
    chosen = [
        kind
        for kind, (_, name) in OPTIONS.items()
        if getattr(args, name.removeprefix("--").replace("-", "_"))
    ]
    return chosen or list(KINDS)
