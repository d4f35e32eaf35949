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
    """A rule: `ask` returns the answer for the symptoms `of`, None if the facts have none.

    It says more than the mistakes in `over`, and is told in their place.
    """

    id: str
    of: tuple[str, ...]
    title: Template
    why: Template
    fix: Template
    ask: Callable[[Facts], Answer | None]
    over: tuple[str, ...] = ()

    @property
    def mistake(self) -> str:
        """The id of what it tells, as a mistake."""
        return f"node.{self.id}"

    def is_of(self, symptom: str) -> bool:
        """Whether the rule can explain a symptom: it begins with one of `of`."""
        return any(symptom.startswith(one) for one in self.of)


MISSING = (
    *("topic.never", "topic.none_then", "topic.no_reaction", "topic.too_few", "log.missing"),
    "run.no_lines",
)
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
        "field_gets",
        (*MISSING, "service.", "topic.", "run."),
        msg("A field has a value of another type"),
        msg(
            "Line {line} gives the field {field} a value of another type. The interface says that it is of "
            "the type {type}, and ROS ends the program when the message goes out."
        ),
        msg("Give {field} a value of the type {type} in line {line}."),
        lambda facts: facts.field_of_other_type(),
        over=("node.field_type",),
    ),
    Rule(
        "no_field",
        (*MISSING, "service.", "topic.", "run."),
        msg("A message has no field with that name"),
        msg("{type} has no field {field}. Its fields are: {fields}."),
        msg("Write the field that is meant in line {line}."),
        lambda facts: facts.no_such_field(),
        over=("node.attribute_unknown",),
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
        msg("Line {line} makes a timer: {name}. It did not call its callback once in the run."),
        msg(
            "The period is in seconds. Look at its value in line {line}, at what stops the timer, and "
            "whether the node to which it belongs is spun."
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
        "just_set",
        (*MISSING, *VALUES, "topic.not_silent"),
        msg("A value is compared with itself"),
        msg(
            "Line {line} ({setter}) runs before line {row}. There {kept} already has the new value, so that "
            "both sides of {code} are the same."
        ),
        msg("Set {kept} below the lines that still need its old value."),
        lambda facts: facts.just_set(),
    ),
    Rule(
        "setter_not_reached",
        MISSING,
        msg("The line that sets a value was never reached"),
        msg(
            "The condition in line {head} asks for {setter}. Line {line} ({code}) would set it, and never "
            "ran: {name} ran {count} times, and the condition in line {row} ({guard}) did not let it."
        ),
        msg(
            "Let line {line} run whatever the condition in line {row} says: move it out, or above it."
        ),
        lambda facts: facts.unset_name(),
    ),
    Rule(
        "line_not_reached",
        MISSING,
        msg("The line that does it was never reached"),
        msg(
            "{name} ran {count} times, and line {line} never: the condition in line {row} ({guard}) "
            "did not let it."
        ),
        msg("Look at what {test} was, and at the lines that set the values in it."),
        lambda facts: facts.guarded_doer(),
    ),
    Rule(
        "never_true_from",
        (*MISSING, *VALUES),
        msg("A condition was never true"),
        msg(
            "The condition in line {row} was evaluated {count} times, and was never true: {guard}. "
            "{name} comes from line {line}: {code}"
        ),
        msg(
            "Compare the values in line {row} with those for which it should be true, and look at how line "
            "{line} makes them."
        ),
        lambda facts: facts.constant_from(true=False),
    ),
    Rule(
        "never_true",
        (*MISSING, *VALUES),
        msg("A condition was never true"),
        msg("The condition in line {row} was evaluated {count} times, and was never true: {guard}"),
        msg("Compare the values in line {row} with those for which it should be true."),
        lambda facts: facts.constant(true=False),
    ),
    Rule(
        "state_kept",
        (*MISSING, *VALUES, "topic.not_silent", "log.too_"),
        msg("A value is never set back"),
        msg(
            "Line {line} ({code}) sets {name}, and no line sets it back in the run: the condition in "
            "line {row} ({guard}) stays as it is from then on."
        ),
        msg("Set {name} back where the state that it stands for is over."),
        lambda facts: facts.kept_state(),
    ),
    Rule(
        "always_true_from",
        (*VALUES, "topic.not_silent", "topic.reacts_too_often", "log.too_often", "log.forbidden"),
        msg("A condition was always true"),
        msg(
            "The condition in line {row} was evaluated {count} times, and was true each time: {guard}. "
            "{name} comes from line {line}: {code}"
        ),
        msg(
            "Compare the values in line {row} with those for which it should not be true, and look at how "
            "line {line} makes them."
        ),
        lambda facts: facts.constant_from(true=True),
    ),
    Rule(
        "always_true",
        (*VALUES, "topic.not_silent", "topic.reacts_too_often", "log.too_often", "log.forbidden"),
        msg("A condition was always true"),
        msg(
            "The condition in line {row} was evaluated {count} times, and was true each time: {guard}"
        ),
        msg("Compare the values in line {row} with those for which it should not be true."),
        lambda facts: facts.constant(true=True),
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
        "several_timers",
        ("run.twice", "run.wrong_period", "topic.several_at_once"),
        msg("The lines come from more than one timer"),
        msg(
            "One line of the node logs for {count} timers, which are created in these lines: {lines}."
        ),
        msg(
            "Keep one of them. A new timer does not stop an old one, also if it gets the same name: "
            "self.destroy_timer(...) does."
        ),
        lambda facts: facts.several_timers(),
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
        "parameter_not_read",
        (*MISSING, *VALUES, "topic.not_silent"),
        msg("No line reads a parameter"),
        msg(
            "Line {line} declares the parameter {name}, and no line reads it: its value changes nothing."
        ),
        msg("Use self.get_parameter('{name}').value where the task asks for this value."),
        lambda facts: facts.unread_parameter(),
    ),
    Rule(
        "value_in_branch",
        VALUES,
        msg("A value is made in this line"),
        msg(
            "Line {row} sends {field} = {value}. It was last set in line {line} ({code}), which runs "
            "if {guard} (line {head})."
        ),
        msg(
            "Here {field} must be {wanted}. Look at the condition in line {head}, and at line {line}."
        ),
        lambda facts: facts.writer_in_branch(),
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
