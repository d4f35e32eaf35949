"""The catalogue: what was handed in is no package, or cannot be opened."""

from __future__ import annotations

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.kind import Kind

UNIT = msg("A package is the unit that ROS builds and runs; colcon knows one by its package.xml.")
AGAIN = msg(
    "Pack the package's folder again, with nothing else in it: "
    "cd ~/ros2_ws/src && tar -czf my_package.tar.gz my_package (with your package's name)."
)
ONLY_YOURS = msg("Hand in only what you wrote: no recordings, data sets or virtual environments.")


def _handed_in(slug: str, title: str, fix: str, why: str = UNIT) -> Kind:
    return Kind(
        id=f"package.{slug}", stage="hand-in", title=title, why=why, fix=fix, link=links.PACKAGE
    )


KINDS = (
    _handed_in("archive_corrupt", msg("The archive cannot be read"), AGAIN),
    _handed_in("archive_encrypted", msg("The archive is locked with a password"),
               msg("Pack it again without a password.")),
    _handed_in("archive_unsupported", msg("The archive is of a kind that is not opened here"),
               msg("Hand in a zip or a tar.gz.")),
    _handed_in("archive_unsafe", msg("A name in the archive leads out of it"),
               msg("Names in an archive are relative and go down only. Pack it again.")),
    _handed_in("archive_bomb", msg("Far more comes out of the archive than is in it"), ONLY_YOURS),
    _handed_in("archive_too_large", msg("The archive is too large"), ONLY_YOURS),
    _handed_in("archive_nested", msg("The package is in archives within archives"),
               msg("Pack the package once.")),
    _handed_in("archive_empty", msg("The archive is empty"),
               msg("See that the package is in it before you hand it in.")),
    _handed_in("archive_inside", msg("There is only a file that is called an archive"), AGAIN),
    _handed_in("link", msg("There is only a link to elsewhere"),
               msg("Hand in the folder that the link leads to, not the link.")),
    _handed_in("empty", msg("Nothing was handed in"),
               msg("Hand in your package: the folder with package.xml and setup.py in it.")),
    _handed_in("only_build", msg("Only build, install and log were handed in"),
               msg("Hand in the package from the workspace's src folder: build, install and log "
                   "are generated from it and do not replace it.")),
    _handed_in("only_node", msg("Only the node's file was handed in"),
               msg("Hand in the whole folder of the package, with package.xml, setup.py, "
                   "setup.cfg and resource/.")),
    _handed_in("manifest_renamed", msg("package.xml or setup.py has another name"),
               msg("Give the file exactly its name: capitals count, and nothing may follow the "
                   "ending.")),
    _handed_in("too_large", msg("The package is too large"), ONLY_YOURS),
    Kind(
        id="package.duplicate",
        stage="hand-in",
        title=msg("Two packages have the same name"),
        why=msg("colcon refuses to build two packages of one name, for nobody could say which of "
                "them ros2 run would start."),
        fix=msg("Keep one of them. Move a backup copy out of the workspace (or put an empty "
                "file COLCON_IGNORE into it)."),
        link=links.COLCON_IGNORE,
        seen=r"Duplicate package names not supported",
    ),
)  # fmt: skip
