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
    if not calls or _waits(found[0]):
        return replace(mistake, words=words, variant="waits")
    return replace(mistake, words=words)


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
            "waits": msg(
                "Write def {name} without async, and call in it no function with await: delete what "
                "only waits, because the timer waits from one call to the next."
            )
        },
        behind=dict.fromkeys(
            ("run.no_lines", "run.constant_counter", "run.wrong_step"), _not_awaited
        ),
        fixed_by=(_plain,),
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
