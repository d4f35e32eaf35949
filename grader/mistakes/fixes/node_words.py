"""Fixes of words, signs and options that mean something else in Python or in rclpy."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from dataclasses import dataclass

from grader.mistakes.fixes import lines
from grader.mistakes.fixes.case import Case
from grader.package.edit.files import Files
from grader.package.edit.text import Splice
from grader.package.source.commented import commented
from grader.package.source.commented import uncommented as uncommented_in
from grader.package.source.counter import logged_counter, targets_of
from grader.package.source.hidden_def import hidden_def
from grader.package.source.module import Function, Module
from grader.package.source.names import dotted, last_part
from grader.package.source.node import LOG_METHODS, NodeSource

COMPUTED = (ast.BinOp, ast.UnaryOp, ast.Compare)
OPTIONS = ("once", "throttle_duration_sec", "skip_first")
"""The options of the logger that leave out lines (rclpy/impl/rcutils_logger.py)."""


def word(case: Case) -> Files | None:
    """Write a word of another language as Python does."""
    module = case.module
    name, close = (str(case.finding.params.get(key, "")) for key in ("name", "close"))
    if module is None or not close.isidentifier() or name in module.names:
        return None
    uses = [n for n in module.nodes if isinstance(n, ast.Name) and n.id == name]
    if any(module.text.code(use) != name for use in uses):
        return None
    return case.changed(module, *(module.text.swap(use, close) for use in uses))


def comment(case: Case) -> Files | None:
    """Begin a comment with # instead of //."""
    module, line = case.module, case.finding.line or 0
    name = str(case.finding.params.get("name", ""))
    row = module.text.line(line) if module is not None else ""
    if module is None or not re.search(rf"//\s*{re.escape(name)}\s*\Z", row):
        return None
    at = module.text.start_of(line) + row.rindex("//")
    return case.changed(module, Splice(at, at + 2, "#"))


def other_comment(case: Case) -> Files | None:
    """Begin a comment at the end of the line with # instead of %, -- or ;."""
    module, line = case.module, case.finding.line or 0
    name = str(case.finding.params.get("name", ""))
    row = module.text.line(line) if module is not None else ""
    match = re.search(rf"(?P<sign>%|--|;)[ \t]*{re.escape(name)}\s*\Z", row)
    if module is None or match is None:
        return None
    at = module.text.start_of(line) + match.start()
    return case.changed(module, Splice(at, at + len(match["sign"]), "#"))


def lost_sum(source: NodeSource) -> tuple[ast.Expr | ast.Return, str] | None:
    """Return the statement of the callback that computes with the counter and keeps nothing."""
    logged = logged_counter(source)
    if source.callback is None or logged is None:
        return None
    for node in ast.walk(source.callback):
        value = node.value if isinstance(node, ast.Expr) else None
        used = {dotted(part) for part in ast.walk(value)} if isinstance(value, COMPUTED) else set()
        if isinstance(node, ast.Expr) and logged[1] in used:
            return node, logged[1]
    return _returned_sum(source, source.callback, logged[1])


def _returned_sum(
    source: NodeSource, callback: Function, counter: str
) -> tuple[ast.Return, str] | None:
    """Return the last line of the callback if it returns the counter plus a number.

    Nothing but a timer may call the callback: other code could keep what it gets.
    """
    last = callback.body[-1]
    value = last.value if isinstance(last, ast.Return) else None
    if not isinstance(last, ast.Return) or not isinstance(value, ast.BinOp):
        return None
    parts = {dotted(value.left), dotted(value.right)}
    number = isinstance(value.left, ast.Constant) or isinstance(value.right, ast.Constant)
    only_timer = callback.name in {timer.method for timer in source.timers}
    called = any(last_part(name) == callback.name for _, name in source.calls)
    changed = any(counter in targets_of(node) for node in ast.walk(callback))
    if not isinstance(value.op, ast.Add) or counter not in parts or not number:
        return None
    return (last, counter) if only_timer and not called and not changed else None


def kept_sum(case: Case) -> Files | None:
    """Add to the counter on the line that only computes."""
    node = case.node
    found = lost_sum(node) if node is not None else None
    if node is None or found is None:
        return None
    module = node.module_of(found[0])
    new = f"{found[1]} += {case.assignment.output.step}"
    return case.changed(module, module.text.swap(found[0], new))


def option_of(call: ast.Call) -> ast.keyword | None:
    """Return the first argument of a call that leaves out lines, as an option of the logger."""
    for given in call.keywords:
        off = isinstance(given.value, ast.Constant) and not given.value.value
        if given.arg in OPTIONS and not off:
            return given
    return None


@dataclass(frozen=True)
class Option:
    """An option of the logger that leaves out lines: its value, the call that has it, its code there."""

    name: str
    value: ast.expr
    call: ast.Call
    code: str


def log_option(source: NodeSource, *options: str) -> Option | None:
    """Return the first of these options that a call of the node's logger gets.

    In the call itself, in a dictionary that it gets with **, in the call of a method that hands its
    own ** on, or in partial(); None if none of them is certain.
    """
    for call in source.own_logs:
        option = option_of(call)
        if option is not None and option.arg in options:
            return Option(option.arg, option.value, call, f"{option.arg}=…")
        for given in (k.value for k in call.keywords if k.arg is None):
            found = _in_dictionary(source, call, given, options)
            if found is not None:
                return found
    for call in source.calls_of("partial"):
        option = option_of(call)
        logs = call.args and last_part(dotted(call.args[0])) in LOG_METHODS
        if logs and option is not None and option.arg in options:
            return Option(option.arg, option.value, call, f"{option.arg}=…")
    return None


def _in_dictionary(
    source: NodeSource, call: ast.Call, given: ast.expr, options: tuple[str, ...]
) -> Option | None:
    """Return the option of a dictionary, or of the calls of the method whose ** this is."""
    name, method = dotted(given), source.function_around(call)
    passed = method.args.kwarg.arg if method is not None and method.args.kwarg else ""
    if method is not None and name and name == passed:
        for outer in source.calls_of(method.name):
            option = option_of(outer)
            if option is not None and option.arg in options:
                return Option(option.arg, option.value, outer, f"{option.arg}=…")
        return None
    code = source.module_of(call).text.code(given)
    for value in values_of(source, given):
        for key, part in _pairs(value):
            off = isinstance(part, ast.Constant) and not part.value
            if key in options and not off:
                return Option(key, part, call, f"**{code}")
    return None


def values_of(source: NodeSource, given: ast.expr) -> list[ast.expr]:
    """Return what a name is set to anywhere in the files; the expression itself if it is no name."""
    name = dotted(given)
    if not name:
        return [given]
    short = {name, name.removeprefix("self.")} if name.startswith("self.") else {name}
    nodes = (n for module in source.modules for n in module.nodes)
    set_to = [(n, getattr(n, "value", None)) for n in nodes if short & set(targets_of(n))]
    return [value for _, value in set_to if isinstance(value, ast.expr)]


def _pairs(value: ast.expr) -> Iterator[tuple[str, ast.expr]]:
    """Yield the keys of a dictionary that are texts, with their values: {…} or dict(…)."""
    if isinstance(value, ast.Dict):
        for key, part in zip(value.keys, value.values):
            if isinstance(key, ast.Constant) and isinstance(key.value, str):
                yield key.value, part
    elif isinstance(value, ast.Call) and dotted(value.func) == "dict":
        yield from ((k.arg, k.value) for k in value.keywords if k.arg is not None)


def options(case: Case) -> Files | None:
    """Remove the options that leave out lines from the call of the logger."""
    node = case.node
    option = log_option(node, *OPTIONS) if node is not None else None
    several = len([c for c in node.own_logs if option_of(c) is not None]) > 1 if node else True
    if node is None or option is None or several or not option.call.args:
        return None
    call, module = option.call, node.module_of(option.call)
    if any(not _is_option(node, given) for given in call.keywords):
        return None
    start, end = module.text.span(call.args[-1])[1], module.text.span(call)[1] - 1
    return case.changed(module, Splice(start, end, ""))


def _is_option(node: NodeSource, given: ast.keyword) -> bool:
    """Whether an argument is an option of the logger, or a dictionary of nothing else."""
    known = (*OPTIONS, "throttle_time_source_type")
    if given.arg is not None:
        return given.arg in known
    values = values_of(node, given.value)
    keys = [set(dict(_pairs(value))) for value in values]
    return bool(keys) and all(found and found <= set(known) for found in keys)


def value(case: Case) -> Files | None:
    """Give the place in the text its value: the counter."""
    node = case.node
    if node is None:
        return None
    for found in node.calls_of("format"):
        text = found.func.value if isinstance(found.func, ast.Attribute) else None
        written = node.module_of(found).text.plain_string(text) or ""
        if text is not None and len(re.findall(r"%[dis]", written)) == written.count("%") == 1:
            module = node.module_of(text)
            code = re.sub(r"%[dis]", "{}", module.text.code(text))
            return case.changed(module, module.text.swap(text, code))
    logged, call = logged_counter(node), node.log_call
    if logged is None or call is None:
        return None
    return _with_value(case, node.module_of(call), call, logged[1])


def value_for_name(case: Case) -> Files | None:
    """Write a name of the text with its value, if the finding gives that: no place of the text."""
    name = str(case.finding.params.get("name", ""))
    return lines.written(case) if not name.startswith(("%", "{")) else None


def _with_value(case: Case, module: Module, call: ast.Call, counter: str) -> Files | None:
    """Write the counter behind the only place for a value in the text of a call."""
    text = module.text.plain_string(call.args[0]) or ""
    percent, braces = len(re.findall(r"%[dis]", text)), len(re.findall(r"\{0?\}", text))
    if (percent, braces) not in ((1, 0), (0, 1)) or text.count("%") != percent:
        return None
    at = module.text.span(call.args[0])[1]
    new = f" % {counter}" if percent else f".format({counter})"
    return case.changed(module, Splice(at, at, new))


def uncommented(case: Case) -> Files | None:
    """Write the statement of a comment on a line of its own."""
    module, line = case.module, case.finding.line
    written = str(case.finding.params.get("written", ""))
    if module is None or not written:
        return None
    for found in commented(module.text, re.escape(written)):
        if found.line == line and found.code == written:
            new = uncommented_in(module.text, found)
            return case.with_data(module.path, new) if new is not None else None
    return None


def shown_def(case: Case) -> Files | None:
    """Make code of a def that is in a comment, or in a text in three quotes."""
    node, name = case.node, str(case.finding.params.get("name", ""))
    if node is None or not name:
        return None
    found = hidden_def(node.module.text, name, node.class_body)
    return case.with_data(node.module.path, found.fixed) if found is not None else None


DUNDERS = ("__init__", "__name__", "__main__")
"""The names of Python with two underscores on both sides that a first node has."""


def double_underscores(case: Case) -> Files | None:
    """Write the second underscores of Python's names in the whole file."""
    module = case.module
    if module is None:
        return None
    code, splices = module.text.text, []
    for name in DUNDERS:
        for match in re.finditer(rf"(?<!\w)_{{1,3}}{name.strip('_')}_{{1,3}}(?!\w)", code):
            if match[0] != name:
                splices.append(Splice(*match.span(), name))
    return case.changed(module, *splices)
