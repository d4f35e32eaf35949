"""Mistakes in what a callback does when: loops, conditions, and calls that end the node."""

from __future__ import annotations

import ast
import re
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.example import LOG_LINE, NODE, SILENT, SPIN_UNTIL_CTRL_C, STEP_LINE, example
from grader.mistakes.fixes import lines, node_try
from grader.mistakes.kind import Family
from grader.mistakes.recognised import RecognisedMistake, Suspect
from grader.package.edit.tree import Replace
from grader.package.source.names import SPINS, calls_in, dotted, last_part
from grader.package.source.node import NodeSource

LEVELS = ("set_level", "set_logger_level")


def _loops(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a loop of the callback that logs in each round."""
    source, callback = suspect.source, suspect.source.callback
    for loop in ast.walk(callback) if callback is not None else ():
        if not isinstance(loop, ast.For | ast.While) or not source.logs(loop):
            continue
        found = suspect.finding("loop_in_callback", loop, name=_word(loop))
        inside = {dotted(n) for log in source.logs(loop) for n in ast.walk(log)} - {""}
        if not isinstance(loop, ast.For) or dotted(loop.target) not in inside:
            return found
        if not isinstance(loop.target, ast.Name):
            return None
        rounds = loop.iter
        plain = isinstance(rounds, ast.Call) and dotted(rounds.func) == "range"
        if plain and all(isinstance(n, ast.Constant) for n in getattr(rounds, "args", ())):
            words = {**found.words, "number": dotted(loop.target)}
            return replace(found, variant="counts", words=words)
        return None  # (what is to be logged without the loop is not known)
    return None


def _word(loop: ast.For | ast.While) -> str:
    return "for" if isinstance(loop, ast.For) else "while"


def _level(suspect: Suspect) -> RecognisedMistake | None:
    for call, name in suspect.source.calls:
        given = ast.unparse(call.args[-1]) if last_part(name) in LEVELS and call.args else ""
        hides = re.search(r"\b(?:WARN|WARNING|ERROR|FATAL)\b", given)
        names = [n.value for n in ast.walk(call) if isinstance(n, ast.Constant)]
        if hides and set(names) <= {suspect.assignment.node_name}:  # (no other logger)
            return suspect.finding("level_set", call, name=last_part(name), level=hides[0])
    return None


def _swallowed(suspect: Suspect) -> RecognisedMistake | None:
    """Look for an except in a loop that catches Ctrl+C and lets the loop go on."""
    for handler in suspect.source.all_nodes:
        if not isinstance(handler, ast.ExceptHandler) or not _catches_interrupt(handler):
            continue
        around = list(suspect.source.module_of(handler).around(handler))
        loops = [part for part in around if isinstance(part, ast.While)]
        if not loops or _ends_loop(suspect.source, handler, loops[0]):
            continue
        found = suspect.finding(
            "interrupt_swallowed", suspect.place_at(handler), line=loops[0].lineno
        )
        last = handler.body[-1]
        if isinstance(last, ast.Continue):
            words = {**found.words, "last": last.lineno}
            variant = "bare_continue" if handler.type is None else "continue"
            return replace(found, words=words, variant=variant)
        return replace(found, variant="" if handler.type is None else "named")
    return None


def _ends_loop(source: NodeSource, handler: ast.ExceptHandler, loop: ast.While) -> bool:
    """Whether an except may end its loop, or its try is not what spins in the loop."""
    leaving = ast.Raise | ast.Return | ast.Break | ast.Assign
    if any(isinstance(n, leaving) for n in ast.walk(handler)):
        return True
    tried = source.module_of(handler).parents.get(handler)
    spins = [call for call, name in calls_in(loop) if last_part(name) in SPINS]
    return bool(spins) and tried is not None and not any(n in spins for n in ast.walk(tried))


def _catches_interrupt(handler: ast.ExceptHandler) -> bool:
    named = handler.type.elts if isinstance(handler.type, ast.Tuple) else [handler.type]
    return any(n is None or dotted(n) in ("KeyboardInterrupt", "BaseException") for n in named)


CONTINUES = msg(
    "Ctrl+C raises KeyboardInterrupt. This except catches it, and continue begins the loop again."
)
_node = Family("node", links.FIRST_NODE)
KINDS = (
    _node(
        "interrupt_swallowed",
        "shutdown",
        msg("An except in a loop catches Ctrl+C, and the loop goes on"),
        msg(
            "Ctrl+C raises KeyboardInterrupt. This except catches it, and the loop around it "
            "goes on."
        ),
        msg(
            "Write except KeyboardInterrupt: here, and break as the last line in it: break ends "
            "the loop that begins on line {line}."
        ),
        links.EXECUTORS,
        whys={"continue": CONTINUES, "bare_continue": CONTINUES},
        fixes={
            "continue": msg(
                "Write break instead of continue on line {last}: break ends the loop that begins on "
                "line {line}."
            ),
            "bare_continue": msg(
                "Write except KeyboardInterrupt: here, and break instead of continue on line {last}: "
                "break ends the loop that begins on line {line}."
            ),
            "named": msg(
                "Write break as the last line in this except: break ends the loop that begins on "
                "line {line}."
            ),
        },
        behind={"run.ignores_interrupt": _swallowed},
        fixed_by=(node_try.break_in_except,),
        examples=(
            example(
                "loop_goes_on_after_ctrl_c",
                Replace(
                    NODE,
                    SPIN_UNTIL_CTRL_C,
                    "    while True:\n"
                    "        try:\n"
                    "            rclpy.spin(node)\n"
                    "        except KeyboardInterrupt:\n"
                    "            continue\n",
                ),
                fails="run.interrupt",
            ),
            example(
                "loop_catches_everything",
                Replace(
                    NODE,
                    SPIN_UNTIL_CTRL_C,
                    "    while True:\n"
                    "        try:\n"
                    "            rclpy.spin_once(node)\n"
                    "        except:\n"
                    "            pass\n",
                ),
                fails="run.interrupt",
            ),
        ),
    ),
    _node(
        "loop_in_callback",
        "timer",
        msg("A loop in the callback logs several lines at once"),
        msg(
            "The timer calls the callback again and again. A loop in the callback does all its "
            "rounds in one call, at the same time."
        ),
        msg("Remove this {name}, and indent its lines as far as the {name} is indented now."),
        fixes={
            "counts": msg(
                "Remove this {name}, and indent its lines as far as the {name} is indented now. "
                "Without it there is no {number}: write {counter} = {start} in __init__, log "
                "{counter} instead of {number}, and write {counter} += {step} below the line that "
                "logs."
            ),
        },
        behind={"run.twice": _loops, "run.wrong_step": _loops},
        fixed_by=(lines.unwrapped,),
        examples=(
            example(
                "loop_logs_its_number",
                Replace(NODE, "        self.counter_ = 0\n", ""),
                Replace(
                    NODE,
                    LOG_LINE + STEP_LINE,
                    "        for i in range(10):\n"
                    "            self.get_logger().info('Hello time: ' + str(i))\n",
                ),
                fails="run.output",
            ),
            example(
                "loop_logs_ten",
                Replace(
                    NODE,
                    LOG_LINE + STEP_LINE,
                    f"        for i in range(10):\n    {LOG_LINE}    {STEP_LINE}",
                ),
                fails="run.output",
            ),
        ),
    ),
    _node(
        "level_set",
        "logger",
        msg("The logger is set to a level that hides the lines"),
        msg("After {name}, the logger shows only records of the level {level} and above."),
        msg("Remove the line with {name}."),
        links.LOGGING,
        behind={"run.no_lines": _level},
        fixed_by=(lines.deleted,),
        examples=(
            example(
                "level_set_to_warn",
                Replace(
                    NODE,
                    "self.counter_ = 0",
                    "self.counter_ = 0\n"
                    "        self.get_logger().set_level(rclpy.logging.LoggingSeverity.WARN)",
                ),
                fails="run.output",
                blocks=SILENT,
            ),
        ),
    ),
)
