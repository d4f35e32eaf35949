"""The catalogue: package.xml."""

from __future__ import annotations

from typing import TYPE_CHECKING

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.example import (
    CFG,
    INNER,
    MANIFEST,
    MARKER,
    SETUP,
    UNBUILT,
    UNSTARTED,
    Example,
    example,
)
from grader.mistakes.fixes import layout, manifest, setup_py
from grader.mistakes.kind import Kind, Variants
from grader.mistakes.submission import UNIT
from grader.package.edit.tree import Delete, Edit, Move, Replace, Write

if TYPE_CHECKING:
    from typing_extensions import Unpack

DEGRADES = msg(
    "colcon reads the package's name and build type from package.xml. If it cannot use the file, "
    "it falls back to plain Python: the build reports success, but ros2 run answers: Package not "
    "found."
)
NO_MANIFEST = msg(
    "colcon reads the package's name and build type from package.xml. Without the file it takes "
    "the folder for plain Python, and the build stops where setup.py copies package.xml."
)
BUILD_TYPE = msg(
    "The build type tells colcon how to build. Only with ament_python, once and directly in <export>, "
    "does colcon build a Python package of ROS. Otherwise it looks for a CMakeLists.txt, builds nothing, "
    "or takes the package for plain Python, and then ros2 run does not find it."
)


def _renamed(name: str) -> tuple[Edit, ...]:
    """Return the edits that give the package another name, but for its folder and the entry point."""
    path = f"$base/lib/{name}"
    return (
        Replace(MANIFEST, "<name>my_robot_controller</name>", f"<name>{name}</name>"),
        Replace(SETUP, "package_name = 'my_robot_controller'", f"package_name = '{name}'"),
        Write(CFG, f"[develop]\nscript_dir={path}\n[install]\ninstall_scripts={path}\n"),
        Move(MARKER, f"resource/{name}"),
    )


def _example(name: str, *edits: Edit) -> Example:
    return example(name, *edits, fails="package.manifest", blocks=UNBUILT)


def _line(name: str, old: str, new: str) -> Example:
    return _example(name, Replace(MANIFEST, old, new))


def _manifest(
    slug: str, title: str, fix: str, why: str = DEGRADES, **parts: Unpack[Variants]
) -> Kind:
    return Kind(
        id=f"package.{slug}",
        stage="manifest",
        title=title,
        why=why,
        fix=fix,
        link=links.MANIFEST,
        **parts,
    )


RENAME_TAG = msg("Write <{tag}> instead of <{close}>, and the same in its end tag.")
KINDS = (
    _manifest(
        "no_manifest",
        msg("There is no package.xml"),
        msg(
            "In a new folder, run ros2 pkg create --build-type ament_python --dependencies rclpy "
            "{package}, and copy its package.xml here."
        ),
        NO_MANIFEST,
        whys={"nothing": UNIT},
        fixes={
            "renamed": msg(
                "Give it its name and its place; capitals and small letters differ. In the package's "
                "folder, run: mv {there} package.xml"
            ),
        },
        fixed_by=(layout.out_of_inner_folder, manifest.rename),
        examples=(
            example(
                "only_a_text",
                Delete(INNER),
                Delete("resource"),
                Delete(MANIFEST),
                Delete(SETUP),
                Delete(CFG),
                Write("submission.txt", "see my repository\n"),
                fails="package.found",
            ),
            _example("no_manifest", Delete(MANIFEST)),
        ),
    ),
    _manifest(
        "manifest_unreadable",
        msg("package.xml cannot be read"),
        msg("Hand in a package.xml that can be read."),
        fixes={
            "encoding": msg(
                "Save the file again with the encoding UTF-8, then build again. ROS reads it in no "
                "other encoding. (Windows PowerShell writes UTF-16 with >.)"
            )
        },
    ),
    _manifest(
        "broken_xml",
        msg("package.xml is not well-formed XML"),
        msg(
            "Look at that line and the lines above it, and compare them with a package.xml that ros2 "
            'pkg create makes. Each <tag> needs its </tag>; values are in quotes, as in format="3"; & is written &amp; and < is '
            "written &lt;; a comment is between <!-- and -->; nothing is above <?xml …?> or below "
            "</package>. Save the file with the encoding UTF-8."
        ),
        fixes={
            "unclosed": msg("Write </{tag}> at the end of what <{tag}> contains."),
            "unopened": msg(
                "Write <{name}> before the text that <{tag}> closes, or delete <{tag}>."
            ),
            "misspelt": msg("Write <{wanted}> there."),
        },
        fixed_by=(manifest.well_formed,),
        examples=(
            _line("license_not_closed", "</license>", ""),
            _line("end_tag_twice", "  </export>\n", "  </export>\n  </export>\n"),
            _line("format_without_quotes", 'format="3"', "format=3"),
            _line("comment_without_end", "  <depend>", "  <!-- TODO: licence\n  <depend>"),
            _line("manifest_not_xml", "</description>", "</decription>"),
            _example("manifest_empty", Write(MANIFEST, "")),
        ),
    ),
    _manifest(
        "manifest_doctype",
        msg("package.xml has a <!DOCTYPE …>"),
        msg("Delete the <!DOCTYPE …> line: no package.xml needs one."),
    ),
    _manifest(
        "manifest_tag",
        msg("A required tag of package.xml is missing or empty"),
        msg(
            "Write directly in <package>, and not in a comment: {wanted}. Between the two tags is a text, "
            "without other tags."
        ),
        fixes={"renamed": RENAME_TAG},
        fixed_by=(manifest.tag_name, manifest.version, manifest.name),
        examples=(
            _example(
                "license_in_a_comment",
                Replace(MANIFEST, "<license>", "<!-- <license>"),
                Replace(MANIFEST, "</license>", "</license> -->"),
            ),
            _example(
                "license_misspelt",
                Replace(MANIFEST, "<license>", "<licence>"),
                Replace(MANIFEST, "</license>", "</licence>"),
            ),
        ),
    ),
    _manifest(
        "manifest_rules",
        msg("package.xml breaks a rule of its format"),
        msg(
            "Correct what the message names, so that colcon accepts the file: compare the line with a "
            'package.xml that ros2 pkg create makes. It begins with <package format="3">; of two tags that '
            "say the same, one is enough; what ROS 1 calls <run_depend> is <exec_depend>."
        ),
        examples=(
            _line(
                "description_twice",
                "  <description>",
                "  <description>Says hello</description>\n  <description>",
            ),
            _line("maintainer_email_at", "@todo.todo", "(at)todo.todo"),
            _line("format_missing", ' format="3"', ""),
            _line(
                "run_depend_of_ros_1",
                "<depend>rclpy</depend>",
                "<run_depend>rclpy</run_depend>",
            ),
        ),
    ),
    _manifest(
        "depend_missing",
        msg("package.xml does not name a package that your code imports"),
        msg("Add {lines} to package.xml, below the other dependencies."),
        msg(
            "package.xml tells colcon which packages must be built before yours, and tells rosdep "
            "what to install on another machine. Without that line your package runs only where "
            "the other one happens to be."
        ),
        fixes={
            "misspelt": msg("Write <depend>{needed}</depend> instead of '{found}'."),
            "other_tag": msg(
                "Add <exec_depend>{needed}</exec_depend> too: the tag that names it is not for "
                "running."
            ),
        },
        fixed_by=(manifest.depend_name, manifest.depend),
    ),
    _manifest(
        "name_mismatch",
        msg("The package's names differ"),
        msg("Write <name>{package}</name> in package.xml, then build again."),
        msg(
            "colcon and ros2 run use the name in package.xml. The names in package.xml, "
            "setup.py, setup.cfg and resource/ must be the same."
        ),
        fixes={
            "setup": msg(
                "Give setup() the name '{package}', then build again. If the name comes from a "
                "variable, correct the value of the variable."
            ),
            "throughout": msg(
                "Use the name {package} in package.xml, setup.py and setup.cfg, for the file in resource/ "
                "and for the inner folder. Your package was marked under its own name."
            ),
        },
        fixed_by=(manifest.name, setup_py.name),
        examples=(
            example(
                "manifest_other_name",
                Replace(
                    MANIFEST, "<name>my_robot_controller</name>", "<name>my_robot_controler</name>"
                ),
                fails="package.manifest",
                note="runs anyway: marker, setup.cfg and setup.py have the right name",
            ),
            _example(
                "setup_variable_other_name",
                Replace(
                    SETUP,
                    "package_name = 'my_robot_controller'",
                    "package_name = 'robot_controller'",
                ),
            ),
            example(
                "other_name_throughout",
                *_renamed("my_controller"),
                Replace(SETUP, "test_node = my_robot_controller.", "test_node = my_controller."),
                Move(INNER, "my_controller"),
                fails="package.manifest",
                note="builds and runs under its own name",
            ),
            example(
                "name_misspelt_but_the_entry",
                *_renamed("my_robot_conroller"),
                Move(INNER, "my_robot_conroller"),
                fails="package.manifest",
                also={"entry_point.mapping": "setup.other_package"},
                blocks=UNSTARTED,
            ),
        ),
    ),
    _manifest(
        "build_type",
        msg("package.xml does not set the build type ament_python"),
        msg(
            "Let package.xml have this once, above </package> and not in a comment: "
            "<export><build_type>ament_python</build_type></export>. Delete any other <build_type>. Then "
            "build again."
        ),
        BUILD_TYPE,
        fixes={
            "renamed": RENAME_TAG,
            "cmake": msg(
                "If only this line is wrong, write ament_python. Otherwise create a "
                "new package with ros2 pkg create --build-type ament_python and copy "
                "your code into it."
            ),
        },
        seen=r"does not appear to contain CMakeLists\.txt",
        fixed_by=(manifest.tag_name, manifest.build_type),
        examples=(
            _line("build_type_missing", "    <build_type>ament_python</build_type>\n", ""),
            _example(
                "build_type_outside",
                Replace(MANIFEST, "  <export>\n    <build_type>", "  <build_type>"),
                Replace(MANIFEST, "  </export>\n", ""),
            ),
            _line("build_type_cmake", "ament_python", "ament_cmake"),
            _line("build_type_misspelt", "ament_python", "ament_pyton"),
        ),
    ),
)
