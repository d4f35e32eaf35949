"""The `lab` program inside the lab.

Exit status: 0 done, 1 something is not as it should be, 2 wrong usage, 3 the lab's surroundings
failed, 130 interrupted.
"""

from __future__ import annotations

import sys
from collections.abc import Sequence

import click

from grader.base.i18n.message import msg
from grader.cli import options
from grader.cli.invoke import run
from grader.cli.lazy_group import LazyCommand, LazyGroup

COMMANDS = {
    "check": LazyCommand(
        "lab.commands.check:check", msg("Run your instructor's checks on your package.")
    ),
    "doctor": LazyCommand(
        "lab.commands.doctor:doctor",
        msg("Look for what often goes wrong in a terminal or a build."),
    ),
    "file": LazyCommand(
        "lab.commands.file:file", msg("Print the path of the node's file."), hidden=True
    ),
    "hint": LazyCommand("lab.commands.hint:hint", msg("Say more about the current step.")),
    "next": LazyCommand("lab.commands.next:next_", msg("Go on with the next lesson.")),
    "notice": LazyCommand(
        "lab.commands.notice:notice", msg("Say which step has just been done, if any."), hidden=True
    ),
    "reset": LazyCommand(
        "lab.commands.reset:reset", msg("Start again at a step; what is moved away is kept.")
    ),
    "status": LazyCommand("lab.commands.status:status", msg("List the steps and which are done.")),
    "submit": LazyCommand("lab.commands.submit:submit", msg("Make the archive to hand in.")),
    "window": LazyCommand(
        "lab.window.cli:command", msg("Open a page with the turtle, the graph, the log and plots.")
    ),
    "watch": LazyCommand(
        "lab.commands.watch:watch", msg("Show the current step and notice when it is done.")
    ),
}


def main(argv: Sequence[str] | None = None) -> int:
    """Run the command line and return its exit status."""
    words = list(sys.argv[1:] if argv is None else argv)
    return run(commands, "lab", words)


@click.group(
    cls=LazyGroup,
    lazy=COMMANDS,
    invoke_without_command=True,
    context_settings=options.CONTEXT,
    help=msg("Take you through the lesson. Without a command: the same as watch."),
)
@click.pass_context
def commands(ctx: click.Context) -> int | None:
    """All commands."""
    if ctx.invoked_subcommand is not None:
        return None
    from lab.commands.watch import watch_lesson  # noqa: PLC0415 - keeps --help fast

    return watch_lesson(None)
