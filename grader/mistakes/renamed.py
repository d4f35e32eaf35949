"""The mistake of arguments in the code with which ROS gives the node another name."""

from __future__ import annotations

import ast

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.example import NODE, example
from grader.mistakes.fixes.case import Case
from grader.mistakes.kind import Family
from grader.mistakes.recognised import RecognisedMistake, Suspect
from grader.package.edit.files import Files
from grader.package.edit.tree import Replace
from grader.package.source.names import last_part
from grader.package.source.node import NodeSource

REMAPS = ("__node:=", "__name:=")
MOST_CODE = 80  # characters of a piece of code that a text shows


def _renames(source: NodeSource) -> tuple[ast.Call, str] | None:
    """Return the only call of init whose arguments rename nodes, and what to write instead."""
    found = [
        call
        for call, name in source.calls
        if last_part(name) == "init"
        and any(
            isinstance(part, ast.Constant) and str(part.value).startswith(REMAPS)
            for part in ast.walk(call)
        )
    ]
    if len(found) != 1:
        return None
    call = found[0]
    around = source.function_around(call)
    args = around is not None and "args" in [argument.arg for argument in around.args.args]
    function = source.module_of(call).text.code(call.func)
    return call, f"{function}(args=args)" if args else f"{function}()"


def _renamed(suspect: Suspect) -> RecognisedMistake | None:
    found = _renames(suspect.source)
    if found is None:
        return None
    call, written = found
    code = suspect.source.module_of(call).text.code(call)
    if "\n" in code or len(code) > MOST_CODE:
        return None
    return suspect.finding("renamed", call, name=code, written=written)


def _with_own_name(case: Case) -> Files | None:
    """Call init without the arguments that rename nodes."""
    found = _renames(case.node) if case.node is not None else None
    if case.node is None or found is None:
        return None
    module = case.node.module_of(found[0])
    return case.changed(module, module.text.swap(*found))


_node = Family("node", links.NODES)
KINDS = (
    _node(
        "renamed",
        "class",
        msg("An argument in the code gives the node another name"),
        msg(
            "__node:=… in the arguments of ROS replaces the name that is passed to "
            "super().__init__()."
        ),
        msg("Write {written} instead of {name}."),
        behind={"run.wrong_node_name": _renamed},
        fixed_by=(_with_own_name,),
        examples=(
            example(
                "remapped_in_init",
                Replace(
                    NODE,
                    "rclpy.init(args=args)",
                    "rclpy.init(args=['--ros-args', '-r', '__node:=hello_node'])",
                ),
                fails="run.node_name",
            ),
        ),
    ),
)
