"""`grader shell STUDENT`: the package that was marked, built, in the sandbox in which it was marked."""

from __future__ import annotations

import sys
from pathlib import Path

import pexpect
import pytest

from grader.run.attached import Harmless
from tests.batch.classes import corpus_class, replay_all
from tests.processes import ROOT, grader, run


@pytest.fixture
def command(tmp_path: Path) -> list[str]:
    """The command line for the only student of a class."""
    folder, out = corpus_class(tmp_path / "class", ["solution"]), tmp_path / "out"
    assert replay_all(folder, out).returncode == 0
    return [*grader("shell", "s0-solution", "--out", out, "--sandbox", "bubblewrap")]


@pytest.mark.prefix
@pytest.mark.full
def test_a_person_looks_at_a_package_where_it_was_marked(command: list[str]) -> None:
    typed = pexpect.spawn(
        sys.executable, [*command[1:]], cwd=str(ROOT), timeout=60, dimensions=(33, 91)
    )
    typed.expect_exact(r"student:~/ros2_ws$ ")
    typed.sendline("stty size; id -un; ls install; cat")
    typed.expect_exact("33 91\r\nstudent\r\n")
    typed.expect_exact("my_robot_controller")
    typed.sendline("there")
    typed.expect_exact("there\r\nthere\r\n")
    typed.sendintr()
    typed.expect_exact(r"student:~/ros2_ws$ ")
    typed.sendline("echo status=$?")
    typed.expect_exact("status=130")
    typed.sendline("exit 7")
    typed.expect(pexpect.EOF)
    typed.close()
    assert typed.exitstatus == 7


@pytest.mark.prefix
@pytest.mark.long
def test_a_command_runs_without_a_terminal(command: list[str]) -> None:
    done = run([*command, "--", "ros2", "pkg", "executables", "my_robot_controller"])
    assert (done.returncode, done.stdout) == (0, "my_robot_controller test_node\n"), done.stderr
    done = run(command, stdin="printf '\\033[1mbold\\033[0m\\n'; exit 3\n")
    assert (done.returncode, done.stdout) == (3, "bold\n"), done.stderr
    unknown = run(["x" if word == "s0-solution" else word for word in command])
    assert unknown.returncode == 2
    assert "there is no student 'x'" in unknown.stderr


def test_a_program_cannot_change_the_clipboard_of_the_person() -> None:
    seen = Harmless()
    parts = [b"a\x1b]52;c;aG", b"Fy\x07b\x1b[1mc", b"\x1b", b"]0;title\x1b\\d\x1bPq", b"~\x1b\\e\n"]
    assert b"".join(map(seen, parts)) == b"ab\x1b[1mcde\n"
