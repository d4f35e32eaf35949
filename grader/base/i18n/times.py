"""How often something must happen, in words: exactly once, at least 2 times, 3 to 5 times."""

from __future__ import annotations

import math

from grader.base.i18n.message import Message, say, say_plural


def times(least: int, most: float | None) -> Message:
    """Return how often something must happen; `most` is None or infinite if nothing limits it."""
    if most is None or math.isinf(most):
        return say_plural("at least once", "at least {count} times", least)
    if most == 0:
        return say("never")
    if least == most:
        return say_plural("exactly once", "exactly {count} times", least)
    if least == 0:
        return say_plural("at most once", "at most {count} times", int(most))
    return say("{least} to {most} times", least=least, most=int(most))
