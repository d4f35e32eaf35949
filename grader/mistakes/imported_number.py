"""The mistake of a number that is imported with from, and counted in its own module."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.example import INNER, LOG, NODE, STEP_LINE, example
from grader.mistakes.fixes import node_imports
from grader.mistakes.kind import Family
from grader.mistakes.recognised import RecognisedMistake, Suspect
from grader.package.edit.tree import Replace, Write
from grader.package.source.counter import declares, targets_of
from grader.package.source.module import Function, Module
from grader.package.source.own_imports import OwnImport, imports_of


def _copied(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a name of another module that is read here, and set anew by a function there."""
    found = list(_names(suspect))
    if len(found) != 1:
        return None
    statement, imported, other, change = found[0]
    module = imported.parts[-1]
    bound = {n.id for n in suspect.source.module_of(statement).nodes if isinstance(n, ast.Name)}
    if module in bound or len(imported.parts) < 2:
        return None
    written = f"{module}.{imported.name}"
    mistake = suspect.finding("number_imported", statement, name=imported.bound, written=written)
    words = {
        **mistake.words,
        "text": f"from {'.'.join(imported.parts[:-1])} import {module}",
        "path": other.path,
        "line": str(change.lineno),
    }
    return replace(mistake, words=words)


def _flag_copied(suspect: Suspect) -> RecognisedMistake | None:
    """The same of a name that a condition asks for."""
    found = _copied(suspect)
    name = str(found.params.get("name", "")) if found is not None else ""
    tests = [
        n.test
        for module in suspect.source.modules
        for n in module.nodes
        if isinstance(n, ast.If | ast.While)
    ]
    asked = {n.id for test in tests for n in ast.walk(test) if isinstance(n, ast.Name)}
    return found if name in asked else None


def _names(suspect: Suspect) -> Iterator[tuple[ast.stmt, OwnImport, Module, ast.stmt]]:
    """Yield the imports of a name that a log call can read, and where its module changes it."""
    source = suspect.source
    for module in source.modules:
        read = {n.id for n in module.nodes if isinstance(n, ast.Name)}
        for node in module.nodes:
            for imported in imports_of(node, module.path) if isinstance(node, ast.stmt) else ():
                if not imported.name or imported.bound not in read:
                    continue
                for other in (*source.modules, *source.beside):
                    change = _change(other, imported.name)
                    if other.path in imported.paths and isinstance(node, ast.stmt) and change:
                        yield node, imported, other, change


def _change(module: Module, name: str) -> ast.stmt | None:
    """Return where a function of a module sets a variable of the module anew."""
    for function in (n for n in module.nodes if isinstance(n, Function)):
        for node in ast.walk(function):
            changes = isinstance(node, ast.Assign | ast.AugAssign) and name in targets_of(node)
            if changes and isinstance(node, ast.stmt) and declares(function, name):
                return node
    return None


_node = Family("node", links.PYTHON_CLASSES)
KINDS = (
    _node(
        "number_imported",
        "counter",
        msg("A variable of another module is imported with from, and changed there later"),
        msg(
            "This line gives {name} the value that it has in {path} at that moment. When line {line} "
            "of {path} sets it anew, {name} in this file keeps the old value."
        ),
        msg(
            "Write {text} below the imports, and {written} instead of {name} where it is read: then its "
            "value is read from that module each time. Take {name} out of this import."
        ),
        behind={"run.constant_counter": _copied, "run.no_lines": _flag_copied},
        fixed_by=(node_imports.read_in_module,),
        examples=(
            example(
                "number_imported_with_from",
                Write(
                    f"{INNER}/ticks.py",
                    "count = 0\n\n\ndef add():\n    global count\n    count += 1\n",
                ),
                Replace(
                    NODE,
                    "import rclpy\n",
                    "from my_robot_controller.ticks import add, count\nimport rclpy\n",
                ),
                Replace(NODE, LOG, "self.get_logger().info(f'Hello time: {count}')"),
                Replace(NODE, STEP_LINE, "        add()\n"),
                fails="run.output",
            ),
        ),
    ),
)
