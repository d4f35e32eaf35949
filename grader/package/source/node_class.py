"""Which class of a package's modules is the node, and which classes belong to it."""

from __future__ import annotations

import ast
from collections.abc import Iterator, Sequence

from grader.package.source.module import Module
from grader.package.source.names import calls_in, dotted, last_part

USED_BY_NODES = ("self.create_timer", "self.get_logger")


def module_with_node(modules: Sequence[Module]) -> Module:
    """Return the module that has the node's class; the first one if none has.

    The first module is the entry point's, the others are those that it imports.
    """
    for fits in (_is_node, acts_as_node):
        found = next((m for m in modules if any(fits(c) for c in m.classes)), None)
        if found is not None:
            return found
    if modules[0].classes:
        return modules[0]
    return next((m for m in modules if m.uses_ros and m.classes), modules[0])


def class_of_node(module: Module, made: set[str]) -> ast.ClassDef | None:
    """Return the class that is the node, or was meant to be; None if there is no class.

    `made` are the names that the entry function calls: they tell several nodes apart. Of several
    that it calls, the first one that counts is the node.
    """
    for fits in (derives_from_node, acts_as_node):
        found = [c for c in module.classes if fits(c)]
        known = {c for each in found for c in family_of(each, module)}
        below = [c for c in module.classes if c in known and c.name in made]
        called = [c for c in found if c.name in made] or below or found[:1]
        if found:
            return next((c for c in called if _counts(c)), called[0])
    return module.classes[0] if module.classes else None


def _counts(found: ast.ClassDef) -> bool:
    """Return whether a class adds to one of its attributes."""
    changed = [n for n in ast.walk(found) if isinstance(n, ast.AugAssign)]
    return any(isinstance(n.target, ast.Attribute) and isinstance(n.op, ast.Add) for n in changed)


def derives_from_node(found: ast.ClassDef) -> bool:
    """Return whether a base class is named like a node's."""
    return any(base.endswith("Node") for base in _bases(found))


def _is_node(found: ast.ClassDef) -> bool:
    """Return whether a class is derived from a node, or was meant to be."""
    return derives_from_node(found) or any(
        name.startswith(USED_BY_NODES) for _, name in calls_in(found)
    )


def acts_as_node(found: ast.ClassDef) -> bool:
    """Return whether a class uses itself as a node, or gives a name to its base class."""
    for call, name in calls_in(found):
        if name.startswith(USED_BY_NODES) or (name == "super().__init__" and call.args):
            return True
    return False


def _bases(found: ast.ClassDef) -> Iterator[str]:
    for base in found.bases:
        yield last_part(dotted(base))


def family_of(found: ast.ClassDef, module: Module) -> list[ast.ClassDef]:
    """Return a class with those of its file that it derives from, or that derive from it."""
    bases = {each: set(_bases(each)) for each in module.classes}
    by_name = {each.name: each for each in module.classes}
    derived: dict[str, list[ast.ClassDef]] = {}
    for each, names in bases.items():
        for name in names:
            derived.setdefault(name, []).append(each)
    family = {found: None}
    waiting = [found]
    for each in waiting:
        above = [by_name[name] for name in bases.get(each, ()) if name in by_name]
        new = [c for c in (*above, *derived.get(each.name, ())) if c not in family]
        family |= dict.fromkeys(new)
        waiting += new
    return list(family)
