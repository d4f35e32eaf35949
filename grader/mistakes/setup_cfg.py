"""The catalogue: setup.cfg."""

from __future__ import annotations

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.example import CFG, UNBUILT, UNINSTALLED, Example, example
from grader.mistakes.fixes import setup_cfg
from grader.mistakes.kind import Kind
from grader.package.edit.tree import Delete, Edit, Move, Replace, Write

WHY = msg(
    "setup.cfg sets where executables are installed. ros2 run looks only in lib/<package>. With "
    "other settings they get into another folder, and ros2 run answers: No executable found; or the "
    "build stops at them. [develop] is for colcon build --symlink-install, [install] for a build "
    "without it."
)
BOTH = msg(
    "In setup.cfg, write exactly these four lines, then build again: [develop], below it "
    "script_dir=$base/lib/{package}, below that [install], and below it install_scripts=$base/lib/{package}. No spaces are "
    "before them, no quotes around the path, and no comment is behind it."
)


def _example(name: str, *edits: Edit, blocks: tuple[str, ...] = UNINSTALLED) -> Example:
    return example(name, *edits, fails="package.setup_cfg", blocks=blocks)


def _sections(path: str) -> Write:
    return Write(CFG, f"[develop]\nscript_dir={path}\n[install]\ninstall_scripts={path}\n")


KINDS = (
    Kind(
        id="package.setup_cfg_missing",
        stage="setup.cfg",
        title=msg("There is no setup.cfg"),
        why=WHY,
        fix=BOTH,
        fixes={
            "renamed": msg(
                "Give it its name and its place. In the package's folder, run: mv {there} setup.cfg. Then "
                "build again. (Windows hides the last part of a name, such as .txt, unless you switch on "
                "'File name extensions'.)"
            ),
        },
        link=links.DEVELOPING,
        fixed_by=(setup_cfg.missing,),
        examples=(
            _example("setup_cfg_missing", Delete(CFG)),
            _example("setup_cfg_txt", Move(CFG, "setup.cfg.txt")),
        ),
    ),
    Kind(
        id="package.setup_cfg_syntax",
        stage="setup.cfg",
        title=msg("setup.cfg cannot be parsed"),
        why=msg(
            "setuptools reads this file in every build and stops at a line that it cannot read: a line "
            "is a [section], or key=value in a section, or a comment that begins with #. Each name "
            "appears only once."
        ),
        fix=BOTH,
        fixes={
            "encoding": msg(
                "Save the file again with the encoding UTF-8, without a BOM. Windows PowerShell "
                "writes UTF-16 with >."
            ),
        },
        link=links.SETUP_CFG,
        seen=r"configparser\.\w{1,60}Error|File contains no section headers",
        fixed_by=(setup_cfg.rewritten,),
        examples=(
            _example(
                "setup_cfg_section_twice", Replace(CFG, "[install]", "[develop]"), blocks=UNBUILT
            ),
            _example(
                "setup_cfg_first_heading_missing", Replace(CFG, "[develop]\n", ""), blocks=UNBUILT
            ),
        ),
    ),
    Kind(
        id="package.setup_cfg_wrong",
        stage="setup.cfg",
        title=msg("setup.cfg installs executables where ros2 run does not look"),
        why=WHY,
        fix=BOTH,
        link=links.DEVELOPING,
        fixed_by=(setup_cfg.rewritten,),
        examples=(
            _example("setup_cfg_empty", Write(CFG, "")),
            _example("setup_cfg_quotes", _sections('"$base/lib/my_robot_controller"')),
            _example(
                "setup_cfg_variable_of_setup_py",
                _sections("$base/lib/$package_name"),
                blocks=UNBUILT,
            ),
            example(
                "setup_cfg_key_misspelt",
                Replace(CFG, "install_scripts", "install_script"),
                fails="package.setup_cfg",
                also={"build.colcon": "build.failed"},
                note="setuptools refuses the key, so the build fails too",
            ),
            _example("setup_cfg_other_package", _sections("$base/lib/my_robot")),
            _example(
                "setup_cfg_without_install",
                Write(CFG, "[develop]\nscript_dir=$base/lib/my_robot_controller\n"),
                blocks=(),
            ),
            _example("setup_cfg_bin", _sections("$base/bin")),
        ),
    ),
)
