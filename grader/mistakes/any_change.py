"""The one line whose change gives the required lines, where no other record names the mistake."""

from __future__ import annotations

from dataclasses import replace

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.example import NODE, example
from grader.mistakes.fixes import node_worked_out
from grader.mistakes.kind import Family
from grader.mistakes.recognised import RecognisedMistake, Suspect
from grader.mistakes.worked_out import change_of
from grader.package.edit.tree import Replace

SYMPTOMS = ("run.wrong_step", "run.constant_counter", "run.wrong_start")


def _changed(suspect: Suspect) -> RecognisedMistake | None:
    """Look for the statement whose change gives the required lines."""
    change = change_of(suspect, "counted", "shown", "removed")
    if change is None:
        return None
    params = {"name": change.name, "written": change.written}
    found = suspect.finding("any_change", change.at, **params)
    return replace(found, variant="" if change.sort == "counted" else change.sort)


_node = Family("node", links.FIRST_NODE)
KINDS = (
    _node(
        "any_change",
        "counter",
        msg("A line does not do what the count needs"),
        msg(
            "After this line, {name}, the counter is not the number that the next line has to show."
        ),
        msg("Write {written} instead of {name}."),
        whys={
            "shown": msg("What this line logs, {name}, is not the required text with the number."),
            "removed": msg("Without this line, {name}, the required lines come."),
        },
        fixes={"removed": msg("Delete this line.")},
        behind=dict.fromkeys(SYMPTOMS, _changed),
        fixed_by=(node_worked_out.change("counted", "shown", "removed"),),
        deletes=("removed",),
        examples=(
            example(
                "counter_toggles",
                Replace(NODE, "self.counter_ += 1", "self.counter_ = 1 - self.counter_"),
                fails="run.output",
            ),
        ),
    ),
)
