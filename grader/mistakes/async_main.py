"""An entry point that is an async function, which ros2 run calls like any other."""

from __future__ import annotations

import ast
from dataclasses import replace

from grader.base.i18n.message import joined, msg, say
from grader.mistakes import links
from grader.mistakes.example import NODE, example
from grader.mistakes.fixes import lines
from grader.mistakes.fixes.case import Case
from grader.mistakes.kind import Family
from grader.mistakes.recognised import RecognisedMistake, Suspect
from grader.package.edit.files import Files
from grader.package.edit.text import Splice
from grader.package.edit.tree import Replace
from grader.package.source.module import Module
from grader.package.source.names import dotted, last_part

IN_THREAD = {"to_thread": 0, "run_in_executor": 1}
"""Calls that run a function in a thread, and the place of the function in their arguments."""


def _is_async(suspect: Suspect) -> RecognisedMistake | None:
    function = suspect.function
    if not isinstance(function, ast.AsyncFunctionDef):
        return None
    found = suspect.finding("main_async", function, name=function.name)
    module = suspect.source.module_of(function)
    changes = [
        say(
            "line {line}: {new} instead of {code}", line=n.lineno, new=new, code=module.text.code(n)
        )
        for n, new in _changes(module, function)
        if "\n" not in module.text.code(n)
    ]
    if not changes:
        return found
    return replace(
        found, words={**found.words, "others": joined(*changes, by=", ")}, variant="awaits"
    )


def _changes(module: Module, function: ast.AsyncFunctionDef) -> list[tuple[ast.expr, str]]:
    """Return what works only with async, by line: each `await` of the function, and asyncio.run."""
    changes: list[tuple[ast.expr, str]] = [
        (node, _called_directly(module, node.value))
        for node in ast.walk(function)
        if isinstance(node, ast.Await)
    ]
    for node in module.nodes:
        if not isinstance(node, ast.Call) or dotted(node.func) not in ("asyncio.run", "run"):
            continue
        call = node.args[0] if len(node.args) == 1 else None
        if isinstance(call, ast.Call) and dotted(call.func) == function.name:
            changes.append((node, module.text.code(call)))
    return sorted(changes, key=lambda change: change[0].lineno)


def _called_directly(module: Module, waited: ast.expr) -> str:
    """Return the code of what an `await` waits for, called without a thread."""
    code = module.text.code
    at = IN_THREAD.get(last_part(dotted(waited.func))) if isinstance(waited, ast.Call) else None
    if not isinstance(waited, ast.Call) or at is None or len(waited.args) <= at:
        return code(waited)
    given: list[ast.expr | ast.keyword] = [*waited.args[at + 1 :], *waited.keywords]
    return f"{code(waited.args[at])}({', '.join(code(value) for value in given)})"


def _plain(case: Case) -> Files | None:
    """Write the function without async, await and asyncio.run."""
    node = case.node
    main = node.main if node is not None else None
    if node is None or not isinstance(main, ast.AsyncFunctionDef):
        return None
    module, text = node.module_of(main), node.module_of(main).text
    start = text.span(main)[0]
    changes = _changes(module, main)
    loops = any(isinstance(n, ast.AsyncFor | ast.AsyncWith) for n in ast.walk(main))
    if loops or not text.text.startswith("async def ", start):
        return None
    sleeps = any("asyncio." in new for _, new in changes)
    head = Splice(start, start + len("async "), "")
    made = case.changed(module, head, *(text.swap(n, new) for n, new in changes))
    if made is None or sleeps:
        return None
    return lines.without_import(replace(case, files=made), "asyncio")


_node = Family("node", links.PYTHON_ERRORS)
KINDS = (
    _node(
        "main_async",
        "spin",
        msg("The function of the entry point is async, so calling it runs none of its lines"),
        msg(
            "Calling an async function only makes a coroutine. ros2 run calls {name} like any "
            "other function, and nothing runs the coroutine."
        ),
        msg("Delete async in this line: def {name}(…)."),
        fixes={
            "awaits": msg(
                "Delete async in this line: def {name}(…). A function without async has no await and "
                "needs no asyncio. Write in {others}."
            )
        },
        behind={"run.exits_at_once": _is_async},
        fixed_by=(_plain,),
        examples=(
            example(
                "main_async",
                Replace(NODE, "def main(args=None)", "async def main(args=None)"),
                fails="run.starts",
            ),
            example(
                "main_waits_for_spin_in_a_thread",
                Replace(NODE, "import rclpy\nfrom", "import asyncio\n\nimport rclpy\nfrom"),
                Replace(NODE, "def main(args=None)", "async def main(args=None)"),
                Replace(NODE, "rclpy.spin(node)", "await asyncio.to_thread(rclpy.spin, node)"),
                Replace(NODE, "\n    main()\n", "\n    asyncio.run(main())\n"),
                fails="run.starts",
            ),
        ),
    ),
)
