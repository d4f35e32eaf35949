"""What the build installed must be what the sources declare."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from grader.base.i18n.translator import Translator
from grader.course.assignment import CheckUse
from grader.report.model import CheckResult
from grader.run.run import Run
from grader.run.workspace import Build, Installed
from grader.verdict.checks.as_declared import wrapper_digest
from grader.verdict.checks.installed import executable, mapping
from grader.verdict.evaluate import evaluate_checks
from grader.verdict.evidence import Evidence
from grader.verdict.outcome import Failed, Passed
from grader.verdict.static import static_results
from tests.static_bench import BUILT, Bench

NAME = "my_robot_controller"
SCRIPT = f"install/{NAME}/lib/{NAME}/test_node"
METADATA = f"build/{NAME}/{NAME}.egg-info/entry_points.txt"
UP_TO_MAPPING = ("package.found", "entry_point.mapping", "entry_point.executable")
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
    if isinstance(outcome, Failed):
        raise outcome
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
def test_the_mapping_fails_if_the_build_installed_anything_else(bench: Bench, made: Build) -> None:
    static = bench.evidence()
    evidence = Evidence(static.assignment, static.submission, build=lambda: made, run=no_run)
    with pytest.raises(Failed) as caught:
        mapping.function(evidence)
    assert caught.value.mistake.id == "entry_point.other_installed"


def test_a_contradiction_of_the_mapping_is_told_once(bench: Bench) -> None:
    static = bench.evidence()
    made = build(altered=(f"{NAME}/my_first_node.py",))
    evidence = Evidence(static.assignment, static.submission, build=lambda: made, run=no_run)
    found = {one.id: one for one in evaluate_checks(evidence, Translator("en"), only=UP_TO_MAPPING)}
    assert found[mapping.id].status == "failed"
    assert (found[executable.id].status, found[executable.id].blocked_by) == ("skipped", mapping.id)


def test_the_script_of_another_name_than_the_assignments_hides_no_contradiction(
    bench: Bench,
) -> None:
    """The entry point that is run leads to the right function, the declared one does not."""
    entries = (
        f"[console_scripts]\ntest_node = {NAME}.other:main\nhello = {NAME}.my_first_node:main\n"
    )
    files = {path: Installed("f", 0o755, len(WRAPPER)) for path in (SCRIPT, OTHER_SCRIPT)}
    made = build(files=files, entry_files={METADATA: entries}, entry_points=entries)
    with pytest.raises(Failed) as caught:
        ask(bench, made)
    assert caught.value.mistake.id == "entry_point.other_installed"


def test_a_script_without_an_entry_point_of_its_own_must_be_the_declared_one(bench: Bench) -> None:
    """setup.py can remove the metadata that its script contradicts."""
    forged = {SCRIPT: WRAPPER + "print('more')\n"}
    with pytest.raises(Failed):
        ask(bench, build(entry_files={}, scripts=forged))


def test_without_a_build_the_source_alone_decides_the_mapping(bench: Bench) -> None:
    static = bench.evidence()
    found = static_results(static.submission, static.assignment, mapping.id)
    assert found[mapping.id].status == "passed"


def test_a_script_for_another_distribution_fails(bench: Bench) -> None:
    with pytest.raises(Failed, match="not the script"):
        ask(bench, build(scripts={SCRIPT: f"__requires__ = 'other==1.0'\n{WRAPPER}"}))


def test_the_digest_does_not_depend_on_the_names() -> None:
    other = WRAPPER.replace("my_robot_controller.my_first_node", "a.b").replace("main", "run")
    assert wrapper_digest(WRAPPER, "test_node", f"{NAME}.my_first_node:main") == wrapper_digest(
        other.replace("__run__", "__main__"), "x", "a.b:run"
    )


EASY = """\
#!/opt/ros/jazzy/bin/python3
# EASY-INSTALL-ENTRY-SCRIPT: 'DIST','console_scripts','NAME'
import re
import sys

# for compatibility with easy_install; see #2198
__requires__ = 'DIST'

if __name__ == '__main__':
    sys.exit(load_entry_point('DIST', 'console_scripts', 'NAME')())
"""


def test_an_executable_can_have_the_name_of_its_package() -> None:
    """A right package whose executable and distribution are both called heart lost points."""

    def digest(distribution: str, name: str) -> str:
        script = EASY.replace("DIST", distribution).replace("NAME", name)
        return wrapper_digest(script, name, f"{name}.node:main")

    assert digest("heart", "heart") == digest("my-robot-controller", "test_node")


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
