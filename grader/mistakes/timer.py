"""Mistakes in whether and how long the timer runs: none, stopped, reset, under a condition."""

from __future__ import annotations

import ast
import re
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.example import NODE, SILENT, example
from grader.mistakes.fixes import lines, node_scope, node_timer
from grader.mistakes.kind import Family
from grader.mistakes.order import attribute_needed_early
from grader.mistakes.recognised import NAME_ERROR, OWN_ATTRIBUTE, Raised, RecognisedMistake, Suspect
from grader.mistakes.scope import creates_timer
from grader.package.edit.tree import Replace
from grader.package.source.names import calls_in, dotted, last_part, own_name
from grader.package.source.place import function_at


def _by_hand_early(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    early = attribute_needed_early(raised, match)
    names = {timer.method for timer in raised.source.timers} - {""}
    for call, _ in calls_in(early.needs) if early is not None else ():
        if own_name(call.func) in names:
            return raised.finding("called_by_hand", at=call)
    return None


def _outside_init(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    if match["name"] != "self" or not creates_timer(raised):
        return None
    return (
        None if function_at(raised.module, raised.line) else raised.finding("timer_at_class_level")
    )


def _missing(suspect: Suspect) -> RecognisedMistake | None:
    source = suspect.source
    beside = [call for m in source.beside for call in calls_in(m.tree)]
    if source.timers or any(last_part(name) == "create_timer" for _, name in beside):
        return None
    if source.node_class is None or source.calls_of("create_subscription"):
        return None
    return suspect.finding("timer_missing", source.methods.get("__init__"))


def _called_once(suspect: Suspect) -> RecognisedMistake | None:
    """No timer is created, and __init__ calls the method that logs, in no loop."""
    source, init = suspect.source, suspect.source.methods.get("__init__")
    if source.timers or source.calls_of("create_timer"):
        return None
    for call, name in calls_in(init) if init is not None else ():
        method, module = source.methods.get(own_name(call.func)), source.module_of(call)
        loops = [part for part in module.around(call) if isinstance(part, ast.For | ast.While)]
        if method is None or not source.logs(method) or call.args or call.keywords or loops:
            continue
        new = f"self.create_timer({suspect.assignment.seconds}, {name})"
        found = suspect.finding("timer_missing", call, name=f"{name}()", written=new)
        return replace(found, variant="by_hand")
    return None


def _by_hand(suspect: Suspect) -> RecognisedMistake | None:
    source = suspect.source
    init = source.methods.get("__init__")
    names = {dotted(timer.callback) for timer in source.timers if timer.callback} - {""}
    for call, name in calls_in(init) if init else ():
        if name in names:
            found = suspect.finding("called_by_hand", call)
            return replace(found, words={**found.words, "callback": last_part(name)})
    return None


_node = Family("node", links.FIRST_NODE)
KINDS = (
    _node(
        "timer_at_class_level",
        "timer",
        msg("The timer is created outside of __init__"),
        msg(
            "Lines indented directly below the class run when the class is defined; there is no "
            "self yet."
        ),
        msg("Indent the line so that it is part of __init__."),
        links.PYTHON_CLASSES,
        raised={NAME_ERROR: _outside_init},
        fixed_by=(node_scope.indented,),
        examples=(
            example(
                "timer_at_class_level",
                Replace(
                    NODE,
                    "        self.create_timer(1.0, self.timer_callback)\n",
                    "\n    self.create_timer(1.0, self.timer_callback)\n",
                ),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "timer_missing",
        "timer",
        msg("No timer is created"),
        msg("Only a timer calls the callback again and again."),
        msg("Write in __init__: self.create_timer({period}, self.{callback})"),
        whys={
            "by_hand": msg("{name} calls the method once. Only a timer calls it again and again."),
        },
        fixes={
            "by_hand": msg("Write {written} instead of {name}."),
        },
        behind={"run.no_lines": _missing, "run.stops": _called_once},
        fixed_by=(lines.written, node_timer.made),
        examples=(
            example(
                "callback_called_once",
                Replace(
                    NODE, "self.create_timer(1.0, self.timer_callback)", "self.timer_callback()"
                ),
                fails="run.output",
                also={"run.period": "run.by_hand"},
            ),
            example(
                "timer_missing",
                Replace(NODE, "        self.create_timer(1.0, self.timer_callback)\n", ""),
                fails="run.output",
                blocks=SILENT,
            ),
        ),
    ),
    _node(
        "called_by_hand",
        "timer",
        msg("__init__ calls the callback itself"),
        msg("The timer makes the first call after one period; your own call comes too early."),
        msg("Remove the line self.{callback}() from __init__."),
        raised={OWN_ATTRIBUTE: _by_hand_early},
        behind={"run.by_hand": _by_hand},
        fixed_by=(node_timer.by_hand,),
        deletes=("",),
        examples=(
            example(
                "called_by_hand_before_counter",
                Replace(
                    NODE,
                    "        self.counter_ = 0\n",
                    "        self.timer_callback()\n        self.counter_ = 0\n",
                ),
                fails="run.starts",
            ),
            example(
                "called_by_hand",
                Replace(
                    NODE,
                    "self.create_timer(1.0, self.timer_callback)",
                    ("self.create_timer(1.0, self.timer_callback)\n        self.timer_callback()"),
                ),
                fails="run.period",
            ),
        ),
    ),
)
