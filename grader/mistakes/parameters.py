"""Errors at the parameters of a node: one that is not declared, and one without `.value`."""

from __future__ import annotations

import ast
import re

from grader.base.nearest import nearest
from grader.mistakes.recognised import Raised, RecognisedMistake
from grader.package.source.declared import declared, declares_others
from grader.package.source.names import called_name, calls_in
from grader.package.source.place import statement_at
from grader.report.model import Where


def undeclared(raised: Raised, match: re.Match[str]) -> RecognisedMistake:
    """A parameter is used that the node has not declared, or not yet."""
    name, source = match["name"], raised.source
    known = {p.name: p for p in declared(source)}
    close = "" if declares_others(source) or name in known else nearest(name, known, cutoff=0.7)
    asked = {str(one.with_.get("name", "")) for one in raised.assignment.checks}
    if close and name in asked and close not in asked:
        made = raised.source.module_of(known[close].call)
        params = {"name": close, "close": name, "written": name}
        where = Where(file=made.path, line=known[close].call.lineno)
        words = {**raised.words, **params, "row": ""}
        return RecognisedMistake(
            kind="parameter.not_declared",
            params=params,
            words=words,
            variant="declared",
            where=where,
        )
    params = {"name": name, "close": close, "written": close} if close else {"name": name}
    row = known[name].call.lineno if name in known else ""
    variant = "misspelt" if close else "late" if name in known else ""
    words = {**raised.words, "name": name, "close": close, "row": str(row)}
    return RecognisedMistake(
        kind="parameter.not_declared",
        params=params,
        words=words,
        variant=variant,
        where=raised.where,
    )


def parameter_object(raised: Raised, match: re.Match[str]) -> RecognisedMistake:
    """A Parameter is used as a number: name the call that returns it, on this line or the only one."""
    del match
    statement = statement_at(raised.module, raised.line)
    here = [call for call, _ in calls_in(statement)] if statement is not None else []
    asked = [call for call in raised.module.nodes if isinstance(call, ast.Call)]
    for calls in (here, asked):
        found = [c for c in calls if called_name(c) in ("get_parameter", "declare_parameter")]
        bare = [
            c for c in found if isinstance(raised.module.parents.get(c), ast.BinOp | ast.Assign)
        ]
        first = (bare or found)[0] if found and (calls is here or len(bare) == 1) else None
        if first is not None:
            code = raised.module.text.code(first)
            params = {"name": code, "written": f"{code}.value"}
            return raised.finding("parameter_object", at=first, params=params)
    code = "self.get_parameter('…')"
    return raised.finding("parameter_object", name=code, written=f"{code}.value")
