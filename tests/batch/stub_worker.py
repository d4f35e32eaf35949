"""A worker without a sandbox that answers each task with the same prepared report.

It serves to measure only the cost in the coordinating process for a class of thousands.
"""

from __future__ import annotations

import sys
from pathlib import Path

from grader.batch.work import Answer, Task
from grader.report.model import Report


def main(argv: list[str]) -> int:
    """Answer tasks until the input ends: `stub_worker.py REPORT PARENT`."""
    report = Report.model_validate_json(Path(argv[0]).read_bytes())
    sys.stdin.readline()
    for line in iter(sys.stdin.readline, ""):
        task = Task.from_text(line)
        known = {"name": task.name, "path": str(task.submission.path)}
        known["sha256"] = task.submission.sha256
        submission = report.submission.model_copy(update=known)
        answer = Answer(report.model_copy(update={"submission": submission}))
        print(answer.to_text(), flush=True)
    return 0


if __name__ == "__main__":
    raise SystemExit(main(sys.argv[1:]))
