"""A beginner's hour: what was done wrong is named by guide, check and hint, on one screen each."""

from __future__ import annotations

import json
import os
import re
from collections.abc import Iterator
from dataclasses import asdict, dataclass
from itertools import dropwhile
from pathlib import Path

import pytest

from grader.base.i18n.message import say
from grader.base.i18n.translator import Translator
from grader.report.wrap import rows
from grader.ros.prefix import Ros
from tests.domains import new_domain
from tests.lab import beginner
from tests.lab.beginner import STATES, State
from tests.lab.kinds import Kind
from tests.lab.screen import Lab
from tests.lab.workspaces import open_to_all

LINES, COLUMNS = 24, 80
AROUND = 2  # lines: the command, and the next prompt
WORKING = re.compile(r"^.* \.\.\.\n", re.MULTILINE)
"""What a terminal without a cursor keeps of what is shown while a check works."""
STEPS = (
    ("package", f"cd ~/ros2_ws/src && {beginner.CREATE}\n{beginner.AND_BUILD}"),
    ("node", f"{beginner.WRITTEN}\n{beginner.ENTERED}\n{beginner.AND_BUILD}"),
    ("lesson 2", ":"),
    (
        "circle",
        f"{beginner.CIRCLE_WRITTEN}\n{beginner.CIRCLE_ENTERED}\n{beginner.DEPENDS}\n"
        f"{beginner.AND_BUILD}",
    ),
)
MADE = ("src", "build", "install", "log")
OF_ROOT = "files of another user"
SLOW = 240  # seconds for one command on a busy machine
BETWEEN = "----"
PYTHON = "/opt/ros2_teaching_lab/.venv/bin/python -I"
HINTS = f"""\
import contextlib, io, sys

sys.path.insert(0, "/opt/ros2_teaching_lab")
from lab.commands.cli import main
from lab.guide.cli import main as guide

guide([])
print("{BETWEEN}", flush=True)
for _ in range(2):
    with contextlib.redirect_stdout(io.StringIO()):
        main(["hint"])
main(["hint"])
"""
"""The guide, and the third hint: as one program, which starts faster than four."""
KEPT = os.environ.get("BEGINNER_OUT")
"""A file that gets a line of JSON for each state: what was said, and how many lines it took."""


@dataclass(frozen=True)
class Said:
    """What guide, check, the guide after it, and the third hint said."""

    guide: str
    check: str
    after: str
    hint: str


class Desk:
    """A lab with two terminals of 24 lines, and copies of the workspace at points of the lessons."""

    def __init__(self, folder: Path) -> None:
        self.workspace = folder / "ros2_ws"
        self._domain = new_domain()
        self.lab, self.other = (self._terminal() for _ in range(2))
        self._keep("empty")
        for name, lines in STEPS:
            self.type(lines)
            self._keep(name)
        (self.workspace / ".lab/home/hints.py").write_text(HINTS, encoding="utf-8")

    def _terminal(self) -> Lab:
        env = {"ROS_DOMAIN_ID": self._domain}  # (terminals of one lab see each other's nodes)
        opened = Lab(Kind("bubblewrap"), self.workspace, env=env)
        opened.screen.timeout = SLOW
        opened.screen.setwinsize(LINES, COLUMNS)  # (bash shows its prompt again)
        opened.screen.sendline("echo the size is set")
        opened.screen.expect_exact("\nthe size is set")
        opened.wait_for_prompt()
        # (the prompt's own words are other tests' matter, and cost a second each)
        opened.type('lab() { [ "$1" = notice ] || command lab "$@"; }')
        return opened

    def _keep(self, name: str) -> None:
        self.type(
            f"mkdir -p ~/kept/{name!r}; for each in {' '.join(MADE)}; do"
            f" [ -e ~/ros2_ws/$each ] && cp -a ~/ros2_ws/$each ~/kept/{name!r}/; done"
        )

    def type(self, lines: str) -> str:
        """Type lines in the terminal, as a file that it reads, and return what they print."""
        (self.workspace / ".lab/home/typed").write_text(f"{lines}\n", encoding="utf-8")
        return self.lab.type(". ~/typed")

    def play(self, state: State, name: str, lang: str) -> Said:
        """Bring the workspace to the state; return what is said there."""
        self.type(
            f"cd ~; rm -rf ~/my_robot* ~/ros2_ws/my_robot* ~/ros2_ws/.lab/{{progress.json,ran}}\n"
            f"for each in {' '.join(MADE)}; do rm -rf ~/ros2_ws/$each; done\n"
            f"cp -a ~/kept/{state.begin!r}/. ~/ros2_ws/; cd ~/ros2_ws; : > ~/ros2_ws/.lab/ran\n"
            f"unset AMENT_PREFIX_PATH; . /opt/ros/$ROS_DISTRO/setup.bash\n"
            f"export GRADER_ASSIGNMENT={state.lesson} GRADER_LANG={lang}\n{state.types}\n"
            "cd ~/ros2_ws"  # (the prompt is one line there)
        )
        for line in state.runs:
            self.lab.screen.sendline(line)
            if state.ctrl:
                self.lab.screen.expect_exact("Hello time: 1")
                self.lab.screen.sendcontrol(state.ctrl)
            self.lab.wait_for_prompt()
        if name == OF_ROOT:
            os.chown(self.workspace / "src/my_robot_controller/setup.py", 0, 0)
        if state.running:
            self.other.screen.sendline(f"{beginner.SOURCE}; {state.running}")
            self.other.screen.expect_exact("Hello time: 1")
        try:
            guide, check = (self.shown(each) for each in ("guide", "check"))
            check = WORKING.sub("", check)
            after, hint = self.shown(f"{PYTHON} ~/hints.py").split(BETWEEN)
            return Said(guide, check, after.strip("\n"), hint.strip("\n"))
        finally:
            if state.running:
                self.other.interrupt()
            self.type("for each in $(jobs -p); do kill -KILL -- -$each; done; wait 2> /dev/null")

    def shown(self, command: str) -> str:
        """Return what a command shows on the terminal."""
        said = self.type(command).replace(". ~/typed", "")
        return re.sub(r"\x1b\[[0-9;?]*[A-Za-z]|\x1b\]8;[^\x1b]*\x1b\\", "", said).strip("\n")


@pytest.fixture(scope="module")
def desk(ros_jazzy: Ros) -> Iterator[Desk]:
    """A desk for all states."""
    del ros_jazzy
    with open_to_all() as folder:
        opened = Desk(folder)
        with opened.lab, opened.other:
            yield opened


PLAYED = [
    pytest.param(name, lang, id=f"{name}-{lang}")
    for lang in ("en", "ko")
    for name, state in STATES.items()
    if lang == "en" or state.korean
]


@pytest.mark.long
@pytest.mark.parametrize(("name", "lang"), PLAYED)
def test_what_a_beginner_did_is_named_everywhere(name: str, lang: str, desk: Desk) -> None:
    state = STATES[name]
    if name == OF_ROOT and os.getuid() != 0:
        pytest.skip("only root can give files away")
    said = desk.play(state, name, lang)
    if KEPT:
        with Path(KEPT).open("a", encoding="utf-8") as file:
            told = {"name": name, "lang": lang, **asdict(said)}
            file.write(json.dumps(told, ensure_ascii=False) + "\n")
    assert faults(state, said, lang) == []


def faults(state: State, said: Said, lang: str) -> list[str]:
    """Return what a beginner would miss in what was said."""
    found: list[str] = []
    translate = Translator(lang)
    begin, end = (translate(text) for text in (say("Next: "), say("More: lab hint")))
    told = (translate(say("Found: ")), begin, translate(say("All steps of this lesson are done.")))
    for key, text in asdict(said).items():
        wanted = state.first if key == "guide" and state.first else state.says
        heard = _words(
            "\n".join(dropwhile(lambda line: not line.startswith(told), text.split("\n")))
        )
        heard = heard if key in ("guide", "after") else _words(text)  # (not what the step says)
        found += [f"{key} lacks {w}" for w in wanted if not _has(f"{heard} ", w)]
        if (lines := rows(text, COLUMNS) + AROUND) > LINES:
            found.append(f"{key} has {lines} lines")
    now = _next(said.after, begin, end) or said.after.splitlines()[-1]
    found += [
        f"{key} lacks {now}" for key in ("check", "hint") if now not in _words(getattr(said, key))
    ]
    return found


def _has(text: str, wanted: str) -> bool:
    """Whether a text has what is wanted, in any language."""
    if "|" in wanted:
        return any(_has(text, each) for each in wanted.split("|"))
    if wanted.startswith("@"):
        line = wanted[1:]
        return re.search(rf"(?:\.\w+:|line ){line}\b|\b{line}번", text) is not None
    return " ".join(wanted.split()) in text or wanted in text


def _words(text: str) -> str:
    """Return a text without its line breaks: those of commands, too."""
    return " ".join(text.replace("\\\n", "\n").split())


def _next(guide: str, begin: str, end: str) -> str:
    """Return what the guide says to do next, as one line."""
    _, is_there, rest = guide.rpartition(f"\n{begin}")
    return _words(rest.partition(end)[0]) if is_there else ""
