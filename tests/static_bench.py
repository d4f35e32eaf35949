"""A right package on disk for the tests of the static checks."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, cast

import pytest

from grader.course.assignment import Assignment
from grader.package.submission import Submission, take_in
from grader.ros.distro import Distro
from grader.run.workspace import Build
from grader.verdict.checks.declare import Check
from grader.verdict.checks.entry_point import mapping_from_source
from grader.verdict.diagnose import Diagnosis
from grader.verdict.outcome import Failed, Outcome, Passed
from tests.marking import ASSIGNMENT

if TYPE_CHECKING:
    from grader.verdict.evidence import Evidence

ROOT = Path(__file__).resolve().parent.parent
NAME = "my_robot_controller"
NODE = f"{NAME}/my_first_node.py"
MARKER = f"resource/{NAME}"
ENTRY = "'test_node = my_robot_controller.my_first_node:main',"
BUILT = Build(command="colcon build", status=0, log="", seconds=0.0)
"""A build that went well, for what is only looked at after it."""

FILES = {
    "package.xml": """\
<?xml version="1.0"?>
<?xml-model href="http://download.ros.org/schema/package_format3.xsd"?>
<package format="3">
  <name>my_robot_controller</name>
  <version>0.0.0</version>
  <description>TODO: Package description</description>
  <maintainer email="jane@todo.todo">jane</maintainer>
  <license>TODO: License declaration</license>
  <depend>rclpy</depend>
  <export>
    <build_type>ament_python</build_type>
  </export>
</package>
""",
    "setup.py": """\
from setuptools import find_packages, setup

package_name = 'my_robot_controller'

setup(
    name=package_name,
    version='0.0.0',
    packages=find_packages(exclude=['test']),
    data_files=[
        ('share/ament_index/resource_index/packages',
            ['resource/' + package_name]),
        ('share/' + package_name, ['package.xml']),
    ],
    install_requires=['setuptools'],
    entry_points={
        'console_scripts': [
            'test_node = my_robot_controller.my_first_node:main',
        ],
    },
)
""",
    "setup.cfg": """\
[develop]
script_dir=$base/lib/my_robot_controller
[install]
install_scripts=$base/lib/my_robot_controller
""",
    MARKER: "",
    f"{NAME}/__init__.py": "",
    NODE: "#!/usr/bin/env python3\n\n\ndef main(args=None):\n    pass\n",
}


def asked(check: Check, evidence: Evidence) -> Passed:
    """Return that a check passes, as the assignment uses it; raises any other outcome."""
    uses = [use for use in evidence.assignment.checks if use.kind == check.id]
    found = check.evaluate(evidence, uses[0])
    if isinstance(found, Outcome):
        raise found
    return found


@dataclass
class StandIn:
    """The part of the evidence that the static checks use."""

    assignment: Assignment
    submission: Submission
    distro: Distro | None = None

    @property
    def asked(self) -> Assignment:
        """The assignment: the package has the names that it requires."""
        return self.assignment

    def has_mistake(self, check: str, *mistakes: str) -> bool:
        """Whether an earlier check found a mistake: each is judged on its own here."""
        del check, mistakes
        return False

    def has_failed(self, check: str) -> bool:
        """Whether an earlier check failed: each is judged on its own here."""
        del check
        return False


class Bench:
    """A right package on disk that a test changes and checks."""

    def __init__(self, root: Path) -> None:
        self.root = root
        self.assignment = ASSIGNMENT
        for path, text in FILES.items():
            self.write(path, text)
        (root / NODE).chmod(0o755)

    def write(self, path: str, content: str | bytes) -> None:
        file = self.root / path
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_bytes(content if isinstance(content, bytes) else content.encode())

    def change(self, path: str, old: str, new: str) -> None:
        text = (self.root / path).read_text()
        assert text.count(old) == 1, old
        self.write(path, text.replace(old, new))

    def evidence(self) -> Evidence:
        submission = take_in(self.root, package=NAME, node_file=self.assignment.node_file)
        return cast("Evidence", StandIn(self.assignment, submission))

    def passes(self, check: Check) -> Passed:
        return check.function(self.evidence()) or Passed()

    def fails(self, check: Check) -> Diagnosis:
        with pytest.raises(Failed) as caught:
            check.function(self.evidence())
        return explained(caught.value)

    def maps(self) -> Passed | None:
        return mapping_from_source(self.evidence())

    def misses(self) -> Diagnosis:
        with pytest.raises(Failed) as caught:
            mapping_from_source(self.evidence())
        return explained(caught.value)


def explained(outcome: Failed) -> Diagnosis:
    """Return a failure with the texts of its catalogue entry; assert that they are complete."""
    failed = Diagnosis.of(outcome)
    for text in (failed.expected, failed.actual, failed.rationale, failed.fix):
        assert text.strip()
        assert all(line.isprintable() for line in text.split("\n"))
    (mistake,) = failed.mistakes
    stage, _, slug = mistake.id.partition(".")
    assert stage in ("package", "source", "setup")
    assert slug == slug.lower()
    assert slug.isidentifier()
    return failed


def mistake(failed: Diagnosis) -> str:
    return failed.mistakes[0].id


def line(failed: Diagnosis) -> int | None:
    return failed.where.line if failed.where else None
