"""A group of commands whose modules are imported only to run them."""

from __future__ import annotations

from collections.abc import Mapping
from importlib import import_module
from typing import Any, NamedTuple

import click

from grader.base.i18n.translator import SOURCE
from grader.cli.localized import translated_texts, untranslated


class LazyCommand(NamedTuple):
    """Where a command is (`module:attribute`), and the first line of its help.

    A `hidden` command is for other programs: no help lists it.
    """

    target: str
    help: str
    hidden: bool = False

    def load(self) -> click.Command:
        """Import the command."""
        module, _, attribute = self.target.partition(":")
        with untranslated():  # click.Path takes its name's translation when it is made
            command = getattr(import_module(module), attribute)
        assert isinstance(command, click.Command)
        return command


class LazyGroup(click.Group):
    """A group whose --help lists the commands of a table without importing them.

    `obj` of its context is the language of the help.
    """

    def __init__(self, *args: Any, lazy: Mapping[str, LazyCommand], **kwargs: Any) -> None:
        super().__init__(*args, **kwargs)
        self.lazy = lazy
        for name, entry in lazy.items():
            self.add_command(click.Command(name, help=entry.help, hidden=entry.hidden))

    def resolve_command(
        self, ctx: click.Context, args: list[str]
    ) -> tuple[str | None, click.Command | None, list[str]]:
        """Import the command that the arguments name; its help is translated until `ctx` closes."""
        name, command, rest = super().resolve_command(ctx, args)
        if name is not None and name in self.lazy:
            command = self.lazy[name].load()
            ctx.with_resource(translated_texts(command, ctx.obj or SOURCE))
        return name, command, rest
