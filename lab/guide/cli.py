"""The `guide` command: prints the current step, another step, a list, or the whole lesson."""

from __future__ import annotations

import os
import re
import sys
from collections.abc import Sequence
from pathlib import Path

import click
from rich.markdown import Markdown
from rich.rule import Rule
from rich.text import Text

from grader.base.errors import UsageError
from grader.base.gated_console import GatedConsole
from grader.base.i18n.message import msg, say
from grader.base.i18n.translator import Translator, chosen_language, errors_in
from grader.cli import options
from grader.cli.invoke import run
from grader.course.find import assignment_file
from grader.course.load import load_assignment
from grader.ros.distro import DEFAULT
from lab.guide.lesson import Lesson, Step, lesson_file, read_lesson
from lab.guide.progress import StudentState, current, next_actions

CODE = re.compile(r"^```\w*\n(.*?)^```$\n?", re.MULTILINE | re.DOTALL)
MAX_WIDTH = 96  # columns; longer lines are hard to read


def main(argv: Sequence[str] | None = None) -> int:
    """Run the command line and return its exit status."""
    return run(command, "guide", list(argv or ()))


@click.command(
    context_settings={"help_option_names": ["-h", "--help"]},
    help=msg(
        "Show what to do next. N shows step N, `list` all steps and which are done, `all` the whole "
        "lesson.\n\n"
        "A step is recognised as done by the files in your workspace and by this terminal."
    ),
)
@click.option(
    "--workspace",
    type=click.Path(path_type=Path),
    default=Path("~/ros2_ws"),
    show_default=True,
    help=msg("The folder of the workspace."),
)
@options.assignment
@options.lang
@click.argument("what", required=False, metavar="[N|list|all]")
def command(workspace: Path, assignment: str | None, lang: str | None, what: str | None) -> None:
    """Print a step of the lesson."""
    translate = Translator(lang or chosen_language(os.environ))
    distro = os.environ.get("ROS_DISTRO") or DEFAULT
    with errors_in(translate.lang):
        file = assignment_file(assignment)
        assigned = load_assignment(file)
        lesson = read_lesson(lesson_file(file.parent, translate.lang), distro=distro)
        state = StudentState(workspace.expanduser(), assigned, os.environ)
        actions = [translate(action) for action in next_actions(state, lesson.steps)]
        _show(what, _console(), lesson, actions, translate)


def _console() -> GatedConsole:
    console = GatedConsole(sys.stdout, soft_wrap=True)
    if console.is_terminal:
        return GatedConsole(sys.stdout, width=min(console.width, MAX_WIDTH))
    return console


def _show(
    what: str | None,
    console: GatedConsole,
    lesson: Lesson,
    actions: Sequence[str],
    translate: Translator,
) -> None:
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
