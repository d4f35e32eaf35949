"""A student who does only what the guide says, from an empty workspace to an archive."""

from __future__ import annotations

import os
import re
from itertools import takewhile
from pathlib import Path

from grader.base.i18n.message import say
from grader.base.i18n.translator import Translator
from grader.course.load import load_assignment
from tests import processes
from tests.lab.screen import Lab

COMMAND = re.compile(r"^(source|cd|mkdir|ros2|touch|chmod|mv|colcon) ")
NOTICE = re.compile(r"^\S+: \d+\. ")  # of the prompt: which step is done, which is next
TURTLE = "ros2 run turtlesim turtlesim_node"
MOST_ACTIONS = 40
SLOW = 240  # seconds


class Player:
    """Plays a lesson in an open lab. What a student must invent comes from the solution."""

    def __init__(self, lab: Lab, lesson: str, workspace: Path, lang: str) -> None:
        self.lab = lab
        lab.screen.timeout = SLOW  # a build of interfaces beside other tests
        self.workspace = workspace
        self.assignment = load_assignment(
            processes.ROOT / "lab/course" / lesson / "assignment.yaml"
        )
        self._next = Translator(lang)(say("Next: ")).strip()
        self._more = Translator(lang)(say("More: lab hint"))
        solution = processes.ROOT / "grader/keys" / lesson / "solution"
        own = solution / self.assignment.package
        self.solution = own if (own / "package.xml").is_file() else solution
        self.played: list[str] = []

    def play(self) -> None:
        """Do what the guide says until nothing is left; AssertionError if it does not help."""
        for _ in range(MOST_ACTIONS):
            action = self._ask()
            if action is None:
                return
            assert self.played[-2:] != [action, action], f"the guide repeats: {self.played}"
            self.played.append(action)
            self._do(action)
        raise AssertionError(f"no end: {self.played}")

    def _ask(self) -> str | None:
        """Return the guide's next action; None if all steps are done."""
        said = self.lab.type("guide")
        _, begins, rest = f"\n{said}".partition(f"\n{self._next}")
        if not begins:
            return None
        rest = re.sub(r" \\\r?\n +", " ", rest)  # (a shell reads on)
        first, *others = rest.partition(self._more)[0].strip().splitlines()
        if COMMAND.match(first):
            return first.strip()
        wrapped = takewhile(lambda line: not NOTICE.match(line), others)
        return " ".join([first.strip(), *map(str.strip, wrapped)])

    def _do(self, action: str) -> None:
        assignment = self.assignment
        if action.startswith(f"ros2 run {assignment.package}"):
            self._run(action)
        elif action.startswith(TURTLE):
            self._run_until_seen(TURTLE, "/turtlesim")
        elif COMMAND.match(action):
            said = self.lab.type(action)
            assert self.lab.status() == 0, said
        elif "console_scripts" in action:
            (entry,) = re.findall(r"'.* = .*:.*',", action)
            setup = self.workspace / "src" / assignment.package / "setup.py"
            text = setup.read_text()
            setup.write_text(text.replace("'console_scripts': [", f"'console_scripts': [{entry}"))
        elif "<depend>" in action:
            manifest = self.workspace / "src" / assignment.package / "package.xml"
            lines = "\n  ".join(
                ["<depend>rclpy</depend>", *action[action.index("<depend>") :].split()]
            )
            text = manifest.read_text()
            manifest.write_text(text.replace("<depend>rclpy</depend>", lines))
        elif not (self.workspace / "src" / assignment.package / self._inner).is_file():
            self._write_interfaces()
        else:
            text = (self.solution / self._inner).read_text()
            (self.workspace / "src" / assignment.package / self._inner).write_text(text)

    @property
    def _inner(self) -> str:
        return f"{self.assignment.package}/{self.assignment.node_file}"

    def _write_interfaces(self) -> None:
        """Write what the lesson's text says of an interface package."""
        for name in self.assignment.interface_packages:
            theirs = self.solution.parent / name
            for file in (path for path in theirs.rglob("*") if path.is_file()):
                mine = self.workspace / "src" / name / file.relative_to(theirs)
                mine.parent.mkdir(exist_ok=True)
                mine.write_bytes(file.read_bytes())
                owner = self.workspace.stat()
                for path in (mine.parent, mine):
                    os.chown(path, owner.st_uid, owner.st_gid)

    def _run(self, action: str) -> None:
        """Run the node, stop it with Ctrl+C, and check the package."""
        self._run_until_seen(re.split(r"\s{2,}", action)[0], f"/{self.assignment.node_name}")
        output = self.lab.type("check")
        assert self.lab.status() == 0, output

    def _run_until_seen(self, command: str, node: str) -> None:
        """Run a program, and stop it with Ctrl+C when its node is on the graph."""
        self.lab.screen.sendline(
            f"timeout --signal=INT 60 {command} & until ros2 node list | grep -x {node}; do :; done; "
            "kill -INT %1; wait %1; echo ended"
        )
        self.lab.screen.expect_exact("\r\nended")
        self.lab.wait_for_prompt()
