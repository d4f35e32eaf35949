"""The messages of terminals, a module for each subject; a message is one entry in one of them."""

from __future__ import annotations

from grader.explain.terminal_text import TerminalText
from grader.explain.texts import (
    build,
    commands,
    general,
    graph,
    install,
    interfaces,
    launch,
    programs,
    pythons,
    screen,
    shell,
)

TEXTS: tuple[TerminalText, ...] = tuple(
    entry
    for module in (
        install, shell, pythons, screen, build, interfaces, launch, graph, commands, programs, general,
    )
    for entry in module.KINDS
)  # fmt: skip
