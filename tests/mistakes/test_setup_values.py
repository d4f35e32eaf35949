"""What the report says of values in setup.py, setup.cfg and package.xml: their line and the change."""

from __future__ import annotations

from pathlib import Path

import pytest

from grader.package.source.module import parse_module
from grader.package.source.setup_cfg import SetupCfgFault, read_setup_cfg, slip_of_path
from grader.package.source.setup_faults import INSIDE, NOT_REACHED, setup_fault
from grader.package.source.setup_packages import packages_of, setup_call
from grader.package.source.setup_values import refused_version
from grader.report.model import CheckResult
from tests.corpus.broken import BROKEN
from tests.corpus.build import write
from tests.recorded import mark

BY_NAME = {package.name: package for package in BROKEN}
PACKAGE = "my_robot_controller"


def _check(name: str, check: str, tmp_path: Path) -> tuple[CheckResult, str]:
    """Return a check of a broken package, and the source line that it names."""
    package = write(BY_NAME[name], tmp_path)
    found = mark(package).check(check)
    where = found.where
    assert where is not None
    rows = (package / where.file).read_text(encoding="utf-8").splitlines()
    return found, rows[where.line - 1] if where.line else ""


@pytest.mark.parametrize(
    ("name", "check", "code", "said"),
    [
        ("setup_version_of_maven", "build.colcon", "VERSION = '1.0-SNAPSHOT'", "'1.0-SNAPSHOT' is"),
        ("setup_version_in_cfg", "build.colcon", "version = 1.0-SNAPSHOT", "in setup.cfg"),
        ("setup_requirement_refused", "build.colcon", "rclpy is needed", "'rclpy is needed' in"),
        ("setup_boolean_in_quotes", "build.colcon", "zip_safe='yes'", "zip_safe=True"),
        ("setup_license_in_a_list", "build.colcon", "license=[", "license is a text"),
        ("setup_line_of_data_files_in_three", "build.colcon", "'share/', p", "two parts"),
        ("setup_path_of_pathlib", "build.colcon", "", "pathlib in data_files"),
        ("setup_argument_repeated_empty_last", "build.colcon", "[]", "Delete the empty one"),
        ("setup_source_folder_of_packages_missing", "build.colcon", "package_dir", "Delete package_dir"),
        ("packages_name_another_folder_too", "build.colcon", "'.utils'", "/utils from packages="),
        ("setup_cfg_variable_of_setup_py", "package.setup_cfg", "$package_name", "(lines: 2, 4)"),
        ("setup_cfg_comment_behind_value", "package.setup_cfg", "# for", "Delete the comment"),
        ("setup_cfg_first_heading_missing", "package.setup_cfg", "script_dir", "Write [develop]"),
        ("entry_points_empty", "entry_point.mapping", "setup(", "instead of the entry_points"),
        ("entry_points_without_console_scripts", "entry_point.mapping", "setup(", "to the dict"),
        ("setup_lines_of_data_files_without_brackets", "build.colcon", "'share/ament", "( before each"),
        ("setup_line_of_data_files_exchanged", "build.colcon", "(['package.xml']", "the folder is the first"),
        ("setup_file_of_data_files_absolute", "build.colcon", "HERE, 'p", "'package.xml' instead of"),
        ("setup_folder_of_data_files_absolute", "build.colcon", "'/share/'", "'share/' instead of"),
        ("setup_py_modules_for_packages", "build.colcon", "py_modules", "packages=['my_robot_controller']"),
        ("setup_py_modules_beside_packages", "build.colcon", "py_modules", "Delete py_modules="),
        ("setup_guard_misspelt_below_its_function", "build.colcon", "'main'", "'__main__' instead"),
        ("text_of_entry_points_without_its_header", "entry_point.mapping", "test_node =", "[console_scripts] above"),
        ("second_entry_without_its_name", "entry_point.mapping", "r.second:main", "'second = my_robot"),
        ("entry_in_two_texts", "entry_point.mapping", "'test_node', 'my_robot", "in place of the two"),
        ("modules_of_two_entries_exchanged", "entry_point.mapping", "'test_node", "write there: 'second ="),
        ("dependencies_in_a_tag_of_their_own", "package.manifest", "<dependencies>", "keep what is between"),
        ("function_around_setup_only_named", "build.colcon", "install", "Write install() instead"),
        ("setup_cfg_one_heading_for_both", "package.setup_cfg", "[develop, install]", "Below that, write [install]"),
        ("entry_points_as_a_set", "build.colcon", "entry_points={", "'console_scripts': ['test_node"),
        ("entry_points_as_list_in_the_settings", "build.colcon", "entry_points=[", "before the ["),
        ("package_name_of_a_path", "build.colcon", "sys.argv[1]", "package_name = 'my_robot"),
        ("entry_of_setup_cfg_at_the_margin", "entry_point.mapping", "test_node =", "4 spaces before"),
        ("entry_made_with_the_ending", "entry_point.mapping", "'console_scripts'", "the code that makes"),
        ("setup_cfg_base_in_capitals", "package.setup_cfg", "$BASE", "small letters (lines: 2, 4)"),
        ("setup_cfg_settings_behind_headings", "package.setup_cfg", "[develop]", "Begin a new line"),
        ("quotes_of_two_kinds", "package.manifest", "@todo.todo'>", '@todo.todo">'),
        ("blanks_at_the_start_of_tags", "package.manifest", "< depend>", "Write: <depend>"),
        ("blanks_in_tags_of_two_lines", "package.manifest", "< license>", "Correct them all"),
        ("all_tags_in_one_comment", "package.manifest", "<!--", "Delete the <!--"),
        ("license_in_a_comment", "package.manifest", "<!-- <license>", "Delete the <!--"),
        ("export_in_a_comment", "package.manifest", "<!-- <export>", "Delete the <!--"),
        ("entity_of_html", "package.manifest", "&nbsp;", "XML knows only"),
        ("email_twice_in_a_tag", "package.manifest", "email=", "Delete the second one"),
    ],
)  # fmt: skip
def test_the_line_and_the_change_are_named(
    name: str, check: str, code: str, said: str, tmp_path: Path
) -> None:
    found, row = _check(name, check, tmp_path)
    assert code in row
    assert said in found.fix


def test_a_path_of_setup_cfg_that_stops_the_build_costs_points_once(tmp_path: Path) -> None:
    report = mark(write(BY_NAME["setup_cfg_variable_of_setup_py"], tmp_path))
    assert report.check("build.colcon").status == "skipped"
    assert "No executable found" not in report.check("package.setup_cfg").rationale


def test_a_folder_of_another_name_is_told_once(tmp_path: Path) -> None:
    package = write(BY_NAME["setup_raises"], tmp_path)
    setup = package / "setup.py"
    code = setup.read_text(encoding="utf-8").replace("raise RuntimeError('not today')\n", "")
    code = code.replace("find_packages(exclude=['test'])", "[package_name]")
    setup.write_text(code, encoding="utf-8")
    (package / PACKAGE).rename(package / "robot_code")
    report = mark(package)
    assert report.check("source.node_file").status == "failed"
    assert report.check("build.colcon").status == "skipped"


def test_packages_that_are_right_are_not_asked_for(tmp_path: Path) -> None:
    found, _ = _check("setup_source_folder_of_packages_missing", "build.colcon", tmp_path)
    assert "packages=" not in found.fix


@pytest.mark.parametrize(
    ("version", "accepted"),
    [
        ("'1.0.0'", True), ("'1'", True), ("'1.0rc1'", True), ("'2024.1.dev3'", True),
        ("'v1.2'", True), ("'1.0+local'", True), ("1.0", True), ("version()", True),
        ("'1.0-SNAPSHOT'", False), ("'first'", False), ("'1.x'", False), ("(1, 0)", False),
    ],
)  # fmt: skip
def test_only_a_version_that_is_refused_is_named(version: str, accepted: bool) -> None:
    module = parse_module("setup.py", f"setup(version={version})\n".encode())
    call = setup_call(module)
    assert call is not None
    assert (refused_version(module, call) is None) == accepted


@pytest.mark.parametrize(
    "code",
    [
        "install_requires=['setuptools', 'numpy>=1.2,<2', 'a[b]==1.*; python_version<\"4\"', '']",
        "install_requires='setuptools\\nnumpy  # fast'", "python_requires='>=3.8, <4'",
        "zip_safe=True", "zip_safe=1", "package_data={'': ['*.xml']}", "extras_require=EXTRAS",
        "install_requires=requirements()", "python_requires=PYTHON", "install_requires=[]",
    ],
)  # fmt: skip
def test_a_value_that_setuptools_accepts_is_not_blamed(code: str) -> None:
    found = f"from setuptools import setup\nsetup(name='a', {code})\n".encode()
    assert setup_fault(found, NOT_REACHED, PACKAGE) is None
    assert setup_fault(found, INSIDE, PACKAGE) is None


def test_a_guard_does_not_hide_a_refused_value() -> None:
    found = b"if __name__ == '__main__':\n    setup(name='a',\n          zip_safe='no')\n"
    fault = setup_fault(found, NOT_REACHED, PACKAGE)
    assert fault is not None
    assert (fault.variant, fault.line) == ("refused_boolean", 3)


def test_a_file_that_a_helper_reads_is_not_to_be_made() -> None:
    found = b"def version():\n    return open('VERSION').read()\n\n\nsetup(version=version())\n"
    error = "FileNotFoundError: [Errno 2] No such file or directory: 'VERSION'"
    fault = setup_fault(found, error, PACKAGE)
    assert fault is not None
    assert (fault.variant, fault.line, fault.words["name"]) == ("no_file_other", 2, "VERSION")


def test_a_function_below_the_call_is_moved_up() -> None:
    found = b"setup(name='a',\n      version=version())\n\n\ndef version():\n    return '1'\n"
    fault = setup_fault(found, "NameError: name 'version' is not defined", PACKAGE)
    assert fault is not None
    assert (fault.variant, fault.words["line"], fault.words["last"]) == ("late_lines", "5", "6")


@pytest.mark.parametrize(
    ("code", "there"),
    [
        ("packages=['my_robot_controller']", True),
        ("packages=NAMES", True),
        ("packages=['robot']", False),
        ("packages=find_packages('src')", False),
    ],
)
def test_what_is_in_packages_is_known(code: str, there: bool) -> None:
    rows = ("from setuptools import setup, find_packages", f"NAMES = ['{PACKAGE}']")
    found = "\n".join((*rows, f"setup({code})", "")).encode()
    assert packages_of(found, PACKAGE, nested=False).is_there == there


@pytest.mark.parametrize(
    ("value", "slip"),
    [
        ("$base/lib/robot", ("", "")),
        ("$base/lib/${package_name}", ("variable", "${package_name}")),
        ("$base/lib/%(name)s", ("variable", "%(name)s")),
        ("$base/lib/my_robot_controller ; here", ("comment", "")),
        ("'$base/lib/my_robot_controller'", ("quotes", "")),
        ("$base/lib/$dist_name", ("", "")),
    ],
)
def test_the_slip_of_a_path_is_known(value: str, slip: tuple[str, str]) -> None:
    assert slip_of_path(value, "$base/lib/my_robot_controller") == slip


@pytest.mark.parametrize(
    ("text", "variant", "there"),
    [
        ("script_dir=a\n[install]\ninstall_scripts=a\n", "heading_above", 0),
        ("script_dir=a\n[develop]\n[install]\ninstall_scripts=a\n", "below", 2),
        ("import setuptools\n[develop]\nscript_dir=a\n", "no_section", 0),
        ("\ufeff[develop]\nscript_dir=a\n", "mark", 0),
    ],
)
def test_a_line_above_the_first_section(text: str, variant: str, there: int) -> None:
    with pytest.raises(SetupCfgFault) as caught:
        read_setup_cfg(text.encode())
    assert (caught.value.variant, caught.value.there) == (variant, there)
