"""Intake of real trees: what is found in them, what is left out, and what is said about it."""

from __future__ import annotations

import os
import shutil
import socket
import struct
import subprocess
import time
from pathlib import Path

import pytest

from grader.errors import UsageError
from grader.intake.modes import git_ignores_modes
from grader.intake.modes import git_modes
from grader.intake.modes import keeps_modes
from grader.intake.naming import sanitise
from grader.intake.naming import submission_name
from grader.submission import Submission
from grader.submission import take_in

PACKAGE = "my_robot_controller"
NODE = "my_first_node.py"
NODE_PATH = f"{PACKAGE}/{NODE}"
XML = "<package format='3'>\n  <name>{}</name>\n</package>\n"


def make(root: Path, name: str = PACKAGE) -> Path:
    """Make a small package in the folder `root`."""
    (root / PACKAGE).mkdir(parents=True)
    (root / "resource").mkdir()
    (root / "resource" / name).touch()
    (root / "package.xml").write_text(XML.format(name))
    (root / "setup.py").write_text(f"from setuptools import setup\nsetup(name='{name}')\n")
    (root / PACKAGE / "__init__.py").touch()
    (root / NODE_PATH).write_text("#!/usr/bin/env python3\n")
    (root / NODE_PATH).chmod(0o755)
    return root


def take(path: Path, name: str | None = None) -> Submission:
    return take_in(path, package=PACKAGE, node_file=NODE, name=name)


def paths(submission: Submission) -> set[str]:
    return {file.path for file in submission.files}


def notes(submission: Submission) -> str:
    return "\n".join(submission.notes)


# where the package lies


@pytest.mark.parametrize("place", [".", PACKAGE, f"src/{PACKAGE}", f"week 1/ros2/ä/{PACKAGE}"])
def test_the_package_is_found_wherever_it_lies(tmp_path: Path, place: str) -> None:
    make(tmp_path / "jane" / place)
    found = take(tmp_path / "jane")
    assert found.root == place
    assert [(c.path, c.name) for c in found.candidates] == [(place, PACKAGE)]
    assert not found.problem
    assert not found.notes
    node = found.file(NODE_PATH)
    assert node is not None
    assert node.data == b"#!/usr/bin/env python3\n"
    assert node.mode == 0o755
    assert found.file("gone") is None
    assert [file.path for file in found.files] == sorted(paths(found))
    assert found.name == "jane"
    assert (found.origin, found.modes) == ("directory", "recorded")


def test_a_path_through_a_link_is_the_folder_that_it_leads_to(tmp_path: Path) -> None:
    make(tmp_path / "jane")
    (tmp_path / "link").symlink_to("jane")
    assert take(tmp_path / "link").name == "jane"


@pytest.mark.parametrize(
    ("make_it", "words"),
    [
        (lambda p: None, "there is no folder"),
        (lambda p: p.write_text("x"), "is a file"),
        (os.mkfifo, "neither a folder nor a file"),
        (lambda p: p.symlink_to(p), "cannot be read"),
        (lambda p: p.symlink_to("gone"), "there is no folder"),
    ],
)
def test_a_path_that_is_no_folder_is_wrong_usage(
    tmp_path: Path, make_it: object, words: str
) -> None:
    path = tmp_path / "thing"
    make_it(path)  # type: ignore[operator]
    with pytest.raises(UsageError, match=words) as caught:
        take(path)
    assert caught.value.exit_status == 2


def test_a_folder_that_cannot_be_read_is_wrong_usage(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def refuse(path: object) -> None:
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr(os, "scandir", refuse)
    with pytest.raises(UsageError, match="Permission denied"):
        take(tmp_path)
    with pytest.raises(UsageError, match="null"):
        take(Path("a\0b"))
    with pytest.raises(UsageError, match="File name too long"):
        take(Path("a" * 300))


# which package


def test_of_several_packages_the_one_with_the_right_name_is_taken(tmp_path: Path) -> None:
    make(tmp_path / "src/a", "another")
    make(tmp_path / "src/b")
    make(tmp_path / "src/c", "third")
    assert take(tmp_path).root == "src/b"


def test_the_name_is_the_manifests_else_setup_pys_else_the_folders(tmp_path: Path) -> None:
    (tmp_path / "a").mkdir()
    (tmp_path / "a/setup.py").write_text(f"n = '{PACKAGE}'\nsetup(name=n)\n")
    assert take(tmp_path).candidates[0].name == PACKAGE
    (tmp_path / "a/package.xml").write_text("<package><name> from_xml\n</name>")  # never closed
    assert take(tmp_path).candidates[0].name == "from_xml"
    (tmp_path / "a/package.xml").write_text("<package>")
    (tmp_path / "a/setup.py").write_text("setup(name=compute())")
    assert take(tmp_path).candidates[0].name == "a"


def test_two_packages_of_the_right_name_are_a_mistake_that_names_both(tmp_path: Path) -> None:
    make(tmp_path / "src/b")
    make(tmp_path / "src/backup")
    found = take(tmp_path)
    assert found.root is None
    assert not found.files
    assert found.problem_mistake == "package.duplicate"
    assert "src/b" in found.problem
    assert "src/backup" in found.problem
    (tmp_path / "src/backup/COLCON_IGNORE").touch()
    assert take(tmp_path).root == "src/b"


def test_a_package_inside_another_is_explained_as_colcon_sees_it(tmp_path: Path) -> None:
    make(tmp_path / "one")
    make(tmp_path / "one" / "again" / PACKAGE)
    found = take(tmp_path)
    assert found.root == "one"
    assert "never builds the inner" in found.hints[0]
    make(tmp_path / "two/outer", "outer")
    make(tmp_path / "two/outer/inner")
    found = take(tmp_path / "two")
    assert found.root == "outer/inner"
    assert "lies inside another package (outer, in outer)" in found.hints[0]


def test_the_only_package_is_taken_whatever_it_is_called(tmp_path: Path) -> None:
    make(tmp_path / "a", "my_robot")
    found = take(tmp_path)
    assert found.root == "a"
    assert found.candidates[0].name == "my_robot"
    assert not found.hints


def test_of_several_wrong_ones_the_one_with_the_node_or_the_nearest_name_is_taken(
    tmp_path: Path,
) -> None:
    make(tmp_path / "a", "alpha")
    make(tmp_path / "b", "my_robot_controler")
    found = take(tmp_path)
    assert found.root == "b"
    assert "alpha (a)" in found.hints[0]
    (tmp_path / "b" / NODE_PATH).unlink()
    assert take(tmp_path).root == "a"


def test_a_package_that_colcon_is_told_to_ignore_is_marked_with_a_hint(tmp_path: Path) -> None:
    make(tmp_path / "src/a")
    (tmp_path / "src/COLCON_IGNORE").touch()
    found = take(tmp_path)
    assert found.root == "src/a"
    assert "0 packages finished" in found.hints[0]


def write(root: Path, files: list[str]) -> None:
    for file in files:
        (root / file).parent.mkdir(parents=True, exist_ok=True)
        (root / file).write_text("x")


@pytest.mark.parametrize(
    ("files", "mistake", "words"),
    [
        ([], "package.empty", "is empty"),
        ([NODE], "package.only_node", NODE),
        (["notes.txt", "a/b.py"], "package.no_manifest", "a/b.py, notes.txt"),
        (["p/Package.xml"], "package.manifest_renamed", "p/Package.xml"),
        (["p/setup.py.txt"], "package.manifest_renamed", "p/setup.py.txt"),
        (["my.zip"], "package.archive_inside", "my.zip"),
        (["build/COLCON_IGNORE", "log/x"], "package.only_build", "build/"),
    ],
)
def test_where_there_is_no_package_it_is_said_what_was_seen(
    tmp_path: Path, files: list[str], mistake: str, words: str
) -> None:
    write(tmp_path, files)
    found = take(tmp_path)
    assert (found.root, found.problem_mistake) == (None, mistake)
    assert words in found.problem
    assert found.problem_fix
    assert len(found.sha256) == 64


def test_a_link_in_place_of_the_package_is_said(tmp_path: Path) -> None:
    make(tmp_path / "elsewhere")
    (tmp_path / "given").mkdir()
    (tmp_path / "given" / PACKAGE).symlink_to(tmp_path / "elsewhere")
    found = take(tmp_path / "given")
    assert found.problem_mistake == "package.link"
    assert PACKAGE in found.problem


# what is left out


def test_links_that_lead_out_are_left_out_and_inner_ones_kept(tmp_path: Path) -> None:
    secret = tmp_path / "secret.txt"
    secret.write_text("the key")
    root = make(tmp_path / "given" / "pkg")
    (tmp_path / "given/shared.py").write_text("shared = 1\n")
    links = {
        "absolute": str(secret),
        "above": "../../secret.txt",
        "proc": "/proc/self/environ",
        "sneaky": "inner/../../../secret.txt",
        "folder_out": "../..",
        "inner": "resource",
        "dangling": "nothing/there",
        "loop_a": "loop_b",
        "loop_b": "loop_a",
        "self": "self",
        "dot": ".",
        f"{PACKAGE}/up.py": "../setup.py",
        "shared.py": "../shared.py",
    }
    for name, target in links.items():
        (root / name).symlink_to(target)
    found = take(tmp_path / "given")
    kept = {file.path: file.target for file in found.files if file.kind == "link"}
    out = {"absolute", "above", "proc", "sneaky", "folder_out", "shared.py"}
    assert kept == {name: target for name, target in links.items() if name not in out}
    assert out & paths(found) == {"shared.py"}
    shared = found.file("shared.py")
    assert shared is not None
    assert (shared.kind, shared.data) == ("file", b"shared = 1\n")
    assert "proc -> /proc/self/environ" in notes(found) or "more" in notes(found)
    assert not any(b"the key" in file.data for file in found.files)
    through = found.file(f"inner/{PACKAGE}")
    assert through is not None
    assert through.path == f"resource/{PACKAGE}"
    up = found.file(f"{PACKAGE}/up.py")
    assert up is not None
    assert up.path == "setup.py"
    for name in ("loop_a", "self", "dangling", "../secret.txt", "inner/../../x", "/etc/passwd"):
        assert found.file(name) is None


def test_what_is_neither_file_nor_folder_is_never_opened(tmp_path: Path) -> None:
    root = make(tmp_path / "p")
    os.mkfifo(root / "fifo")
    os.mkfifo(root / PACKAGE / "node.py")
    with socket.socket(socket.AF_UNIX) as server:
        server.bind(str(root / "socket"))
    begin = time.monotonic()
    found = take(root)
    assert time.monotonic() - begin < 2
    assert not {"fifo", "socket", f"{PACKAGE}/node.py"} & paths(found)
    assert "neither file nor folder" in notes(found)


def test_a_fifo_in_place_of_the_manifest_does_not_block(tmp_path: Path) -> None:
    root = make(tmp_path / "p")
    (root / "package.xml").unlink()
    os.mkfifo(root / "package.xml")
    found = take(root)
    assert found.candidates[0].name == PACKAGE
    assert found.file("package.xml") is None


def test_what_colcon_and_other_tools_have_made_is_left_out(tmp_path: Path) -> None:
    ws = tmp_path / "ws"
    root = make(ws / "src" / PACKAGE)
    for base in (ws, root):
        write(base, ["build/COLCON_IGNORE", f"build/{PACKAGE}/setup.py"])
        write(base, ["install/.colcon_install_layout", f"install/{PACKAGE}/package.xml"])
        write(base, ["log/latest/events.log"])
    write(root, [f"{PACKAGE}/__pycache__/a.pyc", "my.egg-info/PKG-INFO", ".vscode/settings.json"])
    write(root, [".DS_Store", ".venv/bin/python", "venv/pyvenv.cfg", "node_modules/a/package.xml"])
    found = take(ws)
    assert found.root == f"src/{PACKAGE}"
    assert paths(found) == paths(take(make(tmp_path / "clean")))
    assert f"src/{PACKAGE}/log/" in notes(found) or "more" in notes(found)
    assert found.sha256 == take(tmp_path / "clean").sha256


def test_a_students_own_module_called_log_or_build_is_not_lost(tmp_path: Path) -> None:
    root = make(tmp_path / "p")
    mine = [f"{PACKAGE}/log/__init__.py", f"{PACKAGE}/build/walls.py", "log/__init__.py"]
    write(root, [*mine, f"{PACKAGE}/env/world.py"])
    found = take(root)
    assert {*mine, f"{PACKAGE}/env/world.py"} <= paths(found)
    assert not found.notes


def test_hostile_names_are_left_out_and_shown_harmlessly(tmp_path: Path) -> None:
    root = make(tmp_path / "p")
    for name in (b"\xff\xfe.py", b"a\nb.py", b"\x1b[2J.py", "a\u2028b".encode(), b"x\x7fy"):
        (Path(os.fsdecode(os.fsencode(root) + b"/" + name))).write_text("x")
    write(root, ["-rf", "$(touch x)", "a b;c", "名前.py", "émile.py", "back\\slash"])
    found = take(root)
    assert {"-rf", "$(touch x)", "a b;c", "名前.py", "émile.py", "back\\slash"} <= paths(found)
    assert len(paths(found)) == 6 + len(paths(take(make(tmp_path / "clean"))))
    text = notes(found)
    assert "not plain UTF-8" in text
    assert all(line.isprintable() for line in found.notes)
    text.encode()


def test_a_package_in_a_folder_of_a_hostile_name_is_not_taken(tmp_path: Path) -> None:
    make(Path(os.fsdecode(os.fsencode(tmp_path) + b"/given/p\xff")))
    assert take(tmp_path / "given").problem_mistake == "package.empty"
    inside = take(Path(os.fsdecode(os.fsencode(tmp_path) + b"/given/p\xff")))
    assert inside.root == "."
    inside.name.encode()


# bounds


def test_a_tree_that_is_too_deep_is_cut(tmp_path: Path) -> None:
    root = make(tmp_path / "p")
    deep = root
    for _ in range(60):
        deep /= "d"
        deep.mkdir()
    (deep / "bottom").touch()
    found = take(root)
    assert found.root == "."
    assert not any(path.endswith("bottom") for path in paths(found))
    assert "folders deep" in notes(found)


def test_ten_thousand_files_in_the_package_are_too_many_and_beside_it_no_matter(
    tmp_path: Path,
) -> None:
    root = make(tmp_path / "given/src" / PACKAGE)
    for n in range(100):
        folder = tmp_path / "given/photos" / str(n)
        folder.mkdir(parents=True)
        for k in range(100):
            (folder / str(k)).touch()
    begin = time.monotonic()
    assert take(tmp_path / "given").root == f"src/{PACKAGE}"
    (tmp_path / "given/photos").rename(root / "photos")
    found = take(tmp_path / "given")
    assert found.root is None
    assert found.problem_mistake == "package.too_large"
    assert "5,000" in found.problem
    assert time.monotonic() - begin < 5


def test_one_folder_of_very_many_names_is_cut(tmp_path: Path) -> None:
    make(tmp_path / "given/z")
    (tmp_path / "given/data").mkdir()
    for n in range(6_000):
        (tmp_path / f"given/data/{n}").touch()
    found = take(tmp_path / "given")
    assert found.root == "z"
    assert "first 5000 names" in notes(found)


def test_a_large_file_has_no_data_and_a_reason(tmp_path: Path) -> None:
    root = make(tmp_path / "p")
    with (root / "bag.db3").open("wb") as file:
        file.truncate(3_000_000_000)
    found = take(root)
    bag = found.file("bag.db3")
    assert bag is not None
    assert bag.unreadable
    assert not bag.data
    assert "larger than 5 MB" in bag.reason
    assert "bag.db3" in notes(found)


def test_a_package_of_very_many_bytes_is_too_large(tmp_path: Path) -> None:
    root = make(tmp_path / "p")
    (root / "0").write_bytes(b"x" * 4_900_000)
    for n in range(1, 12):
        os.link(root / "0", root / str(n))
    assert take(root).problem_mistake == "package.too_large"


def test_links_to_one_large_file_do_not_multiply_it(tmp_path: Path) -> None:
    root = make(tmp_path / "given/p")
    (tmp_path / "given/large").write_bytes(b"x" * 4_900_000)
    for n in range(300):
        (root / f"link{n}").symlink_to("../large")
    assert take(tmp_path / "given").problem_mistake == "package.too_large"
    (tmp_path / "given/large").write_bytes(b"x")
    assert "more than 200 links" in notes(take(tmp_path / "given"))


def test_links_that_multiply_take_bounded_time(tmp_path: Path) -> None:
    root = make(tmp_path / "p")
    (root / "l0").symlink_to("resource")
    for n in range(1, 150):
        (root / f"l{n}").symlink_to("/".join([f"l{n - 1}", ".."] * 80))
    begin = time.monotonic()
    assert take(root).root == "."
    assert time.monotonic() - begin < 5


def test_a_file_that_cannot_be_read_is_kept_with_the_reason(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    root = make(tmp_path / "p")
    really = os.open

    def refuse(path: str | Path, flags: int, *rest: int) -> int:
        if str(path).endswith(NODE):
            raise PermissionError(13, "Permission denied")
        return really(path, flags, *rest)

    monkeypatch.setattr(os, "open", refuse)
    node = take(root).file(NODE_PATH)
    assert node is not None
    assert node.unreadable
    assert "Permission denied" in node.reason
    assert "Permission denied" in notes(take(root))


def test_a_folder_that_cannot_be_read_is_noted(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    root = make(tmp_path / "p")
    really = os.scandir

    def refuse(path: str | Path) -> object:
        if str(path).endswith("resource"):
            raise PermissionError(13, "Permission denied")
        return really(path)

    monkeypatch.setattr(os, "scandir", refuse)
    found = take(root)
    assert found.root == "."
    assert "a folder that cannot be read (Permission denied): resource" in notes(found)


# what is known of it


def test_the_hash_follows_content_and_exec_bit_and_not_place_or_time(tmp_path: Path) -> None:
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
def test_the_name_is_the_folders_or_that_of_the_first_parent_that_says_more(
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
def test_a_name_is_made_fit_for_a_file(given: str, name: str) -> None:
    assert sanitise(given) == name


def test_no_name_is_too_long_for_a_file_system() -> None:
    assert len(sanitise("𠮷" * 100).encode()) <= 200


def test_a_given_name_is_sanitised(tmp_path: Path) -> None:
    assert take(make(tmp_path / "p"), name="../Jane").name == "_Jane"


def test_file_systems_without_modes_are_known_by_the_mount_that_is_nearest(tmp_path: Path) -> None:
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
    """A checkout with the exec bit in its index and none in its files."""
    root = tmp_path / "clone"
    make(root / "src" / PACKAGE)
    git(root, "init", "-q")
    git(root, "add", "-A")
    (root / "src" / PACKAGE / NODE_PATH).chmod(0o644)
    return root


def test_a_checkout_is_known_as_one(checkout: Path) -> None:
    found = take(checkout)
    assert (found.origin, found.modes) == ("git", "recorded")
    node = found.file(NODE_PATH)
    assert node is not None
    assert node.mode == 0o644
    assert not any(".git" in path for path in paths(found))


def test_where_git_ignores_exec_bits_its_index_tells_them(checkout: Path) -> None:
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
    git(checkout, "add", "--intent-to-add", "later.py")  # an extended flag: version 3
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
    ],
)
def test_gits_configuration_is_read_as_text(tmp_path: Path, text: str, ignored: bool) -> None:
    (tmp_path / ".git").mkdir()
    (tmp_path / ".git/config").write_text(text)
    assert git_ignores_modes(tmp_path) is ignored


def test_a_repository_whose_configuration_would_run_a_program_runs_none(checkout: Path) -> None:
    mark = checkout / "ran"
    config = f"[core]\n\tfileMode = false\n\tfsmonitor = touch {mark}\n\tpager = touch {mark}\n"
    (checkout / ".git/config").write_text(config)
    assert take(checkout).modes == "recorded"
    assert not mark.exists()


def test_the_submission_is_left_as_it_was(tmp_path: Path) -> None:
    root = make(tmp_path / "p")
    before = sorted((str(p), p.stat().st_mtime_ns) for p in root.rglob("*"))
    take(root)
    assert sorted((str(p), p.stat().st_mtime_ns) for p in root.rglob("*")) == before
    shutil.rmtree(root)


def test_where_the_nodes_file_lies_outside_the_package_is_told(tmp_path: Path) -> None:
    root = make(tmp_path / "ws/src" / PACKAGE)
    (root / NODE_PATH).rename(tmp_path / "ws/src" / NODE)
    assert take(tmp_path / "ws").node_files == (f"src/{NODE}",)
