"""What is told about a setup.py that stops: the line, what to write there, and the patch."""

from __future__ import annotations

from pathlib import Path

import pytest

from grader.package.source.setup_faults import setup_fault
from grader.package.source.setup_packages import packages_of
from tests.corpus.broken import BROKEN
from tests.corpus.build import write
from tests.fix.corpus_fixes import TOOLS, with_tool
from tests.recorded import mark

BY_NAME = {package.name: package for package in BROKEN}
PACKAGE = "my_robot_controller"
CALL = "from setuptools import setup\n\nsetup(\n    name='a',\n    {argument},\n)\n"


@pytest.mark.parametrize(
    ("name", "code", "fix", "patched"),
    [
        ("setup_reads_missing_file", "long_description=", "Do not read README.md", False),
        ("find_packages_not_called", "setup(", "Compare each value with", False),
        ("setup_variable_missing", "name=package_name", f"package_name = '{PACKAGE}'", True),
        ("setup_text_unquoted", "license=", "'Apache'", False),
        ("setup_called_by_a_misspelt_name", "setu(", "setup instead of setu", True),
        ("setup_uses_os_and_glob", "os.path.join", "import os", True),
        ("setup_file_without_list", "data_files", "Each line of data_files", False),
        (
            "setup_data_file_missing",
            "launch/hello.launch.py",
            "lists launch/hello.launch.py",
            False,
        ),
        ("setup_import_error", "from setuptool import", "setuptools instead of setuptool", True),
        ("setup_source_folder_missing", "package_dir", "no such folder", False),
        ("packages_name_the_file", "packages=", "packages=find_packages(exclude=['test'])", True),
    ],
)
def test_the_line_is_named_and_changed(
    name: str, code: str, fix: str, patched: bool, tmp_path: Path
) -> None:
    package = write(BY_NAME[name], tmp_path)
    found = mark(package).check("build.colcon")
    lines = (package / "setup.py").read_text(encoding="utf-8").splitlines()
    assert found.where is not None
    assert code in lines[(found.where.line or 0) - 1]
    assert fix in found.fix
    assert bool(found.patch) == patched
    if patched:
        fixed = with_tool(TOOLS[0], found.patch.encode(), package)
        new = (fixed / "setup.py").read_bytes()
        assert setup_fault(new, str(found.mistakes[0].params.get("error", "")), PACKAGE) is None


@pytest.mark.parametrize(
    ("argument", "error", "variant"),
    [
        ("version=v1", "NameError: name 'v1' is not defined", "undefined"),
        ("version='0'", "ModuleNotFoundError: No module named 'other'", ""),
        ("version=v1)\nv1 = dict(a=1", "NameError: name 'v1' is not defined", ""),
    ],
)
def test_a_cause_is_named_only_if_it_is_seen(argument: str, error: str, variant: str) -> None:
    found = setup_fault(CALL.format(argument=argument).encode(), error, PACKAGE)
    assert (found.variant if found is not None else "") == variant


def test_find_packages_is_imported_if_the_package_contains_others() -> None:
    code = CALL.format(argument="packages=['node']").encode()
    alone = packages_of(code, PACKAGE, nested=False)
    assert alone.wanted == f"packages=['{PACKAGE}']"
    assert not alone.statement
    nested = packages_of(code, PACKAGE, nested=True)
    assert nested.statement == "from setuptools import find_packages"
    assert nested.fixed is not None
    assert nested.fixed.startswith(nested.statement.encode())
