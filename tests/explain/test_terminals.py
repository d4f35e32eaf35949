"""What terminals show is explained by its cause, or nothing is claimed.

The texts in `terminals/` are those that ROS 2, colcon, CMake, Python, pip, apt, Qt and the shells
print; most are of public questions. Each file is about one subject; `nothing.yaml` has right outputs.
"""

from __future__ import annotations

import io
from dataclasses import dataclass, field
from pathlib import Path

import pytest
import yaml

from grader.explain.explanation import NOT_IN_LAB, Reader, print_recognised
from grader.explain.from_terminal import ENTRIES, seen_in
from grader.explain.machine import Machine
from grader.explain.texts import TEXTS
from grader.ros.distro import find_distro

LAB = Machine(
    {"LAB_PROGRAMS": "/lab", "ROS_DISTRO": "jazzy", "AMENT_PREFIX_PATH": "/opt/ros/jazzy"}
)


@dataclass(frozen=True, kw_only=True)
class Shown:
    """A text, the ids of what it shows, and words that the answer has or lacks."""

    text: str
    shows: tuple[str, ...] = ()
    says: tuple[str, ...] = ()
    never: tuple[str, ...] = ()
    name: str = field(default="", compare=False)


def _read() -> list[Shown]:
    read: list[Shown] = []
    for path in sorted((Path(__file__).parent / "terminals").glob("*.yaml")):
        for number, row in enumerate(yaml.safe_load(path.read_text())):
            lists = {key: tuple(row.get(key, ())) for key in ("shows", "says", "never")}
            name = f"{path.stem} {number} {' '.join(lists['shows'])}"
            read.append(Shown(text=row["text"], name=name, **lists))
    return read


TERMINALS = _read()


def answer(text: str, machine: Machine | None = None) -> str:
    out = io.StringIO()
    print_recognised(text, file=out, reader=Reader("en", find_distro("jazzy"), machine=machine))
    return " ".join(out.getvalue().split())


@pytest.mark.parametrize("shown", TERMINALS, ids=lambda shown: shown.name)
def test_a_terminal_is_explained_by_its_cause_or_nothing_is_claimed(shown: Shown) -> None:
    assert [seen.kind.id for seen in seen_in(shown.text)] == list(shown.shows)
    said = answer(shown.text)
    assert [words for words in shown.says if words not in said] == []
    assert [words for words in shown.never if words in said] == []


def test_every_entry_has_a_text() -> None:
    """(An entry without a pattern is only printed by its id; one needs a machine.)"""
    shown = {name for one in TERMINALS for name in one.shows}
    assert {text.id for text in TEXTS if text.seen and not text.only_if_found} - shown == set()


def test_a_fix_for_the_lab_names_only_its_commands() -> None:
    """(Two of them are for the machine outside, and say so.)"""
    inside = {text.id: text.in_lab for text in TEXTS if text.in_lab}
    inside.pop("lab.owned_by_root")
    assert {name: found for name, fix in inside.items() if (found := NOT_IN_LAB.findall(fix))} == {}


@pytest.mark.parametrize(
    ("text", "says", "never"),
    [
        ("sudo: ros2: command not found", ["without sudo"], ["usermod"]),
        ("$ rviz2\nqt.qpa.xcb: could not connect to display", ["Run window"], ["docker", "ssh"]),
        ("Package 'turtlesim' not found", ["Ask your instructor"], ["sudo", "computer that printed"]),
        ("E: Unable to locate package ros-jazzy-joy",
         ["This is for the computer that printed the text. The lab has no sudo, apt-get."], []),
        ("permission denied while trying to connect to the Docker daemon socket at unix:///x",
         ["The lab has no sudo, docker."], []),
        ("ros2 run: error: the following arguments are required: executable_name", [],
         ["computer that printed"]),
    ],
)  # fmt: skip
def test_in_the_lab_its_own_commands_are_named(
    text: str, says: list[str], never: list[str]
) -> None:
    said = answer(text, LAB)
    assert [words for words in says if words not in said] == []
    assert [words for words in never if words in said] == []


def test_general_entries_speak_only_if_nothing_else_does() -> None:
    general = {name for name, kind in ENTRIES.items() if kind.stage == "general"}
    for shown in TERMINALS:
        found = {seen.kind.id for seen in seen_in(shown.text)}
        assert not (found & general) or found <= general
