"""Recognise a thread that spins the node, while the program comes to its end beside it."""

from __future__ import annotations

import ast
from dataclasses import replace

from grader.mistakes.fixes import node_executor, node_order
from grader.mistakes.recognised import RecognisedMistake, Suspect
from grader.package.source.imported import full_name
from grader.package.source.names import dotted, last_part
from grader.package.source.node import NodeSource
from grader.package.source.spinning_threads import SpinningThread, lines_of, spinning_threads


def daemon(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a thread that spins, while the function comes to its end or cleans up."""
    source = suspect.source
    joins = [call for call, _ in source.calls if _is_join(source, call)]
    if any(not _has_limit(join) for join in joins):
        return None
    for thread in spinning_threads(source):
        later = [
            name
            for other, name in source.calls
            if last_part(name) in node_order.CLEANUP and other.lineno > thread.call.lineno
        ]
        if not (thread.daemon or later):
            continue
        found = suspect.finding("spin_in_daemon", thread.call)
        if joins:
            return _limited(source, found, thread, joins[0])
        return _told(source, found, thread, later)
    return None


def _told(
    source: NodeSource, found: RecognisedMistake, thread: SpinningThread, later: list[str]
) -> RecognisedMistake:
    words = {**found.words, **({"node": thread.given} if thread.given else {})}
    function, target = thread.function, dotted(thread.target)
    if function is not None:
        words |= {"name": function.name, "line": str(function.lineno), "called": f"{target}()"}
        return replace(
            found, words=words, variant="own" if target == function.name else "own_method"
        )
    if not thread.daemon:
        return replace(found, words={**words, "called": f"{later[0]}()"}, variant="cleaned_up")
    owner = target.rpartition(".")[0]
    if owner not in node_executor.executors_of(source):
        return replace(found, words=words)
    return replace(found, words={**words, "name": owner}, variant="executor")


def _limited(
    source: NodeSource, found: RecognisedMistake, thread: SpinningThread, join: ast.Call
) -> RecognisedMistake | None:
    """The program waits for the thread, but only for a time."""
    written = thread.written(source)
    if not written:
        return None
    words = {
        **found.words,
        "waits": source.module_of(join).text.code(join),
        "row": str(join.lineno),
        "written": written,
        "lines": ", ".join(map(str, sorted({*lines_of(source, thread.call), join.lineno}))),
    }
    return replace(found, words=words, variant="limited")


def _is_join(source: NodeSource, call: ast.Call) -> bool:
    """Whether a call is the join of a thread, not that of a text or of paths."""
    owner = call.func.value if isinstance(call.func, ast.Attribute) else None
    if owner is None or last_part(dotted(call.func)) != "join":
        return False
    return not full_name(source.module_of(call), owner).startswith("os")


def _has_limit(join: ast.Call) -> bool:
    """Whether a join ends after a time, whether the thread has ended or not."""
    given = [*join.args, *(word.value for word in join.keywords)]
    return bool(given) and not (isinstance(given[0], ast.Constant) and given[0].value is None)
