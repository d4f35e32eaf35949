"""A process that marks one submission after the other: `python -m grader.batch.worker PARENT`.

It reads lines of JSON (the job, then the tasks) and writes each answer as one line. It ends when
its input ends, on SIGTERM, and with the process that started it, even if that is killed.
"""

from __future__ import annotations

import ctypes
import os
import signal
import sys

PR_SET_PDEATHSIG = 1


def end_with(parent: int) -> None:
    """Have the kernel kill this process when its parent ends: prctl(2), Linux."""
    ctypes.CDLL(None, use_errno=True).prctl(PR_SET_PDEATHSIG, signal.SIGKILL, 0, 0, 0)
    if os.getppid() != parent:
        sys.exit(1)  # the parent ended before the prctl


def main(argv: list[str]) -> int:
    """Answer tasks until the input ends."""
    end_with(int(argv[0]))
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # the parent handles Ctrl+C
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(0))
    # what a library prints must not mix with the answers
    answers = os.fdopen(os.dup(1), "w", encoding="ascii")
    os.dup2(2, 1)
    from grader.batch import work  # noqa: PLC0415 - slow; the parent is watched first

    job = work.Job.from_text(sys.stdin.readline())
    for line in iter(sys.stdin.readline, ""):
        answers.write(work.mark_task(job, work.Task.from_text(line)).to_text() + "\n")
        answers.flush()
    return 0


if __name__ == "__main__":
    raise SystemExit(main(sys.argv[1:]))
