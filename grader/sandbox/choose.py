"""Which sandbox marks: `auto`, or the one that was asked for; each is proven by opening it."""

from __future__ import annotations

import difflib
import os

from grader.errors import SurroundingsError
from grader.errors import UsageError
from grader.limits import Limits
from grader.ros.prefix import Ros
from grader.sandbox.base import Sandbox

NAMES = ("auto", "bubblewrap", "account", "none")
DISPOSABLE = "GRADER_DISPOSABLE"


def check_name(name: str) -> None:
    """Raise UsageError (with a "did you mean") if there is no sandbox of that name."""
    if name not in NAMES:
        close = difflib.get_close_matches(name.lower(), NAMES, n=1)
        hint = f"did you mean '{close[0]}'? " if close else ""
        raise UsageError(
            f"there is no sandbox '{name}'", remedy=f"{hint}Sandboxes: {', '.join(NAMES)}."
        )


def open_sandbox(name: str, ros: Ros, limits: Limits, *, own_code: bool = False) -> Sandbox:
    """Return an opened sandbox; the caller closes it.

    `own_code` allows `auto` to end at `none`, for a student's own package. Raises
    SurroundingsError where no sandbox is to be had, with cause and remedy.
    """
    check_name(name)
    tried: list[SurroundingsError] = []
    for choice in _choices(name, own_code=own_code):
        try:
            sandbox = _make(choice, ros, limits)
            sandbox.__enter__()
        except SurroundingsError as error:
            tried.append(error)
        else:
            return sandbox
    raise SurroundingsError(
        "no sandbox to mark in: " + "\n".join(error.message for error in tried),
        remedy="\n".join(error.remedy for error in tried if error.remedy),
    )


def _choices(name: str, *, own_code: bool) -> list[str]:
    if name != "auto":
        return [name]
    choices = ["bubblewrap"]
    if os.environ.get(DISPOSABLE) == "1":
        choices.append("account")
    return [*choices, "none"] if own_code else choices


def _make(name: str, ros: Ros, limits: Limits) -> Sandbox:
    # each sandbox is loaded only when it is asked for: `grader --help` must not pay for it
    if name == "bubblewrap":
        from grader.sandbox.bubblewrap import Bubblewrap  # noqa: PLC0415

        return Bubblewrap(ros, limits)
    from grader.sandbox import plain  # noqa: PLC0415

    return plain.Account(ros, limits) if name == "account" else plain.Bare(ros, limits)
