"""A spin that ends by itself after a time, although a node runs until Ctrl+C."""

from __future__ import annotations

import ast

from grader.package.source.ends_after import LIMITED, constant, timeout_of
from grader.package.source.names import calls_in, dotted, last_part
from grader.package.source.node import NodeSource


def time_limit(source: NodeSource) -> tuple[ast.Call, str, str] | None:
    """Return the only spin, its timeout as code, and the call of spin that has none.

    None if the node is spun in another way too, or again and again.
    """
    calls = calls_in(source.main) if source.main is not None else ()
    spins = [(c, name) for c, name in calls if last_part(name).startswith("spin")]
    if len(spins) != 1 or last_part(spins[0][1]) != LIMITED:
        return None
    call, name = spins[0]
    module = source.module_of(call)
    if any(isinstance(part, ast.While | ast.For) for part in module.around(call)):
        return None
    timeout = timeout_of(call)
    owner = name.rpartition(".")[0]
    node = dotted(call.args[0]) if call.args else ""
    if (
        timeout is None
        or not constant(module, timeout)
        or not owner
        or (owner == "rclpy" and not node)
    ):
        return None
    spin = f"rclpy.spin({node})" if owner == "rclpy" else f"{owner}.spin()"
    return call, f"timeout_sec={module.text.code(timeout)}", spin
