"""A process that marks one submission after the other: `python -m grader.batch.worker PARENT`.

It reads lines of JSON (the job, then tasks) and writes one line an answer. It ends with its input,
on SIGTERM, and with the process that started it, however that ends.
"""

from __future__ import annotations

import ctypes
import os
import signal
import sys

PR_SET_PDEATHSIG = 1


def end_with(parent: int) -> None:
    """Have the kernel end this process with its parent: Linux, prctl(2)."""
    ctypes.CDLL(None, use_errno=True).prctl(PR_SET_PDEATHSIG, signal.SIGKILL, 0, 0, 0)
    if os.getppid() != parent:
        sys.exit(1)  # it has ended meanwhile


def main(argv: list[str]) -> int:
    """Answer until the input ends."""
    end_with(int(argv[0]))
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl+C is our parent's to answer
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(0))
    # what a library prints must not come between the answers
    answers = os.fdopen(os.dup(1), "w", encoding="ascii")
    os.dup2(2, 1)
    from grader.batch import work  # noqa: PLC0415 - a parent that has gone must not wait for it

    job = work.Job.from_text(sys.stdin.readline())
    for line in iter(sys.stdin.readline, ""):
        answers.write(work.answer(job, work.Task.from_text(line)).to_text() + "\n")
        answers.flush()
    return 0


if __name__ == "__main__":
    raise SystemExit(main(sys.argv[1:]))
