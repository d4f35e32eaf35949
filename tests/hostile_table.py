"""`python -m tests.hostile_table [NAME …]`: every hostile package in every sandbox, as a table.

A cell is `held` if the verdict is what the corpus expects and nothing is left over: no process, and
no container. The checks that the machine's limits may decide are not compared with the corpus, but
their outcomes must be the same in all sandboxes: `differs` names the first that is not. It exits
with 1 unless every cell is `held`. The time of each verdict goes to stderr.
"""

from __future__ import annotations

import argparse
import json
import os
import shutil
import subprocess
import sys
import tempfile
import time
from collections.abc import Sequence
from pathlib import Path

from grader.base.cache import cache_root
from grader.report.model import Report
from grader.ros import images
from grader.sandbox.processes import adopt_orphans
from tests import engine, processes
from tests.corpus.build import write
from tests.corpus.hostile import HOSTILE
from tests.corpus.model import Package
from tests.marking import LIMITS, assert_verdict, outcomes

COLUMNS = ("bubblewrap", "bubblewrap as a user", "docker")
GRADER_FAILED = 3  # exit status


def main(argv: Sequence[str]) -> int:
    """Mark the packages, print one row for each, and return the exit status."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("names", nargs="*", help="packages (default: all)")
    parser.add_argument("--columns", nargs="+", default=COLUMNS, choices=COLUMNS)
    parser.add_argument("--runs", type=int, default=1, help="verdicts for each cell")
    asked = parser.parse_args(argv)
    if "docker" in asked.columns and shutil.which("dockerd") is None:
        sys.exit("Docker is missing")
    adopt_orphans()
    packages = [one for one in HOSTILE if not asked.names or one.name in asked.names]
    print("| package | " + " | ".join(asked.columns) + " |")
    print("|---|" + "---|" * len(asked.columns))
    bad = 0
    for package in packages:
        cells, seen = [], []
        for column in asked.columns:
            said = ""
            for number in range(asked.runs):
                start = time.monotonic()
                report, one = _cell(package, column)
                took = f"{time.monotonic() - start:.1f} s, {one or 'held'}"
                print(
                    f"{package.name}, {column}, {number + 1}: {took}", file=sys.stderr, flush=True
                )
                said = said or one
                seen.append(report)
            cells.append(said or _difference(seen) or "held")
        bad += sum(cell != "held" for cell in cells)
        print(f"| {package.name} | " + " | ".join(cells) + " |", flush=True)
    print(f"\n{len(packages)} packages, {bad} cells that did not hold")
    return 1 if bad else 0


def _cell(package: Package, column: str) -> tuple[Report | None, str]:
    """Return a verdict, and what is wrong with it ("" if nothing is)."""
    before = set(processes.descendants())
    with tempfile.TemporaryDirectory() as folder:
        place = Path(folder)
        place.chmod(0o777)
        report, said = _verdict(package, column, place)
    if report is None:
        return None, said
    try:
        assert_verdict(package, report)
    except AssertionError as error:
        said = "not as expected: " + f"{error}\n".splitlines()[0].replace("|", "/")[:120]
    left = list(processes.descendants(without=before).values())
    return report, said or (f"left over: {left[0][:60]}" if left else "")


def _verdict(package: Package, column: str, place: Path) -> tuple[Report | None, str]:
    root = write(package, place)
    sandbox = column.split(maxsplit=1)[0]
    limits = [f"{name}={getattr(LIMITS, name)}" for name in ("build_seconds", "start_seconds")]
    limits.append(f"run_seconds={LIMITS.run_seconds}")
    words = [word for limit in limits for word in ("--limit", limit)]
    command = processes.grader("grade", root, "--sandbox", sandbox, "--out", place / "out", *words)
    own_images = {images.REPOSITORY_VARIABLE: engine.REPOSITORY}
    environment = {**os.environ, **own_images, "PYTHONPATH": str(processes.ROOT)}
    if column.endswith("as a user"):
        subprocess.run(["chmod", "-R", "a+rwX", place], check=True)
        command = processes.as_user(command)
        environment |= {"HOME": str(place), "GRADER_CACHE": str(cache_root())}
        environment.pop("GRADER_STATE", None)
    done = subprocess.run(
        command, cwd=processes.ROOT, env=environment, capture_output=True, text=True, check=False
    )
    written = list((place / "out").rglob("report.json"))
    if done.returncode == GRADER_FAILED or not written:
        return None, f"exit status {done.returncode}: {done.stderr.strip()[:100]}"
    return Report.model_validate(json.loads(written[0].read_text(encoding="utf-8"))), ""


def _difference(reports: Sequence[Report | None]) -> str:
    """Return the first check whose outcome is not the same in all verdicts."""
    known = [outcomes(report) for report in reports if report is not None]
    for row in zip(*known):
        if len({json.dumps(one) for one in row}) > 1:
            found = {" ".join((one[1], *one[3])) for one in row}
            return f"differs: {row[0][0]} ({', '.join(sorted(found))})"
    return ""


if __name__ == "__main__":
    raise SystemExit(main(sys.argv[1:]))
