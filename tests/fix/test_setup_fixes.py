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
    ("name", "code", "fix"),
    [
        ("setup_reads_missing_file", "long_description=", "delete long_description=open("),
        ("setup_reads_missing_file_above", "with open(", "delete that line"),
        ("setup_reads_requirements", "install_requires=", "install_requires=['setuptools']"),
        ("find_packages_not_called", "packages=", "packages=find_packages(exclude=['test'])"),
        ("find_packages_in_list", "packages=", "packages=find_packages(exclude=['test'])"),
        ("setup_variable_missing", "name=package_name", f"package_name = '{PACKAGE}'"),
        ("setup_text_unquoted", "license=", "'Apache'"),
        ("setup_name_positional", "    package_name,", "name=package_name"),
        ("setup_glob_of_module", "import glob", "from glob import glob instead of import glob"),
        ("setup_file_without_list", "'package.xml'", "['package.xml']"),
        ("setup_folder_without_files", "('share/' + package_name)", "['package.xml'])"),
        ("setup_data_file_missing", "launch/hello.launch.py", "lists launch/hello.launch.py"),
        ("setup_import_error", "from setuptool import", "setuptools instead of setuptool"),
        ("setup_true_in_small_letters", "zip_safe=", "True instead of true"),
        ("packages_name_the_file", "packages=", "packages=find_packages(exclude=['test'])"),
        ("packages_name_the_file_alone", "packages=", "packages=[package_name]"),
    ],
)
def test_the_line_is_named_and_changed(name: str, code: str, fix: str, tmp_path: Path) -> None:
    package = write(BY_NAME[name], tmp_path)
    found = mark(package).check("build.colcon")
    lines = (package / "setup.py").read_text(encoding="utf-8").splitlines()
    assert found.where is not None
    assert code in lines[(found.where.line or 0) - 1]
    assert fix in found.fix
    assert found.patch
    fixed = with_tool(TOOLS[0], found.patch.encode(), package)
    new = (fixed / "setup.py").read_bytes()
    assert setup_fault(new, str(found.mistakes[0].params.get("error", "")), PACKAGE) is None


@pytest.mark.parametrize(
    ("argument", "error", "variant", "certain"),
    [
        ("url=open('LINK').read()", "FileNotFoundError: [Errno 2] No such file or directory: 'LINK'",
         "no_file", True),
        ("scripts=open('LINK').read()", "FileNotFoundError: [Errno 2] No such file or directory: 'LINK'",
         "", False),
        ("version=v1", "NameError: name 'v1' is not defined", "undefined", True),
        ("version=v1 + '0'", "NameError: name 'v1' is not defined", "undefined", False),
        ("packages=find_packages", "TypeError: 'method' object is not iterable", "not_called", True),
        ("packages=folders", "TypeError: 'method' object is not iterable", "", False),
        ("version='0'", "ModuleNotFoundError: No module named 'other'", "", False),
        ("version=v1)\nv1 = 1\ndict(a=1", "NameError: name 'v1' is not defined", "late", False),
        ("version=v1)\nv1 = dict(a=1", "NameError: name 'v1' is not defined", "late_lines", False),
    ],
)  # fmt: skip
def test_a_cause_is_named_only_if_it_is_seen(
    argument: str, error: str, variant: str, certain: bool
) -> None:
    found = setup_fault(CALL.format(argument=argument).encode(), error, PACKAGE)
    assert (found.variant if found is not None else "") == variant
    assert (found is not None and found.fixed is not None) == certain


def test_find_packages_is_imported_if_the_package_contains_others() -> None:
    code = CALL.format(argument="packages=['node']").encode()
    alone = packages_of(code, PACKAGE, nested=False)
    assert alone.wanted == f"packages=['{PACKAGE}']"
    assert not alone.statement
    nested = packages_of(code, PACKAGE, nested=True)
    assert nested.statement == "from setuptools import find_packages"
    assert nested.fixed is not None
    assert nested.fixed.startswith(nested.statement.encode())
