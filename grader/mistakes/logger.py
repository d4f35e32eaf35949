"""Mistakes in logging: how the logger is called, and lines that it does not show."""

from __future__ import annotations

import ast
import re
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.example import NODE, SILENT, example
from grader.mistakes.fixes import lines, node_log
from grader.mistakes.kind import INSTEAD, Family
from grader.mistakes.recognised import RecognisedMistake, Suspect
from grader.package.edit.tree import Replace
from grader.package.source.counter import targets_of
from grader.package.source.names import called_name, calls_in, last_part, own_name
from grader.package.source.node import NodeSource
from grader.package.source.place import block_of, statement_of
from grader.package.source.printed import as_log

LEVELS = ("set_level", "set_logger_level")


def _missing(suspect: Suspect) -> RecognisedMistake | None:
    """The callback logs nothing, and nothing that it may call does."""
    source, callback = suspect.source, suspect.source.callback
    if callback is None or callback not in source.methods.values():
        return None
    if any(getattr(node, "attr", "") == "get_logger" for node in ast.walk(callback)):
        return None
    at_start = (callback, source.methods.get("__init__"), source.main, None)
    for module in source.known_modules:
        logs = [*source.logs(module.tree), *source.prints(module.tree)]
        if any(source.function_around(call) not in at_start for call in logs):
            return None  # (it may be called from the callback, or log what another timer does)
    kept = {own_name(call.func) for call, _ in calls_in(callback)} & source.attributes
    replaced = (last_part(t) for n in source.all_nodes for t in targets_of(n))
    own = [*source.logs(callback), *source.prints(callback)]
    if own or kept - set(source.methods) or callback.name in replaced:
        return None
    return suspect.finding("log_missing", callback)


def _hidden_level(suspect: Suspect) -> RecognisedMistake | None:
    """The only line that the callback logs is one of debug, or a line hides all below a level."""
    source, callback = suspect.source, suspect.source.callback
    for call, name in source.calls:
        given = ast.unparse(call.args[-1]) if last_part(name) in LEVELS and call.args else ""
        names = {n.value for n in ast.walk(call) if isinstance(n, ast.Constant)}
        hides = re.search(r"\b(?:WARN|WARNING|ERROR|FATAL)\b", given)
        if hides and names <= {suspect.assignment.node_name}:  # (no other logger)
            return replace(
                suspect.finding("debug_level", call, name=last_part(name)), variant="set"
            )
    logs = source.logs(callback) if callback is not None else []
    if callback is None or len(logs) != 1 or called_name(logs[0]) != "debug":
        return None
    begins = suspect.output.text[:3].casefold() in ast.unparse(callback).casefold()
    return suspect.finding("debug_level", logs[0]) if begins else None


def _printed(suspect: Suspect) -> RecognisedMistake | None:
    """Look for the print(): that of the callback first, and what to write instead of it."""
    source, callback = suspect.source, suspect.source.callback
    prints = source.prints(callback) if callback is not None else []
    prints = prints or [call for call, name in source.calls if name == "print"]
    if not prints:
        return None
    call, around = prints[0], source.function_around(prints[0])
    if any(call in log.args for log in source.own_logs):
        return replace(suspect.finding("print_used", call), variant="inside")
    if _is_logged_too(source, call):
        return replace(suspect.finding("print_used", call), variant="beside")
    if around is not None and around not in source.own_methods:
        return replace(suspect.finding("print_used", call, name=around.name), variant="given")
    written = as_log(source, call) if not source.own_logs else None
    if written is None:
        return suspect.finding("print_used", call)
    code = source.module_of(call).text.code(call)
    found = suspect.finding("print_used", call, name=code, written=written)
    return replace(found, variant="written")


def _is_logged_too(source: NodeSource, call: ast.Call) -> bool:
    """Whether the logger logs the text of a print() as well, wherever the print() is reached."""
    module, given = source.module_of(call), list(map(ast.dump, call.args))
    around = set(module.around(call))
    logs = [log for log in source.own_logs if called_name(log) != "debug" and module.has(log)]
    same = [log for log in logs if list(map(ast.dump, log.args)) == given]
    return any(around & set(block_of(module, statement_of(module, log))) for log in same)


def _below_level(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a debug where a line of the log is missing."""
    debug = [call for call in suspect.source.own_logs if called_name(call) == "debug"]
    return suspect.finding("debug_level", debug[0]) if debug else None


_node = Family("node", links.LOGGING)
KINDS = (
    _node(
        "log_missing",
        "logger",
        msg("The callback logs nothing"),
        msg("The timer calls the callback, but no line of the callback logs anything."),
        msg("Write self.get_logger().info(…) in the callback."),
        behind={"run.no_lines": _missing},
        examples=(
            example(
                "log_line_forgotten",
                Replace(
                    NODE,
                    "        self.get_logger().info('Hello time: ' + str(self.counter_))\n",
                    "",
                ),
                fails="run.output",
                blocks=SILENT,
            ),
        ),
    ),
    _node(
        "debug_level",
        "logger",
        msg("The line is logged at a level that is not shown"),
        msg(
            "A logger neither shows nor publishes records below its level. By default that is INFO."
        ),
        msg("Write self.get_logger().info(…) instead of .debug(…)."),
        fixes={"set": msg("Remove the line with {name}.")},
        behind={"run.no_lines": _hidden_level, "log.missing": _below_level},
        fixed_by=(node_log.level,),
        examples=(
            example(
                "logged_as_debug",
                Replace(NODE, "self.get_logger().info", "self.get_logger().debug"),
                fails="run.output",
                blocks=SILENT,
                note="below the default level: neither on the terminal nor on /rosout",
            ),
        ),
    ),
    _node(
        "print_used",
        "logger",
        msg("print() is used instead of the logger"),
        msg(
            "print() only writes to this terminal: no level, no time, no node name, and no other "
            "program sees it on /rosout."
        ),
        msg("Write self.get_logger().info(…) instead of print(…)."),
        whys={
            "inside": msg(
                "print() writes the text to this terminal and returns None, so the logger gets None "
                "instead of the text."
            ),
        },
        fixes={
            "inside": msg("Remove print( and its ): give one text to the logger."),
            "beside": msg("Delete this print(…): the logger logs the same text."),
            "written": INSTEAD,
            "given": msg(
                "In {name}, self is not the node. Give it the node's logger as an argument, and write "
                "logger.info(…) there instead of print(…)."
            ),
        },
        behind={"run.print_not_logger": _printed},
        fixed_by=(lines.written,),
        examples=(
            example(
                "printed", Replace(NODE, "self.get_logger().info", "print"), fails="run.logger"
            ),
            example(
                "print_in_log",
                Replace(
                    NODE,
                    "'Hello time: ' + str(self.counter_)",
                    "print('Hello time: ' + str(self.counter_))",
                ),
                fails="run.logger",
            ),
        ),
    ),
)
