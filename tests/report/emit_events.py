"""A program that emits the events of a verdict, one for each line on its standard input.

`python -m tests.report.emit_events [WORD…]`: `fail` raises in the middle, `hidden` runs a hidden
check, `print` prints while the live line is shown.
"""

from __future__ import annotations

import sys

from grader.report.events import (
    CheckFinished,
    CheckStarted,
    Event,
    Note,
    StageFinished,
    StageStarted,
    TickSeen,
)
from grader.report.terminal import LiveProgress
from tests.report.samples import TITLES, check


def events(words: list[str]) -> list[Event]:
    name = "run.output"
    visibility = "hidden" if "hidden" in words else "visible"
    return [
        StageStarted("build", "building with colcon"),
        StageFinished("build", 1.9),
        StageStarted("run", "running the node"),
        CheckStarted(name, TITLES[name][0], "hidden" if visibility == "hidden" else "visible"),
        TickSeen(0, "Hello time: 0\x1b[2J\x9b31m\u202e[red]", 1.0),
        Note("a second attempt, the machine is busy [red]\x1b]0;title\x07"),
        CheckFinished(check(name, visibility=visibility)),
        StageFinished("run", 1.4),
    ]


def main() -> None:
    words = sys.argv[1:]
    with LiveProgress() as progress:
        for event in events(words):
            sys.stdin.readline()
            progress(event)
            if "print" in words and isinstance(event, Note):
                print("in between")
            if "fail" in words and isinstance(event, CheckStarted):
                raise SystemExit("stopped on the way")
        sys.stdin.readline()
    print("the end")


if __name__ == "__main__":
    main()
