"""Operators of places: a statement of a block runs earlier, later, or in another block."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from dataclasses import replace
from itertools import product

from grader.base.i18n.message import msg
from grader.change.operator import SIMPLE, Made, Operator, Site, is_text, moved, operator
from grader.package.source.names import dotted


@operator(
    "out",
    cost=2,
    why=msg("{name} is in the block: it runs only when the block does."),
    fix=msg("Move the line {name} out of the block: as far to the left as the head of the block."),
)
def out(site: Site) -> Iterator[Made]:
    """Yield the last statement of a block below the block."""
    for node in site.of((ast.If, ast.For, ast.While)):
        assert isinstance(node, ast.If | ast.For | ast.While)
        for block in (node.body, node.orelse):
            if block and isinstance(block[-1], ast.Expr | ast.Assign | ast.AugAssign | ast.Return):
                last = block[-1]
                end = (node.end_lineno or node.lineno) + 1
                yield moved(site, last, end, site.indent(node))


@operator(
    "into",
    cost=4,
    hides=True,
    why=msg("{name} runs each time. It belongs to the condition above it."),
    fix=msg("Move the line {name} to the end of the lines that run only if {written}."),
)
def into(site: Site) -> Iterator[Made]:
    """Yield a statement as the last one of the block above it."""
    for function in site.functions:
        for statement in site.simple(function):
            block = site.block(statement)
            at = block.index(statement)
            before = block[at - 1] if at else None
            if isinstance(before, ast.If | ast.For | ast.While):
                test = site.code(before.iter if isinstance(before, ast.For) else before.test)
                other = f"not ({test})"
                last = (before.orelse or before.body)[-1]
                made = moved(site, statement, statement.lineno, site.indent(last))
                yield replace(made, written=other if before.orelse else test)
                if before.orelse:
                    end = (before.body[-1].end_lineno or 0) + 1
                    made = moved(site, statement, end, site.indent(before.body[-1]))
                    yield replace(made, written=test)


@operator(
    "earlier",
    cost=2,
    hides=True,
    why=msg(
        "Lines run from top to bottom: {name} comes too late, or too early, for what it is for."
    ),
    fix=msg("Move the line {name} to line {written}."),
)
def earlier(site: Site) -> Iterator[Made]:
    """Yield a plain statement above others of its block, below a condition, or what self keeps at the end."""
    for function in site.functions:
        for statement in site.simple(function):
            block = site.block(statement)
            at = block.index(statement)
            for to in range(max(0, at - 3), at):
                other = block[to]
                if not is_text(other):
                    indent = site.indent(statement)
                    yield moved(site, statement, other.lineno, indent, more=at - to - 1)
            kept = isinstance(statement, ast.Assign) and dotted(statement.targets[0])
            last = block[-2] if isinstance(block[-1], ast.Return) else block[-1]
            if (
                kept
                and kept.startswith("self.")
                and isinstance(last, SIMPLE)
                and last in block[at + 1 :]
            ):
                end = (last.end_lineno or last.lineno) + 1
                yield moved(site, statement, end, site.indent(statement))
            for below in block[at + 1 : at + 3]:
                if not isinstance(below, SIMPLE):
                    line = (below.end_lineno or below.lineno) + 1
                    yield moved(site, statement, line, site.indent(statement))


@operator(
    "split",
    cost=2,
    hides=True,
    why=msg("These lines belong to a part of the condition above alone: {written}"),
    fix=msg("Above {name}, insert the line {written}."),
)
def split(site: Site) -> Iterator[Made]:
    """Yield a condition of its own, a part of an and, for the last lines of a block."""
    for node in site.of(ast.If):
        if not isinstance(node, ast.If) or not isinstance(node.test, ast.BoolOp):
            continue
        parts = node.test.values if isinstance(node.test.op, ast.And) else []
        for part, below in product(parts, node.body[1:]):
            row = f"{site.indent(node)}if {site.code(part)}:"
            put = site.module.text.before(below.lineno, row)
            yield Made(below, site.module.line(below.lineno), row.strip(), (put,))


@operator(
    "no_else",
    cost=2,
    hides=True,
    why=msg("{name} in this else takes back what the lines above have found."),
    fix=msg("Remove this else with the line {name}."),
)
def no_else(site: Site) -> Iterator[Made]:
    """Yield a condition without its else, if that sets what a condition above it sets too."""
    for node in site.of(ast.If):
        last = node.orelse[0] if isinstance(node, ast.If) and len(node.orelse) == 1 else None
        if not isinstance(node, ast.If) or not isinstance(last, ast.Assign):
            continue
        block = site.block(node)
        above = [one for one in block[: block.index(node)] if isinstance(one, ast.If)]
        names = {
            dotted(n.targets[0]) for one in above for n in one.body if isinstance(n, ast.Assign)
        }
        if dotted(last.targets[0]) in names:
            first, end = (node.body[-1].end_lineno or 0) + 1, (last.end_lineno or 0) + 1
            gone = tuple(site.module.text.without(row) for row in range(first, end))
            yield Made(last, site.code(last), "", gone)


OPERATORS: tuple[Operator, ...] = (out, into, earlier, split, no_else)
