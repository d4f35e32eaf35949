"""Where a counter is increased if the callback that logs it does not increase it."""

from __future__ import annotations

import ast
from collections.abc import Iterable
from dataclasses import replace

from grader.mistakes.recognised import RecognisedMistake, Suspect
from grader.package.source.counter import logged_counter, parts_of_callback
from grader.package.source.module import Function
from grader.package.source.names import calls_in, dotted, last_part
from grader.package.source.node import NodeSource

NEVER_RUN = ("unused", "call_it")


def counted_elsewhere(suspect: Suspect) -> RecognisedMistake | None:
    """Look for the += in another function than the callback that logs the counter."""
    source, callback = suspect.source, suspect.source.callback
    logged = logged_counter(source)
    if logged is None or callback is None:
        return None
    inside = {node for part in parts_of_callback(source) for node in ast.walk(part)}
    adds = [
        (node, target)
        for node in source.own_nodes
        if isinstance(node, ast.stmt)
        and (target := _added_to(node))
        and last_part(target) == last_part(logged[1])
    ]
    if any(node in inside for node, _ in adds):
        return None
    for node, target in adds:
        around = source.function_around(node)
        if around is None or around.name in ("__init__", callback.name):
            continue
        if any(last_part(name) == callback.name for _, name in calls_in(around)):
            return None  # (it adds for each line: only the order can be wrong)
        if around is suspect.function or not _calls(source.calls, around):
            found = suspect.finding("counts_elsewhere", node, name=logged[1])
            if target.partition(".")[0] in source.node_variables:
                words = {**found.words, "written": f"{logged[1]} += {suspect.output.step}"}
                return replace(found, words=words, variant="outside")
            only, words = _has_only(around, node), {**found.words, "other": around.name}
            if _given_to_timer(source.calls, around):
                return replace(found, words=words, variant="timer" if only else "timer_too")
            if _is_unused(source, around):
                return _unused(source, around, replace(found, words=words), only)
            return found
    return None


def counted_at_other_times(suspect: Suspect) -> RecognisedMistake | None:
    """Look for the += that runs in another function, and adds more than one for each line."""
    found = counted_elsewhere(suspect)
    return None if found is not None and found.variant in NEVER_RUN else found


def _added_to(node: ast.AST) -> str:
    """Return the name that a statement adds to: a += 1, or a = a + 1; "" if it does not."""
    if isinstance(node, ast.AugAssign):
        return dotted(node.target)
    value = node.value if isinstance(node, ast.Assign) else None
    if not isinstance(node, ast.Assign) or not isinstance(value, ast.BinOp):
        return ""
    target = dotted(node.targets[0])
    return target if target in (dotted(value.left), dotted(value.right)) else ""


def _has_only(function: Function, statement: ast.stmt) -> bool:
    """Return whether a function does nothing but one statement."""
    rest = [s for s in function.body if s is not statement and not isinstance(s, ast.Pass)]
    return all(isinstance(s, ast.Expr) and isinstance(s.value, ast.Constant) for s in rest)


def _given_to_timer(calls: Iterable[tuple[ast.Call, object]], function: Function) -> bool:
    for call, _ in calls:
        if last_part(dotted(call.func)) == "create_timer":
            given = (*call.args, *(keyword.value for keyword in call.keywords))
            if any(last_part(dotted(value)) == function.name for value in given):
                return True
    return False


def _is_unused(source: NodeSource, function: Function) -> bool:
    """Whether no line names a function, and Python does not call it by itself."""
    name = function.name
    if function is source.main or function.decorator_list or name.startswith("__"):
        return False
    known = (n for n in source.all_nodes if isinstance(n, ast.Name | ast.Attribute | ast.Constant))
    return all(getattr(n, "value", None) != name and last_part(dotted(n)) != name for n in known)


def _unused(
    source: NodeSource, function: Function, found: RecognisedMistake, only: bool
) -> RecognisedMistake:
    """Say to call a method that only counts, and to move the += out of any other one."""
    given = [a.arg for a in function.args.args]
    if not only or given != ["self"] or source.methods.get(function.name) is not function:
        return replace(found, variant="unused")
    words = {**found.words, "written": f"self.{function.name}()"}
    return replace(found, words=words, variant="call_it")


def _calls(calls: list[tuple[ast.Call, str]], function: Function) -> bool:
    return any(last_part(name) == function.name for _, name in calls)
