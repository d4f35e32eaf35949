"""Which programs run on a terminal, asked of the kernel."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

from grader.run.started_program import Seen, programs
from grader.sandbox.processes import descendants
from tests.corpus.build import write
from tests.corpus.hostile_edits import first
from tests.corpus.hostile_environment import HERE, WITH_REAL
from tests.corpus.model import Package
from tests.marking import mark

WAIT = "import time; print('there', flush=True); time.sleep(60)"


@contextmanager
def running(*command: str) -> Iterator[set[int]]:
    """Run a command that prints a line when all its processes are there; give their ids."""
    process = subprocess.Popen(command, stdout=subprocess.PIPE, text=True)
    try:
        assert process.stdout is not None
        assert process.stdout.readline() == "there\n"
        yield {process.pid, *descendants(process.pid)}
    finally:
        for pid in descendants(process.pid):
            subprocess.run(["kill", "-9", str(pid)], check=False)
        process.kill()
        process.wait()


@pytest.fixture
def script(tmp_path: Path) -> Path:
    file = tmp_path / "install" / "robot" / "lib" / "robot" / "drive"
    file.parent.mkdir(parents=True)
    file.write_text(WAIT)
    return file


def seen(pids: set[int]) -> Seen | None:
    return programs(pids, package="robot", executable="drive")


def test_the_file_of_the_entry_point_and_what_leads_to_it_are_no_others(script: Path) -> None:
    with running("sh", "-c", f"{sys.executable} {script}; true") as pids:
        assert len(pids) == 2
        assert seen(pids) == Seen(own=True, others=())


def test_what_that_file_starts_is_another_program(script: Path) -> None:
    child = f"import subprocess; subprocess.call([{sys.executable!r}, '-c', {WAIT!r}])"
    script.write_text(child)
    with running(sys.executable, str(script)) as pids:
        found = seen(pids)
    assert found is not None
    assert found.own
    assert [line.startswith(f"{sys.executable} -c") for line in found.others] == [True]


def test_a_program_in_its_place_is_named(script: Path) -> None:
    other = script.with_name("other")
    other.write_text(WAIT)
    with running("sh", "-c", f"{sys.executable} {other}; true") as pids:
        assert seen(pids) == Seen(own=False, others=(f"{sys.executable} {other}",))


def test_of_processes_that_are_not_in_sight_nothing_is_known() -> None:
    with running(sys.executable, "-c", WAIT) as pids:
        pass
    assert seen(pids) is None
    assert seen(set()) is None


@pytest.mark.prefix
@pytest.mark.full
def test_a_program_beside_the_node_is_told(tmp_path: Path) -> None:
    """The node of another file counts; the points are for a person to look at."""
    start = f"    import os, subprocess, sys\n    subprocess.call([sys.executable, {HERE}, *sys.argv[1:]])\n"
    package = Package(name="beside", edits=(*WITH_REAL, first(start + "    return\n")))
    report = mark(write(package, tmp_path))
    assert any(
        "started another program" in note and "real.txt" in note for note in report.submission.notes
    )
