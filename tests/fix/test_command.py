"""The contract of `grader fix`: what it prints, what it writes, its exit statuses."""

from __future__ import annotations

import io
import shutil
import zipfile
from pathlib import Path

import pexpect
import pytest

from grader.package.edit.tree import Chmod, Delete, Replace, Write
from tests import processes
from tests.corpus.model import INNER, MANIFEST, MARKER, NODE, SETUP
from tests.fix.corpus_fixes import TOOLS, edited, plan_of, with_tool
from tests.fix.test_disk import tree

NAME = Replace(MANIFEST, "<name>my_robot_controller<", "<name>my_robot_controler<")
EMPTY = Write(NODE, b"")


def test_a_dry_run_is_the_default_and_prints_what_apply_writes(tmp_path: Path) -> None:
    root = edited(tmp_path, NAME, Delete(MARKER))
    before = tree(tmp_path)
    done = processes.run(processes.grader("fix", "--no-run", root))
    assert done.returncode == 0, done.stderr
    assert tree(tmp_path) == before
    assert (
        processes.run(processes.grader("fix", "--dry-run", "--no-run", root)).stdout == done.stdout
    )
    copy = with_tool(TOOLS[0], done.stdout.encode(), root)
    assert plan_of(copy).patch == b""
    assert "fixes  package.manifest" in done.stderr
    assert "--apply" in done.stderr


def test_apply_writes_and_says_where_the_old_files_are(tmp_path: Path) -> None:
    root = edited(tmp_path, NAME)
    done = processes.run(processes.grader("fix", "--apply", "--no-run", root))
    assert done.returncode == 0, done.stderr
    assert f"{MANIFEST}.~1~" in done.stderr
    assert (root / f"{MANIFEST}.~1~").is_file()
    again = processes.run(processes.grader("fix", "--apply", "--no-run", root))
    assert (again.returncode, again.stdout) == (0, "")
    assert "Nothing is wrong" in again.stderr


def test_a_file_of_the_package_is_answered_with_its_folder(tmp_path: Path) -> None:
    root = edited(tmp_path, NAME)
    done = processes.run(processes.grader("fix", root / NODE))
    assert done.returncode == 2
    assert f"Give the folder of the package: {root}\n" in done.stderr
    assert "archive" not in done.stderr


def test_unfixable_mistakes_are_named_and_the_status_is_1(tmp_path: Path) -> None:
    root = edited(tmp_path, EMPTY, NAME)
    done = processes.run(processes.grader("fix", "--apply", root))
    assert done.returncode == 1
    assert "left    source.node_file: the file is empty" in done.stderr
    assert "was not run" in done.stderr
    assert plan_of(root).new.data(MANIFEST) == (root / MANIFEST).read_bytes()


def test_one_check_alone_can_be_fixed(tmp_path: Path) -> None:
    root = edited(tmp_path, NAME, Delete(MARKER), Chmod(NODE, 0o644))
    done = processes.run(processes.grader("fix", "--apply", "--check", "package.marker", root))
    assert done.returncode == 0, done.stderr
    assert (root / MARKER).is_file()
    assert {finding.check for finding in plan_of(root).fixed} == {
        *("package.manifest", "source.exec_bit"),
    }


def test_an_unreadable_setup_py_is_not_reported_as_right(tmp_path: Path) -> None:
    root = edited(tmp_path, Replace(SETUP, "setup(\n    name", "setup of the (\n    name"))
    done = processes.run(processes.grader("fix", "--no-run", root))
    assert done.returncode == 1
    assert "left    entry_point.mapping: the files alone do not show it" in done.stderr
    one = processes.run(processes.grader("fix", "--check", "entry_point.mapping", root))
    assert one.returncode == 1


def test_a_missing_comma_in_setup_py_is_added_without_a_run(tmp_path: Path) -> None:
    root = edited(tmp_path, Replace(SETUP, "version='0.0.0',", "version='0.0.0'"), NAME)
    done = processes.run(processes.grader("fix", "--apply", "--no-run", root))
    assert done.returncode == 0, done.stderr
    assert "version='0.0.0'," in (root / SETUP).read_text()


def test_the_package_inside_a_workspace_is_fixed(tmp_path: Path) -> None:
    root = edited(tmp_path, NAME)
    workspace = tmp_path / "ros2_ws"
    shutil.copytree(root, workspace / "src" / INNER)
    done = processes.run(processes.grader("fix", "--apply", "--no-run", workspace))
    assert done.returncode == 0, done.stderr
    assert (workspace / "src" / INNER / f"{MANIFEST}.~1~").is_file()


def test_a_folder_without_a_package_is_reported_with_status_1(tmp_path: Path) -> None:
    done = processes.run(processes.grader("fix", tmp_path))
    assert done.returncode == 1
    assert "package.found" in done.stderr


def _zip(root: Path) -> bytes:
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w") as archive:
        for path in root.rglob("*"):
            archive.write(path, path.relative_to(root.parent))
    return stream.getvalue()


def test_a_usage_error_has_status_2_and_writes_nothing(tmp_path: Path) -> None:
    root = edited(tmp_path, NAME)
    archive = tmp_path / "handed_in.zip"
    archive.write_bytes(_zip(root))
    inside = tmp_path / "inside"
    inside.mkdir()
    shutil.copy(archive, inside / "handed_in.zip")
    before = tree(tmp_path)
    for words, output in (
        ([archive], "Unpack"),
        ([inside], "Unpack"),
        ([tmp_path / "nowhere"], "no file or folder"),
        ([root, "--check", "package.marke"], "did you mean 'package.marker'?"),
        ([root, "--assignment", "hello_tme"], "hello_time"),
        ([root, "--distro", "jazzy,kilted"], "one distro"),
        ([], "path/to/my_package"),
    ):
        done = processes.run(
            processes.grader("fix", "--apply", "--no-run", *words),
            cwd=tmp_path,
            env={"HOME": str(tmp_path)},
        )
        assert (done.returncode, done.stdout) == (2, ""), words
        assert output in done.stderr
        assert "Traceback" not in done.stderr
    assert tree(tmp_path) == before


def test_a_read_only_file_has_status_2_and_nothing_is_written(tmp_path: Path) -> None:
    root = edited(tmp_path, NAME, Delete(MARKER))
    (root / MANIFEST).chmod(0o444)
    before = tree(root)
    done = processes.run(processes.grader("fix", "--apply", "--no-run", root))
    assert done.returncode == 2
    assert "read-only" in done.stderr
    assert tree(root) == before


def test_a_diff_is_coloured_on_a_terminal_and_plain_in_a_pipe(tmp_path: Path) -> None:
    root = edited(tmp_path, NAME)
    words = processes.grader("fix", "--no-run", root)
    shown, status = pexpect.run(
        " ".join(words),
        cwd=str(processes.ROOT),
        withexitstatus=True,
        env={"TERM": "xterm-256color"},
    )
    assert status == 0
    assert b"\x1b[32m+  <name>my_robot_controller</name>" in shown
    assert "\x1b" not in processes.run(words).stdout


def test_control_characters_of_a_submission_do_not_reach_the_terminal(tmp_path: Path) -> None:
    root = edited(
        tmp_path,
        Replace(SETUP, "'test_node = my", "'test_nod = my"),
        Replace(
            SETUP,
            "        'console_scripts'",
            "        # \x1b]0;title\x07\n        'console_scripts'",
        ),
    )
    words = " ".join(processes.grader("fix", "--no-run", root))
    shown, status = pexpect.run(
        words, cwd=str(processes.ROOT), withexitstatus=True, env={"TERM": "xterm-256color"}
    )
    assert status == 0
    assert b"\x1b]0;" not in shown
    assert b"\\x1b]0;title" in shown


@pytest.mark.full  # it marks the package for real, twice
@pytest.mark.prefix
def test_a_mistake_found_by_a_run_is_fixed_and_run_again(tmp_path: Path) -> None:
    root = edited(
        tmp_path,
        Replace(NODE, "'Hello time: ' + str(self.counter_)", "'Hello time: {self.counter_}'"),
        Replace(NODE, "'my_first_node'", "'my_node'"),
        Delete(MARKER),
    )
    done = processes.run(processes.grader("fix", "--apply", root))
    assert done.returncode == 0, done.stderr
    assert "f'Hello time: {self.counter_}'" in (root / NODE).read_text()
    assert "running the node" in done.stderr
    again = processes.run(processes.grader("fix", root))
    assert (again.returncode, again.stdout) == (0, ""), again.stderr
