"""What a followed run of a node that counts shows, by the rules (grader/explain/rules.py)."""

from __future__ import annotations

import ast

from grader.explain.facts import Facts
from grader.explain.rules import explained
from grader.package.source.module import Module
from grader.package.source.names import calls_in, module_name, named_in
from grader.package.source.node import NodeSource
from grader.report.model import CheckResult
from grader.run.variants import Trace, Watched, trace_node
from grader.sandbox.base import Sandbox
from grader.verdict.evidence import Evidence
from grader.verdict.found_change import Fact
from grader.verdict.node_files import source_of_node

SECONDS = 5.0
"""The most processor time of the followed run."""
LONGEST_CODE = 4  # pieces of code of one condition whose values are asked for
FOLLOWED = ("run.no_lines", "run.stops", "run.twice", "run.wrong_period")
"""The symptoms for which a followed run may show the reason."""


def trace_in(sandbox: Sandbox, until: float, evidence: Evidence) -> Trace | None:
    """Follow a node in a sandbox whose workspace has been built; None if too little time is left.

    `until` is of the run's clock.
    """
    source = source_of_node(evidence)
    if source is None or source.main is None or until - sandbox.run_clock.now() < SECONDS:
        return None
    return trace_node(
        sandbox,
        module_name(source.entry.path),
        evidence.assignment.function,
        [module.path for module in source.known_modules],
        period=evidence.assignment.output.period,
        seconds=SECONDS,
        conditions=conditions_of(source),
    )


def conditions_of(source: NodeSource) -> list[Watched]:
    """Return the conditions of the files, and the lines that set something, with the names in them."""
    found = []
    for module in source.known_modules:
        for part in module.nodes:
            if isinstance(part, ast.If | ast.While):
                found.append(_watched(module, part, part.test))
            elif isinstance(part, ast.Assign | ast.AugAssign):
                found.append(_watched(module, part, part.value))
    return [one for one in found if one.code]


def _watched(module: Module, part: ast.stmt, read: ast.expr) -> Watched:
    called = {call.func for call, _ in calls_in(read)}
    code = dict.fromkeys(module.text.code(n) for n in named_in(read) if n not in called)
    return Watched(
        module.path, part.lineno, read.end_lineno or part.lineno, tuple(code)[:LONGEST_CODE]
    )


def fact_behind(evidence: Evidence, result: CheckResult) -> Fact | None:
    """Return what a followed run explains of a failed check; None if that is nothing."""
    seen = next((one.id for one in result.mistakes if one.id in FOLLOWED), "")
    use = next((use for use in evidence.assignment.checks if use.id == result.id), None)
    trace = evidence.trace if seen and not evidence.assignment.runs else None
    source = source_of_node(evidence)
    if trace is None or source is None or use is None:
        return None
    return fact_of(Facts(source, trace, evidence.run, use), seen)


def fact_of(facts: Facts, symptom: str) -> Fact | None:
    """Return what the facts explain of a symptom; None if that is nothing."""
    told = explained(facts, symptom)
    if told is None:
        return None
    rule, (place, values) = told
    plain = {
        name: str(value) if isinstance(value, str) else value for name, value in values.items()
    }
    return Fact(rule.id, *place, plain)
