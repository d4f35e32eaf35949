"""Tells a class folder from one student's package or workspace."""

from __future__ import annotations

import os
import re
from pathlib import Path

from grader.batch.systems.layout import FolderItem, Layout
from grader.package.intake.archive_kind import is_named_archive
from grader.package.intake.artefacts import COLCON
from grader.package.intake.reading import Unread, read_bytes

DEEPEST = 3  # levels below a student's folder in which a package is searched
MOST_NAMES = 500
NAME = re.compile(rb"<name>\s*([^<\s]{1,200})\s*</name>")
LARGEST_MANIFEST = 1_000_000


def one_package(layout: Layout) -> str:
    """Return "one package" or "one workspace" if a folder is that, else ""."""
    if layout.has("package.xml", "file"):
        return "one package"
    items = layout.submissions()
    if len(items) == 1 and _is_named_like_its_package(layout.path, items[0]):
        return "one package"
    folders = {item.name for item in layout.items if item.kind == "folder"}
    archives = any(item.kind == "archive" for item in layout.items)
    if "src" in folders and folders <= {"src", *COLCON} and not archives:
        return "one workspace"
    return ""


def is_class(layout: Layout) -> bool:
    """Whether a folder is a class, not one student's: most of its items are submissions.

    Packages side by side, each in a folder of its own name, are one student's.
    """
    items = layout.submissions()
    if one_package(layout) or len(items) < 2 or layout.has("setup.py", "file"):
        return False
    submissions = [item for item in items if _is_submission(layout.path, item)]
    packages = [item for item in submissions if _is_named_like_its_package(layout.path, item)]
    return 2 * len(submissions) >= len(items) and len(packages) < len(submissions)


def _is_submission(path: Path, item: FolderItem) -> bool:
    return item.kind == "archive" or (not item.problem and _holds_package(path / item.name))


def _holds_package(folder: Path) -> bool:
    waiting = [(str(folder), 0)]
    names = 0
    while waiting and names < MOST_NAMES:
        place, depth = waiting.pop(0)
        try:
            with os.scandir(place) as entries:
                for entry in entries:
                    names += 1
                    if entry.name in ("package.xml", "setup.py") or is_named_archive(entry.name):
                        return True
                    if depth < DEEPEST and entry.is_dir(follow_symlinks=False):
                        waiting.append((entry.path, depth + 1))
        except OSError:
            continue
    return False


def _is_named_like_its_package(path: Path, item: FolderItem) -> bool:
    if item.kind != "folder" or item.problem:
        return False
    manifest = read_bytes(path / item.name / "package.xml", LARGEST_MANIFEST)
    match = None if isinstance(manifest, Unread) else NAME.search(manifest)
    return match is not None and match[1] == os.fsencode(item.name)
