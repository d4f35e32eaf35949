"""Mistakes in the period that create_timer is given."""

from __future__ import annotations

import ast
import re
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.constructor import lines_of
from grader.mistakes.example import DEAD, NODE, SILENT, example
from grader.mistakes.fixes import lines, node_timer
from grader.mistakes.kind import Family
from grader.mistakes.recognised import Raised, RecognisedMistake, Suspect
from grader.package.edit.tree import Replace
from grader.package.source.names import calls_in, last_part
from grader.package.source.period import seconds_of, timers_of_lines
from grader.package.source.place import statement_at

MICRO = 1e5  # seconds: a period in microseconds is ten times as long
LONG = 100.0  # seconds; a longer period was meant in milliseconds
REAL_NUMBER = (
    r"float\(\) argument must be .{1,60}not '(?P<type>\w{1,120})'"
    r"|must be real number, not (?P<old>\w{1,120})"
)
CALLABLE = ("method", "function")
TIMER = msg("Write self.create_timer({period}, self.{callback})")


NO_FLOAT = r"could not convert string to float: (?P<text>'[^'\n]{0,60}')"


def _negative(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    del match
    for timer in raised.source.timers:
        if timer.period is None or raised.line not in (None, timer.call.lineno):
            continue
        code = raised.source.module_of(timer.call).text.code(timer.period)
        period = raised.assignment.seconds
        return raised.finding("period_negative", at=timer.call, name=code, written=period)
    return None


def _zero(suspect: Suspect) -> RecognisedMistake | None:
    """The period is 0: the timer is due again at once."""
    for timer in suspect.source.timers:
        if timer.period is None or seconds_of(suspect.source, timer.period) != 0:
            continue
        value = node_timer.value_of(suspect.source, timer.period) or timer.period
        code, period = suspect.source.module_of(value).text.code(value), suspect.assignment.seconds
        found = suspect.finding("period_zero", value, name=code, written=period)
        return found if value is timer.period else replace(found, variant="elsewhere")
    return None


def _swapped(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    kind = match.groupdict().get("type")
    timers = [timer.call for timer in raised.source.timers]
    here = [call for call in timers if raised.line is None or raised.line in lines_of(call)]
    if not here or kind not in (None, *CALLABLE):
        return None
    return _call_swapped(raised, here[0])


def _call_swapped(raised: Raised, timer: ast.Call) -> RecognisedMistake:
    """The call with its two arguments in the right order."""
    text = raised.source.module_of(timer).text
    code = text.code(timer)
    if len(timer.args) != 2 or timer.keywords or "\n" in code:
        return raised.finding("timer_arguments_swapped")
    first, second = map(text.code, timer.args)
    written = f"{text.code(timer.func)}({second}, {first})"
    found = raised.finding("timer_arguments_swapped", at=timer, name=code, written=written)
    return replace(found, variant="call")


def _not_number(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The period is something else than a number: mostly a tuple, because of a comma."""
    if match["type"] in CALLABLE:
        return None
    for timer in raised.source.timers:
        if timer.period is None or raised.line not in (None, *lines_of(timer.call)):
            continue
        value = node_timer.value_of(raised.source, timer.period)
        number = node_timer.number_of(value)
        if match["type"] == "Parameter" and isinstance(value, ast.Call):
            code = raised.source.module_of(value).text.code(value)
            params = {"name": code, "written": f"{code}.value"}
            found = raised.finding("parameter_object", at=value, params=params)
            return replace(found, variant="written")
        if value is None or not number:
            return raised.finding("period_not_number", at=timer.call, type=match["type"])
        code = raised.source.module_of(value).text.code(value)
        params = {"name": code, "written": number, "type": match["type"]}
        found = raised.finding("period_not_number", at=value, params=params)
        return replace(
            found, variant="decimal" if "." not in code and "," in code[:-1] else "comma"
        )
    return None


def _argument_missing(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """Complete the student's own call, if what is missing is known."""
    del match
    for timer in raised.source.timers:
        if raised.line not in (None, *lines_of(timer.call)):
            continue
        found = node_timer.completed(raised.source, timer, raised.assignment.seconds)
        if found is None:
            return raised.finding("timer_argument_missing", at=timer.call)
        code = " ".join(raised.source.module_of(timer.call).text.code(timer.call).split())
        code = re.sub(r",? \)", ")", code.replace("( ", "("))
        params = {"name": code, "written": found.written}
        mistake = raised.finding("timer_argument_missing", at=timer.call, params=params)
        return replace(mistake, variant="written")
    return raised.finding("timer_argument_missing")


def _milliseconds(suspect: Suspect) -> RecognisedMistake | None:
    timers = timers_of_lines(suspect.source)
    given = timers[0].period if timers else None
    value = node_timer.value_of(suspect.source, given) if given is not None else None
    number = value.value if isinstance(value, ast.Constant) else None
    if not isinstance(number, int | float) or not number >= LONG > suspect.period:
        return None
    found = suspect.finding("period_milliseconds", value, written=f"{number:g}")
    variant = "" if number < MICRO else "large"
    if value is not None and value.lineno not in lines_of(timers[0].call):
        name = suspect.source.module_of(value).text.code(value)
        found = replace(found, words={**found.words, "name": name})
        variant = f"{variant}_there".lstrip("_")
    return replace(found, variant=variant)


def _period_text(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The line that makes the timer gives it a text; another text is no period."""
    statement = statement_at(raised.module, raised.line)
    calls = calls_in(statement) if statement is not None else ()
    if not any(last_part(name) == "create_timer" for _, name in calls):
        return None
    return raised.finding("period_text", params=match.groupdict(""))


_node = Family("node", links.FIRST_NODE)
KINDS = (
    _node(
        "period_not_number",
        "timer",
        msg("The period is not a number"),
        msg("create_timer takes the period first: a number of seconds, such as {period}."),
        TIMER,
        whys={
            "comma": msg("A comma at the end of a value makes a tuple of it, and not a number."),
            "decimal": msg(
                "A decimal number has a point in Python. With a comma it is a tuple, and not a "
                "number."
            ),
        },
        fixes={
            "comma": msg("Delete the comma after {written} on this line."),
            "decimal": msg("Write {written} instead of {name}."),
        },
        seen=r"float\(\) argument must be a string or a real number, not '(?P<type>tuple)'",
        raised={REAL_NUMBER: _not_number},
        fixed_by=(lines.written,),
        examples=(
            example(
                "period_is_tuple",
                Replace(
                    NODE,
                    "        self.create_timer(1.0,",
                    "        self.period_ = 1.0,\n        self.create_timer(self.period_,",
                ),
                fails="run.starts",
            ),
            example(
                "period_with_comma",
                Replace(
                    NODE,
                    "        self.create_timer(1.0,",
                    "        period = 1,0\n        self.create_timer(period,",
                ),
                fails="run.starts",
            ),
            example(
                "period_in_list",
                Replace(NODE, "create_timer(1.0,", "create_timer([1.0],"),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "timer_arguments_swapped",
        "timer",
        msg("The arguments of create_timer are swapped"),
        msg("create_timer takes the period first, then the callback."),
        TIMER,
        fixes={"call": msg("Write {written} instead of {name}.")},
        seen=r"float\(\) argument must be a string or a real number, not '(?:method|function)'",
        raised={
            REAL_NUMBER: _swapped,
            r"float\(\) argument must be|not '?(?:method|function)'?": _swapped,
        },
        fixed_by=(lines.written, node_timer.arguments),
        examples=(
            example(
                "timer_arguments_swapped",
                Replace(NODE, "1.0, self.timer_callback", "self.timer_callback, 1.0"),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "period_text",
        "timer",
        msg("The period is a string"),
        msg("The period is a number of seconds: no quotes, no unit."),
        TIMER,
        seen=rf"ValueError: {NO_FLOAT}",
        raised={NO_FLOAT: _period_text},
        fixed_by=(node_timer.period,),
        examples=(
            example("period_as_text", Replace(NODE, "(1.0,", "('1.0s',"), fails="run.starts"),
        ),
    ),
    _node(
        "timer_argument_missing",
        "timer",
        msg("An argument of create_timer is missing"),
        msg("create_timer takes the period first, then the callback."),
        TIMER,
        fixes={
            "written": msg("Write {written} instead of {name}."),
        },
        seen=r"create_timer\(\) missing \d{1,3} required positional argument",
        raised={r"create_timer\(\) missing": _argument_missing},
        fixed_by=(node_timer.arguments,),
        examples=(
            example("period_missing", Replace(NODE, "(1.0, self", "(self"), fails="run.starts"),
        ),
    ),
    _node(
        "period_negative",
        "timer",
        msg("The period is negative"),
        msg("The period is the time from one call of the callback to the next, in seconds."),
        msg("Write {written} instead of {name}."),
        raised={"timer period must be non-negative": _negative},
        fixed_by=(lines.written,),
        examples=(
            example("period_negative", Replace(NODE, "(1.0,", "(-1.0,"), fails="run.starts"),
        ),
    ),
    _node(
        "period_zero",
        "timer",
        msg("The period is 0"),
        msg("A timer with the period 0 is always due: it calls the callback without a pause."),
        msg("Write {written} instead of {name} in create_timer."),
        fixes={
            "elsewhere": msg("Write {written} instead of {name} in this line."),
        },
        behind=dict.fromkeys(("run.too_much_output", "run.wrong_period"), _zero),
        fixed_by=(lines.written,),
        examples=(
            example(
                "period_zero",
                Replace(NODE, "create_timer(1.0,", "create_timer(0,"),
                fails="run.output",
                blocks=("run.spins", *DEAD),
            ),
        ),
    ),
    _node(
        "period_milliseconds",
        "timer",
        msg("The period is not written in seconds"),
        msg("create_timer takes seconds, not milliseconds: {written} is {written} seconds."),
        TIMER,
        whys=dict.fromkeys(
            ("large", "large_there"),
            msg(
                "create_timer takes seconds, not micro- or nanoseconds: {written} is {written} "
                "seconds, many days or years."
            ),
        ),
        fixes=dict.fromkeys(
            ("there", "large_there"),
            msg("Write {period} instead of {name} on this line: it is the period of the timer."),
        ),
        behind={"run.no_lines": _milliseconds},
        fixed_by=(node_timer.period,),
        examples=(
            example(
                "period_in_milliseconds",
                Replace(NODE, "(1.0,", "(1000.0,"),
                fails="run.output",
                blocks=SILENT,
            ),
            example(
                "constant_in_milliseconds",
                Replace(NODE, "\n\nclass MyFirstNode", "PERIOD = 1000\n\n\nclass MyFirstNode"),
                Replace(NODE, "(1.0,", "(PERIOD,"),
                fails="run.output",
                blocks=SILENT,
            ),
        ),
    ),
)
