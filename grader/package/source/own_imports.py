"""What a module imports from its own package: the file, and the name that it is known by."""

from __future__ import annotations

import ast
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from grader.package.source.module import Function, Module


@dataclass(frozen=True)
class OwnImport:
    """An import from the own package: `name` of the module `parts` is bound as `bound`.

    `name` is "" for a module as a whole, "*" for all of its names.
    """

    parts: tuple[str, ...]
    name: str
    bound: str

    @property
    def paths(self) -> tuple[str, str]:
        """The files that the module can be, by their path in the package."""
        path = "/".join(self.parts)
        return f"{path}.py", f"{path}/__init__.py"


def own_imports(module: Module) -> Iterator[OwnImport]:
    """Yield what a file imports from its own package, whose folder its path begins with.

    What `from a import b` binds can be a name of the module a or the module a.b: both are yielded.
    """
    for node in module.nodes:
        yield from imports_of(node, module.path)


def imports_of(node: ast.AST, path: str) -> Iterator[OwnImport]:
    """Yield what a statement of the file at a path imports from its own package."""
    package = path.partition("/")[0]
    if isinstance(node, ast.ImportFrom):
        parts = _parts(node, path)
        for alias in node.names if parts[:1] == (package,) else ():
            bound = alias.asname or alias.name
            yield OwnImport(parts, alias.name, bound)
            yield OwnImport((*parts, alias.name), "", bound)
    elif isinstance(node, ast.Import):
        for alias in node.names:
            parts = tuple(alias.name.split("."))
            if parts[0] == package:
                yield OwnImport(parts, "", alias.asname or alias.name)


def _parts(node: ast.ImportFrom, path: str) -> tuple[str, ...]:
    """Return the absolute name of the module that a `from` names; () if it leaves the package."""
    named = tuple(node.module.split(".")) if node.module else ()
    if not node.level:
        return named
    folders = tuple(path.split("/")[:-1])
    kept = len(folders) - node.level + 1
    return (*folders[:kept], *named) if kept > 0 else ()


def entry_function(name: str, modules: Sequence[Module]) -> tuple[Module, Function] | None:
    """Return a function of the first module, or the one that it imports under that name."""
    entry = modules[0]
    if name in entry.functions:
        return entry, entry.functions[name]
    for found in own_imports(entry):
        wanted = name if found.name == "*" else found.name
        if found.bound in (name, "*"):
            for module in modules:
                if module.path in found.paths and wanted in module.functions:
                    return module, module.functions[wanted]
    return None
