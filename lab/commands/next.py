"""`lab next`: goes on with the next lesson, in all terminals of the lab and in its page."""

from __future__ import annotations

import os

import click

from grader.base.errors import UsageError
from grader.base.folder import Folder
from grader.base.i18n.message import msg, say
from grader.base.i18n.translator import errors_in
from grader.cli import options
from grader.course.assignment import BUILT
from grader.course.find import LESSON
from lab.guide.opened import opened_lab
from lab.guide.progress import FOLDER, LESSON_FILE
from lab.guide.show import show
from lab.ros_packages import has_package


@click.command(
    name="next",
    help=msg(
        "Go on with the next lesson of the course, once this one has full marks. All terminals of "
        "the lab and its page change to it."
    ),
)
@options.lang
def next_(lang: str | None) -> None:
    """Change the lab's lesson, and show the first step."""
    with errors_in(lang):
        lab = opened_lab(lang)
        after = lab.after()
        if not after.goes_on(os.environ):
            none = say("there is no lesson to go on with in this lab")
            raise UsageError(none, remedy=after.in_lab(os.environ))
        if not lab.progress().passed:
            raise UsageError(
                say("this lesson does not have full marks yet"),
                remedy=say(
                    "Run check. Another lesson all the same: exit, then make lab LESSON=ID."
                ),
            )
        asked = opened_lab(lang, lab.workspace, after.id).assignment.interfaces
        for package in (one for one in BUILT if one in asked and not has_package(one, os.environ)):
            raise UsageError(
                say("this lab has no {package}, which the next lesson needs", package=package),
                remedy=say("exit, then make lab LESSON={id}", id=after.id),
            )
        with Folder.open(lab.workspace) as root, root.private(FOLDER) as own:
            own.replace(LESSON_FILE, f"{os.environ[LESSON]} {after.id}\n".encode())
        lab = lab.now()
        click.echo(lab.translate(say("The lesson is now: {title}.", title=after.title or after.id)))
        show(None, lab.lesson, lab.task(os.environ, look=True), lab.translate)
