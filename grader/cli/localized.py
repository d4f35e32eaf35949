"""Translates the command line: the commands' help and click's own texts.

click uses gettext's global domain and the languages in the environment. While a command runs, that
domain is ours; texts that are not in our catalogue stay English.
"""

from __future__ import annotations

import gettext
import inspect
import os
import unicodedata
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager

import click

from grader.base.i18n.message import msg
from grader.base.i18n.translator import (
    DOMAIN,
    FOLDER,
    LANGUAGES,
    SOURCE,
    chosen_language,
    translated,
)

FILLER = "\x00"  # in no text
WIDE = ("W", "F")  # two columns (Unicode, UAX #11)
NO_DOMAIN = "messages"  # gettext's default, which has no catalogue
VARIABLE = "LANGUAGE"  # the environment variable that gettext reads first
CLICK = (  # click's own texts that a student may see
    msg("Usage:"),
    msg("Options"),
    msg("Commands"),
    msg("default: {default}"),
    msg("Show this message and exit."),
    msg("Show the version and exit."),
    msg("Try '{command} {option}' for help."),
    msg("Error: {message}"),
    msg("Invalid value: {message}"),
    msg("Invalid value for {param_hint}: {message}"),
    msg("Missing command."),
    msg("Missing argument"),
    msg("Missing option"),
    msg("No such option {name!r}."),
    msg("No such command {name!r}."),
    msg("Option {name!r} does not take a value."),
    msg("file"),
    msg("directory"),
    msg("path"),
    msg("{name} {filename!r} does not exist."),
    msg("{name} {filename!r} is a file."),
    msg("{name} {filename!r} is a directory."),
)
CLICK_PLURALS = (  # click's texts with a plural form
    ("Got unexpected extra argument ({args})", "Got unexpected extra arguments ({args})"),
    ("Did you mean {possibility}?", "(Did you mean one of: {possibilities}?)"),
    ("Option {name!r} requires an argument.", "Option {name!r} requires {nargs} arguments."),
    ("{value!r} is not {choice}.", "{value!r} is not one of {choices}."),
)


@contextmanager
def translated_help(lang: str, command: click.Command) -> Iterator[None]:
    """Within this context, translate click's own texts and those of a command."""
    if lang == SOURCE:
        yield
        return
    domain, languages = gettext.textdomain(), os.environ.get(VARIABLE)
    formatter, click.Context.formatter_class = click.Context.formatter_class, _Formatter
    os.environ[VARIABLE] = lang
    gettext.bindtextdomain(DOMAIN, str(FOLDER))
    gettext.textdomain(DOMAIN)
    try:
        with translated_texts(command, lang):
            yield
    finally:
        click.Context.formatter_class = formatter
        gettext.textdomain(domain)
        os.environ.pop(VARIABLE)
        if languages is not None:
            os.environ[VARIABLE] = languages


class _Formatter(click.HelpFormatter):
    """click's own, which counts characters, for characters that take two columns."""

    def write_text(self, text: str) -> None:
        super().write_text(_filled(text))

    def write_dl(
        self, rows: Iterable[tuple[str, str]], col_max: int = 30, col_spacing: int = 2
    ) -> None:
        filled = [(_filled(first), _filled(second)) for first, second in rows]
        super().write_dl(filled, col_max, col_spacing)

    def getvalue(self) -> str:
        return super().getvalue().replace(FILLER, "")


def _filled(text: str) -> str:
    """Return a text with a filler behind each wide character, so that it has as many as columns."""
    return "".join(c + FILLER * (unicodedata.east_asian_width(c) in WIDE) for c in text)


@contextmanager
def untranslated() -> Iterator[None]:
    """Within this context, click's own texts are English."""
    domain = gettext.textdomain()
    gettext.textdomain(NO_DOMAIN)
    try:
        yield
    finally:
        gettext.textdomain(domain)


@contextmanager
def translated_texts(command: click.Command, lang: str) -> Iterator[None]:
    """Within this context, translate the help of a command, its options and its subcommands."""
    helps = list(_helps(command))
    for owner, text in helps:
        owner.help = translated(inspect.cleandoc(text), lang)
    try:
        yield
    finally:
        for owner, text in helps:
            owner.help = text


def _helps(command: click.Command) -> Iterator[tuple[click.Command | click.Option, str]]:
    if command.help:
        yield command, command.help
    for option in command.params:
        if isinstance(option, click.Option) and option.help:
            yield option, option.help
    if isinstance(command, click.Group):
        for below in command.commands.values():
            yield from _helps(below)


def language_of(words: Sequence[str]) -> str:
    """Return the language of a command line: its --lang, else that of the environment."""
    own = list(words)[: words.index("--")] if "--" in words else list(words)
    for word, following in zip(own, [*own[1:], ""]):
        name, _, value = word.partition("=")
        if name == "--lang" and (value or following) in LANGUAGES:
            return value or following
    return chosen_language(os.environ)
