"""The catalogue: package.xml, the marker in resource/, and setup.cfg."""

from __future__ import annotations

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.kind import Kind
from grader.mistakes.submission import UNIT

DEGRADES = msg(
    "colcon reads the package's name and build type from package.xml. If it cannot use the file, "
    "it falls back to plain Python: the build reports success, but ros2 run answers: Package not "
    "found."
)
MARKER_MISSING = msg(
    "ROS finds a package by an empty file with the package's name in the package index. setup.py "
    "copies it there from resource/ when you build. If it is missing, the build stops with: can't "
    "copy 'resource/{package}': doesn't exist or not a regular file."
)
CFG = msg(
    "setup.cfg sets where executables are installed. ros2 run looks only in lib/<package>. Without "
    "these settings they are installed in bin, and ros2 run answers: No executable found."
)
CFG_TWO = msg(
    "setup.cfg sets where executables are installed. ros2 run looks only in lib/<package>. Without "
    "these settings they are installed in bin, and ros2 run answers: No executable found. "
    "[develop] is for colcon build --symlink-install, [install] for a build without it."
)
NEW_CFG = msg(
    "Create setup.cfg beside setup.py with these four lines: [develop] / "
    "script_dir=$base/lib/{package} / [install] / install_scripts=$base/lib/{package}"
)


def _manifest(slug: str, title: str, fix: str, why: str = DEGRADES, **fixes: str) -> Kind:
    return Kind(
        id=f"package.{slug}",
        stage="manifest",
        title=title,
        why=why,
        fix=fix,
        fixes=fixes,
        link=links.MANIFEST,
    )


MANIFEST = (
    Kind(
        id="package.no_manifest",
        stage="manifest",
        title=msg("There is no package.xml"),
        why=DEGRADES,
        whys={"nothing": UNIT},
        fix=msg("Copy the package.xml that ros2 pkg create makes, and set its <name>."),
        fixes={"renamed": msg("Rename {close} to package.xml.")},
        link=links.MANIFEST,
    ),
    _manifest("manifest_unreadable", msg("package.xml cannot be read"),
              msg("Hand in a package.xml that can be read.")),
    _manifest("broken_xml", msg("package.xml is not well-formed XML"),
              msg("Look at that line and the line above it: each <tag> needs its </tag>, and & is "
                  "written &amp;."),
              empty=msg("Write the file again: save it in the editor, or copy the one that ros2 "
                        "pkg create makes.")),
    _manifest("manifest_doctype", msg("package.xml has a <!DOCTYPE …>"),
              msg("Delete the <!DOCTYPE …> line: no package.xml needs one.")),
    _manifest("manifest_tag", msg("A required tag of package.xml is missing or empty"),
              msg("Add <{tag}>…</{tag}> inside <package>."),
              empty=msg("Write something between <{tag}> and </{tag}>.")),
    _manifest("manifest_rules", msg("package.xml breaks a rule of its format"),
              msg("Correct what the message names, so that colcon accepts the file.")),
    Kind(
        id="package.name_mismatch",
        stage="manifest",
        title=msg("The package's names differ"),
        why=msg("colcon and ros2 run use the name in package.xml. The names in package.xml, "
                "setup.py, setup.cfg and resource/ must be the same."),
        whys={"setup": msg("Python installs the package under the name in setup.py, and ROS looks "
                           "for the name in package.xml: the two must be the same.")},
        fix=msg("Write <name>{package}</name> in package.xml."),
        fixes={
            "setup": msg("Set name (or package_name) in setup.py to '{package}'."),
            "throughout": msg("Use the name {package} in package.xml, setup.py, setup.cfg and for "
                              "the file in resource/. Your package was marked under its own name."),
        },
        link=links.PACKAGE,
    ),
    Kind(
        id="package.build_type",
        stage="manifest",
        title=msg("package.xml does not set the build type ament_python"),
        why=msg("The build type tells colcon how to build. Without ament_python, colcon takes the "
                "package for a C++ one and looks for a CMakeLists.txt."),
        fix=msg("Write in package.xml: <export><build_type>ament_python</build_type></export>"),
        fixes={"cmake": msg("If only this line is wrong, write ament_python. Otherwise create a "
                            "new package with ros2 pkg create --build-type ament_python and copy "
                            "your code into it.")},
        link=links.PACKAGE,
        seen=r"does not appear to contain CMakeLists\.txt",
    ),
)  # fmt: skip
PLACES = (
    Kind(
        id="package.marker_missing",
        stage="marker",
        title=msg("The marker file in resource/ is missing"),
        why=MARKER_MISSING,
        whys={"other": msg("ROS finds a package by an empty file with the package's name in the "
                           "package index. The marker's name is the name that ROS uses for the "
                           "package.")},
        fix=msg("Create the empty file. In the package's folder, run: mkdir -p resource && touch "
                "resource/{package}"),
        fixes={
            "folder": msg("Delete that folder and create an empty file with the same name: touch "
                          "resource/{package}"),
            "rename": msg("Rename resource/{close} to resource/{package}: the two names must be "
                          "the same."),
            "other": msg("Make that line install 'resource/{package}': set package_name in "
                         "setup.py to '{package}'."),
        },
        link=links.DEVELOPING,
        seen=r"can't copy '[^'\n]{0,300}resource/(?P<package>[^'/\n]{1,120})': doesn't exist",
    ),
    Kind(
        id="package.marker_not_installed",
        stage="marker",
        title=msg("setup.py does not install the package's marker"),
        why=msg("ROS finds a package by an empty file with the package's name in the package "
                "index. setup.py copies it there from resource/ when you build. colcon still adds "
                "a missing one itself, but warns that it will stop doing so."),
        whys={"other": msg("ROS finds a package by an empty file with the package's name in the "
                           "package index. The marker's name is the name that ROS uses for the "
                           "package.")},
        fix=msg("Add to data_files: ('share/ament_index/resource_index/packages', ['resource/' + "
                "package_name]),"),
        fixes={"other": msg("Make that line install 'resource/{package}': set package_name in "
                            "setup.py to '{package}'.")},
        link=links.DEVELOPING,
        seen=r"doesn't explicitly install a marker in the package index",
    ),
    Kind(
        id="package.setup_cfg_missing",
        stage="setup.cfg",
        title=msg("There is no setup.cfg"),
        why=CFG,
        fix=NEW_CFG,
        link=links.DEVELOPING,
    ),
    Kind(
        id="package.setup_cfg_syntax",
        stage="setup.cfg",
        title=msg("setup.cfg cannot be parsed"),
        why=msg("setuptools reads this file in every build and stops at a line that it cannot "
                "read."),
        fix=msg("Fix that line: a line is either [section] or key=value."),
        link=links.SETUP_CFG,
        seen=r"configparser\.\w{1,60}Error|File contains no section headers",
    ),
    Kind(
        id="package.setup_cfg_wrong",
        stage="setup.cfg",
        title=msg("setup.cfg installs executables where ros2 run does not look"),
        why=CFG_TWO,
        fix=msg("Write {key}={wanted}"),
        fixes={
            "key": msg("Write below [{section}]: {key}={wanted}"),
            "section": msg("Add two lines: [{section}] and below it {key}={wanted}"),
        },
        link=links.DEVELOPING,
    ),
)  # fmt: skip
KINDS = (*MANIFEST, *PLACES)
