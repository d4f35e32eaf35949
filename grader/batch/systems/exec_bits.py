"""Detects whether a class lost its exec bits: without a single one, they were lost on the way."""

from __future__ import annotations

import os
import stat
from collections.abc import Iterator, Sequence
from pathlib import Path

MOST_FOLDERS = 200  # searched for one student
DEEPEST = 8
AT_LEAST = 2  # submissions: one student alone may have forgotten it


def no_exec_bits(paths: Sequence[Path]) -> bool:
    """Whether several folders have Python files and none of these files is executable."""
    with_files = 0
    for path in paths:
        any_file = False
        for mode in _modes(path):
            any_file = True
            if mode & 0o111:
                return False
        with_files += any_file
    return with_files >= AT_LEAST


def _modes(root: Path) -> Iterator[int]:
    waiting = [(str(root), 0)]
    for _ in range(MOST_FOLDERS):
        if not waiting:
            return
        folder, depth = waiting.pop()
        try:
            with os.scandir(folder) as entries:
                for entry in entries:
                    if entry.is_dir(follow_symlinks=False):
                        if depth < DEEPEST and not entry.name.startswith("."):
                            waiting.append((entry.path, depth + 1))
                    elif entry.name.endswith(".py") and not entry.is_symlink():
                        status = entry.stat(follow_symlinks=False)
                        if stat.S_ISREG(status.st_mode):
                            yield status.st_mode
        except OSError:
            continue
