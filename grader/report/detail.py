"""How much a student gets to know about a check that failed: the `feedback:` of an assignment."""

from __future__ import annotations

from collections.abc import Mapping
from datetime import datetime
from enum import IntEnum
from typing import Any, Literal, get_args

from pydantic import model_validator

from grader.base.nearest import meant_or_known
from grader.base.part import Part

Feedback = Literal["full", "hints", "where", "score"]
WORDS: tuple[Feedback, ...] = get_args(Feedback)
AS_POLICY = "policy"
"""In place of a word: as the assignment's `feedback:` says."""


class Detail(IntEnum):
    """What is shown of a failed check; each level adds to the one before.

    `POINTS`: its title and points. `WHERE`: what was expected and found, in which file and line.
    `WHY`: why it matters. `KIND`: the kind of change, in a sentence. `LINE`: the line itself.
    """

    POINTS = -1
    WHERE = 0
    WHY = 1
    KIND = 2
    LINE = 3


HINTS = int(Detail.LINE)
"""How many hints there are about one failed check: the levels above `WHERE`."""
IN_FILES: Mapping[Feedback, Detail] = {
    "full": Detail.LINE,
    "hints": Detail.KIND,  # nobody can ask a file for the next hint
    "where": Detail.WHERE,
    "score": Detail.POINTS,
}


class FeedbackRules(Part):
    """How much students get: in the lab, and in what is handed back before and after the due date.

    One word instead of the block is for all three.
    """

    lab: Feedback = "hints"
    before_due: Feedback = "where"
    after_due: Feedback = "full"

    @model_validator(mode="before")
    @classmethod
    def _one_word(cls, value: Any) -> Any:
        if not isinstance(value, str):
            return value
        if value not in WORDS:
            from grader.base.yaml_model import broken  # noqa: PLC0415 - it imports PyYAML

            known = meant_or_known(value, WORDS)
            raise broken(f"feedback must be one of {', '.join(WORDS)}, not '{value}'{known}")
        return {"lab": value, "before_due": value, "after_due": value}

    def handed_back(self, due: datetime | None, now: datetime) -> Detail:
        """Return the level for what is handed back at `now`; both are aware datetimes.

        Without a due date nothing is before it, so that `after_due` holds.
        """
        is_before = due is not None and now < due
        return IN_FILES[self.before_due if is_before else self.after_due]

    def in_lab(self, hints: int) -> Detail:
        """Return the level of a failed check about which a student asked for `hints` hints."""
        if self.lab == "hints":
            return Detail(min(max(hints, 0), HINTS))
        return IN_FILES[self.lab]
