"""Mistakes in the first number of the counter: its start, and counting before the log line."""

from __future__ import annotations

from dataclasses import replace

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.counted import counter_in
from grader.mistakes.example import LOG_LINE, NODE, STEP_LINE, example
from grader.mistakes.fixes import node_count
from grader.mistakes.kind import Family
from grader.mistakes.recognised import RecognisedMistake, Suspect
from grader.package.edit.tree import Replace
from grader.package.source.counter import adds_to, targets_of, texts_of
from grader.package.source.plain_counter import plain_start


def _adds_before_log(suspect: Suspect) -> RecognisedMistake | None:
    """A line of the callback itself, in no branch, adds to the counter above the log line."""
    counter, callback = counter_in(suspect), suspect.source.callback
    if counter is None or callback is None:
        return None
    texts = texts_of(callback, counter.logged)
    read = min([counter.logged.lineno, *(text.lineno for text in texts)])
    added = [n for n in callback.body if adds_to(n, counter.name) and n.lineno < read]
    start = plain_start(suspect.source, counter.name)
    if not added or start is None or suspect.source.function_around(counter.logged) is not callback:
        return None
    found = suspect.finding("adds_before_log", added[0], name=counter.name)
    written = suspect.source.module_of(added[0]).text.code(added[0])
    words = {**found.words, "written": written[:80], "line": str(counter.logged.lineno)}
    words["first"] = str(start.at.lineno)
    other = start.number != suspect.output.start
    return replace(found, words=words, variant="other" if other else "")


def _starts_elsewhere(suspect: Suspect) -> RecognisedMistake | None:
    counter, start = counter_in(suspect), suspect.output.start
    first = plain_start(suspect.source, counter.name) if counter is not None else None
    if counter is None or first is None or first.number == start:
        return None
    around = suspect.source.module_of(first.at).parents.get(first.at)
    name = next(targets_of(around), counter.name) if around is not None else counter.name
    return suspect.finding("starts_elsewhere", first.at, name=name, start=start)


_node = Family("node", links.FIRST_NODE)
KINDS = (
    _node(
        "adds_before_log",
        "counter",
        msg("The callback adds to the counter before it logs"),
        msg("The first line must show the counter's first value."),
        msg(
            "Move this line ({written}) below line {line}, which logs: log first, and then count. "
            "Then the first line shows {start}."
        ),
        fixes={
            "other": msg(
                "Move this line ({written}) below line {line}, which logs: log first, and then count. "
                "In line {first}, write {start} as the first value of {name}."
            ),
        },
        behind={"run.wrong_start": _adds_before_log},
        fixed_by=(node_count.start,),
        deletes=("", "other"),
        examples=(
            example(
                "adds_before_logging",
                Replace(
                    NODE,
                    (
                        "self.get_logger().info('Hello time: ' + str(self.counter_))\n"
                        "        self.counter_ += 1"
                    ),
                    (
                        "self.counter_ += 1\n"
                        "        self.get_logger().info('Hello time: ' + str(self.counter_))"
                    ),
                ),
                fails="run.output",
            ),
            example(
                "adds_before_text",
                Replace(
                    NODE,
                    LOG_LINE + STEP_LINE,
                    "        self.counter_ = self.counter_ + 1\n"
                    "        text = 'Hello time: ' + str(self.counter_)\n"
                    "        self.get_logger().info(text)\n",
                ),
                fails="run.output",
            ),
        ),
    ),
    _node(
        "starts_elsewhere",
        "counter",
        msg("The counter starts at a different number"),
        msg("The first line shows the first value of the counter."),
        msg("Write on that line: {name} = {start}"),
        behind={"run.wrong_start": _starts_elsewhere},
        fixed_by=(node_count.start,),
        examples=(
            example(
                "starts_at_one",
                Replace(NODE, "self.counter_ = 0", "self.counter_ = 1"),
                fails="run.output",
            ),
        ),
    ),
)
