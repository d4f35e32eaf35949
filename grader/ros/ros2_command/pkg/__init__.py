"""Various package related sub-commands."""

VERBS = ("create", "executables", "list", "prefix", "xml")
