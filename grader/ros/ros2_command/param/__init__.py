"""Various param related sub-commands."""

VERBS = ("delete", "describe", "dump", "get", "list", "load", "set")
