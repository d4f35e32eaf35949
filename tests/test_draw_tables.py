"""How many draws of a lesson a table of instants passes, that does not react to anything."""

from __future__ import annotations

import random
from collections.abc import Collection, Sequence

from grader.course.draw import Values
from grader.course.find import assignment_file
from grader.course.load import load_assignment
from grader.verdict.checks.all import CHECKS

STAY = load_assignment(assignment_file("stay_inside"), known_checks=CHECKS)
DRAWS = 250
TRIES, STEPS, MOST = 8, 600, 9
STEP = 0.1  # s, the clock's


def windows(values: Values) -> list[tuple[float, float, bool]]:
    """Return from when to when a line must be logged, or must not, with these drawn values."""
    drawn = STAY.with_drawn(values)
    plan = drawn.runs[0]
    found = []
    for use in drawn.checks:
        stimulus = plan.stimulus(use.after) if use.kind.startswith("log.") else None
        if stimulus is not None and use.during is not None:
            first, last = (stimulus.at + float(one) for one in use.during)
            found.append((first - 1e-6, last + 1e-6, use.kind == "log.matches"))
    return found


def passed(table: Collection[int], has: Sequence[Sequence[int]]) -> int:
    """Return the number of draws that a table passes, a set of ticks with a line.

    `has` is for each window: for each tick a bit for each draw whose window it is in.
    """
    fits = (1 << DRAWS) - 1
    for window, bits in enumerate(has):
        there = 0
        for tick in table:
            there |= bits[tick]
        fits &= there if window % 2 else ~there
    return bin(fits).count("1")


def best_table(has: Sequence[Sequence[int]], seed: int) -> int:
    """Return how many draws the best table passes that a walk finds, one change after the other."""
    chance = random.Random(seed)
    ticks = range(len(has[0]))
    table = set(chance.sample(ticks, 4))
    best = passed(table, has)
    for _ in range(STEPS):
        new = set(table)
        if chance.random() < 0.6 and len(new) > 1:
            new.remove(chance.choice(sorted(new)))
        if chance.random() < 0.7 and len(new) < MOST:
            new.add(chance.choice(ticks))
        count = passed(new, has)
        if count >= best:
            table, best = new, count
    return best


def test_a_table_of_stay_inside_fails_in_two_of_three_draws() -> None:
    """It logs at instants of its own, whatever the pose is; the drives of such a program are right."""
    chance = random.Random(1)
    names = STAY.draw.items()
    draws = [{name: chance.choice(one.values) for name, one in names} for _ in range(DRAWS)]
    wanted = [windows(values) for values in draws]
    assert [one[2] for one in wanted[0]] == [False, True, False, True]
    ticks = range(round(STAY.runs[0].clock.ticks * STAY.runs[0].clock.period / STEP))
    has = [
        [
            sum((each[w][0] <= tick * STEP <= each[w][1]) << n for n, each in enumerate(wanted))
            for tick in ticks
        ]
        for w in range(len(wanted[0]))
    ]
    best = max(best_table(has, seed) for seed in range(TRIES))
    assert 0.1 * DRAWS < best <= 0.34 * DRAWS
