"""The `window` command: serves the page until Ctrl+C."""

from __future__ import annotations

import os
import webbrowser
from collections.abc import Sequence

import click

from grader.base.i18n.message import msg, say
from grader.base.i18n.translator import Translator, chosen_language, errors_in
from grader.cli import options
from grader.cli.invoke import run
from lab.window.published import HOST, LOCALHOST, PORT


def main(argv: Sequence[str] | None = None) -> int:
    """Run the command line and return its exit status."""
    return run(command, "window", list(argv or ()))


@click.command(
    context_settings={"help_option_names": ["-h", "--help"]},
    help=msg(
        "Open a page in the browser with the turtle, the graph, the log, plots and parameters.\n\n"
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
@click.option("--no-open", is_flag=True, help=msg("Do not open the browser."))
@options.lang
def command(port: int, host: str, no_open: bool, lang: str | None) -> int:
    """Serve the page."""
    from lab.window.serve import serve  # noqa: PLC0415 - keeps --help fast

    translate = Translator(lang or chosen_language(os.environ))

    def ready(address: str) -> None:
        click.echo(translate(say("The window is open at this address. Ctrl+C ends it.")))
        click.echo(f"\n  {address}\n")
        if not no_open and _has_browser():
            webbrowser.open(address)

    with errors_in(translate.lang):
        try:
            serve(host, port, translate.lang, os.environ, ready)
        except KeyboardInterrupt:
            click.echo(translate(say("The window is closed.")))
    return 0


def _has_browser() -> bool:
    """Whether a browser can be opened from here: a desktop, and not in the lab."""
    desktop = os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY")
    return bool(desktop) and not os.environ.get("LAB_PROGRAMS")
