"""The names of the sandboxes, for the command line."""

from __future__ import annotations

from grader.base.errors import UsageError
from grader.base.i18n.message import joined, say
from grader.base.nearest import did_you_mean

NAMES = ("auto", "docker", "bubblewrap", "account", "none")


def check_name(name: str) -> None:
    """Raise UsageError (with a "did you mean") if no sandbox has that name."""
    if name not in NAMES:
        known = say("Sandboxes: {names}.", names=", ".join(NAMES))
        raise UsageError(
            say("there is no sandbox '{name}'", name=name),
            remedy=joined(did_you_mean(name, NAMES), known),
        )
