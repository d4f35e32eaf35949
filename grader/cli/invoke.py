"""Runs a command line: its exit status, and error messages instead of tracebacks."""

from __future__ import annotations

import os
import signal
import sys
import traceback
from types import FrameType

import click

from grader.base.errors import GraderError
from grader.base.gate import gated_output
from grader.base.i18n.message import say
from grader.base.i18n.translator import Translator, chosen_language
from grader.base.plain_text import first_lines
from grader.cli.localized import language_of, translated_help

MOST_LINES = 60  # of an error message


class Terminated(BaseException):
    """SIGTERM or SIGHUP was received. An exception, so that all clean-up code runs."""


def _terminated(number: int, frame: FrameType | None) -> None:
    del number, frame
    raise Terminated


def run(command: click.Command, name: str, argv: list[str] | None) -> int:
    """Run a command line and return its exit status (docs/architecture.md)."""
    signal.signal(signal.SIGTERM, _terminated)
    signal.signal(signal.SIGHUP, _terminated)
    words = sys.argv[1:] if argv is None else argv
    lang = language_of(words)
    with gated_output(), translated_help(lang, command):
        return _run(command, name, words, lang)


def _run(command: click.Command, name: str, argv: list[str], lang: str) -> int:
    try:
        status = command.main(args=argv, prog_name=name, standalone_mode=False, obj=lang)
        return status if isinstance(status, int) else 0
    except click.exceptions.Exit as done:
        return done.exit_code
    except click.ClickException as error:
        error.show()
        return 2
    except GraderError as error:
        lines = first_lines(f"{name}: {error}", lines=MOST_LINES)
        click.echo("\n".join(lines), err=True)
        return error.exit_status
    except (KeyboardInterrupt, click.Abort):
        _print_error(say("{name}: interrupted; nothing was left running", name=name))
        return 130
    except Terminated:
        _print_error(say("{name}: terminated; nothing was left running", name=name))
        return 143
    except BrokenPipeError:  # the reader of our output has closed it (| head)
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 1
    except Exception:  # a bug of ours; the traceback may quote anything, so it passes the gate
        traceback.print_exc()
        _print_error(
            say(
                "{name}: this is a bug in the program: please report it with all of the above",
                name=name,
            )
        )
        return 3


def _print_error(text: str) -> None:
    click.echo(Translator(chosen_language(os.environ))(text), err=True)
