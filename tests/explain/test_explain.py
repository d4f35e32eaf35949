"""`grader explain`: an entry by its id, or the mistakes in a terminal's output."""

from __future__ import annotations

import io
import os
import re
import signal
import subprocess
import sys

import pexpect
import pytest

from grader.course.find import assignment_file
from grader.course.load import load_assignment
from grader.explain.explanation import Reader, print_entry
from grader.explain.from_terminal import ENTRIES
from grader.explain.rules import BY_MISTAKE
from grader.mistakes.retired import RETIRED
from grader.ros.distro import find_distro
from tests import processes

COMMAND = [sys.executable, "-m", "grader", "explain"]
PLACEHOLDER = re.compile(r"<(?:before|wanted|name|node_name|callback|period)>")


def environment(lang: str = "C") -> dict[str, str]:
    clean = {k: v for k, v in os.environ.items() if k not in ("LC_ALL", "LANGUAGE", "LC_MESSAGES")}
    return {**clean, "LANG": lang, "PYTHONIOENCODING": "utf-8", "COLUMNS": "100"}


def explain(*words: str, text: str = "", lang: str = "C") -> subprocess.CompletedProcess[str]:
    env = {"LC_ALL": "", "LANGUAGE": "", "LC_MESSAGES": "", "LANG": lang, "COLUMNS": "100"}
    return processes.run(processes.grader("explain", *words), env=env, stdin=text)


def test_an_entry_has_the_reason_the_fix_and_a_link() -> None:
    done = explain("setup.missing_comma")
    assert done.returncode == 0
    for output in (
        "the comma between them is missing",
        "Python joins two adjacent strings",
        "Add a comma after",
        "https://",
    ):
        assert output in done.stdout


def test_the_language_comes_from_the_environment_or_the_option() -> None:
    assert "쉼표" in explain("setup.missing_comma", lang="ko_KR.UTF-8").stdout
    assert "쉼표" in explain("setup.missing_comma", "--lang", "ko").stdout
    assert "comma" in explain("setup.missing_comma", "--lang", "en", lang="ko_KR.UTF-8").stdout


def test_an_unknown_id_is_a_usage_error_with_a_suggestion() -> None:
    done = explain("setup.mising_comma")
    assert done.returncode == 2
    assert "did you mean 'setup.missing_comma'" in done.stderr
    assert "Traceback" not in done.stderr


def test_what_a_fact_of_a_run_says_and_an_id_of_before_are_explained() -> None:
    rule = explain("node.value_from").stdout
    assert "It was last set in line …" in rule
    assert "in the place of …" in rule
    gone = explain("node.timer_again")
    assert (gone.returncode, "no longer has this mistake" in gone.stdout) == (0, True)
    assert not RETIRED & {*ENTRIES, *BY_MISTAKE}


def test_terminal_output_is_explained_root_cause_first() -> None:
    text = "RuntimeError: 'distutils.core.setup()' was never called\nNo executable found\n"
    done = explain("-", text=text)
    assert done.returncode == 0
    assert done.stdout.index("build.entry_unreadable") < done.stdout.index("lab.no_executable")
    assert "No executable found" in done.stdout


def test_a_text_without_a_known_mistake_is_reported_as_such() -> None:
    done = explain("-", text="Hello time: 0\n")
    assert done.returncode == 1
    assert "no mistake" in done.stdout


def test_control_characters_of_the_text_do_not_reach_the_terminal() -> None:
    done = explain("-", text="\x1b[31mPermission\x1b[2J ./a.py: Permission denied\x07\n")
    assert "\x1b" not in done.stdout
    assert "\x07" not in done.stdout


def test_all_entries_are_listed() -> None:
    listed = explain().stdout
    assert [kind for kind in ENTRIES if f"{kind}: " not in listed] == []


def test_an_entry_has_an_example_instead_of_a_placeholder() -> None:
    done = explain("setup.missing_comma")
    assert not PLACEHOLDER.search(done.stdout)
    assert re.search(r"Add a comma after '\w+ = \w+\.\w+:main'", done.stdout)
    assert "an example" in done.stdout


def test_every_placeholder_has_an_example(subtests: pytest.Subtests) -> None:
    """(A placeholder without a value is a KeyError.)"""
    for kind in ENTRIES:
        with subtests.test(kind):
            out = io.StringIO()
            print_entry(kind, file=out, reader=Reader("en", find_distro("jazzy")))
            assert ENTRIES[kind].title in " ".join(out.getvalue().split())


def test_the_names_of_the_lesson_are_no_example() -> None:
    out = io.StringIO()
    lesson = load_assignment(assignment_file("hello_time"))
    print_entry(
        "setup.misspelt_module", file=out, reader=Reader("en", find_distro("jazzy"), lesson)
    )
    assert f"{lesson.executable} = {lesson.target}" in " ".join(out.getvalue().split())
    assert "example" not in out.getvalue()


def test_what_is_read_is_shown_at_once_and_ctrl_c_is_for_the_program_before_the_pipe() -> None:
    """As in `ros2 run … 2>&1 | explain -`, where Ctrl+C reaches both sides of the pipe."""
    process = subprocess.Popen(
        [*COMMAND, "-"], stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
        env=environment(), cwd=processes.ROOT, bufsize=0,
    )  # fmt: skip
    assert process.stdin is not None
    assert process.stdout is not None
    process.stdin.write(b"first line\n")
    assert process.stdout.readline() == b"first line\n"
    process.send_signal(signal.SIGINT)
    process.stdin.write(b"No executable found\n")
    process.stdin.close()
    rest = process.stdout.read().decode()
    assert process.wait() == 0
    assert rest.startswith("No executable found\n\n")
    assert "lab.no_executable: " in rest


def test_empty_input_is_told_how_errors_go_through_a_pipe() -> None:
    done = explain("-", text="")
    assert done.returncode == 1
    assert "2>&1" in done.stdout
    assert "2>&1" not in explain("-", text="Hello time: 0\n").stdout


def test_the_end_of_a_long_output_is_explained() -> None:
    done = explain("-", text="Hello time: 0\n" * 200_000 + "No executable found\n")
    assert "lab.no_executable: " in done.stdout


def test_a_terminal_as_input_is_asked_for_the_output_and_ctrl_c_ends_it() -> None:
    terminal = pexpect.spawn(COMMAND[0], [*COMMAND[1:], "-"], env=environment(), cwd=str(processes.ROOT),
                             encoding="utf-8", timeout=30)  # fmt: skip
    terminal.expect("Ctrl\\+D")
    terminal.sendline("No executable found")
    terminal.sendeof()
    terminal.expect("lab.no_executable")
    terminal.expect(pexpect.EOF)
    other = pexpect.spawn(COMMAND[0], [*COMMAND[1:], "-"], env=environment(), cwd=str(processes.ROOT),
                          encoding="utf-8", timeout=30)  # fmt: skip
    other.expect("Ctrl\\+D")
    processes.wait_until_asleep(other.pid)
    other.sendintr()
    other.expect("interrupted")
    other.expect(pexpect.EOF)


def test_a_package_of_ros_is_not_to_be_built_by_the_student() -> None:
    done = explain("-", text="Package 'turtlesim' not found\n")
    assert "ros-jazzy-turtlesim" in done.stdout
    assert "local_setup" not in done.stdout
    assert (
        "ros-jazzy-demo-nodes-cpp" in explain("-", text="Package 'demo_nodes_cpp' not found").stdout
    )


def test_a_package_misspelt_by_a_letter_is_compared_with_the_lessons() -> None:
    done = explain("-", text="Package 'my_robot_controler' not found\n")
    assert "Did you mean the package my_robot_controller?" in done.stdout
    right = explain("-", text="Package 'my_robot_controller' not found\n")
    assert "Did you mean" not in right.stdout
