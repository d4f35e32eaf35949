"""The catalogue: the build, and what it installs."""

from __future__ import annotations

from typing import TYPE_CHECKING

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.encodings import DECLARED, ENCODINGS, NOT_UTF8
from grader.mistakes.example import CFG, SETUP, example
from grader.mistakes.fixes import setup_cfg, setup_py, syntax
from grader.mistakes.kind import Kind, Parts, Variants
from grader.mistakes.package_dir import SOURCE_FOLDERS
from grader.mistakes.slips import (
    DOCUMENTS,
    LANGUAGE,
    OTHER_LANGUAGE,
    PASTED,
    PASTED_WHYS,
    SIGNS,
    WEB,
)
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
OPENED = msg(
    "setup.py stops at a file that it cannot open. It is of no use to create the file: colcon build "
    "--symlink-install runs setup.py in the build folder, and from there a relative path leads to "
    "another place."
)
DELETE = msg("Do not read {name} in setup.py: delete {wanted}, then build again.")
DELETE_ALL = msg(
    "Do not read {name} in setup.py: delete that line and all that use what it reads, then build "
    "again."
)
CONFIG = msg(
    "Write both sections in setup.cfg, each with one line only: [develop] with "
    "script_dir=$base/lib/{package} and [install] with install_scripts=$base/lib/{package}. Then build "
    "again."
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


REFUSED = {
    "refused_version": msg(
        "'{found}' is not a version. A version consists of numbers with points between them: write "
        "'0.0.0' instead, then build again."
    ),
    "refused_condition": msg(
        "Write {argument} as a text with a condition, such as {argument}='>=3.8', or delete this "
        "argument. Then build again."
    ),
    "refused_requirement": msg(
        "'{found}' in {argument} is not the name of a Python package, alone or with a version, such "
        "as 'setuptools>=58'. Correct it or delete it, then build again."
    ),
    "refused_boolean": msg(
        "Write {argument}=True or {argument}=False, without quotes, then build again."
    ),
    "refused_dict": msg(
        "The value of {argument} is a dict, with {{ }} and a colon between key and value. Correct "
        "it, or delete {argument} if you do not need it. Then build again."
    ),
    "refused_text": msg(
        "The value of {argument} is a text. Write it in quotes, without a list around it, then "
        "build again."
    ),
    "refused_list": msg(
        "The value of {argument} is a list. Write its texts between [ and ], with commas between "
        "them. Then build again."
    ),
    "refused_pair": msg(
        "Each line of data_files has two parts, a folder and a list of files: (folder, [file, "
        "file]). Correct this line, then build again: {found}"
    ),
}
FORMS = ("pair_open", "pair_swapped", "absolute", "folder_absolute", "py_modules", "py_modules_too")
NOT_ACCEPTED = msg(
    "colcon runs setup.py to install the package into the workspace's install folder. The "
    "build stops at a value of setup(), or of setup.cfg, that it cannot use."
)


KINDS = (
    _build(
        "ignored",
        msg("The package has a file COLCON_IGNORE or AMENT_IGNORE"),
        msg("Delete that file. In the package's folder, run: rm {name}. Then build again."),
        msg("colcon skips every folder that has a file of this name, without a message."),
        examples=(
            example("colcon_ignore", Write("COLCON_IGNORE", ""), fails="build.colcon"),
            example("ament_ignore", Write("AMENT_IGNORE", ""), fails="build.colcon"),
        ),
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
                "number, a list or a dict, and for code in setup.py that writes output. Correct it, "
                "then build again."
            ),
            "cfg_python": msg("Delete python_requires from setup.cfg, then build again."),
        },
        whys={
            "cfg_python": msg(
                "colcon asks setup.py for its data and reads its output as the answer. setuptools "
                "makes an object of python_requires in setup.cfg, which colcon cannot read."
            ),
            "answer": msg(
                "colcon asks setup.py for its data and reads its output as the answer. It could not "
                "read this one."
            ),
        },
        fixed_by=(setup_cfg.without_entry, setup_py.prints),
        examples=(
            example(
                "setup_prints",
                Replace(SETUP, "\nsetup(\n", "\nprint('building')\nsetup(\n"),
                fails="build.colcon",
                note="colcon reads what setup.py prints as its answer",
            ),
            example(
                "python_requires_in_setup_cfg",
                Replace(CFG, "[develop]", "[options]\npython_requires = >=3.8\n[develop]"),
                fails="build.colcon",
            ),
        ),
    ),
    Kind(
        id="build.setup_error",
        stage="build",
        title=msg("setup.py stops with an error"),
        why=WHY,
        fix=msg("Fix what the error names, then build again."),
        whys={
            "unreadable": UNREADABLE,
            **dict.fromkeys(PASTED, WEB),
            **PASTED_WHYS,
            "hidden": msg(
                "Python finds this file before its own module {name}, which setuptools imports."
            ),
            "relative": msg(
                "The file is there, but colcon build --symlink-install runs setup.py in the build "
                "folder, and from there a relative path leads to another place."
            ),
            "other_place": msg(
                "setup.py is in the package's folder, beside {name}. '{found}' leads to another "
                "folder."
            ),
            **dict.fromkeys(ENCODINGS, NOT_UTF8),
            "declared": DECLARED,
            **dict.fromkeys(("no_file", "no_file_above", "no_file_value", "no_file_other"), OPENED),
            **dict.fromkeys((*REFUSED, *FORMS, "inside", "path_object"), NOT_ACCEPTED),
            **dict.fromkeys(LANGUAGE, OTHER_LANGUAGE),
            **dict.fromkeys(SIGNS, UNREADABLE),
        },
        fixes={
            "comma": msg(
                "Write a comma at the end of line {line}, then build again. Without it, "
                "Python calls what that line contains."
            ),
            "unreadable": msg(
                "Python stops at that line of setup.py. The mistake is there or before it, often at "
                "the end of the line above. Compare both lines with those that ros2 pkg create "
                "writes, then build again."
            ),
            "own_close": msg(
                "{path} does not define {name}, but {close}. Write {close} instead of {name} everywhere "
                "in setup.py, then build again."
            ),
            "own": msg(
                "{path} does not define {name}. Write the value itself into setup.py instead of "
                "importing it, or define {name} in {path}. Then build again."
            ),
            "no_import": msg("Add at the top of setup.py, then build again: {statement}"),
            "outside": msg(
                "Move this entry up, above the ] in line {line}: entries are between the [ and the "
                "] of 'console_scripts'."
            ),
            "outside_empty": msg(
                "Move this entry, without the comma behind it, between the [ and the ] in line {line}, "
                "then build again."
            ),
            "key": msg(
                "Write quotes around {name}: '{name}'. A name without quotes is a variable."
            ),
            "repeated": msg(
                "Give {name} to setup() only once: delete the one that you do not need."
            ),
            "repeated_lines": msg(
                "{name} is given to setup() twice, in lines {line} and {last}. Delete the one that "
                "you do not need, then build again."
            ),
            "repeated_lists": msg(
                "{name} is given to setup() twice, in lines {line} and {last}. Move what is in the "
                "second list into the first one, with a comma after each element, and delete the "
                "second {name}. Then build again."
            ),
            "repeated_empty": msg(
                "{name} is given to setup() twice, in lines {line} and {last}. Delete the empty one, "
                "then build again."
            ),
            "hidden": msg("Give {name}.py another name, or move it out of the package."),
            "relative": msg("Do not open {name} in setup.py: delete that line and what uses it."),
            "other_place": msg("Write '{name}' instead of '{found}', then build again."),
            "no_file": DELETE,
            "no_file_there": DELETE,
            "no_file_above": DELETE_ALL,
            "no_file_there_above": DELETE_ALL,
            "no_file_other": msg(
                "Do not read {name} in setup.py: write the value itself in place of the code that "
                "reads it, then build again."
            ),
            "no_file_value": msg(
                "Write the value itself instead of reading {name}: {wanted}, then build again."
            ),
            "not_called": msg(
                "{name} is a function and must be called. Write: {wanted}, then build again."
            ),
            "not_called_open": msg(
                "{name} is a function, and must be called with ( ) and what it needs in them, such as "
                "glob('launch/*.py'). Write the call, then build again."
            ),
            "comma_behind": msg(
                "The comma at the end of this line makes {name} a tuple, not a text. Delete the comma, so "
                "that the line ends with the quote. Then build again."
            ),
            "list_in_list": msg(
                "find_packages() returns a list already. Write: {wanted}, without the square "
                "brackets around it, then build again."
            ),
            "misspelt": msg("Write {close} instead of {name}, then build again."),
            "variable": msg("Write above setup(, then build again: {statement}"),
            "late": msg(
                "Python reads the file from top to bottom. Move line {line}, which defines {name}, "
                "above setup(, then build again."
            ),
            "late_lines": msg(
                "Python reads the file from top to bottom. Move lines {line} to {last}, which define "
                "{name}, above setup(, then build again."
            ),
            "python_2": msg(
                "{name} is a function of Python 2. Python 3 does not have it. Delete the line that calls it "
                "and write in setup.py itself what it gives, then build again."
            ),
            "undefined": msg(
                "No line of setup.py defines {name}. If it is a text, write quotes around it: "
                "'{name}'. If it is a variable, give it a value above setup(. Then build again."
            ),
            "no_module": msg(
                "Python finds no module {name}. Correct its name, or delete that import and what "
                "uses it (a setup.py needs only setuptools). Then build again."
            ),
            "positional": msg(
                "Each value in setup() has a name and an = before it. Write: {wanted}, then build "
                "again."
            ),
            "no_comma": msg(
                "A comma is between a folder and the list of its files. Write {wanted} instead of {name}."
            ),
            "no_colon": msg(
                "A colon is between a key and its value. Write {wanted} instead of {name}."
            ),
            "unpacked": msg(
                "{name} is a dict with the values of setup(). Write setup({wanted}): the two stars "
                "give each value under its name. Then build again."
            ),
            "ros_1": msg(
                "This is the setup.py of a ROS 1 package (catkin). In a new folder, run ros2 pkg "
                "create --build-type ament_python {package}, copy its setup.py here, and write the "
                "entry of your executable into console_scripts. Then build again."
            ),
            "import_form": msg(
                "The import and the call do not fit together. Write {wanted} instead of {found}, "
                "then build again."
            ),
            "group_name": msg(
                "The name of a group of entry_points may have only letters, digits, _ and dots. Move "
                "the entries of '{name}' to console_scripts and delete this group, then build again."
            ),
            "file_alone": msg(
                "The files of a line of data_files are a list. Write: {wanted}, then build again."
            ),
            "inside": msg(
                "The build stopped at a value of setup(), or of [metadata] or [options] in setup.cfg "
                "if you have them. Compare each value with a setup.py that ros2 pkg create makes, and "
                "with what the error says. Correct what differs, then build again."
            ),
            "pair_open": msg(
                "Each line of data_files is a folder and a list of files, in round brackets. Write "
                "( before each folder and ) behind its list: {wanted}, then build again."
            ),
            "pair_swapped": msg(
                "In each line of data_files, the folder is the first part, and the list of files the "
                "second. Write: {wanted}, then build again."
            ),
            "absolute": msg(
                "The files of data_files are named by their path from the folder of setup.py. Write "
                "{wanted} instead of {found}, then build again."
            ),
            "folder_absolute": msg(
                "The folders of data_files are below the install folder, so their names do not begin "
                "with /. Write {wanted} instead of {found}, then build again."
            ),
            "py_modules": msg(
                "py_modules= is for single files beside setup.py, and there is no {name}. Delete "
                "py_modules=, and write {wanted}. Then build again."
            ),
            "py_modules_too": msg(
                "py_modules= is for single files beside setup.py, and there is no {name}. Delete "
                "py_modules=, then build again."
            ),
            "path_object": msg(
                "colcon reads only texts here. Write str(…) around each path of pathlib in {argument}, "
                "then build again."
            ),
            **REFUSED,
            **ENCODINGS,
            **PASTED,
            **DOCUMENTS,
            **LANGUAGE,
            **SIGNS,
        },
        link=links.COLCON,
        fixed_by=(
            syntax.setup_py,
            setup_py.comma,
            setup_py.key,
            setup_py.entry_inside,
            setup_py.imports,
            setup_py.fault,
        ),
        examples=(
            example(
                "setup_imports_a_misspelt_name",
                Write("my_robot_controller/config.py", "NAME = 'my_robot_controller'\n"),
                Replace(
                    SETUP,
                    "\nsetup(\n",
                    "\nfrom my_robot_controller.config import NAMES\n\nsetup(\n",
                ),
                fails="build.colcon",
            ),
            example(
                "comma_between_tuples_missing",
                Replace(SETUP, "['resource/' + package_name]),", "['resource/' + package_name])"),
                fails="build.colcon",
            ),
            example(
                "setup_uses_os_and_glob",
                Replace(
                    SETUP,
                    "        ('share/' + package_name, ['package.xml']),\n",
                    "        ('share/' + package_name, ['package.xml']),\n"
                    "        (os.path.join('share', package_name, 'launch'), glob('launch/*.py')),\n",
                ),
                fails="build.colcon",
            ),
            example(
                "entry_outside_list",
                Replace(
                    SETUP,
                    "            'test_node = my_robot_controller.my_first_node:main',\n        ],\n",
                    "        ],\n        'test_node = my_robot_controller.my_first_node:main',\n",
                ),
                fails="build.colcon",
                blocks=("entry_point.mapping",),
            ),
            example(
                "setup_called_by_a_misspelt_name",
                Replace(SETUP, "\nsetup(\n", "\nsetu(\n"),
                fails="build.colcon",
                blocks=("entry_point.mapping",),
            ),
            example(
                "py_modules_for_packages",
                Replace(
                    SETUP,
                    "packages=find_packages(exclude=['test'])",
                    "packages=[],\n    py_modules=['my_first_node']",
                ),
                fails="build.colcon",
            ),
            example(
                "folder_without_comma_in_data_files",
                Replace(
                    SETUP,
                    "        ('share/' + package_name, ['package.xml']),\n",
                    "        ('share/my_robot_controller' ['package.xml']),\n",
                ),
                fails="build.colcon",
            ),
            example(
                "key_without_colon_in_setup",
                Replace(SETUP, "'console_scripts': [", "'console_scripts' ["),
                fails="build.colcon",
                blocks=("entry_point.mapping",),
            ),
            example(
                "setup_gets_a_dict_with_one_star",
                Replace(SETUP, "setup(\n", "settings = dict(\n"),
                Replace(SETUP, "    },\n)\n", "    },\n)\n\nsetup(*settings)\n"),
                fails="build.colcon",
                blocks=("entry_point.mapping",),
            ),
            example(
                "setup_lines_of_data_files_without_brackets",
                Replace(SETUP, "        ('share/ament", "        'share/ament"),
                Replace(SETUP, "['resource/' + package_name]),", "['resource/' + package_name],"),
                Replace(
                    SETUP,
                    "('share/' + package_name, ['package.xml']),",
                    "'share/' + package_name, ['package.xml'],",
                ),
                fails="build.colcon",
            ),
            example(
                "setup_line_of_data_files_exchanged",
                Replace(
                    SETUP,
                    "('share/' + package_name, ['package.xml']),",
                    "(['package.xml'], 'share/' + package_name),",
                ),
                fails="build.colcon",
            ),
            example(
                "setup_file_of_data_files_absolute",
                Replace(
                    SETUP,
                    "\nsetup(\n",
                    "\nimport os\n\nHERE = os.path.dirname(os.path.realpath(__file__))\n\nsetup(\n",
                ),
                Replace(SETUP, "['package.xml']", "[os.path.join(HERE, 'package.xml')]"),
                fails="build.colcon",
            ),
            example(
                "setup_folder_of_data_files_absolute",
                Replace(SETUP, "('share/' + package_name,", "('/share/' + package_name,"),
                fails="build.colcon",
            ),
            example(
                "setup_py_modules_for_packages",
                Replace(
                    SETUP,
                    "packages=find_packages(exclude=['test'])",
                    "py_modules=['my_first_node']",
                ),
                fails="build.colcon",
            ),
            example(
                "setup_py_modules_beside_packages",
                Replace(
                    SETUP,
                    "    zip_safe=True,\n",
                    "    zip_safe=True,\n    py_modules=['my_first_node'],\n",
                ),
                fails="build.colcon",
            ),
            example(
                "setup_reads_a_file_of_the_folder_above",
                Replace(SETUP, "\nsetup(\n", "\nopen('../package.xml').close()\n\nsetup(\n"),
                fails="build.colcon",
            ),
            example(
                "setup_in_utf_16",
                Write(SETUP, "from setuptools import setup\n\nsetup()\n".encode("utf-16")),
                fails="build.colcon",
                blocks=("entry_point.mapping",),
            ),
            example(
                "setup_in_latin_1",
                Write(SETUP, b"from setuptools import setup\n\n# J\xfcrgen\nsetup()\n"),
                fails="build.colcon",
                blocks=("entry_point.mapping",),
            ),
            example(
                "group_without_quotes",
                Replace(SETUP, "'console_scripts'", "console_scripts"),
                fails="build.colcon",
                blocks=("entry_point.mapping",),
            ),
            example(
                "second_group_with_a_dash",
                Replace(
                    SETUP,
                    "    entry_points={\n",
                    "    entry_points={\n        'launch-files': ['hello = my_robot_controller:hello'],\n",
                ),
                fails="build.colcon",
            ),
            example(
                "setup_argument_repeated",
                Replace(SETUP, "    entry_points={", "    entry_points={},\n    entry_points={"),
                fails="build.colcon",
                blocks=("entry_point.mapping",),
            ),
            example(
                "setup_argument_repeated_empty_last",
                Replace(
                    SETUP, "    },\n)\n", "    },\n    entry_points={'console_scripts': []},\n)\n"
                ),
                fails="build.colcon",
                blocks=("entry_point.mapping",),
            ),
            example(
                "setup_version_in_cfg",
                Replace(CFG, "[develop]", "[metadata]\nversion = 1.0-SNAPSHOT\n[develop]"),
                Replace(SETUP, "    version='0.0.0',\n", ""),
                fails="build.colcon",
            ),
            example(
                "setup_opens_relative_path",
                Replace(
                    SETUP,
                    "setup(\n",
                    "with open('setup.cfg') as file:\n    file.read()\nwith open('README.md') as file:\n    file.read()\n\nsetup(\n",
                ),
                Write("README.md", "A package.\n"),
                fails="build.colcon",
            ),
            example(
                "module_of_python_hidden",
                Write("logging.py", "import logging\n\nlogging.basicConfig()\n"),
                fails="build.colcon",
            ),
            example(
                "setup_syntax_error",
                Replace(SETUP, "    version='0.0.0',", "    version='0.0.0'"),
                fails="build.colcon",
                blocks=("entry_point.mapping",),
            ),
            example(
                "setup_two_commas",
                Replace(SETUP, "    version='0.0.0',", "    version='0.0.0',,"),
                fails="build.colcon",
                blocks=("entry_point.mapping",),
            ),
            example(
                "setup_equals_in_dict",
                Replace(SETUP, "'console_scripts': [", "'console_scripts' = ["),
                fails="build.colcon",
                blocks=("entry_point.mapping",),
            ),
            example(
                "setup_colon_in_call",
                Replace(SETUP, "    license='Apache-2.0',", "    'license': 'Apache-2.0',"),
                fails="build.colcon",
                blocks=("entry_point.mapping",),
            ),
            example(
                "setup_bracket_of_an_argument_open",
                Replace(
                    SETUP, "find_packages(exclude=['test']),", "find_packages(exclude=['test'],"
                ),
                fails="build.colcon",
                blocks=("entry_point.mapping",),
            ),
            example(
                "setup_quote_missing",
                Replace(
                    SETUP,
                    "my_robot_controller.my_first_node:main'",
                    "my_robot_controller.my_first_node:main",
                ),
                fails="build.colcon",
                blocks=("entry_point.mapping",),
            ),
            example(
                "setup_first_quote_missing",
                Replace(SETUP, "    license='Apache-2.0',", "    license=Apache-2.0',"),
                fails="build.colcon",
                blocks=("entry_point.mapping",),
            ),
            example(
                "setup_entry_unquoted",
                Replace(
                    SETUP,
                    "'test_node = my_robot_controller.my_first_node:main'",
                    "test_node = my_robot_controller.my_first_node:main",
                ),
                fails="build.colcon",
                blocks=("entry_point.mapping",),
            ),
            example(
                "setup_typographic_quotes",
                Replace(
                    SETUP,
                    "'test_node = my_robot_controller.my_first_node:main'",
                    "\u2018test_node = my_robot_controller.my_first_node:main\u2019",
                ),
                fails="build.colcon",
                blocks=("entry_point.mapping",),
            ),
            example(
                "setup_no_break_space",
                Replace(SETUP, "    version='0.0.0',", "\u00a0\u00a0\u00a0\u00a0version='0.0.0',"),
                fails="build.colcon",
                blocks=("entry_point.mapping",),
            ),
            example(
                "setup_code_fence",
                Replace(
                    SETUP,
                    "from setuptools import find_packages\n",
                    "```\nfrom setuptools import find_packages\n",
                ),
                fails="build.colcon",
                blocks=("entry_point.mapping",),
            ),
            example(
                "setup_page_label",
                Replace(
                    SETUP,
                    "from setuptools import find_packages\n",
                    "Python\nfrom setuptools import find_packages\n",
                ),
                fails="build.colcon",
                note="NameError: name 'Python' is not defined",
            ),
            example(
                "setup_slashes_comment",
                Replace(SETUP, "    zip_safe=True,", "    zip_safe=True,  // as created"),
                fails="build.colcon",
                blocks=("entry_point.mapping",),
            ),
            example(
                "setup_indentation",
                Replace(SETUP, "    zip_safe=True,\n", "    zip_safe=True,\n  )\n"),
                fails="build.colcon",
                blocks=("entry_point.mapping",),
            ),
            example(
                "setup_name_error",
                Replace(SETUP, "\nsetup(\n", "\nprint(pakage_name)\nsetup(\n"),
                fails="build.colcon",
            ),
            example(
                "setup_import_misspelt",
                Replace(SETUP, "import find_packages", "import find_package"),
                Replace(SETUP, "packages=find_packages(", "packages=find_package("),
                fails="build.colcon",
            ),
            example(
                "setup_true_in_small_letters",
                Replace(SETUP, "zip_safe=True", "zip_safe=true"),
                fails="build.colcon",
            ),
            example(
                "setup_import_error",
                Replace(SETUP, "from setuptools import setup", "from setuptool import setup"),
                fails="build.colcon",
            ),
            example(
                "setup_reads_missing_file",
                Replace(
                    SETUP,
                    "    zip_safe=True,",
                    "    zip_safe=True,\n    long_description=open('README.md').read(),",
                ),
                fails="build.colcon",
            ),
            example(
                "setup_reads_missing_file_above",
                Replace(
                    SETUP,
                    "\nsetup(\n",
                    "\nwith open('README.md') as file:\n    text = file.read()\n\nsetup(\n"
                    "    long_description=text,\n",
                ),
                fails="build.colcon",
            ),
            example(
                "setup_reads_requirements",
                Replace(
                    SETUP,
                    "install_requires=['setuptools']",
                    "install_requires=open('requirements.txt').read().split()",
                ),
                fails="build.colcon",
            ),
            example(
                "find_packages_not_called",
                Replace(SETUP, "find_packages(exclude=['test'])", "find_packages"),
                fails="build.colcon",
            ),
            example(
                "package_name_with_a_comma",
                Replace(
                    SETUP,
                    "package_name = 'my_robot_controller'\n",
                    "package_name = 'my_robot_controller',\n",
                ),
                fails="build.colcon",
            ),
            example(
                "entry_below_an_empty_list",
                Replace(
                    SETUP,
                    "'console_scripts': [\n            'test_node = my_robot_controller.my_first_node:main',\n        ],",
                    "'console_scripts': [],\n        'test_node = my_robot_controller.my_first_node:main',",
                ),
                fails="build.colcon",
                blocks=("entry_point.mapping",),
            ),
            example(
                "find_packages_in_list",
                Replace(
                    SETUP, "find_packages(exclude=['test'])", "[find_packages(exclude=['test'])]"
                ),
                fails="build.colcon",
            ),
            example(
                "setup_variable_missing",
                Replace(SETUP, "package_name = 'my_robot_controller'\n", ""),
                fails="build.colcon",
            ),
            example(
                "setup_text_unquoted",
                Replace(SETUP, "license='Apache-2.0'", "license=Apache"),
                fails="build.colcon",
            ),
            example(
                "setup_values_in_a_dict",
                Replace(SETUP, "\nsetup(\n", "\nconfig = dict(\n"),
                Replace(SETUP, "        ],\n    },\n)\n", "        ],\n    },\n)\nsetup(config)\n"),
                fails="build.colcon",
                blocks=("entry_point.mapping",),
            ),
            example(
                "setup_of_catkin",
                Write(
                    SETUP,
                    "from setuptools import setup\n"
                    "from catkin_pkg.python_setup import generate_distutils_setup\n\n"
                    "d = generate_distutils_setup(\n    packages=['my_robot_controller'],\n"
                    "    package_dir={'': 'src'},\n)\n\nsetup(**d)\n",
                ),
                fails="build.colcon",
                blocks=("entry_point.mapping",),
            ),
            example(
                "setup_name_positional",
                Replace(SETUP, "    name=package_name,", "    package_name,"),
                fails="build.colcon",
                blocks=("entry_point.mapping",),
            ),
            example(
                "setup_glob_not_called",
                Replace(SETUP, "\nsetup(\n", "\nfrom glob import glob\n\nsetup(\n"),
                Replace(SETUP, "['package.xml']", "glob"),
                fails="build.colcon",
            ),
            example(
                "setup_glob_of_module",
                Replace(SETUP, "\nsetup(\n", "\nimport glob\n\nsetup(\n"),
                Replace(SETUP, "['package.xml']", "glob('package.xml')"),
                fails="build.colcon",
            ),
            example(
                "setup_file_without_list",
                Replace(SETUP, "['package.xml']", "'package.xml'"),
                fails="build.colcon",
            ),
            example(
                "setup_version_of_maven",
                Replace(SETUP, "\nsetup(\n", "\nVERSION = '1.0-SNAPSHOT'\n\nsetup(\n"),
                Replace(SETUP, "version='0.0.0'", "version=VERSION"),
                fails="build.colcon",
            ),
            example(
                "setup_license_in_a_list",
                Replace(SETUP, "license='Apache-2.0'", "license=['Apache-2.0']"),
                fails="build.colcon",
            ),
            example(
                "setup_line_of_data_files_in_three",
                Replace(SETUP, "('share/' + package_name,", "('share/', package_name,"),
                fails="build.colcon",
            ),
            example(
                "setup_path_of_pathlib",
                Replace(SETUP, "\nsetup(\n", "\nfrom pathlib import Path\n\nsetup(\n"),
                Replace(SETUP, "['package.xml']", "[Path('package.xml')]"),
                fails="build.colcon",
            ),
            example(
                "setup_raises",
                Replace(SETUP, "\nsetup(\n", "\nraise RuntimeError('not today')\nsetup(\n"),
                fails="build.colcon",
            ),
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
            "where ros2 run looks for it. It must reach the call of setup(): a "
            "sys.exit() before or in that call ends it without a message."
        ),
        fixes={
            "node": msg(
                "The code of a node is in setup.py. Delete it there, or move it to {path} if that file does "
                "not have the node yet. setup.py has only what ros2 pkg create writes into it."
            ),
            **dict.fromkeys(
                ("guard", "named"), msg("Write {wanted} instead of {name}, then build again.")
            ),
            "entries_list": msg(
                "entry_points is a dict: the name of a group, and the list of its entries. Write "
                "{{'console_scripts': before the [, and }} after the ]. Then build again."
            ),
            "entries_pair": msg(
                "entry_points is a dict: the name of a group, a colon, and the list of its entries. "
                "Write {{ and }} instead of the outer brackets, and a colon instead of the comma "
                "between them. Then build again."
            ),
            "entries_set": msg(
                "entry_points is a dict: the name of a group, a colon, and the list of its entries. "
                "Write entry_points={wanted}, then build again."
            ),
            "entries_dict": msg(
                "In {name}, each entry is one text, 'name = package.module:function', in a list. "
                "Write instead of the inner braces: {wanted}. Then build again."
            ),
            **REFUSED,
            "refused": msg(
                "setuptools prints its reason only if you start it yourself. In the package's "
                "folder, run: python3 setup.py --version. Correct the value of setup() that it "
                "names, then build again."
            ),
            "not_done": msg(
                "In the package's folder, run: python3 setup.py --version. If that prints an error, "
                "correct what it names. If it prints nothing, something in setup.py ends it, or no "
                "line reaches the call of setup(). Then build again."
            ),
            "missing": msg(
                "setup.py does not call setup(…). Compare the file with the one that ros2 pkg "
                "create makes."
            ),
            "function": msg(
                "The call of setup() is inside of the function {name}, and no line calls {name}. "
                "Write {name}() as the last line of setup.py, at the left margin, then build again."
            ),
        },
        whys={
            "function": msg(
                "colcon runs setup.py to install the package into the workspace's install folder, "
                "where ros2 run looks for it. The lines of a function run only if it is "
                "called."
            ),
            "named": msg(
                "This line names the function {name}, and does not call it, so setup() in it is not "
                "called and nothing is installed."
            ),
            "guard": msg(
                "colcon runs setup.py, and then __name__ is '__main__'. With another text the "
                "condition is never true, and nothing is installed."
            ),
            **dict.fromkeys(
                (
                    *("refused", "entries_list", "entries_pair", "entries_set", "entries_dict"),
                    *REFUSED,
                ),
                msg(
                    "setuptools stops at a value that it does not accept. colcon then says only "
                    "that distutils.core.setup() was never called."
                ),
            ),
        },
        fixed_by=(setup_py.fault,),
        examples=(
            example(
                "setup_exits",
                Replace(SETUP, "\nsetup(\n", "\nimport sys\nsys.exit(0)\nsetup(\n"),
                fails="build.colcon",
            ),
            example(
                "node_in_setup",
                Write(
                    SETUP,
                    "import rclpy\n\n\ndef main(args=None):\n    rclpy.init(args=args)\n",
                ),
                fails="build.colcon",
                blocks=("entry_point.mapping",),
            ),
            example(
                "setup_in_function",
                Replace(SETUP, "\nsetup(\n", "\ndef run():\n  setup(\n"),
                fails="build.colcon",
                blocks=("entry_point.mapping",),
            ),
            example(
                "setup_guard_misspelt",
                Replace(SETUP, "\nsetup(\n", "\nif __name__ == 'main':\n  setup(\n"),
                fails="build.colcon",
            ),
            example(
                "setup_guard_misspelt_below_its_function",
                Replace(SETUP, "\nsetup(\n", "\ndef main():\n  setup(\n"),
                Replace(
                    SETUP, "    },\n)\n", "    },\n)\n\n\nif __name__ == 'main':\n    main()\n"
                ),
                fails="build.colcon",
                blocks=("entry_point.mapping",),
            ),
            example(
                "function_around_setup_only_named",
                Replace(SETUP, "\nsetup(\n", "\ndef install():\n  setup(\n"),
                Replace(SETUP, "    },\n)\n", "    },\n)\n\n\ninstall\n"),
                fails="build.colcon",
                blocks=("entry_point.mapping",),
            ),
            example(
                "entry_points_as_a_set",
                Replace(
                    SETUP,
                    "'console_scripts': [\n"
                    "            'test_node = my_robot_controller.my_first_node:main',\n"
                    "        ],",
                    "'console_scripts',\n"
                    "        ('test_node = my_robot_controller.my_first_node:main'),",
                ),
                fails="build.colcon",
                blocks=("entry_point.mapping",),
            ),
            example(
                "entry_points_as_list_in_the_settings",
                Replace(SETUP, "setup(\n", "settings = dict(\n"),
                Replace(SETUP, "entry_points={\n        'console_scripts': [", "entry_points=["),
                Replace(SETUP, "        ],\n    },\n)\n", "    ],\n)\n\nsetup(**settings)\n"),
                fails="build.colcon",
                blocks=("entry_point.mapping",),
            ),
            example(
                "entry_points_as_list",
                Replace(SETUP, "entry_points={\n        'console_scripts': [", "entry_points=["),
                Replace(SETUP, "        ],\n    },\n)", "    ],\n)"),
                fails="build.colcon",
                blocks=("entry_point.mapping",),
            ),
            example(
                "entry_points_as_a_pair",
                Replace(
                    SETUP,
                    "entry_points={\n        'console_scripts': [",
                    "entry_points=('console_scripts', [",
                ),
                Replace(SETUP, "        ],\n    },\n)", "    ]),\n)"),
                fails="build.colcon",
                blocks=("entry_point.mapping",),
            ),
            example(
                "console_scripts_as_dict",
                Replace(SETUP, "'console_scripts': [", "'console_scripts': {"),
                Replace(
                    SETUP,
                    "'test_node = my_robot_controller.my_first_node:main'",
                    "'test_node': 'my_robot_controller.my_first_node:main'",
                ),
                Replace(SETUP, "        ],\n    },\n)", "        },\n    },\n)"),
                fails="build.colcon",
                blocks=("entry_point.mapping",),
            ),
            example(
                "setup_value_refused",
                Replace(SETUP, "zip_safe=True", "python_requires='three'"),
                fails="build.colcon",
            ),
            example(
                "setup_requirement_refused",
                Replace(SETUP, "['setuptools']", "['setuptools', 'rclpy is needed']"),
                fails="build.colcon",
            ),
            example(
                "setup_boolean_in_quotes",
                Replace(SETUP, "zip_safe=True", "zip_safe='yes'"),
                fails="build.colcon",
            ),
            example(
                "setup_never_called",
                Replace(SETUP, "\nsetup(\n", "\ndict(\n"),
                fails="build.colcon",
                blocks=("entry_point.mapping",),
            ),
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
        fixes={
            "node": msg(
                "The code of a node is in setup.py, and the build runs it. Delete it there, or move it to "
                "{path} if that file does not have the node yet. Then build again."
            ),
        },
        examples=(
            example(
                "node_above_setup",
                Replace(
                    SETUP,
                    "\nsetup(\n",
                    "\nimport rclpy\nrclpy.init()\nrclpy.spin(rclpy.create_node('a'))\nsetup(\n",
                ),
                fails="build.colcon",
            ),
            example(
                "setup_loops",
                Replace(SETUP, "\nsetup(\n", "\nwhile True:\n    pass\n\nsetup(\n"),
                fails="build.colcon",
            ),
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
            "folder_of_files": msg(
                "{name} is a folder, and the second value of a line of data_files is a list of files. "
                "A glob such as glob('folder/*') finds folders too. Let this line name only files, "
                "and write a line of its own for the files of {name}. Then build again."
            ),
            "no_copy_close": msg(
                "Write {wanted} instead of {name} in data_files, then build again."
            ),
            **SOURCE_FOLDERS,
            "no_copy": msg(
                "data_files in setup.py lists {name}, and the package has no file of this name; a folder "
                "cannot be listed, only the files in it. Delete it from data_files, or create the file, "
                "then build again."
            ),
            "no_files": msg(
                "Each line of data_files is a folder and a list of files. Write: {wanted}, then "
                "build again."
            ),
            "option": msg(
                "Delete {name} below [{section}] in setup.cfg: setuptools does not know it there. "
                "Then build again."
            ),
            "entry": msg(
                "An entry belongs in the list console_scripts of setup.py. Delete line {line} of "
                "setup.cfg, then build again. It is: {name}"
            ),
            "option_close": msg(
                "Write {wanted} instead of {name} below [{section}] in setup.cfg, then build again."
            ),
        },
        fixed_by=(setup_py.fault, setup_cfg.without_entry),
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
            example(
                "setup_copies_a_folder",
                Write("config/extra/speed.yaml", "speed: 1\n"),
                Replace(
                    SETUP,
                    "('share/' + package_name, ['package.xml']),",
                    "('share/' + package_name, ['package.xml']),\n"
                    "        ('share/' + package_name + '/config', ['config/extra']),",
                ),
                fails="build.colcon",
            ),
            example(
                "setup_file_of_the_inner_folder",
                Write("my_robot_controller/config/params.yaml", "speed: 1\n"),
                Replace(
                    SETUP,
                    "('share/' + package_name, ['package.xml']),",
                    "('share/' + package_name, ['package.xml']),\n"
                    "        ('share/' + package_name + '/config', ['config/params.yaml']),",
                ),
                fails="build.colcon",
            ),
            example(
                "setup_folder_without_files",
                Replace(
                    SETUP,
                    "('share/' + package_name, ['package.xml']),",
                    "('share/' + package_name),",
                ),
                fails="build.colcon",
            ),
            example(
                "setup_manifest_misspelt",
                Replace(SETUP, "['package.xml']", "['packages.xml']"),
                fails="build.colcon",
            ),
            example(
                "setup_source_folder_missing",
                Replace(
                    SETUP,
                    "    packages=find_packages(exclude=['test']),",
                    "    packages=find_packages(where='src'),\n    package_dir={'': 'src'},",
                ),
                fails="build.colcon",
            ),
            example(
                "setup_source_folder_of_packages_missing",
                Replace(
                    SETUP,
                    "    packages=find_packages(exclude=['test']),",
                    "    packages=[package_name],\n    package_dir={package_name: 'src/' + package_name},",
                ),
                fails="build.colcon",
            ),
            example(
                "setup_data_file_of_another_name",
                Write("launch/hello.launch.py", ""),
                Replace(
                    SETUP,
                    "['package.xml']),",
                    "['package.xml']),\n        ('share/' + package_name, ['launch/hello_launch.py']),",
                ),
                fails="build.colcon",
            ),
            example(
                "setup_data_file_missing",
                Replace(SETUP, "['package.xml']", "['package.xml', 'launch/hello.launch.py']"),
                fails="build.colcon",
                note="error: can't copy 'launch/hello.launch.py'",
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
                Replace(
                    SETUP,
                    "\nsetup(\n",
                    (
                        "import os\n"
                        "\n"
                        "from setuptools.command.develop import develop\n"
                        "\n"
                        "\n"
                        "class Develop(develop):\n"
                        "    def run(self):\n"
                        "        super().run()\n"
                        "        if not self.uninstall:\n"
                        "            os.chmod(os.path.join(self.script_dir, 'test_node'), 0o644)\n"
                        "\n"
                        "\n"
                        "setup(\n"
                        "    cmdclass={'develop': Develop},\n"
                    ),
                ),
                fails="entry_point.executable",
            ),
        ),
    ),
    _installed(
        "elsewhere",
        msg("The executable was installed where ros2 run does not look"),
        CONFIG,
        examples=(
            example(
                "script_dir_twice",
                Replace(
                    CFG,
                    "script_dir=$base/lib/my_robot_controller\n[install]",
                    ("script_dir=$base/lib/my_robot_controller\nscript-dir=$base/bin\n[install]"),
                ),
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
                Replace(
                    SETUP,
                    "\nsetup(\n",
                    (
                        "from setuptools.command.develop import develop\n"
                        "\n"
                        "\n"
                        "class Develop(develop):\n"
                        "    def run(self):\n"
                        "        pass\n"
                        "\n"
                        "\n"
                        "setup(\n"
                        "    cmdclass={'develop': Develop},\n"
                    ),
                ),
                fails="entry_point.executable",
            ),
        ),
    ),
)
