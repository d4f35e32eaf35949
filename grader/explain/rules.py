"""Rules: what a fact of a followed run explains, each as a sentence with the values of that fact.

A rule asks the facts by their queries alone. The first one whose question has an answer is told: they
are in the order of the chain made, spun, due, called, reached, done, and values come last.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from types import MappingProxyType

from grader.base.i18n.message import Template, msg
from grader.explain.facts import Answer, Facts


@dataclass(frozen=True)
class Rule:
    """A rule: `ask` returns the answer for the symptoms `of`, None if the facts have none."""

    id: str
    of: tuple[str, ...]
    title: Template
    why: Template
    fix: Template
    ask: Callable[[Facts], Answer | None]

    @property
    def mistake(self) -> str:
        """The id of what it tells, as a mistake."""
        return f"node.{self.id}"

    def is_of(self, symptom: str) -> bool:
        """Whether the rule can explain a symptom: it begins with one of `of`."""
        return any(symptom.startswith(one) for one in self.of)


MISSING = ("topic.never", "topic.none_then", "topic.no_reaction", "topic.too_few", "log.missing")
VALUES = ("topic.wrong_value", "service.wrong_answer", "world.")

RULES: tuple[Rule, ...] = (
    Rule(
        "never_returns",
        (*MISSING, "service.", "topic.stops", "run.stays", "run."),
        msg("A line of the node does not come back"),
        msg(
            "The node stood in line {line} until the end: {code} waits there. Nothing else runs "
            "meanwhile, no timer and no callback."
        ),
        msg("Do not wait in a callback: replace line {line} by something that returns at once."),
        lambda facts: facts.stands(),
    ),
    Rule(
        "callback_raises",
        (*MISSING, "service.", "topic.", "run."),
        msg("A line of the node raises an exception"),
        msg("Line {line} raises {error}, and the node ends there."),
        msg("Look at the values in line {line}: {code}"),
        lambda facts: facts.raises(),
    ),
    Rule(
        "timer_not_called",
        MISSING,
        msg("A timer never calls its callback"),
        msg(
            "Line {line} makes a timer: {name}. It did not call its callback once in the {seconds} s of the run."
        ),
        msg(
            "The period is in seconds. Look at its value in line {line}, and at what stops the timer."
        ),
        lambda facts: facts.idle_timer(),
    ),
    Rule(
        "callback_not_called",
        (*MISSING, "topic.wrong_value"),
        msg("A callback is never called"),
        msg(
            "Line {line} subscribes to {topic}, and {name} was never called: no message came there "
            "under this name, type and quality of service."
        ),
        msg(
            "Compare the name and the type in line {line} with those of the sender, letter by letter."
        ),
        lambda facts: facts.deaf_callback(),
    ),
    Rule(
        "function_not_called",
        MISSING,
        msg("No line calls a function that does the work"),
        msg("{name} is defined in line {line}, and nothing calls it."),
        msg("Call {name}, or give it to the timer or to the subscription as its callback."),
        lambda facts: facts.uncalled_doer(),
    ),
    Rule(
        "line_not_reached",
        MISSING,
        msg("The line that does it was never reached"),
        msg(
            "{name} ran {count} times, and line {line} never: the condition in line {row} ({guard}) "
            "did not let it."
        ),
        msg("Look at what {guard} was, and at the lines that set the values in it."),
        lambda facts: facts.guarded_doer(),
    ),
    Rule(
        "too_often",
        ("topic.not_silent", "topic.reacts_too_often", "log.too_often", "log.forbidden"),
        msg("A line runs more often than it should"),
        msg("Line {line} ran {count} times: {name} was called {calls} times."),
        msg("Line {line} must not run then: put it under a condition that is false at that time."),
        lambda facts: facts.repeated_doer(),
    ),
    Rule(
        "field_not_set",
        VALUES,
        msg("No line sets a field"),
        msg("No line of {name} sets {field}, so that it keeps the value of a new message."),
        msg("Set {field} before the message goes out in line {line}."),
        lambda facts: facts.unset_field(),
    ),
    Rule(
        "value_from",
        VALUES,
        msg("A value is made in this line"),
        msg("Line {row} sends {field} = {value}. It was last set in line {line} ({code})."),
        msg("Here {field} must be {wanted}. Look at the values in line {line}."),
        lambda facts: facts.writer_of_field(),
    ),
)
BY_ID: Mapping[str, Rule] = MappingProxyType({rule.id: rule for rule in RULES})
BY_MISTAKE: Mapping[str, Rule] = MappingProxyType({rule.mistake: rule for rule in RULES})


def explained(facts: Facts, symptom: str) -> tuple[Rule, Answer] | None:
    """Return the first rule that explains a symptom, with its answer; None if none does."""
    for rule in RULES:
        answer = rule.ask(facts) if rule.is_of(symptom) else None
        if answer is not None:
            return rule, answer
    return None
