"""The ROS prefix made of wheels: made once, completely or not at all, with ROS's environment."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from grader.base import cache
from grader.base.errors import SurroundingsError, UsageError
from grader.ros.distro import distros, find_distro
from grader.ros.prefix import Ros, prefix_path
from grader.sandbox.proof import proven_ros
from tests import processes

SETUP_VARIABLES = {
    "ROS_DISTRO": "jazzy",
    "ROS_VERSION": "2",
    "ROS_PYTHON_VERSION": "3",
}


def sourced(prefix: Path, script: str, *, times: int = 1) -> str:
    lines = ['. "$0/setup.bash"'] * times
    command = ["bash", "-c", "\n".join([*lines, script]), str(prefix)]
    done = subprocess.run(
        ["env", "-i", "PATH=/usr/bin:/bin", *command],
        capture_output=True,
        text=True,
        check=True,
    )
    assert done.stderr == ""
    return done.stdout


def environment(text: str) -> dict[str, str]:
    return dict(line.split("=", 1) for line in text.splitlines() if "=" in line)


def test_setup_bash_gives_the_environment_of_ros(jazzy_prefix: Path) -> None:
    found = environment(sourced(jazzy_prefix, "env"))
    for name, value in SETUP_VARIABLES.items():
        assert found[name] == value
    assert found["AMENT_PREFIX_PATH"] == str(jazzy_prefix)
    assert found["PATH"].split(":")[0] == str(jazzy_prefix / "bin")
    assert Path(found["PYTHONPATH"], "rclpy").is_dir()
    assert Path(found["LD_LIBRARY_PATH"], "librcl.so").exists()


def test_sourcing_twice_changes_nothing(jazzy_prefix: Path) -> None:
    once, twice = (environment(sourced(jazzy_prefix, "env", times=n)) for n in (1, 2))
    assert once.pop("_", "") == twice.pop("_", "")
    assert once == twice


@pytest.mark.parametrize(
    "name", ["some path ü", "it's", 'a "b"', "$HOME `id` $(id)", "back\\slash"]
)
def test_setup_bash_works_in_every_folder(name: str, jazzy_prefix: Path, tmp_path: Path) -> None:
    prefix = tmp_path / name
    prefix.symlink_to(jazzy_prefix)
    output = sourced(prefix, 'printf "%s\\0" "$AMENT_PREFIX_PATH" "$PATH"; ros2 pkg prefix rclpy')
    found = output.split("\0")
    assert found == [str(prefix), f"{prefix}/bin:/usr/bin:/bin", f"{prefix}\n"]


def test_rclpy_makes_a_node_and_python_is_started_once(jazzy_prefix: Path, tmp_path: Path) -> None:
    # the wheels' .pth marks a second start with a variable
    code = (
        "import os, rclpy; rclpy.init(); print(rclpy.create_node('a').get_name(), "
        "'_ROS_WHEELS_BOOTSTRAP_COMPLETE' in os.environ)"
    )
    output = sourced(jazzy_prefix, f'HOME="{tmp_path}" exec python3 -c "{code}"')
    assert output.split() == ["a", "False"]


def assert_versions(ros: Ros, rclpy: str) -> None:
    assert ros.versions["rclpy"] == rclpy == ros.distro.rclpy
    assert ros.versions["setuptools"] == ros.distro.setuptools
    code = "import em, setuptools; print(em.__version__, setuptools.__version__)"
    assert sourced(ros.path, f"python3 -c '{code}'").split() == ["3.3.4", "68.1.2"]
    messages = "geometry_msgs.msg std_msgs.msg sensor_msgs.msg nav_msgs.msg"
    imports = "; ".join(f"import {module}" for module in messages.split())
    assert sourced(ros.path, f"python3 -c '{imports}'") == ""


def test_the_prefix_has_the_distros_versions(ros_jazzy: Ros) -> None:
    assert_versions(ros_jazzy, "7.1.6")


@pytest.mark.full  # it makes another prefix
def test_kilteds_prefix_has_the_distros_versions(ros_kilted: Ros) -> None:
    assert_versions(ros_kilted, "9.1.2")


def test_colcon_and_ros2_are_on_the_path(jazzy_prefix: Path) -> None:
    assert "colcon" in sourced(jazzy_prefix, "colcon --help | head -1")
    assert "rclpy" in sourced(jazzy_prefix, "ros2 pkg list").split()


def test_our_ros2_is_never_installed_beside_the_real_one(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A system's /opt/ros is used unchanged; nothing is written into it."""
    from grader.ros import prefix

    system = tmp_path / "opt" / "ros" / "jazzy"
    system.mkdir(parents=True)
    (system / "setup.bash").write_text("")
    real = Path

    def place(*words: str) -> Path:
        return real(tmp_path / "opt" / "ros") if words == ("/opt/ros",) else real(*words)

    monkeypatch.setattr(prefix, "Path", place)
    found = proven_ros(find_distro("jazzy"))
    assert (found.kind, found.path) == ("system", system)
    assert [p.name for p in system.rglob("*")] == ["setup.bash"]


def test_a_lock_pins_every_package_with_a_hash() -> None:
    for distro in distros().values():
        if distro.lock is None:
            continue
        blocks = distro.lock.read_text().replace("\\\n", " ").strip().splitlines()
        packages = [line for line in blocks if line.strip() and not line.startswith("#")]
        assert len(packages) > 80
        assert all("==" in line and "--hash=sha256:" in line for line in packages)


def test_a_distros_row_has_its_documentation_and_its_fast_dds_variable() -> None:
    """Fast DDS 3, from kilted on, fails if the older variable is set."""
    old = {name for name, row in distros().items() if row.dds_profile.startswith("FASTRTPS_")}
    assert old == {"humble", "jazzy"}
    for name, row in distros().items():
        assert row.documentation == f"https://docs.ros.org/en/{name}"
        assert row.dds_profile.endswith("_DEFAULT_PROFILES_FILE")


def test_a_distro_without_wheels_is_refused_with_a_fix() -> None:
    with pytest.raises(SurroundingsError, match="no ROS wheels for humble") as caught:
        prefix_path(find_distro("humble"))
    assert "make images DISTRO=humble" in str(caught.value.remedy)


def test_a_misspelt_distro_gets_a_suggestion() -> None:
    with pytest.raises(UsageError) as caught:
        find_distro("jazy")
    assert "did you mean 'jazzy'?" in caught.value.remedy


def test_the_cache_is_in_the_requested_folder(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("GRADER_CACHE", raising=False)
    monkeypatch.setenv("XDG_CACHE_HOME", "/somewhere")
    assert cache.cache_root() == Path("/somewhere/ros2_teaching_lab")
    monkeypatch.setenv("GRADER_CACHE", "/own")
    assert cache.cache_root() == Path("/own")


MAKING = """
import sys, time
from pathlib import Path
from grader.base.cache import make_once

def make(staging):
    print("making", flush=True)
    for k in range(50):
        (staging / str(k)).write_text("x")
    sys.stdin.readline()
    (staging / "last").write_text("x")

made = make_once(Path(sys.argv[1]), make, notify=lambda text: print(text, flush=True))
print("made" if made else "found", flush=True)
"""


def maker(folder: Path) -> subprocess.Popen[str]:
    return subprocess.Popen(
        [sys.executable, "-c", MAKING, str(folder)],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
        cwd=processes.ROOT,
    )


def test_a_prefix_killed_half_way_does_not_exist_and_is_made_again(tmp_path: Path) -> None:
    folder = tmp_path / "prefixes" / "jazzy"
    with maker(folder) as first:
        assert first.stdout is not None
        assert first.stdout.readline() == "making\n"
        first.send_signal(signal.SIGKILL)
    assert not folder.exists()
    assert list(folder.parent.glob(".jazzy.making-*"))
    with maker(folder) as second:
        output = second.communicate("\n")[0]
    assert output.splitlines() == ["making", "made"]
    assert (folder / "last").is_file()
    assert list(folder.parent.glob(".jazzy.making-*")) == []


def test_two_concurrent_makers_make_one_prefix(tmp_path: Path) -> None:
    folder = tmp_path / "prefixes" / "jazzy"
    with maker(folder) as first, maker(folder) as second:
        assert first.stdout is not None
        assert second.stdout is not None
        lines = {first: first.stdout.readline(), second: second.stdout.readline()}
        making = next(p for p, line in lines.items() if line == "making\n")
        waiting = second if making is first else first
        assert "waiting" in lines[waiting]
        assert making.communicate("\n")[0] == "made\n"
        assert waiting.communicate("\n")[0] == "found\n"


def test_a_full_disk_is_reported_with_its_fix(tmp_path: Path) -> None:
    def full(staging: Path) -> None:
        raise OSError(28, "No space left on device", str(staging))

    with pytest.raises(SurroundingsError) as caught:
        cache.make_once(tmp_path / "a", full, notify=print)
    assert "No space left on device" in caught.value.message
    assert "GRADER_CACHE" in caught.value.remedy
    assert list(tmp_path.glob(".a.making-*")) == []


@pytest.mark.long
def test_the_real_prefix_survives_a_kill_and_two_makers(tmp_path: Path) -> None:
    """From the network, as on a new machine: killed while unpacking, then made by two at once."""
    env = {**os.environ, "GRADER_CACHE": str(tmp_path), "PYTHONUNBUFFERED": "1"}
    command = processes.grader("prefix", "--distro", "jazzy")
    with subprocess.Popen(
        command,
        cwd=processes.ROOT,
        env=env,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
    ) as first:
        assert first.stderr is not None
        for line in first.stderr:
            if "unpacking" in line:
                os.killpg(first.pid, signal.SIGKILL)
                break
    assert [p.name for p in (tmp_path / "prefixes").iterdir() if not p.name.startswith(".")] == []
    pair = [
        subprocess.Popen(
            command,
            cwd=processes.ROOT,
            env=env,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
        )
        for _ in range(2)
    ]
    output = [process.communicate() for process in pair]
    assert [process.returncode for process in pair] == [0, 0]
    assert output[0][0] == output[1][0]
    assert sum("unpacking" in err for _, err in output) == 1
    made = Path(output[0][0].strip())
    assert json.loads((made / "wheels-prefix.json").read_text())["rclpy"] == "7.1.6"
    assert [p.name for p in made.parent.iterdir() if "making" in p.name] == []
