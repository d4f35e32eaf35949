"""Various service related sub-commands."""

from __future__ import annotations

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ..parsing import Parser

VERBS = ("call", "echo", "find", "info", "list", "type")


def add_arguments(parser: Parser) -> None:
    """Declare the option that may come before the verb."""
    parser.add_argument(
        "--include-hidden-services", action="store_true", help="Consider hidden services as well"
    )
