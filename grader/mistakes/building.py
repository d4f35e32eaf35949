"""The catalogue: the build, and what it installs."""

from __future__ import annotations

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.kind import Kind

WHY = msg(
    "colcon runs your setup.py to install the package into the workspace's install folder; "
    "ros2 run only ever looks there."
)
LOOKS = msg(
    "ros2 run looks only in install/<package>/lib/<package>/ for a file of exactly that name that "
    "may be executed; colcon puts it there from setup.py's entry_points, by setup.cfg's paths."
)
CONFIG = msg(
    "Give setup.cfg both of its sections back: [develop] with script_dir=$base/lib/{package} and "
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
           msg("Take the print() out of setup.py, then build again."),
           msg("colcon asks setup.py for its data and reads what it prints as the answer, so a "
               "print() of yours ends up in the middle of it.")),
    Kind(
        id="build.setup_error",
        stage="build",
        title=msg("setup.py stops with an error"),
        why=WHY,
        fix=msg("Fix what the error names, then build again."),
        whys={"unreadable": msg("colcon runs your setup.py to install the package into the "
                                "workspace's install folder; ros2 run only ever looks there. A "
                                "file that Python cannot read cannot be run.")},
        fixes={"unreadable": msg("Fix that line of setup.py (often the line above lacks a comma, "
                                 "a quote or a bracket), then build again.")},
        link=links.COLCON,
    ),
    _build("entry_unreadable", msg("setuptools stopped at an entry of console_scripts"),
           msg("Look at the entries of console_scripts in setup.py: each is 'name = "
               "package.module:function', and there is a comma after each."),
           msg("setuptools stops at an entry point that it cannot read, and colcon then only says "
               "that distutils.core.setup() was never called."),
           seen=r"'?distutils\.core\.setup\(\)'? was never called"),
    _build("exited", msg("setup.py ends before it has called setup()"),
           msg("Take the exit out of setup.py and compare it with the one that ros2 pkg create "
               "makes."),
           msg("colcon runs your setup.py to install the package into the workspace's install "
               "folder; ros2 run only ever looks there. It has to reach its call of setup(); a "
               "sys.exit() before or in it ends it silently.")),
    _build("timeout", msg("the build does not end"),
           msg("Take the loop, the sleep or the input() out of setup.py."),
           msg("colcon runs your setup.py to install the package into the workspace's install "
               "folder; ros2 run only ever looks there. A setup.py that loops or waits never lets "
               "it finish.")),
    _build("resource", msg("the build met a limit of the sandbox"),
           msg("Let setup.py only describe the package: no large output, no other programs.")),
    _build("failed", msg("the build fails"),
           msg("Read the build log below from its first error on; build again after each change.")),
    _installed("no_exec_bit", msg("the installed executable lost its exec bit"),
               msg("Build again after removing what takes the bit away in setup.py; colcon itself "
                   "writes the file with mode 0755.")),
    _installed("elsewhere", msg("the executable was installed where ros2 run does not look"),
               CONFIG),
    _installed("not_installed", msg("the executable was not installed"),
               msg("Check that entry_points is an argument of setup(), then build again.")),
)  # fmt: skip
