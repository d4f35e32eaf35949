"""Prints steps of the lesson: in styles on a terminal, as plain Markdown elsewhere."""

from __future__ import annotations

import re
import sys
from collections.abc import Sequence
from typing import TYPE_CHECKING, ClassVar, TextIO

from rich.cells import cell_len
from rich.markdown import Markdown, MarkdownElement, TableElement
from rich.rule import Rule
from rich.table import Table
from rich.text import Text

from grader.base.errors import UsageError
from grader.base.gated_console import GatedConsole
from grader.base.i18n.message import say
from grader.base.i18n.translator import Translator
from grader.report.wrap import breaks
from lab.guide.action import Action
from lab.guide.lesson import Lesson, Step
from lab.guide.predicates import current

if TYPE_CHECKING:
    from rich.console import Console, ConsoleOptions, RenderResult

CODE = re.compile(r"^```\w*\n(.*?)^```$\n?", re.MULTILINE | re.DOTALL)
COMMAND = re.compile(r"(?:cd|source|ros2|touch|mkdir|chmod|mv|colcon) ")
FIRST_COLUMN = 0.45  # of a line: a table's first column, if no word in it is longer
WIDEST_NAME = 0.7  # of a line: the longest word for which it gets more
MAX_WIDTH = 96  # columns; longer lines are hard to read


class _Table(TableElement):
    """A table of Markdown that cuts no name: the first column is as wide as its longest word."""

    def __rich_console__(self, console: Console, options: ConsoleOptions) -> RenderResult:
        for table in super().__rich_console__(console, options):
            assert isinstance(table, Table)
            for column in table.columns:
                column.overflow = "fold"
            first = [str(cell) for cell in (table.columns[0].header, *table.columns[0].cells)]
            word = max((cell_len(word) for cell in first for word in cell.split()), default=0)
            if word <= WIDEST_NAME * options.max_width:
                share = int(FIRST_COLUMN * options.max_width)
                table.columns[0].width = max(word, min(share, max(map(cell_len, first))))
            yield table


class _Markdown(Markdown):
    elements: ClassVar[dict[str, type[MarkdownElement]]] = {
        **Markdown.elements,
        "table_open": _Table,
    }


def is_command(line: str) -> bool:
    """Whether a line is to be copied: it is not wrapped then."""
    return COMMAND.match(line) is not None


def console_for(file: TextIO) -> GatedConsole:
    """Return a console for a file: with lines of MAX_WIDTH on a terminal, else not wrapped."""
    console = GatedConsole(file, soft_wrap=True)
    if console.is_terminal:
        return GatedConsole(file, width=min(console.width, MAX_WIDTH))
    return console


def show(
    what: str | None,
    lesson: Lesson,
    actions: Sequence[Action | None],
    translate: Translator,
    *,
    passed: bool = False,
) -> None:
    """Print what a student asks for: a step's number, `list`, `all`, or None for the current step.

    `actions` has what to do next for each step, None if it is done; `passed` as in `show_next`. UsageError for anything else.
    """
    console = console_for(sys.stdout)
    if what == "list":
        show_list(console, lesson, actions, translate, passed=passed)
    elif what == "all":
        _show_markdown(console, lesson.introduction)
        for step in lesson.steps:
            show_step(console, step, lesson, translate)
    else:
        position = _position(what, lesson) if what else current(actions)
        show_step(console, lesson.steps[position - 1], lesson, translate)
        if what is None:
            show_next(console, actions[position - 1], translate, passed=passed)


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
    actions: Sequence[Action | None],
    translate: Translator,
    *,
    passed: bool = False,
) -> None:
    """Print the steps, which of them are done, and the next action."""
    here = current(actions)
    for position, step in enumerate(lesson.steps, start=1):
        done = not actions[position - 1] and (bool(step.done) or position < here)
        mark = "x" if done else ">" if position == here else " "
        style = "green" if done else "bold" if position == here else ""
        console.print(Text(f"[{mark}] {step.number:2}. {step.title}", style=style))
    show_next(console, actions[here - 1], translate, passed=passed)


def show_step(console: GatedConsole, step: Step, lesson: Lesson, translate: Translator) -> None:
    """Print a step's heading and text."""
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
            console.print(_Markdown(prose))
            console.print()
        if code:  # not wrapped, so that it can be copied
            console.print(Text(code, style="bold cyan"), soft_wrap=True)


def show_line(console: GatedConsole, line: str, *, lead: tuple[str, str] = ("", "")) -> None:
    """Print a line behind a text in a style; a command, and code in quotes, is not wrapped."""
    text = Text.assemble(lead, line)
    if not console.soft_wrap and not is_command(line):
        parts = text.divide(breaks(text.plain, console.width, whole_code=True))
        for part in parts:
            part.rstrip()
        text = Text("\n").join(parts)
    console.print(text, soft_wrap=True)


def show_next(
    console: GatedConsole, action: Action | None, translate: Translator, *, passed: bool = False
) -> None:
    """Print what was found and what to do next; `action` is None if all is done.

    `passed` is whether the package had full marks; until then, the last thing to do is `check`.
    """
    if action is None and not passed:
        action = Action("check", "check")
    if action is None:
        done = say("All steps of this lesson are done.")
        console.print(Text(translate(done), style="bold green"))
        hand_in = say(
            "lab submit makes the archive to hand in. The next lesson: exit, then make lab."
        )
        console.print(Text(translate(hand_in)))
        return
    if action.found:
        show_line(console, translate(action.found), lead=(translate(say("Found: ")), "bold yellow"))
    show_line(console, translate(action.next), lead=(translate(say("Next: ")), "bold green"))
    if action.hints:
        console.print(Text(translate(say("More: lab hint")), style="dim"))
