"""Mistakes in what a function returns that must return nothing: __init__, and that of the program."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.base.shown import shown
from grader.mistakes import links
from grader.mistakes.example import NODE, example
from grader.mistakes.fixes.case import Case
from grader.mistakes.fixes.lines import deleted
from grader.mistakes.kind import Family
from grader.mistakes.recognised import Raised, RecognisedMistake, Suspect
from grader.package.edit.files import Files
from grader.package.edit.tree import Replace
from grader.package.source.module import Function, Module
from grader.package.source.names import dotted, last_part
from grader.package.source.place import block_of, statement_at

NOT_NONE = r"TypeError: __init__\(\) should return None, not '(?P<type>\w{1,120})'"
EXITS = ("sys.exit", "exit", "quit", "SystemExit")
INNER = (ast.FunctionDef, ast.AsyncFunctionDef, ast.Lambda, ast.ClassDef)
STOP = "        node.destroy_node()\n        rclpy.try_shutdown()\n"


def parts_of(function: Function) -> Iterator[ast.AST]:
    """Yield all parts of a function, without those of the functions and classes inside it."""
    left: list[ast.AST] = list(function.body)
    while left:
        part = left.pop(0)
        yield part
        if not isinstance(part, INNER):
            left = [*ast.iter_child_nodes(part), *left]


def _of_init(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The __init__ of a class that the line makes an object of returns a value, or has a yield."""
    statement = statement_at(raised.module, raised.line)
    called = {
        last_part(dotted(n.func))
        for n in (ast.walk(statement) if statement is not None else ())
        if isinstance(n, ast.Call)
    }
    classes = [c for module in raised.source.modules for c in module.classes if c.name in called]
    found = [p for init in map(_init_of, classes) if init for p in _not_none(init, match["type"])]
    if not found:
        return None
    mistake = raised.finding("init_returns", at=found[0], name="", written="")
    module = raised.source.module_of(found[0])
    others = ", ".join(str(part.lineno) for part in found[1:])
    if isinstance(found[0], ast.Yield | ast.YieldFrom):
        code = shown(module.text.code(found[0]))
        words = {**mistake.words, "name": code, "lines": others}
        return replace(mistake, params={}, words=words, variant="yields" if others else "yield")
    return _return_of(mistake, module, found[0], others)


def _return_of(
    mistake: RecognisedMistake, module: Module, part: ast.Return, others: str
) -> RecognisedMistake:
    code, value = module.text.code(part), part.value
    calls = value is not None and any(isinstance(n, ast.Call) for n in ast.walk(value))
    written = module.text.code(value) if calls and value is not None else "return"
    function = next((n for n in module.around(part) if isinstance(n, Function)), None)
    last = function is not None and function.body[-1] is part and len(function.body) > 1
    variant = "called" if calls else "last" if last else ""
    variant = f"{variant or 'plain'}_several" if others else variant
    params = {"name": shown(code), "written": shown(written)}
    words = {**mistake.words, **params, "lines": others}
    return replace(mistake, params=params, words=words, variant=variant)


def _init_of(found: ast.ClassDef) -> Function | None:
    inits = [s for s in found.body if isinstance(s, Function) and s.name == "__init__"]
    return inits[-1] if inits else None


def _not_none(init: Function, kind: str) -> list[ast.Return | ast.Yield | ast.YieldFrom]:
    """Return what makes the call of an __init__ give something else than None."""
    parts = list(parts_of(init))
    yields = [p for p in parts if isinstance(p, ast.Yield | ast.YieldFrom)]
    if yields:
        return [*yields] if kind == "generator" else []
    return [p for p in parts if isinstance(p, ast.Return) and not _is_none(p.value)]


def _is_none(value: ast.expr | None) -> bool:
    """Whether a return gives None: it has no value, or calls the __init__ of the base."""
    none = isinstance(value, ast.Constant) and value.value is None
    return value is None or none or dotted(value).endswith("__init__()")


def _without_value(case: Case) -> Files | None:
    """Delete the return, or what it returns."""
    module, line = case.module, case.finding.line
    written = str(case.finding.params.get("written", ""))
    found = (
        [n for n in module.nodes if isinstance(n, ast.Return) and n.lineno == line]
        if module
        else []
    )
    if module is None or len(found) != 1 or not written:
        return None
    if written == "return" and block_of(module, found[0])[-1] is found[0]:
        function = next((n for n in module.around(found[0]) if isinstance(n, Function)), None)
        if function is not None and function.body[-1] is found[0]:
            return deleted(case)
    return case.changed(module, module.text.swap(found[0], written))


def _without_yield(case: Case) -> Files | None:
    """Delete a line that contains only a yield."""
    module, line = case.module, case.finding.line
    found = (
        [n for n in module.nodes if isinstance(n, ast.Expr) and n.lineno == line] if module else []
    )
    alone = len(found) == 1 and isinstance(found[0].value, ast.Yield | ast.YieldFrom)
    return deleted(case) if alone else None


def _status(suspect: Suspect) -> RecognisedMistake | None:
    """The function of the entry point returns a text, or exits with one: the exit status is 1."""
    function = suspect.function
    if function is None:
        return None
    found = [
        (part, value)
        for part in parts_of(function)
        if isinstance(part, ast.Return | ast.Call)
        and (value := _ending(part)) is not None
        and _is_error(suspect, value)
    ]
    if len(found) != 1:
        return None
    part, value = found[0]
    module = suspect.source.module_of(part)
    params = {"name": shown(module.text.code(part))}
    if isinstance(part, ast.Return) and function.body[-1] is part and _is_text(value):
        params["written"] = f"print({module.text.code(value)})"
    mistake = suspect.finding("status_of_main", part, **params)
    variant = "exit" if isinstance(part, ast.Call) else "" if "written" in params else "value"
    return replace(mistake, variant=variant)


def _is_text(value: ast.expr) -> bool:
    text = isinstance(value, ast.Constant) and isinstance(value.value, str)
    return text or isinstance(value, ast.JoinedStr)


def _ending(part: ast.Return | ast.Call) -> ast.expr | None:
    """Return what a function returns, or gives to sys.exit."""
    if isinstance(part, ast.Return):
        return part.value
    exits = dotted(part.func) in EXITS and len(part.args) == 1
    return part.args[0] if exits else None


def _is_error(suspect: Suspect, value: ast.expr) -> bool:
    """Whether sys.exit makes a status other than 0 of a value: of a text, or of another number."""
    if isinstance(value, ast.Constant) and isinstance(value.value, int):
        return value.value % 256 != 0
    given = isinstance(value, ast.Constant) and value.value is not None
    given = given or dotted(value) in suspect.source.node_variables
    return given or isinstance(value, ast.JoinedStr | ast.List | ast.Tuple | ast.Dict)


def _nothing_returned(case: Case) -> Files | None:
    """Print the text that the function returns, or delete its return; empty the () of an exit."""
    module, line = case.module, case.finding.line
    nodes = module.nodes if module is not None else []
    found = [n for n in nodes if isinstance(n, ast.Return) and n.lineno == line]
    exits = [n for n in nodes if isinstance(n, ast.Call) and n.lineno == line]
    exits = [n for n in exits if dotted(n.func) in EXITS and len(n.args) == 1]
    if module is not None and len(exits) == 1 and not found:
        return case.changed(module, module.text.swap(exits[0], f"{dotted(exits[0].func)}()"))
    if module is None or len(found) != 1:
        return None
    new = str(case.finding.params.get("written", ""))
    last = block_of(module, found[0])[-1] is found[0]
    function = next((n for n in module.around(found[0]) if isinstance(n, Function)), None)
    if not last or function is None or function.body[-1] is not found[0]:
        return case.changed(module, module.text.swap(found[0], "return"))
    return case.changed(module, module.text.swap(found[0], new)) if new else deleted(case)


_node = Family("node", links.PYTHON_CLASSES)
KINDS = (
    _node(
        "init_returns",
        "class",
        msg("__init__ returns a value"),
        msg(
            "__init__ only sets up the object, and must return nothing. Creating the object gives "
            "the object itself, without a return."
        ),
        msg("Write return instead of {name}."),
        whys={
            key: msg(
                "A function with yield is a generator: calling __init__ runs none of its lines, and "
                "gives a generator. __init__ must return nothing."
            )
            for key in ("yield", "yields")
        },
        fixes={
            "last": msg("Delete this line: {name}"),
            "called": msg("Delete the word return in this line: write {written}"),
            "plain_several": msg(
                "Write return instead of {name}. Do the same in the other lines: {lines}."
            ),
            "last_several": msg(
                "Delete this line: {name}. In line {lines}, write return without a value."
            ),
            "called_several": msg(
                "Delete the word return in this line: write {written}. In line {lines}, write return "
                "without a value."
            ),
            "yield": msg("Delete {name} in this line."),
            "yields": msg("Delete {name} in this line, and the yield in line {lines}."),
        },
        raised={NOT_NONE: _of_init},
        fixed_by=(_without_value, _without_yield),
        examples=(
            example(
                "init_returns_self",
                Replace(
                    NODE,
                    "self.create_timer(1.0, self.timer_callback)\n",
                    "self.create_timer(1.0, self.timer_callback)\n        return self\n",
                ),
                fails="run.starts",
            ),
            example(
                "init_returns_timer",
                Replace(NODE, "self.create_timer(1.0,", "return self.create_timer(1.0,"),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "status_of_main",
        "shutdown",
        msg("The program ends with the status of an error"),
        msg(
            "ros2 run calls {function}, and gives what it returns to sys.exit. A text is printed "
            "there as an error, and the exit status is 1. Only 0 or nothing means that all is well."
        ),
        msg("Write {written} instead of {name}: {function} must return nothing."),
        links.PYTHON_ERRORS,
        whys={
            "value": msg(
                "ros2 run calls {function}, and what it returns becomes the exit status. Only 0 or "
                "nothing means that all is well."
            ),
            "exit": msg(
                "What is given to {name} becomes the exit status: a text is printed as an error, and "
                "the status is 1. Only 0 or nothing means that all is well."
            ),
        },
        fixes={
            "value": msg("Write return instead of {name}: {function} must return nothing."),
            "exit": msg("Leave the () of the exit in this line empty."),
        },
        behind={"run.error_at_stop": _status},
        fixed_by=(_nothing_returned,),
        examples=(
            example(
                "main_returns_text",
                Replace(NODE, STOP, f"{STOP}    return 'The node has ended'\n"),
                fails="run.interrupt",
            ),
            example(
                "main_returns_true",
                Replace(NODE, STOP, f"{STOP}    return True\n"),
                fails="run.interrupt",
            ),
        ),
    ),
)
