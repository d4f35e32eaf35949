"""A copy of the build context of Docker's own commands, with this machine's extra certificate."""

from __future__ import annotations

import shutil
from pathlib import Path

import grader
from tests import engine, processes

FOLDERS = ("docker", "grader", "lab", ".devcontainer")
ARGUMENTS = {"BASE": engine.STANDIN, "ROS": "image", "VERSION": grader.__version__}
"""Build arguments with which the layers are those of the tests' images, and need not be made."""


def copy_to(folder: Path) -> Path:
    """Make the copy in `folder` and return its path; the real checkout gets no certificate."""
    for name in FOLDERS:
        shutil.copytree(
            processes.ROOT / name,
            folder / name,
            ignore=shutil.ignore_patterns("__pycache__", "keys", "*.crt"),
        )
    shutil.copy(processes.ROOT / ".dockerignore", folder)
    certificate = engine.network("ros").extra_ca
    if certificate is not None:
        shutil.copy(certificate, folder / "docker" / "ca" / "extra.crt")
    return folder
