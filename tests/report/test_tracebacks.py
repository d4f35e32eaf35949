"""Tracebacks in a report: ROS's and Python's own calls are folded, the student's stay."""

from __future__ import annotations

import json
import re
import time

import pytest

from grader.batch.points import single
from grader.publish.feedback import html_page
from grader.publish.markdown import markdown
from grader.report.tracebacks import folded
from tests.recorded import FOLDER
from tests.report.samples import check, render_report, report

STUDENTS = re.compile(r'File "/home/student/ros2_ws/(?:src|build|install)/[^"]*\.py"')
EXECUTABLE = re.compile(r'File "/home/student/ros2_ws/install/[^"]*/lib/\w+/\w+"')
RCLPY = re.compile(r'File "[^"]*/rclpy/[^"]*"')
INSTALLED = (
    '  File "/home/student/ros2_ws/install/my_package/lib/python3.12/site-packages/my_package/'
    'my_node.py", line 9, in main\n    spin(node)'
)
SPIN = (
    '  File "/opt/ros/jazzy/lib/python3.12/site-packages/rclpy/__init__.py", line 244, in spin\n'
    "    executor.spin_once()\n"
    '  File "/usr/lib/python3.12/threading.py", line 9, in wait\n'
    "    waiter.acquire()"
)
TRACE = f"Traceback (most recent call last):\n{INSTALLED}\n{SPIN}\n{SPIN}\nValueError: no"


def recorded() -> list[str]:
    """Return the transcripts of the recorded runs that show a traceback through rclpy."""
    texts: set[str] = set()

    def collect(value: object) -> None:
        if isinstance(value, str) and RCLPY.search(value) and STUDENTS.search(value):
            texts.add(value)
        elif isinstance(value, dict | list):
            for part in value.values() if isinstance(value, dict) else value:
                collect(part)

    for path in FOLDER.glob("*.json"):
        collect(json.loads(path.read_text(encoding="utf-8")))
    return sorted(texts)


def test_the_calls_inside_ros_are_one_line() -> None:
    assert folded(TRACE).splitlines() == [
        "Traceback (most recent call last):",
        *INSTALLED.splitlines(),
        "  [... 4 calls inside rclpy, Python left out ...]",
        "ValueError: no",
    ]


def test_in_recorded_tracebacks_the_students_calls_and_the_error_stay() -> None:
    texts = recorded()
    assert any(map(EXECUTABLE.search, texts))
    for text in texts:
        short = folded(text)
        assert STUDENTS.findall(short) == STUDENTS.findall(text)
        assert not RCLPY.search(short)
        assert not EXECUTABLE.search(short)
        errors = [
            line for line in text.splitlines() if re.match(r"\w+(\.\w+)*(Error|Exception)", line)
        ]
        assert [line for line in errors if line not in short.splitlines()] == []


def test_all_reports_fold_and_verbose_shows_all() -> None:
    marked = report(check("run.starts", "failed"), evidence={"transcript": TRACE, "build_log": ""})
    pages = [
        render_report(marked),
        html_page(single(marked), "Hello", show_hidden=False).decode(),
        markdown(single(marked), "Hello", show_hidden=False),
    ]
    for page in pages:
        assert "inside rclpy" in page
        assert "my_node.py" in page
        assert "threading.py" not in page
    assert "threading.py" in render_report(marked, verbose=True)


def test_a_text_without_such_a_traceback_is_unchanged() -> None:
    for text in ("", "Hello time: 0\r\n", f"Traceback (most recent call last):\n{INSTALLED}\nE: x"):
        assert folded(text).replace("\r\n", "\n") == text.replace("\r\n", "\n")


@pytest.mark.parametrize("part", ['  File "', SPIN + "\n", '  File "/lib/python3', "    "])
def test_a_hostile_text_takes_little_time(part: str) -> None:
    begin = time.process_time()
    folded(part * (300_000 // len(part)))
    assert time.process_time() - begin < 2
