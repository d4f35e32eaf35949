"""Parse command lines, with the error and help texts of the argparse of Python 3.12.

That is the Python of jazzy and kilted; the prefix may run on 3.10 to 3.13, whose argparse words
some texts differently.
"""

from __future__ import annotations

import sys
from argparse import (
    Action,
    ArgumentError,
    ArgumentParser,
    ArgumentTypeError,
    RawDescriptionHelpFormatter,
)

TYPE_CHECKING = False
if TYPE_CHECKING:  # typing is slow to import, and `ros2 run` must be quick
    from argparse import Namespace, _SubParsersAction
    from collections.abc import Callable, Iterable
    from typing import Any, Protocol, TypeVar

    Number = TypeVar("Number", int, float)

    Result = int | str | None  # what sys.exit takes; a text goes to stderr with status 1

    class Verb(Protocol):
        """A module that implements one command or verb; its docstring is its help."""

        __doc__: str | None

        def add_arguments(self, parser: Parser) -> None:
            """Declare the arguments."""

        def main(self, args: Namespace) -> Result:
            """Run it."""


class CommandError(RuntimeError):
    """A command cannot do what was asked; its text goes to stderr, with exit status 1."""


class _HelpFormatter(RawDescriptionHelpFormatter):
    def _format_action_invocation(self, action: Action) -> str:
        # 3.13 shows an option's value once, 3.12 after each form of the option
        if not action.option_strings or action.nargs == 0:
            return super()._format_action_invocation(action)
        value = self._format_args(action, self._get_default_metavar_for_optional(action))
        return ", ".join(f"{option} {value}" for option in action.option_strings)


class Parser(ArgumentParser):
    """An argument parser with the wording of Python 3.12."""

    def __init__(self, **options: Any) -> None:
        options.setdefault("formatter_class", _HelpFormatter)
        super().__init__(**options)

    def declared(self) -> list[Action]:
        """Return the arguments that were added, in their order."""
        return list(self._actions)

    def _check_value(self, action: Action, value: Any) -> None:
        # later releases omit the quotes
        if action.choices is not None and value not in action.choices:
            choices = ", ".join(map(repr, action.choices))
            raise ArgumentError(action, f"invalid choice: {value!r} (choose from {choices})")


def natural(text: str) -> int:
    """Return an option's value that is an integer of 0 or more; raises ArgumentTypeError."""
    return _number(text, int, least=0)


def positive(text: str) -> int:
    """Return an option's value that is an integer of 1 or more; raises ArgumentTypeError."""
    return _number(text, int, least=1)


def positive_float(text: str) -> float:
    """Return an option's value that is a number above 0; raises ArgumentTypeError."""
    return _number(text, float, least=sys.float_info.min)


def _number(text: str, convert: Callable[[str], Number], *, least: float) -> Number:
    try:
        value = convert(text)
    except ValueError:
        value = None
    if value is None or not least <= value < float("inf"):
        kind = "a number above 0" if convert is float else f"an integer of at least {least}"
        raise ArgumentTypeError(f"value must be {kind}, not {text!r}")
    return value


def summary(verb: Verb) -> str:
    """Return the description of a command: its docstring's first line without the dot."""
    return (verb.__doc__ or "").strip().partition("\n")[0].rstrip(".")


def first_word(arguments: Iterable[str]) -> str | None:
    """Return the first argument that is not an option: the name of the command or verb."""
    return next((argument for argument in arguments if not argument.startswith("-")), None)


def add_commands(
    parser: Parser, command_line: str, listed: dict[str, str]
) -> _SubParsersAction[Parser]:
    """Add sub-commands to a parser, and list them in its help as ros2cli does.

    `command_line` is the part before the sub-command (``ros2 pkg``), `listed` maps the sub-commands
    that the help shows to their one-line descriptions.
    """
    width = max(map(len, listed), default=0)
    return parser.add_subparsers(
        title="Commands",
        description="".join(f"{name.ljust(width)}  {text}\n" for name, text in listed.items()),
        metavar=f"Call `{command_line} <command> -h` for more detailed usage.",
        required=False,
        parser_class=Parser,
    )
