"""What hides an error, or ends a function before its lines have run."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.example import LOG_LINE, NODE, SILENT, STEP_LINE, example
from grader.mistakes.kind import Family
from grader.mistakes.recognised import RecognisedMistake, Suspect
from grader.package.edit.tree import Replace
from grader.package.source.module import Function
from grader.package.source.names import SPINS, calls_in, dotted, last_part
from grader.package.source.node import NodeSource

ENDS = ("KeyboardInterrupt", "ExternalShutdownException", "SystemExit")
"""Exceptions that end a node as it should end."""
LEAVES = ast.Break | ast.Return | ast.Raise | ast.Call
LOG_OF_NUMBER = "            self.get_logger().info('Hello time: ' + self.counter_)\n"


def _functions(source: NodeSource) -> Iterator[Function]:
    """Yield the functions that run in every run of the node: callback, constructor, main.

    The functions that the callback calls by a name that only they have come last.
    """
    for function in (source.callback, source.methods.get("__init__"), source.main):
        if function is not None:
            yield function
    called = [last_part(name) for _, name in calls_in(source.callback)] if source.callback else []
    functions = [n for n in source.all_nodes if isinstance(n, Function)]
    for name in dict.fromkeys(called):
        named = [function for function in functions if function.name == name]
        if len(named) == 1 and not name.startswith("__"):
            yield named[0]


def hides(handler: ast.ExceptHandler) -> bool:
    """Whether a handler neither raises nor shows the exception that it catches."""
    caught = handler.type.elts if isinstance(handler.type, ast.Tuple) else [handler.type]
    if handler.type is not None and all(last_part(dotted(c)) in ENDS for c in caught if c):
        return False
    silent = {
        part
        for statement in handler.body
        for call, name in calls_in(statement)
        if last_part(name) == "debug"
        for part in ast.walk(call)
    }
    for node in (part for statement in handler.body for part in ast.walk(statement)):
        if node in silent or (isinstance(node, ast.Attribute) and dotted(node) == "sys.exit"):
            silent |= set(ast.walk(node))
            continue  # (such a line is not shown, and an end shows nothing)
        if isinstance(node, ast.Raise):
            return False
        if isinstance(node, ast.Name) and node.id in (handler.name, "traceback", "sys"):
            return False
    return True


def _swallows(suspect: Suspect) -> RecognisedMistake | None:
    for function in _functions(suspect.source):
        for node in ast.walk(function):
            if not isinstance(node, ast.Try) or _all_harmless(node.body):
                continue
            for handler in filter(hides, node.handlers):
                return suspect.finding("error_hidden", suspect.place_at(handler))
    return None


def _keeps_ctrl_c(suspect: Suspect) -> RecognisedMistake | None:
    """An except around what spins catches Ctrl+C, and the loop around it begins again."""
    source = suspect.source
    for tried in (node for node in source.all_nodes if isinstance(node, ast.Try)):
        calls = [last_part(name) for part in tried.body for _, name in calls_in(part)]
        loops = [
            n for n in source.module_of(tried).around(tried) if isinstance(n, ast.While | ast.For)
        ]
        if not loops or not set(calls) & set(SPINS):
            continue
        for handler in filter(_goes_on, tried.handlers):
            return replace(
                suspect.finding("error_hidden", suspect.place_at(handler)), variant="ctrl_c"
            )
    return None


def _goes_on(handler: ast.ExceptHandler) -> bool:
    """Whether a handler catches Ctrl+C and ends neither a loop nor a function."""
    caught = ast.unparse(handler.type) if handler.type is not None else "BaseException"
    leaves = any(isinstance(n, LEAVES) for part in handler.body for n in ast.walk(part))
    return not leaves and ("KeyboardInterrupt" in caught or "BaseException" in caught)


def _all_harmless(body: list[ast.stmt]) -> bool:
    return all(isinstance(s, ast.Pass | ast.Import | ast.ImportFrom) for s in body)


_node = Family("node", links.PYTHON_ERRORS)
KINDS = (
    _node(
        "error_hidden",
        "callback",
        msg("An except hides the error"),
        msg(
            "This except catches the error and does not show it: the try stops at the line with "
            "the error, and no traceback says why."
        ),
        msg(
            "Remove this except (and its try), or let it catch only KeyboardInterrupt. Run the node "
            "again: now the traceback shows the line with the error."
        ),
        whys={
            "ctrl_c": msg(
                "Ctrl+C raises KeyboardInterrupt in the line that spins. This except catches it, and the loop "
                "around it begins again."
            ),
        },
        fixes={
            "ctrl_c": msg(
                "Leave the loop here: write except KeyboardInterrupt: and, indented below it, break."
            ),
        },
        behind={
            "run.ignores_interrupt": _keeps_ctrl_c,
            "run.no_lines": _swallows,
            "run.constant_counter": _swallows,
            "run.stops": _swallows,
            "run.exits_at_once": _swallows,
            "run.ended_early": _swallows,
            "run.no_node": _swallows,
        },
        examples=(
            example(
                "error_hidden_in_callback",
                Replace(
                    NODE,
                    LOG_LINE + STEP_LINE,
                    (
                        "        try:\n"
                        f"{LOG_OF_NUMBER}"
                        "            self.counter_ += 1\n"
                        "        except:\n"
                        "            pass\n"
                    ),
                ),
                fails="run.output",
                blocks=SILENT,
            ),
            example(
                "error_hidden_in_main",
                Replace(NODE, "        self.counter_ = 0\n", ""),
                Replace(NODE, "except KeyboardInterrupt:", "except Exception:"),
                fails="run.output",
                blocks=("run.interrupt", *SILENT),
            ),
        ),
    ),
)
