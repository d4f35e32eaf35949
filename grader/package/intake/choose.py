"""Choose the package to grade among the folders that look like packages."""

from __future__ import annotations

import difflib
from dataclasses import dataclass

from grader.base.i18n.message import say
from grader.base.shown import shown
from grader.package.intake.copies import original
from grader.package.intake.model import Candidate
from grader.package.intake.problems import Problem, duplicate, no_package
from grader.package.intake.reading import Unread
from grader.package.intake.tree import Tree, ancestors, join, parent
from grader.package.source.manifest import name_in
from grader.package.source.setup_py import literal_name

MANIFEST, SETUP, IGNORE = "package.xml", "setup.py", "COLCON_IGNORE"
MOST_CANDIDATES = 50
MOST_NAMING_BYTES = 64_000
"""How much of a package.xml or setup.py is read to learn the package's name."""
TOO_MANY = say("not examined, as there are more than {count} packages", count=MOST_CANDIDATES)


@dataclass(frozen=True)
class Choice:
    """The chosen candidate, or the problem; `hints` are for the student.

    `copies` are other packages with its name that colcon would find too.
    """

    chosen: Candidate | None
    hints: tuple[str, ...] = ()
    copies: tuple[str, ...] = ()
    problem: Problem | None = None


def find_candidates(tree: Tree) -> list[Candidate]:
    """Return every folder that holds a package.xml or a setup.py, outer ones first.

    Like colcon, it does not look into hidden folders, unless all are in one: the hidden folder may
    be the workspace.
    """
    found = {
        parent(path)
        for path in tree.entries
        if path.rpartition("/")[2] in (MANIFEST, SETUP) and tree.file(path) is not None
    }
    folders = {folder for folder in found if not hidden_part(folder)}
    ordered = sorted(folders or found, key=lambda folder: (len(ancestors(folder)), folder))
    if len(ordered) > MOST_CANDIDATES:
        tree.left_out.add(TOO_MANY, ordered[-1])
    return [Candidate(f, _name(tree, f)) for f in ordered[:MOST_CANDIDATES]]


def hidden_part(path: str) -> str:
    """Return the name of the first hidden folder of a path, "" if it has none."""
    return next((p for p in path.split("/") if p.startswith(".") and p != "."), "")


def _name(tree: Tree, folder: str) -> str:
    """Return a package's name: from package.xml, else setup.py, else its folder."""
    for file, read in ((MANIFEST, name_in), (SETUP, literal_name)):
        entry = tree.file(join(folder, file))
        if entry is not None:
            found = tree.place.read(entry.path, MOST_NAMING_BYTES)
            name = None if isinstance(found, Unread) else read(found)
            if name:
                return shown(name)
    return shown(tree.place.name if folder == "." else folder.rpartition("/")[2])


def choose(tree: Tree, candidates: list[Candidate], *, package: str, node_file: str) -> Choice:
    """Choose by the assignment's package name, among the folders that colcon would find."""
    if not candidates:
        return Choice(None, problem=no_package(tree, package=package, node_file=node_file))
    seen = [c for c in candidates if not _ignored(tree, c)]
    right = _outermost([c for c in seen if c.name == package])
    # colcon does not search inside a package: prefer a package that is not nested in another
    free = [c for c in right if not _around(c, seen)]
    same = free or right
    chosen = original(tree, same, package=package, node_file=node_file) if same else None
    if same and chosen is None:
        return Choice(None, problem=duplicate([c.path for c in same], package))
    copies = tuple(c.path for c in same if c is not chosen)
    if chosen is None:
        chosen = next((c for c in candidates if c.name == package), None)
    if chosen is None:
        return _nearest(tree, seen or candidates, package=package, node_file=node_file)
    return Choice(chosen, tuple(_hints(tree, chosen, candidates)), copies)


def _ignored(tree: Tree, candidate: Candidate) -> bool:
    return any(join(folder, IGNORE) in tree.entries for folder in ancestors(candidate.path))


def _outermost(candidates: list[Candidate]) -> list[Candidate]:
    return [c for c in candidates if not _around(c, candidates)]


def _around(candidate: Candidate, others: list[Candidate]) -> list[Candidate]:
    """Return the others in which the candidate is nested, the outermost first."""
    above = set(ancestors(candidate.path)) - {candidate.path}
    return [other for other in others if other.path in above]


def _nearest(tree: Tree, wrong: list[Candidate], *, package: str, node_file: str) -> Choice:
    """Choose the nearest candidate, with a hint, since none has the right name."""

    def likeness(candidate: Candidate) -> tuple[bool, float, int]:
        start = "" if candidate.path == "." else f"{candidate.path}/"
        has_node = any(p.startswith(start) and p.endswith(f"/{node_file}") for p in tree.entries)
        ratio = difflib.SequenceMatcher(None, candidate.name, package).ratio()
        return has_node, ratio, -len(ancestors(candidate.path))

    best = max(wrong, key=likeness)
    hints = _hints(tree, best, wrong)
    if len(wrong) > 1:
        names = ", ".join(f"{c.name} ({shown(c.path)})" for c in wrong[:5])
        hints.insert(
            0,
            say(
                "No package is called {package}; of {names}, {name} was graded.",
                package=package,
                names=names,
                name=best.name,
            ),
        )
    return Choice(best, tuple(hints))


def _moved(tree: Tree, outer: Candidate, inner: Candidate) -> bool:
    """Whether a folder is no second package, but has the one file that the outer package lacks."""
    files = [name for name in (MANIFEST, SETUP) if tree.file(join(inner.path, name)) is not None]
    return len(files) == 1 and tree.file(join(outer.path, files[0])) is None


def _hints(tree: Tree, chosen: Candidate, candidates: list[Candidate]) -> list[str]:
    hints: list[str] = []
    outer = _around(chosen, candidates)
    if outer:
        hints.append(
            say(
                "{path} is inside another package ({name}, in {outer}): colcon stops at the "
                "outer one and never builds the inner one. It was graded as if they were side by "
                "side. Put packages side by side in src.",
                path=shown(chosen.path),
                name=outer[0].name,
                outer=shown(outer[0].path),
            )
        )
    inner = [c for c in candidates if chosen in _around(c, candidates)]
    inner = [c for c in inner if not _moved(tree, chosen, c)]
    if inner and tree.file(join(inner[0].path, MANIFEST)) is None:
        hints.append(
            say(
                "There is another setup.py in {path}. colcon does not read it: it builds the package "
                "with the setup.py beside package.xml. Delete it.",
                path=shown(inner[0].path),
            )
        )
    elif inner and inner[0].name == chosen.name:
        hints.append(
            say(
                "There is another package of the same name inside this one ({path}): ros2 pkg "
                "create was run inside the package. colcon stops at the outer one and never builds "
                "the inner one. Move your own code out of the inner one, and delete its package.xml, "
                "setup.py, setup.cfg and resource.",
                path=shown(inner[0].path),
            )
        )
    elif inner:
        hints.append(
            say(
                "There is another package inside this one ({path}): colcon stops at the outer "
                "one and never builds the inner one. Put packages side by side in src.",
                path=shown(inner[0].path),
            )
        )
    hidden = hidden_part(chosen.path)
    if hidden:
        hints.append(
            say(
                "The package is in the folder {folder}. colcon does not look into folders whose "
                "names begin with a dot. Give the folder another name.",
                folder=shown(hidden),
            )
        )
    if _ignored(tree, chosen):
        hints.append(
            say(
                "There is a file {ignore} in or above the package, so colcon skips the package "
                "and prints '0 packages finished'. Delete {ignore}.",
                ignore=IGNORE,
            )
        )
    return hints
