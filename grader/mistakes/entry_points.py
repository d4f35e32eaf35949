"""The catalogue: the entry point in setup.py, part by part.

The titles of invalid entries follow the quoted entry and a colon, so they begin in lower case.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.build import PACKAGE_DIR
from grader.mistakes.example import SETUP, UNBUILT, UNINSTALLED, UNSTARTED, Example, example
from grader.mistakes.fixes import entries, layout, setup_py
from grader.mistakes.kind import Kind, Variants
from grader.package.edit.tree import Delete, Replace, Write

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
WRITE = msg("Write '{wanted}', then build again.")


def _entry(
    slug: str, title: str, fix: str = WRITE, why: str = NOT_FOUND, **parts: Unpack[Variants]
) -> Kind:
    return Kind(
        id=f"setup.{slug}",
        stage="entry point",
        title=title,
        why=why,
        fix=fix,
        link=links.DEVELOPING,
        **parts,
    )


def _example(
    name: str, old: str, new: str, *, blocks: tuple[str, ...] = UNSTARTED, blocking: bool = True
) -> Example:
    """Return a package with a change in setup.py, at which the entry point fails."""
    edit = Replace(SETUP, old, new)
    return example(name, edit, fails="entry_point.mapping", blocks=blocks, blocking=blocking)


TARGET = "my_robot_controller.my_first_node:main"
LINE = f"            'test_node = {TARGET}',\n"
SECOND = Write("my_robot_controller/second.py", "def main():\n    pass\n")
POINTS = f"    entry_points={{\n        'console_scripts': [\n{LINE}        ],\n    }},\n"
REWRITES = """\
    },
)

script = f'../../install/{package_name}/lib/{package_name}/test_node'
try:
    with open(script, 'a') as file:
        file.write('# started\\nprint()\\n')
except OSError:
    pass
"""
IN_CLASS = msg(
    "{function} is a method (line {line} of {path}), and the exercise asks for a function outside of "
    "classes. Write def {function}(): below the class, at the left margin, with what the method does. Then "
    "write '{wanted}' in setup.py, and build again."
)
TARGETS: Mapping[str, tuple[str, str]] = {
    "no_function": (
        msg("the function is missing: a module cannot be called"),
        r"TypeError: 'module' object is not callable",
    ),
    "dot_for_colon": (
        msg("between module and function comes ':', not '.'"),
        r"No module named '(?P<module>[\w.]{1,200}\.main)'; '[\w.]{1,200}' is not a package",
    ),
    "py_in_target": (
        msg("a module's name does not include .py"),
        r"No module named '(?P<module>[\w.]{1,200}\.py)'",
    ),
    "no_package_prefix": (msg("the package's name and a dot are missing"), ""),
    "other_function": (msg("the function has a different name"), ""),
    "other_package": (msg("the package has a different name"), ""),
    "other_module": (msg("it leads to a different module"), ""),
    # (the import that an entry makes, and none in a file, ends in importlib)
    "misspelt_module": (
        msg("there is no module with that name"),
        r'^  File "<frozen importlib\._bootstrap>", line \d{1,6}, in \w{1,60}\n'
        r"ModuleNotFoundError: No module named '(?P<module>\w{1,120}\.[\w.]{1,200})'",
    ),
}
"""The parts of an entry that leads to something else, and how the terminal shows it."""
OTHER_TARGETS: Mapping[str, tuple[Example, ...]] = {
    "no_function": (_example("main_left_out", TARGET, TARGET.removesuffix(":main")),),
    "dot_for_colon": (_example("dot_for_colon", TARGET, TARGET.replace(":", ".")),),
    "py_in_target": (_example("suffix_in_module", TARGET, TARGET.replace(":", ".py:")),),
    "no_package_prefix": (_example("package_left_out", TARGET, "my_first_node:main"),),
    "other_function": (_example("function_misspelt", TARGET, TARGET.replace("main", "mian")),),
    "other_package": (
        _example("package_misspelt", TARGET, TARGET.replace("controller", "controler")),
    ),
    "misspelt_module": (_example("module_misspelt", TARGET, TARGET.replace("first", "frist")),),
}
KINDS = (
    _entry(
        "missing",
        msg("There is no setup.py that can be read"),
        msg(
            "In a new folder, run ros2 pkg create --build-type ament_python {package}, and copy its "
            "setup.py here. Then add your entry to console_scripts."
        ),
        WHY,
        fixes={
            "renamed": msg(
                "Give it its name and its place. In the package's folder, run: mv {there} setup.py"
            ),
        },
        fixed_by=(layout.out_of_inner_folder, layout.setup_renamed),
        seen=r"can't open file '[^'\n]{0,300}setup\.py'",
        examples=(
            example("setup_missing", Delete(SETUP), fails="entry_point.mapping", blocks=UNBUILT),
        ),
    ),
    _entry(
        "missing_comma",
        msg("two entries become one, because the comma between them is missing"),
        msg("Add a comma after '{before}', then build again."),
        JOINS,
        fixed_by=(entries.comma,),
        examples=(
            example(
                "comma_missing",
                SECOND,
                Replace(
                    SETUP,
                    LINE,
                    f"            'test_node = {TARGET}'\n"
                    "            'second = my_robot_controller.second:main',\n",
                ),
                fails="entry_point.mapping",
                blocks=UNBUILT,
                note="was never called, says colcon",
            ),
        ),
    ),
    _entry(
        "bad_entry",
        msg("it does not have the form name = package.module:function"),
        WRITE,
        STOPS,
        fixes={"other": msg("Correct or delete this entry: '{entry}'. Then build again.")},
        fixed_by=(entries.replaced,),
        examples=(
            _example("colon_for_equals", "test_node = my", "test_node : my", blocks=UNBUILT),
            _example("slash_for_dot", TARGET, TARGET.replace(".", "/"), blocks=UNBUILT),
            _example("function_called", TARGET, f"{TARGET}()", blocks=UNBUILT),
        ),
    ),
    _entry(
        "duplicate_entry",
        msg("the name is used more than once"),
        msg("Keep only one line, then build again: '{wanted}',"),
        WHY,
    ),
    _entry(
        "other_executable",
        msg("the executable has a different name"),
        fixed_by=(entries.replaced,),
        examples=(
            _example("executable_is_file_name", "'test_node =", "'my_first_node =", blocks=()),
            _example("executable_misspelt", "'test_node =", "'test_nod =", blocks=()),
        ),
    ),
    _entry(
        "group_misspelt",
        msg("the group is not called console_scripts"),
        msg("Write 'console_scripts' instead of '{group}', then build again."),
        msg(
            "setuptools makes executables only from the group console_scripts. It accepts "
            "another one, if its name has only letters, digits, _ and dots, and ros2 run answers: No "
            "executable found."
        ),
        fixes={"other": msg("Move '{wanted}' to the group console_scripts, then build again.")},
        fixed_by=(entries.group,),
        examples=(
            _example("console_script", "console_scripts'", "console_script'", blocks=UNINSTALLED),
            example(
                "gui_scripts",
                Replace(SETUP, "'console_scripts'", "'gui_scripts'"),
                fails="entry_point.mapping",
                note="runs anyway: on Linux setuptools makes the same script for it",
            ),
            _example(
                "console_scripts_with_a_dash",
                "'console_scripts'",
                "'console-scripts'",
                blocks=("build.colcon", *UNINSTALLED),
            ),
        ),
    ),
    _entry(
        "entry_at_margin",
        msg("the entry in setup.cfg is not indented"),
        msg("Write 4 spaces before {code}, then build again."),
        msg(
            "In setup.cfg, a line that begins with spaces belongs to the name above it. A line at "
            "the left margin begins a name of its own, so this entry is not one of console_scripts, "
            "and the build stops."
        ),
    ),
    _entry(
        "misplaced_entry",
        msg("the entry is in the wrong place of setup.py"),
        msg("Move '{wanted}' to the list console_scripts in entry_points, then build again."),
        fixes={
            "variable": msg(
                "Write entry_points={name}, in setup(), below the lines that give {name} its value. Then "
                "build again."
            ),
        },
        examples=(
            example(
                "entry_in_tests_require",
                Replace(SETUP, LINE, ""),
                Replace(
                    SETUP,
                    "    zip_safe=True,",
                    f"    tests_require=[\n        'pytest',\n{LINE[4:]}    ],\n    zip_safe=True,",
                ),
                fails="entry_point.mapping",
                blocks=UNBUILT,
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
    _entry(
        "no_entry",
        msg("there is no entry for the executable"),
        msg("Add this line to console_scripts, then build again: '{wanted}',"),
        fixes={
            "cfg": msg(
                "Add this line to console_scripts below [options.entry_points] in setup.cfg, "
                "indented and without quotes: {wanted}. Then build again."
            ),
            "group": msg(
                "Add to the dict entry_points, then build again: 'console_scripts': ['{wanted}'],"
            ),
            "nothing": msg(
                "Write in setup(), then build again: entry_points={{'console_scripts': ['{wanted}']}},"
            ),
        },
        fixed_by=(entries.added,),
        examples=(
            _example("entry_missing", LINE, "", blocks=UNINSTALLED),
            _example("entry_commented_out", LINE, LINE.replace("'", "# '", 1), blocks=UNINSTALLED),
            _example("entry_points_misspelt", "entry_points=", "entry_point=", blocks=UNINSTALLED),
            _example("entry_points_lost", POINTS, "", blocks=UNINSTALLED),
        ),
    ),
    *(
        _entry(
            slug,
            title,
            WRITE,
            RAISES,
            seen=seen,
            fixed_by=(entries.replaced,),
            fixes={"in_class": IN_CLASS} if slug == "other_function" else {},
            examples=OTHER_TARGETS.get(slug, ()),
        )
        for slug, (title, seen) in TARGETS.items()
    ),
    _entry(
        "not_packaged",
        msg("setup.py does not install the Python package"),
        msg("Write in setup(): {wanted}, then build again."),
        msg(
            "packages= lists the folders to install: folders with an __init__.py, and no files. The "
            "build stops at a name for which there is no such folder. A package that is not one of them "
            "is not installed, and the entry point leads to a module that does not exist."
        ),
        fixes={
            "other_folder": msg(
                "Look at packages=, and at package_dir= if it is there: from them comes the folder {path}. "
                "Correct or delete it, or create that folder with an __init__.py in it. Then build again."
            ),
            "import": msg(
                "Write at the top of setup.py: {statement}, and in setup(): {wanted}, then build "
                "again."
            ),
        },
        fixed_by=(layout.init_file, setup_py.packages),
        examples=(
            example(
                "packages_name_the_file",
                Replace(SETUP, "find_packages(exclude=['test'])", "['my_first_node']"),
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
            "package_dir": msg(
                "package_dir tells setuptools that the packages are in another folder. The build finds no "
                "package there, so ros2 run cannot import the node: ModuleNotFoundError."
            ),
            "overlay": OVERLAY,
            "program": PROGRAM,
        },
        fix=msg("Remove what setup.py does besides calling setup()."),
        fixes={
            "package_dir": PACKAGE_DIR,
            "overlay": msg("Remove what installs it (setup.py, colcon.pkg)."),
            "program": msg("Make and spin the node in the function of the entry point."),
        },
        link=links.DEVELOPING,
        examples=(
            _example("script_rewritten", "    },\n)\n", REWRITES, blocks=UNINSTALLED),
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
        why=msg(
            "The entry tells ros2 run which function of which module to start. setup() gets what its last "
            "call has when it is reached; colcon does not read the entries of pyproject.toml."
        ),
        fix=msg(
            "Write the entry itself into entry_points of the call of setup(), under console_scripts: "
            "'{wanted}', and delete the code that makes or changes entry_points. Then build again."
        ),
        link=links.DEVELOPING,
        examples=(
            _example(
                "entry_made_with_the_ending",
                LINE.strip(),
                "*[f'test_node = {package_name}.{name}:main' for name in ('my_first_node.py',)],",
            ),
            _example(
                "setup_called_twice",
                "    },\n)\n",
                "    },\n)\n\nsetup(name=package_name, version='0.0.1', packages=[package_name])\n",
            ),
        ),
    ),
)
