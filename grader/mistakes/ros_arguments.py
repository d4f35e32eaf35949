"""The mistake of a program that ends at the arguments that ROS gives to a node."""

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
from grader.package.source.names import called_name, dotted, last_part
from grader.package.source.node import NodeSource


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
    if found is None:
        return None
    call, written = found
    code = suspect.source.module_of(call).text.code(call)
    return suspect.finding("arguments_refused", call, name=code, written=written)


def _known_only(case: Case) -> Files | None:
    """Read only the known arguments."""
    found = _reads_all(case.node) if case.node is not None else None
    if case.node is None or found is None:
        return None
    module = case.node.module_of(found[0])
    return case.changed(module, module.text.swap(*found))


_node = Family("node", links.FIRST_NODE)
KINDS = (
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
        behind={"run.exits_at_once": _refused},
        fixed_by=(_known_only,),
        examples=(
            example(
                "argparse_reads_all",
                Replace(NODE, "import rclpy\nfrom", "import argparse\n\nimport rclpy\nfrom"),
                Replace(
                    NODE,
                    "    rclpy.init(args=args)\n",
                    "    parser = argparse.ArgumentParser()\n"
                    "    parser.add_argument('--start', type=int, default=0)\n"
                    "    parser.parse_args()\n"
                    "    rclpy.init(args=args)\n",
                ),
                fails="run.starts",
            ),
        ),
    ),
)
