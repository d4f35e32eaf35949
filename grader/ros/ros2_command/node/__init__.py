"""Various node related sub-commands."""

VERBS = ("list",)
