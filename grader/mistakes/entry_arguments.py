"""The mistake of a function of the entry point that uses its parameter, which is None in ros2 run."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.example import NODE, example
from grader.mistakes.fixes import lines
from grader.mistakes.kind import Family
from grader.mistakes.recognised import Raised, RecognisedMistake, on_line
from grader.package.edit.tree import Replace
from grader.package.source.module import Function
from grader.package.source.names import dotted

OF_NONE = (
    r"TypeError: (?:object of type 'NoneType' has no len\(\)"
    r"|(?:argument of type )?'NoneType' (?:object )?is not (?:subscriptable|iterable|a container)"
    r"|argument of type 'NoneType' is not iterable|cannot unpack non-iterable NoneType object)"
    r"|AttributeError: 'NoneType' object has no attribute"
)


def none_parameters(function: Function) -> set[str]:
    """Return the parameters that are None if they get no value, and that no line sets."""
    given = function.args
    count = len(given.defaults)
    plain = zip(given.args[len(given.args) - count :], given.defaults)
    named = ((name, value) for name, value in zip(given.kwonlyargs, given.kw_defaults) if value)
    found = {
        name.arg
        for name, value in (*plain, *named)
        if isinstance(value, ast.Constant) and value.value is None
    }
    stored = {
        node.id
        for node in ast.walk(function)
        if isinstance(node, ast.Name) and not isinstance(node.ctx, ast.Load)
    }
    return found - stored


def _none_in_main(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The line of main uses a parameter as a list, and ros2 run calls main without arguments."""
    del match
    main = raised.source.main
    if main is None or not raised.module.has(main) or isinstance(main, ast.AsyncFunctionDef):
        return None
    names = none_parameters(main)
    for use, read in _uses(main, raised.line):
        if dotted(read) not in names:
            continue
        code, name = raised.module.text.code(use), raised.module.text.code(read)
        if "\n" in code:
            return None
        if _is_item(use):
            params = {"name": code, "variable": name}
            return replace(raised.finding("main_gets_none", at=use, params=params), variant="item")
        params = {"name": code, "variable": name, "written": _with_list(code, use, name)}
        return raised.finding("main_gets_none", at=use, params=params)
    return None


def _is_item(use: ast.expr) -> bool:
    """Whether one item or an attribute is read, so that an empty list is of no use."""
    index = isinstance(use, ast.Subscript) and not isinstance(use.slice, ast.Slice)
    return index or isinstance(use, ast.Attribute)


def _with_list(code: str, use: ast.expr, name: str) -> str:
    """Return the code with an empty list in place of None."""
    if isinstance(use, ast.Compare):
        return f"{code.removesuffix(name)}({name} or [])"
    if isinstance(use, ast.Name):
        return f"{name} or []"
    return code.replace(
        name, f"{name} or []" if isinstance(use, ast.Call) else f"({name} or [])", 1
    )


def _uses(main: Function, line: int | None) -> Iterator[tuple[ast.expr, ast.expr]]:
    """Yield what needs items on a line, and the part of it that must not be None."""
    for node in ast.walk(main):
        if isinstance(node, ast.For | ast.comprehension):
            if node.iter.lineno == line:
                yield node.iter, node.iter
        elif not isinstance(node, ast.expr) or node.lineno != line:
            continue
        elif isinstance(node, ast.Call) and dotted(node.func) == "len" and len(node.args) == 1:
            yield node, node.args[0]
        elif isinstance(node, ast.Subscript | ast.Attribute):
            yield node, node.value
        elif isinstance(node, ast.Compare) and isinstance(node.ops[-1], ast.In | ast.NotIn):
            yield node, node.comparators[-1]


_node = Family("node", links.DEVELOPING)
KINDS = (
    _node(
        "main_gets_none",
        "start",
        msg("The entry point's function uses an argument that it does not get"),
        msg(
            "The executable calls {function}() without arguments, so {variable} has the value of its "
            "default: None. What is written behind the name of the executable is in sys.argv."
        ),
        msg("Write {written} instead of {name}: an empty list stands for None."),
        fixes={
            "item": msg(
                "Write the value itself in the code instead of {name}, or delete what needs it: "
                "{variable} is always None here."
            )
        },
        raised={OF_NONE: on_line(_none_in_main)},
        fixed_by=(lines.written,),
        examples=(
            example(
                "length_of_args_in_main",
                Replace(
                    NODE,
                    "    rclpy.init(args=args)\n",
                    "    if len(args) > 0:\n        print(args[0])\n    rclpy.init(args=args)\n",
                ),
                fails="run.starts",
            ),
            example(
                "first_of_args_in_main",
                Replace(
                    NODE,
                    "    rclpy.init(args=args)\n",
                    "    print(args[0])\n    rclpy.init(args=args)\n",
                ),
                fails="run.starts",
            ),
        ),
    ),
)
