"""Shared by the kinds of check for a period: the instants at which something came in a scenario."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from itertools import pairwise


def wrong_gaps(instants: Sequence[float], period: float, clock: float) -> list[float]:
    """Return the gaps between instants that are not a period; `clock` is the clock's period."""
    slack = _slack(period, clock)
    gaps = [after - before for before, after in pairwise(instants)]
    return [gap for gap in gaps if abs(gap - period) > slack]


def stops_before(last: float, instants: Sequence[float], period: float, clock: float) -> bool:
    """Whether nothing more came although it was due before the end of the window."""
    return last - max(instants) > period + _slack(period, clock)


def usual_gap(instants: Sequence[float], clock: float) -> float:
    """Return about how many seconds lie between instants.

    A timer that is faster than the clock comes between its instants too, where these are watched.
    """
    if len(instants) < 2:
        return instants[0]
    between = [at for at in instants if abs(at / clock - round(at / clock)) > 1e-6]
    if between:
        watched = [at for at in instants if at <= between[-1] + clock]
        return round((watched[-1] - watched[0]) / max(1, len(watched) - 1), 3)
    gaps = Counter(round(after - before, 3) for before, after in pairwise(instants))
    return gaps.most_common(1)[0][0]


def _slack(period: float, clock: float) -> float:
    """Return by how much a gap may differ (s): 0 if the clock's period divides the wanted one."""
    steps = period / clock
    return 1e-6 if abs(steps - round(steps)) < 1e-6 else clock
