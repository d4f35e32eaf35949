"""Fixes of the function of the entry point, and of the guard at the end of the file."""

from __future__ import annotations

from grader.mistakes.fixes.case import Case
from grader.package.edit.files import Files
from grader.package.edit.text import Splice, indent_of
from grader.package.source.guard import called_on_import, guarded_code, names_needed_outside


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
