"""The catalogue: setup.cfg."""

from __future__ import annotations

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.example import CFG, UNBUILT, UNINSTALLED, example
from grader.mistakes.fixes import layout, setup_cfg
from grader.mistakes.kind import Kind
from grader.package.edit.tree import Delete, Move, Replace, Write

WITHOUT_CFG = msg(
    "setup.cfg sets where executables are installed. ros2 run looks only in lib/<package>. Without "
    "these settings they are installed in bin, and ros2 run answers: No executable found."
)
TWO_SECTIONS = msg(
    "setup.cfg sets where executables are installed. ros2 run looks only in lib/<package>. Without "
    "these settings they are installed in bin, and ros2 run answers: No executable found. "
    "[develop] is for colcon build --symlink-install, [install] for a build without it."
)
OTHER_PLACE = msg(
    "setup.cfg sets where executables are installed. ros2 run looks only in lib/<package>. With "
    "another path they can get into another folder, and then ros2 run answers: No executable found. "
    "[develop] is for colcon build --symlink-install, [install] for a build without it."
)
OTHER_KEY = msg(
    "setup.cfg sets where executables are installed. ros2 run looks only in lib/<package>. [develop] "
    "is for colcon build --symlink-install, [install] for a build without it. Each has keys of its own, "
    "and a build that reads a key which setuptools does not know there stops."
)
NEW_CFG = msg(
    "Create setup.cfg beside setup.py. Below [develop] write script_dir=$base/lib/{package}, and "
    "below [install] write install_scripts=$base/lib/{package}. Then build again."
)


KINDS = (
    Kind(
        id="package.setup_cfg_missing",
        stage="setup.cfg",
        title=msg("There is no setup.cfg"),
        why=WITHOUT_CFG,
        fix=NEW_CFG,
        fixes={
            "inner": msg(
                "Move it out of the inner folder. In the package's folder, run: mv {there} ."
            ),
            "renamed": msg(
                "Rename the file. In the package's folder, run: mv {close} setup.cfg. Then build "
                "again. (Windows hides the last part of a name, such as .txt, unless you switch on "
                "'File name extensions'.)"
            ),
        },
        link=links.DEVELOPING,
        fixed_by=(layout.out_of_inner_folder, setup_cfg.missing),
        examples=(
            example(
                "setup_cfg_missing",
                Delete(CFG),
                fails="package.setup_cfg",
                blocks=UNINSTALLED,
                note="the script lands in bin",
            ),
            example(
                "setup_cfg_txt",
                Move(CFG, "setup.cfg.txt"),
                fails="package.setup_cfg",
                blocks=UNINSTALLED,
            ),
        ),
    ),
    Kind(
        id="package.setup_cfg_syntax",
        stage="setup.cfg",
        title=msg("setup.cfg cannot be parsed"),
        why=msg(
            "setuptools reads this file in every build and stops at a line that it cannot read."
        ),
        fix=msg("Fix that line: a line is either [section] or key=value."),
        whys={
            **dict.fromkeys(
                ("heading_above", "below", "no_section", "half_heading"),
                msg(
                    "setup.cfg consists of sections: a line such as [develop] begins one, and its "
                    "settings are below it. setuptools stops at a line above the first section."
                ),
            ),
        },
        fixes={
            "heading_above": msg(
                "Write [{other}] on a line of its own above this line, then build again."
            ),
            "below": msg(
                "Move this line below [{other}], which is in line {line}, then build again."
            ),
            "half_heading": msg(
                "The name of a section is in square brackets. Write [{other}] in this line, then build "
                "again."
            ),
            "no_section": msg(
                "Delete this line, or write above it the [section] to which it belongs. Then build "
                "again."
            ),
            "comment": msg(
                "A comment in setup.cfg begins with #. Write # instead of {other} at the start of "
                "this line, or delete the line. Then build again."
            ),
            "mark": msg(
                "Save the file again with the encoding UTF-8, without a BOM (byte order mark)."
            ),
            "equals": msg("The = behind the name is missing. Write: {other}"),
            "section": msg("Write [{other}] on that line: setup.cfg needs both sections."),
            "headings": msg(
                "Write [develop] on a line of its own above script_dir, and [install] above "
                "install_scripts. Then build again."
            ),
            "bare_headings": msg(
                "The name of a section is in square brackets. Write the lines [develop] and [install] "
                "with brackets, without : and without spaces before them. Delete the spaces before the "
                "lines below them too. Then build again."
            ),
            "twice": msg(
                "Delete the second one, with the lines that belong to it: each name appears only once."
            ),
            "encoding": msg(
                "Save the file again with the encoding UTF-8, without a BOM. Windows PowerShell "
                "writes UTF-16 with >."
            ),
        },
        link=links.SETUP_CFG,
        seen=r"configparser\.\w{1,60}Error|File contains no section headers",
        fixed_by=(setup_cfg.syntax,),
        examples=(
            example(
                "setup_cfg_section_twice",
                Replace(CFG, "[install]", "[develop]"),
                fails="package.setup_cfg",
                blocks=UNBUILT,
            ),
            example(
                "setup_cfg_without_equals",
                Replace(CFG, "script_dir=", "script_dir "),
                fails="package.setup_cfg",
                blocks=UNBUILT,
            ),
            example(
                "setup_cfg_comment_of_matlab",
                Replace(CFG, "[develop]\n", "% where ros2 run looks\n[develop]\n"),
                fails="package.setup_cfg",
                blocks=UNBUILT,
            ),
            example(
                "setup_cfg_comment_of_c",
                Replace(CFG, "[install]\n", "// the second part\n[install]\n"),
                fails="package.setup_cfg",
                blocks=UNBUILT,
            ),
            example(
                "setup_cfg_without_headings",
                Replace(CFG, "[develop]\n", ""),
                Replace(CFG, "[install]\n", ""),
                fails="package.setup_cfg",
                blocks=UNBUILT,
            ),
            example(
                "setup_cfg_as_yaml",
                Write(
                    CFG,
                    (
                        "develop:\n  script_dir: $base/lib/my_robot_controller\n"
                        "install:\n  install_scripts: $base/lib/my_robot_controller\n"
                    ),
                ),
                fails="package.setup_cfg",
                blocks=UNBUILT,
            ),
            example(
                "setup_cfg_first_heading_missing",
                Replace(CFG, "[develop]\n", ""),
                fails="package.setup_cfg",
                blocks=UNBUILT,
            ),
            example(
                "setup_cfg_not_ini",
                Replace(CFG, "[develop]", "[develop"),
                fails="package.setup_cfg",
                blocks=UNBUILT,
            ),
        ),
    ),
    Kind(
        id="package.setup_cfg_wrong",
        stage="setup.cfg",
        title=msg("setup.cfg installs executables where ros2 run does not look"),
        why=OTHER_PLACE,
        whys={
            **dict.fromkeys(("key", "heading", "joined", "section", "one_line"), TWO_SECTIONS),
            **dict.fromkeys(("misspelt", "line", "swapped"), OTHER_KEY),
            "indented": msg(
                "In setup.cfg, a line that begins with a space continues the line above. So this "
                "line, and those below it, belong to the value above, and begin no section."
            ),
            "sections": TWO_SECTIONS,
            "comment": msg(
                "setup.cfg sets where executables are installed, and ros2 run looks only in "
                "lib/<package>. In setup.cfg, a comment has a line of its own: behind a value, it is "
                "part of the path."
            ),
            "variable": msg(
                "setup.cfg sets where executables are installed, and ros2 run looks only in "
                "lib/<package>. setup.cfg does not know the variables of setup.py: a build that uses "
                "this path stops at {name}."
            ),
            "capitals": msg(
                "setup.cfg sets where executables are installed, and ros2 run looks only in "
                "lib/<package>. This variable has a name in small letters: a build that uses this "
                "path stops at {name}."
            ),
            "quotes": msg(
                "setup.cfg sets where executables are installed, and ros2 run looks only in "
                "lib/<package>. setup.cfg is not Python: its quotes are part of the path, so the "
                "executable gets into another folder."
            ),
        },
        fix=msg("Write {key}={wanted}, then build again."),
        fixes={
            "indented": msg(
                "Delete the spaces before this line and before the lines below it, then build again."
            ),
            "swapped": msg(
                "Exchange the two keys: script_dir={wanted} belongs below [develop], and "
                "install_scripts={wanted} below [install]. Then build again."
            ),
            "quotes": msg(
                "Delete the quotes around the path (lines: {line}), so that it is {wanted}. Then "
                "build again."
            ),
            "comment": msg(
                "Delete the comment behind the path (lines: {line}), so that the path is {wanted}. "
                "Then build again."
            ),
            "variable": msg(
                "Write the whole path without {name} (lines: {line}), so that it is {wanted}. Then "
                "build again."
            ),
            "capitals": msg(
                "Write the variable in small letters (lines: {line}): {wanted}. Then build again."
            ),
            "one_line": msg(
                "What is behind [{section}] is not read. Begin a new line there: below [{section}], "
                "write {key}={wanted}. Do the same with the other section, if it is on one line too. "
                "Then build again."
            ),
            "both": msg(
                "Write below [develop] script_dir={wanted}, and below [install] "
                "install_scripts={wanted}. Then build again."
            ),
            "key": msg("Write below [{section}]: {key}={wanted}, then build again."),
            "misspelt": msg("Write {key} instead of {close} in this line, then build again."),
            "line": msg("Write {key}={wanted} in place of this line, then build again."),
            "joined": msg(
                "Write [develop] in place of this line, with only script_dir={wanted} below it. Below that, "
                "write [install], and below it install_scripts={wanted}. Then build again."
            ),
            "heading": msg("Write [{section}] instead of [{close}], then build again."),
            "section": msg(
                "Add two lines: [{section}] and below it {key}={wanted}. Then build again."
            ),
            "sections": msg(
                "Add four lines to setup.cfg: [develop], below it script_dir={wanted}, then "
                "[install], and below it install_scripts={wanted}. Then build again."
            ),
        },
        link=links.DEVELOPING,
        fixed_by=(setup_cfg.setting,),
        examples=(
            example(
                "setup_cfg_empty", Write(CFG, ""), fails="package.setup_cfg", blocks=UNINSTALLED
            ),
            example(
                "setup_cfg_one_heading_for_both",
                Write(
                    CFG,
                    (
                        "[develop, install]\n"
                        "script_dir=$base/lib/my_robot_controller\n"
                        "install_scripts=$base/lib/my_robot_controller\n"
                    ),
                ),
                fails="package.setup_cfg",
                blocks=UNINSTALLED,
            ),
            example(
                "setup_cfg_quotes",
                Write(
                    CFG,
                    (
                        "[develop]\n"
                        'script_dir="$base/lib/my_robot_controller"\n'
                        "[install]\n"
                        'install_scripts="$base/lib/my_robot_controller"\n'
                    ),
                ),
                fails="package.setup_cfg",
                blocks=UNINSTALLED,
            ),
            example(
                "setup_cfg_variable_of_setup_py",
                Write(
                    CFG,
                    (
                        "[develop]\n"
                        "script_dir=$base/lib/$package_name\n"
                        "[install]\n"
                        "install_scripts=$base/lib/$package_name\n"
                    ),
                ),
                fails="package.setup_cfg",
                blocks=UNBUILT,
                note="ValueError: invalid variable 'package_name'",
            ),
            example(
                "setup_cfg_comment_behind_value",
                Write(
                    CFG,
                    (
                        "[develop]\n"
                        "script_dir=$base/lib/my_robot_controller  # for ros2 run\n"
                        "[install]\n"
                        "install_scripts=$base/lib/my_robot_controller  # for ros2 run\n"
                    ),
                ),
                fails="package.setup_cfg",
                blocks=UNINSTALLED,
            ),
            example(
                "setup_cfg_base_in_capitals",
                Replace(CFG, "script_dir=$base", "script_dir=$BASE"),
                Replace(CFG, "install_scripts=$base", "install_scripts=$BASE"),
                fails="package.setup_cfg",
                blocks=UNBUILT,
            ),
            example(
                "setup_cfg_settings_behind_headings",
                Replace(CFG, "[develop]\n", "[develop] "),
                Replace(CFG, "[install]\n", "[install] "),
                fails="package.setup_cfg",
                blocks=UNINSTALLED,
            ),
            example(
                "setup_cfg_keys_swapped",
                Write(
                    CFG,
                    (
                        "[develop]\ninstall_scripts=$base/lib/my_robot_controller\n"
                        "[install]\nscript_dir=$base/lib/my_robot_controller\n"
                    ),
                ),
                fails="package.setup_cfg",
                blocks=UNBUILT,
            ),
            example(
                "setup_cfg_section_indented",
                Write(
                    CFG,
                    (
                        "[develop]\nscript_dir=$base/lib/my_robot_controller\n"
                        "  [install]\n  install_scripts=$base/lib/my_robot_controller\n"
                    ),
                ),
                fails="package.setup_cfg",
                blocks=UNINSTALLED,
            ),
            example(
                "setup_cfg_key_misspelt",
                Replace(CFG, "install_scripts", "install_script"),
                fails="package.setup_cfg",
                also={"build.colcon": "build.failed"},
                note="setuptools refuses the key, so the build fails too",
            ),
            example(
                "setup_cfg_key_of_the_other_section",
                Replace(CFG, "install_scripts", "script_dir"),
                fails="package.setup_cfg",
                blocks=UNBUILT,
                note="setuptools refuses the key",
            ),
            example(
                "setup_cfg_other_package",
                Write(
                    CFG,
                    (
                        "[develop]\n"
                        "script_dir=$base/lib/my_robot\n"
                        "[install]\n"
                        "install_scripts=$base/lib/my_robot\n"
                    ),
                ),
                fails="package.setup_cfg",
                blocks=UNINSTALLED,
            ),
            example(
                "setup_cfg_without_install",
                Write(CFG, "[develop]\nscript_dir=$base/lib/my_robot_controller\n"),
                fails="package.setup_cfg",
                note="works with --symlink-install; without, the script lands in bin",
            ),
            example(
                "setup_cfg_heading",
                Replace(CFG, "[install]", "[instal]"),
                fails="package.setup_cfg",
            ),
            example(
                "setup_cfg_bin",
                Write(
                    CFG, ("[develop]\nscript_dir=$base/bin\n[install]\ninstall_scripts=$base/bin\n")
                ),
                fails="package.setup_cfg",
                blocks=UNINSTALLED,
            ),
        ),
    ),
)
