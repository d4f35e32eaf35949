"""Various action related sub-commands."""

VERBS = ("info", "list", "send_goal", "type")
