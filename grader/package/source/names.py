"""Names as Python code writes them: of variables, attributes and called functions."""

from __future__ import annotations

import ast
from collections.abc import Iterable, Iterator

from grader.base.nearest import nearest

LONGEST_NAME = 20  # names, dots and calls; longer ones are ignored
SPINS = ("spin", "spin_once", "spin_until_future_complete")


def dotted(named: ast.AST) -> str:
    """Return a name as written: `rclpy.spin`, `self.get_logger().info`; "" for anything else."""
    node: ast.AST = named
    after = ""
    for _ in range(LONGEST_NAME):
        if isinstance(node, ast.Name):
            return node.id + after
        if isinstance(node, ast.Attribute):
            after = f".{node.attr}{after}"
            node = node.value
        elif isinstance(node, ast.Call):
            after = f"(){after}"
            node = node.func
        else:
            break
    return ""


def misnamed_init(names: Iterable[str]) -> str:
    """Return the file whose name is nearly `__init__.py`; "" if there is none."""
    return nearest("__init__.py", names, cutoff=0.75)


def last_part(name: str) -> str:
    """Return the part of a dotted name after its last dot."""
    return name.rpartition(".")[2]


def called_name(call: ast.Call) -> str:
    """Return the last part of the name of the called function, whatever it is called on."""
    function = call.func
    return function.attr if isinstance(function, ast.Attribute) else dotted(function)


def named_in(part: ast.AST) -> list[ast.Name | ast.Attribute]:
    """Return the names and attributes in a part of the source, each whole: self.a.b, and not self.a."""
    found = [n for n in ast.walk(part) if isinstance(n, ast.Name | ast.Attribute) and dotted(n)]
    inner = {p for n in found for p in ast.walk(n) if p is not n}
    return [n for n in found if n not in inner]


def own_name(node: ast.AST | None) -> str:
    """Return x of `self.x`; "" for anything else."""
    if isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name):
        return node.attr if node.value.id == "self" else ""
    return ""


def module_name(path: str) -> str:
    """Return the name by which Python imports a file of a package: `a.b` for `a/b.py`."""
    return path.removesuffix(".py").replace("/", ".")


def calls_in(node: ast.AST) -> Iterator[tuple[ast.Call, str]]:
    """Yield every call in a part of the source, in order, with the called name."""
    for found in sorted(
        (n for n in ast.walk(node) if isinstance(n, ast.Call)),
        key=lambda n: (n.lineno, n.col_offset),
    ):
        yield found, dotted(found.func)
