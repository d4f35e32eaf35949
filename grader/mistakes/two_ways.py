"""A condition of which each part gives the number in its own way."""

from __future__ import annotations

import ast
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.example import NODE, example
from grader.mistakes.fixes import node_worked_out
from grader.mistakes.kind import Family
from grader.mistakes.recognised import RecognisedMistake, Suspect
from grader.mistakes.worked_out import INSTEAD, change_of, worked_out
from grader.package.edit.tree import Replace


def _branch(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a condition of which one part alone gives the right lines."""
    change = change_of(suspect, "branch")
    if change is None or "\n" in change.form:
        return None
    found = worked_out("two_ways_to_count", "branch")(suspect)
    whole = found is not None and isinstance(change.at, ast.If)
    if found is None or not whole:
        return found
    words = {**found.words, "first": change.at.lineno, "line": change.at.end_lineno or 0}
    return replace(found, words=words, variant="lines")


_node = Family("node", links.PYTHON_CLASSES)
KINDS = (
    _node(
        "two_ways_to_count",
        "counter",
        msg("A condition gives the number in two ways"),
        msg(
            "The condition {form} does not always have the same value, so the number is not made in the "
            "same way in each callback. {written} alone gives the required lines."
        ),
        INSTEAD,
        fixes={
            "lines": msg(
                "Write only {written} in place of the lines {first} to {line}, indented as far as the if "
                "is indented."
            )
        },
        behind=dict.fromkeys(
            ("run.wrong_step", "run.wrong_start", "run.constant_counter"), _branch
        ),
        fixed_by=(node_worked_out.change("branch"),),
        examples=(
            example(
                "count_back_to_zero_in_the_else",
                Replace(
                    NODE,
                    "        self.counter_ += 1\n",
                    "        if self.counter_ < 4:\n            self.counter_ += 1\n"
                    "        else:\n            self.counter_ = 0\n",
                ),
                fails="run.output",
            ),
            example(
                "count_back_to_zero_in_one_line",
                Replace(
                    NODE,
                    "self.counter_ += 1",
                    "self.counter_ = 0 if self.counter_ == 4 else self.counter_ + 1",
                ),
                fails="run.output",
            ),
        ),
    ),
)
