"""An operator: what it changes in a program, what a text says of it, and why it corrects something.

It is a generator over the places of one file. Whether a change helps is not known here: a caller runs
the program with each.
"""

from __future__ import annotations

import ast
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from functools import cached_property

from grader.base.i18n.message import Template
from grader.package.edit.text import Splice
from grader.package.source.module import Function, Module
from grader.package.source.names import dotted
from grader.package.source.place import block_of, owns_lines

SIMPLE = ast.Expr | ast.Assign | ast.AugAssign | ast.AnnAssign


@dataclass(frozen=True)
class Wanted:
    """What the failed check asks for: plain numbers and texts, the fields of messages, types, and all fields' paths."""

    numbers: tuple[float, ...] = ()
    texts: tuple[str, ...] = ()
    fields: tuple[tuple[str, object], ...] = ()
    types: tuple[str, ...] = ()
    paths: tuple[str, ...] = ()


@dataclass(frozen=True, eq=False)
class Site:
    """One file of a node, with what the operators ask of it."""

    module: Module
    wanted: Wanted

    @cached_property
    def functions(self) -> list[Function]:
        """The functions and methods of the file."""
        return [n for n in self.module.nodes if isinstance(n, Function)]

    @cached_property
    def attributes(self) -> dict[str, list[ast.Attribute]]:
        """The places that set each attribute of self, by its name."""
        found: dict[str, list[ast.Attribute]] = {}
        for node in self.module.nodes:
            is_set = isinstance(node, ast.Attribute) and isinstance(node.ctx, ast.Store)
            if isinstance(node, ast.Attribute) and is_set and dotted(node.value) == "self":
                found.setdefault(node.attr, []).append(node)
        return found

    @cached_property
    def methods(self) -> dict[str, Function]:
        """The methods of the classes, by their names."""
        return {s.name: s for c in self.module.classes for s in c.body if isinstance(s, Function)}

    def of(self, kind: type[ast.AST] | tuple[type[ast.AST], ...]) -> Iterator[ast.AST]:
        """Yield the parts of a type, without the texts that only explain."""
        return (n for n in self.module.nodes if isinstance(n, kind))

    def code(self, node: ast.stmt | ast.expr) -> str:
        """Return what is written at a part."""
        return self.module.text.code(node)

    def function_of(self, node: ast.AST) -> Function | None:
        """Return the innermost function around a part."""
        return next((n for n in self.module.around(node) if isinstance(n, Function)), None)

    def statement(self, node: ast.AST) -> ast.stmt | None:
        """Return the innermost statement that a part is in, or that it is."""
        around = (node, *self.module.around(node))
        return next((n for n in around if isinstance(n, ast.stmt)), None)

    def block(self, statement: ast.stmt) -> list[ast.stmt]:
        """Return the statements beside a statement, with it."""
        return block_of(self.module, statement)

    def simple(self, function: ast.AST) -> list[ast.stmt]:
        """Return the plain statements of a function that have their lines for themselves."""
        found = [n for n in ast.walk(function) if isinstance(n, SIMPLE)]
        return sorted(
            (n for n in found if owns_lines(self.module, n) and not is_text(n)),
            key=lambda n: n.lineno,
        )

    def locals_of(self, function: Function) -> list[str]:
        """Return the names that a function gives a value, its parameters first."""
        names = [a.arg for a in function.args.args if a.arg != "self"]
        for node in ast.walk(function):
            if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store):
                names.append(node.id)
        return list(dict.fromkeys(names))

    def indent(self, statement: ast.stmt) -> str:
        """Return the blanks before a statement."""
        row = self.module.text.line(statement.lineno)
        return row[: len(row) - len(row.lstrip(" \t"))]


def is_text(node: ast.stmt) -> bool:
    """Whether a statement is a text alone, which only explains."""
    return isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant)


@dataclass(frozen=True)
class Made:
    """A change: the part that it is about, what a text names as old and new, and the splices."""

    at: ast.stmt | ast.expr
    name: str
    written: str
    splices: tuple[Splice, ...]
    more: int = 0  # that it costs in addition


Make = Callable[[Site], Iterator[Made]]


@dataclass(frozen=True)
class Operator:
    """One row of the table: `why` and `fix` are told with {name} and {written}.

    `shows` is of one that only shows the place: it could take away what the program is meant to do.
    One that `hides` can help by chance, with the mistake still there: it has to leave no other failure.
    A `certain` one hardly helps by chance: a rule of Python or ROS is its reason. An `untried` one shows
    only in a run of its own: two types on one topic cannot be in one process.
    """

    sort: str
    cost: int
    why: Template
    fix: Template
    make: Make = field(repr=False)
    shows: bool = False
    hides: bool = False
    certain: bool = False
    untried: bool = False


def operator(
    sort: str,
    *,
    cost: int,
    why: Template,
    fix: Template,
    shows: bool = False,
    hides: bool = False,
    certain: bool = False,
    untried: bool = False,
) -> Callable[[Make], Operator]:
    """Declare an operator; see `Operator`."""
    return lambda make: Operator(sort, cost, why, fix, make, shows, hides, certain, untried)


def swapped(
    site: Site, node: ast.stmt | ast.expr, new: str, *, more: int = 0, at: ast.expr | None = None
) -> Made:
    """Return the change of a part into other code."""
    return Made(at or node, site.code(node), new, (site.module.text.swap(node, new),), more)


def inserted(site: Site, below: ast.stmt, code: str, *, more: int = 0) -> Made:
    """Return the change that puts a line below a statement."""
    row = f"{site.indent(below)}{code}"
    put = site.module.text.before((below.end_lineno or below.lineno) + 1, row)
    return Made(below, site.module.line(below.lineno), code, (put,), more)


def above(site: Site, statement: ast.stmt, *rows: str, more: int = 0) -> Made:
    """Return the change that puts lines above a statement."""
    indent = site.indent(statement)
    put = site.module.text.before(statement.lineno, *(f"{indent}{row}" for row in rows))
    return Made(statement, site.module.line(statement.lineno), rows[0].strip(), (put,), more)


def moved(site: Site, statement: ast.stmt, line: int, indent: str, *, more: int = 0) -> Made:
    """Return the change that moves a statement before a line, with other blanks before it."""
    text = site.module.text
    rows = range(statement.lineno, (statement.end_lineno or statement.lineno) + 1)
    old = site.indent(statement)
    lines = [indent + text.line(row).removeprefix(old) for row in rows]
    gone = tuple(text.without(row) for row in rows)
    if len(site.block(statement)) == 1:
        gone = (text.swap(statement, "pass"),)
    put = text.before(line, *lines)
    name = site.module.line(statement.lineno)
    return Made(statement, name, str(line), (*gone, put), more)


def all_made(site: Site, table: Sequence[Operator]) -> Iterator[tuple[Operator, Made, str]]:
    """Yield every change of a file with its new text; each text once."""
    seen = {site.module.text.text}
    for row in table:
        for made in row.make(site):
            new = site.module.edited(made.splices)
            text = new.decode("utf-8", "replace") if new is not None else ""
            if text and text not in seen:
                seen.add(text)
                yield row, made, text
