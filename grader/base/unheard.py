"""The listener where nobody listens."""

from __future__ import annotations


def unheard(what: object) -> None:
    """Take a text or an event, and do nothing with it."""
    del what
