"""`python -m tests.bench_class`: the cost of a class, compared with a simple wall-clock grader.

All figures come from one run on this machine, which must be otherwise idle. Throughput is that of
the whole command: starting, marking, and writing every output.
"""

from __future__ import annotations

import argparse
import os
import sys
import tempfile
import time
from pathlib import Path

from grader.package.submission import take_in
from grader.ros.distro import find_distro
from grader.ros.prefix import Ros
from grader.sandbox.proof import proven_ros
from tests.batch import classes
from tests.bench import ASSIGNMENT, at_least, bound, machine_cpu, plain_grader


def main() -> int:
    """Measure and print; return 1 if a bound of the project is not kept."""
    options = argparse.ArgumentParser(description=__doc__)
    options.add_argument("--count", type=int, default=40, help="packages of the compared class")
    options.add_argument("--large", type=int, default=200, help="packages of the large class")
    options.add_argument("--stubbed", type=int, default=2000, help="packages without a sandbox")
    asked = options.parse_args()
    ros = proven_ros(find_distro("jazzy"))
    bounds = []
    with tempfile.TemporaryDirectory() as work:
        place = Path(work)
        bounds += compared(ros, place, asked.count)
        if asked.large:
            bounds += large(place, asked.large)
        if asked.stubbed:
            report = next((place / "out").glob("*solution*/jazzy/report.json"))
            bounds += stubbed(place, asked.stubbed, report)
    return 0 if all(bounds) else 1


def compared(ros: Ros, place: Path, count: int) -> list[bool]:
    """Mark a class, and every fourth package of it with the simple grader."""
    folder = classes.corpus_class(place / "class", classes.mixed_names(count))
    before, begin = machine_cpu(), time.monotonic()
    done = classes.grade_all(folder, place / "out", "--quiet")
    wall, cpu = time.monotonic() - begin, machine_cpu() - before
    if done.returncode not in (0, 1):
        sys.exit(done.stderr)
    some = sorted(folder.iterdir())[:: max(1, count // 10)][:10]
    plain = [plain_once(ros, one) for one in some]
    cores = len(os.sched_getaffinity(0))
    ours, theirs = count / wall * 60, len(plain) / sum(plain) * 60
    print(f"class of {count}: {wall:.1f} s, {ours:.1f} a minute, {cpu / count:.2f} s cpu each")
    print(f"plain grader on {len(plain)} of them: {sum(plain):.1f} s, {theirs:.2f} a minute")
    return [
        at_least("throughput: times the plain grader's", ours / theirs, 4.5),
        at_least("cores busy", cpu / wall / cores, 0.85),
    ]


def large(place: Path, count: int) -> list[bool]:
    """Mark a large class, then run again with nothing left to mark."""
    folder = classes.corpus_class(place / "large", classes.mixed_names(count))
    begin = time.monotonic()
    status, peak = classes.measured(folder, place / "large-out")
    print(f"class of {count}: {time.monotonic() - begin:.1f} s, exit status {status}")
    begin = time.monotonic()
    again = classes.grade_all(folder, place / "large-out", "--quiet")
    warm = time.monotonic() - begin
    if again.returncode != status or f"{count} marked before" not in again.stderr:
        sys.exit(f"the second run was another one:\n{again.stderr}")
    return [
        bound(f"coordinator's memory at {count}: MB", peak, 200),
        bound(f"warm rerun of {count}: seconds", warm, 2.0),
    ]


def stubbed(place: Path, count: int, report: Path) -> list[bool]:
    """Run a very large class with workers that all return the same report."""
    folder = classes.large_class(place / "many", count)
    begin = time.monotonic()
    _, peak = classes.measured(folder, place / "many-out", report=report)
    print(f"class of {count} without a sandbox: {time.monotonic() - begin:.1f} s")
    return [bound(f"coordinator's memory at {count}: MB", peak, 200)]


def plain_once(ros: Ros, student: Path) -> float:
    """Return the seconds of wall time that the simple grader takes for one package."""
    submission = take_in(student, package=ASSIGNMENT.package, node_file=ASSIGNMENT.node_file)
    return plain_grader(ros, submission).wall


if __name__ == "__main__":
    raise SystemExit(main())
