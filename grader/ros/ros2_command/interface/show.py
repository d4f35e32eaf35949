"""Output the interface definition."""

import sys
from argparse import Namespace

from ..interface_text import lines
from ..parsing import Parser


def add_arguments(parser: Parser) -> None:
    """Declare the arguments of `ros2 interface show`."""
    parser.add_argument(
        "type", help="Interface to show (e.g. 'std_msgs/msg/String'); '-' reads it from stdin"
    )
    amount = parser.add_mutually_exclusive_group()
    amount.add_argument(
        "--all-comments", action="store_true", help="Show the comments of nested messages, too"
    )
    amount.add_argument("--no-comments", action="store_true", help="Show no comments")


def main(args: Namespace) -> None:
    """Print the definition; raises CommandError if there is no such interface."""
    name = sys.stdin.readline().strip() if args.type == "-" else args.type
    for line in lines(name, comments=not args.no_comments, nested_comments=args.all_comments):
        print(line)
