"""The error that an except hides, if the source shows it for certain."""

from __future__ import annotations

import ast
from dataclasses import replace

from grader.course.assignment import Assignment
from grader.mistakes.fixes import node_order, node_try
from grader.mistakes.fixes.case import Case, Finding
from grader.mistakes.recognised import Raised, RecognisedMistake
from grader.package.edit.files import Files
from grader.package.source.names import calls_in, last_part, own_name
from grader.package.source.node import NodeSource
from grader.package.source.sure_errors import sure_error
from grader.report.model import Where


def hidden_error(
    source: NodeSource, assignment: Assignment, tried: ast.Try | ast.With
) -> tuple[str, int, RecognisedMistake] | None:
    """Return the error that a try raises for certain, its line, and the mistake behind it."""
    from grader.mistakes.recognise import behind_error  # noqa: PLC0415 - reads the whole catalogue

    for body in hidden_bodies(source, tried):
        found = sure_error(source, body)
        if found is None:
            continue
        error, line = found
        where = Where(file=source.module_of(tried).path, line=line)
        mistake = behind_error(Raised(error, where, source, assignment))
        if mistake is not None:
            return error, line, mistake
    return None


def hidden_bodies(source: NodeSource, tried: ast.Try | ast.With) -> list[list[ast.stmt]]:
    """Return the lines whose errors a try hides: its own, and those of what it runs in main.

    It runs the constructor if it creates the node, and the callback if it spins.
    """
    bodies = _with_called(source, tried, tried.body)
    if source.function_around(tried) is not source.main:
        return bodies
    name = source.node_class.name if source.node_class is not None else ""
    called = {last_part(n) for statement in tried.body for _, n in calls_in(statement)}
    start = source.methods.get("__init__") if name in called else None
    callback = source.callback if called & {*node_order.SPINS} else None
    run = [function for function in (start, callback) if function is not None]
    module = source.module_of(tried)
    of_run = [f.body for f in run if source.module_of(f) is module]
    return [*bodies, *(b for body in of_run for b in _with_called(source, tried, body))]


def _with_called(
    source: NodeSource, tried: ast.Try | ast.With, body: list[ast.stmt]
) -> list[list[ast.stmt]]:
    """Return some lines, and those of the node's methods that they call in any case."""
    plain = [s for s in body if isinstance(s, ast.Expr | ast.Assign | ast.AugAssign)]
    called = [source.method(own_name(c.func)) for s in plain for c, _ in calls_in(s)]
    module = source.module_of(tried)
    return [body, *(m.body for m in called if m is not None and module.has(m))]


def corrected(case: Case, *, keeps_try: bool = False) -> Files | None:
    """Correct the hidden error, and delete what hides it, unless the try is to stay."""
    from grader.mistakes.catalogue import fixes_for  # noqa: PLC0415 - reads the whole catalogue

    node, module = case.node, case.module
    for tried in module.nodes if node is not None and module is not None else ():
        if not isinstance(tried, ast.Try) or node is None:
            continue
        lines = [s.lineno for s in tried.body] if keeps_try else [h.lineno for h in tried.handlers]
        if case.finding.line not in lines:
            continue
        found = hidden_error(node, case.assignment, tried)
        where = found[2].where if found is not None else None
        if found is None or where is None:
            return None
        params = dict(found[2].params)
        finding = Finding(case.finding.check, found[2].kind, params, where.file, where.line)
        for fix in fixes_for(finding):
            files = fix(replace(case, finding=finding))
            if files is not None:
                return files if keeps_try else _shown(replace(case, files=files))
    return None


def _shown(case: Case) -> Files:
    """Delete the except that hides the error, or let it catch only Ctrl+C."""
    return node_try.without_try(case) or node_try.narrowed(case) or case.files
