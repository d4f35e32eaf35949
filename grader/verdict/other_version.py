"""A node that does not log, and another file of the package that has the finished node."""

from __future__ import annotations

import shlex
from functools import partial
from typing import TYPE_CHECKING

from grader.base.shown import shown
from grader.mistakes.recognised import RecognisedMistake
from grader.package.source.node import NodeSource, read_node
from grader.report.model import Where
from grader.verdict.checks.parsed import data_of, names_in

if TYPE_CHECKING:
    from grader.verdict.evidence import Evidence

SYMPTOMS = ("run.no_lines", "run.exits_at_once")


def other_version(symptom: str, source: NodeSource, evidence: Evidence) -> RecognisedMistake | None:
    """Return the only other file with a finished node, if the one that is started has no timer."""
    path, folder = source.entry.path, evidence.assignment.folder
    if symptom not in SYMPTOMS or source.timers or "create_timer" in source.entry.text.text:
        return None
    names = [n for n in names_in(evidence, folder) if n.endswith(".py") and n != "__init__.py"]
    used = {name.rpartition(".")[2] for module in source.modules for name in module.imports}
    others = {f"{folder}/{node.file}" for node in evidence.assignment.nodes.values()}
    found = [
        f"{folder}/{name}"
        for name in names
        if f"{folder}/{name}" not in {path, *source.paths, *others}
        and name.removesuffix(".py") not in used
        and _is_finished(f"{folder}/{name}", evidence)
    ]
    if len(found) != 1:
        return None
    return RecognisedMistake(
        kind="node.finished_elsewhere",
        params={"there": found[0]},
        words={"there": shown(shlex.quote(found[0])), "path": shown(path)},
        where=Where(file=path, line=1),
    )


def _is_finished(path: str, evidence: Evidence) -> bool:
    """Whether a file has a node whose timer's callback logs, and the entry point's function."""
    found = read_node(partial(data_of, evidence), path, evidence.assignment.function)
    if found is None or found.main is None or found.node_class is None or not found.timers:
        return False
    callback = found.callback
    return found.makes_node() and callback is not None and bool(found.logs(callback))
