"""`if __name__ == '__main__':` with the code of the node, and a call that should be below one."""

from __future__ import annotations

import ast

from grader.package.source.names import dotted


def is_guard(statement: ast.stmt) -> bool:
    """Return whether a statement is `if __name__ == '__main__':`."""
    test = statement.test if isinstance(statement, ast.If) else None
    if not isinstance(test, ast.Compare) or len(test.comparators) != 1:
        return False
    sides = (test.left, test.comparators[0])
    texts = [side.value for side in sides if isinstance(side, ast.Constant)]
    named = any(dotted(side) == "__name__" for side in sides)
    return named and texts == ["__main__"] and isinstance(test.ops[0], ast.Eq)


def guarded_code(tree: ast.Module) -> ast.If | None:
    """Return the guard that has the code of the node below it, not only the call of a function."""
    for statement in tree.body:
        if isinstance(statement, ast.If) and is_guard(statement) and not statement.orelse:
            called = {dotted(n.func) for n in ast.walk(statement) if isinstance(n, ast.Call)}
            if any(name.startswith("rclpy.") or name.endswith("spin") for name in called):
                return statement
    return None


def names_needed_outside(tree: ast.Module, block: ast.If) -> bool:
    """Return whether code outside of a block uses a name that the block sets."""
    inside = set(ast.walk(block))
    names = [n for n in ast.walk(tree) if isinstance(n, ast.Name)]
    kept = {n.id for n in names if n in inside and not isinstance(n.ctx, ast.Load)}
    kept |= {
        alias.asname or alias.name.partition(".")[0]
        for n in inside
        if isinstance(n, ast.Import | ast.ImportFrom)
        for alias in n.names
    }
    return any(n.id in kept and n not in inside for n in names)


def called_on_import(tree: ast.Module, function: str) -> ast.Call | None:
    """Return the call of a function of the file that runs when the file is imported."""
    defined = {n.name for n in tree.body if isinstance(n, ast.FunctionDef)}
    for statement in tree.body:
        call = statement.value if isinstance(statement, ast.Expr) else None
        if isinstance(call, ast.Call) and function in defined and dotted(call.func) == function:
            return call
    return None
