"""Helpers for the tests of fixes: corpus packages, fixed in memory and with real tools."""

from __future__ import annotations

import shutil
import subprocess
from pathlib import Path

from grader.package.edit.files import Files
from grader.package.edit.tree import Edit
from grader.verdict.fix import FixPlan, fix_files
from tests.corpus.build import write
from tests.corpus.model import Package
from tests.marking import ASSIGNMENT, taken_in

NODE = f"{ASSIGNMENT.package}/{ASSIGNMENT.node_file}"
TOOLS = (("git", "apply", "-"), ("patch", "-p1", "--binary", "--no-backup-if-mismatch"))


def edited(folder: Path, *edits: Edit, name: str = "edited") -> Path:
    """Write the solution with these edits."""
    return write(Package(name=name, edits=edits), folder)


def plan_of(path: Path) -> FixPlan:
    """Return what the files alone have fixed."""
    return fix_files(taken_in(path), ASSIGNMENT)


def contents(files: Files) -> dict[str, bytes]:
    return {path: f.data for path, f in files.by_path.items() if f.kind == "file"}


def with_tool(tool: tuple[str, ...], patch: bytes, root: Path) -> Path:
    """Apply a patch to a copy of a package with one of the tools, and return the copy."""
    copy = root.with_name(f"{root.name}.{tool[0]}")
    shutil.copytree(root, copy, symlinks=True)
    done = subprocess.run(tool, cwd=copy, input=patch, capture_output=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    return copy
