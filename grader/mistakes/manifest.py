"""The catalogue: package.xml."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.example import CFG, INNER, MANIFEST, MARKER, SETUP, UNBUILT, UNSTARTED, example
from grader.mistakes.fixes import layout, manifest, setup_py
from grader.mistakes.kind import Kind, Parts
from grader.mistakes.submission import UNIT
from grader.package.edit.tree import Delete, Move, Replace, Write

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

MISSPELT = (
    Replace(MANIFEST, "<name>my_robot_controller</name>", "<name>my_robot_conroller</name>"),
    Replace(
        SETUP,
        "package_name = 'my_robot_controller'",
        "package_name = 'my_robot_conroller'",
    ),
    Write(
        CFG,
        (
            "[develop]\n"
            "script_dir=$base/lib/my_robot_conroller\n"
            "[install]\n"
            "install_scripts=$base/lib/my_robot_conroller\n"
        ),
    ),
    Move(MARKER, "resource/my_robot_conroller"),
)
"""Edits that misspell the package's name everywhere, except for its folder and the entry point."""


def _manifest(
    slug: str,
    title: str,
    fix: str,
    why: str = DEGRADES,
    fixes: Mapping[str, str] | None = None,
    whys: Mapping[str, str] | None = None,
    **parts: Unpack[Parts],
) -> Kind:
    return Kind(
        id=f"package.{slug}",
        stage="manifest",
        title=title,
        why=why,
        fix=fix,
        fixes=fixes or {},
        whys=whys or {},
        link=links.MANIFEST,
        **parts,
    )


KINDS = (
    Kind(
        id="package.no_manifest",
        stage="manifest",
        title=msg("There is no package.xml"),
        why=NO_MANIFEST,
        whys={"nothing": UNIT},
        fix=msg(
            "In a new folder, run ros2 pkg create --build-type ament_python --dependencies rclpy "
            "{package}, and copy its package.xml here."
        ),
        fixes={
            "inner": msg(
                "Move it out of the inner folder. In the package's folder, run: mv {there} ."
            ),
            "renamed": msg("Rename it. In the package's folder, run: mv {close} package.xml"),
            "capitals": msg(
                "Rename it: Linux distinguishes capitals from small letters. In the package's "
                "folder, run: mv {close} package.xml"
            ),
        },
        link=links.MANIFEST,
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
            example(
                "manifest_and_setup_missing", Delete(MANIFEST), Delete(SETUP), fails="package.found"
            ),
            example(
                "no_manifest",
                Delete(MANIFEST),
                fails="package.manifest",
                blocks=UNBUILT,
                note="colcon takes the folder for plain Python",
            ),
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
        examples=(
            example(
                "manifest_in_utf_16",
                Write(
                    MANIFEST,
                    (
                        '<?xml version="1.0"?>\n<package format="3">\n'
                        "  <name>my_robot_controller</name>\n  <version>0.0.0</version>\n"
                        "  <description>Counts</description>\n"
                        '  <maintainer email="a@example.com">A</maintainer>\n'
                        "  <license>MIT</license>\n  <depend>rclpy</depend>\n"
                        "  <export>\n    <build_type>ament_python</build_type>\n  </export>\n"
                        "</package>\n"
                    ).encode("utf-16"),
                ),
                fails="package.manifest",
                blocks=UNBUILT,
            ),
        ),
    ),
    _manifest(
        "broken_xml",
        msg("package.xml is not well-formed XML"),
        msg(
            "Look at that line and the line above it, and compare them with a package.xml that ros2 "
            "pkg create makes: each <tag> needs its </tag>, and & is written &amp;. If you cannot read "
            "the file in an editor, save it anew as plain text, with the encoding UTF-8."
        ),
        whys={
            "encoding_declared": msg(
                "An XML file has to be in the encoding that it declares. colcon reads this one all the "
                "same, but other programs stop at it."
            )
        },
        fixes={
            "entity": msg(
                "XML knows only &amp; &lt; &gt; &quot; and &apos;. Write the character itself instead "
                "of any other & with a name and ; behind it."
            ),
            "attribute_twice": msg(
                "A tag has each attribute only once. Delete the second one of the same name in that "
                "tag."
            ),
            "empty": msg(
                "Write the file again: save it in the editor, or copy the one that ros2 "
                "pkg create makes."
            ),
            "unclosed": msg("Write </{tag}> at the end of what <{tag}> contains."),
            "again": msg("Write </{tag}> instead of the second <{tag}>."),
            "closed_twice": msg("Delete the second <{tag}>: one end tag closes one tag."),
            "unopened": msg("Write <{name}> before the text that <{tag}> closes."),
            "misspelt": msg("Write <{wanted}> there."),
            "unfinished": msg("Write > at the end of <{tag}"),
            "quotes": msg('Type the quotes of that tag again: " on the keyboard.'),
            "ampersand": msg("Write &amp; instead of &."),
            "before": msg("Delete what is before the first < of the file."),
            "declaration": msg(
                "<?xml …?> must be the very first line of the file. Move it from line {wanted} to "
                "the top."
            ),
            "blank": msg(
                "<?xml …?> must be at the very beginning of the file. Delete the empty lines and "
                "the spaces above and before it."
            ),
            "declared_twice": msg("Delete this line: <?xml …?> is only at the top of the file."),
            "after": msg("Delete what is after the last > of the file."),
            "package_twice": msg(
                "Delete everything below the first </package>, from this line to the end of the file."
            ),
            "typed": msg("A sign of a tag in this line is missing or wrong. Write: {wanted}"),
            "typed_lines": msg(
                "A sign of a tag is missing or wrong in this line, and in other lines of the file too. "
                "Correct them all in the same way. Write here: {wanted}"
            ),
            "line_twice": msg(
                "This line and line {wanted} above it are the same. Delete one of them."
            ),
            "lines_swapped": msg(
                "Line {wanted} and this one are in the wrong order. Exchange the two lines."
            ),
            "end_twice": msg("Delete this line: </package> is only at the end of the file."),
            "root_first": msg(
                "All tags are between <package …> and </package>. Move this line below the one that begins "
                "with <package."
            ),
            "first_line": msg('Write as the first line: <?xml version="1.0"?>'),
            "no_tags": msg(
                "package.xml is XML: it consists of tags, such as <package>. Copy the one that ros2 pkg "
                "create makes, and write your values into it."
            ),
            "encoding_declared": msg(
                'The file is not in the encoding that its first line names. Write encoding="utf-8" '
                "there, or delete encoding=… from that line."
            ),
            "outside": msg(
                "Move this tag, with all lines up to its end tag, above </{name}>: all tags belong "
                "inside <{name}>."
            ),
            "bare": msg("Write quotes around the value: {wanted}"),
            "comment": msg("Write --> where the comment ends."),
            "hyphens": msg(
                "Write the comment so: {wanted} (A comment has two hyphens only at its beginning "
                "and its end. A command that you type in the terminal keeps its two hyphens.)"
            ),
            "hyphens_lines": msg(
                "Between <!-- and -->, write one hyphen, or - - with a space, instead of each --. Right "
                "before --> there is no other hyphen. A command that you type in the terminal keeps its "
                "two hyphens."
            ),
            "comment_start": msg("Write <!-- where the comment begins, and --> where it ends."),
            "less": msg("Write &lt; instead of this <."),
            "version": msg(
                "Write only the name of the package, as in {wanted}: this tag has no version in it, unlike "
                "a requirement of pip."
            ),
        },
        fixed_by=(manifest.well_formed, manifest.declared_encoding),
        examples=(
            example(
                "license_not_closed",
                Replace(MANIFEST, "</license>", ""),
                fails="package.manifest",
                blocks=UNBUILT,
                note="expat names the line of </package>",
            ),
            example(
                "end_tag_with_a_backslash",
                Replace(MANIFEST, "rclpy</depend>", "rclpy<\\depend>"),
                fails="package.manifest",
                blocks=UNBUILT,
            ),
            example(
                "tag_without_its_first_sign",
                Replace(MANIFEST, "<depend>rclpy", "depend>rclpy"),
                fails="package.manifest",
                blocks=UNBUILT,
            ),
            example(
                "end_tag_with_its_slash_at_the_end",
                Replace(MANIFEST, "rclpy</depend>", "rclpy<depend/>"),
                fails="package.manifest",
                blocks=UNBUILT,
            ),
            example(
                "end_tag_twice",
                Replace(MANIFEST, "  </export>\n", "  </export>\n  </export>\n"),
                fails="package.manifest",
                blocks=UNBUILT,
            ),
            example(
                "end_tags_in_the_wrong_order",
                Replace(MANIFEST, "  </export>\n</package>\n", "</package>\n  </export>\n"),
                fails="package.manifest",
                blocks=UNBUILT,
            ),
            example(
                "end_tag_of_a_dependency_twice",
                Replace(MANIFEST, "rclpy</depend>", "rclpy</depend></depend>"),
                fails="package.manifest",
                blocks=UNBUILT,
            ),
            example(
                "manifest_pasted_twice",
                Replace(
                    MANIFEST, "</package>\n", "</package>\n<package><name>a</name></package>\n"
                ),
                fails="package.manifest",
                blocks=UNBUILT,
            ),
            example(
                "manifest_as_json",
                Write(MANIFEST, '{"name": "my_robot_controller", "version": "0.0.0"}\n'),
                fails="package.manifest",
                blocks=UNBUILT,
            ),
            example(
                "manifest_declares_utf_16",
                Replace(
                    MANIFEST, '<?xml version="1.0"?>', '<?xml version="1.0" encoding="utf-16"?>'
                ),
                fails="package.manifest",
            ),
            example(
                "format_without_quotes",
                Replace(MANIFEST, 'format="3"', "format=3"),
                fails="package.manifest",
                blocks=UNBUILT,
            ),
            example(
                "entity_of_html",
                Replace(MANIFEST, "<description>", "<description>Hello&nbsp;"),
                fails="package.manifest",
                blocks=UNBUILT,
            ),
            example(
                "email_twice_in_a_tag",
                Replace(MANIFEST, "<maintainer ", '<maintainer email="a@todo.todo" '),
                fails="package.manifest",
                blocks=UNBUILT,
            ),
            example(
                "quotes_of_two_kinds",
                Replace(MANIFEST, '@todo.todo">', "@todo.todo'>"),
                fails="package.manifest",
                blocks=UNBUILT,
            ),
            example(
                "blanks_at_the_start_of_tags",
                Replace(MANIFEST, "<depend>", "< depend>"),
                Replace(MANIFEST, "</depend>", "</ depend>"),
                fails="package.manifest",
                blocks=UNBUILT,
            ),
            example(
                "blanks_in_tags_of_two_lines",
                Replace(MANIFEST, "<license>", "< license>"),
                Replace(MANIFEST, "<depend>", "< depend>"),
                fails="package.manifest",
                blocks=UNBUILT,
            ),
            example(
                "comment_without_end",
                Replace(MANIFEST, "  <depend>", "  <!-- TODO: licence\n  <depend>"),
                fails="package.manifest",
                blocks=UNBUILT,
            ),
            example(
                "version_of_pip_in_a_dependency",
                Replace(MANIFEST, "<depend>rclpy</depend>", "<depend>rclpy>=7.1,<8.0</depend>"),
                fails="package.manifest",
                blocks=UNBUILT,
            ),
            example(
                "comment_with_two_hyphens",
                Replace(MANIFEST, "  <depend>", "  <!-- TODO -- licence -->\n  <depend>"),
                fails="package.manifest",
                blocks=UNBUILT,
            ),
            example(
                "comment_with_one_hyphen",
                Replace(MANIFEST, "  <depend>", "  <!- TODO: licence ->\n  <depend>"),
                fails="package.manifest",
                blocks=UNBUILT,
            ),
            example(
                "license_opened_twice",
                Replace(MANIFEST, "</license>", "<license>"),
                fails="package.manifest",
                blocks=UNBUILT,
            ),
            example(
                "package_not_closed",
                Replace(MANIFEST, "</package>", ""),
                fails="package.manifest",
                blocks=UNBUILT,
            ),
            example(
                "end_tag_without_bracket",
                Replace(MANIFEST, "</license>", "</license"),
                fails="package.manifest",
                blocks=UNBUILT,
            ),
            example(
                "manifest_typographic_quotes",
                Replace(MANIFEST, 'format="3"', "format=\u201c3\u201d"),
                fails="package.manifest",
                blocks=UNBUILT,
            ),
            example(
                "manifest_page_label",
                Replace(MANIFEST, '<?xml version="1.0"?>', 'XML\n<?xml version="1.0"?>'),
                fails="package.manifest",
                blocks=UNBUILT,
            ),
            example(
                "comment_above_declaration",
                Replace(MANIFEST, '<?xml version="1.0"?>', '<!-- Jane -->\n<?xml version="1.0"?>'),
                fails="package.manifest",
                blocks=UNBUILT,
            ),
            example(
                "blank_line_above_declaration",
                Replace(MANIFEST, '<?xml version="1.0"?>', '\n<?xml version="1.0"?>'),
                fails="package.manifest",
                blocks=UNBUILT,
            ),
            example(
                "manifest_not_xml",
                Replace(MANIFEST, "</description>", "</decription>"),
                fails="package.manifest",
                blocks=UNBUILT,
                note="colcon takes it for plain Python: it builds, and ros2 run does not find it",
            ),
            example(
                "manifest_empty", Write(MANIFEST, ""), fails="package.manifest", blocks=UNBUILT
            ),
            example(
                "manifest_not_utf8",
                Write(
                    MANIFEST,
                    b'<?xml version="1.0"?>\n<package format="3"><name>my_robot_controller</name><version>0.0.0</version><description>f\xfcr</description></package>\n',
                ),
                fails="package.manifest",
                blocks=UNBUILT,
            ),
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
        msg("Add <{tag}>…</{tag}> inside <package>."),
        fixes={
            "empty": msg("Write something between <{tag}> and </{tag}>."),
            "tags": msg(
                "Write the text itself between <{tag}> and </{tag}>, without tags around it."
            ),
            "tags_maintainer": msg(
                "Write the name as the text and the e-mail address as an attribute, without tags "
                'inside: <maintainer email="student@todo.todo">student</maintainer>'
            ),
            "commented": msg(
                "<{tag}> is in the comment that begins in this line. Delete the <!-- before it and "
                "the --> behind it, so that it counts. Then build again."
            ),
            "version": msg("Add <version>0.0.0</version> inside <package>."),
            "name": msg("Add <name>{package}</name> inside <package>."),
            "maintainer": msg(
                'Add <maintainer email="student@todo.todo">student</maintainer> inside <package>. You '
                "may invent the address."
            ),
            "renamed": msg("Write <{tag}> instead of <{close}>, and the same in its end tag."),
        },
        fixed_by=(manifest.tag_name, manifest.version, manifest.name),
        examples=(
            example(
                "license_in_a_comment",
                Replace(MANIFEST, "<license>", "<!-- <license>"),
                Replace(MANIFEST, "</license>", "</license> -->"),
                fails="package.manifest",
                blocks=UNBUILT,
            ),
            example(
                "all_tags_in_one_comment",
                Replace(MANIFEST, "  <name>", "  <!--\n  <name>"),
                Replace(MANIFEST, "</package>", "  -->\n</package>"),
                fails="package.manifest",
                blocks=UNBUILT,
            ),
            example(
                "maintainer_in_a_comment_with_words",
                Replace(MANIFEST, "<maintainer", "<!-- who? <maintainer"),
                Replace(MANIFEST, "</maintainer>", "</maintainer> -->"),
                fails="package.manifest",
                blocks=UNBUILT,
            ),
            example(
                "maintainer_with_tags_inside",
                Replace(
                    MANIFEST,
                    '<maintainer email="student@todo.todo">student</maintainer>',
                    "<maintainer><name>student</name><email>student@todo.todo</email></maintainer>",
                ),
                fails="package.manifest",
                blocks=UNBUILT,
            ),
            example(
                "license_misspelt",
                Replace(MANIFEST, "<license>", "<licence>"),
                Replace(MANIFEST, "</license>", "</licence>"),
                fails="package.manifest",
                blocks=UNBUILT,
            ),
        ),
    ),
    _manifest(
        "manifest_rules",
        msg("package.xml breaks a rule of its format"),
        msg("Correct what the message names, so that colcon accepts the file."),
        fixes={
            "version": msg("Write three numbers with points between them, such as 1.0.0."),
            "itself": msg("Delete this line: a package does not depend on itself."),
            "twice": msg(
                "Delete the <{tag}> that begins in line {line}: package.xml has only one."
            ),
            "export_twice": msg(
                "package.xml has <{tag}> only once. Move what the one in line {line} contains into "
                "the one in line {first}, and delete the one in line {line}."
            ),
            "redundant": msg(
                "Delete <{tag}>{found}</{tag}> in line {line}: <depend> in line {first} already "
                "includes it."
            ),
            "email": msg('Write in that line: email="{wanted}"'),
            "email_parts": msg(
                "Write an address with an @ and a domain in that line, such as "
                'email="student@todo.todo". You may invent it.'
            ),
            "no_email": msg(
                'Write an address into the tag: <{tag} email="student@todo.todo">. You may invent it.'
            ),
            "attribute_name": msg("Write {wanted}= instead of {found}= in that tag."),
            "attribute": msg("Delete {found}=… from the tag <{tag}>."),
            "content": msg(
                "Write {wanted} in that line: what {found}=… contains belongs between <{tag}> and "
                "</{tag}>."
            ),
            "format": msg(
                'Write <package format="3">. Each format has its own tags, and ros2 pkg create '
                "writes format 3."
            ),
            "tag": msg("Write <{wanted}> instead of <{tag}>, and the same in its end tag."),
            "container": msg(
                "Delete <{tag}> and </{tag}>, and keep what is between them: package.xml has no such "
                "tag, and its lines are directly in <package>."
            ),
            "unknown_tag": msg("Delete <{tag}> and what it contains: package.xml has no such tag."),
            "child": msg(
                "Move <{found}> below </{tag}>: each of the two has a line of its own, and <{tag}> "
                "contains only text."
            ),
            "name": msg("Write <name>{package}</name> in package.xml, then build again."),
            "empty": msg("Write something between <{tag}> and </{tag}>."),
            "second_empty": msg("Delete this empty <{tag}>."),
            "root": msg(
                'Write <package format="3"> as the outermost tag, and </package> at the end of '
                "the file."
            ),
        },
        fixed_by=(manifest.version, manifest.three_numbers, manifest.rule, manifest.root),
        examples=(
            example(
                "description_twice",
                Replace(
                    MANIFEST,
                    "  <description>",
                    "  <description>Says hello</description>\n  <description>",
                ),
                fails="package.manifest",
                blocks=UNBUILT,
            ),
            example(
                "export_twice",
                Replace(MANIFEST, "  <export>", "  <export>\n  </export>\n  <export>"),
                fails="package.manifest",
                blocks=UNBUILT,
            ),
            example(
                "depend_redundant",
                Replace(
                    MANIFEST,
                    "<depend>rclpy</depend>",
                    "<exec_depend>rclpy</exec_depend>\n  <depend>rclpy</depend>",
                ),
                fails="package.manifest",
                blocks=UNBUILT,
            ),
            example(
                "maintainer_email_at",
                Replace(MANIFEST, "@todo.todo", "(at)todo.todo"),
                fails="package.manifest",
                blocks=UNBUILT,
            ),
            example(
                "maintainer_mail",
                Replace(MANIFEST, "email=", "mail="),
                fails="package.manifest",
                blocks=UNBUILT,
            ),
            example(
                "format_missing",
                Replace(MANIFEST, ' format="3"', ""),
                fails="package.manifest",
                blocks=UNBUILT,
            ),
            example(
                "run_depend_of_ros_1",
                Replace(MANIFEST, "<depend>rclpy</depend>", "<run_depend>rclpy</run_depend>"),
                fails="package.manifest",
                blocks=UNBUILT,
            ),
            example(
                "dependencies_in_a_tag_of_their_own",
                Replace(
                    MANIFEST,
                    "  <depend>rclpy</depend>",
                    "  <dependencies>\n    <depend>rclpy</depend>\n  </dependencies>",
                ),
                fails="package.manifest",
                blocks=UNBUILT,
            ),
            example(
                "depend_in_an_attribute",
                Replace(MANIFEST, "<depend>rclpy</depend>", '<depend include="rclpy"/>'),
                fails="package.manifest",
                blocks=UNBUILT,
            ),
            example(
                "depends_on_itself",
                Replace(
                    MANIFEST,
                    "<depend>rclpy</depend>",
                    "<depend>rclpy</depend>\n  <depend>my_robot_controller</depend>",
                ),
                fails="package.manifest",
                blocks=UNBUILT,
            ),
        ),
    ),
    _manifest(
        "depend_missing",
        msg("package.xml does not name a package that your code imports"),
        msg("Add <depend>{needed}</depend> to package.xml, below the other dependencies."),
        why=msg(
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
    Kind(
        id="package.name_mismatch",
        stage="manifest",
        title=msg("The package's names differ"),
        why=msg(
            "colcon and ros2 run use the name in package.xml. The names in package.xml, "
            "setup.py, setup.cfg and resource/ must be the same."
        ),
        whys={
            "setup": msg(
                "Python installs the package under the name in setup.py, and ROS looks "
                "for the name in package.xml: the two must be the same."
            )
        },
        fix=msg("Write <name>{package}</name> in package.xml, then build again."),
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
        link=links.PACKAGE,
        fixed_by=(
            manifest.name,
            setup_py.name,
        ),
        examples=(
            example(
                "manifest_other_name",
                Replace(
                    MANIFEST, "<name>my_robot_controller</name>", "<name>my_robot_controler</name>"
                ),
                fails="package.manifest",
                note="runs anyway: marker, setup.cfg and setup.py have the right name",
            ),
            example(
                "setup_other_name",
                Replace(SETUP, "name=package_name", "name='my_robot'"),
                fails="package.manifest",
            ),
            example(
                "setup_variable_other_name",
                Replace(
                    SETUP,
                    "package_name = 'my_robot_controller'",
                    "package_name = 'robot_controller'",
                ),
                fails="package.manifest",
                blocks=UNBUILT,
            ),
            example(
                "other_name_throughout",
                Replace(MANIFEST, "<name>my_robot_controller</name>", "<name>my_controller</name>"),
                Replace(
                    SETUP, "package_name = 'my_robot_controller'", "package_name = 'my_controller'"
                ),
                Write(
                    CFG,
                    (
                        "[develop]\n"
                        "script_dir=$base/lib/my_controller\n"
                        "[install]\n"
                        "install_scripts=$base/lib/my_controller\n"
                    ),
                ),
                Move(MARKER, "resource/my_controller"),
                Replace(SETUP, "test_node = my_robot_controller.", "test_node = my_controller."),
                Move(INNER, "my_controller"),
                fails="package.manifest",
                note="builds and runs under its own name",
            ),
            example(
                "name_misspelt_but_the_entry",
                *MISSPELT,
                Move(INNER, "my_robot_conroller"),
                fails="package.manifest",
                also={"entry_point.mapping": "setup.other_package"},
                blocks=UNSTARTED,
            ),
            example(
                "name_misspelt_throughout",
                *MISSPELT,
                Replace(
                    SETUP, "test_node = my_robot_controller.", "test_node = my_robot_conroller."
                ),
                Move(INNER, "my_robot_conroller"),
                fails="package.manifest",
            ),
            example(
                "name_misspelt_but_the_folder",
                *MISSPELT,
                fails="package.manifest",
                note="the inner folder has the right name",
            ),
        ),
    ),
    Kind(
        id="package.build_type",
        stage="manifest",
        title=msg("package.xml does not set the build type ament_python"),
        why=msg(
            "The build type tells colcon how to build. Without ament_python, colcon takes the "
            "package for a C++ one and looks for a CMakeLists.txt."
        ),
        whys={
            **dict.fromkeys(("outside", "into", "outside_too", "out_of_other"), DEGRADES),
            "several": msg("The build type tells colcon how to build: a package has only one."),
            "line": msg(
                "The build type tells colcon how to build. Only with ament_python does colcon build a "
                "Python package of ROS: for other types it looks for a CMakeLists.txt, or does not know "
                "them and builds nothing."
            ),
        },
        fix=msg(
            "Write above </package> in package.xml, then build again: "
            "<export><build_type>ament_python</build_type></export>"
        ),
        fixes={
            "outside": msg(
                "Write <export> before this tag and </export> after it: "
                "<export><build_type>ament_python</build_type></export>"
            ),
            "into": msg(
                "Delete this tag here, and write it into the <export> of line {first}, so that "
                "package.xml has: <export><build_type>ament_python</build_type></export>. Then build "
                "again."
            ),
            "out_of_other": msg(
                "Delete this tag here: it does not belong into <{within}>. Write above </package>, "
                "then build again: <export><build_type>ament_python</build_type></export>"
            ),
            "outside_too": msg(
                "Delete this tag: the right one is in <export>, in line {first}. Then build again."
            ),
            "in_export": msg(
                "The <export> of line {first} has no build type. Write into it, so that package.xml "
                "has: <export><build_type>ament_python</build_type></export>. Then build again."
            ),
            "renamed": msg("Write <{tag}> instead of <{close}>, and the same in its end tag."),
            "condition": msg(
                "With this condition, the tag does not count. Delete the condition, then build again: "
                "<build_type>ament_python</build_type>"
            ),
            "commented": msg(
                "<build_type> is in the comment that begins in this line. Delete the <!-- before it "
                "and the --> behind it, so that it counts. Then build again."
            ),
            "line": msg(
                "Write in this line instead, then build again: "
                "<build_type>ament_python</build_type>"
            ),
            "several": msg(
                "Keep only one of them: <build_type>ament_python</build_type>. Delete the others, "
                "then build again."
            ),
            "cmake": msg(
                "If only this line is wrong, write ament_python. Otherwise create a "
                "new package with ros2 pkg create --build-type ament_python and copy "
                "your code into it."
            ),
        },
        link=links.PACKAGE,
        seen=r"does not appear to contain CMakeLists\.txt",
        fixed_by=(manifest.tag_name, manifest.build_type),
        examples=(
            example(
                "build_type_tag_misspelt",
                Replace(MANIFEST, "<build_type>", "<build_typ>"),
                Replace(MANIFEST, "</build_type>", "</build_typ>"),
                fails="package.manifest",
                blocks=UNBUILT,
            ),
            example(
                "build_type_missing",
                Replace(MANIFEST, "    <build_type>ament_python</build_type>\n", ""),
                fails="package.manifest",
                blocks=UNBUILT,
            ),
            example(
                "export_in_a_comment",
                Replace(MANIFEST, "  <export>", "  <!-- <export>"),
                Replace(MANIFEST, "  </export>", "  </export> -->"),
                fails="package.manifest",
                blocks=UNBUILT,
            ),
            example(
                "build_type_twice",
                Replace(
                    MANIFEST, "<build_type>", "<build_type>ament_cmake</build_type><build_type>"
                ),
                fails="package.manifest",
                blocks=UNBUILT,
            ),
            example(
                "build_type_outside",
                Replace(MANIFEST, "  <export>\n    <build_type>", "  <build_type>"),
                Replace(MANIFEST, "  </export>\n", ""),
                fails="package.manifest",
                blocks=UNBUILT,
            ),
            example(
                "build_type_above_export",
                Replace(MANIFEST, "    <build_type>ament_python</build_type>\n", ""),
                Replace(
                    MANIFEST, "  <export>", "  <build_type>ament_python</build_type>\n  <export>"
                ),
                fails="package.manifest",
                blocks=UNBUILT,
            ),
            example(
                "build_type_cmake",
                Replace(MANIFEST, "ament_python", "ament_cmake"),
                fails="package.manifest",
                blocks=UNBUILT,
            ),
            example(
                "build_type_misspelt",
                Replace(MANIFEST, "ament_python", "ament_pyton"),
                fails="package.manifest",
                blocks=UNBUILT,
            ),
        ),
    ),
)
