"""A small change with which a check passes, found by trying it, where no other record has one."""

from __future__ import annotations

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.kind import Family

_node = Family("node", links.FIRST_NODE)
KINDS = (
    _node(
        "small_change",
        "callback",
        msg("A small change here lets the check pass"),
        msg(
            "The grader ran the node with {written} instead of {name} in this line, and then this "
            "check passes."
        ),
        msg("Write {written} instead of {name}."),
        whys={
            "long": msg(
                "The grader ran the node with this line changed, and then this check passes."
            ),
            "several": msg(
                "One change alone does not help. The grader ran the node with these changes together, and "
                "then this check passes."
            ),
            "word": msg(
                "The grader ran the node with another text than {name} in this line, and then this check "
                "passes."
            ),
            "seconds": msg(
                "ROS counts periods in seconds. The grader ran the node with {written} instead of "
                "{name} in this line, and then this check passes."
            ),
            "before_spin": msg(
                "{written} waits until Ctrl+C, so no line below it runs before. The grader ran the node with this "
                "line above it, and then this check passes."
            ),
            "field": msg(
                "The value of a parameter is in one field only, that of its type. The other fields are 0, empty "
                "or false. The grader ran the node with {written} instead of {name} in this line, and then this "
                "check passes."
            ),
            "unit": msg(
                "One second is 1000 milliseconds, 1000000 microseconds or 1000000000 nanoseconds. The grader "
                "ran the node with {written} instead of {name} in this line, and then this check passes."
            ),
            "digits": msg(
                "{name} is a text, also if it has only digits: nothing can be added to it as to a number. The "
                "grader ran the node with {written}, and then this check passes."
            ),
            "bits": msg(
                "~, & and | work on the bits of a number: ~True is -2, which counts as true, and & comes before "
                "==. In a condition, not, and, or are meant. The grader ran the node with {written} instead of "
                "{name} in this line, and then this check passes."
            ),
            "power": msg(
                "^ compares the bits of two numbers: 10 ^ 3 is 9. A power is written with **. The grader ran "
                "the node with {written} instead of {name} in this line, and then this check passes."
            ),
            "condition": msg(
                "The lines below {name} run only when its condition is true. The grader ran the node "
                "with these lines each time, and then this check passes."
            ),
            "branches": msg(
                "Each call runs only one branch of this condition. The grader ran the node with the lines below "
                "{name} each time, and without the other branches, and then this check passes."
            ),
            "else": msg(
                "The grader ran the node without the condition {name}, with only the lines of its "
                "else, and then this check passes."
            ),
            "loop": msg(
                "The grader ran the node without the loop {name}, so that the lines in it run once, "
                "and then this check passes."
            ),
            "with": msg(
                "The grader ran the node with the lines below {name} outside of this block, and then "
                "this check passes."
            ),
            "out": msg(
                "This line is in the block of {form}. The grader ran the node with this line below "
                "that block, and then this check passes."
            ),
            "moved": msg(
                "The order of these lines matters. The grader ran the node with this line above "
                "{written}, and then this check passes."
            ),
            "moved_down": msg(
                "The order of these lines matters. The grader ran the node with this line below "
                "{written}, and then this check passes."
            ),
            "deleted": msg(
                "The grader ran the node without this line, and then this check passes."
            ),
            "moved_lines": msg(
                "The order of these lines matters. The grader ran the node with all lines of {name} "
                "above {written}, and then this check passes."
            ),
            "base": msg(
                "{name} is not the Node of rclpy. The grader ran the node with that as the base of "
                "the class, and then this check passes."
            ),
            "slept": msg(
                "This line sleeps, and while a callback sleeps, nothing else in the node runs. The "
                "grader ran the node without this line, and then this check passes."
            ),
            "deleted_lines": msg(
                "The grader ran the node without the lines that begin here, and then this check passes."
            ),
            "emptied": msg(
                "The grader ran the node with pass instead of this line, and then this check passes."
            ),
            "below": msg(
                "The grader ran the node with one more line below this one, {written}, and then this "
                "check passes."
            ),
            "above": msg(
                "The grader ran the node with one more line above this one, {written}, and then this "
                "check passes."
            ),
            "own": msg(
                "{name} is a variable of one function: other functions do not have it, and it is gone "
                "when the function ends. The grader ran the node with {written}, which belongs to the "
                "node, and then this check passes."
            ),
            "renamed": msg(
                "Node, from which the class inherits, uses the name {name} itself. The grader ran the "
                "node with another name, and then this check passes."
            ),
            "argument": msg(
                "The grader ran the node without the argument {form} in this line, and then this check "
                "passes."
            ),
            "called": msg(
                "{name} only names the function. The grader ran the node with {written}, which calls "
                "it, and then this check passes."
            ),
            "not_called": msg(
                "{name} calls the function in this line. The grader ran the node with {written}, "
                "which only names it, and then this check passes."
            ),
            "returned": msg(
                "This function changes {form} before it returns it, so that it gives the next value "
                "already the first time. The grader ran the node with the value from before the "
                "change, and then this check passes."
            ),
            "gives_itself": msg(
                "A function without return gives None, and the value of a call of {name} is used. The "
                "grader ran the node with return self as its last line, and then this check passes."
            ),
            "unkept": msg(
                "{name} in a line of its own works out a value and keeps it nowhere. The grader ran the "
                "node with {written}, and then this check passes."
            ),
            "falsy": msg(
                "0, an empty string and an empty list count as false in a condition, as None does. "
                "The grader ran the node with this line asking only for None, and then this check "
                "passes."
            ),
            "inexact": msg(
                "A float is not exact: 0.1 added ten times is a little less than 1. The grader ran the node "
                "with {form} rounded in this line, and then this check passes."
            ),
        },
        fixes={
            "returned": msg(
                "Keep the value in a variable before the line that changes it, and write {written} "
                "instead of {name}."
            ),
            "gives_itself": msg("Write return self below this line, as the last line of {name}."),
            "long": msg("Make the change below."),
            "condition": msg(
                "If these lines are meant to run each time, delete the line {name}, and indent the lines of "
                "its block one step less. If not, correct the condition: log the values that it asks for."
            ),
            "else": msg(
                "Delete the line {name} with the lines below it, and keep the lines of its else, "
                "indented one step less."
            ),
            "branches": msg(
                "Delete the whole condition with all its branches, and keep only the lines below {name}, "
                "indented one step less."
            ),
            "loop": msg(
                "If the lines of this loop are meant to run once, delete the line {name}, and indent them one "
                "step less. If not, log what changes from one turn of the loop to the next, and correct that."
            ),
            "with": msg("Delete the line {name}, and indent the lines of its block one step less."),
            "out": msg("Move this line out of the block of {form}, to below it."),
            "moved": msg("Move this line above {written}."),
            "before_spin": msg("Move this line above {written}."),
            "moved_down": msg("Move this line below {written}."),
            "deleted": msg(
                "Delete this line if the program does not need it. If it does, find out what this line "
                "changes for the lines that are logged, and correct that."
            ),
            "moved_lines": msg("Move all lines of {name} above {written}."),
            "base": msg(
                "Write Node instead of {name}, and at the top of the file: from rclpy.node import Node"
            ),
            "slept": msg("Delete this line: the timer waits, and not the callback."),
            "deleted_lines": msg(
                "Delete the lines that the change below takes away, if the program does not need them. If it "
                "does, find out what they change for the lines that are logged, and correct that."
            ),
            "word": msg(
                "Find out what {name} is used for in this line. With {written}, for example, the check passes."
            ),
            "emptied": msg(
                "Find out when this line runs, and what it changes for the lines that are logged. Then "
                "correct that, or delete it if the program does not need it."
            ),
            "below": msg("Write {written} below this line."),
            "above": msg("Write {written} above this line."),
            "own": msg("Write {written} instead of {name} wherever the change below does."),
            "renamed": msg("Use another name everywhere in the file, such as {written}."),
            "argument": msg("Write {written}."),
        },
    ),
    _node(
        "one_of_two",
        "text",
        msg("One of two mistakes is here"),
        msg(
            "The grader ran the node with {written} instead of {name} in this line. Then the text of "
            "each line is right, and only the number is not: that is another mistake."
        ),
        msg("Write {written} instead of {name}. Then grade again."),
    ),
)
