"""Running a program of this package on a pseudo-terminal or in a pipe."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from pathlib import Path

import pexpect

ROOT = Path(__file__).resolve().parents[2]
STYLES = re.compile(r"\x1b\[[0-9;]*m")
SECONDS = 30  # for a program to answer, which takes less than one


def environment(**more: str) -> dict[str, str]:
    kept = {"PATH": os.environ["PATH"], "HOME": os.environ.get("HOME", "/"), "LANG": "C.UTF-8"}
    return {**kept, "PYTHONPATH": str(ROOT), "TERM": "xterm-256color", **more}


def on_a_terminal(module: str, *words: str, columns: int = 80, **env: str) -> pexpect.spawn:
    return pexpect.spawn(
        sys.executable,
        ["-m", f"tests.report.{module}", *words],
        cwd=ROOT,
        env=environment(**env),
        dimensions=(24, columns),
        encoding="utf-8",
        echo=False,
        timeout=SECONDS,
    )


def piped(module: str, *, lines: int = 0, **env: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [sys.executable, "-m", f"tests.report.{module}"],
        cwd=ROOT,
        env=environment(**env),
        input="\n" * lines,
        capture_output=True,
        encoding="utf-8",
        timeout=SECONDS,
        check=True,
    )
