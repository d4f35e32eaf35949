"""Various node related sub-commands."""

VERBS = ("info", "list")
