"""A call that only waits, where the program has to spin the node."""

from __future__ import annotations

import ast

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.example import NODE, SILENT, example
from grader.mistakes.fixes import lines
from grader.mistakes.kind import Family
from grader.mistakes.recognised import RecognisedMistake, Suspect
from grader.package.edit.tree import Replace
from grader.package.source.imported import imports
from grader.package.source.names import dotted, last_part

WAITS = ("pause", "wait", "run_forever", "sleep")


def _waits(suspect: Suspect) -> RecognisedMistake | None:
    """Look for the one statement below the new node that waits; nothing in the files spins."""
    source, function = suspect.source, suspect.function
    names = source.node_variables
    spins = any(
        last_part(dotted(n)).startswith("spin")
        for n in source.all_nodes
        if isinstance(n, ast.Attribute | ast.Name)
    )
    if function is None or spins or len(names) != 1:
        return None
    [node] = names
    made = [
        s.lineno
        for s in ast.walk(function)
        if isinstance(s, ast.Assign) and any(dotted(t) == node for t in s.targets)
    ]
    found = [
        s.value
        for s in _in_order(function)
        if isinstance(s, ast.Expr)
        and isinstance(s.value, ast.Call)
        and last_part(dotted(s.value.func)) in WAITS
        and made
        and s.lineno > made[0]
    ]
    if len(found) != 1:
        return None
    module = source.module_of(found[0])
    rclpy = next((bound for bound, full, _ in imports(module) if full == "rclpy"), "rclpy")
    code = module.text.code(found[0])
    if "\n" in code:
        return None
    return suspect.finding("waits_for_spin", found[0], name=code, written=f"{rclpy}.spin({node})")


def _in_order(function: ast.AST) -> list[ast.stmt]:
    """Return the statements of a function that run once: those of its try and with blocks too."""
    found = []
    for statement in getattr(function, "body", ()):
        found.append(statement)
        if isinstance(statement, ast.Try | ast.With):
            found += _in_order(statement)
    return found


_node = Family("node", links.EXECUTORS)
KINDS = (
    _node(
        "waits_for_spin",
        "spin",
        msg("The program waits, but nothing spins the node"),
        msg(
            "{name} waits, and calls none of the node's callbacks. rclpy.spin waits too, until Ctrl+C, "
            "and calls the callbacks when they are due."
        ),
        msg("Write {written} instead of {name}."),
        behind={"run.never_spins": _waits, "run.no_lines": _waits},
        fixed_by=(lines.written,),
        examples=(
            example(
                "pause_for_spin",
                Replace(
                    NODE, "import rclpy\nfrom", "from signal import pause\n\nimport rclpy\nfrom"
                ),
                Replace(NODE, "rclpy.spin(node)", "pause()"),
                fails="run.spins",
                blocks=("run.output", *SILENT),
            ),
        ),
    ),
)
