"""A package that has other names than the assignment is marked under its own."""

from __future__ import annotations

from pathlib import Path

import pytest

from grader.package.submission import take_in
from grader.verdict.own_names import own_executable, with_own_names
from tests.marking import ASSIGNMENT
from tests.static_bench import MARKER, NAME, NODE, Bench

OTHER = "my_robot_conroller"
TARGET = "my_robot_controller.my_first_node:main"


@pytest.fixture
def bench(tmp_path: Path) -> Bench:
    return Bench(tmp_path / NAME)


def names(bench: Bench) -> tuple[str, str]:
    submission = take_in(bench.root, package=NAME, node_file=ASSIGNMENT.node_file)
    found = with_own_names(ASSIGNMENT, submission)
    return found.package, found.target


def call(bench: Bench, name: str) -> None:
    bench.change("package.xml", f"<name>{NAME}</name>", f"<name>{name}</name>")


def test_a_package_with_the_right_name_keeps_it(bench: Bench) -> None:
    assert names(bench) == (NAME, TARGET)


def test_a_misspelt_package_whose_inner_folder_is_right(bench: Bench) -> None:
    call(bench, OTHER)
    (bench.root / MARKER).rename(bench.root / "resource" / OTHER)
    assert names(bench) == (OTHER, TARGET)


def test_a_package_that_is_misspelt_throughout(bench: Bench) -> None:
    call(bench, OTHER)
    (bench.root / MARKER).rename(bench.root / "resource" / OTHER)
    (bench.root / NODE).parent.rename(bench.root / OTHER)
    assert names(bench) == (OTHER, f"{OTHER}.my_first_node:main")


def test_a_name_that_is_only_in_the_manifest_is_not_the_packages(bench: Bench) -> None:
    call(bench, OTHER)
    assert names(bench) == (NAME, TARGET)


@pytest.mark.parametrize("name", ["../up", "My_Robot", "a", "-rf", "x" * 200])
def test_a_name_that_ros_does_not_allow_is_not_used(name: str, bench: Bench) -> None:
    call(bench, name)
    (bench.root / MARKER).unlink()
    assert names(bench) == (NAME, TARGET)


@pytest.mark.parametrize(
    ("entries", "wanted"),
    [
        (f"[console_scripts]\ntest_node = {TARGET}\n", "test_node"),
        (f"[console_scripts]\nmy_first_node = {TARGET}\n", "my_first_node"),
        (f"[console_scripts]\nmy_first_node = {TARGET}\ntest_node = {TARGET}\n", "test_node"),
        (f"[console_scripts]\na = {TARGET}\nb = {TARGET}\n", "test_node"),
        (f"[console_scripts]\na = {TARGET}\nb = x:main\n", "a"),
        ("[console_scripts]\na = my_robot_controller.my_first_node : main\n", "a"),
        (f"[gui_scripts]\na = {TARGET}\n", "test_node"),
        (f"[console_scripts]\n--prefix = {TARGET}\n", "test_node"),
        (f"[console_scripts]\na/../b = {TARGET}\n", "test_node"),
        ("", "test_node"),
    ],
)
def test_the_only_executable_that_leads_to_the_function_is_run(entries: str, wanted: str) -> None:
    assert own_executable(ASSIGNMENT, entries) == wanted
