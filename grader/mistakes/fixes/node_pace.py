"""Fixes of a timer whose wrong period is hidden: by an option of the logger, or by a sleep."""

from __future__ import annotations

import ast

from grader.mistakes.fixes.node_words import option_of
from grader.package.source.node import NodeSource
from grader.package.source.real_time import THROTTLE


def throttled(source: NodeSource) -> ast.keyword | None:
    """Return the option with which a line of the node's log is written at most so often."""
    for call in source.own_logs:
        option = option_of(call)
        if option is not None and option.arg == THROTTLE:
            return option
    return None
