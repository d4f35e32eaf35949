"""A prefix is tested before it counts as made, and a broken one is made again."""

from __future__ import annotations

import os
import shutil
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from grader.base.errors import SurroundingsError
from grader.ros import prefix
from grader.ros.distro import Distro, find_distro
from grader.ros.prefix import BrokenRosError, Ros, base_interpreter
from grader.sandbox import proof
from grader.sandbox.bubblewrap import Bubblewrap
from grader.sandbox.limits import Limits
from grader.sandbox.proof import prove_again, prove_ros
from tests import processes
from tests.test_cli import solution

JAZZY = find_distro("jazzy")


def small_prefix(folder: Path, *, python: Path | None = None) -> Path:
    """Write a minimal prefix into a folder: programs that print nothing and succeed."""
    (folder / "bin").mkdir(parents=True)
    (folder / "bin" / "python3").symlink_to(python or base_interpreter())
    for name in ("colcon", "ros2"):
        (folder / "bin" / name).write_text("#!/bin/sh\n")
        (folder / "bin" / name).chmod(0o755)
    (folder / "setup.bash").write_text('PATH="$(dirname "$BASH_SOURCE")/bin:$PATH"\n')
    (folder / "wheels-prefix.json").write_text("{}")
    return folder


class Maker:
    """Makes small prefixes instead of pip's; the first `broken` ones fail their proof."""

    def __init__(self, broken: int = 0) -> None:
        self.broken = broken
        self.made: list[Path] = []
        self.proven: list[Path] = []
        self.heard: list[str] = []

    def make(self, distro: Distro, staging: Path, interpreter: Path, *, notify: object) -> None:
        assert list(staging.iterdir()) == []  # nothing is left of one that failed
        self.made.append(small_prefix(staging))

    def prove(self, ros: Ros) -> None:
        assert not prefix.prefix_path(JAZZY).exists()  # it does not count before its proof
        self.proven.append(ros.path)
        if len(self.made) <= self.broken:
            raise BrokenRosError("colcon does not run", remedy="Do this.")

    def find(self) -> Path:
        return prefix.wheels_prefix(JAZZY, prove=self.prove, notify=self.heard.append)


@pytest.fixture
def maker(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Callable[[int], Maker]:
    monkeypatch.setenv("GRADER_CACHE", str(tmp_path / "cache"))

    def with_broken(broken: int) -> Maker:
        made = Maker(broken)
        monkeypatch.setattr(prefix, "make_prefix", made.make)
        return made

    return with_broken


def test_a_prefix_is_proven_once(maker: Callable[[int], Maker]) -> None:
    first = maker(0)
    folder = first.find()
    assert first.proven == first.made
    assert (folder / "bin" / "colcon").is_file()
    second = maker(0)
    assert second.find() == folder
    assert second.made == second.proven == []


def test_a_prefix_that_fails_its_proof_is_made_again(maker: Callable[[int], Maker]) -> None:
    made = maker(1)
    assert made.find().is_dir()
    assert len(made.made) == len(made.proven) == 2
    assert "colcon does not run\nmaking the prefix once more" in made.heard


def test_a_prefix_that_fails_twice_is_reported_and_not_kept(maker: Callable[[int], Maker]) -> None:
    made = maker(2)
    with pytest.raises(SurroundingsError) as caught:
        made.find()
    assert caught.value.exit_status == 3
    assert (caught.value.message, caught.value.remedy) == ("colcon does not run", "Do this.")
    assert len(made.made) == 2
    left = [path.name for path in prefix.prefix_path(JAZZY).parent.iterdir()]
    assert [name for name in left if not name.endswith(".lock")] == []


@pytest.mark.parametrize("program", ["python3", "colcon", "ros2"])
@pytest.mark.parametrize("how", ["removed", "closed", "points nowhere"])
def test_a_prefix_with_missing_programs_is_made_again(
    program: str, how: str, maker: Callable[[int], Maker]
) -> None:
    path = maker(0).find() / "bin" / program
    if how == "closed" and program != "python3":
        path.chmod(0o644)
    else:
        path.unlink()
    if how == "points nowhere":
        path.symlink_to("/no/such/python")
    again = maker(0)
    folder = again.find()
    assert len(again.made) == 1
    assert os.access(folder / "bin" / program, os.X_OK)
    assert maker(0).find() == folder
    assert [p.name for p in folder.parent.iterdir() if "making" in p.name] == []


def test_a_prefix_of_an_older_format_is_not_used(
    maker: Callable[[int], Maker], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(prefix, "FORMAT", 1)
    older = maker(0).find()
    monkeypatch.undo()
    assert prefix.FORMAT > 1
    assert prefix.prefix_path(JAZZY).name != older.name


def test_a_damaged_prefix_that_cannot_be_removed_is_reported(
    maker: Callable[[int], Maker], monkeypatch: pytest.MonkeyPatch
) -> None:
    folder = maker(0).find()
    (folder / "bin" / "colcon").unlink()

    def refused(self: Path, target: object) -> Path:
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr(Path, "rename", refused)
    with pytest.raises(SurroundingsError, match="damaged and cannot be removed: Permission denied"):
        maker(0).find()


@pytest.fixture(params=["bubblewrap", "none"])
def surroundings(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> str:
    """The sandbox in which the proof runs; `none` if bubblewrap does not open."""
    if request.param == "none":
        real = shutil.which
        monkeypatch.setattr("shutil.which", lambda name: None if name == "bwrap" else real(name))
    return str(request.param)


def test_the_real_prefix_passes_its_proof(ros_jazzy: Ros, surroundings: str) -> None:
    prove_ros(ros_jazzy)


@pytest.mark.parametrize(
    ("program", "text", "output"),
    [
        ("colcon", "#!/no/such/python\n", "colcon build --help does not run: status 12[67]"),
        ("colcon", "#!/bin/sh\necho out of order\nexit 1\n", "status 1\nout of order"),
        ("ros2", "#!/bin/sh\nexec /no/such/python\n", "ros2 --help does not run: status 127"),
        ("python3", "#!/bin/sh\necho No module named rclpy\nexit 1\n", "No module named rclpy"),
    ],
)
def test_a_prefix_with_a_failing_program_does_not_pass(
    program: str, text: str, output: str, tmp_path: Path, surroundings: str
) -> None:
    folder = small_prefix(tmp_path / "some 'path' $ü")
    (folder / "bin" / program).unlink()
    (folder / "bin" / program).write_text(text)
    (folder / "bin" / program).chmod(0o755)
    with pytest.raises(BrokenRosError, match=output) as caught:
        prove_ros(Ros(JAZZY, "wheels", folder, base_interpreter(), {}))
    assert "GRADER_CACHE" in caught.value.remedy


def test_a_system_ros_is_never_removed(tmp_path: Path) -> None:
    """ros-jazzy-ros-base has no colcon."""
    folder = small_prefix(tmp_path / "jazzy")
    (folder / "bin" / "colcon").unlink()
    system = Ros(JAZZY, "system", folder, base_interpreter(), {})
    missing = pytest.raises(BrokenRosError, match="colcon: command not found")
    with Bubblewrap(system, Limits()) as sandbox, missing as caught:
        prove_again(sandbox)
    assert "apt-get install python3-colcon-common-extensions" in caught.value.remedy
    assert folder.is_dir()


def test_an_unfinished_proof_removes_nothing(
    maker: Callable[[int], Maker], monkeypatch: pytest.MonkeyPatch
) -> None:
    folder = maker(0).find()
    monkeypatch.setattr(proof, "SECONDS", 0.0)
    made = Ros(JAZZY, "wheels", folder, base_interpreter(), {})
    untested = pytest.raises(SurroundingsError, match="cannot test whether")
    with Bubblewrap(made, Limits()) as sandbox, untested as caught:
        prove_again(sandbox)
    assert not isinstance(caught.value, BrokenRosError)
    assert folder.is_dir()


@pytest.fixture
def own_cache(
    ros_jazzy: Ros, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> Iterator[Callable[[str, str], Path]]:
    """A function that copies the prefix to a separate cache and replaces a program there."""
    # (the shared prefix is never touched, because other graders use it)
    monkeypatch.setenv("GRADER_CACHE", str(tmp_path / "cache"))

    def damaged(program: str, text: str) -> Path:
        folder = prefix.prefix_path(JAZZY)
        shutil.copytree(ros_jazzy.path, folder, symlinks=True, copy_function=_link)
        (folder / "bin" / program).unlink()
        (folder / "bin" / program).write_text(text)
        (folder / "bin" / program).chmod(0o755)
        return folder

    yield damaged
    shutil.rmtree(tmp_path / "cache", ignore_errors=True)


def _link(source: str, target: str) -> None:
    try:
        os.link(source, target, follow_symlinks=False)
    except OSError:  # the cache may be on another disk
        shutil.copy2(source, target, follow_symlinks=False)


@pytest.mark.prefix
@pytest.mark.parametrize(
    ("program", "text"),
    [
        # as made by an earlier version in a checkout with a long path
        ("colcon", "#!/bin/sh\n'''exec' \"/no/such/.venv/bin/python\" \"$0\" \"$@\"\n' '''\n"),
        *(
            pytest.param(program, text, marks=pytest.mark.long)
            for program, text in (
                ("colcon", "#!/no/such/python\n"),
                ("colcon", "#!/bin/sh\nexec python3 -c 'import no_such_colcon'\n"),
                ("ros2", "#!/no/such/python\n"),
                ("python3", "#!/bin/sh\nexit 126\n"),
            )
        ),
    ],
)
def test_a_broken_program_of_the_prefix_is_a_surroundings_error(
    program: str, text: str, own_cache: Callable[[str, str], Path], tmp_path: Path
) -> None:
    folder = own_cache(program, text)
    command = processes.grader("grade", solution(tmp_path), "--sandbox", "bubblewrap")
    done = processes.run([*command, "--out", tmp_path / "out"])
    assert done.returncode == 3, done.stdout + done.stderr
    assert "a program of ROS jazzy does not run" in done.stderr
    assert "Run the command again to make a new one." in done.stderr
    assert "Traceback (most recent call last)" not in done.stdout
    assert list((tmp_path / "out").rglob("report.json")) == []
    assert not folder.exists()  # so the next command makes it again
