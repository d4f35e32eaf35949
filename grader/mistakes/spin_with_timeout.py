"""The mistake of a spin that ends by itself after a time."""

from __future__ import annotations

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.example import NODE, SPIN_UNTIL_CTRL_C, example
from grader.mistakes.fixes.case import Case
from grader.mistakes.kind import Family
from grader.mistakes.recognised import RecognisedMistake, Suspect
from grader.package.edit.files import Files
from grader.package.edit.tree import Replace
from grader.package.source.time_limit import time_limit


def _limited(suspect: Suspect) -> RecognisedMistake | None:
    found = time_limit(suspect.source)
    if found is None:
        return None
    call, timeout, spin = found
    return suspect.finding("spin_has_timeout", call, timeout=timeout, written=spin)


def _spun(case: Case) -> Files | None:
    """Spin without the timeout."""
    found = time_limit(case.node) if case.node is not None else None
    if case.node is None or found is None:
        return None
    module = case.node.module_of(found[0])
    return case.changed(module, module.text.swap(found[0], found[2]))


_node = Family("node", links.EXECUTORS)
KINDS = (
    _node(
        "spin_has_timeout",
        "spin",
        msg("The line that spins the node has a timeout"),
        msg(
            "{timeout} ends this line after that many seconds, whether the node is done or not, and "
            "the program goes on below it. A node runs until Ctrl+C."
        ),
        msg("Write {written} instead: it has no timeout."),
        behind={"run.ended_early": _limited},
        fixed_by=(_spun,),
        examples=(
            example(
                "spins_for_three_seconds",
                Replace(NODE, "import rclpy\n", "import rclpy\nfrom rclpy.task import Future\n"),
                Replace(
                    NODE,
                    SPIN_UNTIL_CTRL_C,
                    SPIN_UNTIL_CTRL_C.replace(
                        "rclpy.spin(node)",
                        "rclpy.spin_until_future_complete(node, Future(), timeout_sec=3.0)",
                    ),
                ),
                fails="run.output",
                blocks=("run.interrupt",),
            ),
        ),
    ),
)
