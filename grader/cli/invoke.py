"""Runs a command line: its exit status, and error messages instead of tracebacks."""

from __future__ import annotations

import contextlib
import os
import signal
import sys
import traceback
from collections.abc import Iterator
from types import FrameType
from typing import TextIO

import click

from grader.base.errors import GraderError
from grader.base.gate import gated_output
from grader.base.i18n.message import say
from grader.base.i18n.translator import OWN, SAMPLES, SOURCE, Translator, chosen_language
from grader.base.plain_text import first_lines
from grader.cli.localized import language_of, translated_help
from grader.report.notice import notice

UTF_8 = "utf-8"
MOST_LINES = 60  # of an error message


class Terminated(BaseException):
    """SIGTERM or SIGHUP was received. An exception, so that all clean-up code runs."""


def _terminated(number: int, frame: FrameType | None) -> None:
    del number, frame
    raise Terminated


def run(command: click.Command, name: str, argv: list[str] | None) -> int:
    """Run a command line and return its exit status (docs/architecture.md)."""
    if argv is None and sys.getfilesystemencoding() != UTF_8:
        _restart_with_utf8()
    signal.signal(signal.SIGTERM, _terminated)
    signal.signal(signal.SIGHUP, _terminated)
    words = sys.argv[1:] if argv is None else argv
    with _readable_language():
        lang = language_of(words)
        with gated_output(), translated_help(lang, command):
            return _run(command, name, words, lang)


def _restart_with_utf8() -> None:
    """Replace this process by the same in Python's UTF-8 mode; it writes as before.

    File names and files are in UTF-8 whatever the locale, and a locale such as ISO 8859-1 could not
    even name a folder that a report mentions.
    """
    os.environ.setdefault("PYTHONIOENCODING", sys.stdout.encoding if sys.stdout else UTF_8)
    os.execv(sys.executable, [sys.executable, "-X", "utf8", *sys.orig_argv[1:]])  # noqa: S606


@contextlib.contextmanager
def _readable_language() -> Iterator[None]:
    """Within this context, the environment asks for a language that the output can show.

    An encoding without Hangul would show escapes only. (--lang is not changed.)
    """
    sample = SAMPLES[chosen_language(os.environ)]
    if all(_encodes(stream, sample) for stream in (sys.stdout, sys.stderr)):
        yield
        return
    before = os.environ.get(OWN)
    os.environ[OWN] = SOURCE
    try:
        yield
    finally:
        os.environ.pop(OWN)
        if before is not None:
            os.environ[OWN] = before


def _encodes(stream: TextIO | None, sample: str) -> bool:
    try:
        sample.encode(getattr(stream, "encoding", None) or "utf-8")
    except (UnicodeEncodeError, LookupError):
        return False
    return True


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
        notice("\n".join(lines), sys.stderr)
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
    notice(Translator(chosen_language(os.environ))(text), sys.stderr)
