"""The catalogue: the build, and what it installs."""

from __future__ import annotations

from typing import TYPE_CHECKING

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.encodings import DECLARED, ENCODINGS, NOT_UTF8
from grader.mistakes.example import CFG, SETUP, Example, example
from grader.mistakes.fixes import setup_py, syntax
from grader.mistakes.kind import Kind, Parts, Variants
from grader.mistakes.slips import SLIP_WHYS, SLIPS
from grader.package.edit.tree import Replace, Write

if TYPE_CHECKING:
    from typing_extensions import Unpack

WHY = msg(
    "colcon runs setup.py to install the package into the workspace's install folder, where "
    "ros2 run looks for it."
)
UNREADABLE = msg(
    "colcon runs setup.py to install the package into the workspace's install folder, where "
    "ros2 run looks for it. Python cannot run a file that it cannot read."
)
LOOKS = msg(
    "ros2 run looks only in install/<package>/lib/<package>/, for an executable file with exactly "
    "that name. colcon creates it there from entry_points in setup.py and the paths in setup.cfg."
)
INSIDE = msg(
    "The build stopped at a value of setup(), or of [metadata] or [options] in setup.cfg "
    "if you have them. Compare each value with a setup.py that ros2 pkg create makes, and "
    "with what the error says. Correct what differs, then build again."
)
NOT_ACCEPTED = msg(
    "colcon runs setup.py to install the package into the workspace's install folder. The "
    "build stops at a value of setup(), or of setup.cfg, that it cannot use."
)
PACKAGE_DIR = msg(
    "package_dir leads to the folder {name}, and the package has no such folder. Delete "
    "package_dir, and where= in find_packages() if it is there, then build again."
)
NODE = msg(
    "The code of a node is in setup.py. Delete it there, or move it to {path} if that file does "
    "not have the node yet. setup.py has only what ros2 pkg create writes into it."
)


def _build(slug: str, title: str, fix: str, why: str = WHY, **parts: Unpack[Variants]) -> Kind:
    return Kind(
        id=f"build.{slug}",
        stage="build",
        title=title,
        why=why,
        fix=fix,
        link=links.COLCON,
        **parts,
    )


def _installed(slug: str, title: str, fix: str, **parts: Unpack[Parts]) -> Kind:
    return Kind(
        id=f"entry_point.{slug}",
        stage="build",
        title=title,
        why=LOOKS,
        fix=fix,
        link=links.DEVELOPING,
        **parts,
    )


def _example(name: str, old: str, new: str, *, maps: bool = True) -> Example:
    """Return a package with a change in setup.py; without `maps`, its entries are not known."""
    blocks = () if maps else ("entry_point.mapping",)
    return example(name, Replace(SETUP, old, new), fails="build.colcon", blocks=blocks)


CALL = "\nsetup(\n"
ENTRY = "            'test_node = my_robot_controller.my_first_node:main',\n"
MANIFEST_LINE = "        ('share/' + package_name, ['package.xml']),\n"
USES = "        (os.path.join('share', package_name, 'launch'), glob('launch/*.py')),\n"
NODE_ABOVE = "\nimport rclpy\nrclpy.init()\nrclpy.spin(rclpy.create_node('a'))\nsetup(\n"
DEVELOP = """\
from setuptools.command.develop import develop


class Develop(develop):
    def run(self):
        pass


setup(
    cmdclass={'develop': Develop},
"""
NO_BIT = """\
import os

from setuptools.command.develop import develop


class Develop(develop):
    def run(self):
        super().run()
        if not self.uninstall:
            os.chmod(os.path.join(self.script_dir, 'test_node'), 0o644)


setup(
    cmdclass={'develop': Develop},
"""
KINDS = (
    _build(
        "ignored",
        msg("The package has a file COLCON_IGNORE or AMENT_IGNORE"),
        msg("Delete that file. In the package's folder, run: rm {name}. Then build again."),
        msg("colcon skips every folder that has a file of this name, without a message."),
        examples=(example("colcon_ignore", Write("COLCON_IGNORE", ""), fails="build.colcon"),),
    ),
    _build(
        "setup_prints",
        msg("setup.py prints something"),
        msg("Remove the print() from setup.py, then build again."),
        msg(
            "colcon asks setup.py for its data and reads its output as the answer. What print() "
            "writes ends up in the middle of that answer."
        ),
        fixes={
            "answer": msg(
                "Look for a value of setup() that is an object or a function instead of a text, a "
                "number, a list or a dict, for python_requires in setup.cfg, and for code in setup.py "
                "that writes output. Correct or delete it, then build again."
            ),
        },
        whys={
            "answer": msg(
                "colcon asks setup.py for its data and reads its output as the answer. It could not "
                "read this one."
            ),
        },
        fixed_by=(setup_py.prints,),
        examples=(_example("setup_prints", CALL, "\nprint('building')\nsetup(\n"),),
    ),
    _build(
        "setup_error",
        msg("setup.py stops with an error"),
        msg("Correct what the error names, here or where its values are made. Then build again."),
        whys={
            "unreadable": UNREADABLE,
            "file": msg(
                "colcon build --symlink-install runs setup.py in the build folder. From there, a "
                "relative path leads to another place than from the package's folder."
            ),
            **dict.fromkeys(("inside", "data_files"), NOT_ACCEPTED),
            **dict.fromkeys(ENCODINGS, NOT_UTF8),
            "declared": DECLARED,
            **SLIP_WHYS,
        },
        fixes={
            "comma": msg(
                "Write a comma at the end of line {line}, then build again. Without it, "
                "Python calls what that line contains."
            ),
            "joined": msg(
                "Look at this line and the one above it. Without the comma between two values, or the "
                "colon behind a key, Python takes the second for a part of the first. Then build again."
            ),
            "unreadable": msg(
                "Python stops at that line of setup.py. The mistake is there or before it, often at "
                "the end of the line above. Compare both lines with those that ros2 pkg create "
                "writes, then build again."
            ),
            "no_import": msg("Add at the top of setup.py, then build again: {statement}"),
            "outside": msg(
                "Move this entry between the [ and the ] of 'console_scripts' (line {line} has the ]), "
                "with a comma after it, then build again."
            ),
            "repeated": msg(
                "Give {name} to setup() only once: put what you need into one of the two, and delete "
                "the other."
            ),
            "file": msg(
                "Do not read {name} in setup.py: delete that line and what uses it, or write the value "
                "itself there. Then build again."
            ),
            "misspelt": msg("Write {close} instead of {name}, then build again."),
            "variable": msg("Write above setup(, then build again: {statement}"),
            "undefined": msg(
                "No line of setup.py defines {name}. If it is a text, write quotes around it: "
                "'{name}'. If it is a variable, give it a value above setup(. Then build again."
            ),
            "data_files": msg(
                "Each line of data_files is a folder and a list of files, in round brackets, by paths "
                "without / at the beginning. Give the line that differs this form, then build again: "
                "('share/' + package_name, ['package.xml']),"
            ),
            "inside": INSIDE,
            **ENCODINGS,
            **SLIPS,
        },
        fixed_by=(
            syntax.setup_py,
            setup_py.comma,
            setup_py.entry_inside,
            setup_py.imports,
            setup_py.fault,
        ),
        examples=(
            _example("comma_between_tuples_missing", "+ package_name]),", "+ package_name])"),
            _example("setup_uses_os_and_glob", MANIFEST_LINE, MANIFEST_LINE + USES),
            _example(
                "entry_outside_list",
                f"{ENTRY}        ],\n",
                f"        ],\n{ENTRY.replace('            ', '        ')}",
                maps=False,
            ),
            _example("setup_called_by_a_misspelt_name", CALL, "\nsetu(\n", maps=False),
            example(
                "setup_in_latin_1",
                Write(SETUP, b"from setuptools import setup\n\n# J\xfcrgen\nsetup()\n"),
                fails="build.colcon",
                blocks=("entry_point.mapping",),
            ),
            _example("group_without_quotes", "'console_scripts'", "console_scripts", maps=False),
            _example(
                "setup_argument_repeated",
                "    entry_points={",
                "    entry_points={},\n    entry_points={",
                maps=False,
            ),
            _example("setup_syntax_error", "version='0.0.0',", "version='0.0.0'", maps=False),
            _example("setup_quote_missing", "first_node:main'", "first_node:main", maps=False),
            _example(
                "setup_typographic_quotes",
                "'test_node = my_robot_controller.my_first_node:main'",
                "\u2018test_node = my_robot_controller.my_first_node:main\u2019",
                maps=False,
            ),
            _example(
                "setup_page_label",
                "from setuptools import find_packages\n",
                "Python\nfrom setuptools import find_packages\n",
            ),
            _example("setup_variable_missing", "package_name = 'my_robot_controller'\n", ""),
            _example("setup_text_unquoted", "license='Apache-2.0'", "license=Apache"),
            _example(
                "setup_import_error", "from setuptools import setup", "from setuptool import setup"
            ),
            _example(
                "setup_reads_missing_file",
                "    zip_safe=True,",
                "    zip_safe=True,\n    long_description=open('README.md').read(),",
            ),
            _example(
                "find_packages_not_called", "find_packages(exclude=['test'])", "find_packages"
            ),
            _example("setup_file_without_list", "['package.xml']", "'package.xml'"),
            _example(
                "setup_name_positional", "    name=package_name,", "    package_name,", maps=False
            ),
            _example("setup_raises", CALL, "\nraise RuntimeError('not today')\nsetup(\n"),
        ),
    ),
    _build(
        "entry_unreadable",
        msg("setuptools stopped at an entry of console_scripts"),
        msg(
            "Check the entries of console_scripts in setup.py: each is 'name = "
            "package.module:function', with a comma after it."
        ),
        msg(
            "setuptools stops at an entry point that it cannot read. colcon then says only that "
            "distutils.core.setup() was never called."
        ),
        seen=r"'?distutils\.core\.setup\(\)'? was never called",
    ),
    _build(
        "exited",
        msg("setup.py ends before setup() has done its work"),
        msg(
            "Remove the exit from setup.py, and compare the file with the one that ros2 pkg "
            "create makes."
        ),
        msg(
            "colcon runs setup.py to install the package into the workspace's install folder, "
            "where ros2 run looks for it. It must reach the call of setup(), and setup() must accept "
            "its values: otherwise colcon says only that distutils.core.setup() was never called."
        ),
        fixes={
            "node": NODE,
            "not_done": msg(
                "In the package's folder, run: python3 setup.py --version. If that prints an error, "
                "correct the value of setup() that it names. If it prints nothing, something in setup.py "
                "ends it, or no line reaches the call of setup(). Then build again."
            ),
            "missing": msg(
                "setup.py does not call setup(…). Compare the file with the one that ros2 pkg "
                "create makes."
            ),
        },
        examples=(
            _example("setup_exits", CALL, "\nimport sys\nsys.exit(0)\nsetup(\n"),
            example(
                "node_in_setup",
                Write(SETUP, "import rclpy\n\n\ndef main(args=None):\n    rclpy.init(args=args)\n"),
                fails="build.colcon",
                blocks=("entry_point.mapping",),
            ),
            _example("setup_boolean_in_quotes", "zip_safe=True", "zip_safe='yes'"),
            _example("setup_never_called", CALL, "\ndict(\n", maps=False),
        ),
    ),
    _build(
        "timeout",
        msg("The build does not finish"),
        msg(
            "Find what setup.py waits for or repeats without end (such as a loop, a sleep or "
            "input()), remove it, then build again."
        ),
        msg(
            "colcon runs setup.py to install the package into the workspace's install folder, "
            "where ros2 run looks for it. A setup.py that loops or waits never "
            "finishes."
        ),
        fixes={"node": NODE},
        examples=(
            _example("node_above_setup", CALL, NODE_ABOVE),
            _example("setup_loops", CALL, "\nwhile True:\n    pass\n\nsetup(\n"),
        ),
    ),
    _build(
        "resource",
        msg("The build reached a limit of the sandbox"),
        msg("Use setup.py only to describe the package: no large output, no other programs."),
    ),
    _build(
        "failed",
        msg("The build failed"),
        msg(
            "Read the build log below, starting at its first error. Build again after each change."
        ),
        fixes={
            "last": msg(
                "Correct what this message names, in setup.py or in the files of the package, then "
                "build again. The build log below has the lines around it."
            ),
            "no_copy": msg(
                "data_files in setup.py lists {name}, and the package has no file of this name; a folder "
                "cannot be listed, only the files in it. Correct the name, delete it from data_files, or "
                "create the file. Then build again."
            ),
            "no_marker": msg(
                "{name} is the empty file by which ROS finds the package. Create it in the package's folder: "
                "mkdir -p resource && touch {name}. Then build again."
            ),
            "option": msg(
                "Correct or delete {name} below [{section}] in setup.cfg: setuptools does not know it "
                "there. Then build again."
            ),
            "package_dir": PACKAGE_DIR,
        },
        examples=(
            example(
                "entry_in_setup_cfg",
                Replace(
                    CFG,
                    "install_scripts=$base/lib/my_robot_controller\n",
                    "install_scripts=$base/lib/my_robot_controller\n"
                    "'test_node = my_robot_controller.my_first_node:main',\n",
                ),
                fails="build.colcon",
            ),
            _example(
                "setup_source_folder_missing",
                "    packages=find_packages(exclude=['test']),",
                "    packages=find_packages(where='src'),\n    package_dir={'': 'src'},",
            ),
            _example(
                "setup_data_file_missing",
                "['package.xml']",
                "['package.xml', 'launch/hello.launch.py']",
            ),
        ),
    ),
    _installed(
        "no_exec_bit",
        msg("The installed executable lost its exec bit"),
        msg(
            "Remove the code in setup.py that clears the exec bit, then build again. The "
            "build itself writes the file with mode 0755."
        ),
        examples=(
            example(
                "develop_takes_the_exec_bit",
                Replace(SETUP, CALL, NO_BIT),
                fails="entry_point.executable",
            ),
        ),
    ),
    _installed(
        "elsewhere",
        msg("The executable was installed where ros2 run does not look"),
        msg(
            "Write both sections in setup.cfg, each with one line only: [develop] with "
            "script_dir=$base/lib/{package} and [install] with install_scripts=$base/lib/{package}. "
            "Then build again."
        ),
        examples=(
            example(
                "script_dir_twice",
                Replace(CFG, "\n[install]", "\nscript-dir=$base/bin\n[install]"),
                fails="entry_point.executable",
            ),
        ),
    ),
    _installed(
        "not_installed",
        msg("The executable was not installed"),
        msg(
            "setup.py names an entry, and the build still made no executable of it. Delete from "
            "setup.py what changes the installation, such as cmdclass, then build again."
        ),
        examples=(
            example(
                "develop_does_nothing",
                Replace(SETUP, CALL, DEVELOP),
                fails="entry_point.executable",
            ),
        ),
    ),
)
