"""Mistakes in which a value is kept on a method or a function, as a static variable of C."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from dataclasses import dataclass, replace

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.example import NODE, STEP_LINE, example
from grader.mistakes.fixes.case import Case
from grader.mistakes.fixes.lines import own_lines
from grader.mistakes.kind import Family
from grader.mistakes.recognised import Raised, RecognisedMistake
from grader.package.edit.files import Files
from grader.package.edit.text import indent_of
from grader.package.edit.tree import Replace
from grader.package.source.counter import targets_of
from grader.package.source.names import dotted, own_name
from grader.package.source.node import NodeSource
from grader.package.source.place import block_of, function_at, statement_at

NO_ATTRIBUTE = (
    r"AttributeError: '(?P<type>method|function)' object has no attribute '(?P<name>\w{1,120})'"
)


@dataclass(frozen=True)
class Kept:
    """The uses of an attribute of a method through self, and the lines that set it otherwise."""

    method: str
    attribute: str
    through_self: tuple[ast.Attribute, ...]
    in_class: tuple[ast.Assign, ...]

    @property
    def code(self) -> str:
        """The attribute as a method of the class reads it."""
        return f"self.{self.method}.{self.attribute}"

    @property
    def is_set(self) -> bool:
        """Whether a line sets it, so that it is meant to be a variable."""
        return bool(self.in_class) or any(isinstance(u.ctx, ast.Store) for u in self.through_self)


def kept_on(source: NodeSource, method: str, attribute: str) -> Kept:
    """Return where the class uses an attribute of one of its methods."""
    uses = [
        n
        for n in source.own_nodes
        if isinstance(n, ast.Attribute) and n.attr == attribute and own_name(n.value) == method
    ]
    names = {f"{method}.{attribute}"}
    in_class = [
        s for s in source.class_body if isinstance(s, ast.Assign) and names & {*targets_of(s)}
    ]
    return Kept(method, attribute, tuple(uses), tuple(in_class))


def _read_at(raised: Raised, attribute: str) -> Iterator[ast.Attribute]:
    statement = statement_at(raised.module, raised.line)
    for part in ast.walk(statement) if statement is not None else ():
        if isinstance(part, ast.Attribute) and part.attr == attribute:
            yield part


def _on_method(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The line sets or reads an attribute of a method that another line sets."""
    source = raised.source
    for part in _read_at(raised, match["name"]):
        method = own_name(part.value)
        if method not in source.methods or match["type"] != "method":
            continue
        kept = kept_on(source, method, part.attr)
        if not kept.is_set:
            continue
        new = _new_name(source, kept)
        params = {"name": kept.code, "written": new, "method": method, "attribute": part.attr}
        found = raised.finding("attribute_of_method", at=part, params=params)
        module = source.module_of(part)
        value = module.text.code(kept.in_class[0].value) if kept.in_class else raised.words["start"]
        line = str(kept.in_class[0].lineno) if kept.in_class else ""
        rows = sorted({use.lineno for use in kept.through_self})
        words = {**found.words, "value": value, "line": line, "lines": ", ".join(map(str, rows))}
        init = source.method("__init__")
        in_init = any(
            isinstance(u.ctx, ast.Store) and source.function_around(u) is init
            for u in kept.through_self
        )
        variant = "in_class" if kept.in_class else "in_init" if in_init and init else ""
        return replace(found, words=words, variant=variant)
    return None


def _new_name(source: NodeSource, kept: Kept) -> str:
    """Return a name for the attribute of the node that nothing else has."""
    taken = {*source.attributes, *source.methods}
    name = kept.attribute
    while name in taken:
        name += "_"
    return f"self.{name}"


def _on_function(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The line adds to an attribute of a function of the file that no line sets."""
    module = raised.module
    statement = statement_at(module, raised.line)
    if not isinstance(statement, ast.AugAssign) or match["type"] != "function":
        return None
    name = dotted(statement.target)
    function, _, attribute = name.partition(".")
    nodes = [n for n in module.nodes if isinstance(n, ast.Assign)]
    if function not in module.functions or attribute != match["name"]:
        return None
    if any(name in targets_of(n) for n in nodes):
        return None
    last = str(module.functions[function].end_lineno)
    params = {"name": name, "method": function, "line": last}
    params["written"] = f"{name} = {raised.words['start']}"
    found = raised.finding("attribute_of_method", at=statement, params=params)
    return replace(found, variant="function")


def _kept(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    return _on_method(raised, match) or _on_function(raised, match)


def _of_node(case: Case) -> Files | None:
    """Keep the value in an attribute of the node, which __init__ sets."""
    node, params = case.node, case.finding.params
    method, attribute = (str(params.get(key, "")) for key in ("method", "attribute"))
    init = node.method("__init__") if node is not None else None
    if node is None or init is None or not attribute:
        return None
    kept, new, module = kept_on(node, method, attribute), str(params["written"]), node.module
    splices = [module.text.swap(use, new) for use in kept.through_self]
    if not all(module.has(use) for use in kept.through_self):
        return None
    if not kept.in_class:
        first = min(kept.through_self, key=lambda use: use.lineno)
        is_first = isinstance(first.ctx, ast.Store) and function_at(module, first.lineno) is init
        return case.changed(module, *splices) if is_first else None
    super_init = node.super_init
    around = statement_at(module, super_init.lineno) if super_init is not None else None
    rows = own_lines(module, kept.in_class[0])
    if len(kept.in_class) != 1 or around is None or around not in init.body or rows is None:
        return None
    if len(block_of(module, kept.in_class[0])) == 1:
        return None
    indent = indent_of(module.text.line(around.lineno))
    value = module.text.code(kept.in_class[0].value)
    set_here = module.text.before(
        (around.end_lineno or around.lineno) + 1, f"{indent}{new} = {value}"
    )
    splices += [set_here, *(module.text.without(row) for row in rows)]
    return case.changed(module, *splices)


_node = Family("node", links.PYTHON_CLASSES)
KINDS = (
    _node(
        "attribute_of_method",
        "counter",
        msg("A value is kept on a method"),
        msg(
            "{method} is a method. Python lets no line set an attribute of a method through self. "
            "What must be kept between the calls belongs to the node: it is an attribute of self."
        ),
        msg(
            "Write {written} instead of {name} in all lines: {lines}. Set it in __init__, before "
            "the timer is created: {written} = {value}"
        ),
        whys={
            "function": msg(
                "{name} does not exist until a line assigns to it: += adds to a value that is "
                "already there."
            )
        },
        fixes={
            "in_init": msg("Write {written} instead of {name} in all lines: {lines}."),
            "in_class": msg(
                "Write {written} instead of {name} in all lines: {lines}. Set it in __init__, before "
                "the timer is created: {written} = {value}. Delete line {line}."
            ),
            "function": msg(
                "Write {written} below the function {method}, on a line of its own without "
                "indentation: {method} ends in line {line}."
            ),
        },
        raised={NO_ATTRIBUTE: _kept},
        fixed_by=(_of_node,),
        examples=(
            example(
                "static_counter_of_method",
                Replace(NODE, "        self.counter_ = 0\n", ""),
                Replace(NODE, "str(self.counter_)", "str(self.timer_callback.count)"),
                Replace(
                    NODE,
                    STEP_LINE,
                    "        self.timer_callback.count += 1\n\n    timer_callback.count = 0\n",
                ),
                fails="run.output",
                blocks=("run.interrupt",),
            ),
            example(
                "counter_set_on_method",
                Replace(NODE, "self.counter_ = 0", "self.timer_callback.count = 0"),
                Replace(NODE, "str(self.counter_)", "str(self.timer_callback.count)"),
                Replace(NODE, "self.counter_ += 1", "self.timer_callback.count += 1"),
                fails="run.starts",
            ),
        ),
    ),
)
