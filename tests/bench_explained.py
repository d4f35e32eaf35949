"""`make bench-diagnosis`: how failed verdicts are explained, in the mode that users have.

Packages are mutants of every lesson's solution, named ones and automatic ones, each n-th. The truth comes for
free: the line that the mutant changed, and the solution. For each failed verdict:

- line: an explanation names a line that the mutant changed (or the one beside it, if a line is missing);
- change: a change is shown, which the grader has built and run;
- back: with that change the files are those of the solution, as Python or XML read them;
- seconds: wall time of the verdict, and of the same verdict without a search, on this machine.

`--write docs/diagnosis.md` replaces the table there.
"""

from __future__ import annotations

import argparse
import ast
import difflib
import math
import re
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path

from grader.base.unheard import unheard
from grader.mistakes.catalogue import CATALOGUE
from grader.package.edit.tree import Tree, write_tree
from grader.report.model import CheckResult, Report
from grader.ros.distro import find_distro
from grader.validate.automatic import generate
from grader.validate.marking import submit
from grader.validate.mutant import Mutant
from grader.validate.named import read_mutants
from grader.validate.validation import solution_of
from grader.verdict.mark import mark
from grader.verdict.order import Order, make_orders
from tests.processes import ROOT

LESSONS = ("hello_time", "draw_circle", "start_stop", "own_message", "stay_inside")
KEYS = ROOT / "grader" / "keys"
Z = 1.96  # of a 95 % interval
BEGIN, END = "<!-- made by make bench-diagnosis -->", "<!-- end -->"


@dataclass
class Explained:
    """What one failed verdict said."""

    mutant: str
    line: bool
    change: bool
    back: bool
    said: str
    seconds: float
    plain: float = 0


@dataclass
class Row:
    """The verdicts of one lesson; `passed` are mutants with which no check failed."""

    lesson: str
    explained: list[Explained] = field(default_factory=list)
    passed: int = 0

    def share(self, of: Callable[[Explained], bool]) -> str:
        """Return a share of the failed verdicts in %, with Wilson's 95 % interval."""
        count, total = sum(map(of, self.explained)), len(self.explained)
        if not total:
            return "-"
        share, spread = count / total, Z * Z / total
        middle = (share + spread / 2) / (1 + spread)
        half = Z / (1 + spread) * math.sqrt(share * (1 - share) / total + spread / (4 * total))
        return f"{100 * share:.0f} ({100 * (middle - half):.0f} to {100 * (middle + half):.0f})"

    def __str__(self) -> str:
        timed = [one for one in self.explained if one.plain]
        ratio = statistics.median(one.seconds / one.plain for one in timed) if timed else math.nan
        cells = [
            self.lesson,
            str(len(self.explained)),
            self.share(lambda one: one.line),
            self.share(lambda one: one.change),
            self.share(lambda one: one.back),
            f"{ratio:.1f}",
        ]
        return f"| {' | '.join(cells)} |"


HEAD = (
    "| lesson | failed verdicts | line named, % | change shown, % | it is the way back, % "
    "| time of a verdict with a search to one without |\n|---|---|---|---|---|---|"
)


def main() -> int:
    """Measure and print."""
    options = argparse.ArgumentParser(description=__doc__)
    options.add_argument("--each", type=int, default=12, help="mutants of each lesson")
    options.add_argument("--lesson", choices=LESSONS, action="append")
    options.add_argument("--shift", type=int, default=0, help="another sample: begin with the n-th")
    options.add_argument("--write", type=Path, help="the page whose table is replaced")
    asked = options.parse_args()
    rows = []
    for lesson in asked.lesson or LESSONS:
        row = measured(lesson, asked.each, asked.shift)
        rows.append(row)
        print(row, flush=True)
    whole = Row("all", [one for row in rows for one in row.explained])
    table = "\n".join([HEAD, *map(str, [*rows, whole])])
    print(f"\n{table}")
    if asked.write:
        text = asked.write.read_text(encoding="utf-8")
        made = f"{BEGIN}\n{table}\n{END}"
        asked.write.write_text(
            re.sub(f"{BEGIN}.*?{END}", lambda _: made, text, flags=re.DOTALL), encoding="utf-8"
        )
    return 0


def measured(lesson: str, count: int, shift: int) -> Row:
    """Mark mutants of a lesson."""
    row = Row(lesson)
    (order,) = make_orders(
        KEYS / lesson / "solution", lesson, "jazzy", "bubblewrap", (), keys=KEYS / lesson
    )
    solution = solution_of(KEYS / lesson, order.assignment)
    for number, mutant in enumerate(chosen(lesson, order, solution, count, shift)):
        mutated = mutant.of(solution)
        report, seconds = marked(mutated, order)
        failed = [check for check in report.checks if check.status == "failed"]
        if not failed:
            row.passed += 1
            continue
        found = explained(mutant.name, failed, solution, mutated, seconds)
        if number % 4 == 0:
            _, found.plain = marked(mutated, replace(order, tries_fixes=False))
        row.explained.append(found)
        signs = "".join("x" if one else "-" for one in (found.line, found.change, found.back))
        print(f"  {signs} {seconds:5.1f} s  {mutant.name[:60]:60} {found.said}", flush=True)
    return row


def chosen(lesson: str, order: Order, solution: Tree, count: int, shift: int) -> Iterator[Mutant]:
    """Yield mutants: half of them named by the lesson's author, half automatic, spread evenly."""
    named = read_mutants(
        KEYS / lesson / "mutants.yaml",
        checks=[use.id for use in order.assignment.checks],
        kinds=CATALOGUE,
        distro=find_distro("jazzy"),
        beside=bool(order.assignment.others),
    ).mutants
    automatic = list(generate(solution, order.assignment))
    for of_kind in (named, automatic):
        mutants = [one for one in of_kind if not one.equivalent]
        step = max(1, 2 * len(mutants) // count)
        yield from mutants[shift % step :: step][: (count + 1) // 2]


def marked(tree: Tree, order: Order) -> tuple[Report, float]:
    """Return a package's report, and the seconds of wall time that it took."""
    submission = submit(tree, order)
    begin = time.perf_counter()
    report = mark(submission, order, unheard)
    return report, time.perf_counter() - begin


def explained(
    name: str, failed: Sequence[CheckResult], solution: Tree, mutated: Tree, seconds: float
) -> Explained:
    """Return what the failed checks say of a mutant."""
    causes = [check for check in failed if not check.consequence_of]
    places = [check.where for check in causes if check.where is not None]
    patches = [check.patch for check in failed if check.patch]
    changed = changed_lines(solution, mutated)
    named = any(
        place.file.endswith(path) and (not lines or place.line in lines)
        for place in places
        for path, lines in changed.items()
    )
    first = causes[0] if causes else failed[0]
    said = f"{first.id}: {first.mistakes[0].id if first.mistakes else '-'}"
    back = any(is_back(patch, solution, mutated) for patch in patches)
    return Explained(name, named, bool(patches), back, said, seconds)


def changed_lines(solution: Tree, mutated: Tree) -> Mapping[str, set[int]]:
    """Return the lines of the mutant that are changed, by file; none for a whole file."""
    found: dict[str, set[int]] = {}
    for path in sorted({*solution, *mutated}):
        old, new = solution.get(path), mutated.get(path)
        if old is None or new is None or old.mode != new.mode:
            found[path] = set()
        elif old.data != new.data:
            found[path] = _lines(old.data, new.data)
    return found


def _lines(old: bytes, new: bytes) -> set[int]:
    first, second = (data.decode("utf-8", "replace").splitlines() for data in (old, new))
    lines: set[int] = set()
    for tag, _, _, begin, end in difflib.SequenceMatcher(None, first, second, False).get_opcodes():
        if tag != "equal":  # (where a line is missing, the lines beside it)
            lines |= set(range(begin + 1, end + 1)) if end > begin else {begin, begin + 1}
    return lines


def is_back(patch: str, solution: Tree, mutated: Tree) -> bool:
    """Whether a change makes the solution of a mutant."""
    with tempfile.TemporaryDirectory() as folder:
        place = Path(folder) / "package"
        write_tree(mutated, place)
        done = subprocess.run(
            ["git", "apply", "-"], input=patch.encode(), cwd=place, capture_output=True, check=False
        )
        if done.returncode:
            return False
        return all(
            (place / path).is_file()
            and _read(path, (place / path).read_bytes()) == _read(path, file.data)
            for path, file in solution.items()
            if not file.target and file.data
        )


def _read(path: str, data: bytes) -> str:
    """Return a file as its reader sees it: Python without its layout, other text without blanks."""
    text = data.decode("utf-8", "replace")
    if path.endswith(".py"):
        try:
            return ast.dump(ast.parse(text))
        except (SyntaxError, ValueError):
            return text
    return "".join(text.split())


if __name__ == "__main__":
    sys.exit(main())
