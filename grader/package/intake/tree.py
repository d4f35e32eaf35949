"""The contents of a folder or an archive, listed without following any link."""

from __future__ import annotations

import unicodedata
from collections import deque
from dataclasses import dataclass, field, replace

from grader.base.i18n.message import say
from grader.package.intake.archive_kind import is_named_archive
from grader.package.intake.artefacts import (
    COLCON,
    LAB,
    SUBMIT,
    is_colcon_artefact,
    is_only_copy,
    is_tool_file,
    is_tool_folder,
)
from grader.package.intake.left_out import LeftOut
from grader.package.intake.links import follow
from grader.package.intake.place import Entry, Place

MOST_LEVELS = 32
"""How many folders deep a submission is read."""
MOST_IN_FOLDER = 5_000
"""How many names of one folder are read."""
MOST_ENTRIES = 50_000
"""How many names are read in total, nearest to the top first."""
LONGEST_TARGET = 1_000
"""The longest link target (characters) that is kept."""

MADE_BY_TOOLS = say("left out, as tools generate it")
LEADS_OUT = say("left out, as it is a link that leads out of the package")
SPECIAL = say("left out, as it is neither a file nor a folder (a device, named pipe or socket)")
BAD_NAME = say("left out, as its name is not plain UTF-8 text")
TOO_DEEP = say("not read, as it is more than {count} folders deep", count=MOST_LEVELS)
TOO_FULL = say("only the first {count} names were read in", count=MOST_IN_FOLDER)
TOO_MANY = say(
    "not read, as there are more than {count} files and folders",
    count=MOST_ENTRIES,
)


@dataclass
class Tree:
    """All entries found; `truncated` are the folders of which not every name was read,
    `labs` the folders in which the lab keeps its own, `links_out` the package's links (relative to
    it) that lead out of it, `made` the folders build and install of colcon, which are left out.
    """

    place: Place
    entries: dict[str, Entry] = field(default_factory=dict)
    left_out: LeftOut = field(default_factory=LeftOut)
    git: set[str] = field(default_factory=set)
    labs: set[str] = field(default_factory=set)
    truncated: set[str] = field(default_factory=set)
    links_out: list[str] = field(default_factory=list)
    made: list[str] = field(default_factory=list)

    def below(self, folder: str) -> dict[str, Entry]:
        """Return the entries below a folder, by their path relative to it, sorted by path."""
        if folder == ".":
            return dict(sorted(self.entries.items()))
        start = f"{folder}/"
        return {
            path[len(start) :]: entry
            for path, entry in sorted(self.entries.items())
            if path.startswith(start)
        }

    def links(self) -> dict[str, str]:
        """Return every link's path and target."""
        return {path: e.target for path, e in self.entries.items() if e.kind == "link"}

    def file(self, path: str) -> Entry | None:
        """Return the file at a path, or the file of the tree to which a link there leads."""
        entry = self.entries.get(path)
        if entry is not None and entry.kind == "link":
            place = follow(path, self.links()).place
            entry = self.entries.get(place) if place is not None else None
        return entry if entry is not None and entry.kind == "file" else None


def join(folder: str, name: str) -> str:
    """Return the path of a name in a folder of the tree, whose root is `.`."""
    return name if folder == "." else f"{folder}/{name}"


def parent(path: str) -> str:
    """Return the folder of a path in the tree."""
    return path.rpartition("/")[0] or "."


def ancestors(path: str) -> list[str]:
    """Return a folder of the tree and all above it, up to the tree's root."""
    found = [path]
    while found[-1] != ".":
        found.append(parent(found[-1]))
    return found


def look(place: Place) -> Tree:
    """Return the tree of a place; OSError only if the place itself cannot be read."""
    tree = Tree(place)
    for reason, where in place.remarks():
        tree.left_out.add(reason, where)
    waiting = deque([(".", 0)])
    while waiting:
        folder, depth = waiting.popleft()
        if len(tree.entries) >= MOST_ENTRIES:
            tree.left_out.add(TOO_MANY, folder)
            tree.truncated.add(folder)
            continue
        try:
            found = _names(tree, folder)
        except OSError as error:
            if folder == ".":
                raise
            tree.left_out.add(
                say("a folder that cannot be read ({reason})", reason=str(error.strerror)),
                folder,
            )
            continue
        for child in _sort(tree, folder, found):
            if child.kind == "folder" and depth + 1 >= MOST_LEVELS:
                tree.left_out.add(TOO_DEEP, child.path)
            elif child.kind == "folder":
                waiting.append((child.path, depth + 1))
    return tree


def _names(tree: Tree, folder: str) -> list[str]:
    found: list[str] = []
    for name in tree.place.names(folder):
        if len(found) >= MOST_IN_FOLDER:
            tree.left_out.add(TOO_FULL, folder)
            tree.truncated.add(folder)
            break
        found.append(name)
    return sorted(found)


def _sort(tree: Tree, folder: str, names: list[str]) -> list[Entry]:
    """Add the entries that are kept to the tree and return them; note the student's others."""
    kept = []
    found = {name: _entry(tree, join(folder, name)) for name in names}
    beside = COLCON & {name for name, e in found.items() if e is not None and e.kind == "folder"}
    artefacts = {
        name for name in beside if is_colcon_artefact(tree.place, join(folder, name), beside)
    }
    for name, entry in found.items():
        if entry is None:
            continue
        if name == ".git" and entry.kind != "link":
            tree.git.add(folder)
        if name == LAB and entry.kind == "folder":
            tree.labs.add(folder)
            continue
        if _is_handed_in(tree, folder, name):
            continue
        if entry.kind == "folder" and (name in artefacts or is_tool_folder(tree.place, entry.path)):
            tree.left_out.add(MADE_BY_TOOLS, f"{entry.path}/")
            tree.made += [entry.path] if name in ("build", "install") else []
        elif entry.kind != "folder" and is_tool_file(name) and not is_only_copy(name, found.keys()):
            tree.left_out.add(MADE_BY_TOOLS, entry.path)
        else:
            tree.entries[entry.path] = entry
            kept.append(entry)
    return kept


def _is_handed_in(tree: Tree, folder: str, name: str) -> bool:
    """Whether a file is an archive that the lab made in its workspace."""
    of_lab = folder.rpartition("/")[2] == SUBMIT and parent(folder) in tree.labs
    return of_lab and is_named_archive(name)


def _entry(tree: Tree, path: str) -> Entry | None:
    """Return the entry at a path; None, with a note, if it is not kept."""
    if not is_plain(path.rpartition("/")[2]):
        tree.left_out.add(BAD_NAME, path)
        return None
    try:
        entry = tree.place.entry(path)
    except OSError as error:
        tree.left_out.add(
            say("left out, as it cannot be accessed ({reason})", reason=str(error.strerror)), path
        )
        return None
    if entry is None:
        tree.left_out.add(SPECIAL, path)
    elif entry.kind == "link":
        # a target that cannot be kept counts as leading out, as an absolute path does
        fits = len(entry.target) <= LONGEST_TARGET and is_plain(entry.target)
        return entry if fits else replace(entry, target="/")
    return entry


def is_plain(name: str) -> bool:
    """Whether a name is UTF-8 text without control characters, line ends or direction overrides.

    (Python represents bytes that are not UTF-8 as lone surrogates, category Cs.)
    """
    if name.isascii():
        return name.isprintable()
    return not any(
        unicodedata.category(c) in ("Cc", "Cs", "Zl", "Zp") or c in "\u202a\u202b\u202d\u202e"
        for c in name
    )
