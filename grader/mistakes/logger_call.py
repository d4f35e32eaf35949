"""The mistake of a logger that is called in another way than it takes."""

from __future__ import annotations

import ast
import re
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.example import DEAD, NODE, example
from grader.mistakes.fixes import lines
from grader.mistakes.kind import INSTEAD, Family
from grader.mistakes.number_in_text import has_text
from grader.mistakes.recognised import Raised, RecognisedMistake
from grader.package.edit.tree import Replace
from grader.package.source.module import Module
from grader.package.source.names import called_name, dotted, last_part
from grader.package.source.node import LOG_METHODS
from grader.package.source.place import statement_at

LOGGER = (
    r"'(?:function|method)' object has no attribute '(?:info|debug|warn|warning|error|fatal)'"
    r"|'RcutilsLogger' object (?:is not callable|has no attribute "
    r"'(?:print|write|information|message|msg|log_info|log)')"
    r"|(?<!\w)(?:log\(\) missing 1 required positional argument: 'severity'"
    r"|get_logger\(\) takes 1 positional argument but \d{1,3} were given"
    r"|(?:info|debug|warn|warning|error|fatal)\(\) takes (?:from \d{1,3} to )?\d{1,3} positional "
    r"arguments? but \d{1,3} were given)"
)


def _call(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The line calls the logger in another way than it takes: write it as it takes it."""
    statement = statement_at(raised.module, raised.line)
    call = statement.value if isinstance(statement, ast.Expr) else None
    if not isinstance(call, ast.Call):
        return None
    named = [n for n in ast.walk(call) if isinstance(n, ast.Attribute | ast.Name)]
    kept = {} if match[0].startswith(("'f", "'m")) else raised.source.loggers
    owners = [n for n in named if last_part(dotted(n)) == "get_logger" or dotted(n) in kept]
    if not owners:
        return None
    code = raised.module.text.code
    owner = code(owners[0]) + ("()" if last_part(dotted(owners[0])) == "get_logger" else "")
    text = _text_of(raised.module, call)
    method = called_name(call) if called_name(call) in LOG_METHODS else "info"
    written = f"{owner}.{method}({text})"
    found = raised.finding("logger_call", at=owners[0], name=code(call), written=written)
    return replace(found, variant="written") if text else found


def _text_of(module: Module, call: ast.Call) -> str:
    """Return the text that a call is to log, of all that it gets; "" if that is not certain."""
    inner = (n for n in ast.walk(call.func) if isinstance(n, ast.Call))
    given = call.args or [each for part in inner for each in part.args]
    written = [module.text.code(each) for each in given]
    texts = [has_text(each) for each in given]
    if call.keywords or not given or not texts[0] or "%" in written[0] or len(given) > 2:
        return ""
    if len(given) == 1:
        return written[0]
    return f"{written[0]} + {written[1] if texts[1] else f'str({written[1]})'}"


_node = Family("node", links.LOGGING)
KINDS = (
    _node(
        "logger_call",
        "logger",
        msg("The logger is not called as it takes it"),
        msg(
            "get_logger() returns the node's logger, and takes nothing. The logger has a method for each "
            "level, such as info, and each takes one text."
        ),
        msg("Write self.get_logger().info(…) with one text in the parentheses of info."),
        fixes={"written": INSTEAD},
        seen=LOGGER,
        raised={LOGGER: _call},
        fixed_by=(lines.written,),
        examples=(
            example(
                "get_logger_not_called",
                Replace(NODE, "self.get_logger().info", "self.get_logger.info"),
                fails="run.output",
                blocks=DEAD,
            ),
            example(
                "logger_with_comma",
                Replace(NODE, "'Hello time: ' + str", "'Hello time: ', str"),
                fails="run.output",
                blocks=DEAD,
                note="as print would take it",
            ),
            example(
                "logger_print",
                Replace(NODE, "get_logger().info(", "get_logger().print("),
                fails="run.output",
                blocks=DEAD,
            ),
        ),
    ),
)
