"""The mistake of a print that is written as in Python 2, with >> before what it prints to."""

from __future__ import annotations

import ast
import re

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.example import NODE, example
from grader.mistakes.fixes import lines
from grader.mistakes.kind import Family
from grader.mistakes.recognised import Raised, RecognisedMistake, on_line
from grader.package.edit.tree import Replace
from grader.package.source.place import statement_at


def _print_to(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The line is a print with >> and what it prints to."""
    del match
    statement = statement_at(raised.module, raised.line)
    value = statement.value if isinstance(statement, ast.Expr) else None
    parts = value.elts if isinstance(value, ast.Tuple) else [value]
    first = parts[0] if parts else None
    if value is None or not isinstance(first, ast.BinOp) or not isinstance(first.op, ast.RShift):
        return None
    code = raised.module.text.code
    given = [code(part) for part in parts[1:] if part is not None]
    written = f"print({', '.join([*given, f'file={code(first.right)}'])})"
    params = {"name": code(value), "written": written}
    return raised.finding("print_of_python_2", at=value, params=params)


_node = Family("node", links.PYTHON_ERRORS)
KINDS = (
    _node(
        "print_of_python_2",
        "start",
        msg("print is written as in Python 2"),
        msg(
            "In Python 3, print is a function: what it prints is in its (), and file= says where it goes. "
            "print >> … is an operation that does not exist."
        ),
        msg("Write {written} instead of {name}."),
        raised={
            r"unsupported operand type\(s\) for >>: 'builtin_function_or_method'": on_line(
                _print_to
            )
        },
        fixed_by=(lines.written,),
        examples=(
            example(
                "print_to_a_stream_of_python_2",
                Replace(NODE, "import rclpy\n", "import sys\n\nimport rclpy\n"),
                Replace(
                    NODE,
                    "    node = MyFirstNode()\n",
                    "    node = MyFirstNode()\n    print >>sys.stderr, 'it is up'\n",
                ),
                fails="run.starts",
            ),
        ),
    ),
)
