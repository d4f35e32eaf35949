"""The catalogue: a submission that is not a package, or cannot be opened."""

from __future__ import annotations

from typing import TYPE_CHECKING

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.example import CFG, INIT, INNER, MANIFEST, NODE, SETUP, example
from grader.mistakes.kind import Kind, Parts
from grader.package.edit.tree import Copy, Delete, Move, Nest, Replace
from grader.package.intake import archive_problems as archives
from grader.package.intake import problems

if TYPE_CHECKING:
    from typing_extensions import Unpack

UNIT = msg("ROS builds and runs packages. colcon recognises a package by its package.xml.")


def _submission(slug: str, title: str, fix: str, **parts: Unpack[Parts]) -> Kind:
    return Kind(
        id=f"package.{slug}",
        stage="hand-in",
        title=title,
        why=UNIT,
        fix=fix,
        link=links.PACKAGE,
        **parts,
    )


KINDS = (
    _submission("archive_corrupt", msg("The archive cannot be read"), archives.AGAIN),
    _submission(
        "archive_encrypted", msg("The archive is locked with a password"), archives.NO_PASSWORD
    ),
    _submission(
        "archive_unsupported",
        msg("The archive's format is not supported"),
        msg("Hand in a zip or a tar.gz."),
    ),
    _submission(
        "archive_unsafe",
        msg("A path in the archive leads out of it"),
        msg("Paths in an archive must be relative and contain no '..'. Pack it again."),
    ),
    _submission(
        "archive_bomb", msg("The archive unpacks to many times its size"), problems.ONLY_YOURS
    ),
    _submission("archive_too_large", msg("The archive is too large"), problems.ONLY_YOURS),
    _submission(
        "archive_nested",
        msg("The package is in archives within archives"),
        msg("Pack the package once."),
    ),
    _submission(
        "archive_empty",
        msg("The archive is empty"),
        msg("Check that the package is in it before you hand it in."),
    ),
    _submission(
        "archive_inside",
        msg("There is only a file that is named like an archive but is not one"),
        archives.AGAIN,
    ),
    _submission("link", msg("There is only a link to another place"), problems.NOT_THE_LINK),
    _submission(
        "empty",
        msg("Nothing was handed in"),
        msg("Hand in your package: the folder with package.xml and setup.py in it."),
        examples=(
            example(
                "empty_folder",
                Delete(INNER),
                Delete("resource"),
                Delete(MANIFEST),
                Delete(SETUP),
                Delete(CFG),
                fails="package.found",
            ),
        ),
    ),
    _submission(
        "only_build", msg("Only build, install and log were handed in"), problems.NOT_THE_BUILD
    ),
    _submission(
        "only_node",
        msg("Only the node's file was handed in"),
        msg(
            "Hand in the whole folder of the package, with package.xml, setup.py, "
            "setup.cfg and resource/."
        ),
        examples=(
            example(
                "only_the_node",
                Delete("resource"),
                Delete(MANIFEST),
                Delete(SETUP),
                Delete(CFG),
                Delete(INIT),
                Move(NODE, "my_first_node.py"),
                fails="package.found",
                note="only the node's file",
            ),
        ),
    ),
    _submission(
        "manifest_renamed",
        msg("package.xml or setup.py has a different name"),
        msg(
            "Rename the file to exactly package.xml or setup.py: case matters, and nothing "
            "may follow the ending."
        ),
    ),
    _submission("too_large", msg("The package is too large"), problems.ONLY_YOURS),
    Kind(
        id="package.duplicate",
        stage="hand-in",
        title=msg("Two packages have the same name"),
        why=msg(
            "colcon refuses to build two packages with the same name, because it is not clear "
            "which of them ros2 run would start."
        ),
        fix=problems.KEEP_ONE,
        link=links.COLCON_IGNORE,
        seen=r"Duplicate package names not supported",
        examples=(
            example(
                "two_of_one_name",
                Nest("src/my_robot_controller"),
                Copy("src/my_robot_controller", "src/first_try"),
                fails="package.found",
                note="which of the two is meant is unknown",
            ),
            example(
                "backup_beside",
                Nest("src/my_robot_controller"),
                Copy("src/my_robot_controller", "src/backup"),
                Replace(
                    "src/backup/my_robot_controller/my_first_node.py",
                    "import rclpy\n",
                    "import rclpi\n",
                ),
                fails="build.colcon",
                blocking=False,
                note="colcon refuses both, but which one is meant is clear",
            ),
        ),
    ),
)
