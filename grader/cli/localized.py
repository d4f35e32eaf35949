"""The command line in the reader's language: the commands' help, and what click itself says.

click asks gettext's global domain, by the languages in the environment. So that domain is ours while
a command runs; what is not in our catalogue stays English.
"""

from __future__ import annotations

import gettext
import inspect
import os
from collections.abc import Iterator, Sequence
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

NAME = "LANGUAGE"  # of the variable that gettext looks at first
CLICK = (  # what a student meets of click's own texts
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
CLICK_COUNTED = (  # those of it that have a plural
    ("Got unexpected extra argument ({args})", "Got unexpected extra arguments ({args})"),
    ("Did you mean {possibility}?", "(Did you mean one of: {possibilities}?)"),
    ("Option {name!r} requires an argument.", "Option {name!r} requires {nargs} arguments."),
    ("{value!r} is not {choice}.", "{value!r} is not one of {choices}."),
)


@contextmanager
def said_in(lang: str, command: click.Command) -> Iterator[None]:
    """Let a command, and those below it, translate a language as long as this lasts."""
    if lang == SOURCE:
        yield
        return
    helps, domain, languages = list(_helps(command)), gettext.textdomain(), os.environ.get(NAME)
    os.environ[NAME] = lang
    gettext.bindtextdomain(DOMAIN, str(FOLDER))
    gettext.textdomain(DOMAIN)
    for owner, text in helps:
        owner.help = translated(inspect.cleandoc(text), lang)
    try:
        yield
    finally:
        for owner, text in helps:
            owner.help = text
        gettext.textdomain(domain)
        os.environ.pop(NAME)
        if languages is not None:
            os.environ[NAME] = languages


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
    """Return the language of a command line: its --lang, else what the environment asks for."""
    own = list(words)[: words.index("--")] if "--" in words else list(words)
    for word, following in zip(own, [*own[1:], ""]):
        name, _, value = word.partition("=")
        if name == "--lang" and (value or following) in LANGUAGES:
            return value or following
    return chosen_language(os.environ)
