"""Various topic related sub-commands."""

from __future__ import annotations

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ..parsing import Parser

VERBS = ("bw", "delay", "echo", "find", "hz", "info", "list", "pub", "type")


def add_arguments(parser: Parser) -> None:
    """Declare the option that may come before the verb."""
    parser.add_argument(
        "--include-hidden-topics", action="store_true", help="Consider hidden topics as well"
    )
