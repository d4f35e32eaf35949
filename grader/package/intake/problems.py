"""Why there is no package to grade: what was found, and the fix."""

from __future__ import annotations

import re
from dataclasses import dataclass

from grader.base.i18n.message import Message, msg, say
from grader.base.shown import shown
from grader.package.intake.archive_kind import is_named_archive
from grader.package.intake.tree import MADE_BY_TOOLS, Tree

NEAR_NAME = re.compile(r"package\.xml\.\w{1,10}|setup\.py\.\w{1,10}|package\.xml|setup\.py", re.I)
ONLY_YOURS = msg("Hand in only what you wrote: no recordings, data sets or virtual environments.")
NOT_THE_LINK = msg("Hand in the folder that the link leads to, not the link.")
NOT_THE_BUILD = msg(
    "Hand in the package from the workspace's src folder: build, install and log are generated "
    "from it and do not replace it."
)
KEEP_ONE = msg(
    "Keep one of them. Move a backup copy out of the workspace (or put an empty file COLCON_IGNORE "
    "into it)."
)
CREATE = "ros2 pkg create --build-type ament_python {package}"


@dataclass(frozen=True)
class Problem:
    """The mistake's id, a sentence that states what was found, and the fix."""

    mistake: str
    text: str
    fix: str


def duplicate(paths: list[str], package: str) -> Problem:
    """Several packages have the right name: colcon refuses, and which one is meant is unknown."""
    places = ", ".join(shown(path) for path in paths[:3])
    return Problem(
        "package.duplicate",
        say(
            "There are {count} packages called {package}: in {places}.",
            count=len(paths),
            package=package,
            places=places,
        ),
        Message(KEEP_ONE),
    )


def too_large(reason: str, root: str) -> Problem:
    """A package beyond the limits of intake."""
    return Problem(
        "package.too_large",
        say(
            "The package in {root} is too large to grade: {reason}.",
            root=shown(root),
            reason=reason,
        ),
        Message(ONLY_YOURS),
    )


def no_package(tree: Tree, *, package: str, node_file: str) -> Problem:
    """No folder contains a package.xml or a setup.py."""
    create = CREATE.format(package=package)
    files = [path for path, entry in tree.entries.items() if entry.kind == "file"]
    names = {path: path.rpartition("/")[2] for path in files}
    near = [path for path, name in names.items() if NEAR_NAME.fullmatch(name)]
    if near:
        wanted = "package.xml" if "package" in names[near[0]].lower() else "setup.py"
        return Problem(
            "package.manifest_renamed",
            say("There is no package.xml or setup.py, but a file {file}.", file=shown(near[0])),
            say(
                "Rename it to exactly {wanted}: case matters, and nothing may follow the ending.",
                wanted=wanted,
            ),
        )
    archives = [path for path, name in names.items() if is_named_archive(name)]
    if archives and len(files) == len(archives):
        return Problem(
            "package.archive_inside",
            say(
                "There is no package in the folder, only a file that is named like an archive "
                "but is not one: {file}.",
                file=shown(archives[0]),
            ),
            say(
                "Pack the package's folder again (renaming a file does not make it an archive), "
                "and open the archive once before you hand it in."
            ),
        )
    links = list(tree.links().items())
    if not files and links:
        place = " -> ".join(links[0])
        return Problem(
            "package.link",
            say("There is no package, only a link to another place: {place}.", place=shown(place)),
            Message(NOT_THE_LINK),
        )
    if not files:
        return _nothing(tree, create)
    nodes = [path for path, name in names.items() if name == node_file]
    if nodes and len(files) == 1:
        return Problem(
            "package.only_node",
            say(
                "Only the file {file} was handed in, without its package.",
                file=shown(nodes[0]),
            ),
            say(
                "Hand in the whole folder {package}, with package.xml, setup.py, setup.cfg and "
                "resource/. If you have none yet, create it with: {create}",
                package=package,
                create=create,
            ),
        )
    some = ", ".join(shown(path) for path in sorted(files)[:4])
    more = say(" and {count} more", count=len(files) - 4) if len(files) > 4 else ""
    return Problem(
        "package.no_manifest",
        say(
            "No folder contains a package.xml or a setup.py. Files found: {some}{more}.",
            some=some,
            more=more,
        ),
        say(
            "Hand in the folder {package} that contains package.xml and setup.py. If you have none "
            "yet, create it with: {create}",
            package=package,
            create=create,
        ),
    )


def _nothing(tree: Tree, create: str) -> Problem:
    made = tree.left_out.places(MADE_BY_TOOLS)
    if made:
        return Problem(
            "package.only_build",
            say(
                "There are only generated files ({folders}) and no source.",
                folders=", ".join(made),
            ),
            Message(NOT_THE_BUILD),
        )
    rest = tree.left_out.lines()
    return Problem(
        "package.empty",
        say("The folder is empty.")
        if not rest
        else say("There is no file to grade. {reason}.", reason=rest[0]),
        say(
            "Hand in your package. If you have none yet, create it in ~/ros2_ws/src with: {create}",
            create=create,
        ),
    )
