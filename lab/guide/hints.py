"""Three hints for each task: what the state is, where to change it, how.

What a check or a record knows comes first; what it leaves out is made of the task itself.
"""

from __future__ import annotations

import re
from pathlib import Path

from grader.base.i18n.message import joined, say
from grader.report.commands import REMARK, is_command, parts_of
from lab.guide.action import Action
from lab.guide.changes import code
from lab.guide.lesson import Step
from lab.guide.plain import plain_words

COUNT = 3
STUCK = re.compile(r"^\*[^*\n]{1,40}\?\* +(.+?)(?:\n\n|\Z)", re.MULTILINE | re.DOTALL)
"""The paragraph of a step that begins with a question in italics (*Stuck?*)."""
PROSE = re.compile(r"^(?![`|*#<\s\d-])(.+?)(?:\n\n|\Z)", re.MULTILINE | re.DOTALL)
"""A paragraph of a step that is no code, table or list."""
CODE = re.compile(r"^```.*?^```$", re.MULTILINE | re.DOTALL)


def hints_of(action: Action, step: Step, package: Path) -> tuple[str, ...]:
    """Return what, where and how: COUNT hints about a task of a step.

    `package` is the package's folder, as the student types it.
    """
    own = tuple(action.hints)
    if len(own) >= COUNT:
        return own
    where = _where(action, package)
    if len(own) == COUNT - 1:
        return own[0], where, own[1]
    what = own[0] if own else _what(action, step)
    return what, where, _how(action)


def _what(action: Action, step: Step) -> str:
    """Return what the step is for: its paragraph for those who are stuck, else its first one.

    They are about usual mistakes: where another one was found, that is what the hint is about.
    """
    if action.found:
        return action.found
    text = CODE.sub("", step.text)
    for paragraph in (*STUCK.findall(text), *PROSE.findall(text)):
        return plain_words(paragraph)
    return step.title


def _where(action: Action, package: Path) -> str:
    if action.where:
        return action.where
    if action.place:
        file, _, line = (
            action.place.rpartition(":") if ":" in action.place else (action.place, "", "")
        )
        path = f"{package}/{file}"
        if line:
            return say("In {path}, line {line}.", path=path, line=int(line))
        return say("In {path}.", path=path)
    first, *_ = parts_of(action.next) or [""]
    if first.startswith("cd "):
        folder = first.removeprefix("cd ")
        return say("In a terminal of this lab, in {folder}: cd takes you there.", folder=folder)
    if is_command(action.next):
        return say("In a terminal of this lab, in any folder.")
    return say("In {path}.", path=str(package))


def _how(action: Action) -> str:
    if not is_command(action.next):
        return action.next
    command, _, _ = action.next.partition(REMARK)  # (the remark stands above)
    return joined(say("Type:"), code("\n".join(parts_of(command))), by="\n")
