"""The mistake of an except that names something else than a class of exceptions."""

from __future__ import annotations

import ast
import re
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.base.shown import shown
from grader.mistakes import links
from grader.mistakes.example import NODE, example
from grader.mistakes.fixes import lines
from grader.mistakes.kind import Family
from grader.mistakes.recognised import Raised, RecognisedMistake
from grader.package.edit.tree import Replace

NO_CLASS = r"TypeError: catching classes that do not inherit from BaseException is not allowed"


def _no_class(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The except of the line, or the only one of the file, has an object or a text."""
    del match
    module = raised.module
    handlers = [n for n in module.nodes if isinstance(n, ast.ExceptHandler) and n.type is not None]
    wrong = [
        h for h in handlers if h.type is not None and _class_in(module.text.code(h.type), h.type)
    ]
    here = [h for h in wrong if h.lineno == raised.line]
    found = here or wrong
    if len(found) != 1 or found[0].type is None:
        return None
    code = module.text.code(found[0].type)
    new = _class_in(code, found[0].type)
    params = {"name": f"except {shown(code)}", "written": f"except {new}"}
    mistake = raised.finding("except_no_class", at=found[0].type, params=params)
    called = isinstance(found[0].type, ast.Call)
    return mistake if called else replace(mistake, variant="other")


def _class_in(code: str, given: ast.expr) -> str:
    """Return the name of the exception that is called, or that is in quotes; "" for others."""
    if isinstance(given, ast.Call) and not given.args and not given.keywords:
        return re.sub(r"\s*\(\s*\)\Z", "", code)
    if isinstance(given, ast.Constant) and isinstance(given.value, str):
        name = given.value.strip().removesuffix("()")
        return name if name.endswith(("Error", "Exception", "Interrupt")) else ""
    return ""


_node = Family("node", links.PYTHON_ERRORS)
KINDS = (
    _node(
        "except_no_class",
        "shutdown",
        msg("An except does not name a class of exceptions"),
        msg(
            "An except names the class of the exceptions that it catches. With () after it, an object "
            "is made, and Python cannot catch with an object."
        ),
        msg("Write {written} instead of {name}, and leave the rest of the line as it is."),
        whys={
            "other": msg(
                "An except names the class of the exceptions that it catches, without quotes."
            )
        },
        raised={NO_CLASS: _no_class},
        fixed_by=(lines.written,),
        examples=(
            example(
                "except_calls_the_class",
                Replace(NODE, "except KeyboardInterrupt:", "except KeyboardInterrupt():"),
                fails="run.interrupt",
            ),
        ),
    ),
)
