"""The `devcontainer` command."""

from __future__ import annotations

from pathlib import Path

from tests.installed import npm_packages

HERE = Path(__file__).resolve().parent / "devcontainer"
PROGRAM = "@devcontainers/cli/devcontainer.js"


def command() -> list[str]:
    """Return the command line that starts it."""
    return ["node", str(npm_packages(HERE) / PROGRAM)]
