"""The node's file as a syntax tree: its class, methods and calls, for fixes of mistakes in runs."""

from __future__ import annotations

import ast
from collections.abc import Iterable
from dataclasses import dataclass

from grader.mistakes.fixes.case import Case
from grader.package.edit.files import Files
from grader.package.edit.text import SourceText, Splice
from grader.package.source.python import can_parse

LEVELS = ("debug", "info", "warn", "warning", "error", "fatal")


@dataclass(frozen=True)
class NodeCode:
    """A node's file that Python can parse and that has one class."""

    case: Case
    source: SourceText
    tree: ast.Module
    node_class: ast.ClassDef

    def changed(self, *splices: Splice) -> Files | None:
        """Return the files after changes to this one; None if Python cannot parse the result."""
        new = self.source.spliced(splices) if splices else None
        if new is None or not can_parse(new):
            return None
        return self.case.with_data(self.case.node_path, new)

    def method(self, name: str) -> ast.FunctionDef | None:
        """Return a method of the class; None if there is none, or more than one."""
        body = self.node_class.body
        found = [s for s in body if isinstance(s, ast.FunctionDef) and s.name == name]
        return found[0] if len(found) == 1 else None

    @property
    def methods(self) -> list[ast.FunctionDef]:
        """The methods of the class."""
        return [s for s in self.node_class.body if isinstance(s, ast.FunctionDef)]

    @property
    def main(self) -> ast.FunctionDef | None:
        """The function that the entry point calls, if it is in this file."""
        name = self.case.assignment.target.partition(":")[2]
        found = [s for s in self.tree.body if isinstance(s, ast.FunctionDef) and s.name == name]
        return found[0] if len(found) == 1 else None

    def calls(self, *names: str, within: ast.AST | None = None) -> list[ast.Call]:
        """Return the calls of a function or method of one of these names, in order."""
        found = [n for n in ast.walk(within or self.tree) if isinstance(n, ast.Call)]
        named = [call for call in found if called(call) in names]
        return sorted(named, key=lambda call: (call.lineno, call.col_offset))

    @property
    def timer(self) -> ast.Call | None:
        """The one call of create_timer."""
        found = self.calls("create_timer")
        return found[0] if len(found) == 1 else None

    @property
    def log_call(self) -> ast.Call | None:
        """The one call of the node's logger, if it has exactly one argument."""
        found = [c for c in self.calls(*LEVELS) if "get_logger" in ast.unparse(c.func)]
        return found[0] if len(found) == 1 and len(found[0].args) == 1 else None

    def counters(self) -> dict[str, ast.Constant]:
        """Return the attributes of self that __init__ sets to an integer literal."""
        init = self.method("__init__")
        found: dict[str, ast.Constant] = {}
        for statement in init.body if init else []:
            if isinstance(statement, ast.Assign) and len(statement.targets) == 1:
                name, value = own(statement.targets[0]), statement.value
                if name and isinstance(value, ast.Constant) and type(value.value) is int:
                    found[name] = value
        return found

    def changes_of(self, name: str) -> list[ast.stmt]:
        """Return the statements outside of __init__ that assign to an attribute of self."""
        inside = {id(n) for n in ast.walk(self.method("__init__") or ast.Pass())}
        found: list[ast.stmt] = []
        for node in ast.walk(self.tree):
            if id(node) in inside:
                continue
            targets: Iterable[ast.expr] = ()
            if isinstance(node, ast.Assign):
                targets = node.targets
            elif isinstance(node, ast.AugAssign | ast.AnnAssign):
                targets = (node.target,)
            if any(own(target) == name for target in targets) and isinstance(node, ast.stmt):
                found.append(node)
        return found


def called(call: ast.Call) -> str:
    """Return the last part of the name of the called function."""
    function = call.func
    if isinstance(function, ast.Attribute):
        return function.attr
    return function.id if isinstance(function, ast.Name) else ""


def own(node: ast.expr | None) -> str:
    """Return x of `self.x`; "" for anything else."""
    plain = isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name)
    if plain and isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name):
        return node.attr if node.value.id == "self" else ""
    return ""


def read_node(case: Case) -> NodeCode | None:
    """Return the node's file; None if it cannot be parsed or does not have exactly one class."""
    parsed = case.parsed(case.node_path)
    if parsed is None:
        return None
    source, tree = parsed
    classes = [s for s in tree.body if isinstance(s, ast.ClassDef)]
    return NodeCode(case, source, tree, classes[0]) if len(classes) == 1 else None
