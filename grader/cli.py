"""The `grader` command. Exit status: 0 every check passed, 1 graded and something failed, 2 wrong
usage, 3 the grader's own surroundings failed, 130/143 interrupted/terminated.
"""

from __future__ import annotations

import os
import sys
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

import click

import grader
from grader.entry import run
from grader.locale.message import say
from grader.locale.speaker import Speaker
from grader.locale.speaker import chosen_language
from grader.locale.speaker import errors_in

if TYPE_CHECKING:
    from grader.report.model import Report
    from grader.ros.images import Base
    from grader.runner import Order


def main(argv: list[str] | None = None) -> int:
    """Run the command line and return its exit status."""
    return run(commands, "grader", argv)


@click.group(context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 100})
@click.version_option(grader.__version__, "-V", "--version", prog_name="grader")
def commands() -> None:
    """Marks ROS 2 packages and says why.

    Exit status: 0 every check passed, 1 something failed, 2 wrong usage, 3 the grader's own
    surroundings failed, 130 interrupted.
    """


_assignment = click.option(
    "--assignment",
    default="hello_time",
    show_default=True,
    metavar="ID|FILE",
    help="The assignment: its id, or the path of an assignment.yaml.",
)
_distro = click.option(
    "--distro",
    default="jazzy",
    show_default=True,
    help="The ROS 2 distro to mark on; several with commas between them.",
)
_sandbox = click.option(
    "--sandbox",
    default="auto",
    show_default=True,
    help="Where the student's code runs: auto, docker, bubblewrap, account or none.",
)
_limit = click.option(
    "--limit",
    "limits",
    multiple=True,
    metavar="NAME=VALUE",
    help="Another value for a limit (seconds, bytes), e.g. build_seconds=120. May be repeated.",
)
_out = click.option(
    "--out",
    type=click.Path(path_type=Path, file_okay=False),
    default=Path("reports"),
    show_default=True,
    help="The folder that reports are written to.",
)
_lang = click.option(
    "--lang",
    type=click.Choice(["en", "ko"]),
    help="The language of the texts (default: what LC_ALL, LANG and LANGUAGE ask for).",
)
_verbose = click.option("-v", "--verbose", is_flag=True, help="Show the evidence of every check.")


@commands.command()
@click.argument("path", type=click.Path(path_type=Path))
@_assignment
@_distro
@_sandbox
@click.option("--name", help="The student's name in the report (default: the folder's).")
@_limit
@_out
@_lang
@_verbose
def grade(
    path: Path,
    assignment: str,
    distro: str,
    sandbox: str,
    name: str | None,
    limits: tuple[str, ...],
    out: Path,
    lang: str | None,
    verbose: bool,
) -> int:
    """Mark one package: PATH is the package, a workspace, or a repository that holds it."""
    from grader.ordering import make_orders  # noqa: PLC0415 - --help must not pay for it

    with errors_in(lang):
        orders = make_orders(path, assignment, distro, sandbox, limits, name=name, lang=lang)
        return _mark(orders, out, verbose=verbose, show_hidden=True)


@commands.command()
@click.argument("path", type=click.Path(path_type=Path), required=False)
@_assignment
@_distro
@_sandbox
@_limit
@_lang
@_verbose
def check(
    path: Path | None,
    assignment: str,
    distro: str,
    sandbox: str,
    limits: tuple[str, ...],
    lang: str | None,
    verbose: bool,
) -> int:
    """Check your own package before handing it in: the same verdict, with the visible checks.

    PATH is your package or workspace (default: the package in ~/ros2_ws, else the current
    folder). It is your own code: where no sandbox is to be had it runs without one, and says so.
    """
    from grader.ordering import make_orders  # noqa: PLC0415

    named = path is not None
    if path is None:
        workspace = Path.home() / "ros2_ws"
        path = workspace if workspace.is_dir() else Path.cwd()
    with errors_in(lang):
        orders = make_orders(path, assignment, distro, sandbox, limits, own_code=True, lang=lang)
        if not named:
            click.echo(Speaker(orders[0].lang)(say("checking {path}", path=str(path))), err=True)
        return _mark(orders, None, verbose=verbose, show_hidden=False)


@commands.command()
@click.argument("mistake", metavar="[MISTAKE-ID | -]", required=False)
@_lang
def explain(mistake: str | None, lang: str | None) -> int:
    """Explain a mistake of the catalogue, or what a terminal shows (-: read from standard input).

    For example: ros2 run my_robot_controller test_node 2>&1 | grader explain -
    """
    from grader.mistakes import explain as texts  # noqa: PLC0415

    lang = lang or chosen_language(os.environ)
    if mistake is None:
        texts.print_list(file=sys.stdout, lang=lang)
        return 0
    if mistake == "-":
        text = sys.stdin.buffer.read(texts.MOST_BYTES).decode("utf-8", "replace")
        return 0 if texts.print_recognised(text, file=sys.stdout, lang=lang) else 1
    texts.print_entry(mistake, file=sys.stdout, lang=lang)
    return 0


@commands.command()
@click.argument("path", type=click.Path(path_type=Path))
@click.option(
    "--dry-run/--apply",
    "dry_run",
    default=True,
    help="Show the change as a diff (the default), or write it; the old files are kept.",
)
@_assignment
@_distro
@_sandbox
@click.option("--check", "only", default="", metavar="ID", help="Mend this check only.")
@click.option(
    "--no-run", is_flag=True, help="Look at the files only: build nothing and run nothing."
)
@_limit
def fix(
    path: Path,
    dry_run: bool,
    assignment: str,
    distro: str,
    sandbox: str,
    only: str,
    no_run: bool,
    limits: tuple[str, ...],
) -> int:
    """Mend your own package where only one mend is possible, as a diff that is shown first.

    PATH is your package or workspace. Exit status: 0 nothing is wrong any more, 1 something is left
    that cannot be mended by itself (it is named).
    """
    from grader.fix.command import Wish  # noqa: PLC0415
    from grader.fix.command import fix as mend  # noqa: PLC0415
    from grader.ordering import make_orders  # noqa: PLC0415

    orders = make_orders(path, assignment, distro, sandbox, limits, own_code=True)
    if len(orders) > 1:
        raise click.UsageError("fix runs the node on one distro: name one")
    wish = Wish(order=orders[0], only=only, writes=not dry_run, runs=not no_run)
    return mend(wish, say=lambda text: click.echo(text, err=True))


@commands.command()
@click.argument("assignment", metavar="ASSIGNMENT")
@click.option("--static", is_flag=True, help="Only the mutants whose files decide them: no run.")
@click.option(
    "--jobs", type=click.IntRange(1), help="How many are run at once (default: cores + 1)."
)
@click.option("--only", default="*", metavar="GLOB", help="Only the mutants with such a name.")
@click.option(
    "--json",
    "json_file",
    type=click.Path(path_type=Path, dir_okay=False),
    help="Write the matrix to this file as well.",
)
@click.option(
    "--keys",
    type=click.Path(path_type=Path, file_okay=False),
    help="The folder with the solution and mutants.yaml (default: the grader's own).",
)
@_distro
@_sandbox
@_limit
def validate(
    assignment: str,
    static: bool,
    jobs: int | None,
    only: str,
    json_file: Path | None,
    keys: Path | None,
    distro: str,
    sandbox: str,
    limits: tuple[str, ...],
) -> int:
    """Mark an assignment's own solution, starter and mutants: does it mark what it claims to?

    Exit status: 0 everything is as expected, 1 something is not.
    """
    from grader.ordering import make_orders  # noqa: PLC0415
    from grader.validate import command  # noqa: PLC0415
    from grader.validate import matrix  # noqa: PLC0415

    order, *others = make_orders(Path(), assignment, distro, sandbox, limits, lang="en")
    if others:
        raise click.UsageError("validate marks on one distro: name one")
    wish = command.Wish(
        order=order,
        keys=keys or command.KEYS / order.assignment.id,
        starter=command.starter_of(assignment),
        static=static,
        jobs=jobs or 0,
        only=only,
    )
    found = command.validate(wish, say=lambda text: click.echo(text, err=True))
    click.echo(matrix.table(found))
    click.echo()
    click.echo(matrix.summary(found))
    if json_file is not None:
        command.write_json(found, json_file)
    return 1 if found.faults else 0


@commands.command()
@click.option("--distro", default="jazzy", show_default=True)
def prefix(distro: str) -> int:
    """Make the ROS prefix of a distro from PyPI's wheels, if it is not there, and say where it is."""
    from grader.ros.distro import find_distro  # noqa: PLC0415
    from grader.ros.prefix import wheels_prefix  # noqa: PLC0415

    found = wheels_prefix(find_distro(distro), say=lambda text: click.echo(text, err=True))
    click.echo(found)
    return 0


@commands.command()
@click.option("--distro", help="Build the images of this distro; several with commas between them.")
@click.option(
    "--base",
    type=click.Choice(["ros", "wheels"]),
    default="ros",
    show_default=True,
    help="What they stand on: the official ros:<distro>-ros-base, or PyPI's ROS wheels.",
)
@click.option("--extra-ca", type=click.Path(path_type=Path), help="A CA certificate (PEM) for pip.")
@click.option("--apt-mirror", default="", metavar="URL", help="The mirror that apt uses.")
@click.option("--pip-index", default="", metavar="URL", help="The package index that pip uses.")
@click.option("--base-image", default="", metavar="IMAGE", help="Another image to start from.")
def images(
    distro: str | None,
    base: Base,
    extra_ca: Path | None,
    apt_mirror: str,
    pip_index: str,
    base_image: str,
) -> int:
    """Build the Docker images of a distro (--distro), and list all with their sizes.

    HTTP_PROXY, HTTPS_PROXY and NO_PROXY are passed on to the build.
    """
    from grader.ros.distro import find_distro  # noqa: PLC0415
    from grader.ros.image_build import Network  # noqa: PLC0415
    from grader.ros.image_build import build_image  # noqa: PLC0415
    from grader.ros.images import connect  # noqa: PLC0415
    from grader.ros.images import table  # noqa: PLC0415

    wanted = [find_distro(word.strip()) for word in (distro or "").split(",") if word.strip()]
    network = Network(apt_mirror=apt_mirror, pip_index=pip_index, extra_ca=extra_ca)
    if base_image:
        network = replace(network, wheels_base=base_image, ros_base=base_image)
    client = connect()
    for found in wanted:
        for stage in ("grade", "lab"):
            build_image(
                client,
                found,
                stage=stage,
                base=base,
                network=network,
                say=lambda text: click.echo(text, err=True),
            )
    rows = [row for row in table(client) if not wanted or row.distro in {d.name for d in wanted}]
    width = max(len(row.name) for row in rows)
    for row in rows:
        size = f"{row.size / 1e6:,.0f} MB" if row.size is not None else "not here"
        click.echo(f"{row.name:<{width}}  {size:>10}  {row.id}".rstrip())
    return 0


def _hidden(count: int) -> str:
    if count == 0:
        return say("There are no hidden checks: your instructor's side asks the same.")
    if count == 1:
        return say("1 hidden check will be asked on your instructor's side.")
    return say("{count} hidden checks will be asked on your instructor's side.", count=count)


def _mark(orders: list[Order], out: Path | None, *, verbose: bool, show_hidden: bool) -> int:
    from grader.report import files  # noqa: PLC0415
    from grader.report import terminal  # noqa: PLC0415
    from grader.runner import grade as mark  # noqa: PLC0415

    speak = Speaker(orders[0].lang)
    reports: list[Report] = []
    for order in orders:
        with terminal.LiveProgress(sys.stderr, lang=order.lang) as progress:
            report = mark(order, progress)
        reports.append(report)
        if out is not None:
            written = files.write_report(report, out, report.submission.name)
        if len(orders) == 1:
            terminal.print_report(
                report,
                file=sys.stdout,
                verbose=verbose,
                show_hidden=show_hidden,
                path=written if out is not None else None,
            )
        if report.environment.sandbox == "none":
            bare = say("No sandbox was used: the package ran as you, with your files.")
            click.echo(speak(bare), err=True)
    if not show_hidden:
        click.echo(speak(_hidden(orders[0].assignment.hidden_checks)))
    if len(orders) > 1:
        if out is not None:
            matrix = files.write_matrix(reports, out, reports[0].submission.name)
        terminal.print_matrix(
            reports,
            file=sys.stdout,
            show_hidden=show_hidden,
            path=matrix if out is not None else None,
        )
    return 0 if all(report.all_passed for report in reports) else 1
