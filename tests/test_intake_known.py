"""What intake finds out about a submission: hash, name, exec bits."""

from __future__ import annotations

import os
import shutil
import struct
import subprocess
from pathlib import Path

import pytest

from grader.package.intake.modes import git_ignores_modes, git_modes, keeps_modes
from grader.package.intake.naming import sanitise, submission_name

from .small_package import NODE, NODE_PATH, PACKAGE, make, paths, take


def test_the_hash_depends_on_content_and_exec_bit_only(tmp_path: Path) -> None:
    first = take(make(tmp_path / "a"))
    second = make(tmp_path / "b/c/d")
    assert take(tmp_path / "b").sha256 == first.sha256
    os.utime(second / "setup.py", (0, 0))
    (second / "setup.py").chmod(0o600)
    assert take(second).sha256 == first.sha256
    (second / NODE_PATH).chmod(0o644)
    changed = take(second).sha256
    assert changed != first.sha256
    (second / NODE_PATH).write_text("# other\n")
    assert take(second).sha256 not in (changed, first.sha256)
    (second / "link").symlink_to("setup.py")
    linked = take(second).sha256
    (second / "link").unlink()
    (second / "link").symlink_to("setup.cfg")
    assert take(second).sha256 != linked


@pytest.mark.parametrize(
    ("path", "name"),
    [
        ("/home/jane/ros2_ws/src/my_robot_controller", "jane"),
        ("/home/jane/ros2_ws", "jane"),
        ("/home/jane/ros2_ws/src", "jane"),
        ("/home/jane/colcon_ws/", "jane"),
        ("/home/jane/workspace/src", "jane"),
        ("/home/jane/week_1", "week_1"),
        ("/my_robot_controller", "my_robot_controller"),
        ("/", "submission"),
        ("/x/Jane Doe (2)", "Jane_Doe_2_"),
    ],
)
def test_the_name_is_that_of_the_folder_or_of_the_nearest_specific_parent(
    path: str, name: str
) -> None:
    assert submission_name(Path(path), PACKAGE) == name


@pytest.mark.parametrize(
    ("given", "name"),
    [
        ("Jörg Müller", "Jörg_Müller"),
        ("Jo\u0308rg", "Jörg"),
        ("李雷", "李雷"),
        ("नेहा", "नेहा"),
        ("../../etc", "_.._etc"),
        (".hidden", "hidden"),
        ("--help", "help"),
        (".", "submission"),
        ("..", "submission"),
        ("", "submission"),
        ("a\0b\nc", "a_b_c"),
        ("\udcff", "submission"),
        ("x" * 200, "x" * 80),
        ("$(reboot); rm -rf /", "_reboot_rm_-rf_"),
    ],
)
def test_a_name_is_made_a_valid_file_name(given: str, name: str) -> None:
    assert sanitise(given) == name


def test_no_name_is_too_long_for_a_file_system() -> None:
    assert len(sanitise("𠮷" * 100).encode()) <= 200


def test_a_given_name_is_sanitised(tmp_path: Path) -> None:
    assert take(make(tmp_path / "p"), name="../Jane").name == "_Jane"


def test_file_systems_without_modes_are_detected_by_the_nearest_mount(tmp_path: Path) -> None:
    mounts = tmp_path / "mountinfo"
    mounts.write_text(
        "1 0 8:1 / / rw shared:1 - ext4 /dev/a rw\n"
        "2 1 8:2 / /mnt rw - 9p C: rw\n"
        "3 2 8:3 / /mnt/ext rw,noatime master:2 shared:3 - ext4 /dev/b rw\n"
        "4 1 8:4 / /media/my\\040stick rw - vfat /dev/c rw\n"
        "5 1 8:5 / /over rw - vfat /dev/d rw\n"
        "6 5 8:6 / /over rw - ext4 /dev/e rw\n"
        "nonsense\n"
    )
    for path, keeps in [
        ("/home/a", True),
        ("/mnt/c", False),
        ("/mnt", False),
        ("/mnt/ext/x", True),
        ("/mnt/external", False),
        ("/media/my stick/p", False),
        ("/over/p", True),
    ]:
        assert keeps_modes(Path(path), mounts) is keeps, path
    assert keeps_modes(tmp_path, tmp_path / "gone")


def git(folder: Path, *words: str) -> None:
    subprocess.run(
        ["git", "-c", "user.name=a", "-c", "user.email=a@b.example", *words],
        cwd=folder,
        check=True,
        capture_output=True,
        env={"PATH": os.environ["PATH"], "HOME": str(folder)},
    )


@pytest.fixture
def checkout(tmp_path: Path) -> Path:
    """A checkout with the exec bit in its index but not on its files."""
    root = tmp_path / "clone"
    make(root / "src" / PACKAGE)
    git(root, "init", "-q")
    git(root, "add", "-A")
    (root / "src" / PACKAGE / NODE_PATH).chmod(0o644)
    return root


def test_a_checkout_is_recognised(checkout: Path) -> None:
    found = take(checkout)
    assert (found.origin, found.modes) == ("git", "recorded")
    node = found.file(NODE_PATH)
    assert node is not None
    assert node.mode == 0o644
    assert not any(".git" in path for path in paths(found))


def test_if_git_ignores_exec_bits_they_come_from_its_index(checkout: Path) -> None:
    git(checkout, "config", "core.fileMode", "false")
    found = take(checkout)
    node = found.file(NODE_PATH)
    assert node is not None
    assert (found.modes, node.mode) == ("recorded", 0o755)
    (checkout / "src" / PACKAGE / PACKAGE / "new.py").touch()
    assert take(checkout).modes == "unknown"


def test_without_a_usable_index_exec_bits_are_unknown(checkout: Path) -> None:
    git(checkout, "config", "core.fileMode", "false")
    index = checkout / ".git/index"
    whole = index.read_bytes()
    for content in (b"", b"DIRC", whole[:80], whole[:12] + b"\xff" * 200, b"DIRC" + b"\xff" * 999):
        index.write_bytes(content)
        assert take(checkout).modes == "unknown"
    index.unlink()
    index.symlink_to("/etc/passwd")
    assert take(checkout).modes == "unknown"


def test_the_index_is_read_as_git_wrote_it(checkout: Path) -> None:
    modes = git_modes(checkout)
    assert modes[f"src/{PACKAGE}/{NODE_PATH}"] == 0o755
    assert modes[f"src/{PACKAGE}/setup.py"] == 0o644
    assert len(modes) == 5
    git(checkout, "add", "--intent-to-add", "--all")
    (checkout / "later.py").touch()
    git(checkout, "add", "--intent-to-add", "later.py")  # an extended flag requires version 3
    assert struct.unpack(">I", (checkout / ".git/index").read_bytes()[4:8]) == (3,)
    assert len(git_modes(checkout)) == 6


@pytest.mark.parametrize(
    ("text", "ignored"),
    [
        ("[core]\n\tfilemode = false\n", True),
        ("[CORE]\nFileMode=No\n", True),
        ("[core]\n\tfilemode = true\n", False),
        ("[other]\n\tfilemode = false\n", False),
        ("[core]\n", False),
        ("[core]\n\tfilemode = true\n\tfilemode = false\n", True),
        ("[core]\n\tfilemode = false\n[user]\n[core]\n\tfilemode = true\n", False),
        ("[core]\n\tfilemode = false\n[other]\n\tfilemode = true\n", True),
    ],
)
def test_the_git_configuration_is_read_as_text(tmp_path: Path, text: str, ignored: bool) -> None:
    (tmp_path / ".git").mkdir()
    (tmp_path / ".git/config").write_text(text)
    assert git_ignores_modes(tmp_path) is ignored


def test_a_program_in_a_repositorys_configuration_is_not_run(checkout: Path) -> None:
    mark = checkout / "ran"
    config = f"[core]\n\tfileMode = false\n\tfsmonitor = touch {mark}\n\tpager = touch {mark}\n"
    (checkout / ".git/config").write_text(config)
    assert take(checkout).modes == "recorded"
    assert not mark.exists()


def test_the_submission_is_not_changed(tmp_path: Path) -> None:
    root = make(tmp_path / "p")
    before = sorted((str(p), p.stat().st_mtime_ns) for p in root.rglob("*"))
    take(root)
    assert sorted((str(p), p.stat().st_mtime_ns) for p in root.rglob("*")) == before
    shutil.rmtree(root)


def test_a_node_file_outside_the_package_is_located(tmp_path: Path) -> None:
    root = make(tmp_path / "ws/src" / PACKAGE)
    (root / NODE_PATH).rename(tmp_path / "ws/src" / NODE)
    assert take(tmp_path / "ws").node_files == (f"src/{NODE}",)
