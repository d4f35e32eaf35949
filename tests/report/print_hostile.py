"""A program that prints a hostile text in each of the given ways.

After each way it prints that way and the exit status.
"""

from __future__ import annotations

import logging
import sys
import warnings

import click
from rich.table import Table
from rich.text import Text

from grader.base.errors import SurroundingsError
from grader.base.gate import show
from grader.base.gated_console import GatedConsole
from grader.cli.invoke import run
from grader.report.page import Page

HOSTILE = "\x1b[2J\x1b[1;1H\x1b]0;owned\x07\x1b[32mScore 100 / 100\x1b[0m\r\b\x9b31m\u202egrade\x00"


@click.command()
@click.argument("way")
def command(way: str) -> None:
    """Print the hostile text in one way."""
    match way:
        case "print":
            print(HOSTILE)
        case "write":
            sys.stderr.write(HOSTILE)
        case "echo":
            click.echo(HOSTILE)
        case "secho":
            click.secho(HOSTILE, fg="red", err=True)
        case "warning":
            warnings.warn(HOSTILE, stacklevel=1)
        case "logging":
            logging.getLogger("library").warning(HOSTILE)
        case "error":
            raise SurroundingsError(f"Docker refused: {HOSTILE}", remedy=HOSTILE)
        case "usage":
            raise click.UsageError(HOSTILE)
        case "crash":
            raise RuntimeError(HOSTILE)
        case "console":
            table = Table(title=HOSTILE)
            table.add_row(Text(HOSTILE, style="bold"))
            GatedConsole(sys.stdout).print(table, HOSTILE)
        case "page":
            page = Page(width=80, styled=sys.stdout.isatty())
            page.line((HOSTILE, "bold"), HOSTILE)
            page.quote([HOSTILE])
            page.code("change", [HOSTILE])
            page.grid(["one", "two"], [[(HOSTILE, "red"), (HOSTILE, "")]])
            show(str(page), sys.stdout)
        case "long":
            raise SurroundingsError("x" * 1_000_000 + "\n" * 10_000 + "the end")


if __name__ == "__main__":
    for word in sys.argv[1:]:
        status = run(command, "print_hostile", [word])
        sys.stderr.flush()
        print(f"\n== {word} {status}", flush=True)
