"""The dev containers' own command: fetched by npm once, held to the hash in package-lock.json."""

from __future__ import annotations

import hashlib
import shutil
import subprocess
from pathlib import Path

from grader.ros.cache import cache_root
from grader.ros.cache import make_once

HERE = Path(__file__).resolve().parent / "devcontainer"
FILES = ("package.json", "package-lock.json")
PROGRAM = "node_modules/@devcontainers/cli/devcontainer.js"


def command() -> list[str]:
    """Return the words that start it."""
    digest = hashlib.sha256((HERE / FILES[1]).read_bytes()).hexdigest()[:16]
    folder = cache_root() / "npm" / digest
    make_once(folder, _fetch, say=lambda text: None)
    return ["node", str(folder / PROGRAM)]


def _fetch(staging: Path) -> None:
    for name in FILES:
        shutil.copy(HERE / name, staging / name)
    words = ["npm", "ci", "--ignore-scripts", "--no-audit", "--no-fund"]
    done = subprocess.run(words, cwd=staging, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise RuntimeError(f"npm ci ended with {done.returncode}:\n{done.stderr[-2000:]}")
