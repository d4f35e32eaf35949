"""The call of the logger that a call of print() or of sys.stdout.write() stands for."""

from __future__ import annotations

import ast
import re

from grader.package.source.module import Module
from grader.package.source.names import dotted
from grader.package.source.node import NodeSource

WRITES = ("print", "sys.stdout.write", "sys.stderr.write", "stdout.write", "stderr.write")
RECORD = re.compile(r"^\\?\[?(?:DEBUG|INFO|WARN|ERROR|FATAL)\]? ?\[")
END_OF_RECORD = re.compile(r"^.*\]:? ?")
LONGEST = 80  # characters of a piece of code that a text shows
TEXT_NAMES = ast.Name | ast.Attribute
QUIET = ("flush", "file")  # arguments of print that the logger does not need


def writes_line(call: ast.Call) -> bool:
    """Return whether a call writes a text to the terminal, and is not print()."""
    return dotted(call.func) in WRITES[1:] and len(call.args) == 1


def imitates_record(call: ast.Call) -> bool:
    """Return whether a call writes a text that begins as a log record does."""
    given = call.args[0] if call.args and dotted(call.func) in WRITES else None
    first = (
        next((n for n in ast.walk(given) if isinstance(n, ast.Constant)), None) if given else None
    )
    if isinstance(given, ast.JoinedStr) and given.values:
        part = given.values[0]
        first = part if isinstance(part, ast.Constant) else None
    text = first.value if first is not None else None
    return isinstance(text, str) and RECORD.match(text) is not None


def as_log(source: NodeSource, call: ast.Call, node: str = "") -> str | None:
    """Return the call of the logger with the same text; None if it is long or not known.

    `node` is how the node is called at this place, if it is not self.
    """
    module = source.module_of(call)
    text = _text_of(module, call)
    logger = f"{node}.get_logger()" if node else _logger_at(source, call)
    code = module.text.code(call)
    if text is None or not logger or "\n" in code:
        return None
    written = f"{logger}.info({text})"
    return written if len(written) <= LONGEST and len(code) <= 2 * LONGEST else None


def _logger_at(source: NodeSource, call: ast.Call) -> str:
    """Return how the node's logger is called at a place; "" if the place has no self."""
    kept = source.loggers_at(call)
    if kept:
        return kept[0]
    around = source.function_around(call)
    own = around is not None and around in source.own_methods and around.args.args
    node = source.held_node or "self"
    return f"{node}.get_logger()" if own and around and around.args.args[0].arg == "self" else ""


def _text_of(module: Module, call: ast.Call) -> str | None:
    code = module.text.code
    others = [k for k in call.keywords if k.arg not in QUIET and not _ends_line(k)]
    if others or not call.args:
        return None
    if any(isinstance(given, ast.Starred) for given in call.args):
        return None
    if imitates_record(call):
        return _after_record(module, call)
    if dotted(call.func) != "print":
        return _without_newline(module, call.args[0]) if len(call.args) == 1 else None
    if len(call.args) == 1:
        given = call.args[0]
        text = isinstance(given, ast.JoinedStr | ast.BinOp | ast.Constant | ast.Call | TEXT_NAMES)
        return code(given) if text and not _is_number(given) else None
    parts: list[str] = []
    for given in call.args:
        if isinstance(given, ast.Constant) and isinstance(given.value, str):
            parts.append(given.value)
        else:
            parts.append(f"{{{code(given)}}}")
    joined = " ".join(parts)
    plain = all(not p.startswith("{") or not set(p[1:-1]) & set("'\"{}\\!:=") for p in parts)
    texts = [p for p in parts if not p.startswith("{")]
    if not plain or any(set(p) & set("'{}\\") or not p.isprintable() for p in texts):
        return None
    return f"f'{joined}'"


def _ends_line(keyword: ast.keyword) -> bool:
    value = keyword.value.value if isinstance(keyword.value, ast.Constant) else None
    return keyword.arg == "end" and value == "\n"


def _is_number(given: ast.expr) -> bool:
    return isinstance(given, ast.Constant) and not isinstance(given.value, str)


def _without_newline(module: Module, given: ast.expr) -> str | None:
    """Return a text without the end of the line that it has, for a logger; None if it has none."""
    code = module.text.code(given)
    if code.count("\\n") != 1:
        return None
    short = re.sub(r"(?: \+ (['\"])\\n\1|\\n(?=['\"]))$", "", code)
    short = re.sub(r"\\n(?=['\"]$)", "", short)
    return short if "\\n" not in short else None


def _after_record(module: Module, call: ast.Call) -> str | None:
    """Return the text that comes after the level, the time and the name of an imitated record."""
    given = call.args[0]
    if len(call.args) != 1 or not isinstance(given, ast.JoinedStr):
        return None
    code = module.text.code(given)
    match = re.fullmatch(r"([fF])(['\"])(.*)\2", code)
    parts = re.split(r"\]: ", match[3]) if match is not None else []
    if match is None or len(parts) != 2:
        return None
    rest = parts[1].removesuffix("\\n")
    value = re.fullmatch(r"\{(\w{1,40})\}", rest)
    if value is not None:
        return value[1]
    return f"{match[1]}{match[2]}{rest}{match[2]}" if rest else None
