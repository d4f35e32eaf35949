"""The fix of a package that was created inside a package of the same name."""

from __future__ import annotations

from dataclasses import replace

from grader.mistakes.fixes import entries
from grader.mistakes.fixes.case import Case
from grader.package.edit.files import Files


def taken_out(case: Case) -> Files | None:
    """Move the node out of the inner package, and add the entry to the outer setup.py.

    The inner package is left for the student to delete. None if it has other files of Python.
    """
    files, params = case.files, case.finding.params
    inner = f"{params.get('inner', '')}/{case.assignment.folder}"
    old = str(params.get("path", ""))
    others = {path for path in files.below(inner) if path.endswith(".py")}
    if others - {old, f"{inner}/__init__.py"}:
        return None
    if old and files.file(old) is not None and case.node_path not in files.by_path:
        files = files.with_move(old, case.node_path)
    finding = replace(case.finding, file="setup.py", line=None)
    added = entries.added(replace(case, files=files, finding=finding))
    return added or (files if files is not case.files else None)
