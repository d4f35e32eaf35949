"""The commands of docs/students.md are there and do what the page says."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from tests import processes
from tests.lab.kinds import Kind
from tests.lab.screen import Lab

PAGES = ("students.md", "students.ko.md")
OUTSIDE = "make lab"
ENDLESS = ("lab", "window", "lab reset 6")  # they wait for a key


def commands(page: str) -> list[str]:
    """Return the commands of a page, in its order."""
    text = (processes.ROOT / "docs" / page).read_text(encoding="utf-8")
    blocks = re.findall(r"^```\n(.*?)^```$", text, re.MULTILINE | re.DOTALL)
    return [line for block in blocks for line in block.splitlines()]


def test_both_languages_have_the_same_commands() -> None:
    first, second = map(commands, PAGES)
    assert first == second
    assert first[0] == OUTSIDE


@pytest.mark.parametrize(
    "lang",
    [pytest.param("en", marks=pytest.mark.full), pytest.param("ko", marks=pytest.mark.long)],
)
def test_the_commands_of_the_page_work(lang: str, tmp_path: Path) -> None:
    env = {"GRADER_LANG": lang, "LANG": "C.UTF-8"}
    with Lab(Kind("bubblewrap"), tmp_path / "ros2_ws", env=env) as lab:
        create = "ros2 pkg create --build-type ament_python my_robot_controller"
        lab.type(f"cd ~/ros2_ws/src && {create} --dependencies rclpy > /dev/null")
        inner = "~/ros2_ws/src/my_robot_controller/my_robot_controller"
        lab.type(f"touch {inner}/my_first_node.py")
        for line in commands(PAGES[0]):
            if line == OUTSIDE:
                continue
            if line in ENDLESS:
                lab.screen.sendline(line)
                lab.screen.expect(r"q |http://127\.0\.0\.1:|\[y/N\]: ")  # (then it reads the key)
                lab.interrupt()
                continue
            said = lab.type(line)
            assert "command not found" not in said
            assert "Traceback" not in said
        assert lab.leave() == 0
        assert (tmp_path / "ros2_ws/submit/hello_time.zip").is_file()
