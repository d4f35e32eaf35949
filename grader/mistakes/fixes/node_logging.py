"""The fix of a node that logs with Python's logging module: the same lines with its own logger."""

from __future__ import annotations

import ast

from grader.mistakes.fixes.case import Case
from grader.package.edit.files import Files
from grader.package.edit.text import Splice
from grader.package.source.imported import full_name, imports
from grader.package.source.module import Module
from grader.package.source.names import calls_in, dotted, last_part
from grader.package.source.node import LOG_METHODS, NodeSource
from grader.package.source.place import block_of
from grader.package.source.python import PythonFault, parse_python
from grader.package.source.python_logging import is_of_logging, python_loggers, python_logs


def own_logger(case: Case) -> Files | None:
    """Log with the node's logger, and delete what sets up Python's logging."""
    node = case.node
    logs = python_logs(node, node.module.tree) if node is not None else []
    if node is None or not logs or not all(_is_simple(node, call) for call in logs):
        return None
    module = node.module
    splices = [splice for call in logs for splice in _changes(module, call)]
    for statement in _set_up(node):
        if len(block_of(module, statement)) == 1 or not _is_own_line(module, statement):
            return None
        splices.append(module.text.without(statement.lineno))
    new = module.edited([*splices, *(_imports(module))])
    if new is None or _names_left(new, module, node):
        new = module.edited(splices)
    return case.with_data(module.path, new)


def _is_simple(node: NodeSource, call: ast.Call) -> bool:
    """Whether a call is in a method of the node, and the node's logger takes its arguments."""
    method = last_part(full_name(node.module, call.func) or dotted(call.func))
    around = node.function_around(call)
    first = around.args.args[0].arg if around is not None and around.args.args else ""
    own = around in node.own_methods and first == "self"
    plain = bool(call.args) and not call.keywords
    starred = any(isinstance(given, ast.Starred) for given in call.args)
    text = len(call.args) == 1 or node.module.text.plain_string(call.args[0]) is not None
    return own and plain and text and not starred and method in LOG_METHODS


def _changes(module: Module, call: ast.Call) -> list[Splice]:
    text = module.text
    method = last_part(full_name(module, call.func) or dotted(call.func))
    splices = [text.swap(call.func, f"self.get_logger().{method}")]
    if len(call.args) > 1:
        values = ", ".join(text.code(given) for given in call.args[1:])
        start, end = text.span(call.args[0])[1], text.span(call.args[-1])[1]
        splices.append(Splice(start, end, f" % ({values})" if _several(call) else f" % {values}"))
    return splices


def log_of_node(node: NodeSource, call: ast.Call) -> str:
    """Return the call of the node's logger for a call of Python's; "" if it is not certain."""
    module = node.module
    if not module.has(call) or not _is_simple(node, call):
        return ""
    start, code = module.text.span(call)[0], module.text.code(call)
    for splice in sorted(_changes(module, call), key=lambda s: -s.start):
        code = code[: splice.start - start] + splice.new + code[splice.end - start :]
    return code if "\n" not in code else ""


def _several(call: ast.Call) -> bool:
    """Whether the values behind % need brackets."""
    return len(call.args) > 2 or not dotted(call.args[1])


def _set_up(node: NodeSource) -> list[ast.stmt]:
    """Return the statements that make and set up Python's loggers."""
    module, known = node.module, python_loggers(node)
    found: list[ast.stmt] = []
    for part in module.nodes:
        value = part.value if isinstance(part, ast.Expr | ast.Assign | ast.AnnAssign) else None
        if not isinstance(value, ast.Call) or not isinstance(part, ast.stmt):
            continue
        called = dotted(value.func)
        method = last_part(called)
        of_logging = is_of_logging(module, value.func)
        makes = of_logging and method in ("getLogger", "Logger", "basicConfig")
        if makes or (called.rpartition(".")[0] in known and method == "setLevel"):
            found.append(part)
    return found


def _is_own_line(module: Module, statement: ast.stmt) -> bool:
    return module.text.line(statement.lineno).strip() == module.text.code(statement)


def _imports(module: Module) -> list[Splice]:
    """Return the splices that delete the imports of Python's logging, each on its own line."""
    statements = {s for _, full, s in imports(module) if full.partition(".")[0] == "logging"}
    alone = [s for s in statements if isinstance(s, ast.Import | ast.ImportFrom)]
    alone = [s for s in alone if len(s.names) == 1 and _is_own_line(module, s)]
    return [module.text.without(s.lineno) for s in alone]


def _names_left(new: bytes, module: Module, node: NodeSource) -> bool:
    """Whether the changed file still uses a name of Python's logging."""
    bound = {name for name, full, _ in imports(module) if full.partition(".")[0] == "logging"}
    try:
        tree = parse_python(new).tree
    except PythonFault:
        return True
    used = {dotted(n) for n in ast.walk(tree) if isinstance(n, ast.Name | ast.Attribute)}
    called = {name.rpartition(".")[0] for _, name in calls_in(tree)}
    return bool((bound | python_loggers(node)) & (used | called))
