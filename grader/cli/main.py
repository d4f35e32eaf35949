"""The `grader` command. Exit status: 0 every check passed, 1 graded and something failed, 2 wrong
usage, 3 the grader's own surroundings failed, 130/143 interrupted/terminated.
"""

from __future__ import annotations

import sys
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

import click

import grader
from grader.base.i18n.message import msg, say
from grader.base.i18n.translator import Translator, errors_in
from grader.cli import options
from grader.cli.convert import COMMANDS as GRADEBOOK_COMMANDS
from grader.cli.explain import COMMANDS as MISTAKE_COMMANDS
from grader.cli.fix import COMMANDS as FIX_COMMANDS
from grader.cli.grade_all import COMMANDS as CLASS_COMMANDS
from grader.cli.invoke import run
from grader.cli.validate import COMMANDS as VALIDATE_COMMANDS

if TYPE_CHECKING:
    from grader.report.model import Report
    from grader.ros.images import Base
    from grader.verdict.order import Order


def main(argv: list[str] | None = None) -> int:
    """Run the command line and return its exit status."""
    return run(commands, "grader", argv)


@click.group(
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


_out = click.option(
    "--out",
    type=click.Path(path_type=Path, file_okay=False),
    default=Path("reports"),
    show_default=True,
    help="The folder for reports.",
)
_verbose = click.option(
    "-v", "--verbose", is_flag=True, help=msg("Show the evidence of every check.")
)


@commands.command()
@click.argument("path", type=click.Path(path_type=Path))
@options.assignment
@options.keys
@options.distros
@options.sandbox
@click.option("--name", help="The student's name in the report (default: the folder's).")
@options.limits
@_out
@options.lang
@_verbose
def grade(
    path: Path,
    assignment: str | None,
    keys: Path | None,
    distro: str,
    sandbox: str,
    name: str | None,
    limits: tuple[str, ...],
    out: Path,
    lang: str | None,
    verbose: bool,
) -> int:
    """Mark one package: PATH is the package, a workspace, or a repository that holds it."""
    from grader.verdict.order import make_orders  # noqa: PLC0415 - keeps --help fast

    with errors_in(lang):
        orders = make_orders(
            path, assignment, distro, sandbox, limits, name=name, keys=keys, lang=lang
        )
        return _mark(orders, out, verbose=verbose, show_hidden=True)


@commands.command(
    help=msg(
        "Check your own package before you submit it: the same verdict, by the visible checks.\n\n"
        "PATH is your package or workspace (default: the package in ~/ros2_ws, else the current "
        "folder). It is your own code: if no sandbox is available it runs without one, and says so."
    )
)
@click.argument("path", type=click.Path(path_type=Path), required=False)
@options.assignment
@options.distros
@options.sandbox
@options.limits
@options.lang
@_verbose
def check(
    path: Path | None,
    assignment: str | None,
    distro: str,
    sandbox: str,
    limits: tuple[str, ...],
    lang: str | None,
    verbose: bool,
) -> int:
    """Mark a student's own package, without the hidden checks."""
    from grader.verdict.order import default_path, make_orders  # noqa: PLC0415

    with errors_in(lang):
        place = path or default_path()
        orders = make_orders(place, assignment, distro, sandbox, limits, own_code=True, lang=lang)
        if path is None:
            click.echo(
                Translator(orders[0].lang)(say("checking {path}", path=str(place))), err=True
            )
        return _mark(orders, None, verbose=verbose, show_hidden=False)


@commands.command()
@click.option("--distro", default="jazzy", show_default=True)
def prefix(distro: str) -> int:
    """Make the ROS prefix of a distro from PyPI's wheels unless it exists, and print its path."""
    from grader.ros.distro import find_distro  # noqa: PLC0415
    from grader.ros.prefix import wheels_prefix  # noqa: PLC0415
    from grader.sandbox.proof import prove_ros  # noqa: PLC0415

    found = wheels_prefix(
        find_distro(distro), prove=prove_ros, notify=lambda text: click.echo(text, err=True)
    )
    click.echo(found)
    return 0


@commands.command()
@click.option("--distro", help="Build the images of this distro; separate several with commas.")
@click.option(
    "--base",
    type=click.Choice(["ros", "wheels"]),
    default="ros",
    show_default=True,
    help="The base: the official ros:<distro>-ros-base, or PyPI's ROS wheels.",
)
@click.option("--extra-ca", type=click.Path(path_type=Path), help="A CA certificate (PEM) for pip.")
@click.option("--apt-mirror", default="", metavar="URL", help="The mirror for apt.")
@click.option("--pip-index", default="", metavar="URL", help="The package index for pip.")
@click.option("--base-image", default="", metavar="IMAGE", help="Another base image.")
def images(
    distro: str | None,
    base: Base,
    extra_ca: Path | None,
    apt_mirror: str,
    pip_index: str,
    base_image: str,
) -> int:
    """Build the Docker images of a distro (--distro), and list all images with their sizes.

    HTTP_PROXY, HTTPS_PROXY and NO_PROXY are passed to the build.
    """
    from grader.ros.distro import find_distro  # noqa: PLC0415
    from grader.ros.image_build import Network, build_image  # noqa: PLC0415
    from grader.ros.images import connect, image_table  # noqa: PLC0415

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
                notify=lambda text: click.echo(text, err=True),
            )
    rows = [
        row for row in image_table(client) if not wanted or row.distro in {d.name for d in wanted}
    ]
    width = max(len(row.name) for row in rows)
    for row in rows:
        size = f"{row.size / 1e6:,.0f} MB" if row.size is not None else "not here"
        click.echo(f"{row.name:<{width}}  {size:>10}  {row.id}".rstrip())
    return 0


for _command in (
    *CLASS_COMMANDS,
    *GRADEBOOK_COMMANDS,
    *MISTAKE_COMMANDS,
    *FIX_COMMANDS,
    *VALIDATE_COMMANDS,
):
    commands.add_command(_command)


def _hidden(count: int) -> str:
    if count == 0:
        return say("There are no hidden checks: your instructor's grader runs the same ones.")
    if count == 1:
        return say("Your instructor's grader also runs 1 hidden check.")
    return say("Your instructor's grader also runs {count} hidden checks.", count=count)


def _mark(orders: list[Order], out: Path | None, *, verbose: bool, show_hidden: bool) -> int:
    from grader.report import files, terminal  # noqa: PLC0415
    from grader.verdict.mark import grade as mark  # noqa: PLC0415

    translate = Translator(orders[0].lang)
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
            bare = say(
                "No sandbox was used: the package ran as your user, with access to your files."
            )
            click.echo(translate(bare), err=True)
    if not show_hidden:
        click.echo(translate(_hidden(orders[0].assignment.hidden_checks)))
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
