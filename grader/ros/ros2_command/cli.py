"""The `ros2` command line: find the command and the verb, parse their arguments, run them.

Only the modules that a command line names are imported, as in ros2cli (its
``add_subparsers_on_demand``), so that a node does not wait for code that it does not need.
"""

from __future__ import annotations

import os
import sys
from importlib import import_module

from . import absent
from .parsing import CommandError, Parser, add_commands, first_word, summary

TYPE_CHECKING = False
if TYPE_CHECKING:
    from argparse import Namespace
    from collections.abc import Sequence
    from types import ModuleType

    from .parsing import Result

COMMANDS = (
    "action",
    "daemon",
    "doctor",
    "grade",
    "interface",
    "lab",
    "lifecycle",
    "node",
    "param",
    "pkg",
    "run",
    "service",
    "topic",
    "wtf",
)
COMPLETE = "_complete"  # hidden: the words for a shell's completion


def program() -> None:
    """Run `ros2` as the process that this is, and end it.

    With rclpy Python needs 0.15 s to take itself down after the node is gone, which nobody sees:
    then the process ends at once.
    """
    result = main()
    if "rclpy" not in sys.modules:
        raise SystemExit(result)
    if isinstance(result, str):
        print(result, file=sys.stderr)
    status = 1 if isinstance(result, str) else int(result or 0)
    try:
        sys.stdout.flush()
        sys.stderr.flush()
    except OSError:  # the reader of a pipe has ended
        status = 1
    os._exit(status & 0xFF)


def main(argv: Sequence[str] | None = None) -> Result:
    """Run `ros2` with these arguments (default: the process's own); return the exit status.

    An int is the exit status, a text is an error message for stderr with status 1.

    Raises SystemExit with status 0 after `-h` and 2 after a usage error (argparse), and whatever
    the verbs raise, except CommandError (ros2cli does the same with RuntimeError).
    """
    arguments = list(sys.argv[1:] if argv is None else argv)
    command = first_word(arguments)
    if command in absent.COMMANDS and arguments[0] == command:
        return absent.command(command)
    if command == COMPLETE:
        return _run_hidden(arguments[1:])
    args = _parser(command, arguments).parse_args(arguments)
    if not args.use_python_default_buffering and hasattr(sys.stdout, "reconfigure"):
        sys.stdout.reconfigure(line_buffering=True)
    try:
        return _run(args)
    except CommandError as error:
        return str(error)
    except BrokenPipeError:  # the reader of a pipe has ended, as in `ros2 topic echo /a | head`
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 1
    except KeyboardInterrupt:
        import signal  # noqa: PLC0415 (most verbs do not need it)

        return signal.SIGINT


def _run_hidden(words: list[str]) -> Result:
    complete: ModuleType = _module("complete")
    result: Result = complete.main(words)
    return result


def _run(args: Namespace) -> Result:
    verb: ModuleType | None = args.verb
    if verb is None:
        args.parser.print_help()
        return 0
    result: Result = verb.main(args)
    return result


def _parser(command: str | None, arguments: list[str]) -> Parser:
    parser = Parser(prog="ros2", description="ros2 is an extensible command-line tool for ROS 2.")
    parser.add_argument(
        "--use-python-default-buffering",
        action="store_true",
        help="Do not force line buffering in stdout and instead use the python default buffering, "
        "which might be affected by PYTHONUNBUFFERED/-u and depends on whatever stdout is "
        "interactive or not",
    )
    parser.set_defaults(verb=None, parser=parser)
    listed = {} if command else {name: summary(_module(name)) for name in COMMANDS}
    subparsers = add_commands(parser, "ros2", listed)
    for name in sorted((*COMMANDS, *absent.COMMANDS)):
        selected = _module(name) if name == command and name in COMMANDS else None
        subparser = subparsers.add_parser(name, description=summary(selected) if selected else None)
        if selected:
            _fill(subparser, selected, command_line=f"ros2 {name}", arguments=arguments)
    return parser


def _fill(parser: Parser, module: ModuleType, *, command_line: str, arguments: list[str]) -> None:
    """Add the arguments of the selected command to its parser, and its verbs if it has any."""
    if hasattr(module, "add_arguments"):
        module.add_arguments(parser)
    verbs: tuple[str, ...] = getattr(module, "VERBS", ())
    if not verbs:
        parser.set_defaults(verb=module, parser=parser)
        return
    parser.set_defaults(verb=None, parser=parser)
    name = command_line.partition(" ")[2]
    verb = first_word(arguments[arguments.index(name) + 1 :])
    listed = {} if verb else {each: summary(_module(f"{name}.{each}")) for each in verbs}
    subparsers = add_commands(parser, command_line, listed)
    for each in verbs:
        selected = _module(f"{name}.{each}") if each == verb else None
        subparser = subparsers.add_parser(each, description=summary(selected) if selected else None)
        if selected:
            selected.add_arguments(subparser)
            subparser.set_defaults(verb=selected, parser=subparser)


def _module(name: str) -> ModuleType:
    return import_module(f".{name}", __package__)
