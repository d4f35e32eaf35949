"""The catalogue: the entry point in setup.py, part by part.

The titles of invalid entries follow the quoted entry and a colon, so they begin in lower case.
"""

from __future__ import annotations

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.kind import Kind

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
WRITE = msg("Write '{wanted}',")
OTHERS = {"other": msg("Fix or delete this entry: '{entry}'")}


def _stops(slug: str, title: str, seen: str = "") -> Kind:
    """Return an entry that setuptools cannot read."""
    return Kind(
        id=f"setup.{slug}",
        stage="entry point",
        title=title,
        why=STOPS,
        fix=WRITE,
        fixes=OTHERS,
        link=links.ENTRY_POINTS,
        seen=seen,
    )


def _raises(slug: str, title: str, seen: str = "") -> Kind:
    """Return an entry that builds, but ends ros2 run with an exception."""
    return Kind(
        id=f"setup.{slug}",
        stage="entry point",
        title=title,
        why=RAISES,
        fix=WRITE,
        link=links.DEVELOPING,
        seen=seen,
    )


def _not_found(slug: str, title: str, fix: str = WRITE, **fixes: str) -> Kind:
    """Return an entry from which no executable with the required name is made."""
    return Kind(
        id=f"setup.{slug}",
        stage="entry point",
        title=title,
        why=NOT_FOUND,
        fix=fix,
        fixes=fixes,
        link=links.DEVELOPING,
    )


KINDS = (
    Kind(
        id="setup.missing",
        stage="entry point",
        title=msg("There is no setup.py that can be read"),
        why=WHY,
        fix=msg("Create the package with ros2 pkg create --build-type ament_python: it writes "
                "setup.py. Then add your entry to console_scripts."),
        link=links.PACKAGE,
        seen=r"can't open file '[^'\n]{0,300}setup\.py'",
    ),
    Kind(
        id="setup.missing_comma",
        stage="entry point",
        title=msg("two entries become one, because the comma between them is missing"),
        why=JOINS,
        fix=msg("Add a comma after '{before}'."),
        link=links.ENTRY_POINTS,
    ),
    _stops("colon_for_equals", msg("after the name comes '=', not ':'")),
    _stops("no_equals", msg("the '=' between the name and the module is missing")),
    _stops("no_name", msg("the name before the '=' is missing")),
    _stops("no_target", msg("there is nothing after the '='")),
    _stops("two_equals", msg("there is more than one '='")),
    _stops("slash_in_target", msg("folders are separated by dots, not slashes")),
    _stops("brackets", msg("the function is named, not called: no ()")),
    _stops("dash_in_target", msg("a Python module's name cannot contain a dash")),
    _stops("two_colons", msg("there is more than one ':'")),
    _stops("space_in_target", msg("there is a space in the module or function")),
    _stops("bad_entry", msg("it does not have the form name = package.module:function")),
    Kind(
        id="setup.duplicate_entry",
        stage="entry point",
        title=msg("the name is used more than once"),
        why=msg("An entry of console_scripts has the form name = package.module:function. The "
                "build turns it into the executable that ros2 run starts. A name can refer to one "
                "function only."),
        fix=msg("Keep only one line: '{wanted}',"),
        link=links.ENTRY_POINTS,
    ),
    _not_found("space_in_name", msg("there is a space in the executable's name")),
    _not_found("other_executable", msg("the executable has a different name")),
    Kind(
        id="setup.group_misspelt",
        stage="entry point",
        title=msg("the group is not called console_scripts"),
        why=msg("setuptools makes executables only from the group console_scripts. It accepts any "
                "other group without a message, and ros2 run answers: No executable found."),
        fix=msg("Write 'console_scripts', with an s at the end."),
        link=links.ENTRY_POINTS,
    ),
    _not_found("no_entry", msg("there is no entry for the executable"),
               msg("Add this line to console_scripts, then build again: '{wanted}',"),
               comment=msg("Remove the # before '{wanted}', then build again."),
               nothing=msg("Add to setup(): entry_points={{'console_scripts': ['{wanted}']}},")),
    _raises("no_function", msg("the function is missing: a module cannot be called"),
            seen=r"TypeError: 'module' object is not callable"),
    _raises("dot_for_colon", msg("between module and function comes ':', not '.'"),
            seen=r"No module named '(?P<module>[\w.]{1,200}\.main)'; '[\w.]{1,200}' is not a package"),
    _raises("py_in_target", msg("a module's name does not include .py"),
            seen=r"No module named '(?P<module>[\w.]{1,200}\.py)'"),
    _raises("no_package_prefix", msg("the package's name and a dot are missing")),
    _raises("other_function", msg("the function has a different name")),
    _raises("other_package", msg("the package has a different name")),
    _raises("other_module", msg("it leads to a different module")),
    _raises("misspelt_module", msg("there is no module with that name"),
            seen=r"No module named '(?P<module>\w{1,120}\.[\w.]{1,200})'"),
    Kind(
        id="setup.not_packaged",
        stage="entry point",
        title=msg("setup.py does not install the Python package"),
        why=msg("Only the packages in packages= are installed. If yours is not one of them, the "
                "entry point leads to a module that does not exist."),
        fix=msg("Write packages=find_packages(exclude=['test']), in setup(), then build again."),
        link=links.DEVELOPING,
    ),
    Kind(
        id="entry_point.computed_mapping",
        stage="entry point",
        title=msg("setup.py computes a different entry than the required one"),
        why=msg("The entry tells ros2 run which function of which module to start."),
        fix=msg("Write the entry into setup.py's entry_points, under console_scripts: '{wanted}',"),
        link=links.DEVELOPING,
    ),
)  # fmt: skip
