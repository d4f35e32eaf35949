"""The contract of the `grader` command: exit statuses, messages, files and processes."""

from __future__ import annotations

import json
import os
import secrets
import signal
import subprocess
import sys
from pathlib import Path

import pytest

import grader
from grader.cli.main import COMMANDS
from grader.package.edit.tree import Write
from tests import processes
from tests.corpus.build import write
from tests.corpus.model import Package

WITH_SYSTEMS = {"convert", "grade-all"}  # their options come from the systems' records
NODE = "my_robot_controller/my_first_node.py"


def solution(folder: Path) -> Path:
    return write(Package(name="solution", edits=()), folder)


def waiting(folder: Path, mark: str) -> Path:
    """Write a package whose setup.py starts a program with `mark` and waits for it."""
    code = f"import subprocess\nsubprocess.run({mark.split()!r})\n"
    return write(Package(name="waiting", edits=(Write("setup.py", code),)), folder)


def test_help_names_the_commands_and_exit_statuses() -> None:
    done = processes.run(processes.grader("--help"), forked=False)
    assert done.returncode == 0
    for word in ("grade", "check", "prefix", "130"):
        assert word in done.stdout
    assert processes.run(processes.grader("grade", "--help")).returncode == 0


def test_version() -> None:
    assert grader.__version__ in processes.run(processes.grader("--version")).stdout


@pytest.mark.parametrize(
    ("words", "output"),
    [
        (["grade", "/no/such/path"], "/no/such/path"),
        (["grade"], "PATH"),
        (["grdae", "x"], "grdae"),
        (["grade", ".", "--distro", "jazy"], "did you mean 'jazzy'?"),
        (["grade", ".", "--distro", ","], "no distro"),
        (["grade", ".", "--sandbox", "bubblewarp"], "did you mean 'bubblewrap'?"),
        (["grade", ".", "--assignment", "hello_tme"], "hello_time"),
        (["grade", ".", "--assignment", "no/such.yaml"], "no/such.yaml"),
        (["grade", ".", "--limit", "memry=3"], "did you mean 'memory'?"),
        (["grade", ".", "--limit", "memory=lots"], "NAME=NUMBER"),
        (["grade", ".", "--limit", "memory=-1"], "above 0"),
    ],
)
def test_a_usage_error_has_status_2_with_a_message_and_no_traceback(
    words: list[str], output: str
) -> None:
    done = processes.run(processes.grader(*words))
    assert done.returncode == 2
    assert output in done.stderr
    assert "Traceback" not in done.stderr
    assert done.stdout == ""


def test_a_missing_sandbox_has_status_3_and_says_what_to_install(tmp_path: Path) -> None:
    for program in ("sh", "env"):
        (tmp_path / program).symlink_to(f"/bin/{program}")
    done = processes.run(
        processes.grader("grade", solution(tmp_path), "--out", tmp_path / "out"),
        env={"PATH": str(tmp_path)},
    )
    assert done.returncode == 3
    assert "install bubblewrap" in done.stderr
    assert "Traceback" not in done.stderr


def test_an_unavailable_distro_has_status_3(tmp_path: Path) -> None:
    done = processes.run(processes.grader("grade", solution(tmp_path), "--distro", "rolling"))
    assert done.returncode == 3
    assert "no ROS wheels for rolling" in done.stderr


def test_the_report_is_written_to_the_given_folder(tmp_path: Path) -> None:
    package = solution(tmp_path)
    done = processes.run(
        processes.replaying("grade", package, "--name", "Ann Lee", "--out", tmp_path / "o"),
        forked=False,
    )
    assert done.returncode == 0, done.stdout + done.stderr
    files = list((tmp_path / "o").rglob("report.json"))
    assert len(files) == 1
    report = json.loads(files[0].read_text())
    assert report["score"] == report["max_score"] == 100
    assert files[0].parent.name == "jazzy"
    assert files[0].stat().st_mode & 0o077 == 0
    assert "100" in done.stdout


@pytest.mark.parametrize(("number", "status"), [(signal.SIGINT, 130), (signal.SIGTERM, 143)])
def test_a_signal_ends_everything(tmp_path: Path, number: signal.Signals, status: int) -> None:
    mark = f"sleep 93{secrets.randbelow(10**6)}"
    package = waiting(tmp_path, mark)
    process = subprocess.Popen(
        processes.grader("grade", package, "--out", tmp_path / "o"),
        cwd=processes.ROOT,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )
    assert process.stderr is not None
    for line in process.stderr:  # one line for each stage, because it is not a terminal
        if "colcon" in line:
            break
    process.send_signal(number)
    _, output = process.communicate(timeout=30)
    assert process.returncode == status
    assert "Traceback" not in output
    assert processes.alive(mark) == []
    assert not list((tmp_path / "o").rglob("report.json"))


def test_a_closed_pipe_gives_no_traceback(tmp_path: Path) -> None:
    package = solution(tmp_path)
    command = " ".join(
        f"'{word}'" for word in processes.replaying("grade", package, "--out", tmp_path)
    )
    done = processes.run(["sh", "-c", f"{command} | true"])
    assert "Traceback" not in done.stderr


def test_a_self_check_shows_the_verdict_and_writes_no_report(tmp_path: Path) -> None:
    package = solution(tmp_path)
    done = processes.run(processes.replaying("check", package), cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    assert "100" in done.stdout
    assert "hidden" in done.stdout
    assert sorted(p.name for p in tmp_path.iterdir()) == ["solution"]


def test_a_self_check_finds_the_workspace_in_the_home_folder(tmp_path: Path) -> None:
    package = solution(tmp_path / "ros2_ws" / "src")
    package.rename(package.with_name("my_robot_controller"))
    done = processes.run(
        processes.replaying("check"), env={"HOME": str(tmp_path), "GRADER_CACHE": str(_cache())}
    )
    assert done.returncode == 0, done.stdout + done.stderr
    assert str(tmp_path / "ros2_ws") in done.stderr


@pytest.mark.full
def test_a_self_check_runs_without_a_sandbox_and_says_so(tmp_path: Path) -> None:
    package = solution(tmp_path)
    tools = tmp_path / "tools"
    tools.mkdir()
    for folder in ("/usr/bin", "/bin"):
        for tool in Path(folder).iterdir():
            if tool.name != "bwrap" and not (tools / tool.name).is_symlink():
                (tools / tool.name).symlink_to(tool)
    path = {"PATH": str(tools)}
    refused = processes.run(processes.grader("grade", package, "--out", tmp_path / "o"), env=path)
    assert refused.returncode == 3
    done = processes.run(processes.grader("check", package), env=path)
    assert done.returncode == 0, done.stdout + done.stderr
    assert "No sandbox was used" in done.stderr


@pytest.mark.full
def test_two_distros_give_a_matrix(tmp_path: Path) -> None:
    package = solution(tmp_path)
    done = processes.run(
        processes.grader("grade", package, "--distro", "jazzy,kilted", "--out", tmp_path / "o")
    )
    assert done.returncode == 0, done.stdout + done.stderr
    written = {p.name for p in (tmp_path / "o").rglob("*.json")}
    assert written == {"report.json", "evidence.json", "matrix.json"}
    assert len(list((tmp_path / "o").rglob("report.json"))) == 2
    assert "kilted" in done.stdout


@pytest.mark.parametrize("command", COMMANDS)
def test_a_command_starts_without_what_another_one_imports(command: str) -> None:
    """The other tests fork their commands from a process that has imported everything."""
    done = processes.run(processes.grader(command, "--help"), forked=False)
    assert (done.returncode, done.stderr) == (0, "")
    assert done.stdout.startswith(f"Usage: grader {command} ")


def test_start_up_imports_only_what_a_help_text_needs() -> None:
    code = "import sys, grader.cli.main; print([m for m in ('pydantic', 'rich', 'yaml', 'pexpect') "
    done = processes.run([sys.executable, "-c", code + "if m in sys.modules])"])
    assert done.stdout.strip() == "[]"


@pytest.mark.parametrize("name", sorted(set(COMMANDS) - WITH_SYSTEMS))
def test_the_help_of_a_command_imports_only_what_a_help_text_needs(name: str) -> None:
    code = (
        f"import sys; from grader.cli.main import main; main([{name!r}, '--help']); "
        "print([m for m in ('pydantic', 'rich', 'yaml', 'pexpect') if m in sys.modules])"
    )
    done = processes.run([sys.executable, "-c", code])
    assert done.stdout.splitlines()[-1] == "[]"


def test_the_help_of_the_grader_imports_no_command() -> None:
    code = (
        "import sys; from grader.cli.main import COMMANDS, main; main(['--help']); "
        "print([c.target for c in COMMANDS.values() if c.target.split(':')[0] in sys.modules])"
    )
    done = processes.run([sys.executable, "-c", code])
    assert done.stdout.splitlines()[-1] == "[]"


def _cache() -> Path:
    from grader.base.cache import cache_root

    return cache_root()


def test_the_command_works_with_an_empty_term_variable(tmp_path: Path) -> None:
    done = processes.run(
        processes.replaying("grade", solution(tmp_path), "--out", tmp_path / "o"),
        env={"TERM": "", "COLUMNS": "40", "LANG": "C", "NO_COLOR": "1"},
        forked=False,  # Python chooses the encoding of its output as it starts
    )
    assert done.returncode == 0, done.stderr
    assert "\x1b" not in done.stdout + done.stderr
    assert os.environ.get("TERM") != ""
