"""A condition asks what rclpy.init() gives back, which is always None."""

from __future__ import annotations

import ast
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.example import NODE, example
from grader.mistakes.fixes.case import Case
from grader.mistakes.fixes.lines import own_lines
from grader.mistakes.kind import Family
from grader.mistakes.recognised import RecognisedMistake, Suspect
from grader.package.edit.files import Files
from grader.package.edit.tree import Replace
from grader.package.source.imported import imports
from grader.package.source.module import Module
from grader.package.source.names import dotted


def _call_in(test: ast.expr, module: Module) -> ast.Call | None:
    """Return the call of rclpy.init that a test consists of, also behind not or beside a value."""
    inner = test.operand if isinstance(test, ast.UnaryOp) else test
    inner = inner.left if isinstance(inner, ast.Compare) else inner
    names = {f"{bound}.init" for bound, full, _ in imports(module) if full == "rclpy"}
    found = isinstance(inner, ast.Call) and dotted(inner.func) in (names or {"rclpy.init"})
    return inner if found and isinstance(inner, ast.Call) else None


def _leaves(block: ast.If) -> bool:
    """Whether the block of an if ends the function."""
    return isinstance(block.body[-1], ast.Return | ast.Raise) and not block.orelse


def _is_met(test: ast.expr) -> bool | None:
    """Whether a test of None is met: init() gives None back; None if this is not known."""
    if isinstance(test, ast.Call):
        return False
    if isinstance(test, ast.UnaryOp):
        return True if isinstance(test.op, ast.Not) and _is_met(test.operand) is False else None
    if not isinstance(test, ast.Compare) or len(test.ops) != 1:
        return None
    other = test.comparators[0]
    if not isinstance(other, ast.Constant) or not isinstance(test.left, ast.Call):
        return None
    same, op = other.value is None, test.ops[0]
    if isinstance(op, ast.Is | ast.Eq):
        return same
    return not same if isinstance(op, ast.IsNot | ast.NotEq) else None


def _tested(suspect: Suspect) -> RecognisedMistake | None:
    """Look for an if with rclpy.init() in its condition."""
    for node in suspect.source.all_nodes:
        if not isinstance(node, ast.If):
            continue
        module = suspect.source.module_of(node)
        call = _call_in(node.test, module)
        code = module.text.code(call) if call is not None else ""
        if call is None or "\n" in code or node.orelse or _is_met(node.test) is not _leaves(node):
            continue
        params = {"name": module.text.code(node.test), "written": code}
        found = suspect.finding("init_tested", node, **params)
        last = str(node.end_lineno or node.lineno)
        found = replace(found, words={**found.words, "line": str(node.lineno), "last": last})
        return found if _leaves(node) else replace(found, variant="runs")
    return None


def _alone(case: Case) -> Files | None:
    """Write the call in place of an if that leaves the function."""
    module = case.module
    found = [
        n
        for n in (module.nodes if module is not None else ())
        if isinstance(n, ast.If) and n.lineno == case.finding.line and _leaves(n)
    ]
    if module is None or len(found) != 1 or own_lines(module, found[0]) is None:
        return None
    call = _call_in(found[0].test, module)
    if call is None:
        return None
    return case.changed(module, module.text.swap(found[0], module.text.code(call)))


_node = Family("node", links.RCLPY)
KINDS = (
    _node(
        "init_tested",
        "start",
        msg("A condition asks what rclpy.init() gives back"),
        msg(
            "What rclpy.init() gives back does not tell whether it worked: an error of it is an "
            "exception. So the condition {name} says nothing about it."
        ),
        msg("Write only {written} in place of the if (lines {line} to {last})."),
        fixes={
            "runs": msg(
                "Write {written} on a line of its own above the if. Then delete the line of the if, and "
                "indent its block less, so that these lines always run."
            )
        },
        behind=dict.fromkeys(
            ("run.exits_at_once", "run.no_node", "run.died_at_start", "run.never_spins"), _tested
        ),
        fixed_by=(_alone,),
        examples=(
            example(
                "init_asked_for_success",
                Replace(
                    NODE,
                    "    rclpy.init(args=args)\n",
                    "    if not rclpy.init(args=args):\n        return 1\n",
                ),
                fails="run.starts",
                right_from="kilted",
                note="rclpy.init() gives back an object from kilted on, which counts as true",
            ),
        ),
    ),
)
