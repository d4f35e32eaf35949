"""The result of a check that was evaluated for each node: one that covers all of them."""

from __future__ import annotations

from collections.abc import Sequence

from grader.base.i18n.message import say
from grader.base.i18n.translator import Translator
from grader.report.model import CheckResult, CheckStatus

DECIDES: tuple[CheckStatus, ...] = ("failed", "error", "inconclusive", "skipped", "passed")
"""The first of these that a node has is the status for all nodes."""


def together(parts: Sequence[CheckResult], translate: Translator) -> CheckResult:
    """Return the result for all nodes: it fails for the first node that fails, and names each.

    A node has a part for each run that starts it; what it has in several runs is told once.
    """
    status = next(one for one in DECIDES if any(part.status == one for part in parts))
    first, *rest = _one_a_node([part for part in parts if part.status == status])
    seconds = round(sum(part.seconds for part in parts), 3)
    if status not in ("failed", "passed") or len({part.node for part in parts}) == 1:
        advice = list(dict.fromkeys(text for part in (first, *rest) for text in part.advice))
        return first.model_copy(update={"advice": advice, "seconds": seconds})
    texts = [say("{node}: {text}", node=part.node, text=part.actual) for part in (first, *rest)]
    actual = "\n".join(translate(text) for text, part in zip(texts, (first, *rest)) if part.actual)
    advice = [*first.advice, *(_advice(part, translate) for part in rest if part.fix)]
    if status == "passed":
        advice = [text for part in (first, *rest) for text in part.advice]
    update = {"actual": actual, "advice": list(dict.fromkeys(advice)), "seconds": seconds}
    if status == "passed":
        update |= {"node": "", "run": ""}
    return first.model_copy(update=update)


def _one_a_node(parts: Sequence[CheckResult]) -> list[CheckResult]:
    found: dict[str, CheckResult] = {}
    for part in parts:
        found.setdefault(part.node, part)
    return list(found.values())


def _advice(part: CheckResult, translate: Translator) -> str:
    """Return the fix of a further node that fails, with its place."""
    if part.where is None:
        return translate(say("{node}: {text}", node=part.node, text=part.fix))
    place = part.where.file if part.where.line is None else f"{part.where.file}:{part.where.line}"
    return translate(say("{node} ({place}): {text}", node=part.node, place=place, text=part.fix))
