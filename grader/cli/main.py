"""The `grader` command. Exit status: 0 every check passed, 1 graded and something failed, 2 wrong
usage, 3 the grader's own surroundings failed, 130/143 interrupted/terminated.
"""

from __future__ import annotations

import click

import grader
from grader.base.i18n.message import msg
from grader.cli import options
from grader.cli.invoke import run
from grader.cli.lazy_group import LazyCommand, LazyGroup

COMMANDS = {
    "check": LazyCommand(
        "grader.cli.check:check",
        msg(
            "Check your own package before you submit it: the same verdict, by the visible checks."
        ),
    ),
    "classroom50-autograder": LazyCommand(
        "grader.cli.classroom50:autograder",
        "Print the autograder.py for an assignment in Classroom 50.",
    ),
    "classroom50-compare": LazyCommand(
        "grader.cli.classroom50:compare",
        "List the students whose points in Classroom 50 are not those of your own machine.",
    ),
    "convert": LazyCommand(
        "grader.cli.convert:convert",
        "Print a report.json in the format of another system (FORM), in the report's language.",
    ),
    "explain": LazyCommand(
        "grader.cli.explain:explain",
        msg(
            "Explain a mistake of the catalogue, or the output of a terminal (-: from standard "
            "input)."
        ),
    ),
    "fix": LazyCommand(
        "grader.cli.fix:fix",
        msg(
            "Fix the mistakes in your own package that have only one possible fix; shows a diff "
            "first."
        ),
    ),
    "forget": LazyCommand(
        "grader.cli.forget:forget",
        "Remove all that is kept about a student: verdicts, evidence, corrections, reports, feedback.",
    ),
    "grade": LazyCommand(
        "grader.cli.grade:grade",
        "Mark one package: PATH is the package, a workspace, or a repository that holds it.",
    ),
    "grade-all": LazyCommand(
        "grader.cli.grade_all:grade_all",
        "Mark a class: PATH is the download of the learning management system, a folder or a zip.",
    ),
    "gradescope": LazyCommand(
        "grader.cli.gradescope:gradescope",
        "Mark the submission in Gradescope's container and keep results.json up to date.",
    ),
    "gradescope-zip": LazyCommand(
        "grader.cli.gradescope_zip:gradescope_zip",
        "Make the autograder archive to upload to Gradescope. It contains the solution.",
    ),
    "images": LazyCommand(
        "grader.cli.images:images",
        "Build the Docker images of a distro (--distro), and list all images with their sizes.",
    ),
    "keygen": LazyCommand(
        "grader.cli.keygen:keygen",
        "Make the key with which this installation signs the evidence of its verdicts.",
    ),
    "mail": LazyCommand(
        "grader.cli.mail:mail",
        "Write e-mail drafts for the students of a class into drafts.mbox: it sends nothing.",
    ),
    "new": LazyCommand(
        "grader.cli.new:new",
        "Write the files of a new lesson: assignment, text, solution and mutants to start from.",
    ),
    "override": LazyCommand(
        "grader.cli.override:override",
        "Correct a verdict by hand: grader override STUDENT --check ID --points N --because WHY.",
    ),
    "prefix": LazyCommand(
        "grader.cli.prefix:prefix",
        "Make the ROS prefix of a distro from PyPI's wheels unless it exists, and print its path.",
    ),
    "replay": LazyCommand(
        "grader.cli.replay:replay",
        "Judge a report's evidence again, without running anything, and compare the verdicts.",
    ),
    "shell": LazyCommand(
        "grader.cli.shell:shell",
        "Open a shell beside a student's package: built, in the sandbox in which it was marked.",
    ),
    "validate": LazyCommand(
        "grader.cli.validate:validate",
        "Test an assignment: mark its solution, starter and mutants, and check the verdicts.",
    ),
    "verify": LazyCommand(
        "grader.cli.verify:verify",
        "Check that PATH (a report.json, its folder, or a ledger) is what the grader wrote.",
    ),
}


def main(argv: list[str] | None = None) -> int:
    """Run the command line and return its exit status."""
    return run(commands, "grader", argv)


@click.group(
    cls=LazyGroup,
    lazy=COMMANDS,
    context_settings=options.CONTEXT,
    help=msg(
        "Marks ROS 2 packages and says why.\n\n"
        "Exit status: 0 every check passed, 1 something failed, 2 wrong usage, 3 the grader's own "
        "surroundings failed, 130 interrupted."
    ),
)
@click.version_option(grader.__version__, "-V", "--version", prog_name="grader")
def commands() -> None:
    """All commands."""
