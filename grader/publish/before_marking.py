"""What a class run says and asks before it marks: the join, the grades that change, how long it takes."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from statistics import median

from grader.base.gate import gate
from grader.base.shown import shown
from grader.base.stream import is_terminal
from grader.batch import cells
from grader.batch.given_files import write_private
from grader.batch.inputs import ClassInputs
from grader.batch.join_file import JOIN_FILE, JoinRow, file_names, join_csv, join_rows
from grader.batch.ledger import Ledger
from grader.batch.model import ClassResult
from grader.batch.run import ClassPlan
from grader.batch.words import duration, plural
from grader.publish.join_page import change_lines, join_lines, join_page

ASKS_FROM = 60.0  # seconds of marking
SECONDS_EACH = 3.0  # of one worker for one submission, as long as no verdict says
MOST_MEASURED = 20  # of the last verdicts

Notify = Callable[[str], None]


def say_join(known: ClassInputs, out: Path, *, quiet: bool, notify: Notify) -> list[JoinRow]:
    """Say which file is whose and what is not sure, write all of it to `out`, and return it.

    Raises SurroundingsError if it cannot be written.
    """
    rows = join_rows(known.folder)
    for line in join_lines(rows, quiet=quiet):
        notify(line)
    write_private(out, "", JOIN_FILE, join_csv(rows))
    notify(f"all of the join: {shown(str(out / JOIN_FILE))} (to correct it: --join FILE)")
    return rows


def say_changes(
    known: ClassInputs, plan: ClassPlan, result: ClassResult, *, notify: Notify
) -> None:
    """Say which grades change or can change that exist: in the gradebook, in the given sheets."""
    names = {entry.student.key: entry.student.name for entry in result.entries}
    waiting = [key for key in names if key in plan.students]
    graded = [key for key in waiting if cells.text(key) in known.gradebook.rows]
    changes = [*known.gradebook.changed(result), *known.sheets.changed(result)]
    for line in change_lines(changes, graded, lambda key: names[key] or key):
        notify(line)


def marking_page(rows: list[JoinRow], plan: ClassPlan, *, width: int, styled: bool) -> str:
    """Return the join as a table, with what a run would do with each file."""
    names = file_names(item.handed_in.path for item in plan.items)
    todo = {names[item.handed_in.path] for item in plan.todo}
    by_hand = {names[item.handed_in.path] for item in plan.items if item.problem}
    faults = {names[item.handed_in.path] for item in plan.items if item.fault}

    def marking(file: str) -> str:
        if file in by_hand:
            return "look at by hand"
        if file in faults:
            return "the grader cannot read it"
        if file in todo:
            return "to mark"
        return "marked before" if file in names.values() else ""

    return join_page(rows, marking, width=width, styled=styled)


def seconds_to_mark(ledger: Ledger, plan: ClassPlan, workers: int) -> float:
    """Return about how many seconds the marking takes, from the last verdicts."""
    known = [time for time in _times(ledger) if time > 0]
    each = median(known) if known else SECONDS_EACH
    return each * len(plan.todo) / max(1, min(workers, len(plan.todo)))


def _times(ledger: Ledger) -> Iterator[float]:
    for verdict in ledger.verdict_ids()[-MOST_MEASURED:]:
        yield ledger.report(verdict).timing.total


def agreed(seconds: float, count: int) -> bool:
    """Ask on a terminal before a long run; True if the answer is yes, or if nothing is asked."""
    if seconds <= ASKS_FROM or not (is_terminal(sys.stdin) and is_terminal(sys.stderr)):
        return True
    out = gate(sys.stderr)
    out.write(f"mark {plural(count, 'submission')} (about {duration(seconds)})? [y/N] ")
    out.flush()
    answer = sys.stdin.readline().strip().casefold()
    return answer in ("y", "yes")
