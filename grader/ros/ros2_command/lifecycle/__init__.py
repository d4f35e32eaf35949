"""Various lifecycle related sub-commands."""

VERBS = ("get", "list", "nodes", "set")
