"""Verdicts in containers equal those in bubblewrap and leave nothing behind."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest
from docker import DockerClient

from grader.report.model import Report
from grader.sandbox import orphans
from tests import engine, processes
from tests.corpus.broken import BROKEN
from tests.corpus.build import write
from tests.corpus.hostile import HOSTILE, WAITED_FOR
from tests.corpus.model import Package
from tests.corpus.right import RIGHT
from tests.docker.test_containers import made_by
from tests.marking import assert_full_marks, assert_verdict, mark

pytestmark = [pytest.mark.docker]
VERDICTS = 50


def some(corpus: tuple[Package, ...], each: int, *, later: int) -> list[object]:
    """Return every n-th package of a corpus for CI, and more of them for the long run."""
    return [
        pytest.param(
            package,
            id=package.name,
            marks=() if n % each == 0 and package.name not in WAITED_FOR else pytest.mark.long,
        )
        for n, package in enumerate(corpus)
        if n % each == 0 or n % later == 0
    ]


@pytest.mark.parametrize("package", some(RIGHT, 160, later=10))
def test_a_right_variant_gets_full_marks_in_containers(package: Package, tmp_path: Path) -> None:
    report = mark(write(package, tmp_path), sandbox="docker")
    assert_full_marks(package, report)
    assert report.environment.sandbox == "docker"


@pytest.mark.parametrize("package", some(BROKEN, 400, later=9))
def test_a_broken_package_fails_alike_in_containers(package: Package, tmp_path: Path) -> None:
    assert_verdict(package, mark(write(package, tmp_path), sandbox="docker"))


@pytest.mark.parametrize("package", some(HOSTILE, 21, later=4))
def test_a_hostile_package_harms_nothing_in_containers(
    package: Package, tmp_path: Path, client: DockerClient
) -> None:
    report = mark(write(package, tmp_path), sandbox="docker")
    assert_verdict(package, report)
    assert made_by(client, os.getpid()) == []


def test_the_report_names_the_image_and_what_is_in_it(tmp_path: Path) -> None:
    report = mark(write(RIGHT[0], tmp_path), sandbox="docker")
    found = report.environment
    assert found.ros == "image"
    assert found.image.startswith(f"{engine.REPOSITORY}:grade-jazzy@sha256:")
    assert found.rclpy.startswith("7.1.")  # as in REP 2000 for jazzy
    assert found.colcon
    assert found.python.startswith("3.")
    assert found.limits["memory"].held_by == found.limits["cpus"].held_by == "cgroup"


@pytest.mark.long
def test_several_distros_give_a_matrix(tmp_path: Path) -> None:
    root = write(RIGHT[0], tmp_path / "in")
    command = processes.grader("grade", root, "--sandbox", "docker", "--distro", "jazzy,kilted")
    done = processes.run([*command, "--out", tmp_path / "out"])
    assert done.returncode == 0, done.stdout + done.stderr
    assert "jazzy" in done.stdout
    assert "kilted" in done.stdout
    (matrix,) = (tmp_path / "out").rglob("matrix.json")
    assert json.loads(matrix.read_text())
    reports = [
        Report.model_validate(json.loads(path.read_text()))
        for path in (tmp_path / "out").rglob("report.json")
    ]
    assert {report.environment.ros for report in reports} == {"image", "wheels"}


@pytest.mark.long
def test_fifty_verdicts_leave_the_daemon_as_it_was(client: DockerClient, tmp_path: Path) -> None:
    before = everything(client)
    root = write(RIGHT[0], tmp_path)
    code = (
        "import sys; from pathlib import Path; from tests.marking import mark\n"
        f"scores = [mark(Path(sys.argv[1]), sandbox='docker').score for _ in range({VERDICTS})]\n"
        "print(scores.count(100.0))"
    )
    done = subprocess.run(
        [sys.executable, "-c", code, root],
        cwd=processes.ROOT,
        capture_output=True,
        text=True,
        check=False,
        timeout=900,
    )
    assert done.stdout.strip() == str(VERDICTS), done.stderr
    assert {left for left in everything(client) - before if not is_anothers(left)} == set()


def everything(client: DockerClient) -> set[tuple[str, str, str]]:
    """Return every container, network and volume as kind, id and owner."""
    containers = {
        ("container", str(each["Id"]), owner(each["Labels"]))
        for each in client.api.containers(all=True)
    }
    networks = {("network", str(each["Id"]), "") for each in client.api.networks()}
    volumes = {
        ("volume", str(each["Name"]), owner(each["Labels"]))
        for each in client.api.volumes()["Volumes"] or ()
    }
    return containers | networks | volumes


def owner(labels: dict[str, str] | None) -> str:
    return json.dumps(labels or {})


def is_anothers(left: tuple[str, str, str]) -> bool:
    """Return whether it belongs to a concurrent test: to a running grader or a lab."""
    labels = json.loads(left[2] or "{}")
    if orphans.OWNER in labels:
        return not orphans.is_orphan(labels)
    return any(name.startswith("ros2-teaching-lab.lab") or "somebody" in name for name in labels)
