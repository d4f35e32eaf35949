"""The result of a check that was evaluated for each node: one that covers all of them."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from grader.base.i18n.message import joined, say
from grader.base.i18n.translator import Translator
from grader.report.model import CheckResult, CheckStatus

DECIDES: tuple[CheckStatus, ...] = ("failed", "error", "inconclusive", "skipped", "passed")
"""The first of these that a node has is the status for all nodes."""


def together(parts: Sequence[CheckResult], translate: Translator) -> CheckResult:
    """Return the result for all nodes: it fails for the first node that fails, and names each.

    A node has a part for each run that starts it; what it has in several runs is told once.
    """
    status = next(one for one in DECIDES if any(part.status == one for part in parts))
    nodes = len({part.node for part in parts})
    first, *rest = _one_a_node([part for part in parts if part.status == status])
    update: dict[str, object] = {"seconds": round(sum(part.seconds for part in parts), 3)}
    if nodes > 1 and status in ("failed", "passed"):
        texts = [_of_node(part, part.actual, parts) for part in (first, *rest) if part.actual]
        update["actual"] = "\n".join(map(translate, texts))
    if nodes > 1 and status == "failed":
        fixes = [_fix_of_node(part) for part in rest if part.fix]
        update["advice"] = [*first.advice, *map(translate, fixes)]
    if nodes > 1 and status == "passed":
        update |= {"node": "", "run": ""}
        update["advice"] = list(map(translate, _advice((first, *rest))))
    return first.model_copy(update=update)


def _one_a_node(parts: Sequence[CheckResult]) -> list[CheckResult]:
    found: dict[str, CheckResult] = {}
    for part in parts:
        found.setdefault(part.node, part)
    return list(found.values())


def _of_node(part: CheckResult, text: str, parts: Sequence[CheckResult]) -> str:
    """Return a text with the node, and the run if only some of its runs have this status."""
    same = [other.status == part.status for other in parts if other.node == part.node]
    if part.run and not all(same):
        return say("{node} in the run {run}: {text}", node=part.node, run=part.run, text=text)
    return joined(part.node, text, by=": ")


def _fix_of_node(part: CheckResult) -> str:
    """Return the fix of a further node that fails, with its place."""
    if part.where is None:
        return joined(part.node, part.fix, by=": ")
    line = "" if part.where.line is None else f":{part.where.line}"
    place = f"{part.where.file}{line}"
    return joined(f"{part.node} ({place})", part.fix, by=": ")


def _advice(parts: Sequence[CheckResult]) -> Iterator[str]:
    """Yield the advice of nodes that passed; what holds for all of them once, without a name."""
    for text in dict.fromkeys(text for part in parts for text in part.advice):
        having = [part.node for part in parts if text in part.advice]
        if len(having) == len(parts):
            yield text
        else:
            yield from (joined(node, text, by=": ") for node in having)
