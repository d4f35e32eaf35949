"""Various daemon related sub-commands."""

VERBS = ("start", "status", "stop")
