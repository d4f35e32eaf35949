"""Fixes of the function of the entry point, and of the guard at the end of the file."""

from __future__ import annotations

from grader.mistakes.fixes.case import Case
from grader.package.edit.files import Files
from grader.package.edit.text import Splice, indent_of
from grader.package.source.guard import called_on_import, guarded_code, names_needed_outside
from grader.package.source.module import Function


def out_of_guard(case: Case) -> Files | None:
    """Put the code below the guard into the function, and call it there."""
    module, function = case.node.entry if case.node else None, case.assignment.function
    guard = guarded_code(module.tree) if module is not None else None
    if module is None or guard is None or function in module.names:
        return None
    first, text = guard.body[0], module.text
    if names_needed_outside(module.tree, guard) or first.lineno == guard.lineno:
        return None
    start, end = text.start_of(guard.lineno), text.end_of(guard.lineno)
    after = (guard.end_lineno or guard.lineno) + 1
    indent = indent_of(text.line(first.lineno))
    call = ("", "", "if __name__ == '__main__':", f"{indent}{function}()")
    splices = [Splice(start, end, f"def {function}(args=None):"), text.before(after, *call)]
    return case.changed(module, *splices)


def under_guard(case: Case) -> Files | None:
    """Put the call of the function, which runs on import, below a guard."""
    module = case.node.entry if case.node else None
    call = called_on_import(module.tree, case.assignment.function) if module is not None else None
    if module is None or call is None or call.lineno != call.end_lineno:
        return None
    if module.line(call.lineno) != module.text.code(call):
        return None
    start = module.text.start_of(call.lineno)
    guard = f"if __name__ == '__main__':{module.text.newline}    "
    return case.changed(module, Splice(start, start, guard))


def appended(case: Case) -> Files | None:
    """Append the function to a file that has only the node's class."""
    node, function = case.node, case.assignment.function
    if node is None or node.node_class is None or not node.module.has(node.node_class):
        return None
    module, made = node.entry, node.node_class.name
    others = [s for s in module.tree.body if isinstance(s, Function)]
    outside = node.makes_node() or node.calls_of("init", "spin") or guarded_code(module.tree)
    if module is not node.module or others or outside or "rclpy" not in module.imports:
        return None
    rows = (
        f"def {function}(args=None):",
        "    rclpy.init(args=args)",
        f"    node = {made}()",
        "    try:",
        "        rclpy.spin(node)",
        "    except KeyboardInterrupt:",
        "        pass",
        "    finally:",
        "        node.destroy_node()",
        "        rclpy.try_shutdown()",
        "",
        "",
        "if __name__ == '__main__':",
        f"    {function}()",
    )
    after = len(module.text.lines) + 1
    return case.changed(module, module.text.before(after, "", "", *rows))
