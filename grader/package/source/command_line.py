"""Whether a package's node reads the arguments of its command line itself."""

from __future__ import annotations

import ast
from collections.abc import Iterator, Sequence

from grader.package.intake.model import SourceFile
from grader.package.source.module import Module
from grader.package.source.names import calls_in, dotted, last_part
from grader.package.source.node_modules import node_modules
from grader.package.source.telling import is_passed_on

READERS = {"parse_args", "parse_known_args", "getopt", "gnu_getopt", "docopt", "Fire"}
FRAMEWORKS = {"click", "fire", "typer"}


def reads_command_line(files: Sequence[SourceFile]) -> bool:
    """Return whether a node does more with its arguments than to hand them to rclpy.

    It may then work only without the arguments that the grader adds (`--ros-args …`), as a person
    at a terminal starts it.
    """
    return any(_reads(module) for module in node_modules(files))


def _reads(module: Module) -> bool:
    if any(last_part(name) in READERS for _, name in calls_in(module.tree)):
        return True
    if any(name in FRAMEWORKS for name in _imported(module)):
        return True
    return any(
        isinstance(node, ast.Attribute | ast.Name)
        and last_part(dotted(node)) == "argv"
        and not is_passed_on(module, node)
        for node in module.nodes
    )


def _imported(module: Module) -> Iterator[str]:
    """Yield the top-level packages that a module imports."""
    for node in module.nodes:
        if isinstance(node, ast.Import):
            yield from (alias.name.partition(".")[0] for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            yield (node.module or "").partition(".")[0]
