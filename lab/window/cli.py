"""The `window` command: serves the page of the lab until Ctrl+C."""

from __future__ import annotations

import os
import webbrowser
from collections.abc import Sequence
from pathlib import Path

import click

from grader.base.i18n.message import msg, say
from grader.base.i18n.translator import Translator, chosen_language, errors_in
from grader.cli import options
from grader.cli.invoke import run
from lab.window.published import DESCRIPTOR, HOST, IN_PAGE, LOCALHOST, PORT, has_browser


def main(argv: Sequence[str] | None = None) -> int:
    """Run the command line and return its exit status."""
    return run(command, "window", list(argv or ()))


@click.command(
    context_settings={"help_option_names": ["-h", "--help"]},
    help=msg(
        "Open the lab in the browser: guide, editor, terminals, turtle, graph, log, plots and "
        "parameters in one page.\n\n"
        "The page shows the nodes that this terminal sees. Only this machine can open it, and only "
        "with the address that is printed. Ctrl+C ends it."
    ),
)
@click.option(
    "--port",
    type=click.IntRange(0, 65535),
    envvar=PORT,
    default=0,
    help=msg("The port of the page. [default: a free one]"),
)
@click.option(
    "--host",
    envvar=HOST,
    default=LOCALHOST,
    show_default=True,
    help=msg("The address to listen on; a container needs its own, to publish the port."),
)
@click.option(
    "--socket",
    "unix",
    type=click.Path(path_type=Path),
    help=msg("Listen on a Unix socket instead; another server passes the page's requests on."),
)
@click.option(
    "--descriptor",
    type=click.IntRange(0),
    envvar=DESCRIPTOR,
    help=msg("Listen on the open socket with this file descriptor instead."),
)
@click.option(
    "--front",
    metavar="URL",
    default="",
    help=msg("The address of the page as the browser has it, if another server passes it on."),
)
@click.option("--served", is_flag=True, hidden=True)
@click.option("--no-open", is_flag=True, help=msg("Do not open the browser."))
@options.lang
def command(
    port: int,
    host: str,
    unix: Path | None,
    descriptor: int | None,
    front: str,
    served: bool,
    no_open: bool,
    lang: str | None,
) -> int:
    """Serve the page."""
    from lab.window.serve import Place, kept, serve  # noqa: PLC0415 - keeps --help fast

    translate = Translator(lang or chosen_language(os.environ))
    if os.environ.get(IN_PAGE):
        click.echo(translate(say("This page shows it already: turtle, graph, log and plots.")))
        return 0

    programs = os.environ.get("LAB_PROGRAMS")

    def ready(address: str) -> None:
        click.echo(translate(say("The window is open at this address. Ctrl+C ends it.")))
        click.echo(f"\n  {address}\n")
        if not no_open and has_browser(os.environ):
            webbrowser.open(address)

    with errors_in(translate.lang):
        try:
            place = Place(host, port, unix, descriptor, front)
            if programs and not served:
                words = [f"{programs}/window", "--served", "--lang", translate.lang]
                words += ["--front", front, "--host", host]
                kept(place, words, ready)
            serve(place, translate.lang, os.environ, (lambda _: None) if served else ready)
        except KeyboardInterrupt:
            click.echo(translate(say("The window is closed.")))
    return 0
