"""Tells a failed check of a scenario's run with what short runs of the node show.

A change is told only if the package, built and run with it, passes the check, and no check that passed
fails then.
"""

from __future__ import annotations

from grader.base.i18n.message import Message, say
from grader.base.i18n.translator import Translator
from grader.base.shown import shown
from grader.explain.rules import BY_ID
from grader.mistakes.catalogue import CATALOGUE
from grader.mistakes.recognised import RecognisedMistake
from grader.package.edit.files import Files
from grader.report.model import CheckResult, Mistake, Where
from grader.verdict.checks.parsed import line_at
from grader.verdict.evaluate import evaluate_again
from grader.verdict.evidence import Evidence
from grader.verdict.fix import patch_text
from grader.verdict.found_change import Fact, FoundChange, Step
from grader.verdict.trial import Trial, root_of

KIND = "node.change_helps"
MOST_CONFIRMED = 2
"""The most changes of one check that are built and run."""
CLEAR = ("topic.wrong_period", "topic.int_in_float", "log.wrong_level")
"""What was seen that has one cause, which its text names."""
OF_OTHERS = ("foreign_sender", "foreign_server", "foreign_client", "only_when_marked")
"""What no change of a line corrects: another node does it, or the node does it only for the grader."""
OF_VALUES = (
    "none_used",
    "types_do_not_fit",
    "no_such_item",
    "not_callable",
    "other_message",
    "field_type",
)
"""Errors of a value that another line made: what they mean is told, and the cause may be elsewhere."""
OTHER = say("Another change may fit what you want to do better.")


def with_change_of_run(
    result: CheckResult, evidence: Evidence, translate: Translator
) -> CheckResult:
    """Return a failed check's result with a change that helps, if one is found."""
    if evidence.seek is None or evidence.with_fix is None or result.visibility != "visible":
        return result
    if root_of(result) is None and len(result.mistakes) > 1:
        return result  # the run has shown the cause: a file of parameters, or a lifecycle
    if any(mistake.id.partition(".")[2] in OF_OTHERS for mistake in result.mistakes):
        return result
    for known in _told(evidence):
        trial = Trial(result, evidence, translate)
        if trial.passes_with(known.of(Files.of(evidence.submission))):
            return _with(known, result, evidence, translate)
    sought = evidence.seek(evidence, result)
    evidence.sought[result.id] = sought
    fact = sought.fact
    for change in sought.changes[:MOST_CONFIRMED]:
        new = change.of(Files.of(evidence.submission))
        if Trial(result, evidence, translate).helps(new, on_top=0).helps:
            return _with(change, result, evidence, translate, fact)
    return with_fact(result, fact, evidence, translate) if fact is not None else result


def says_the_cause(result: CheckResult) -> bool:
    """Whether the text of a failure says all that is wrong: only the change is added to it."""
    seen = result.mistakes[0].id if result.mistakes else ""
    kind = CATALOGUE.get(seen)
    return root_of(result) is not None or seen in CLEAR or (kind is not None and kind.of_shape)


def _is_at(step: Step, where: Where | None) -> bool:
    """Whether a step changes the line that a text is about."""
    return where is None or (step.path == where.file and where.line in (None, step.line))


def with_fact(
    result: CheckResult, fact: Fact, evidence: Evidence, translate: Translator
) -> CheckResult:
    """Return the result with what a fact explains, unless a mistake behind it is known."""
    rule, values = BY_ID[fact.rule], fact.values
    where = Where(file=fact.path, line=fact.line)
    root = root_of(result)
    if says_the_cause(result) and (root is None or root.id not in rule.over):
        has_line = result.where is None or result.where.line is not None
        return result if has_line else result.model_copy(update={"where": where})
    mistake = Mistake(id=rule.mistake, params={"line": fact.line})
    alike = [
        other.id
        for other in evidence.results.values()
        if other.status == "failed" and mistake in other.mistakes and other.where == where
    ]
    code = line_at(evidence, where)
    line = say("line {line}: {code}", line=fact.line, code=shown(code))
    actual = result.actual.partition("\n")[0]
    update = {
        "rationale": translate(Message(rule.why, values)),
        "fix": translate(Message(rule.fix, values)),
        "where": where,
        "actual": "\n".join([actual, translate(Message(rule.title)), translate(line)]),
        "mistakes": [mistake, *result.mistakes],
        "consequence_of": alike[0] if alike else "",
    }
    return result.model_copy(update=update)


def _told(evidence: Evidence) -> list[FoundChange]:
    """Return the changes that were told with earlier checks."""
    old = Files.of(evidence.submission)
    told = {one.patch for one in evidence.results.values()} - {""}
    found = [change for sought in evidence.sought.values() for change in sought.changes]
    return [one for one in found if patch_text(old, one.of(old)) in told]


def _with(
    change: FoundChange,
    result: CheckResult,
    evidence: Evidence,
    translate: Translator,
    fact: Fact | None = None,
) -> CheckResult:
    step, old = change.steps[0], Files.of(evidence.submission)
    patch = "" if change.shows else patch_text(old, change.of(old))
    root = root_of(result)
    is_open = (
        root is not None and root.id.partition(".")[2] in OF_VALUES and "written" not in root.params
    )
    if says_the_cause(result) and patch and not is_open:
        here = root is None or _is_at(step, result.where)
        return result.model_copy(update={"patch": patch}) if here else result
    found = RecognisedMistake(
        kind=KIND,
        params={"name": step.name, "written": step.written},
        variant=step.sort,
        where=Where(file=step.path, line=step.line),
    )
    now = evaluate_again(result.id, evidence, translate, found=found)
    if now.status != "failed":
        return result
    advice = now.advice if now.consequence_of else [*now.advice, translate(OTHER)]
    update = {"patch": patch, "advice": advice}
    if fact is not None and not now.consequence_of:
        why = translate(Message(BY_ID[fact.rule].why, fact.values))
        update["rationale"] = f"{why} {now.rationale}"
    return now.model_copy(update=update)
