"""Prints steps of the lesson: in styles on a terminal, as plain text elsewhere."""

from __future__ import annotations

import io
import re
import shutil
import sys
import textwrap
from dataclasses import replace
from typing import TextIO

from rich.rule import Rule
from rich.text import Text

from grader.base.errors import UsageError
from grader.base.gated_console import GatedConsole
from grader.base.i18n.message import say
from grader.base.i18n.translator import Translator
from grader.report.commands import REMARK, broken, command_behind, is_command
from grader.report.wrap import breaks, rows
from lab.guide.changes import MARGIN
from lab.guide.lesson import Lesson, Step
from lab.guide.markdown import StyledMarkdown, plain_lines
from lab.guide.task import Task, all_done

CODE = re.compile(r"^```\w*\n(.*?)^```$\n?", re.MULTILINE | re.DOTALL)
FENCE = re.compile(r"^```", re.MULTILINE)
TAKEN = 2  # lines of a terminal: the command and the next prompt
MAX_WIDTH = 96  # columns; longer lines are hard to read


def console_for(file: TextIO) -> GatedConsole:
    """Return a console for a file: with lines of MAX_WIDTH on a terminal, else not wrapped."""
    console = GatedConsole(file, soft_wrap=True)
    if console.is_terminal:  # (of a plain one rich does not ask the size)
        lines = shutil.get_terminal_size().lines
        return GatedConsole(file, width=min(console.width, MAX_WIDTH), height=lines)
    return console


def show(
    what: str | None,
    lesson: Lesson,
    task: Task,
    translate: Translator,
) -> None:
    """Print what a student asks for: a step's number, `list`, `all`, or None for the current step.

    UsageError for anything else.
    """
    console = console_for(sys.stdout)
    if what == "list":
        show_list(console, lesson, task, translate)
    elif what == "all":
        _show_markdown(console, lesson.introduction)
        for step in lesson.steps:
            show_step(console, step, lesson, translate)
    elif what:
        show_step(console, lesson.steps[_position(what, lesson) - 1], lesson, translate)
    else:
        show_current(console, lesson, task, translate)


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


def show_list(
    console: GatedConsole,
    lesson: Lesson,
    task: Task,
    translate: Translator,
) -> None:
    """Print the steps, which of them are done, and the next action."""
    here = task.position
    for position, step in enumerate(lesson.steps, start=1):
        done = not task.actions[position - 1] and (bool(step.done) or position < here)
        mark = "x" if done else ">" if position == here else " "
        style = "green" if done else "bold" if position == here else ""
        console.print(Text(f"[{mark}] {step.number:2}. {step.title}", style=style))
    show_next(console, task, translate)


def show_current(
    console: GatedConsole, lesson: Lesson, task: Task, translate: Translator, *, taken: int = TAKEN
) -> None:
    """Print the current step and what is next: on a terminal, as much of the text as fits.

    `taken` lines of the terminal are of the command and of what follows.
    """
    step = lesson.steps[task.position - 1]
    parts = _parts(step.text)
    whole = translate(say("The whole step: guide {number}", number=step.number))

    def write(out: GatedConsole, number: int) -> None:
        text = "\n\n".join(parts[:number])
        show_step(out, replace(step, text=text), lesson, translate)
        if number < len(parts):
            out.print(Text(whole, style="dim"))
        show_next(out, task, translate)

    def fits(number: int) -> bool:
        if number < len(parts) and parts[number - 1].rstrip().endswith(":"):
            return False  # (it announces what is cut off)
        written = io.StringIO()
        write(
            GatedConsole(written, width=console.width, force_terminal=True, color_system=None),
            number,
        )
        return rows(written.getvalue(), console.width) <= console.height - taken

    fitting = (number for number in range(len(parts), 0, -1) if fits(number))
    write(console, next(fitting, 0) if console.is_terminal else len(parts))


def _parts(text: str) -> list[str]:
    """Return the paragraphs, tables and blocks of code of a step."""
    parts: list[str] = []
    is_open = False  # (a block of code has empty lines of its own)
    for part in text.split("\n\n"):
        parts = [*parts[:-1], f"{parts[-1]}\n\n{part}"] if is_open else [*parts, part]
        is_open ^= len(FENCE.findall(part)) % 2 == 1
    return parts


def show_step(console: GatedConsole, step: Step, lesson: Lesson, translate: Translator) -> None:
    """Print a step's heading and text."""
    heading = translate(
        say(
            "Step {number} of {count}: {title}",
            number=step.number,
            count=lesson.count,
            title=step.title,
        )
    )
    if console.is_terminal:
        console.print(Rule(Text(heading, style="bold"), align="left"))
    else:
        console.print(Text(heading + "\n"))
    _show_markdown(console, step.text)


def _show_markdown(console: GatedConsole, text: str) -> None:
    parts = CODE.split(text)
    for prose, code in zip(parts[0::2], [*parts[1::2], ""]):
        if prose.strip():
            _show_prose(console, prose)
            console.print()
        # code is not wrapped, so that it can be copied; a shell reads on behind a backslash
        if code and console.is_terminal:
            lines = [in_width(console, line) for line in code.split("\n")]
            console.print(Text("\n".join(lines), style="bold cyan"), soft_wrap=True)
        elif code:
            console.print(Text(textwrap.indent(code, MARGIN)))


def _show_prose(console: GatedConsole, prose: str) -> None:
    if console.is_terminal:
        console.print(StyledMarkdown(prose))
        return
    lines = "\n".join(plain_lines(prose, console))
    console.print(Text(lines.rstrip("\n")))


def in_width(console: GatedConsole, line: str) -> str:
    """Return a line of code as a terminal shows it: a command that is too long is in several lines."""
    return broken(line, console.width) if is_command(line) else line


def show_line(console: GatedConsole, line: str, *, lead: tuple[str, str] = ("", "")) -> None:
    """Print a line behind a text in a style; code in quotes is not wrapped, and a command only where
    a shell reads on.

    What is said behind a command, in parentheses, comes below it if there is no room beside it, and
    so does a command behind a colon.
    """
    text = Text.assemble(lead, line)
    command, gap, said = line.partition(REMARK)
    if gap and is_command(command) and text.cell_len > console.width and not console.soft_wrap:
        show_line(console, command, lead=lead)
        show_line(console, f"({said}")
        return
    before, behind = command_behind(line)
    if behind and text.cell_len > console.width and not console.soft_wrap:
        show_line(console, before, lead=lead)
        show_line(console, behind)
        return
    bare = line.removeprefix(MARGIN)
    if is_command(bare) and not console.soft_wrap:
        margin = line[: len(line) - len(bare)]
        lines = broken(bare, console.width - len(margin), first=len(lead[0]))
        console.print(Text.assemble(lead, textwrap.indent(lines, margin)), soft_wrap=True)
        return
    if not console.soft_wrap and not line.startswith(MARGIN):
        parts = text.divide(breaks(text.plain, console.width, whole_code=True))
        for part in parts:
            part.rstrip()
        text = Text("\n").join(parts)
    console.print(text, soft_wrap=True)


def show_next(
    console: GatedConsole,
    task: Task,
    translate: Translator,
    *,
    more: bool = True,
) -> None:
    """Print what was found and what to do next; `more` names the command that says more."""
    action = task.action
    if action is None:
        done, following = all_done(task)
        console.print(Text(translate(done), style="bold green"))
        console.print(Text(translate(following)))
        return
    if action.found:
        show_line(console, translate(action.found), lead=(translate(say("Found: ")), "bold yellow"))
    show_line(console, translate(action.next), lead=(translate(say("Next: ")), "bold green"))
    if more:
        console.print(Text(translate(say("More: lab hint")), style="dim"))
