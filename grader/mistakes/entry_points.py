"""The catalogue: the entry point in setup.py, part by part.

The titles of invalid entries follow the quoted entry and a colon, so they begin in lower case.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.example import (
    BODY_OF_MAIN,
    CFG,
    INNER,
    NODE,
    SETUP,
    UNBUILT,
    UNINSTALLED,
    UNSTARTED,
    example,
)
from grader.mistakes.fixes import entries, layout, setup_cfg, setup_py
from grader.mistakes.kind import Kind, Parts
from grader.mistakes.package_dir import SOURCE_FOLDER, SOURCE_FOLDERS
from grader.package.edit.tree import Copy, Delete, Move, Replace, Write

if TYPE_CHECKING:
    from typing_extensions import Unpack

OVERLAY = msg(
    "A shell that sources the workspace finds and runs what a package puts there, before what the "
    "entry point leads to."
)
PROGRAM = msg(
    "ros2 run starts the file of the entry point. Others read that file, and expect it to be the node."
)
WHY = msg(
    "An entry of console_scripts has the form name = package.module:function. The build turns it "
    "into the executable that ros2 run starts: <name> is what you type after the package."
)
STOPS = msg(
    "An entry of console_scripts has the form name = package.module:function. The build turns it "
    "into the executable that ros2 run starts: <name> is what you type after the package. "
    "setuptools stops at an entry that it cannot read; colcon then says only that "
    "distutils.core.setup() was never called."
)
JOINS = msg(
    "Python joins two adjacent strings into one. setuptools stops at an entry that it cannot "
    "read; colcon then says only that distutils.core.setup() was never called."
)
RAISES = msg(
    "An entry of console_scripts has the form name = package.module:function. The build turns it "
    "into the executable that ros2 run starts: <name> is what you type after the package. The "
    "build does not check the module: a wrong part shows only at ros2 run."
)
NOT_FOUND = msg(
    "An entry of console_scripts has the form name = package.module:function. The build turns it "
    "into the executable that ros2 run starts: <name> is what you type after the package. Without "
    "it, ros2 run answers: No executable found."
)
FOLDERS = msg(
    "packages= lists folders that contain an __init__.py, and not files. The build stops at a name "
    "for which there is no such folder."
)
REFUSED = msg(
    "The name of a group may have only letters, digits, _ and dots. setuptools refuses this name, "
    "and the build stops with: Invalid group name."
)
WRITE = msg("Write '{wanted}', then build again.")
OTHERS = {
    "other": msg("Fix or delete this entry: '{entry}'"),
    "two_texts": msg("Write one text, '{wanted}', in place of the two. Then build again."),
    "unnamed": msg(
        "This entry has no name. Write a name for its executable, and =, before it, such as: '{whole}', "
        "then build again."
    ),
    "no_f": msg(
        "Python replaces the names in {{ }} only in a string with an f before it. Write: f'{entry}', "
        "then build again."
    ),
}


def _stops(slug: str, title: str, **parts: Unpack[Parts]) -> Kind:
    """Return an entry that setuptools cannot read."""
    parts.setdefault("fixed_by", (entries.replaced,))
    return Kind(
        id=f"setup.{slug}",
        stage="entry point",
        title=title,
        why=STOPS,
        fix=WRITE,
        fixes=OTHERS,
        link=links.ENTRY_POINTS,
        **parts,
    )


def _raises(
    slug: str, title: str, fixes: Mapping[str, str] | None = None, **parts: Unpack[Parts]
) -> Kind:
    """Return an entry that builds, but ends ros2 run with an exception."""
    parts.setdefault("fixed_by", (entries.replaced,))
    return Kind(
        id=f"setup.{slug}",
        stage="entry point",
        title=title,
        why=RAISES,
        fix=WRITE,
        fixes=fixes or {},
        link=links.DEVELOPING,
        **parts,
    )


def _not_found(
    slug: str,
    title: str,
    fix: str = WRITE,
    fixes: Mapping[str, str] | None = None,
    **parts: Unpack[Parts],
) -> Kind:
    """Return an entry from which no executable with the required name is made."""
    parts.setdefault("fixed_by", (entries.replaced, entries.added))
    return Kind(
        id=f"setup.{slug}",
        stage="entry point",
        title=title,
        why=NOT_FOUND,
        fix=fix,
        fixes=fixes or {},
        link=links.DEVELOPING,
        **parts,
    )


NO_PACKAGES = msg(
    "packages= lists the folders to install. Without it, the build stops if it finds several "
    "folders."
)
PYPROJECT = """\
[project]
name = "my_robot_controller"
version = "0.0.0"

[project.scripts]
test_node = "my_robot_controller.my_first_node:main"
"""
KINDS = (
    Kind(
        id="setup.missing",
        stage="entry point",
        title=msg("There is no setup.py that can be read"),
        why=WHY,
        fix=msg(
            "In a new folder, run ros2 pkg create --build-type ament_python {package}, and copy its "
            "setup.py here. Then add your entry to console_scripts."
        ),
        fixes={
            "pyproject": msg(
                "colcon builds this package with setup.py, and does not read the scripts of "
                "pyproject.toml. In a new folder, run ros2 pkg create --build-type ament_python "
                "{package}, and copy its setup.py here. Add '{wanted}', to console_scripts, and delete "
                "pyproject.toml, or all its tables for the package: [project…], [build-system] and "
                "[tool.setuptools…]."
            ),
            "inner": msg(
                "Move it out of the inner folder. In the package's folder, run: mv {there} ."
            ),
            "renamed": msg(
                "Rename it, then build again. In the package's folder, run: mv {there} setup.py"
            ),
        },
        fixed_by=(layout.out_of_inner_folder, layout.setup_renamed),
        link=links.PACKAGE,
        seen=r"can't open file '[^'\n]{0,300}setup\.py'",
        examples=(
            example(
                "setup_with_a_capital_letter",
                Move(SETUP, "Setup.py"),
                fails="entry_point.mapping",
                blocks=UNBUILT,
            ),
            example(
                "setup_replaced_by_pyproject",
                Delete(SETUP),
                Write("pyproject.toml", PYPROJECT),
                fails="entry_point.mapping",
                blocks=UNBUILT,
            ),
            example("setup_missing", Delete(SETUP), fails="entry_point.mapping", blocks=UNBUILT),
        ),
    ),
    Kind(
        id="setup.missing_comma",
        stage="entry point",
        title=msg("two entries become one, because the comma between them is missing"),
        why=JOINS,
        fix=msg("Add a comma after '{before}', then build again."),
        link=links.ENTRY_POINTS,
        fixed_by=(entries.comma,),
        examples=(
            example(
                "comma_missing",
                Write("my_robot_controller/second.py", "def main():\n    pass\n"),
                Replace(
                    SETUP,
                    "            'test_node = my_robot_controller.my_first_node:main',\n",
                    (
                        "            'test_node = my_robot_controller.my_first_node:main'\n"
                        "            'second = my_robot_controller.second:main',\n"
                    ),
                ),
                fails="entry_point.mapping",
                blocks=UNBUILT,
                note="was never called, says colcon",
            ),
        ),
    ),
    _stops(
        "colon_for_equals",
        msg("after the name comes '=', not ':'"),
        examples=(
            example(
                "colon_for_equals",
                Replace(SETUP, "test_node = my", "test_node : my"),
                fails="entry_point.mapping",
                blocks=UNBUILT,
            ),
        ),
    ),
    _stops(
        "no_equals",
        msg("the '=' between the name and the module is missing"),
        examples=(
            example(
                "entry_in_two_texts",
                Replace(SETUP, "'test_node = my_robot", "'test_node', 'my_robot"),
                fails="entry_point.mapping",
                blocks=UNBUILT,
            ),
            example(
                "second_entry_without_its_name",
                Write("my_robot_controller/second.py", "def main():\n    pass\n"),
                Replace(
                    SETUP,
                    "first_node:main',\n",
                    "first_node:main',\n            'my_robot_controller.second:main',\n",
                ),
                fails="entry_point.mapping",
                blocks=UNBUILT,
            ),
        ),
    ),
    _stops("no_name", msg("the name before the '=' is missing")),
    _stops(
        "no_target",
        msg("there is nothing after the '='"),
        examples=(
            example(
                "entry_cut_after_its_equals_sign",
                Replace(SETUP, "'test_node = my_robot", "'test_node =',\n            'my_robot"),
                fails="entry_point.mapping",
                blocks=UNBUILT,
            ),
        ),
    ),
    _stops("two_equals", msg("there is more than one '='")),
    _stops(
        "slash_in_target",
        msg("folders are separated by dots, not slashes"),
        examples=(
            example(
                "slash_for_dot",
                Replace(
                    SETUP,
                    "my_robot_controller.my_first_node:main",
                    "my_robot_controller/my_first_node:main",
                ),
                fails="entry_point.mapping",
                blocks=UNBUILT,
            ),
        ),
    ),
    _stops(
        "brackets",
        msg("the function is named, not called: no ()"),
        examples=(
            example(
                "function_called",
                Replace(
                    SETUP,
                    "my_robot_controller.my_first_node:main",
                    "my_robot_controller.my_first_node:main()",
                ),
                fails="entry_point.mapping",
                blocks=UNBUILT,
                note="brackets behind main",
            ),
        ),
    ),
    _stops(
        "dash_in_target",
        msg("a Python module's name cannot contain a dash"),
        examples=(
            example(
                "dash_in_module",
                Replace(
                    SETUP,
                    "my_robot_controller.my_first_node:main",
                    "my-robot-controller.my_first_node:main",
                ),
                fails="entry_point.mapping",
                blocks=UNBUILT,
            ),
        ),
    ),
    _stops("two_colons", msg("there is more than one ':'")),
    _stops("space_in_target", msg("there is a space in the module or function")),
    _stops("bad_entry", msg("it does not have the form name = package.module:function")),
    Kind(
        id="setup.duplicate_entry",
        stage="entry point",
        title=msg("the name is used more than once"),
        why=msg(
            "An entry of console_scripts has the form name = package.module:function. The "
            "build turns it into the executable that ros2 run starts. A name can refer to one "
            "function only."
        ),
        fix=msg("Keep only one line, then build again: '{wanted}',"),
        fixed_by=(entries.single,),
        link=links.ENTRY_POINTS,
    ),
    _not_found("space_in_name", msg("there is a space in the executable's name")),
    _not_found(
        "other_executable",
        msg("the executable has a different name"),
        examples=(
            example(
                "executable_is_file_name",
                Replace(SETUP, "'test_node =", "'my_first_node ="),
                fails="entry_point.mapping",
                note="the name that many courses use",
            ),
            example(
                "executable_misspelt",
                Replace(SETUP, "'test_node =", "'test_nod ="),
                fails="entry_point.mapping",
            ),
            example(
                "executable_capital",
                Replace(SETUP, "'test_node =", "'Test_node ="),
                fails="entry_point.mapping",
            ),
            example(
                "executable_with_suffix",
                Replace(SETUP, "'test_node =", "'test_node.py ="),
                fails="entry_point.mapping",
            ),
            example(
                "two_other_executables",
                Replace(
                    SETUP,
                    "            'test_node = my_robot_controller.my_first_node:main',\n",
                    (
                        "            'hello = my_robot_controller.my_first_node:main',\n"
                        "            'hello_too = my_robot_controller.my_first_node:main',\n"
                    ),
                ),
                fails="entry_point.mapping",
                blocks=UNINSTALLED,
                note="two lead to the right function: none is run",
            ),
        ),
    ),
    Kind(
        id="setup.group_misspelt",
        stage="entry point",
        title=msg("the group is not called console_scripts"),
        why=msg(
            "setuptools makes executables only from the group console_scripts. It accepts this "
            "group without a message, and ros2 run answers: No executable found."
        ),
        fix=msg("Write 'console_scripts' instead of '{group}', then build again."),
        whys={
            **dict.fromkeys(("invalid", "invalid_other"), REFUSED),
            "space": msg(
                "The space belongs to the name of the group. Python looks for the executable's "
                "entry in console_scripts, without a space, and finds none there."
            ),
            "other": msg(
                "The exercise asks for an entry in the group console_scripts. From this group, "
                "setuptools makes the executables that ros2 run starts. Other groups have other "
                "uses."
            ),
        },
        fixes={
            "other": msg("Move '{wanted}' to the group console_scripts, then build again."),
            "invalid_other": msg(
                "Move '{wanted}' to the group console_scripts and delete the group '{group}', then "
                "build again."
            ),
        },
        link=links.ENTRY_POINTS,
        fixed_by=(entries.group, entries.regrouped),
        examples=(
            example(
                "console_script",
                Replace(SETUP, "'console_scripts'", "'console_script'"),
                fails="entry_point.mapping",
                blocks=UNINSTALLED,
                note="a group that nobody reads",
            ),
            example(
                "consol_scripts",
                Replace(SETUP, "'console_scripts'", "'consol_scripts'"),
                fails="entry_point.mapping",
                blocks=UNINSTALLED,
            ),
            example(
                "gui_scripts",
                Replace(SETUP, "'console_scripts'", "'gui_scripts'"),
                fails="entry_point.mapping",
                note="runs anyway: on Linux setuptools makes the same script for it",
            ),
            example(
                "console_scripts_with_a_dash",
                Replace(SETUP, "'console_scripts'", "'console-scripts'"),
                fails="entry_point.mapping",
                blocks=("build.colcon", *UNINSTALLED),
                note="setuptools refuses the name, and the build stops",
            ),
            example(
                "space_after_console_scripts",
                Replace(SETUP, "'console_scripts'", "'console_scripts '"),
                fails="entry_point.mapping",
                blocks=UNSTARTED,
                note="the executable is installed, and does not find its entry",
            ),
        ),
    ),
    Kind(
        id="setup.group_twice",
        stage="entry point",
        title=msg("console_scripts is written twice, and only the last one counts"),
        why=msg(
            "A dictionary has each key once: this console_scripts replaces the one above it, with "
            "the entry on line {line}, without a message."
        ),
        fix=msg("Delete this console_scripts with its empty list, then build again."),
        fixes={
            "entries": msg(
                "Put its entries into the list with line {line}, with a comma after each. Delete "
                "this console_scripts, then build again."
            )
        },
        link=links.ENTRY_POINTS,
        fixed_by=(entries.without_group,),
        examples=(
            example(
                "group_twice",
                Replace(
                    SETUP,
                    "        ],\n    },",
                    "        ],\n        'console_scripts': [],\n    },",
                ),
                fails="entry_point.mapping",
                blocks=UNINSTALLED,
            ),
            example(
                "group_twice_with_entries",
                Replace(
                    SETUP,
                    "        ],\n    },",
                    "        ],\n        'console_scripts': [\n"
                    "            'other = my_robot_controller.my_first_node:main',\n"
                    "        ],\n    },",
                ),
                fails="entry_point.mapping",
            ),
        ),
    ),
    Kind(
        id="setup.entry_at_margin",
        stage="entry point",
        title=msg("the entry in setup.cfg is not indented"),
        why=msg(
            "In setup.cfg, a line that begins with spaces belongs to the name above it. A line at "
            "the left margin begins a name of its own, so this entry is not one of console_scripts, "
            "and the build stops."
        ),
        fix=msg("Write 4 spaces before {code}, then build again."),
        link=links.ENTRY_POINTS,
        fixed_by=(setup_cfg.entry_indented,),
        examples=(
            example(
                "entry_of_setup_cfg_at_the_margin",
                Replace(
                    CFG,
                    "install_scripts=$base/lib/my_robot_controller\n",
                    "install_scripts=$base/lib/my_robot_controller\n\n[options.entry_points]\n"
                    "console_scripts =\ntest_node = my_robot_controller.my_first_node:main\n",
                ),
                Replace(
                    SETUP,
                    (
                        "    entry_points={\n"
                        "        'console_scripts': [\n"
                        "            'test_node = my_robot_controller.my_first_node:main',\n"
                        "        ],\n"
                        "    },\n"
                    ),
                    "",
                ),
                fails="entry_point.mapping",
                blocks=UNBUILT,
            ),
        ),
    ),
    Kind(
        id="setup.misplaced_entry",
        stage="entry point",
        title=msg("the entry is in the wrong place of setup.py"),
        why=NOT_FOUND,
        whys={
            "requirement": msg(
                "setuptools reads the texts of {argument} as names of Python packages: the build "
                "stops at any other text."
            ),
            "key_twice": msg(
                "A dict has one value for each key. If a key is written twice, only the last value "
                "counts, and Python says nothing."
            ),
        },
        fix=msg("Move '{wanted}' to the list console_scripts in entry_points, then build again."),
        fixes={
            "group": msg(
                "Put it into entry_points, then build again: "
                "entry_points={{'console_scripts': ['{wanted}']}},"
            ),
            "key_twice": msg(
                "Delete '{name}' in line {line} with its value, then build again. If that value has "
                "entries too, move them to the first '{name}' before."
            ),
            "late": msg(
                "Python calls setup() before it reaches {name}. Move the lines of {name} above "
                "setup(, and write entry_points={name}, in setup(). Then build again."
            ),
            "variable": msg(
                "Write entry_points={name}, in setup(), then build again. (If setup() has an "
                "entry_points already, write it there.)"
            ),
        },
        link=links.DEVELOPING,
        fixed_by=(entries.key_once, entries.passed, entries.grouped, entries.moved, entries.added),
        examples=(
            example(
                "entry_points_twice_in_a_dict",
                Replace(
                    SETUP,
                    "    entry_points={\n        'console_scripts': [\n"
                    "            'test_node = my_robot_controller.my_first_node:main',\n"
                    "        ],\n    },\n",
                    "    **MORE,\n",
                ),
                Replace(
                    SETUP,
                    "\nsetup(\n",
                    "\nMORE = {\n    'entry_points': {\n        'console_scripts': [\n"
                    "            'test_node = my_robot_controller.my_first_node:main',\n"
                    "        ],\n    },\n    'entry_points': {'console_scripts': []},\n}\n\nsetup(\n",
                ),
                fails="entry_point.mapping",
                blocks=UNINSTALLED,
            ),
            example(
                "entry_in_tests_require",
                Replace(
                    SETUP, "            'test_node = my_robot_controller.my_first_node:main',\n", ""
                ),
                Replace(
                    SETUP,
                    "    zip_safe=True,",
                    "    tests_require=[\n        'pytest',\n"
                    "        'test_node = my_robot_controller.my_first_node:main',\n    ],\n"
                    "    zip_safe=True,",
                ),
                fails="entry_point.mapping",
                blocks=UNBUILT,
            ),
            example(
                "group_outside_entry_points",
                Replace(
                    SETUP,
                    "    entry_points={\n        'console_scripts': [",
                    "    console_scripts=[",
                ),
                Replace(SETUP, "        ],\n    },\n)", "    ],\n)"),
                fails="entry_point.mapping",
                blocks=UNINSTALLED,
            ),
            example(
                "entry_points_not_passed",
                Replace(SETUP, "    entry_points={\n", ")\n\nentry_points = {\n"),
                Replace(SETUP, "        ],\n    },\n)", "    ],\n}"),
                Replace(
                    SETUP,
                    "\nsetup(\n",
                    "\npoints = {'console_scripts': [\n    'test_node = my_robot_controller.my_first_node:main',\n]}\n\nsetup(\n",
                ),
                fails="entry_point.mapping",
                blocks=UNINSTALLED,
            ),
            example(
                "entry_points_after_setup",
                Replace(SETUP, "    entry_points={\n", ")\n\nentry_points = {\n"),
                Replace(SETUP, "        ],\n    },\n)", "    ],\n}"),
                fails="entry_point.mapping",
                blocks=UNINSTALLED,
                note="the bracket of setup() is closed too early",
            ),
        ),
    ),
    _not_found(
        "no_entry",
        msg("there is no entry for the executable"),
        msg("Add this line to console_scripts, then build again: '{wanted}',"),
        {
            "renamed": msg("Write entry_points instead of {argument}, then build again."),
            "swapped": msg("Write '{wanted}' instead of '{entry}', then build again."),
            "comment": msg("Remove the # before '{wanted}', then build again."),
            "empty": msg(
                "Write in setup() instead of the entry_points that is there, then build again: "
                "entry_points={{'console_scripts': ['{wanted}']}},"
            ),
            "header": msg(
                "Write the line [console_scripts] above this line, in the same text. Then build again."
            ),
            "group": msg(
                "Add to the dict entry_points, then build again: 'console_scripts': ['{wanted}'],"
            ),
            "cfg": msg(
                "Add this line to console_scripts below [options.entry_points] in setup.cfg, "
                "indented and without quotes: {wanted}. Then build again."
            ),
            "scripts": msg(
                "Add to setup(), then build again: entry_points={{'console_scripts': "
                "['{wanted}']}}, (scripts= only copies files under their own names: you can delete "
                "it.)"
            ),
            "nothing": msg(
                "Add to setup(), then build again: entry_points={{'console_scripts': "
                "['{wanted}']}},"
            ),
        },
        fixed_by=(
            entries.keyword,
            entries.swapped,
            entries.header,
            entries.uncommented,
            entries.added,
        ),
        examples=(
            example(
                "entry_missing",
                Replace(
                    SETUP, "            'test_node = my_robot_controller.my_first_node:main',\n", ""
                ),
                fails="entry_point.mapping",
                blocks=UNINSTALLED,
            ),
            example(
                "names_of_the_entry_swapped",
                Replace(
                    SETUP,
                    "'test_node = my_robot_controller.my_first_node:main'",
                    "'my_first_node = my_robot_controller.test_node:main'",
                ),
                fails="entry_point.mapping",
                blocks=UNINSTALLED,
            ),
            example(
                "entry_in_a_stray_setup",
                Copy(SETUP, f"{INNER}/setup.py"),
                Replace(
                    SETUP, "            'test_node = my_robot_controller.my_first_node:main',\n", ""
                ),
                fails="entry_point.mapping",
                blocks=UNINSTALLED,
            ),
            example(
                "text_of_entry_points_without_its_header",
                Replace(SETUP, "entry_points={", "entry_points='''"),
                Replace(SETUP, "        'console_scripts': [\n", ""),
                Replace(
                    SETUP,
                    "            'test_node = my_robot_controller.my_first_node:main',\n        ],\n    },",
                    "        test_node = my_robot_controller.my_first_node:main\n    ''',",
                ),
                fails="entry_point.mapping",
                blocks=UNINSTALLED,
            ),
            example(
                "entry_points_misspelt",
                Replace(SETUP, "    entry_points={", "    entry_point={"),
                fails="entry_point.mapping",
                blocks=UNINSTALLED,
            ),
            example(
                "entry_commented_out",
                Replace(
                    SETUP,
                    "            'test_node = my_robot_controller.my_first_node:main',\n",
                    "            # 'test_node = my_robot_controller.my_first_node:main',\n",
                ),
                fails="entry_point.mapping",
                blocks=UNINSTALLED,
            ),
            example(
                "entry_points_empty",
                Replace(
                    SETUP,
                    (
                        "    entry_points={\n"
                        "        'console_scripts': [\n"
                        "            'test_node = my_robot_controller.my_first_node:main',\n"
                        "        ],\n"
                        "    },\n"
                    ),
                    "    entry_points={},\n",
                ),
                fails="entry_point.mapping",
                blocks=UNINSTALLED,
            ),
            example(
                "entry_points_without_console_scripts",
                Replace(
                    SETUP,
                    (
                        "        'console_scripts': [\n"
                        "            'test_node = my_robot_controller.my_first_node:main',\n"
                        "        ],\n"
                    ),
                    "        'launch': ['hello = my_robot_controller.hello:main'],\n",
                ),
                fails="entry_point.mapping",
                blocks=UNINSTALLED,
            ),
            example(
                "entry_points_lost",
                Replace(
                    SETUP,
                    (
                        "    entry_points={\n"
                        "        'console_scripts': [\n"
                        "            'test_node = my_robot_controller.my_first_node:main',\n"
                        "        ],\n"
                        "    },\n"
                    ),
                    "",
                ),
                fails="entry_point.mapping",
                blocks=UNINSTALLED,
            ),
        ),
    ),
    _raises(
        "no_function",
        msg("the function is missing: a module cannot be called"),
        seen=r"TypeError: 'module' object is not callable",
        examples=(
            example(
                "main_left_out",
                Replace(
                    SETUP,
                    "my_robot_controller.my_first_node:main",
                    "my_robot_controller.my_first_node",
                ),
                fails="entry_point.mapping",
                blocks=UNSTARTED,
            ),
        ),
    ),
    _raises(
        "dot_for_colon",
        msg("between module and function comes ':', not '.'"),
        seen=r"No module named '(?P<module>[\w.]{1,200}\.main)'; '[\w.]{1,200}' is not a package",
        examples=(
            example(
                "dot_for_colon",
                Replace(
                    SETUP,
                    "my_robot_controller.my_first_node:main",
                    "my_robot_controller.my_first_node.main",
                ),
                fails="entry_point.mapping",
                blocks=UNSTARTED,
            ),
        ),
    ),
    _raises(
        "py_in_target",
        msg("a module's name does not include .py"),
        seen=r"No module named '(?P<module>[\w.]{1,200}\.py)'",
        examples=(
            example(
                "suffix_in_module",
                Replace(
                    SETUP,
                    "my_robot_controller.my_first_node:main",
                    "my_robot_controller.my_first_node.py:main",
                ),
                fails="entry_point.mapping",
                blocks=UNSTARTED,
            ),
        ),
    ),
    _raises(
        "no_package_prefix",
        msg("the package's name and a dot are missing"),
        examples=(
            example(
                "package_left_out",
                Replace(SETUP, "my_robot_controller.my_first_node:main", "my_first_node:main"),
                fails="entry_point.mapping",
                blocks=UNSTARTED,
            ),
        ),
    ),
    _raises(
        "other_function",
        msg("the function has a different name"),
        {
            "in_class": msg(
                "In {path}, move the def of {function} (line {line}) out of the class: to the left "
                "margin, below the class, without self and without @staticmethod. Then write "
                "'{wanted}' in setup.py, and build again."
            ),
            "in_class_object": msg(
                "{function} is a method (line {line} of {path}) and needs an object of {owner}, which the "
                "executable does not make. Write at the end of {path}, above if __name__ if that is there, two "
                "lines: def {function}(): at the left margin, and below it, indented, {owner}().{function}(). Then "
                "write '{wanted}' in setup.py, and build again."
            ),
            "in_class_called": msg(
                "In {path}, write {function} instead of {code} in line {at}, and move the def of "
                "{function} (line {line}) out of the class: to the left margin, below the class, "
                "without self and without @staticmethod. Then write '{wanted}' in setup.py, and "
                "build again."
            ),
        },
        examples=(
            example(
                "main_is_a_method_of_an_object",
                Replace(
                    NODE,
                    "        super().__init__(",
                    "        rclpy.init()\n        super().__init__(",
                ),
                Replace(
                    NODE,
                    '\n\ndef main(args=None):\n    """Run the node until Ctrl+C."""\n'
                    + BODY_OF_MAIN,
                    "\n    def main(self):\n        try:\n            rclpy.spin(self)\n"
                    "        except KeyboardInterrupt:\n            pass\n"
                    "        finally:\n            self.destroy_node()\n"
                    "            rclpy.try_shutdown()\n",
                ),
                Replace(NODE, "'__main__':\n    main()", "'__main__':\n    MyFirstNode().main()"),
                Replace(SETUP, "my_first_node:main", "my_first_node:MyFirstNode.main"),
                fails="entry_point.mapping",
                blocks=UNSTARTED,
            ),
            example(
                "main_of_the_class",
                Replace(
                    NODE,
                    '\n\ndef main(args=None):\n    """Run the node until Ctrl+C."""\n'
                    + BODY_OF_MAIN,
                    "\n    @staticmethod\n    def main(args=None):\n"
                    + "".join(f"    {row}" for row in BODY_OF_MAIN.splitlines(keepends=True)),
                ),
                Replace(NODE, "\n    main()\n", "\n    MyFirstNode.main()\n"),
                Replace(SETUP, "my_first_node:main", "my_first_node:MyFirstNode.main"),
                fails="entry_point.mapping",
                blocking=False,
                note="the entry works; the exercise asks for a function",
            ),
            example(
                "function_misspelt",
                Replace(
                    SETUP,
                    "my_robot_controller.my_first_node:main",
                    "my_robot_controller.my_first_node:mian",
                ),
                fails="entry_point.mapping",
                blocks=UNSTARTED,
            ),
        ),
    ),
    _raises(
        "other_package",
        msg("the package has a different name"),
        examples=(
            example(
                "package_misspelt",
                Replace(
                    SETUP,
                    "my_robot_controller.my_first_node:main",
                    "my_robot_controler.my_first_node:main",
                ),
                fails="entry_point.mapping",
                blocks=UNSTARTED,
            ),
        ),
    ),
    _raises(
        "other_module",
        msg("it leads to a different module"),
        {
            "swapped": msg(
                "Line {at} has the module that belongs here. Write here: '{wanted}', and then build "
                "again. If line {at} is meant to start the other module, write there: '{other}'"
            )
        },
        examples=(
            example(
                "modules_of_two_entries_exchanged",
                Write("my_robot_controller/second.py", "def main():\n    pass\n"),
                Replace(
                    SETUP,
                    "'test_node = my_robot_controller.my_first_node:main',\n",
                    "'test_node = my_robot_controller.second:main',\n"
                    "            'second = my_robot_controller.my_first_node:main',\n",
                ),
                fails="entry_point.mapping",
            ),
        ),
    ),
    _raises(
        "misspelt_module",
        msg("there is no module with that name"),
        # (the import that an entry makes, and none in a file, ends in importlib)
        seen=r'^  File "<frozen importlib\._bootstrap>", line \d{1,6}, in \w{1,60}\n'
        r"ModuleNotFoundError: No module named '(?P<module>\w{1,120}\.[\w.]{1,200})'",
        examples=(
            example(
                "module_misspelt",
                Replace(
                    SETUP,
                    "my_robot_controller.my_first_node:main",
                    "my_robot_controller.my_frist_node:main",
                ),
                fails="entry_point.mapping",
                blocks=UNSTARTED,
            ),
        ),
    ),
    Kind(
        id="setup.not_packaged",
        stage="entry point",
        title=msg("setup.py does not install the Python package"),
        why=msg(
            "Only the packages in packages= are installed. If yours is not one of them, the "
            "entry point leads to a module that does not exist."
        ),
        whys={
            **dict.fromkeys(
                ("folder", "import", "other_folder", "library", "unknown_folder"), FOLDERS
            ),
            "made_name": msg(
                "setup() gets its name and its packages from {name}, and code works out the value "
                "of {name}. In the build it becomes a name for which there is no folder."
            ),
            **dict.fromkeys(("argument", "misspelt"), NO_PACKAGES),
            "text": msg(
                "packages= is a list of folders. This value is a text, and setuptools takes each "
                "of its letters for a folder."
            ),
        },
        fix=msg("Write in setup(): {wanted}, then build again."),
        fixes={
            "other_folder": msg(
                "Delete the name of the folder {path} from packages=, or create that folder with an "
                "__init__.py in it. Then build again."
            ),
            "library": msg(
                "Delete {path} from packages=: it is a library, and no folder of this package. It is named "
                "in package.xml. Then build again."
            ),
            "unknown_folder": msg(
                "Find what makes setup.py name {path}: packages= together with package_dir=, or the "
                "values that they are made of. Correct it, then build again."
            ),
            "made_name": msg("Write the name itself in this line: {wanted}. Then build again."),
            "misspelt": msg("Write packages= instead of {name}= in setup(), then build again."),
            "import": msg(
                "Write at the top of setup.py: {statement}, and in setup(): {wanted}, then build "
                "again."
            ),
        },
        link=links.DEVELOPING,
        fixed_by=(layout.init_file, setup_py.packages),
        examples=(
            example(
                "packages_misspelt",
                Replace(SETUP, "    packages=find", "    package=find"),
                fails="build.colcon",
            ),
            example(
                "packages_name_the_file",
                Replace(SETUP, "find_packages(exclude=['test'])", "['my_first_node']"),
                fails="build.colcon",
            ),
            example(
                "packages_name_the_file_alone",
                Replace(SETUP, "from setuptools import find_packages\n", ""),
                Replace(SETUP, "find_packages(exclude=['test'])", "['my_first_node']"),
                fails="build.colcon",
                note="find_packages is not imported",
            ),
            example(
                "packages_name_another_folder_too",
                Replace(
                    SETUP,
                    "find_packages(exclude=['test'])",
                    "[package_name, package_name + '.utils']",
                ),
                fails="build.colcon",
            ),
            example(
                "package_name_of_a_path",
                Replace(
                    SETUP,
                    "package_name = 'my_robot_controller'",
                    "import sys\n\npackage_name = sys.argv[1]",
                ),
                Replace(SETUP, "find_packages(exclude=['test'])", "[package_name]"),
                fails="build.colcon",
            ),
            example(
                "packages_missing",
                Replace(SETUP, "    packages=find_packages(exclude=['test']),\n", ""),
                fails="build.colcon",
            ),
        ),
    ),
    Kind(
        id="entry_point.other_installed",
        stage="entry point",
        title=msg("The build installs something other than the sources say"),
        why=msg(
            "setup.py is a program: what it does besides setup() can change what is installed. "
            "Others read the sources, and expect the package to be what they say."
        ),
        whys={
            **dict.fromkeys(SOURCE_FOLDERS, SOURCE_FOLDER),
            "overlay": OVERLAY,
            "program": PROGRAM,
        },
        fix=msg("Remove what setup.py does besides calling setup()."),
        fixes={
            **SOURCE_FOLDERS,
            "overlay": msg("Remove what installs it (setup.py, colcon.pkg)."),
            "program": msg("Make and spin the node in the function of the entry point."),
        },
        link=links.DEVELOPING,
        fixed_by=(setup_py.fault,),
        examples=(
            example(
                "script_rewritten",
                Replace(
                    SETUP,
                    "    },\n)\n",
                    "    },\n)\n\n"
                    "script = f'../../install/{package_name}/lib/{package_name}/test_node'\n"
                    "try:\n"
                    "    with open(script, 'a') as file:\n"
                    "        file.write('# started\\nprint()\\n')\n"
                    "except OSError:\n"
                    "    pass\n",
                ),
                fails="entry_point.mapping",
                blocks=UNINSTALLED,
            ),
            example(
                "package_dir_leads_nowhere",
                Replace(
                    SETUP,
                    "    packages=find_packages(exclude=['test']),",
                    "    packages=find_packages(exclude=['test']),\n    package_dir={'': 'src'},",
                ),
                fails="entry_point.executable",
                note="the entry's module is looked for in src/, which is not there",
            ),
        ),
    ),
    Kind(
        id="entry_point.computed_mapping",
        stage="entry point",
        title=msg("setup.py computes a different entry than the required one"),
        why=msg("The entry tells ros2 run which function of which module to start."),
        whys={
            "project": msg(
                "The entry is in pyproject.toml, which colcon build --symlink-install does not "
                "read: it runs setup.py in a folder without that file."
            ),
            "twice": msg(
                "setup.py calls setup() twice, and the last call counts. Line {line} has the entry, in a "
                "call above this one."
            ),
            "replaced": msg(
                "Line {line} has the entry. This line, which runs later, gives entry_points another "
                "value, so that setup() does not get the entry."
            ),
            "below": msg(
                "setup() does its work when it is called, in line {line}. What a line below it "
                "changes comes too late."
            ),
        },
        fix=msg("Write the entry into setup.py's entry_points, under console_scripts: '{wanted}',"),
        fixes={
            "made": msg(
                "Write the entry itself instead of the code that makes it: '{wanted}'. Or change that "
                "code, so that it makes this entry. Then build again."
            ),
            "twice": msg("Delete this call of setup()."),
            "replaced": msg(
                "Delete this statement, or write the entry into it, under console_scripts: '{wanted}',"
            ),
            "below": msg(
                "Move this statement up, above setup( in line {line} and below the lines that give "
                "a value to what it uses. Then build again."
            ),
        },
        fixed_by=(entries.replaced,),
        link=links.DEVELOPING,
        examples=(
            example(
                "entry_points_replaced_in_the_settings",
                Replace(SETUP, "setup(\n", "settings = dict(\n"),
                Replace(
                    SETUP,
                    "    },\n)\n",
                    "    },\n)\nsettings['entry_points'] = {'console_scripts': []}\n\nsetup(**settings)\n",
                ),
                fails="entry_point.mapping",
                blocks=UNINSTALLED,
            ),
            example(
                "entry_made_with_the_ending",
                Replace(
                    SETUP,
                    "'test_node = my_robot_controller.my_first_node:main',",
                    "*[f'test_node = {package_name}.{name}:main' for name in ('my_first_node.py',)],",
                ),
                fails="entry_point.mapping",
                blocks=UNSTARTED,
            ),
            example(
                "setup_called_twice",
                Replace(
                    SETUP,
                    "    },\n)\n",
                    "    },\n)\n\nsetup(name=package_name, version='0.0.1', packages=[package_name])\n",
                ),
                fails="entry_point.mapping",
                blocks=UNSTARTED,
            ),
            example(
                "entry_appended_after_setup",
                Replace(SETUP, "\nsetup(\n", "\nentries = []\n\nsetup(\n"),
                Replace(
                    SETUP,
                    "[\n            'test_node = my_robot_controller.my_first_node:main',\n        ]",
                    "entries",
                ),
                Replace(
                    SETUP,
                    "    },\n)\n",
                    "    },\n)\n"
                    "entries.append('test_node = my_robot_controller.my_first_node:main')\n",
                ),
                fails="entry_point.mapping",
                blocks=UNINSTALLED,
            ),
        ),
    ),
)
