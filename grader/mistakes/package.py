"""The catalogue: package.xml, the marker in resource/, and setup.cfg."""

from __future__ import annotations

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.handed_in import UNIT
from grader.mistakes.kind import Kind

DEGRADES = msg(
    "colcon reads package.xml to learn the package's name and how to build it. From one that it "
    "cannot use it falls back to plain Python: the build says that it finished, and ros2 run says "
    "Package not found."
)
MARKER = msg(
    "ROS finds a package by an empty file of its name in the package index. setup.py copies it "
    "there from resource/ when you build."
)
MARKER_MISSING = msg(
    "ROS finds a package by an empty file of its name in the package index. setup.py copies it "
    "there from resource/ when you build. If it is missing, the build stops with: can't copy "
    "'resource/{package}': doesn't exist or not a regular file."
)
CFG = msg(
    "setup.cfg says where executables are installed. ros2 run looks only in lib/<package>, so "
    "without these two lines they land in bin and it answers: No executable found."
)
CFG_TWO = msg(
    "setup.cfg says where executables are installed. ros2 run looks only in lib/<package>, so "
    "without these two lines they land in bin and it answers: No executable found. [develop] is "
    "for colcon build --symlink-install, [install] for a build without it."
)
NEW_CFG = msg(
    "Make setup.cfg beside setup.py with these four lines: [develop] / "
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
        fix=msg("Copy package.xml from a package that ros2 pkg create makes, and set its <name>."),
        fixes={"renamed": msg("Rename {close} to package.xml.")},
        link=links.MANIFEST,
    ),
    _manifest("manifest_unreadable", msg("package.xml cannot be read"),
              msg("Hand in a package.xml that can be read.")),
    _manifest("broken_xml", msg("package.xml is not well-formed XML"),
              msg("Look at that line and the one above: each <tag> needs its </tag>, and & is "
                  "&amp;."),
              empty=msg("Write it anew: save it in the editor, or copy one that ros2 pkg create "
                        "makes.")),
    _manifest("manifest_doctype", msg("package.xml has a <!DOCTYPE …>"),
              msg("Delete the <!DOCTYPE …> line: no package.xml needs one.")),
    _manifest("manifest_tag", msg("A tag that package.xml must have is missing or empty"),
              msg("Add <{tag}>…</{tag}> inside <package>."),
              empty=msg("Write something between <{tag}> and </{tag}>.")),
    _manifest("manifest_rules", msg("package.xml breaks a rule of its format"),
              msg("Change what is named, so that colcon accepts the file.")),
    Kind(
        id="package.name_mismatch",
        stage="manifest",
        title=msg("The package's names are not equal"),
        why=msg("colcon and ros2 run know the package by the name in package.xml. The names in "
                "package.xml, setup.py, setup.cfg and resource/ must be equal."),
        whys={"setup": msg("Python installs the package under setup.py's name and ROS looks for "
                           "that of package.xml: the two must be equal.")},
        fix=msg("Write <name>{package}</name>."),
        fixes={"setup": msg("Give name (or package_name) in setup.py the value '{package}'.")},
        link=links.PACKAGE,
    ),
    Kind(
        id="package.build_type",
        stage="manifest",
        title=msg("package.xml does not say that the package is built as ament_python"),
        why=msg("The build type tells colcon how to build: without ament_python it takes the "
                "package for a C++ one and looks for a CMakeLists.txt."),
        fix=msg("Write in package.xml: <export><build_type>ament_python</build_type></export>"),
        fixes={"cmake": msg("Delete the package and make it again with: ros2 pkg create "
                            "--build-type ament_python, or (if only this line is wrong) write "
                            "ament_python.")},
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
        whys={"other": msg("ROS finds a package by an empty file of its name in the package index. "
                           "The marker's name is the name under which ROS knows the package.")},
        fix=msg("Make the empty file: in the package's folder, run  mkdir -p resource && touch "
                "resource/{package}"),
        fixes={
            "folder": msg("Delete that folder and make an empty file of the same name: touch "
                          "resource/{package}"),
            "rename": msg("Rename resource/{close} to resource/{package}: the two names must be "
                          "equal."),
            "other": msg("Let that line install 'resource/{package}': give package_name in "
                         "setup.py the value '{package}'."),
        },
        link=links.DEVELOPING,
        seen=r"can't copy '[^'\n]{0,300}resource/(?P<package>[^'/\n]{1,120})': doesn't exist",
    ),
    Kind(
        id="package.marker_not_installed",
        stage="marker",
        title=msg("setup.py does not install the package's marker"),
        why=msg("ROS finds a package by an empty file of its name in the package index. setup.py "
                "copies it there from resource/ when you build. colcon still adds a missing one "
                "itself, with a warning that it will stop doing so."),
        whys={"other": msg("ROS finds a package by an empty file of its name in the package index. "
                           "The marker's name is the name under which ROS knows the package.")},
        fix=msg("Add to data_files: ('share/ament_index/resource_index/packages', ['resource/' + "
                "package_name]),"),
        fixes={"other": msg("Let that line install 'resource/{package}': give package_name in "
                            "setup.py the value '{package}'.")},
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
        title=msg("setup.cfg cannot be understood"),
        why=msg("setuptools reads this file on every build and stops where it cannot."),
        fix=msg("Fix that line: a line is either [section] or key=value."),
        link=links.SETUP_CFG,
        seen=r"configparser\.\w{1,60}Error|File contains no section headers",
    ),
    Kind(
        id="package.setup_cfg_wrong",
        stage="setup.cfg",
        title=msg("setup.cfg puts executables where ros2 run does not look"),
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
