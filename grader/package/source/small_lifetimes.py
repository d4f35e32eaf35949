"""Small changes of when a value is made or read: once, in each call, or when it is asked for."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from grader.package.edit.text import Splice, indent_of
from grader.package.source.change import Change, of_piece
from grader.package.source.counter import targets_of
from grader.package.source.module import Function, Module
from grader.package.source.names import called_name, dotted, parameters_of
from grader.package.source.node import LOG_METHODS, NodeSource
from grader.package.source.place import first_row, owns_lines
from grader.package.source.small_values import BUILTINS, Found, Goal, Sort, imported, is_name

LAZY = ("map", "filter", "zip", "iter", "enumerate", "range", "reversed")
"""Builtins that make an object which is used up."""
LOOPS = ast.ListComp | ast.SetComp | ast.DictComp | ast.GeneratorExp | ast.For


def _once(module: Module, source: NodeSource, goal: Goal) -> Found:
    """Yield what a function makes in each call, made once above it or in __init__."""
    del goal
    functions = [n for n in module.nodes if isinstance(n, Function)]
    plain = {f.name for f in functions if not any(isinstance(n, ast.Yield) for n in ast.walk(f))}
    for function in functions:
        if function is source.main or function.name == "__init__":
            continue
        if not owns_lines(module, function):
            continue
        for call in _made_in(function, plain):
            change = _made_once(module, function, call)
            if change is not None:
                yield 3, change


def _made_in(function: Function, plain: set[str]) -> Iterator[ast.Call]:
    """Yield the calls in a function that need none of its own names, and are of no `plain` function."""
    own = parameters_of(function) - {"self"}
    own |= {
        n.id for n in ast.walk(function) if isinstance(n, ast.Name) and isinstance(n.ctx, ast.Store)
    }
    statements = {n.value for n in ast.walk(function) if isinstance(n, ast.Expr)}
    for call in (n for n in ast.walk(function) if isinstance(n, ast.Call)):
        name = dotted(call.func)
        if not name or call in statements or called_name(call) in (*LOG_METHODS, "get_logger"):
            continue
        if name in BUILTINS and name not in LAZY:
            continue
        if called_name(call) in plain or called_name(call).startswith("create_"):
            continue  # (it may return the same object each time, or has to be called where it is)
        if not {n.id for n in ast.walk(call) if isinstance(n, ast.Name)} & own:
            yield call


def _made_once(module: Module, function: Function, call: ast.Call) -> Change | None:
    """Return the change that makes the value of a call above the function, or in __init__."""
    text, around = module.text, module.parents.get(function)
    code, head = text.code(call), module.line(function.lineno)
    if "\n" in code:
        return None
    name = next(n for n in ("values", "values_", "own_values") if n not in module.names)
    if not isinstance(around, ast.ClassDef):
        row = first_row(function)
        line = f"{name} = {code}"
        put = text.before(row, indent_of(text.line(row)) + line)
        return Change("once", call, code, line, (put, text.swap(call, name)), head)
    init = [s for s in around.body if isinstance(s, Function) and s.name == "__init__"]
    if not init or not function.args.args or not owns_lines(module, init[0].body[-1]):
        return None
    last = init[0].body[-1]
    line = f"self.{name} = {code}"
    put = text.before((last.end_lineno or 0) + 1, indent_of(text.line(last.lineno)) + line)
    splices = (put, text.swap(call, f"self.{name}"))
    return Change("once_init", call, code, line, splices, head)


def _kept(module: Module, source: NodeSource, goal: Goal) -> Found:
    """Yield the functions made in a loop with the loop's value as a default of a parameter."""
    del source, goal
    text = module.text
    for node in module.nodes:
        if not isinstance(node, ast.Lambda | ast.FunctionDef):
            continue
        args = node.args
        if args.vararg is not None or args.kwarg is not None or args.kwonlyargs:
            continue
        parameters = {a.arg for a in args.args}
        body = node.body if isinstance(node.body, list) else [node.body]
        read = {n.id for part in body for n in ast.walk(part) if isinstance(n, ast.Name)}
        looped = [n for around in module.around(node) for n in _targets(around)]
        names = [n for n in dict.fromkeys(looped) if n in read and n not in parameters]
        if not names:
            continue
        start, end = text.span(node)
        stop = text.span(node.body)[0] if isinstance(node, ast.Lambda) else end
        mark = text.text.find(":" if isinstance(node, ast.Lambda) else "(", start, stop)
        if isinstance(node, ast.FunctionDef):
            mark = text.text.find(")", mark, stop)
        more = ", ".join(f"{name}={name}" for name in names)
        lead = ", " if args.args else (" " if isinstance(node, ast.Lambda) else "")
        splice = Splice(mark, mark, lead + more)
        new = f"{text.text[start:mark]}{lead}{more}{text.text[mark:stop]}"
        old = text.text[start:stop]
        yield 2, Change("kept", node, old.strip(), new.strip(), (splice,), names[0])


def _targets(node: ast.AST) -> list[str]:
    """Return the names that a loop sets."""
    if not isinstance(node, LOOPS):
        return []
    targets = [node.target] if isinstance(node, ast.For) else [g.target for g in node.generators]
    return [n.id for t in targets for n in ast.walk(t) if isinstance(n, ast.Name)]


def _asked_for(module: Module, source: NodeSource, goal: Goal) -> Found:
    """Yield the statements that make a lazy object which nothing reads, with a list around it."""
    del goal
    lazy = {"map", "filter"} | {f.name for m in source.known_modules for f in _lazy_functions(m)}
    for node in module.nodes:
        value = node.value if isinstance(node, ast.Expr) else None
        is_lazy = isinstance(value, ast.Call) and called_name(value) in lazy
        if value is not None and (is_lazy or isinstance(value, ast.GeneratorExp)):
            code = module.text.code(value)
            new = f"list{code}" if isinstance(value, ast.GeneratorExp) else f"list({code})"
            yield 2, of_piece(module, "asked_for", value, new)


def _lazy_functions(module: Module) -> Iterator[Function]:
    """Yield the functions that return a map, a filter or a generator."""
    for function in (n for n in module.nodes if isinstance(n, Function)):
        values = [n.value for n in ast.walk(function) if isinstance(n, ast.Return)]
        if any(
            isinstance(v, ast.GeneratorExp)
            or (isinstance(v, ast.Call) and dotted(v.func) in ("map", "filter"))
            for v in values
        ):
            yield function


def _plain(module: Module, source: NodeSource, goal: Goal) -> Found:
    """Yield the file without a yield whose value nothing uses."""
    del source, goal
    for node in module.nodes:
        if isinstance(node, ast.Expr) and isinstance(node.value, ast.Yield | ast.YieldFrom):
            yield 3, of_piece(module, "yields", node, "pass")
            if owns_lines(module, node):
                rows = range(node.lineno, (node.end_lineno or node.lineno) + 1)
                gone = tuple(module.text.without(row) for row in rows)
                yield 2, Change("yields", node, module.line(node.lineno), "", gone)


def _given_back(module: Module, source: NodeSource, goal: Goal) -> Found:
    """Yield calls that get back the number which a function changes only for itself."""
    del source, goal
    text = module.text
    for node in module.nodes:
        call = node.value if isinstance(node, ast.Expr) else None
        function = module.functions.get(dotted(call.func)) if isinstance(call, ast.Call) else None
        if not isinstance(call, ast.Call) or function is None or call.keywords:
            continue
        inside = [n for statement in function.body for n in ast.walk(statement)]
        changed = {name for n in inside for name in targets_of(n) if "." not in name}
        names = [a.arg for a in function.args.args]
        last = function.body[-1]
        if any(isinstance(n, ast.Return) for n in inside) or not owns_lines(module, last):
            continue
        for name, given in zip(names, call.args, strict=False):
            if name in changed and is_name(given):
                indent = indent_of(text.line(last.lineno))
                put = text.before((last.end_lineno or 0) + 1, f"{indent}return {name}")
                new = f"{text.code(given)} = {text.code(call)}"
                splices = (put, text.swap(call, new))
                yield 1, Change("given_back", call, text.code(call), new, splices, text.code(given))


def _copied(module: Module, source: NodeSource, goal: Goal) -> Found:
    """Yield copies of the objects that an assignment, or an append, gives a second name."""
    del source, goal
    text = module.text
    line = imported(module, "import copy")
    for node in module.nodes:
        call = node.value if isinstance(node, ast.Expr) else None
        value = node.value if isinstance(node, ast.Assign) else None
        if isinstance(call, ast.Call) and called_name(call) == "append" and len(call.args) == 1:
            value = call.args[0]
        if value is not None and is_name(value) and line is not None:
            new = f"copy.copy({text.code(value)})"
            splices = (line, text.swap(value, new))
            yield 3, Change("copied", value, text.code(value), new, splices)


def _ends_of_lists(module: Module, source: NodeSource, goal: Goal) -> Found:
    """Yield the other end of a list in the calls of pop()."""
    del source, goal
    text = module.text
    for node in module.nodes:
        if isinstance(node, ast.Call) and called_name(node) == "pop" and not node.keywords:
            first = node.args[0] if len(node.args) == 1 else None
            if not node.args:
                new = f"{text.code(node.func)}(0)"
            elif isinstance(first, ast.Constant) and first.value == 0:
                new = f"{text.code(node.func)}()"
            else:
                continue
            yield 1, of_piece(module, "end_of_list", node, new)


SORTS: tuple[Sort, ...] = (_kept, _given_back, _copied, _ends_of_lists, _asked_for, _plain, _once)
