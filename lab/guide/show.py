"""Prints steps of the lesson: in styles on a terminal, as plain Markdown elsewhere."""

from __future__ import annotations

import re
import sys
from collections.abc import Sequence

from rich.markdown import Markdown
from rich.rule import Rule
from rich.text import Text

from grader.base.errors import UsageError
from grader.base.gated_console import GatedConsole
from grader.base.i18n.message import say
from grader.base.i18n.translator import Translator
from lab.guide.lesson import Lesson, Step
from lab.guide.progress import current

CODE = re.compile(r"^```\w*\n(.*?)^```$\n?", re.MULTILINE | re.DOTALL)
MAX_WIDTH = 96  # columns; longer lines are hard to read


def _console() -> GatedConsole:
    console = GatedConsole(sys.stdout, soft_wrap=True)
    if console.is_terminal:
        return GatedConsole(sys.stdout, width=min(console.width, MAX_WIDTH))
    return console


def show(what: str | None, lesson: Lesson, actions: Sequence[str], translate: Translator) -> None:
    """Print what a student asks for: a step's number, `list`, `all`, or None for the current step.

    `actions` has what to do next for each step, "" if it is done. UsageError for anything else.
    """
    console = _console()
    if what == "list":
        _show_list(console, lesson, actions, translate)
    elif what == "all":
        _show_markdown(console, lesson.introduction)
        for step in lesson.steps:
            _show_step(console, step, lesson, translate)
    else:
        position = _position(what, lesson) if what else current(actions)
        _show_step(console, lesson.steps[position - 1], lesson, translate)
        if what is None:
            _show_next(console, actions[position - 1], translate)


def _position(word: str, lesson: Lesson) -> int:
    """Return the position (from 1) of the step with a number; UsageError if there is none."""
    if word.isdecimal():
        for position, step in enumerate(lesson.steps, start=1):
            if step.number == int(word):
                return position
    raise UsageError(
        say("there is no step '{word}'", word=word),
        remedy=say(
            "Use guide {first} to guide {last}, guide list, or guide all.",
            first=lesson.steps[0].number,
            last=lesson.steps[-1].number,
        ),
    )


def _show_list(
    console: GatedConsole, lesson: Lesson, actions: Sequence[str], translate: Translator
) -> None:
    here = current(actions)
    for position, step in enumerate(lesson.steps, start=1):
        done = not actions[position - 1] and (bool(step.done) or position < here)
        mark = "x" if done else ">" if position == here else " "
        style = "green" if done else "bold" if position == here else ""
        console.print(Text(f"[{mark}] {step.number:2}. {step.title}", style=style))
    _show_next(console, actions[here - 1], translate)


def _show_step(console: GatedConsole, step: Step, lesson: Lesson, translate: Translator) -> None:
    heading = translate(
        say(
            "Step {number} of {count}: {title}",
            number=step.number,
            count=len(lesson.steps),
            title=step.title,
        )
    )
    if console.is_terminal:
        console.print(Rule(Text(heading, style="bold"), align="left"))
    else:
        console.print(Text(heading + "\n"))
    _show_markdown(console, step.text)


def _show_markdown(console: GatedConsole, text: str) -> None:
    if not console.is_terminal:
        console.print(Text(text + "\n"))
        return
    parts = CODE.split(text)
    for prose, code in zip(parts[0::2], [*parts[1::2], ""]):
        if prose.strip():
            console.print(Markdown(prose))
            console.print()
        if code:  # not wrapped, so that it can be copied
            console.print(Text(code, style="bold cyan"), soft_wrap=True)


def _show_next(console: GatedConsole, action: str, translate: Translator) -> None:
    label = translate(say("Next: "))
    console.print(Text.assemble((label, "bold green"), action or "check"), soft_wrap=True)
