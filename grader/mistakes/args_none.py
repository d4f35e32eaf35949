"""The mistake of a main that reads its parameter args, which is None when ros2 run starts it."""

from __future__ import annotations

import ast
import re
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.example import NODE, example
from grader.mistakes.fixes import lines
from grader.mistakes.kind import Family
from grader.mistakes.recognised import Raised, RecognisedMistake
from grader.package.edit.tree import Replace
from grader.package.source.names import dotted
from grader.package.source.place import function_at, statement_at
from grader.package.source.scopes import bindings

OF_NONE = (
    r"TypeError: (?:object of type 'NoneType' has no len\(\)|'NoneType' object is not "
    r"(?:subscriptable|iterable)|argument of type 'NoneType' is not (?:iterable|a container))"
)


def _read(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The line reads a parameter of the entry function whose default is None."""
    del match
    main, module = raised.source.main, raised.module
    statement = statement_at(module, raised.line)
    if main is None or statement is None or function_at(module, raised.line) is not main:
        return None
    given = main.args.args[len(main.args.args) - len(main.args.defaults) :]
    empty = {
        argument.arg
        for argument, default in zip(given, main.args.defaults, strict=True)
        if isinstance(default, ast.Constant) and default.value is None
    }
    names = {name for part in _parts(statement) if (name := _needed(part)) in empty}
    name = min(names, default="")
    own = [bound for bound in bindings(module, name) if bound.scope is main]
    if len(names) != 1 or len(own) != 1:
        return None
    found = raised.finding("args_is_none", name=name)
    words = {**found.words, "line": str(main.lineno)}
    test = statement.test if isinstance(statement, ast.If | ast.While) else None
    code = module.text.code(test) if test is not None else ""
    if isinstance(statement, ast.If) and code in (f"len({name}) > 0", f"len({name}) >= 1"):
        params = {"name": code, "written": name}
        found = raised.finding("args_is_none", params=params)
        return replace(found, variant="length", words={**words, **found.words, "short": name})
    return replace(found, words={**words, "short": name})


def _parts(statement: ast.stmt) -> list[ast.AST]:
    """Return the parts of a statement; only those of its first line if it has a block."""
    if isinstance(statement, ast.If | ast.While):
        return list(ast.walk(statement.test))
    return (
        [statement, *ast.walk(statement.iter)]
        if isinstance(statement, ast.For)
        else list(ast.walk(statement))
    )


def _needed(part: ast.AST) -> str:
    """Return the name of which a part of a line reads the length or the items."""
    if isinstance(part, ast.Call) and dotted(part.func) == "len" and part.args:
        return dotted(part.args[0])
    if isinstance(part, ast.Subscript):
        return dotted(part.value)
    if isinstance(part, ast.For | ast.comprehension):
        return dotted(part.iter)
    if isinstance(part, ast.Compare) and isinstance(part.ops[-1], ast.In | ast.NotIn):
        return dotted(part.comparators[-1])
    return ""


_node = Family("node", links.FIRST_NODE)
KINDS = (
    _node(
        "args_is_none",
        "start",
        msg("The entry function reads its parameter, which is None"),
        msg(
            "ros2 run calls {function}() without arguments. So {short} is None, as line {line} says, "
            "and None has no length and no items. rclpy.init reads the arguments of the command "
            "line by itself."
        ),
        msg(
            "Delete the lines that read {short} if the program does not need them. Or read {short} "
            "only if it is not None: if {short}:"
        ),
        fixes={"length": msg("Write {written} instead of {name}: None counts as false in an if.")},
        raised={OF_NONE: _read},
        fixed_by=(lines.written,),
        examples=(
            example(
                "length_of_no_arguments",
                Replace(
                    NODE,
                    "    rclpy.init(args=args)",
                    "    if len(args) > 0:\n        print(args)\n    rclpy.init(args=args)",
                ),
                fails="run.starts",
            ),
        ),
    ),
)
