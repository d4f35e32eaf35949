"""What the build installed must be what the sources declare."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from grader.course.assignment import CheckUse
from grader.report.model import CheckResult
from grader.run.run import Run
from grader.run.workspace import Build, Installed
from grader.verdict.checks.as_declared import wrapper_digest
from grader.verdict.checks.installed import executable, mapping
from grader.verdict.evidence import Evidence
from grader.verdict.outcome import Failed, Passed
from tests.static_bench import BUILT, Bench

NAME = "my_robot_controller"
SCRIPT = f"install/{NAME}/lib/{NAME}/test_node"
METADATA = f"build/{NAME}/{NAME}.egg-info/entry_points.txt"
ENTRY = f"[console_scripts]\ntest_node = {NAME}.my_first_node:main\n"
WRAPPER = """\
#!/opt/ros/jazzy/bin/python3
# -*- coding: utf-8 -*-
import re
import sys
from my_robot_controller.my_first_node import main
if __name__ == '__main__':
    sys.argv[0] = re.sub(r'(-script\\.pyw|\\.exe)?$', '', sys.argv[0])
    sys.exit(main())
"""


def build(**more: object) -> Build:
    """Return a right build with other facts about it."""
    files = {SCRIPT: Installed("f", 0o755, len(WRAPPER))}
    right = replace(BUILT, files=files, entry_files={METADATA: ENTRY}, scripts={SCRIPT: WRAPPER})
    return replace(right, **more)  # type: ignore[arg-type]


def ask(bench: Bench, made: Build) -> Passed | None:
    static = bench.evidence()
    evidence = Evidence(static.assignment, static.submission, build=lambda: made, run=no_run)
    outcome = mapping.evaluate(evidence, CheckUse(id=mapping.id, points=1))
    assert isinstance(outcome, Passed)
    evidence.results[mapping.id] = passed(mapping.id)
    return executable.function(evidence)


def passed(check: str) -> CheckResult:
    return CheckResult(id=check, title="", status="passed", score=10, max_score=10)


def no_run() -> Run:
    raise AssertionError("nothing is run")


@pytest.fixture
def bench(tmp_path: Path) -> Bench:
    return Bench(tmp_path / NAME)


def test_a_script_of_the_entry_point_passes(bench: Bench) -> None:
    assert ask(bench, build()) is not None


def test_evidence_without_scripts_passes(bench: Bench) -> None:
    """Recordings made before these fields have none."""
    assert ask(bench, build(entry_files={}, scripts={})) is not None


@pytest.mark.parametrize(
    "made",
    [
        build(scripts={SCRIPT: WRAPPER.replace("import sys\n", "import sys, os\n")}),
        build(scripts={SCRIPT: WRAPPER.replace("my_first_node", "other")}),
        build(scripts={SCRIPT: WRAPPER + "print('more')\n"}),
        build(entry_files={METADATA: ENTRY.replace("my_first_node", "other")}),
        build(
            entry_files={METADATA: ENTRY, "install/x/entry_points.txt": ENTRY.replace("my_", "")}
        ),
        build(altered=(f"{NAME}/my_first_node.py",)),
    ],
    ids=["import", "module", "more", "metadata", "second metadata", "source"],
)
def test_anything_else_fails(bench: Bench, made: Build) -> None:
    with pytest.raises(Failed) as caught:
        ask(bench, made)
    assert caught.value.mistake.id == "entry_point.other_installed"


def test_a_script_for_another_distribution_fails(bench: Bench) -> None:
    with pytest.raises(Failed, match="not the script"):
        ask(bench, build(scripts={SCRIPT: f"__requires__ = 'other==1.0'\n{WRAPPER}"}))


def test_the_digest_does_not_depend_on_the_names() -> None:
    other = WRAPPER.replace("my_robot_controller.my_first_node", "a.b").replace("main", "run")
    assert wrapper_digest(WRAPPER, "test_node", f"{NAME}.my_first_node:main") == wrapper_digest(
        other.replace("__run__", "__main__"), "x", "a.b:run"
    )


OTHER_SCRIPT = f"install/{NAME}/lib/{NAME}/hello"


@pytest.mark.parametrize("target", [f"{NAME}.talker:main", f"{NAME}.my_first_node:start"])
def test_the_advice_says_where_an_executable_leads_that_is_there(bench: Bench, target: str) -> None:
    (said,) = advice(bench, f"test_node = {target}\nhello = {NAME}.my_first_node:main\n")
    assert said.startswith(f"test_node starts '{target}', not '{NAME}.my_first_node:main'. hello ")
    assert "no executable" not in said


def test_the_advice_says_if_the_executable_is_not_there(bench: Bench) -> None:
    (said,) = advice(bench, f"hello = {NAME}.my_first_node:main\n")
    assert said.startswith("There is no executable test_node. hello ")


def advice(bench: Bench, entries: str) -> list[str]:
    """Return the advice on a package of which `hello` is run."""
    files = {path: Installed("f", 0o755, len(WRAPPER)) for path in (SCRIPT, OTHER_SCRIPT)}
    made = build(
        files=files, entry_files={METADATA: f"[console_scripts]\n{entries}"},
        scripts={OTHER_SCRIPT: WRAPPER}, entry_points=f"[console_scripts]\n{entries}",
    )  # fmt: skip
    static = bench.evidence()
    evidence = Evidence(static.assignment, static.submission, build=lambda: made, run=no_run)
    evidence.results[mapping.id] = passed(mapping.id)
    found = executable.function(evidence)
    assert found is not None
    return [str(line) for line in found.advice]
