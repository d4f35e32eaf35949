"""The catalogue: files of parameters, and what a node does not take from them."""

from __future__ import annotations

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.kind import Family

_setup = Family("setup", links.PARAMETERS)
_file = Family("parameter", links.PARAMETERS)
KINDS = (
    _setup(
        "file_not_installed",
        "build",
        msg("A file of parameters is not installed"),
        msg(
            "Launch files, and this run, take the file from the package's share folder. The build "
            "copies only the files that data_files in setup.py names, into the folder that stands "
            "before them."
        ),
        msg("Add this line to data_files in setup.py, then build again: ('{folder}', ['{path}']),"),
        whys={
            "cmake": msg(
                "Launch files, and this run, take the file from the package's share folder. The "
                "build copies only what an install() in CMakeLists.txt names."
            )
        },
        fixes={
            "moved": msg(
                "In data_files of setup.py, write this line for the file, then build again: "
                "('{folder}', ['{path}']),"
            ),
            "cmake": msg(
                "Write this line above ament_package() in CMakeLists.txt, then build again: "
                "install({source} DESTINATION share/${{PROJECT_NAME}})"
            ),
        },
    ),
    _file(
        "file_other_node",
        "parameter",
        msg("The file of parameters is for a node with another name"),
        msg(
            "A node takes from the file only what stands below its own full name, or below /**. "
            "Everything else is left out, without an error."
        ),
        msg("Write {node}: in place of {name}: in this line."),
    ),
    _file(
        "file_other_type",
        "parameter",
        msg("A value in the file of parameters has another type"),
        msg(
            "The node declares '{name}' with the type {wanted}; the file gives it a value of the type "
            "{type}. A node that declares a type refuses any other: in YAML, 2 is an integer and 2.0 "
            "a double."
        ),
        msg("Write a value of the type {wanted} for '{name}' in this line."),
        fixes={"double": msg("Write {value}.0 in place of {value} in this line.")},
    ),
    _file(
        "file_unknown",
        "parameter",
        msg("The file of parameters names a parameter that the node does not declare"),
        msg(
            "A value from a file counts only for a parameter that the node declares, by exactly that "
            "name. Any other is left out, without an error."
        ),
        msg("Give the parameter the same name in this line and in declare_parameter."),
        close=msg("Write {close}: in place of {name}: in this line."),
    ),
    _file(
        "file_refused",
        "parameter",
        msg("ROS cannot read the file of parameters"),
        msg(
            "The file has the node's name, below it ros__parameters, and below that the values, each "
            "level two spaces further to the right."
        ),
        msg("Correct this line of the file. The error above says what ROS expects there."),
    ),
)
