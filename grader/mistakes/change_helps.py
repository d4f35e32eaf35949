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
        whys={one.sort: one.why for one in TABLE},
        fixes={one.sort: one.fix for one in TABLE},
    ),
)
