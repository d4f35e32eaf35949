"""The `lab` command, and `check`, `fix` and `explain` in the lab.

Exit status of `lab`: that of the command in the lab (0 for an interactive shell), 2 wrong usage, 3
the lab's surroundings failed, 130/143 interrupted/terminated.
"""

from __future__ import annotations

import os
import sys
from pathlib import Path

import click

import grader
from grader.base.errors import UsageError
from grader.base.i18n.message import msg, say
from grader.base.i18n.translator import Translator, chosen_language, errors_in
from grader.cli import options
from grader.cli.invoke import run
from grader.cli.main import main as run_grader
from grader.report.notice import notice
from lab.commands.cli import main as run_lab


def main(argv: list[str] | None = None) -> int:
    """Run the command line and return its exit status."""
    return run(command, "lab", argv)


def run_in_lab(name: str) -> int:
    """Run the grader's command `name` with this process' arguments; return its exit status.

    `fix` uses the distro of this terminal unless --distro is given; `check` is `lab check`. `explain`
    also knows for which ROS the workspace was built, which no output of a terminal shows for certain.
    """
    words = sys.argv[1:]
    if name == "check":
        return run_lab([name, *words])
    if name == "fix" and not any(word.startswith("--distro") for word in words):
        words = ["--distro", os.environ.get("ROS_DISTRO", "jazzy"), *words]
    status = run_grader([name, *words])
    if name == "explain" and "-" in words and status in (0, 1):
        from lab.other_ros import say_other_ros  # noqa: PLC0415 - keeps --help fast

        say_other_ros()
    return status


@click.command(
    context_settings=options.CONTEXT,
    help=msg(
        "Open a ROS 2 terminal with your workspace, or run COMMAND in it.\n\n"
        "The workspace is a folder on this machine and is kept when the lab is closed. A second lab "
        "with the same workspace is a second terminal."
    ),
)
@click.version_option(grader.__version__, "-V", "--version", prog_name="lab")
@click.option(
    "--distro", default="jazzy", show_default=True, help=msg("The ROS 2 distro of the lab.")
)
@click.option(
    "--workspace",
    type=click.Path(path_type=Path),
    help=msg(
        "The folder of the workspace on this machine; created if missing. [default: ~/ros2_ws]"
    ),
)
@click.option(
    "--sandbox",
    default="auto",
    show_default=True,
    help=msg("How the lab is opened: auto, docker or bubblewrap."),
)
@click.option(
    "--lesson",
    "--assignment",
    "assignment",
    metavar="ID|FILE",
    help=msg(
        "The lesson: its id, or the path of an assignment.yaml (default: the first of the course "
        "that is not finished in this workspace)."
    ),
)
@click.option(
    "--page",
    is_flag=True,
    help=msg("Open it in the browser: guide, editor, terminals, turtle and graph in one page."),
)
@options.lang
@click.argument("words", nargs=-1, type=click.UNPROCESSED, metavar="[-- COMMAND...]")
def command(
    distro: str,
    workspace: Path | None,
    sandbox: str,
    assignment: str | None,
    page: bool,
    lang: str | None,
    words: tuple[str, ...],
) -> int:
    """Open the lab on this terminal."""
    from grader.course.load import load_assignment  # noqa: PLC0415 - keeps --help fast
    from grader.ros.distro import find_distro  # noqa: PLC0415
    from lab.choose import choose  # noqa: PLC0415
    from lab.config import PAGE, LabConfig, lab_network  # noqa: PLC0415
    from lab.lesson import chosen_lesson  # noqa: PLC0415
    from lab.limits import lab_limits  # noqa: PLC0415
    from lab.workspace import prepare, workspace_path  # noqa: PLC0415

    translate = Translator(lang or chosen_language(os.environ))
    with errors_in(translate.lang):
        if page and words:
            raise UsageError(
                say("--page takes no command"), remedy=say("Leave out one of the two.")
            )
        found = find_distro(distro)
        limits = lab_limits(os.environ)
        lesson = chosen_lesson(assignment, workspace_path(workspace))
        enter = choose(
            sandbox,
            found,
            interfaces=load_assignment(lesson.file).interfaces,
            notify=lambda text: _notify(translate(text)),
        )
        config = LabConfig(
            found,
            prepare(workspace),
            lesson,
            command=PAGE if page else words,
            lang=translate.lang,
            limits=limits,
            network=lab_network(os.environ),
        )
        status = enter(config)
    interactive = not words and sys.stdin.isatty()
    return (
        0 if interactive else status
    )  # a shell returns its last command's status, which is not the lab's


def _notify(text: str) -> None:
    notice(f"lab: {text}", sys.stderr)
