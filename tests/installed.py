"""Programs that the tests install: Debian packages, and npm packages by locked hashes."""

from __future__ import annotations

import hashlib
import os
import shutil
import subprocess
import tempfile
from pathlib import Path

from grader.base.cache import cache_root, make_once
from grader.base.lock import locked

FILES = ("package.json", "package-lock.json")


def installed(program: str, package: str) -> Path:
    """Return a program's path; install its Debian package if it is missing and we are root."""
    if found := shutil.which(program):
        return Path(found)
    if os.geteuid() != 0:
        raise RuntimeError(f"the tests need {program}: apt-get install {package}")
    lock = Path(tempfile.gettempdir()) / "ros2_teaching_lab-apt.lock"
    with locked(lock):  # test processes run concurrently
        if not shutil.which(program):
            env = {**os.environ, "DEBIAN_FRONTEND": "noninteractive"}
            for words in (["update"], ["install", "-y", "--no-install-recommends", package]):
                subprocess.run(["apt-get", "-q", *words], env=env, check=True, capture_output=True)
    return Path(shutil.which(program) or f"{program} is still missing")


def npm_packages(project: Path) -> Path:
    """Return the node_modules of a folder's package-lock.json, fetched once.

    npm refuses a package whose hash differs from the lock's.
    """
    digest = hashlib.sha256((project / FILES[1]).read_bytes()).hexdigest()[:16]
    folder = cache_root() / "npm" / digest

    def fetch(staging: Path) -> None:
        for name in FILES:
            shutil.copy(project / name, staging / name)
        words = [str(installed("npm", "npm")), "ci", "--ignore-scripts", "--no-audit", "--no-fund"]
        done = subprocess.run(words, cwd=staging, capture_output=True, text=True, check=False)
        if done.returncode != 0:
            raise RuntimeError(f"npm ci ended with {done.returncode}:\n{done.stderr[-2000:]}")

    make_once(folder, fetch, notify=lambda text: None)
    return folder / "node_modules"
