"""Mistakes in the timer: none is made, what create_timer gets, and the callback that it calls."""

from __future__ import annotations

import ast
import re
from collections.abc import Callable
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.base.nearest import nearest
from grader.base.shown import shown
from grader.mistakes import links
from grader.mistakes.example import DEAD, NODE, SILENT, example
from grader.mistakes.fixes import lines, node_scope, node_timer
from grader.mistakes.kind import INSTEAD, Family
from grader.mistakes.recognised import (
    MISSING_ARGUMENT,
    NAME_ERROR,
    OWN_ATTRIBUTE,
    Raised,
    RecognisedMistake,
    Suspect,
    of_self,
)
from grader.package.edit.tree import Replace
from grader.package.source.endless import methods_run_by
from grader.package.source.module import Function
from grader.package.source.names import calls_in, dotted, last_part, own_name
from grader.package.source.parameters import def_after, needed_besides_self, only_self, uses_of
from grader.package.source.period import is_right, seconds_of, timers_of_lines
from grader.package.source.place import function_at, statement_at
from grader.package.source.timer import Timer

REFUSED = (
    r"float\(\) argument must be .{1,60}not '?\w|must be real number, not (?!Parameter)\w"
    r"|not '?(?:method|function)'?$|create_timer\(\) missing \d|timer period must be non-negative"
    r"|could not convert string to float: '[^'\n]{0,60}'"
)
NO_PARAMETER = (
    r"(?:(?P<function>[\w.<>]{1,120})\(\) )?takes 0 positional arguments but 1 was given"
    "|invalid method signature"
)
CALLED = (
    "'NoneType' object is not callable|'arg_name'|is not a callable object"
    r"|TypeError: \w{1,120}\.(?P<called>\w{1,120})\(\) takes"
)
TIMER = msg("Write self.create_timer({period}, self.{callback})")


def _missing(suspect: Suspect) -> RecognisedMistake | None:
    source = suspect.source
    beside = [call for m in source.beside for call in calls_in(m.tree)]
    if source.timers or any(last_part(name) == "create_timer" for _, name in beside):
        return None
    if source.node_class is None or source.calls_of("create_subscription", "sleep"):
        return None
    return suspect.finding("timer_missing", source.methods.get("__init__"))


def _refused(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The line that makes a timer does not give it a period and a callback."""
    del match
    statement = statement_at(raised.module, raised.line)
    inside = {call for call, _ in calls_in(statement)} if statement is not None else set()
    for timer in raised.source.timers:
        if timer.call not in inside:
            continue
        text = raised.source.module_of(timer.call).text
        given = [*timer.call.args, *(k.value for k in timer.call.keywords)]
        own = [n for n in given if own_name(n) in raised.source.methods]
        if len(own) != 1 or len(given) > 2:
            return raised.finding("timer_arguments", at=timer.call)
        new = f"{text.code(timer.call.func)}({raised.assignment.seconds}, {text.code(own[0])})"
        code = text.code(timer.call)
        found = raised.finding("timer_arguments", at=timer.call, name=code, written=new)
        return replace(found, variant="written")
    return None


def _long_period(suspect: Suspect) -> RecognisedMistake | None:
    """No line comes in time: the period is longer, or none at all. (A shorter one can be counted down.)"""
    return _other_period(suspect, lambda seconds: not 0 < seconds < suspect.period)


def _short_period(suspect: Suspect) -> RecognisedMistake | None:
    return _other_period(suspect, lambda seconds: seconds < suspect.period)


def _other_period(suspect: Suspect, explains: Callable[[float], bool]) -> RecognisedMistake | None:
    """The timer that logs has a period whose value the source says, and it is not the required one."""
    timers = timers_of_lines(suspect.source)
    given = timers[0].period if len(timers) == 1 else None
    seconds = seconds_of(suspect.source, given) if given is not None else None
    if given is None or seconds is None or is_right(seconds, suspect.period):
        return None
    if not explains(seconds):
        return None
    value = node_timer.value_of(suspect.source, given) or given
    code, period = suspect.source.module_of(value).text.code(value), suspect.assignment.seconds
    found = suspect.finding("period_wrong", value, name=code, written=period)
    return replace(found, words={**found.words, "seconds": f"{seconds:g}"})


def _called(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    name = match.groupdict().get("called")
    for timer in raised.source.timers:
        if timer.called and (name is None or timer.method == name):
            return _without_brackets(raised, timer)
    return None


def _called_early(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The callback runs in __init__, before the line that sets what it needs."""
    del match
    source, function = raised.source, function_at(raised.module, raised.line)
    for timer in source.timers:
        method = source.methods.get(timer.method)
        if timer.called and method and function in (method, *methods_run_by(source, method)):
            return _without_brackets(raised, timer)
    return None


def _calls_back_at_once(suspect: Suspect) -> RecognisedMistake | None:
    called = [timer for timer in suspect.source.timers if timer.called]
    return _without_brackets(suspect, called[0]) if called else None


def _without_brackets(where: Raised | Suspect, timer: Timer) -> RecognisedMistake | None:
    """Return that a timer's callback is called where it should be passed, and how it is passed."""
    call, source = timer.callback, where.source
    method = source.methods.get(timer.method)
    if not isinstance(call, ast.Call) or method is None:
        return None  # (what a function of a library is for is not known)
    if any(isinstance(n, ast.Return) and n.value is not None for n in ast.walk(method)):
        return None  # (it may return the function that the timer is to call)
    text = source.module_of(call).text
    kept = bool(call.args or call.keywords) and len(method.args.args) > 1
    written = f"lambda: {text.code(call)}" if kept else text.code(call.func)
    params = {"name": text.code(call), "written": written}
    if isinstance(where, Suspect):
        return where.finding("callback_called", timer.call, **params)
    return where.finding("callback_called", at=timer.call, params=params)


def _is_callback(raised: Raised, match: re.Match[str]) -> bool:
    """Whether the missing attribute is what a timer calls."""
    name = match["name"]
    return of_self(raised, match) and any(t.method == name for t in raised.source.timers)


def _in_function(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The callback is inside of another function: of __init__, or of one that ends the class."""
    name = match["name"]
    for node in raised.module.nodes if _is_callback(raised, match) else ():
        around = raised.source.function_around(node) if isinstance(node, Function) else None
        if isinstance(node, Function) and node.name == name and around is not None:
            found = raised.finding("callback_in_init", at=node, name=name)
            words = {**found.words, "function": around.name}
            variant = "" if around.name in raised.source.methods else "margin"
            return replace(found, words=words, variant=variant)
    return None


def _misspelt(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    name = match["name"]
    defined = any(isinstance(n, Function) and n.name == name for n in raised.module.nodes)
    if not _is_callback(raised, match) or defined:
        return None  # (it is there, and not in the class)
    close = nearest(name, [m for m in raised.source.methods if m != "__init__"])
    params = {"name": name, "close": close, "written": close} if close else {"name": name}
    found = raised.finding("callback_misspelt", params=params)
    words = {**found.words, "callback": close or name, "close": close}
    return replace(found, variant="" if close else "no_method", words=words)


def _no_self_dot(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    name, function = match["name"], function_at(raised.module, raised.line)
    named = any(timer.method == name for timer in raised.source.timers)
    inside = any(function in found.body for found in raised.module.classes)
    if not named or name not in raised.source.methods or not inside:
        return None
    return raised.finding("callback_without_self_dot", name=name, written=f"self.{name}")


def _no_self(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """A method of the node, or the function that the timer calls, has no parameter at all."""
    callback, name = raised.source.callback, last_part(match["function"] or "")
    method = raised.source.methods.get(name) if name else callback
    if callback is not None and callback.name == name:
        method = callback
    if method is None or method.args.args or method.decorator_list:
        return None
    return _with_line(raised.finding("callback_no_self", at=method), raised, method)


def _parameter(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The callback of the timer has more parameters than self."""
    method = raised.source.methods.get(match["function"])
    if method is None or method is not raised.source.callback:
        return None
    found = raised.finding("callback_no_self", at=method)
    if method.decorator_list or match["name"] == "self":
        static = "staticmethod" in map(dotted, method.decorator_list)
        return replace(found, variant="static") if static else None
    return _with_line(replace(found, variant="more"), raised, method)


def _with_line(found: RecognisedMistake, raised: Raised, method: Function) -> RecognisedMistake:
    """Return a mistake in a def with the line as it should be, if only parameters change in it."""
    text = raised.source.module_of(method).text
    change = only_self(text, method)
    used = uses_of(method, {argument.arg for argument in needed_besides_self(method)})
    line = f"def {method.name}(self):"
    if change is not None and not used:
        line = def_after(text, method, change)
    return replace(found, words={**found.words, "wanted": shown(line)})


_node = Family("node", links.FIRST_NODE)
KINDS = (
    _node(
        "timer_missing",
        "timer",
        msg("No timer is created"),
        msg("Only a timer calls the callback again and again."),
        msg("Write in __init__: self.create_timer({period}, self.{callback})"),
        behind={"run.no_lines": _missing, "run.stops": _missing},
        fixed_by=(node_timer.made,),
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
        "timer_arguments",
        "timer",
        msg("create_timer does not get a period and a callback"),
        msg(
            "create_timer takes the period first, a number of seconds such as {period}, and then the "
            "callback. A text, a number below 0 and a tuple (1.0, or 1,0) are no period."
        ),
        TIMER,
        fixes={"written": INSTEAD},
        seen=r"float\(\) argument must be a string or a real number, not '(?:method|function|tuple)'"
        r"|ValueError: could not convert string to float: '[^'\n]{0,60}'"
        r"|create_timer\(\) missing \d{1,3} required positional argument",
        raised={REFUSED: _refused},
        fixed_by=(lines.written,),
        examples=(
            example(
                "timer_arguments_swapped",
                Replace(NODE, "1.0, self.timer_callback", "self.timer_callback, 1.0"),
                fails="run.starts",
            ),
            example("period_as_text", Replace(NODE, "(1.0,", "('1.0s',"), fails="run.starts"),
            example("period_missing", Replace(NODE, "(1.0, self", "(self"), fails="run.starts"),
            example("period_negative", Replace(NODE, "(1.0,", "(-1.0,"), fails="run.starts"),
            example(
                "period_with_comma",
                Replace(
                    NODE,
                    "        self.create_timer(1.0,",
                    "        period = 1,0\n        self.create_timer(period,",
                ),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "period_wrong",
        "timer",
        msg("The timer has another period"),
        msg(
            "create_timer takes seconds: with this value the callback is called every {seconds} s, and it "
            "must be every {written} s."
        ),
        INSTEAD,
        behind={"run.no_lines": _long_period, "run.too_much_output": _short_period},
        fixed_by=(lines.written,),
        examples=(
            example(
                "period_in_milliseconds",
                Replace(NODE, "(1.0,", "(1000.0,"),
                fails="run.output",
                blocks=SILENT,
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
        "callback_called",
        "timer",
        msg("create_timer gets a call instead of the callback"),
        msg(
            "create_timer takes the period in seconds and the callback itself, and calls it later. With () "
            "after its name this line calls the callback now, and passes its result (None) instead."
        ),
        INSTEAD,
        seen=r"TypeError: 'NoneType' object is not callable|UnboundLocalError: .{0,60}'arg_name'",
        raised={CALLED: _called, OWN_ATTRIBUTE: _called_early},
        behind={"run.by_hand": _calls_back_at_once},
        fixed_by=(lines.written,),
        examples=(
            example(
                "brackets_behind_callback",
                Replace(NODE, "self.timer_callback)", "self.timer_callback())"),
                fails="run.output",
                also={"run.period": "node.callback_called"},
                blocks=("run.interrupt",),
                note="one line at once, then 'NoneType' object is not callable",
            ),
        ),
    ),
    _node(
        "callback_in_init",
        "timer",
        msg("The callback is indented into another function"),
        msg("A function inside {function} is not a method of the class, so self does not have it."),
        msg(
            "Indent def {name}(self): as far as def {function}, and move its lines to the left by as much."
        ),
        links.PYTHON_CLASSES,
        fixes={
            "margin": msg(
                "def {function} begins at the margin, and there the class ends. Move it with its own lines "
                "above the class, and leave {name} where it is."
            ),
        },
        raised={OWN_ATTRIBUTE: _in_function},
        fixed_by=(node_scope.out_of_init,),
        examples=(
            example(
                "callback_inside_init",
                Replace(NODE, "    def timer_callback(self)", "        def timer_callback(self)"),
                Replace(
                    NODE,
                    (
                        '        """Say hello once; the timer calls this for as long as the node spins."""\n'
                        "        self.get_logger().info('Hello time: ' + str(self.counter_))\n"
                        "        self.counter_ += 1\n"
                    ),
                    (
                        "            self.get_logger().info('Hello time: ' + str(self.counter_))\n"
                        "            self.counter_ += 1\n"
                    ),
                ),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "callback_misspelt",
        "timer",
        msg("The callback's name is misspelt"),
        msg("create_timer needs the method's exact name."),
        TIMER,
        fixes={
            "no_method": msg(
                "The class has no method {name}. Write def {name}(self): above the lines that the timer "
                "is to run, indented like the other methods, or pass the name of the method that is "
                "meant."
            ),
        },
        raised={OWN_ATTRIBUTE: _misspelt},
        fixed_by=(lines.written,),
        examples=(
            example(
                "callback_misspelt",
                Replace(
                    NODE,
                    "self.create_timer(1.0, self.timer_callback)",
                    "self.create_timer(1.0, self.timer_calback)",
                ),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "callback_without_self_dot",
        "timer",
        msg("The object is missing before the callback"),
        msg(
            "A method is reached through its object: self.name in the class, the node's variable outside."
        ),
        INSTEAD,
        links.PYTHON_CLASSES,
        raised={NAME_ERROR: _no_self_dot},
        fixed_by=(lines.written,),
        examples=(
            example(
                "callback_without_self_dot",
                Replace(NODE, "self.timer_callback", "timer_callback"),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "callback_no_self",
        "callback",
        msg("The callback does not take self alone"),
        msg("Python passes the object as the first argument to each of its methods: self."),
        msg("Write: {wanted}"),
        links.PYTHON_CLASSES,
        whys={"more": msg("The timer passes no argument to your callback except self.")},
        fixes={
            "more": msg("Only a subscription passes a message to its callback. Write: {wanted}")
        },
        seen=r"(?<!__init__\(\) )takes 0 positional arguments but 1 was given|ValueError: invalid method signature"
        r"|TypeError: [\w.]{0,200}\(\) missing \d{1,3} required positional arguments?: '(?P<name>\w{1,120})'",
        raised={NO_PARAMETER: _no_self, MISSING_ARGUMENT: _parameter},
        fixed_by=(node_timer.callback_self,),
        examples=(
            example(
                "callback_without_self",
                Replace(NODE, "def timer_callback(self)", "def timer_callback()"),
                fails="run.output",
                blocks=DEAD,
            ),
            example(
                "callback_wants_message",
                Replace(NODE, "def timer_callback(self)", "def timer_callback(self, msg)"),
                fails="run.output",
                blocks=DEAD,
            ),
        ),
    ),
)
