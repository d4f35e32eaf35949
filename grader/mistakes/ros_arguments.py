"""Mistakes of programs that read their command line themselves."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.example import NODE, example
from grader.mistakes.fixes.case import Case
from grader.mistakes.kind import Family
from grader.mistakes.recognised import Raised, RecognisedMistake, Suspect
from grader.package.edit.files import Files
from grader.package.edit.tree import Replace
from grader.package.source.names import called_name, dotted, last_part
from grader.package.source.node import NodeSource

UNKNOWN = "error: unrecognized arguments: --ros-args"
REQUIRED = re.compile(r"error: the following arguments are required: (?P<name>\S{1,120})")


def _reads_all(source: NodeSource) -> tuple[ast.Call, str] | None:
    """Return the only call that reads the whole command line, and what to write instead."""
    found = [
        call
        for call, _ in source.calls
        if last_part(called_name(call)) == "parse_args" and not call.args and not call.keywords
    ]
    owner = dotted(found[0].func).rpartition(".")[0] if len(found) == 1 else ""
    return (found[0], f"{owner}.parse_known_args()[0]") if owner else None


def _refused(suspect: Suspect) -> RecognisedMistake | None:
    found = _reads_all(suspect.source)
    if found is None or UNKNOWN not in suspect.transcript:
        return None
    call, written = found
    code = suspect.source.module_of(call).text.code(call)
    return suspect.finding("arguments_refused", call, name=code, written=written)


def _needed(suspect: Suspect) -> RecognisedMistake | None:
    """The program ends because an argument is missing that argparse was told to require."""
    found = REQUIRED.search(suspect.transcript)
    if found is None:
        return None
    first = found["name"].rstrip(",").partition("/")[0]
    given = next((call for call in _arguments(suspect.source) if first in _names_of(call)), None)
    if given is None:
        return suspect.finding("arguments_needed", name=first)
    return suspect.finding("arguments_needed", given, name=first)


def _indexed(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The program reads an argument of sys.argv that nobody gave."""
    del match
    for node in raised.module.nodes:
        if (
            isinstance(node, ast.Subscript)
            and last_part(dotted(node.value)) == "argv"
            and node.lineno == raised.line
        ):
            found = raised.finding("arguments_needed", at=node, name=raised.module.text.code(node))
            return replace(found, variant="index")
    return None


def _arguments(source: NodeSource) -> Iterator[ast.Call]:
    return (call for call, _ in source.calls if called_name(call) == "add_argument")


def _names_of(call: ast.Call) -> set[str]:
    """Return the names by which argparse calls an argument in its messages."""
    named = {word.arg: word.value for word in call.keywords}
    values = [*call.args, *(named[word] for word in ("dest", "metavar") if word in named)]
    return {
        value.value
        for value in values
        if isinstance(value, ast.Constant) and isinstance(value.value, str)
    }


def _known_only(case: Case) -> Files | None:
    """Read only the known arguments."""
    found = _reads_all(case.node) if case.node is not None else None
    if case.node is None or found is None:
        return None
    module = case.node.module_of(found[0])
    return case.changed(module, module.text.swap(*found))


PARSER = (
    Replace(NODE, "import rclpy\nfrom", "import argparse\n\nimport rclpy\nfrom"),
    Replace(
        NODE,
        "    rclpy.init(args=args)\n",
        "    parser = argparse.ArgumentParser()\n"
        "    parser.add_argument('--start', type=int, required=True)\n"
        "    parser.parse_known_args()\n"
        "    rclpy.init(args=args)\n",
    ),
)
ARGV = (
    Replace(NODE, "import rclpy\nfrom", "import sys\n\nimport rclpy\nfrom"),
    Replace(NODE, "self.counter_ = 0", "self.counter_ = int(sys.argv[1])"),
)
_node = Family("node", links.FIRST_NODE)
KINDS = (
    _node(
        "arguments_needed",
        "start",
        msg("The program needs an argument that the command does not give"),
        msg(
            "ros2 run {package} {executable} starts the program without arguments. It requires {name}, so argparse prints "
            "its usage and ends the program."
        ),
        msg(
            "Make {name} optional: a name that begins with --, a default=… and no required=True. Or "
            "remove the argument."
        ),
        whys={
            "index": msg(
                "ros2 run {package} {executable} starts the program without arguments. sys.argv then holds only the path of "
                "the program, at index 0, so {name} does not exist."
            )
        },
        fixes={"index": msg("Write the value itself on that line, in place of {name}.")},
        seen=REQUIRED.pattern,
        raised={r"IndexError: list index out of range": _indexed},
        behind={"run.exits_at_once": _needed},
        examples=(
            example("argparse_requires_an_option", *PARSER, fails="run.starts"),
            example("argument_of_argv", *ARGV, fails="run.starts"),
        ),
    ),
    _node(
        "arguments_refused",
        "start",
        msg("The program ends at the arguments of ROS"),
        msg(
            "ROS starts a node with arguments of its own, such as --ros-args -p use_sim_time:=true; "
            "launch files do so too. {name} ends the program if there is an argument that it does "
            "not know."
        ),
        msg("Write {written} instead of {name}: it leaves the other arguments to rclpy."),
        seen=re.escape(UNKNOWN),
        behind={"run.exits_at_once": _refused},
        fixed_by=(_known_only,),
    ),
)
