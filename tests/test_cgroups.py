"""Control groups version 2 on the real kernel, with a controller that version 1 does not use here.

(Where memory and pids belong to version 1, as on a hybrid system, version 2 has only the rest.)
"""

from __future__ import annotations

import json
import secrets
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from tests import processes

CODE = """
import json, os, subprocess, sys
from pathlib import Path
from grader.sandbox.cgroups import delegated_group
root, group = Path(sys.argv[1]), Path(sys.argv[2])
controllers = sys.argv[3].split()
(group / "cgroup.procs").write_text(str(os.getpid()))
child = subprocess.Popen(["sleep", "100"])
found = [delegated_group(root, controllers) for _ in range(2)]
made = group / "submission"
made.mkdir()
print(json.dumps({
    "found": [str(one) for one in found],
    "given": (group / "cgroup.subtree_control").read_text().split(),
    "left": (group / "cgroup.procs").read_text().split(),
    "leaf": Path("/proc/self/cgroup").read_text().splitlines()[-1].rpartition("/")[2],
    "files": [path.name for path in made.iterdir()],
}))
made.rmdir()
child.kill()
"""


@pytest.fixture
def version_2(tmp_path: Path) -> Iterator[Path]:
    """Return a mounted version 2 hierarchy."""
    place = tmp_path / "cgroup2"
    place.mkdir()
    subprocess.run(["mount", "-t", "cgroup2", "none", place], check=True)
    try:
        yield place
    finally:
        subprocess.run(["umount", place], check=True)


@pytest.fixture
def group(version_2: Path) -> Iterator[Path]:
    """Return a new group whose parent gives it what it has."""
    free = (version_2 / "cgroup.controllers").read_text().split()
    assert free, "no controller of this kernel is free for version 2"
    (version_2 / "cgroup.subtree_control").write_text(f"+{free[0]}")
    made = version_2 / f"test-{secrets.token_hex(4)}"
    made.mkdir()
    yield made
    for folder in sorted(made.rglob("*"), reverse=True):
        if folder.is_dir():
            folder.rmdir()
    made.rmdir()


def run(version_2: Path, group: Path, controllers: str) -> dict[str, object]:
    """Ask for a delegated group in a process that is in `group`."""
    done = processes.run([sys.executable, "-c", CODE, version_2, group, controllers], forked=False)
    assert done.returncode == 0, done.stderr
    answer: dict[str, object] = json.loads(done.stdout)
    return answer


def test_our_processes_move_to_a_leaf_so_that_controllers_can_be_given(
    version_2: Path, group: Path
) -> None:
    """The kernel answers EBUSY while the group holds processes."""
    controller = (group / "cgroup.controllers").read_text().split()[0]
    answer = run(version_2, group, controller)
    assert answer["found"] == [str(group)] * 2
    assert answer["given"] == [controller]
    assert answer["left"] == []
    assert answer["leaf"] == "ros2_grader-own"
    assert any(str(name).startswith(f"{controller}.") for name in answer["files"])  # type: ignore[attr-defined]


def test_a_group_with_other_processes_is_left_as_it_is(version_2: Path, group: Path) -> None:
    """A terminal's group holds the user's shell, which is not ours to move."""
    controller = (group / "cgroup.controllers").read_text().split()[0]
    with subprocess.Popen(["sleep", "100"]) as other:
        (group / "cgroup.procs").write_text(str(other.pid))
        answer = run(version_2, group, controller)
        other.kill()
    assert answer["given"] == []
    assert str(other.pid) in answer["left"]  # type: ignore[operator]
