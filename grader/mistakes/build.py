"""The catalogue: the build, and what it installs."""

from __future__ import annotations

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.kind import Kind

WHY = msg(
    "colcon runs setup.py to install the package into the workspace's install folder, the only "
    "place where ros2 run looks."
)
LOOKS = msg(
    "ros2 run looks only in install/<package>/lib/<package>/, for an executable file with exactly "
    "that name. colcon creates it there from entry_points in setup.py and the paths in setup.cfg."
)
CONFIG = msg(
    "Write both sections in setup.cfg: [develop] with script_dir=$base/lib/{package} and "
    "[install] with install_scripts=$base/lib/{package}, then build again."
)


def _build(slug: str, title: str, fix: str, why: str = WHY, seen: str = "") -> Kind:
    return Kind(
        id=f"build.{slug}",
        stage="build",
        title=title,
        why=why,
        fix=fix,
        link=links.COLCON,
        seen=seen,
    )


def _installed(slug: str, title: str, fix: str) -> Kind:
    return Kind(
        id=f"entry_point.{slug}",
        stage="build",
        title=title,
        why=LOOKS,
        fix=fix,
        link=links.DEVELOPING,
    )


KINDS = (
    _build("setup_prints", msg("setup.py prints something"),
           msg("Remove the print() from setup.py, then build again."),
           msg("colcon asks setup.py for its data and reads its output as the answer. What print() "
               "writes ends up in the middle of that answer.")),
    Kind(
        id="build.setup_error",
        stage="build",
        title=msg("setup.py stops with an error"),
        why=WHY,
        fix=msg("Fix what the error names, then build again."),
        whys={"unreadable": msg("colcon runs setup.py to install the package into the workspace's "
                                "install folder, the only place where ros2 run looks. Python "
                                "cannot run a file that it cannot read.")},
        fixes={"unreadable": msg("Fix that line of setup.py, then build again. Often a comma, a "
                                 "quote or a bracket is missing in the line above.")},
        link=links.COLCON,
    ),
    _build("entry_unreadable", msg("setuptools stopped at an entry of console_scripts"),
           msg("Check the entries of console_scripts in setup.py: each is 'name = "
               "package.module:function', with a comma after it."),
           msg("setuptools stops at an entry point that it cannot read. colcon then says only that "
               "distutils.core.setup() was never called."),
           seen=r"'?distutils\.core\.setup\(\)'? was never called"),
    _build("exited", msg("setup.py ends before it calls setup()"),
           msg("Remove the exit from setup.py, and compare the file with the one that ros2 pkg "
               "create makes."),
           msg("colcon runs setup.py to install the package into the workspace's install folder, "
               "the only place where ros2 run looks. It must reach the call of setup(): a "
               "sys.exit() before or in that call ends it without a message.")),
    _build("timeout", msg("The build does not finish"),
           msg("Remove the loop, the sleep or the input() from setup.py."),
           msg("colcon runs setup.py to install the package into the workspace's install folder, "
               "the only place where ros2 run looks. A setup.py that loops or waits never "
               "finishes.")),
    _build("resource", msg("The build reached a limit of the sandbox"),
           msg("Use setup.py only to describe the package: no large output, no other programs.")),
    _build("failed", msg("The build failed"),
           msg("Read the build log below, starting at its first error. Build again after each "
               "change.")),
    _installed("no_exec_bit", msg("The installed executable lost its exec bit"),
               msg("Remove the code in setup.py that clears the exec bit, then build again. colcon "
                   "itself writes the file with mode 0755.")),
    _installed("elsewhere", msg("The executable was installed where ros2 run does not look"),
               CONFIG),
    _installed("not_installed", msg("The executable was not installed"),
               msg("Check that entry_points is an argument of setup(), then build again.")),
)  # fmt: skip
