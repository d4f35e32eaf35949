"""The mistake of an async function of the student's that is called without await."""

from __future__ import annotations

import ast
import re
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.example import LOG_LINE, NODE, SILENT, STEP_LINE, example
from grader.mistakes.fixes.case import Case
from grader.mistakes.kind import Family
from grader.mistakes.recognised import RecognisedMistake, Suspect
from grader.package.edit.files import Files
from grader.package.edit.text import Splice
from grader.package.edit.tree import Replace
from grader.package.source.names import called_name
from grader.package.source.place import function_at

NOT_AWAITED = re.compile(
    r"RuntimeWarning: coroutine '(?:[\w.<>]{1,200}\.)?(?P<name>\w{1,120})' was"
)
WAITS = (ast.Await, ast.AsyncFor, ast.AsyncWith)
ASYNC = "async "


def _not_awaited(suspect: Suspect) -> RecognisedMistake | None:
    """Python warned of a coroutine that nothing awaited, and the function is the student's."""
    match = NOT_AWAITED.search(suspect.transcript)
    found = [
        n
        for n in suspect.source.all_nodes
        if isinstance(n, ast.AsyncFunctionDef) and match and n.name == match["name"]
    ]
    if len(found) != 1:
        return None
    name = found[0].name
    calls = [c for c, _ in suspect.source.calls if called_name(c) == name]
    mistake = suspect.finding("never_awaited", found[0], name=name)
    words = {**mistake.words, "line": str(calls[0].lineno) if calls else ""}
    own = _awaited_functions(suspect.source.all_nodes, found[0]) if calls else None
    if own:
        words["others"] = ", ".join(sorted(function.name for function in own))
        return replace(mistake, words=words, variant="waits_own")
    if not calls or _waits(found[0]):
        return replace(mistake, words=words, variant="waits")
    return replace(mistake, words=words)


def _awaited_functions(
    nodes: list[ast.AST], function: ast.AsyncFunctionDef
) -> list[ast.AsyncFunctionDef] | None:
    """Return the student's functions that a function awaits, which await nothing themselves.

    None if it awaits something else too.
    """
    known = [n for n in nodes if isinstance(n, ast.AsyncFunctionDef)]
    found: list[ast.AsyncFunctionDef] = []
    for part in ast.walk(function):
        if isinstance(part, ast.AsyncFor | ast.AsyncWith):
            return None
        if isinstance(part, ast.Await):
            called = called_name(part.value) if isinstance(part.value, ast.Call) else ""
            named = [n for n in known if n.name == called and n is not function]
            if len(named) != 1 or _waits(named[0]):
                return None
            found += named
    return list(dict.fromkeys(found))


def _all_plain(case: Case) -> Files | None:
    """Delete async and await of a function and of those that it awaits, in one file."""
    module = case.module
    function = function_at(module, case.finding.line) if module is not None else None
    if module is None or not isinstance(function, ast.AsyncFunctionDef):
        return None
    own = _awaited_functions(module.nodes, function)
    if not own:
        return None
    names, text = {function.name, *(other.name for other in own)}, module.text
    splices = []
    for other in (function, *own):
        start = text.span(other)[0]
        if not text.text[start:].startswith(f"{ASYNC}def "):
            return None
        splices.append(Splice(start, start + len(ASYNC), ""))
    for node in module.nodes:
        value = node.value if isinstance(node, ast.Await) else None
        of_these = isinstance(value, ast.Call) and called_name(value) in names
        if isinstance(node, ast.Await) and value is not None and of_these:
            splices.append(Splice(text.span(node)[0], text.span(value)[0], ""))
    return case.changed(module, *splices)


def _waits(function: ast.AsyncFunctionDef) -> bool:
    return any(isinstance(n, WAITS) for n in ast.walk(function))


def _plain(case: Case) -> Files | None:
    """Delete the word async before the def, if nothing in the function or around it awaits."""
    module = case.module
    function = function_at(module, case.finding.line) if module is not None else None
    if module is None or not isinstance(function, ast.AsyncFunctionDef) or _waits(function):
        return None
    start = module.text.span(function)[0]
    awaited = [
        n
        for n in module.nodes
        if isinstance(n, ast.Await)
        and isinstance(n.value, ast.Call)
        and called_name(n.value) == function.name
    ]
    if awaited or not module.text.text[start:].startswith(f"{ASYNC}def "):
        return None
    return case.changed(module, Splice(start, start + len(ASYNC), ""))


_node = Family("node", links.EXECUTORS)
KINDS = (
    _node(
        "never_awaited",
        "callback",
        msg("An async function is called, and none of its lines run"),
        msg(
            "Calling an async function only makes a coroutine. Nothing awaits the coroutine of "
            "{name}, so none of the lines in {name} run. Python's warning in the output says so."
        ),
        msg("Write def {name} without async. Then the call runs its lines at once."),
        fixes={
            "waits_own": msg(
                "Write def without async for {name}, and also for what it awaits: {others}. Delete the "
                "word await before each of their calls."
            ),
            "waits": msg(
                "Write def {name} without async, and call in it no function with await: delete what "
                "only waits, because the timer waits from one call to the next."
            ),
        },
        behind=dict.fromkeys(
            ("run.no_lines", "run.constant_counter", "run.wrong_step"), _not_awaited
        ),
        fixed_by=(_plain, _all_plain),
        examples=(
            example(
                "async_helper_not_awaited",
                Replace(
                    NODE,
                    LOG_LINE + STEP_LINE,
                    "        self.say_hello()\n\n    async def say_hello(self):\n"
                    + LOG_LINE
                    + STEP_LINE,
                ),
                fails="run.output",
                blocks=SILENT,
            ),
            example(
                "async_helpers_that_await_each_other",
                Replace(
                    NODE,
                    LOG_LINE + STEP_LINE,
                    "        self.say_hello()\n\n    async def next(self):\n"
                    "        self.counter_ += 1\n        return self.counter_ - 1\n\n"
                    "    async def say_hello(self):\n        number = await self.next()\n"
                    "        self.get_logger().info(f'Hello time: {number}')\n",
                ),
                fails="run.output",
                blocks=SILENT,
            ),
            example(
                "async_helper_counts",
                Replace(
                    NODE,
                    STEP_LINE,
                    f"        self.count_on()\n\n    async def count_on(self):\n{STEP_LINE}",
                ),
                fails="run.output",
            ),
        ),
    ),
)
