"""The catalogue: the entry point in setup.py, part by part."""

from __future__ import annotations

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.kind import Kind

WHY = msg(
    "An entry of console_scripts reads: name = package.module:function. From it colcon makes the "
    "executable that ros2 run starts: <name> is what you type after the package."
)
STOPS = msg(
    "An entry of console_scripts reads: name = package.module:function. From it colcon makes the "
    "executable that ros2 run starts: <name> is what you type after the package. setuptools stops "
    "at an entry that it cannot read; colcon then only says that distutils.core.setup() was never "
    "called."
)
JOINS = msg(
    "Python joins two texts that stand side by side into one. setuptools stops at an entry that it "
    "cannot read; colcon then only says that distutils.core.setup() was never called."
)
DIES = msg(
    "An entry of console_scripts reads: name = package.module:function. From it colcon makes the "
    "executable that ros2 run starts: <name> is what you type after the package. The build does "
    "not look into the module: a wrong part shows only at ros2 run."
)
NOT_FOUND = msg(
    "An entry of console_scripts reads: name = package.module:function. From it colcon makes the "
    "executable that ros2 run starts: <name> is what you type after the package. Without it "
    "ros2 run answers: No executable found."
)
WRITE = msg("Write '{wanted}',")
OTHERS = {"other": msg("Fix this entry, or delete it: '{entry}'")}


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


def _dies(slug: str, title: str, seen: str = "") -> Kind:
    """Return an entry that builds, and ends ros2 run with an exception."""
    return Kind(
        id=f"setup.{slug}",
        stage="entry point",
        title=title,
        why=DIES,
        fix=WRITE,
        link=links.DEVELOPING,
        seen=seen,
    )


def _lost(slug: str, title: str, fix: str = WRITE, **fixes: str) -> Kind:
    """Return an entry that makes no executable of the name."""
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
        fix=msg("Make the package with ros2 pkg create --build-type ament_python: it writes "
                "setup.py. Then add your entry to console_scripts."),
        link=links.PACKAGE,
        seen=r"can't open file '[^'\n]{0,300}setup\.py'",
    ),
    Kind(
        id="setup.missing_comma",
        stage="entry point",
        title=msg("two entries run into one, because there is no comma between them"),
        why=JOINS,
        fix=msg("Put a comma after '{before}'."),
        link=links.ENTRY_POINTS,
    ),
    _stops("colon_for_equals", msg("after the name comes '=', not ':'")),
    _stops("no_equals", msg("there is no '=' between the name and the module")),
    _stops("no_name", msg("there is no name before the '='")),
    _stops("no_target", msg("there is nothing after the '='")),
    _stops("two_equals", msg("there is more than one '=' in it")),
    _stops("slash_in_target", msg("folders are joined with dots")),
    _stops("brackets", msg("the function is only named, not called: no ()")),
    _stops("dash_in_target", msg("a dash cannot be in the name of a Python module")),
    _stops("two_colons", msg("there is more than one ':' in it")),
    _stops("space_in_target", msg("there is a space in the module or function")),
    _stops("bad_entry", msg("it is not of the form name = package.module:function")),
    Kind(
        id="setup.duplicate_entry",
        stage="entry point",
        title=msg("the name is there more than once"),
        why=msg("An entry of console_scripts reads: name = package.module:function. From it colcon "
                "makes the executable that ros2 run starts. One name can stand for one function "
                "only."),
        fix=msg("Keep one line: '{wanted}',"),
        link=links.ENTRY_POINTS,
    ),
    _lost("space_in_name", msg("there is a space in the executable's name")),
    _lost("other_executable", msg("the executable has another name")),
    Kind(
        id="setup.group_misspelt",
        stage="entry point",
        title=msg("the group is not called console_scripts"),
        why=msg("setuptools makes executables from the group console_scripts; a group that it does "
                "not know it takes without a word, and ros2 run says: No executable found."),
        fix=msg("Write 'console_scripts', with the s at its end."),
        link=links.ENTRY_POINTS,
    ),
    _lost("no_entry", msg("there is no entry for the executable"),
          msg("Add to console_scripts the line '{wanted}', and build again."),
          comment=msg("Take away the # in front of '{wanted}', and build again."),
          nothing=msg("Add to setup(): entry_points={{'console_scripts': ['{wanted}']}},")),
    _dies("no_function", msg("the function is left out: a module cannot be called"),
          seen=r"TypeError: 'module' object is not callable"),
    _dies("dot_for_colon", msg("between module and function comes ':', not '.'"),
          seen=r"No module named '(?P<module>[\w.]{1,200}\.main)'; '[\w.]{1,200}' is not a package"),
    _dies("py_in_target", msg("a module is named without its file's ending .py"),
          seen=r"No module named '(?P<module>[\w.]{1,200}\.py)'"),
    _dies("no_package_prefix", msg("the package's name and a dot are missing")),
    _dies("other_function", msg("the function has another name")),
    _dies("other_package", msg("the package has another name")),
    _dies("other_module", msg("it leads to another module")),
    _dies("misspelt_module", msg("there is no module of that name"),
          seen=r"No module named '(?P<module>\w{1,120}\.[\w.]{1,200})'"),
    Kind(
        id="setup.not_packaged",
        stage="entry point",
        title=msg("setup.py does not install the Python package"),
        why=msg("Only what packages= names is installed; the entry point then leads to a module "
                "that is not there."),
        fix=msg("Write in setup(): packages=find_packages(exclude=['test']), and build again."),
        link=links.DEVELOPING,
    ),
    Kind(
        id="entry_point.computed_mapping",
        stage="entry point",
        title=msg("setup.py computes another entry than the one that was asked for"),
        why=msg("The entry tells ros2 run which function of which module to start."),
        fix=msg("Write the entry into setup.py's entry_points, under console_scripts: '{wanted}',"),
        link=links.DEVELOPING,
    ),
)  # fmt: skip
