"""Automatic mutants: made from the solution and the assignment only, and deterministic."""

from __future__ import annotations

import ast
from collections import Counter
from collections.abc import Iterator

from grader.base.errors import AssignmentError
from grader.course.assignment import Assignment
from grader.package.edit.tree import Edit, Tree, Write, text_of
from grader.package.source.node import read_node
from grader.validate import in_files, in_setup, in_source
from grader.validate.mutant import Mutant
from grader.validate.spots import Code


def generate(original: Tree, assignment: Assignment) -> Iterator[Mutant]:
    """Yield the automatic mutants of a solution; names are unique, the order is fixed.

    A change after which Python cannot parse the node is a mutant too: it must fail at
    `source.node_file`. Mutants that no check of the assignment could detect are left out.
    Raises AssignmentError if the solution lacks a file or cannot be parsed.
    """
    for path in in_files.needed(assignment):
        if path not in original:
            raise AssignmentError(f"the solution of {assignment.id} has no file {path}")
    checks = [use.id for use in assignment.checks]
    used: Counter[str] = Counter()
    for name, edits, families in _made(original, assignment):
        used[name] += 1
        unique = name if used[name] == 1 else f"{name} #{used[name]}"
        mutant = Mutant(name=unique, edits=edits, families=families)
        if any(mutant.is_hit_by(check) for check in checks):
            yield mutant


def _made(
    original: Tree, assignment: Assignment
) -> Iterator[tuple[str, tuple[Edit, ...], tuple[str, ...]]]:
    yield from in_files.mutants_of(original, assignment)
    setup = _read(original, in_files.SETUP)
    for name, text, families in in_setup.mutants_of(setup, assignment):
        yield name, (Write(in_files.SETUP, text.encode()),), families
    path = f"{assignment.package}/{assignment.node_file}"
    for place in _files_of_node(original, path, assignment):
        for name, text, families in in_source.mutants_of(_read(original, place), assignment):
            # (of these files source.node_file reads only the required one)
            unreadable = ("source.node_file",) if place == path else ("run.",)
            expected = families if _parses(text) else unreadable
            yield name, (Write(place, text.encode()),), expected


def _files_of_node(original: Tree, path: str, assignment: Assignment) -> list[str]:
    """Return the files that the node is in: the required one first, and that of its class."""
    _read(original, path)
    files = {name: entry.data for name, entry in original.items() if not entry.target}
    node = read_node(files.get, path, assignment.function)
    others = [other for other in node.paths if other != path] if node is not None else []
    return [path, *others]


def _read(original: Tree, path: str) -> Code:
    code = Code(text_of(original, path))
    try:
        compile(code.tree, path, "exec")
    except (SyntaxError, ValueError) as error:
        raise AssignmentError(f"the solution's {path} is not valid Python: {error}") from None
    return code


def _parses(text: str) -> bool:
    try:
        compile(ast.parse(text), "<mutant>", "exec")
    except (SyntaxError, ValueError):
        return False
    return True
