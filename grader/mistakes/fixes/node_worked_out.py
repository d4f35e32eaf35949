"""Fixes that make the one change after which the node logs the required lines."""

from __future__ import annotations

from grader.mistakes.fixes.case import Case, Fix
from grader.package.edit.files import Files
from grader.package.source.node import read_node
from grader.package.source.one_change import changes, wanted_lines


def change(*sorts: str) -> Fix:
    """Return a fix that makes the change of one of these sorts at the finding's line."""

    def fix(case: Case) -> Files | None:
        node = read_node(case.files.data, case.node_path, case.assignment.function)
        output = case.assignment.output
        if node is None:
            return None
        wanted = wanted_lines(output.line, output.start, output.step)
        name = str(case.finding.params.get("name", ""))
        for found in changes(node, wanted, *sorts):
            if found.at.lineno == case.finding.line and found.name.startswith(name):
                return case.changed(node.module, *found.splices)
        return None

    return fix
