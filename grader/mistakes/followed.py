"""What a followed run shows, where no other record has the reason: where the way to a line ends."""

from __future__ import annotations

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.kind import Family

_node = Family("node", links.FIRST_NODE)
KINDS = (
    _node(
        "not_reached",
        "callback",
        msg("The line that logs is not reached"),
        msg(
            "The grader ran the node and followed it: whenever this line ran, {name} was false. So "
            "{log}, which logs, did not run."
        ),
        msg(
            "Find out why it is false: log the values that it asks for in the line above it, and look "
            "at where the program sets them."
        ),
        whys={
            "always_true": msg(
                "The grader ran the node and followed it: whenever this line ran, {name} was true. So "
                "its else, and with it {log}, which logs, did not run."
            ),
            "empty": msg(
                "The grader ran the node and followed it: whenever this line ran, {name} had no items. "
                "So {log}, which logs, did not run."
            ),
            "leaves": msg(
                "The grader ran the node and followed it: the program came to this line each time, and "
                "so never to {log}, which logs."
            ),
            "waits": msg(
                "The grader ran the node and followed it: the program waits in this line, and does not come "
                "to {log}, which logs."
            ),
            "not_called": msg(
                "Nothing in the program calls {name}, so {log}, which logs, did not run."
            ),
            "not_spun": msg(
                "The timer of this line belongs to a node that is in no executor. So ROS did not call "
                "{name}, and {log}, which logs, did not run."
            ),
            "stopped": msg(
                "The timer of this line was stopped in {place} before it was due. So ROS did not call "
                "{name}, and {log}, which logs, did not run."
            ),
        },
        fixes={
            "always_true": msg(
                "Find out why it is true: log the values that it asks for in the line above it, and look "
                "at where the program sets them."
            ),
            "empty": msg("Find out why it has no items: look at where the program fills it."),
            "leaves": msg(
                "Find out why the program comes to this line: log, above it, the values that decide it."
            ),
            "waits": msg(
                "Find out what this line waits for, and what would have to run for that. While a callback "
                "waits, ROS calls no other callback of its group, and all of a node are in one group unless "
                "the program says otherwise."
            ),
            "not_called": msg("Call {name} where the line is to be logged."),
            "not_spun": msg(
                "Create the timer with the node that is spun. If you want two nodes, add both to one "
                "executor with add_node, and call its spin."
            ),
            "stopped": msg("Let this timer run on: find out why the program comes to {place}."),
        },
    ),
    _node(
        "several_timers",
        "timer",
        msg("The lines come from more than one timer"),
        msg(
            "The grader ran the node and followed it: it logs from {count} timers. They are created "
            "here: {places}."
        ),
        msg(
            "Keep one of them. A new timer does not stop an old one, also if it gets the same name: "
            "self.destroy_timer(...) does."
        ),
    ),
)
