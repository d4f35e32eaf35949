"""The lab in Korean: the lesson, the guide, the shell and its messages, with the same commands."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

import pytest

from grader.base.i18n.translator import LANGUAGES
from grader.ros.prefix import Ros
from lab.guide.lesson import lesson_file, read_lesson
from tests import processes
from tests.lab.helpers import run
from tests.lab.kinds import Kind
from tests.lab.screen import Lab, command, environment
from tests.lab.ten_steps import NODE
from tests.lab.workspaces import after_step, put

COURSE = processes.ROOT / "lab/course/hello_time"
WORDS = processes.ROOT / "lab/shell/words"
STARTER = COURSE / "starter/src"
OTHERS = [lang for lang in LANGUAGES if lang != "en"]
BLOCK = re.compile(r"^```.*?^```$", re.MULTILINE | re.DOTALL)
INLINE = re.compile(r"`([^`\n]+)`")
HANGUL = re.compile("[가-힣]")
PROSE = re.compile(r"(?:\b[a-z]{2,}\b +){2}[a-z]{2,}\b")
KOREAN = {"LANG": "ko_KR.UTF-8", "LC_ALL": "", "LANGUAGE": "", "GRADER_LANG": ""}


def guide(*words: str, workspace: Path, env: dict[str, str]) -> subprocess.CompletedProcess[str]:
    line = [sys.executable, "-m", "lab.guide", "--workspace", str(workspace), *words]
    return processes.run(line, env={"AMENT_PREFIX_PATH": "", "ROS_DISTRO": "", **KOREAN, **env})


REMARK = re.compile(r" +# .*$", re.MULTILINE)


def code_of(text: str) -> list[str]:
    """Return the texts to be typed, or printed, literally."""
    return [REMARK.sub("", block) for block in BLOCK.findall(text)]


def names_in(text: str) -> set[str]:
    """Return the names, commands and messages that a lesson formats as inline code."""
    return set(INLINE.findall(BLOCK.sub("", text)))


@pytest.mark.parametrize("lang", OTHERS)
@pytest.mark.parametrize(
    ("english", "other"),
    [
        (COURSE / "lesson.md", COURSE / "lesson.{lang}.md"),
        (STARTER / "README.md", STARTER / "README.{lang}.md"),
    ],
    ids=["lesson", "starter"],
)
def test_a_text_of_the_course_has_the_same_commands_and_names(
    english: Path, other: Path, lang: str
) -> None:
    one = english.read_text(encoding="utf-8")
    same = Path(str(other).format(lang=lang)).read_text(encoding="utf-8")
    assert code_of(same) == code_of(one)
    assert names_in(same) == names_in(one)
    lines = [line for line in BLOCK.sub("", same).splitlines() if line.strip()]
    lines = [line for line in lines if not line.startswith(("|--", "<!-- done: "))]
    assert [line for line in lines if not HANGUL.search(line)] == []


@pytest.mark.parametrize("lang", OTHERS)
def test_the_lesson_has_the_same_steps_with_the_same_parts(lang: str) -> None:
    one = read_lesson(lesson_file(COURSE, "en"), distro="kilted")
    same = read_lesson(lesson_file(COURSE, lang), distro="kilted")
    assert [(s.number, s.done) for s in same.steps] == [(s.number, s.done) for s in one.steps]
    for step, other in zip(one.steps, same.steps, strict=True):
        assert code_of(other.text) == code_of(step.text)
        for part in (r"^\d\. ", r"^\|", r"^\*(?!\*)"):  # the guide refers to list items by number
            found = [re.findall(part, text, re.MULTILINE) for text in (step.text, other.text)]
            assert found[0] == found[1]


def test_a_language_without_a_lesson_has_the_english_one(tmp_path: Path) -> None:
    assert lesson_file(COURSE, "fr") == COURSE / "lesson.md"


@pytest.mark.parametrize("step", range(2, 10))
def test_the_guide_names_each_next_action_in_korean(step: int, tmp_path: Path) -> None:
    """A next action that is only a command is the same in every language."""
    env = after_step(tmp_path / "ws", step, NODE)
    done = guide(workspace=tmp_path / "ws", env=env)
    assert (done.returncode, done.stderr) == (0, "")
    first, *_, last, _ = done.stdout.splitlines()  # (the last line names the hint)
    assert first.startswith(f"10단계 중 {step + 1}단계: ")
    assert last.startswith("다음: ")
    assert HANGUL.search(first.partition(": ")[2])
    english = guide("--lang", "en", workspace=tmp_path / "ws", env=env).stdout.splitlines()
    assert english[0].startswith(f"Step {step + 1} of 10: ")
    action = english[-2].removeprefix("Next: ")
    assert HANGUL.search(last.removeprefix("다음: ")) or last == f"다음: {action}"
    assert PROSE.findall(last.removeprefix("다음: ").replace(action, "")) == []


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("#!/usr/bin/env python3\n", ""),
        ("(Node)", "(object)"),
        ("self.create_timer(1.0, self.timer_callback)", "pass"),
        ("def main(", "def mian("),
        ("rclpy.spin(node)", "pass"),
        ("class MyFirstNode(Node):", "class MyFirstNode(Node)"),
    ],
)
def test_missing_parts_of_a_node_are_named_in_korean(old: str, new: str, tmp_path: Path) -> None:
    env = after_step(tmp_path / "ws", 9, NODE.replace(old, new))
    lines = guide(workspace=tmp_path / "ws", env=env).stdout.splitlines()
    (last,) = (line for line in lines if line.startswith("다음: "))
    said = "\n".join(line for line in lines if line.startswith(("다음: ", "발견: ", "찾은 것: ")))
    assert "my_first_node.py" in said
    assert HANGUL.search(last.removeprefix("다음: "))
    assert PROSE.findall(last) == []


def test_a_package_in_a_wrong_state_and_a_wrong_step_are_reported_in_korean(tmp_path: Path) -> None:
    env = after_step(tmp_path / "ws", 9, NODE)
    put(tmp_path / "ws", "src/my_robot_controller/setup.py", "setup(")
    listed = guide("list", workspace=tmp_path / "ws", env=env).stdout.splitlines()
    assert [line[:3] for line in listed[:10]] == ["[x]"] * 6 + ["[>]"] + ["[x]"] * 2 + ["[ ]"]
    assert all(HANGUL.search(line) for line in listed)
    done = guide("11", workspace=tmp_path, env={})
    assert done.returncode == 2
    assert "'11' 단계는 없습니다" in done.stderr


def test_the_shells_texts_exist_in_every_language_with_the_same_placeholders() -> None:
    def words(lang: str) -> dict[str, list[str]]:
        text = (WORDS / f"{lang}.sh").read_text(encoding="utf-8")
        found = re.findall(r"^(\w+)=(.*)$", text, re.MULTILINE)
        return {
            name: re.findall(r"%.|~/[a-z0-9_]+|\\n$", value.strip("'\"")) for name, value in found
        }

    for lang in OTHERS:
        assert words(lang) == words("en")
        lines = (WORDS / f"{lang}.sh").read_text(encoding="utf-8").splitlines()[1:]
        assert all(HANGUL.search(line) for line in lines)


def test_the_lab_has_the_language_of_the_caller(kind: Kind, tmp_path: Path) -> None:
    for words, env, lang in (
        ((), KOREAN, "ko"),
        (("--lang", "ko"), {**KOREAN, "LANG": "C.UTF-8"}, "ko"),
        (("--lang", "en"), KOREAN, "en"),
    ):
        there = Kind(kind.sandbox, {**kind.env, **env})
        done = run(there, tmp_path / "ws", *words, "--", "sh", "-c", "guide list && code .")
        assert done.returncode == 0, done.stderr
        first, *_, last = done.stdout.strip().splitlines()
        for line in (first, last):
            assert bool(HANGUL.search(line)) == (lang == "ko"), line


def test_a_check_in_the_lab_uses_the_language(kind: Kind, tmp_path: Path) -> None:
    there = Kind(kind.sandbox, {**kind.env, **KOREAN})
    done = run(there, tmp_path / "ws", "--", "check")
    assert done.returncode == 1, done.stderr
    assert "점수 0 / 100" in done.stdout
    assert "  expected  " not in done.stdout


def test_the_welcome_is_in_the_language(kind: Kind, tmp_path: Path) -> None:
    with Lab(kind, tmp_path / "ws", env=KOREAN) as lab:
        _, _, text = lab.welcome.partition("\n\n")
        assert "다음에 할 일을 한 단계씩" in text
        assert str(tmp_path / "ws") in lab.welcome
        assert PROSE.findall(text) == []
        assert lab.type("echo $lab_welcome").strip() == ""  # not left in the shell
        assert lab.leave() == 0


@pytest.mark.full
def test_usage_errors_of_the_lab_are_in_korean(ros_jazzy: Ros, tmp_path: Path) -> None:
    for words, status in (
        (["--workspace", "/"], 2),
        (["--sandbox", "dokcer"], 2),
        (["--distro", "jazy"], 2),
        (["--sandbox", "docker", "--workspace", str(tmp_path / "ws")], 3),
    ):
        done = subprocess.run(
            command(*words, "--", "true"),
            cwd=processes.ROOT,
            env=environment(**KOREAN, DOCKER_HOST="unix:///no-daemon"),
            capture_output=True,
            text=True,
            check=False,
        )
        assert done.returncode == status
        assert done.stderr.startswith("lab: ")
        assert HANGUL.search(done.stderr)
        text = re.sub(r"\(.*?\)", "", done.stderr)  # commands to be typed
        assert PROSE.findall(text) == [], done.stderr
