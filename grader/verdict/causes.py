"""The cause of a skipped check: the chain of checks that it names ends at one that says why.

No point is lost without a failed check. A skipped check names the check because of which it could
not be judged. If that one (or the one that it names itself) has failed, the points are lost for that
reason; if it is undecided, so is this one; if it has passed, nobody knows, and the points stay open.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

from grader.base.i18n.message import say
from grader.base.i18n.translator import Translator
from grader.report.model import CheckResult

UNDECIDED = ("inconclusive", "error")


def cause_of(by: str, results: Mapping[str, CheckResult]) -> CheckResult | None:
    """Return the result at the end of the chain that begins at a check; None if it leads nowhere."""
    seen: set[str] = set()
    while by in results and by not in seen:
        result = results[by]
        if result.status != "skipped":
            return result
        seen.add(by)
        by = result.blocked_by
    return None


def says_why(result: CheckResult | None) -> bool:
    """Whether a result at the end of a chain is a reason: it failed, or it is undecided itself."""
    return result is not None and result.status in ("failed", *UNDECIDED)


def without_cause(results: Iterable[CheckResult]) -> list[CheckResult]:
    """Return the results whose points would be lost, or be open, because of a check that passed."""
    by_id = {result.id: result for result in results}
    return [
        result
        for result in by_id.values()
        if result.status in ("skipped", "inconclusive")
        and (result.status == "skipped" or result.blocked_by)
        and not says_why(cause_of(result.blocked_by, by_id))
    ]


def with_causes(results: Sequence[CheckResult], translate: Translator) -> list[CheckResult]:
    """Return the results; a skipped one that nothing explains becomes inconclusive.

    The checks see to it that there is none: this is what remains if one of them has a bug.
    """
    lost = {id(result) for result in without_cause(results)}
    unknown = {result.id: result for result in results if result.status in UNDECIDED}
    by_id = {result.id: result for result in results}
    return [
        _open(result, by_id, translate)
        if id(result) in lost or (result.status == "skipped" and _is_open(result, by_id, unknown))
        else result
        for result in results
    ]


def _is_open(
    result: CheckResult, by_id: Mapping[str, CheckResult], unknown: Mapping[str, CheckResult]
) -> bool:
    cause = cause_of(result.blocked_by, by_id)
    return cause is not None and cause.id in unknown


def _open(
    result: CheckResult, by_id: Mapping[str, CheckResult], translate: Translator
) -> CheckResult:
    cause = cause_of(result.blocked_by, by_id)
    title = cause.title if cause is not None else result.blocked_by
    text = (
        say("not known, because another check could not be decided: {title}", title=title)
        if says_why(cause)
        else say(
            "not known: it could not be judged because of “{title}”, where nothing was found wrong. "
            "Please report this to the grader's authors.",
            title=title,
        )
    )
    return result.model_copy(update={"status": "inconclusive", "actual": translate(text)})
