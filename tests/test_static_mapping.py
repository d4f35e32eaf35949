"""The static check of the entry point: each mistake and its report."""

from __future__ import annotations

import json
import os
from pathlib import Path

import pytest

from grader.verdict.checks import package

from .static_bench import ENTRY, FILES, NAME, NODE, Bench, line, mistake

RECORDINGS = Path(__file__).parent / "recordings"


@pytest.fixture
def bench(tmp_path: Path) -> Bench:
    return Bench(tmp_path / "jane")


@pytest.mark.parametrize(
    "entry",
    [
        "'test_node=my_robot_controller.my_first_node:main',",
        "'test_node  =  my_robot_controller.my_first_node : main'",
        '"test_node = my_robot_controller.my_first_node:main",',
        "'test_node = ' 'my_robot_controller.my_first_node:main',",
        "'test_node = ' + package_name + '.my_first_node:main',",
        "f'test_node = {package_name}.my_first_node:main',",
        "'other = my_robot_controller.gone:main',\n" + ENTRY,
    ],
)
def test_the_entry_may_be_written_in_any_plain_way(bench: Bench, entry: str) -> None:
    bench.change("setup.py", ENTRY, entry)
    passed = bench.maps()
    assert passed is not None
    assert "my_first_node" in passed.actual


def test_the_entry_point_may_be_in_a_string_or_in_setup_cfg(bench: Bench) -> None:
    start = FILES["setup.py"].index("    entry_points={")
    head = FILES["setup.py"][:start]
    bench.write(
        "setup.py", head + '    entry_points="""\n[console_scripts]\n' + ENTRY[1:-2] + '\n""",\n)\n'
    )
    passed = bench.maps()
    assert passed is not None
    assert "line 17" in passed.actual
    bench.write("setup.py", head + ")\n")
    assert mistake(bench.misses()) == "setup.no_entry"
    bench.write(
        "setup.cfg",
        FILES["setup.cfg"] + "[options.entry_points]\nconsole_scripts =\n  # mine\n"
        "  test_node = my_robot_controller.my_first_node:main\n",
    )
    passed = bench.maps()
    assert passed is not None
    assert "setup.cfg, line 8" in passed.actual


GENERATED = json.loads((RECORDINGS / "ros2cli-jazzy-create-new.json").read_text())["cases"][0]


@pytest.mark.parametrize("since", ["text", "text of 0.32.6 and later, derived"])
def test_the_setup_py_of_each_ros2cli_is_right_with_an_entry(bench: Bench, since: str) -> None:
    created = GENERATED[since]["my_robot/setup.py"].replace("my_robot", NAME)
    bench.write("setup.py", created)
    assert mistake(bench.misses()) == "setup.no_entry"
    bench.change(
        "setup.py", "'console_scripts': [\n", f"'console_scripts': [\n            {ENTRY}\n"
    )
    passed = bench.maps()
    assert passed is not None
    assert "my_first_node" in passed.actual


@pytest.mark.parametrize(
    ("entry", "wanted", "words"),
    [
        ("", "no_entry", "has no entry"),
        ("'other = my_robot_controller.other:main',", "no_entry", "only: other"),
        ("# " + ENTRY, "no_entry", "commented out"),
        (ENTRY[:-1] + "\n'b = my_robot_controller.b:main',", "missing_comma", "the comma"),
        ("'test_node : my_robot_controller.my_first_node:main',", "bad_entry", "':'"),
        ("'test_node my_robot_controller.my_first_node:main',", "bad_entry", "'='"),
        ("'my_robot_controller.my_first_node:main',", "bad_entry", "'='"),
        ("'= my_robot_controller.my_first_node:main',", "bad_entry", "the name before"),
        ("'test_node = ',", "bad_entry", "nothing after"),
        ("'test_node == my_robot_controller.my_first_node:main',", "bad_entry", "more than one"),
        ("'test_node = my_robot_controller/my_first_node:main',", "bad_entry", "dots"),
        ("'test_node = my-robot-controller.my_first_node:main',", "bad_entry", "dash"),
        ("'test_node = my_robot_controller.my_first_node:main()',", "bad_entry", "()"),
        ("'test_node = my_robot_controller:my_first_node:main',", "bad_entry", "':'"),
        ("'test_node = my robot.my_first_node:main',", "bad_entry", "space"),
        ("'test_node = my_robot_controller.my_first_node;main',", "bad_entry", "form"),
        ("'test_node => my_robot_controller.my_first_node:main',", "bad_entry", "form"),
        ("'test_node = my_robot_controller.my_first_node.py:main',", "py_in_target", ".py"),
        ("'test_node = my_robot_controller.my_first_node',", "no_function", ":main"),
        ("'test_node = my_robot_controller.my_first_node.main',", "dot_for_colon", "':'"),
        ("'test_node = my_robot_controller.my_first_node:mian',", "other_function", "mean 'main'"),
        ("'test_node = my_robot_controller.my_first_node:MyNode',", "other_function", "MyNode"),
        ("'test_node = my_robot_controller.my_frist_node:main',", "misspelt_module", "did you"),
        ("'test_node = my_robot_controller.my_first_Node:main',", "misspelt_module", "did you"),
        ("'test_node = my_robot_controller.second:main',", "other_module", "second"),
        ("'test_node = my_first_node:main',", "no_package_prefix", "my_robot_controller"),
        ("'test_node = my_robot.my_first_node:main',", "other_package", "my_robot"),
        ("'my_first_node = my_robot_controller.my_first_node:main',", "other_executable", "called"),
        ("'test_nod = my_robot_controller.other:main',", "other_executable", "test_nod"),
        ("'test-node = my_robot_controller.my_first_node:main',", "other_executable", "test-node"),
        ("'Test_node = my_robot_controller.my_first_node:main',", "other_executable", "Test_node"),
        ("'test node = my_robot_controller.my_first_node:main',", "other_executable", "test node"),
        (ENTRY + ENTRY, "duplicate_entry", "2 times"),
    ],
)
def test_each_wrong_entry_point_has_its_own_mistake(
    bench: Bench, entry: str, wanted: str, words: str
) -> None:
    bench.write(f"{NAME}/second.py", "def main(): pass\n")
    bench.change("setup.py", ENTRY, entry)
    failed = bench.misses()
    assert mistake(failed) == f"setup.{wanted}"
    assert words in failed.actual
    assert failed.where is not None
    assert failed.where.file == "setup.py"
    assert line(failed) in ((16, 17) if wanted == "no_entry" else (17,))


def test_a_missing_comma_is_reported_at_its_line(bench: Bench) -> None:
    entries = [f"'n{n} = my_robot_controller.n{n}:main'" for n in range(4)]
    bench.change("setup.py", ENTRY, ENTRY + "\n" + ",\n".join(entries[:2]) + "\n" + entries[2])
    failed = bench.misses()
    assert (mistake(failed), line(failed)) == ("setup.missing_comma", 19)
    assert entries[1] in failed.fix


def test_an_entry_that_begins_with_a_variable_is_reported_at_its_own_line(bench: Bench) -> None:
    bench.change("setup.py", ENTRY, "executable + '= my_robot_controllermy_first_node:main',")
    bench.change("setup.py", "\nsetup(", "\nexecutable = 'test_node'\n\nsetup(")
    written = (bench.root / "setup.py").read_text().splitlines()
    failed = bench.misses()
    assert mistake(failed) == "setup.misspelt_module"
    assert "executable + " in written[(line(failed) or 0) - 1]


POINTS = """\
    entry_points={
        'console_scripts': [
            'test_node = my_robot_controller.my_first_node:main',
        ],
    },
)
"""


@pytest.mark.parametrize(
    ("new", "at", "words"),
    [
        (f"    tests_require=['pytest', {ENTRY}],\n)\n", 14, "it is in tests_require"),
        (
            f"    extras_require={{\n        'test': [\n            'pytest',\n            {ENTRY}\n"
            "        ],\n    },\n    entry_points={\n        'console_scripts': [\n        ],\n    },\n)\n",
            17,
            "it is in extras_require",
        ),
        (f"    install_requires=[{ENTRY}],\n)\n", 14, "it is in install_requires"),
        (f"    keywords=[\n        {ENTRY}\n    ],\n)\n", 15, "it is in keywords"),
        (f"    console_scripts=[{ENTRY}],\n)\n", 14, "outside of entry_points"),
        (
            f")\nentry_points = {{'console_scripts': [{ENTRY}]}}\n",
            15,
            "setup() does not get entry_points",
        ),
        (
            f"    keywords=[{ENTRY}],\n    entry_points={{'console_scripts': []}},\n)\n",
            14,
            "keywords",
        ),
    ],
)
def test_an_entry_in_the_wrong_place_is_named(bench: Bench, new: str, at: int, words: str) -> None:
    bench.change("setup.py", "    install_requires=['setuptools'],\n", "")
    bench.change("setup.py", POINTS, new)
    failed = bench.misses()
    assert (mistake(failed), line(failed)) == ("setup.misplaced_entry", at)
    assert words in failed.actual


def test_an_entry_of_gui_scripts_is_there_but_in_another_group(bench: Bench) -> None:
    bench.change("setup.py", "'console_scripts'", "'gui_scripts'")
    failed = bench.misses()
    assert (mistake(failed), line(failed)) == ("setup.group_misspelt", 16)
    assert "'gui_scripts'" in failed.actual
    assert "to the group console_scripts" in failed.fix


def test_a_misspelt_argument_is_compared_with_entry_points(bench: Bench) -> None:
    bench.change("setup.py", "    entry_points=", "    entry_point=")
    failed = bench.misses()
    assert mistake(failed) == "setup.no_entry"
    assert "there is 'entry_point'" in failed.actual
    assert "entry_points={'console_scripts': ['test_node" in failed.fix


@pytest.mark.parametrize("group", ["console_script", "consol_scripts", "consolescripts", "scripts"])
def test_a_misspelt_group_is_reported(bench: Bench, group: str) -> None:
    bench.change("setup.py", "'console_scripts'", f"'{group}'")
    failed = bench.misses()
    assert (mistake(failed), line(failed)) == ("setup.group_misspelt", 16)
    assert group in failed.actual


def test_a_missing_setup_py_is_reported(bench: Bench) -> None:
    (bench.root / "setup.py").unlink()
    assert mistake(bench.misses()) == "setup.missing"
    bench.passes(package.manifest)


def test_a_setup_py_that_cannot_be_read_is_reported_in_one_sentence(
    bench: Bench, monkeypatch: pytest.MonkeyPatch
) -> None:
    really = os.open

    def refuse(
        path: str | Path, flags: int, mode: int = 0o777, *, dir_fd: int | None = None
    ) -> int:
        if str(path).endswith("setup.py"):
            raise PermissionError(13, "Permission denied")
        return really(path, flags, mode, dir_fd=dir_fd)

    monkeypatch.setattr(os, "open", refuse)
    assert bench.misses().actual == "setup.py cannot be read: Permission denied"


@pytest.mark.parametrize(
    ("old", "new"),
    [
        (f"[\n            {ENTRY}\n        ]", "entries()"),
        (ENTRY, "*entries(),"),
        (ENTRY, "NAME + ' = my_robot_controller.my_first_node:main',"),
        ("setup(\n    name", "if True:\n  setup(\n    name"),
        ("setup(\n    name", "def setup(**k): pass\nsetup(\n    name"),
        ("setup(\n    name", "setup(name='a')\nsetup(\n    name"),
        ("setup(\n    name", "setup(\n    **settings,\n    nam"),
        ("package_name = 'my_robot_controller'\n", "a = a = b = [b]\nsetup()\n"),
    ],
)
def test_values_known_only_by_running_setup_py_are_not_judged(
    bench: Bench, old: str, new: str
) -> None:
    bench.change("setup.py", old, new)
    if "settings" in new:  # then the entry points are defined there
        bench.change("setup.py", "entry_points=", "nothing=")
    assert bench.maps() is None


def test_a_changed_variable_is_not_trusted(bench: Bench) -> None:
    bench.change("setup.py", f"[\n            {ENTRY}\n        ]", "scripts")
    bench.change("setup.py", "\nsetup(", f"\nscripts = [{ENTRY}]\nsetup(")
    assert bench.maps() is not None
    bench.change("setup.py", "\nsetup(", "\nscripts.append('x = y:z')\nsetup(")
    assert bench.maps() is None


def test_hostile_expressions_take_bounded_time(bench: Bench) -> None:
    doubling = "a0 = 'x' * 100\n" + "".join(f"a{n} = a{n - 1} + a{n - 1}\n" for n in range(1, 60))
    lists = "b0 = ['x']\n" + "".join(f"b{n} = b{n - 1} + b{n - 1}\n" for n in range(1, 60))
    bench.change("setup.py", "\nsetup(", f"\n{doubling}{lists}\nsetup(")
    bench.change("setup.py", f"[\n            {ENTRY}\n        ]", "b59")
    assert bench.maps() is None
    bench.change("setup.py", "name=package_name", "name=a59")
    bench.passes(package.manifest)


@pytest.mark.parametrize(
    "deep",
    [
        "name='a'" + " + 'a'" * 20_000,
        "name=a" + ".a" * 20_000,
        "name=a" + ".a" * 20_000 + ".format('a')",
        "name=" + "[" * 90 + "]" * 90,
    ],
)
def test_deep_expressions_are_not_judged(bench: Bench, deep: str) -> None:
    bench.change("setup.py", "name=package_name", deep)
    bench.passes(package.manifest)
    bench.maps()


def test_a_node_without_the_function_is_advice(bench: Bench) -> None:
    bench.change(NODE, "def main(", "def mein(")
    passed = bench.maps()
    assert passed is not None
    assert "there is 'mein'" in passed.advice[0]


def test_the_students_text_is_shown_escaped(bench: Bench) -> None:
    bench.change("setup.py", ENTRY, "'test_node = \\ud800\\x1b[2J\\u202e.a:b',")
    assert "\\ud800" in bench.misses().actual
    bench.change(
        "setup.py", "package_name = 'my_robot_controller'", "package_name = '\\x07\\udcff'"
    )
    assert "\\x07" in bench.fails(package.manifest).actual
