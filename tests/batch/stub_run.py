"""Run the real command on a class with verdicts that are the scores in the nodes' sources.

Everything else is real: the command line, the sandbox and its proof, intake, ledger, outputs.
"""

from __future__ import annotations

import csv
import io
import re
import sys
from dataclasses import dataclass
from pathlib import Path

from grader.batch.work import Answer, Job, Task
from grader.report.model import Report
from tests import processes
from tests.batch import in_process
from tests.report.samples import check, report

SCORE = re.compile(rb"# score: ([\d.]+)")


@dataclass(frozen=True)
class Run:
    """The result of a run of the command; `out` is its output folder."""

    status: int
    output: str
    out: Path

    def rows(self, name: str = "gradebook.csv") -> list[dict[str, str]]:
        """Return the rows of a CSV file in the output folder."""
        text = (self.out / name).read_bytes().decode("utf-8-sig")
        return list(csv.DictReader(io.StringIO(text, newline="")))

    def column(self, name: str, of: str, by: str) -> dict[str, str]:
        """Return a column of a CSV file as a dict keyed by another column."""
        return {row[by]: row[of] for row in self.rows(name)}

    def finals(self) -> dict[str, str]:
        """Return the final grade of each student, by name."""
        return self.column("gradebook.csv", "final", "name")

    @property
    def marked(self) -> int:
        """Return how many submissions were marked."""
        found = re.search(r"^(\d+) to mark", self.output, re.MULTILINE)
        return int(found[1]) if found else 0


def grade_all(path: Path, out: Path, *words: str | Path, quiet: bool = True) -> Run:
    """Run `grader grade-all`."""
    options = ("--out", out, "--sandbox", "bubblewrap", *(["--quiet"] if quiet else []), *words)
    command = [sys.executable, "-m", "tests.batch.stub_run", "grade-all", path, *options]
    done = processes.run(command)
    assert "Traceback" not in done.stderr, done.stderr
    return Run(done.returncode, done.stdout + done.stderr, out)


def verdict(task: Task) -> Report:
    """Return the report of a package whose node states its score: `# score: 85`."""
    if task.submission.root is None:
        return nothing_found(task)
    found = [SCORE.search(file.data) for file in task.submission.files]
    score = next(float(match[1]) for match in found if match)
    one = check("run.output", "passed" if score == 100 else "failed", score=score, max_score=100)
    made = report(checks=[one])
    return of_task(task, made, package="my_robot_controller", score=score)


def nothing_found(task: Task) -> Report:
    """Return the report of a submission without a package: nothing passed, 0 of 100."""
    failed = check("package.found", "failed", max_score=100, actual=task.submission.problem)
    return of_task(task, report(checks=[failed]), package=None, score=0)


def of_task(task: Task, made: Report, *, package: str | None, score: float) -> Report:
    """Return a report with the task's submission and these points."""
    known: dict[str, str | None] = {
        "name": task.name,
        "path": str(task.submission.path),
        "student_id": task.student_id,
    }
    known |= {"sha256": task.submission.sha256, "package": package}
    submission = made.submission.model_copy(update=known)
    return made.model_copy(update={"submission": submission, "score": score, "max_score": 100})


def mark(job: Job, task: Task) -> Answer:
    """Return the answer to a task."""
    del job
    return Answer(verdict(task))


if __name__ == "__main__":
    raise SystemExit(in_process.run(mark))
