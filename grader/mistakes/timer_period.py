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
from grader.mistakes.fixes.case import Case
from grader.mistakes.kind import Family
from grader.mistakes.recognised import Raised, RecognisedMistake, Suspect, first_of
from grader.package.edit.files import Files
from grader.package.edit.tree import Replace
from grader.package.source.module import Function
from grader.package.source.names import calls_in, dotted, last_part
from grader.package.source.node import NodeSource
from grader.package.source.period import is_right, origin_of, seconds_of, timers_of_lines
from grader.package.source.place import statement_at
from grader.package.source.timer import Timer

MOST_EXPONENT = 9
MICRO = 1e5  # seconds: a period in microseconds is ten times as long
MANY_PERIODS = 30  # a run without a line has waited for fewer of them
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


def _part_of_duration(suspect: Suspect) -> RecognisedMistake | None:
    """The period is taken from one part of a timedelta, which does not have the whole time."""
    source = suspect.source
    for timer in source.timers:
        value = timer.period and (node_timer.value_of(source, timer.period) or timer.period)
        parts = [n for n in ast.walk(value) if isinstance(n, ast.Attribute)] if value else []
        parts = [n for n in parts if n.attr in ("microseconds", "seconds", "days")]
        if value is None or len(parts) != 1 or not _is_timedelta(source, parts[0].value):
            continue
        code = source.module_of(value).text.code
        written = f"{code(parts[0].value)}.total_seconds()"
        found = suspect.finding("period_zero", value, name=code(value), written=written)
        words = {**found.words, "part": parts[0].attr}
        return replace(found, words=words, variant="duration")
    return None


def _is_timedelta(source: NodeSource, part: ast.expr) -> bool:
    """Whether a value is what timedelta() makes, or a name that is set once, to that."""
    call = part if isinstance(part, ast.Call) else node_timer.value_of(source, part)
    return isinstance(call, ast.Call) and last_part(dotted(call.func)) == "timedelta"


def _zero(suspect: Suspect) -> RecognisedMistake | None:
    """The period is 0: the timer is due again at once."""
    for timer in suspect.source.timers:
        if timer.period is None or seconds_of(suspect.source, timer.period) != 0:
            continue
        value = node_timer.value_of(suspect.source, timer.period) or timer.period
        code = suspect.source.module_of(value).text.code(value)
        period = suspect.assignment.seconds
        if value is timer.period and isinstance(value, ast.Constant):
            return suspect.finding("period_zero", timer.call, name=code, written=period)
        found = suspect.finding("period_zero", value, name=code, written=period)
        whole = any(isinstance(n, ast.FloorDiv) for n in ast.walk(value))
        return replace(found, variant="whole" if whole else "elsewhere")
    return None


def _dot_for_comma(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """A number and the next argument have a dot between them."""
    row = raised.module.line(raised.line)
    found = re.search(rf"(?P<number>\d+\.\d*|\d+)\.[ \t]*(?P<next>{match['name']})\b", row)
    if found is None:
        return None
    written = f"{found['number']}, {found['next']}"
    return raised.finding("dot_for_comma", name=found[0], written=written)


def _swapped(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    kind = match.groupdict().get("type")
    timers = [timer.call for timer in raised.source.timers]
    here = [call for call in timers if raised.line is None or raised.line in lines_of(call)]
    if not here or kind not in (None, *CALLABLE):
        return None
    return _given_swapped(raised, here[0]) or _call_swapped(raised, here[0])


def _call_swapped(raised: Raised, timer: ast.Call) -> RecognisedMistake:
    """The call with its two arguments in the right order."""
    text = raised.source.module_of(timer).text
    code = text.code(timer)
    if len(timer.args) != 2 or timer.keywords or "\n" in code:
        return raised.finding("timer_arguments_swapped")
    first, second = map(text.code, timer.args)
    value = getattr(timer.args[1], "value", None)
    assignment = raised.assignment
    long = isinstance(value, int | float) and value >= LONG > (assignment.period or LONG)
    written = f"{text.code(timer.func)}({assignment.seconds if long else second}, {first})"
    found = raised.finding("timer_arguments_swapped", at=timer, name=code, written=written)
    if not long:
        return replace(found, variant="call")
    return replace(found, variant="milliseconds", words={**found.words, "value": second})


def _given_swapped(raised: Raised, timer: ast.Call) -> RecognisedMistake | None:
    """The period and the callback are parameters, and the call of that method swaps them."""
    function = raised.source.function_around(timer)
    parameters = (
        [a.arg for a in function.args.args if a.arg != "self"] if function is not None else []
    )
    given = [dotted(argument) for argument in timer.args[:2]]
    if function is None or len(parameters) != 2 or {*given} != {*parameters}:
        return None
    calls = [c for c, name in raised.source.calls if last_part(name) == function.name]
    if len(calls) != 1 or len(calls[0].args) != 2 or calls[0].keywords:
        return None
    text = raised.source.module_of(calls[0]).text
    first, second = map(text.code, calls[0].args)
    written = f"{text.code(calls[0].func)}({second}, {first})"
    params = {"name": text.code(calls[0]), "written": written}
    if "\n" in params["name"]:
        return None
    found = raised.finding("timer_arguments_swapped", at=calls[0], params=params)
    words = {**found.words, "method": function.name, "parameters": ", ".join(parameters)}
    return replace(found, words=words, variant="given")


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
        period = raised.assignment.seconds
        if (decorates := _decorates(raised, timer)) is not None:
            return decorates
        found = node_timer.completed(raised.source, timer, period)
        if found is None:
            return raised.finding("timer_argument_missing", at=timer.call)
        if (other := _used_elsewhere(raised, timer)) is not None:
            return other
        code = " ".join(raised.source.module_of(timer.call).text.code(timer.call).split())
        code = re.sub(r",? \)", ")", code.replace("( ", "("))
        params = {"name": code, "written": found.written}
        mistake = raised.finding("timer_argument_missing", at=timer.call, params=params)
        return replace(mistake, variant="written")
    return raised.finding("timer_argument_missing")


def _decorates(raised: Raised, timer: Timer) -> RecognisedMistake | None:
    """The call of create_timer is written as a decorator of the callback."""
    module = raised.source.module_of(timer.call)
    function = module.parents.get(timer.call)
    if not isinstance(function, Function) or timer.call not in function.decorator_list:
        return None
    code = module.text.code
    in_class = isinstance(module.parents.get(function), ast.ClassDef)
    owner = "self." if in_class else code(timer.call.func).removesuffix("create_timer")
    period = timer.period
    seconds = code(period) if period is not None else raised.assignment.seconds
    callback = f"self.{function.name}" if in_class else function.name
    written = f"{owner}create_timer({seconds}, {callback})"
    name = f"@{code(timer.call)}"
    found = raised.finding("timer_argument_missing", at=timer.call, name=name)
    words = {**found.words, "method": function.name, "written": written}
    return replace(found, words=words, variant="decorator_in_class" if in_class else "decorator")


def _used_elsewhere(raised: Raised, timer: Timer) -> RecognisedMistake | None:
    """A method is called on the timer in the same line, and gets the callback: .then(callback)."""
    module = raised.source.module_of(timer.call)
    attribute = module.parents.get(timer.call)
    call = module.parents.get(attribute) if isinstance(attribute, ast.Attribute) else None
    if not isinstance(call, ast.Call) or call.func is not attribute:
        return None
    code, given = module.text.code, [*call.args, *(k.value for k in call.keywords)]
    name = code(call)
    if len(given) != 1 or timer.period is None or "\n" in name:
        return None
    written = f"{code(timer.call.func)}({code(timer.period)}, {code(given[0])})"
    found = raised.finding("timer_argument_missing", at=call, name=name, written=written)
    return replace(found, variant="written")


def _without_chain(case: Case) -> Files | None:
    """Write the call with its callback instead of a chain of calls that begins with create_timer."""
    name = str(case.finding.params.get("name", ""))
    return lines.written(case) if re.search(r"create_timer\([^()]*\)\.\w", name) else None


def _milliseconds(suspect: Suspect) -> RecognisedMistake | None:
    timers = timers_of_lines(suspect.source)
    given = timers[0].period if timers else None
    value = node_timer.value_of(suspect.source, given) if given is not None else None
    origin = origin_of(suspect.source, given)
    if value is None and origin is not None and origin.calculation is None:
        value = origin.number  # (the default of a parameter, or a constant of the class)
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


def _far_too_long(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a period in seconds that the source shows, and in which no line can come so soon."""
    source, timers = suspect.source, timers_of_lines(suspect.source)
    given = timers[0].period if len(timers) == 1 else None
    if given is None:
        return None
    origin = origin_of(source, given)
    seconds = origin.seconds if origin is not None else seconds_of(source, given)
    if seconds is None or not seconds >= MANY_PERIODS * suspect.period:
        return None
    value = node_timer.value_of(source, given) or given
    if origin is not None and origin.calculation is None:
        value = origin.number
    code = source.module_of(value).text.code(value)
    if "\n" in code:
        return None
    params = {"name": code, "value": f"{seconds:g}", "written": suspect.assignment.seconds}
    return suspect.finding("period_far_too_long", value, **params)


def _caret(suspect: Suspect) -> RecognisedMistake | None:
    """Look for ^ in the period, which in other languages is the power."""
    source = suspect.source
    for timer in source.timers:
        value = node_timer.value_of(source, timer.period) if timer.period is not None else None
        if value is None or not any(map(_is_caret, ast.walk(value))):
            continue
        code = source.module_of(value).text.code(value)
        power = _power(value)
        right = power is not None and is_right(power[1], suspect.period)
        written = power[0] if power is not None and right else suspect.assignment.seconds
        return suspect.finding("period_caret", value, name=code, written=written)
    return None


def _is_caret(node: ast.AST) -> bool:
    return isinstance(node, ast.BinOp) and isinstance(node.op, ast.BitXor)


def _power(value: ast.expr) -> tuple[str, float] | None:
    """Return a power that is written with ^ as Python writes it, and its value."""
    if not isinstance(value, ast.BinOp) or not isinstance(value.op, ast.BitXor):
        return None
    base, exponent = (_integer(part) for part in (value.left, value.right))
    if base is None or exponent is None or not 0 < base <= LONG or abs(exponent) > MOST_EXPONENT:
        return None
    return f"{base}**{exponent}", float(base) ** exponent


def _integer(part: ast.expr) -> int | None:
    if isinstance(part, ast.UnaryOp) and isinstance(part.op, ast.USub):
        inner = _integer(part.operand)
        return -inner if inner is not None else None
    value = part.value if isinstance(part, ast.Constant) else None
    return value if type(value) is int else None


NO_DECORATOR = msg(
    "create_timer is no decorator: it is called with the period and the callback, and creates the "
    "timer."
)


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
        "dot_for_comma",
        "timer",
        msg("There is a dot where a comma belongs"),
        msg(
            "A comma separates the arguments of a call. Behind a dot, Python looks for an attribute."
        ),
        msg("Write {written} instead of {name}."),
        links.PYTHON_ERRORS,
        raised={
            r"'(?:float|int)' object has no attribute '(?P<name>\w{1,120})'": _dot_for_comma,
        },
        fixed_by=(lines.written,),
        examples=(
            example(
                "dot_for_comma",
                Replace(NODE, "create_timer(1.0, self", "create_timer(1.0. self"),
                fails="run.starts",
            ),
        ),
    ),
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
        whys={
            "given": msg(
                "{method} takes {parameters} in this order, and passes them on to create_timer. This "
                "call gives them in the other order."
            ),
            "milliseconds": msg(
                "create_timer takes the period first, then the callback. The period is in seconds: "
                "{value} is {value} seconds."
            ),
        },
        fixes=dict.fromkeys(
            ("given", "call", "milliseconds"), msg("Write {written} instead of {name}.")
        ),
        seen=r"float\(\) argument must be a string or a real number, not '(?:method|function)'",
        raised={
            REAL_NUMBER: _swapped,
            r"float\(\) argument must be|not '?(?:method|function)'?": _swapped,
        },
        fixed_by=(lines.written, node_timer.arguments),
        examples=(
            example(
                "timer_arguments_of_set_interval",
                Replace(NODE, "(1.0, self.timer_callback)", "(self.timer_callback, 1000)"),
                fails="run.starts",
            ),
            example(
                "timer_arguments_swapped_for_a_method",
                Replace(
                    NODE,
                    "self.create_timer(1.0, self.timer_callback)",
                    "self.start(1.0, self.timer_callback)",
                ),
                Replace(
                    NODE,
                    "    def timer_callback",
                    "    def start(self, call, seconds):\n        self.create_timer(seconds, call)\n\n"
                    "    def timer_callback",
                ),
                fails="run.starts",
            ),
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
            "decorator": msg(
                "Delete the line {name}, and write {written} on a line of its own below the lines of "
                "{method}, indented like def {method}."
            ),
            "decorator_in_class": msg(
                "Delete the line {name}, and write {written} in __init__, below super().__init__(…)."
            ),
        },
        whys={"decorator": NO_DECORATOR, "decorator_in_class": NO_DECORATOR},
        seen=r"create_timer\(\) missing \d{1,3} required positional argument",
        raised={r"create_timer\(\) missing": _argument_missing},
        fixed_by=(_without_chain, node_timer.arguments),
        examples=(
            example(
                "callback_given_to_then",
                Replace(NODE, "(1.0, self.timer_callback)", "(1.0).then(self.timer_callback)"),
                fails="run.starts",
            ),
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
        "period_caret",
        "timer",
        msg("^ is not the power"),
        msg("In Python, ^ compares the bits of two numbers, and ** is the power."),
        msg("Write {written} instead of {name} in this line."),
        links.PYTHON_ERRORS,
        behind=dict.fromkeys(
            ("run.wrong_period", "run.no_lines", "run.too_much_output", "run.stops"), _caret
        ),
        fixed_by=(lines.written,),
        examples=(
            example(
                "period_with_caret",
                Replace(NODE, "\n\nclass MyFirstNode", "PERIOD = 10^0\n\n\nclass MyFirstNode"),
                Replace(NODE, "(1.0,", "(PERIOD,"),
                fails="run.period",
            ),
        ),
    ),
    _node(
        "period_zero",
        "timer",
        msg("The period is 0"),
        msg("A timer with the period 0 is always due: it calls the callback without a pause."),
        msg("Write {written} instead of {name} in create_timer."),
        whys={
            "duration": msg(
                "A timedelta has its time in three parts: days, seconds and microseconds. {name} takes "
                "only its {part}, which is not the whole time."
            ),
            "whole": msg(
                "{name} is 0: // leaves out what is behind the point. A timer with the period 0 is "
                "always due: it calls the callback without a pause."
            ),
        },
        fixes={
            "duration": msg("Write {written} instead of {name}: it is the whole time in seconds."),
            "whole": msg("Write {written} instead of {name} in this line."),
            "elsewhere": msg("Write {written} instead of {name} in this line."),
        },
        behind=dict.fromkeys(
            ("run.too_much_output", "run.wrong_period"), first_of(_part_of_duration, _zero)
        ),
        fixed_by=(lines.written,),
        examples=(
            example(
                "microseconds_of_a_duration",
                Replace(
                    NODE,
                    "import rclpy\nfrom",
                    "from datetime import timedelta\n\nimport rclpy\nfrom",
                ),
                Replace(
                    NODE, "\n\nclass MyFirst", "PERIOD = timedelta(seconds=1)\n\n\nclass MyFirst"
                ),
                Replace(NODE, "(1.0,", "(PERIOD.microseconds / 1e6,"),
                fails="run.output",
                blocks=("run.spins", *DEAD),
            ),
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
    _node(
        "period_far_too_long",
        "timer",
        msg("The period is much too long"),
        msg("With {name} the period is {value} s: the first line comes only after this time."),
        msg("Write {written} instead of {name} on this line."),
        links.FIRST_NODE,
        behind={"run.no_lines": _far_too_long},
        fixed_by=(lines.written,),
        examples=(
            example(
                "period_in_minutes",
                Replace(NODE, "(1.0,", "(1.0 * 60,"),
                fails="run.output",
                blocks=SILENT,
            ),
        ),
    ),
)
