"""The error that an except hides, if the source shows it for certain."""

from __future__ import annotations

import ast
from dataclasses import replace

from grader.course.assignment import Assignment
from grader.mistakes.fixes import node_try
from grader.mistakes.fixes.case import Case, Finding
from grader.mistakes.recognised import Raised, RecognisedMistake
from grader.package.edit.files import Files
from grader.package.source.node import NodeSource
from grader.package.source.sure_errors import sure_error
from grader.report.model import Where


def hidden_error(
    source: NodeSource, assignment: Assignment, tried: ast.Try
) -> tuple[str, int, RecognisedMistake] | None:
    """Return the error that a try raises for certain, its line, and the mistake behind it."""
    from grader.mistakes.recognise import behind_error  # noqa: PLC0415 - reads the whole catalogue

    found = sure_error(source, tried.body)
    if found is None:
        return None
    error, line = found
    where = Where(file=source.module_of(tried).path, line=line)
    mistake = behind_error(Raised(error, where, source, assignment))
    return (error, line, mistake) if mistake is not None else None


def corrected(case: Case) -> Files | None:
    """Correct the hidden error, and delete what hides it."""
    from grader.mistakes.catalogue import fixes_for  # noqa: PLC0415 - reads the whole catalogue

    node, module = case.node, case.module
    for tried in module.nodes if node is not None and module is not None else ():
        if not isinstance(tried, ast.Try) or node is None:
            continue
        if all(handler.lineno != case.finding.line for handler in tried.handlers):
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
                return node_try.without_try(replace(case, files=files)) or files
    return None
