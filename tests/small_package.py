"""Small packages on disk, and their intake."""

from __future__ import annotations

from pathlib import Path

from grader.package.submission import Submission, take_in

PACKAGE = "my_robot_controller"
NODE = "my_first_node.py"
NODE_PATH = f"{PACKAGE}/{NODE}"
XML = "<package format='3'>\n  <name>{}</name>\n</package>\n"


def make(root: Path, name: str = PACKAGE) -> Path:
    """Write a small package to the folder `root`."""
    (root / PACKAGE).mkdir(parents=True)
    (root / "resource").mkdir()
    (root / "resource" / name).touch()
    (root / "package.xml").write_text(XML.format(name))
    (root / "setup.py").write_text(f"from setuptools import setup\nsetup(name='{name}')\n")
    (root / PACKAGE / "__init__.py").touch()
    (root / NODE_PATH).write_text("#!/usr/bin/env python3\n")
    (root / NODE_PATH).chmod(0o755)
    return root


def take(path: Path, name: str | None = None, *, at_work: bool = False) -> Submission:
    return take_in(path, package=PACKAGE, node_file=NODE, name=name, at_work=at_work)


def paths(submission: Submission) -> set[str]:
    return {file.path for file in submission.files}


def notes(submission: Submission) -> str:
    return "\n".join(submission.notes)


def write(root: Path, files: list[str]) -> None:
    for file in files:
        (root / file).parent.mkdir(parents=True, exist_ok=True)
        (root / file).write_text("x")
