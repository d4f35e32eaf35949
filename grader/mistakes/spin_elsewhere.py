"""The mistake of giving spin to a pool of threads, while main goes on to its clean-up."""

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
from grader.package.source.module import Module
from grader.package.source.names import called_name, dotted, last_part
from grader.package.source.node import NodeSource

SUBMITS = ("submit", "apply_async", "run_in_executor")


def _spins(source: NodeSource) -> tuple[ast.Call, str] | None:
    """Return the only call that is given spin itself, and the call of spin to write instead.

    As in `pool.submit(rclpy.spin, node)`.
    """
    found = [(call, spin) for call, _ in source.calls if (spin := _given(source, call))]
    return found[0] if len(found) == 1 else None


def _given(source: NodeSource, call: ast.Call) -> str:
    at = next((n for n, arg in enumerate(call.args) if last_part(dotted(arg)) == "spin"), -1)
    awaited = isinstance(source.module_of(call).parents.get(call), ast.Await)
    if last_part(called_name(call)) not in SUBMITS or at < 0 or awaited:
        return ""
    text = source.module_of(call).text
    arguments = [text.code(argument) for argument in call.args[at + 1 :]]
    return f"{dotted(call.args[at])}({', '.join(arguments)})"


def _elsewhere(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a program that ends because nothing waits for what spins the node."""
    spins = _spins(suspect.source)
    waits = {last_part(name) for _, name in suspect.source.calls} & {"join", "result", "wait"}
    if spins is None or waits:
        return None
    call, written = spins
    code = suspect.source.module_of(call).text.code(call)
    return suspect.finding("spin_elsewhere", call, name=" ".join(code.split()), written=written)


def _spun_here(case: Case) -> Files | None:
    """Spin in the place of a call that is a line of its own."""
    spins = _spins(case.node) if case.node is not None else None
    if case.node is None or spins is None:
        return None
    call, written = spins
    module: Module = case.node.module_of(call)
    if not isinstance(module.parents.get(call), ast.Expr):
        return None
    return case.changed(module, module.text.swap(call, written))


_node = Family("node", links.EXECUTORS)
KINDS = (
    _node(
        "spin_elsewhere",
        "spin",
        msg("The node spins in another thread, and nothing waits for it"),
        msg(
            "{name} returns at once, and the node spins in another thread. {function} goes on with its next lines, "
            "and when it ends, the node ends."
        ),
        msg("Write {written} instead of {name}: this line then waits until Ctrl+C."),
        behind={"run.exits_at_once": _elsewhere},
        fixed_by=(_spun_here,),
        examples=(
            example(
                "spin_submitted",
                Replace(
                    NODE,
                    "import rclpy\nfrom",
                    "from concurrent.futures import ThreadPoolExecutor\n\nimport rclpy\nfrom",
                ),
                Replace(NODE, "    try:\n", "    pool = ThreadPoolExecutor()\n    try:\n"),
                Replace(NODE, "        rclpy.spin(node)", "        pool.submit(rclpy.spin, node)"),
                fails="run.starts",
            ),
        ),
    ),
)
