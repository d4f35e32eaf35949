"""Packages with a wrong entry point: package, file or function."""

from __future__ import annotations

from grader.validate.tree import Edit, Replace, Write

from .model import BUILT, INNER, INSTALLED, RUN, SETUP, Package, broken

TARGET = "my_robot_controller.my_first_node:main"
ENTRY = f"            'test_node = {TARGET}',\n"
SECOND = "def main():\n    pass\n"


def _lost(name: str, *edits: Edit, mistake: str, note: str = "") -> Package:
    """Return a package that builds and has no executable `test_node`."""
    return broken(
        name,
        *edits,
        failed={"entry_point.mapping": mistake},
        skipped=INSTALLED,
        score=45,
        note=note,
    )


def _renamed(name: str, executable: str, *, note: str = "") -> Package:
    """Return a package whose executable has another name and leads to the right function."""
    return broken(
        name,
        Replace(SETUP, "'test_node =", f"'{executable} ="),
        failed={"entry_point.mapping": "setup.other_executable"},
        score=90,
        note=note,
    )


def _unbuilt(name: str, *edits: Edit, mistake: str, note: str = "") -> Package:
    """Return a package whose entry point makes the build fail."""
    return broken(
        name, *edits, failed={"entry_point.mapping": mistake}, skipped=BUILT, score=40, note=note
    )


def _dead(name: str, *edits: Edit, mistake: str, note: str = "") -> Package:
    """Return a package whose executable exists but fails because of its entry point."""
    return broken(
        name, *edits, failed={"entry_point.mapping": mistake}, skipped=RUN, score=50, note=note
    )


def _target(new: str) -> Edit:
    return Replace(SETUP, TARGET, new)


ENTRY_POINT = (
    _lost("entry_missing", Replace(SETUP, ENTRY, ""), mistake="setup.no_entry"),
    _lost("entry_commented_out", Replace(SETUP, ENTRY, ENTRY.replace("'test", "# 'test")),
          mistake="setup.no_entry"),
    _lost("entry_points_lost", Replace(SETUP, "    entry_points={\n        'console_scripts': [\n"
          f"{ENTRY}        ],\n    }},\n", ""), mistake="setup.no_entry"),
    _renamed("executable_is_file_name", "my_first_node", note="the name that many courses use"),
    _renamed("executable_misspelt", "test_nod"),
    _renamed("executable_capital", "Test_node"),
    _renamed("executable_with_suffix", "test_node.py"),
    _lost("two_other_executables", Replace(SETUP, ENTRY, ENTRY.replace("test_node", "hello")
                                           + ENTRY.replace("test_node", "hello_too")),
          mistake="setup.other_executable", note="two lead to the right function: none is run"),
    _lost("console_script", Replace(SETUP, "'console_scripts'", "'console_script'"),
          mistake="setup.group_misspelt", note="a group that nobody reads"),
    _lost("gui_scripts", Replace(SETUP, "'console_scripts'", "'consol_scripts'"),
          mistake="setup.group_misspelt"),
    _unbuilt("comma_missing", Write(f"{INNER}/second.py", SECOND),
             Replace(SETUP, ENTRY, ENTRY.replace(",", "")
                     + "            'second = my_robot_controller.second:main',\n"),
             mistake="setup.missing_comma", note="was never called, says colcon"),
    _unbuilt("colon_for_equals", Replace(SETUP, "test_node = my", "test_node : my"),
             mistake="setup.colon_for_equals"),
    _unbuilt("slash_for_dot", _target("my_robot_controller/my_first_node:main"),
             mistake="setup.slash_in_target"),
    _unbuilt("dash_in_module", _target("my-robot-controller.my_first_node:main"),
             mistake="setup.dash_in_target"),
    _unbuilt("function_called", _target("my_robot_controller.my_first_node:main()"),
             mistake="setup.brackets", note="brackets behind main"),
    _dead("module_misspelt", _target("my_robot_controller.my_frist_node:main"),
          mistake="setup.misspelt_module"),
    _dead("package_left_out", _target("my_first_node:main"),
          mistake="setup.no_package_prefix"),
    _dead("package_misspelt", _target("my_robot_controler.my_first_node:main"),
          mistake="setup.other_package"),
    _dead("suffix_in_module", _target("my_robot_controller.my_first_node.py:main"),
          mistake="setup.py_in_target"),
    _dead("main_left_out", _target("my_robot_controller.my_first_node"),
          mistake="setup.no_function"),
    _dead("dot_for_colon", _target("my_robot_controller.my_first_node.main"),
          mistake="setup.dot_for_colon"),
    _dead("function_misspelt", _target("my_robot_controller.my_first_node:mian"),
          mistake="setup.other_function"),
)  # fmt: skip
