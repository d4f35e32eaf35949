"""Fixes of static mistakes: the check passes afterwards, and tools accept the diff."""

from __future__ import annotations

from pathlib import Path

import pytest

from grader.mistakes.example import INIT, SETUP
from grader.package.edit.tree import Crlf, Edit, Move, Replace, Write
from grader.verdict.static import static_results
from tests.corpus.broken import BROKEN
from tests.corpus.build import write
from tests.corpus.model import Package
from tests.fix.corpus_fixes import NODE, TOOLS, contents, plan_of, with_tool
from tests.fixing import patch_for
from tests.marking import ASSIGNMENT, taken_in

STATIC = ("package.", "source.", "entry_point.mapping")
BUILT = ("entry_point.computed_mapping", "entry_point.other_installed")  # only a build shows them
# Nothing shows what these should be, so no fix is offered.
NOT_FIXED = {
    *("no_manifest", "manifest_empty", "cmake_package", "setup_missing"),
    *("cmake_package_with_node", "korean_in_cp949"),
    *("as_created", "node_not_written", "node_empty", "docstring_not_closed"),
    *("not_utf8", "null_bytes", "word_document", "node_hidden_by_folder"),
    *("license_in_a_comment", "format_without_quotes", "comment_without_end"),
    *("description_twice", "maintainer_email_at", "format_missing", "run_depend_of_ros_1"),
    *("end_tag_twice", "entry_in_tests_require", "entry_points_after_setup", "gui_scripts"),
}
NOTHING_TO_MARK = {
    *("empty_folder", "only_a_text", "only_the_node"),
    "two_of_one_name",
}


def is_static(package: Package) -> bool:
    failed = package.expect_failed.items()
    checks = [c for c, mistake in failed if c.startswith(STATIC) and mistake not in BUILT]
    return bool(checks) and package.name not in NOTHING_TO_MARK


SHOWN_BY_FILES = [package for package in BROKEN if is_static(package)]
FIXED = [package for package in SHOWN_BY_FILES if package.name not in NOT_FIXED]


def named(package: Package) -> str:
    return package.name


def test_most_static_mistakes_are_fixed() -> None:
    assert {package.name for package in SHOWN_BY_FILES} >= NOT_FIXED
    assert len(FIXED) >= 40


@pytest.mark.parametrize("package", FIXED, ids=named)
def test_every_static_check_passes_after_the_fix(package: Package, tmp_path: Path) -> None:
    plan = plan_of(write(package, tmp_path))
    assert not plan.left
    results = static_results(plan.new.put_into(taken_in(tmp_path / package.name)), ASSIGNMENT)
    status = {check: result.status for check, result in results.items()}
    assert set(status) >= {"package.manifest", "source.shebang", "entry_point.mapping"}
    assert set(status.values()) == {"passed"}


@pytest.mark.parametrize("tool", TOOLS, ids=lambda tool: str(tool[0]))
@pytest.mark.parametrize("package", FIXED, ids=named)
def test_tools_apply_the_diff(package: Package, tool: tuple[str, ...], tmp_path: Path) -> None:
    root = write(package, tmp_path)
    plan = plan_of(root)
    after = taken_in(with_tool(tool, plan.patch, root))
    got = {file.path: file for file in after.files if file.kind == "file"}
    assert {path: file.data for path, file in got.items()} == contents(plan.new)
    assert got[NODE].mode & 0o100, "git and a new patch set modes"


@pytest.mark.parametrize("package", FIXED, ids=named)
def test_a_fixed_package_is_not_changed_again(package: Package, tmp_path: Path) -> None:
    root = write(package, tmp_path)
    fixed = with_tool(TOOLS[0], plan_of(root).patch, root)
    again = plan_of(fixed)
    assert again.patch == b""
    assert again.fixed == ()


@pytest.mark.parametrize("package", FIXED, ids=named)
def test_a_report_carries_the_diff_of_each_failed_check(package: Package, tmp_path: Path) -> None:
    submission = taken_in(write(package, tmp_path))
    for check_id in filter(lambda check: check.startswith(STATIC), package.expect_failed):
        result = static_results(submission, ASSIGNMENT)[check_id]
        patch = patch_for(result, submission, ASSIGNMENT)
        assert patch.startswith("diff --git a/") or result.consequence_of, check_id


@pytest.mark.parametrize("package", [p for p in SHOWN_BY_FILES if p.name in NOT_FIXED], ids=named)
def test_an_uncertain_mistake_leaves_its_file_unchanged(package: Package, tmp_path: Path) -> None:
    plan = plan_of(write(package, tmp_path))
    assert plan.left
    for finding in plan.left:
        assert plan.new.by_path.get(finding.file) == plan.old.by_path.get(finding.file) or (
            finding.file not in plan.old.by_path
        )


@pytest.mark.parametrize("package", [p for p in BROKEN if p.name in NOTHING_TO_MARK], ids=named)
def test_without_a_package_there_is_no_patch(package: Package, tmp_path: Path) -> None:
    submission = taken_in(write(package, tmp_path))
    result = static_results(submission, ASSIGNMENT)["package.found"]
    assert patch_for(result, submission, ASSIGNMENT) == ""


def test_several_mistakes_at_once_are_all_fixed(tmp_path: Path) -> None:
    wanted = (
        *("build_type_missing", "marker_missing", "setup_cfg_without_install"),
        *("exec_bit_missing", "shebang_crlf", "comma_missing", "manifest_other_name"),
    )
    edits = [edit for p in BROKEN if p.name in wanted for edit in p.edits]
    root = write(Package(name="many", edits=tuple(edits)), tmp_path)
    plan = plan_of(root)
    assert not plan.left
    assert {finding.check for finding in plan.fixed} == {
        *("package.manifest", "package.marker", "package.setup_cfg", "source.exec_bit"),
        *("source.shebang", "entry_point.mapping"),
    }


@pytest.mark.parametrize(
    ("edit", "check", "file"),
    [
        (Replace(SETUP, "version='0.0.0',", "version='0.0.0'"), "build.colcon", SETUP),
        (Move(INIT, f"{INIT}.txt"), "source.node_file", INIT),
        (
            Replace("setup.cfg", "install_scripts", "install-scripts"),
            "package.setup_cfg",
            "setup.cfg",
        ),
    ],
)
def test_a_fix_without_a_failed_check_is_listed(
    edit: Edit, check: str, file: str, tmp_path: Path
) -> None:
    plan = plan_of(write(Package(name="one", edits=(edit,)), tmp_path))
    assert [(finding.check, finding.file) for finding in plan.fixed] == [(check, file)]


def test_a_right_package_is_left_unchanged(tmp_path: Path) -> None:
    plan = plan_of(write(Package(name="right", edits=()), tmp_path))
    assert plan.patch == b""
    assert plan.left == ()


def test_the_diff_of_a_huge_file_is_left_out_of_a_report(tmp_path: Path) -> None:
    root = write(Package(name="huge", edits=(Crlf(NODE),)), tmp_path)
    for size, has_patch in ((100, True), (1_000, False), (100_000, False)):
        code = b"#!/usr/bin/env python3\r\n" + b"x = 'some text of a line'\r\n" * size
        (root / NODE).write_bytes(code)
        submission = taken_in(root)
        result = static_results(submission, ASSIGNMENT)["source.shebang"]
        assert result.mistakes[0].id == "source.crlf"
        assert bool(patch_for(result, submission, ASSIGNMENT)) is has_patch


def test_a_diff_that_json_cannot_hold_is_left_out_of_a_report(tmp_path: Path) -> None:
    code = b"#!/usr/bin/env python3\r\n# -*- coding: latin-1 -*-\r\n# f\xfcr\r\nx = 1\r\n"
    root = write(Package(name="latin", edits=(Write(NODE, code),)), tmp_path)
    submission = taken_in(root)
    result = static_results(submission, ASSIGNMENT)["source.shebang"]
    assert patch_for(result, submission, ASSIGNMENT) == ""
    assert contents(plan_of(root).new)[NODE] == code.replace(b"\r\n", b"\n")
