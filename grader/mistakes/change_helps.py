"""The catalogue: a small change with which the failed check passes, found by running it.

The texts are those of the operators (grader/change).
"""

from __future__ import annotations

from grader.base.i18n.message import msg
from grader.change.table import TABLE
from grader.mistakes import links
from grader.mistakes.kind import Family

_node = Family("node", links.FIRST_NODE)
KINDS = (
    _node(
        "change_helps",
        "callback",
        msg("With one small change, the check passes"),
        msg("The grader changed this place, ran the node, and the check passed."),
        msg("Write {written} instead of {name}."),
        whys={
            **{one.sort: one.why for one in TABLE},
            "long": msg("The grader changed this place, ran the node, and the check passed."),
            "several": msg(
                "One change alone does not help. The grader ran the node with these changes together, and "
                "then this check passes."
            ),
        },
        fixes={**{one.sort: one.fix for one in TABLE}, "long": msg("Make the change below.")},
    ),
    _node(
        "one_of_two",
        "text",
        msg("One of two mistakes is here"),
        msg(
            "The grader ran the node with {written} instead of {name} in this line. Then the text of "
            "each line is right, and only the number is not: that is another mistake."
        ),
        msg("Write {written} instead of {name}. Then grade again."),
    ),
)
