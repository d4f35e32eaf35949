"""A lab on a pseudo-terminal, used by typing as a student does."""

from __future__ import annotations

import os
import re
import sys
from collections.abc import Mapping
from pathlib import Path

import pexpect

from grader.base.cache import cache_root
from tests import processes
from tests.domains import new_domain
from tests.lab.kinds import Kind

PROMPT = re.compile(r"student@lab-\w+:[^\n$]*\$ ")
WAIT = 60  # seconds for one command, including a build on a busy machine


def command(*words: str | Path) -> list[str]:
    """Return the command line of this checkout's lab."""
    return [sys.executable, "-m", "lab", *map(str, words)]


def environment(**more: str) -> dict[str, str]:
    """Return a caller's environment variables; the cache is root's, as in a computer lab."""
    inherited = {k: v for k, v in os.environ.items() if not k.startswith(("SUDO_", "ROS_"))}
    own = {"TERM": "dumb", "GRADER_CACHE": str(cache_root())}
    return inherited | own | more


class Lab:
    """An open lab; `screen` is its pexpect terminal."""

    def __init__(
        self,
        kind: Kind,
        workspace: Path,
        *,
        env: Mapping[str, str] | None = None,
        user: bool = False,
        distro: str = "jazzy",
    ) -> None:
        words = command("--sandbox", kind.sandbox, "--workspace", workspace, "--distro", distro)
        words = processes.as_user(words) if user else words
        self.screen = pexpect.spawn(
            words[0],
            words[1:],
            cwd=str(processes.ROOT),
            env=environment(**{"ROS_DOMAIN_ID": new_domain(), **kind.env, **(env or {})}),
            encoding="utf-8",
            timeout=WAIT,
            dimensions=(40, 200),
        )
        self.screen.delaybeforesend = None
        self.welcome = self.wait_for_prompt()

    def __enter__(self) -> Lab:
        return self

    def __exit__(self, *_: object) -> None:
        self.screen.close(force=True)

    def wait_for_prompt(self) -> str:
        """Return the output up to the prompt."""
        self.screen.expect(PROMPT)
        return str(self.screen.before).replace("\r", "")

    def type(self, line: str) -> str:
        """Type a line and return its output."""
        self.screen.sendline(line)
        return self.wait_for_prompt().removeprefix(line + "\n")

    def status(self) -> int:
        """Return the exit status of the last command."""
        return int(self.type("echo $?"))

    def write(self, file: str, text: str) -> None:
        """Write a file with a here-document."""
        self.screen.sendline(f"cat > {file} << 'END'")
        for line in text.splitlines():
            self.screen.sendline(line)
        self.screen.sendline("END")
        self.wait_for_prompt()

    def interrupt(self) -> str:
        """Press Ctrl+C and return the output up to the prompt."""
        self.screen.sendintr()
        return self.wait_for_prompt()

    def leave(self) -> int:
        """Type `exit` and return the lab's exit status."""
        self.screen.sendline("exit")
        self.screen.expect(pexpect.EOF)
        self.screen.close()
        return int(self.screen.exitstatus if self.screen.exitstatus is not None else -1)
