"""Output an interface prototype."""

from argparse import Namespace

from ..interfaces import KINDS, load
from ..message_yaml import Style, to_yaml
from ..parsing import CommandError, Parser

# what a caller fills in of each kind
PART = {"msg": None, "srv": "Request", "action": "Goal"}


def add_arguments(parser: Parser) -> None:
    """Declare the arguments of `ros2 interface proto`."""
    parser.add_argument("type", help="Interface (e.g. 'std_msgs/msg/String')")
    parser.add_argument("--no-quotes", action="store_true", help="Do not print quotes around it")
    parser.add_argument("--flow-style", action="store_true", help="Print it in one line")


def main(args: Namespace) -> None:
    """Print the values of a new message, request or goal as YAML, to be filled in.

    Raises CommandError if there is no such interface.
    """
    text = prototype(args.type, flow=args.flow_style)
    print(text if args.no_quotes else f'"{text}"')


def prototype(identifier: str, *, flow: bool) -> str:
    """Return an interface's default values as YAML; raises CommandError if it does not exist."""
    kind = identifier.split("/")[1] if identifier.count("/") == 2 else ""
    if kind not in KINDS:
        raise CommandError(f"Invalid name '{identifier}'. Example of one: 'std_msgs/msg/String'")
    class_, part = load(identifier, kind), PART[kind]
    return to_yaml((getattr(class_, part) if part else class_)(), Style(flow=flow))
