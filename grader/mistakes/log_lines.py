"""The catalogue: lines of the log that are missing, or that must not be there."""

from __future__ import annotations

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.kind import Family

_log = Family("log", links.LOGGING)
KINDS = (
    _log(
        "wrong_text",
        "text",
        msg("A log line has other text than asked for"),
        msg("The text is compared letter by letter, with its capitals, points and spaces."),
        msg("Log exactly: {wanted}"),
    ),
    _log(
        "wrong_count",
        "text",
        msg("The log counts differently"),
        msg("Each line shows the number that the counter has at that moment."),
        msg("Look at where the counter begins, and where and by how much it is changed."),
    ),
    _log(
        "wrong_period",
        "text",
        msg("The log lines come at a different rate"),
        msg("The first argument of create_timer is the period in seconds: 2 Hz is 0.5 s."),
        msg("Write self.create_timer({wanted}, …)."),
    ),
    _log(
        "wrong_level",
        "logger",
        msg("The log records have another level"),
        msg("The level says how urgent a record is, and whether it is shown."),
        msg("Write self.get_logger().{level}(…) in the callback."),
    ),
    _log(
        "missing",
        "text",
        msg("A log line is missing"),
        msg("A line is logged each time the logger is called, with the text that it gets."),
        msg(
            "Look at the call of the logger, and at the text that it gets: it must be the expected one, at that time."
        ),
    ),
    _log(
        "too_often",
        "text",
        msg("A log line comes too often"),
        msg(
            "A line comes each time the logger is called: each condition on the way to it is true."
        ),
        msg(
            "Look at the conditions on the way to the logger, and at the values in them. If there is "
            "none, keep the last state in an attribute, and log only when it changes."
        ),
    ),
    _log(
        "forbidden",
        "text",
        msg("A log line that must not come"),
        msg("Warnings and errors in the log say that something went wrong."),
        msg("Find what makes the node log this line."),
    ),
)
