"""The mistake of a spin that ends by itself after a time."""

from __future__ import annotations

from dataclasses import replace

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.example import NODE, SPIN_UNTIL_CTRL_C, STEP_LINE, example
from grader.mistakes.fixes.case import Case
from grader.mistakes.kind import Family
from grader.mistakes.recognised import RecognisedMistake, Suspect
from grader.package.edit.files import Files
from grader.package.edit.tree import Replace
from grader.package.source.time_limit import done_future, time_limit


def _limited(suspect: Suspect) -> RecognisedMistake | None:
    found = time_limit(suspect.source)
    if found is None:
        return None
    call, timeout, spin = found
    return suspect.finding("spin_has_timeout", call, timeout=timeout, written=spin)


def _done(suspect: Suspect) -> RecognisedMistake | None:
    """Look for the call that makes the future done until which the node is spun."""
    found = done_future(suspect.source)
    if found is None:
        return None
    call, done, spin = found
    module = suspect.source.module_of(done)
    name = module.text.code(done.func)
    found_at = suspect.finding("spin_until_done", call, name=name, written=spin)
    return replace(found_at, words={**found_at.words, "line": str(done.lineno)})


def _spun(case: Case) -> Files | None:
    """Spin without the timeout, or without the future."""
    node = case.node
    found = (time_limit(node) or done_future(node)) if node is not None else None
    if node is None or found is None:
        return None
    module = node.module_of(found[0])
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
    _node(
        "spin_until_done",
        "spin",
        msg("The line that spins the node ends when a future is done"),
        msg(
            "This line waits until its future is done, and then the program goes on below it. "
            "{name} in line {line} makes the future done. A node runs until Ctrl+C."
        ),
        msg("Write {written} instead: it waits until Ctrl+C."),
        behind={"run.ended_early": _done},
        fixed_by=(_spun,),
        examples=(
            example(
                "spins_until_the_first_callback",
                Replace(NODE, "import rclpy\n", "import rclpy\nfrom rclpy.task import Future\n"),
                Replace(
                    NODE, "self.counter_ = 0", "self.counter_ = 0\n        self.done_ = Future()"
                ),
                Replace(NODE, STEP_LINE, f"{STEP_LINE}        self.done_.set_result(True)\n"),
                Replace(
                    NODE,
                    "rclpy.spin(node)",
                    "rclpy.spin_until_future_complete(node, node.done_)",
                ),
                fails="run.output",
                blocks=("run.interrupt",),
            ),
        ),
    ),
)
