"""The catalogue: Python packages with nodes of their own, beside the main one."""

from __future__ import annotations

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.kind import Family

_beside = Family("beside", links.WORKSPACE)
KINDS = (
    _beside(
        "missing",
        "hand-in",
        msg("Another package of the assignment is missing"),
        msg("The assignment has nodes in several packages. They are built and submitted together."),
        msg("Create {package} in src, beside the other package, and submit both."),
    ),
    _beside(
        "manifest",
        "manifest",
        msg("Another package of the assignment has no readable package.xml"),
        msg("colcon reads package.xml to learn what a folder is, and how it is built."),
        msg("Correct package.xml, or create the package again with ros2 pkg create."),
    ),
    _beside(
        "not_python",
        "manifest",
        msg("Another package of the assignment is not a Python package"),
        msg(
            "The build type decides how colcon builds a package: a Python node needs ament_python."
        ),
        msg("Create {package} with: ros2 pkg create --build-type ament_python {package}"),
    ),
)
