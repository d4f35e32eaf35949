"""Classes on disk: folders of students with packages of the corpus, or many small ones."""

from __future__ import annotations

import json
import os
import sqlite3
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path

from tests.batch.pool_tasks import package
from tests.corpus.broken import BROKEN
from tests.corpus.right import RIGHT
from tests.processes import ROOT, grader, replaying, run

SOLUTION = ROOT / "grader/keys/hello_time/solution/my_robot_controller"


def corpus_class(folder: Path, names: Sequence[str]) -> Path:
    """Write a class of packages of the corpus, one student each: `s00-solution`, …"""
    width = len(str(len(names)))
    for number, name in enumerate(names):
        package(name, folder, called=f"s{number:0{width}}-{name}")
    return folder


def mixed_names(count: int) -> list[str]:
    """Return the names of `count` packages, evenly split: the solution, right and broken variants.

    Packages that wait on the wall clock are left out because they would distort the timing.
    """
    right = [p.name for p in RIGHT if not p.wall_clock]
    broken = [p.name for p in BROKEN if not p.wall_clock and not p.hostile and not p.undecided]
    half = [right[n * len(right) // (count // 2)] for n in range(count // 2)]
    rest = count - len(half)
    other = [broken[n * len(broken) // rest] for n in range(rest)]
    return [name for pair in zip(half, other, strict=False) for name in pair] + other[len(half) :]


def large_class(folder: Path, count: int) -> Path:
    """Write a class of `count` students whose packages differ only in one comment."""
    files = {p.relative_to(SOLUTION): p for p in SOLUTION.rglob("*") if p.is_file()}
    contents = {place: path.read_bytes() for place, path in files.items() if place.suffix != ".pyc"}
    for number in range(count):
        root = folder / f"student-{number:04}" / "my_robot_controller"
        for place, content in contents.items():
            path = root / place
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(content)
            if place.name == "my_first_node.py":
                path.write_bytes(content + f"# student {number}\n".encode())
                path.chmod(0o755)
    return folder


def replay_all(
    folder: Path, out: Path, *words: str, env: dict[str, str] | None = None
) -> subprocess.CompletedProcess[str]:
    """Run the command on a class and mark it from recorded evidence."""
    command = replaying("grade-all", folder, "--out", out, "--sandbox", "bubblewrap", *words)
    return run(command, env=env, timeout=300)


def grade_all(
    folder: Path, out: Path, *words: str, env: dict[str, str] | None = None, timeout: float = 900
) -> subprocess.CompletedProcess[str]:
    """Run the command on a class, with `--quiet` by default."""
    command = grader("grade-all", folder, "--out", out, "--sandbox", "bubblewrap", *words)
    return subprocess.run(
        command,
        cwd=ROOT,
        env={**os.environ, **(env or {})},
        capture_output=True,
        text=True,
        timeout=timeout,
        check=False,
    )


MEASURED = """
import functools, json, sys
from grader.publish import class_run as g
from grader.batch.local_pool import LocalPool
from grader.cli.main import main
stub = json.loads(sys.argv[1])
if stub:
    g.LocalPool = functools.partial(LocalPool, command=tuple(stub))
status = main(sys.argv[2:])
from tests.memory import peak_memory
print(json.dumps({"status": status, "peak": peak_memory()}))
"""


def measured(
    folder: Path, out: Path, *words: str, report: Path | None = None, timeout: float = 1800
) -> tuple[int, float]:
    """Run the command on a class; return its exit status and the peak of its own memory in MB.

    With a `report` the workers are stubs that return it.
    """
    stub = [] if report is None else [sys.executable, "-m", "tests.batch.stub_worker", str(report)]
    command = [sys.executable, "-c", MEASURED, json.dumps(stub), "grade-all", str(folder)]
    command += ["--out", str(out), "--sandbox", "bubblewrap", "--quiet", *words]
    done = subprocess.run(
        command,
        cwd=ROOT,
        capture_output=True,
        text=True,
        timeout=timeout,
        check=False,
        env={**os.environ, "PYTHONPATH": str(ROOT)},
    )
    if not done.stdout.strip().endswith("}"):
        raise AssertionError(done.stdout[-1000:] + done.stderr[-3000:])
    found = json.loads(done.stdout.strip().splitlines()[-1])
    return found["status"], found["peak"]


def count_verdicts(path: Path) -> int:
    """Return the number of verdicts in a ledger in use by another process; 0 if it is missing."""
    if not path.is_file():
        return 0
    connection = sqlite3.connect(path, timeout=20)
    try:
        return int(connection.execute("SELECT count(*) FROM verdict").fetchone()[0])
    except sqlite3.OperationalError:  # its tables are being created
        return 0
    finally:
        connection.close()
