"""Mark many mutants in a few processes, each result told as soon as it is there."""

from __future__ import annotations

import multiprocessing
import signal
from collections.abc import Iterator
from collections.abc import Sequence
from concurrent.futures import ProcessPoolExecutor
from concurrent.futures import as_completed
from types import FrameType

from grader.runner import Order
from grader.validate.marking import Marked
from grader.validate.marking import mark_run
from grader.validate.tree import Tree

AGAIN = 2  # how often a mutant is marked whose verdict our own side could not give


def mark_all(work: Sequence[tuple[str, Tree]], order: Order, *, jobs: int) -> Iterator[Marked]:
    """Mark packages by building and running them, and yield what was found, in any order.

    The processes are new ones, not forks: a fork would inherit terminals and locks.
    """
    if not work:
        return
    context = multiprocessing.get_context("spawn")
    workers = min(jobs, len(work))
    pool = ProcessPoolExecutor(workers, mp_context=context, initializer=_leave_interrupt)
    try:
        waiting = [pool.submit(_mark, name, tree, order) for name, tree in work]
        for done in as_completed(waiting):
            yield done.result()
    finally:
        pool.shutdown(wait=True, cancel_futures=True)


def _mark(name: str, tree: Tree, order: Order) -> Marked:
    marked = mark_run(name, tree, order)
    for _ in range(1, AGAIN):
        if marked.unknown:
            marked = mark_run(name, tree, order)
    return marked


def _leave_interrupt() -> None:
    """Leave Ctrl+C to the parent: it lets what is being marked come to its end, and stops.

    (Not by ignoring it: what is started here would inherit that, the student's node too.)
    """
    signal.signal(signal.SIGINT, _left_to_parent)


def _left_to_parent(number: int, frame: FrameType | None) -> None:
    del number, frame
