"""Mistakes in creating the timer, and in what it calls."""

from __future__ import annotations

import ast
import re
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.base.nearest import nearest
from grader.mistakes import links
from grader.mistakes.constructor import lines_of
from grader.mistakes.example import DEAD, NODE, SILENT, example
from grader.mistakes.fixes import lines, node_scope, node_timer
from grader.mistakes.kind import Family
from grader.mistakes.order import attribute_needed_early
from grader.mistakes.recognised import (
    NAME_ERROR,
    OWN_ATTRIBUTE,
    Raised,
    RecognisedMistake,
    Suspect,
    always,
    of_self,
)
from grader.mistakes.scope import creates_timer
from grader.package.edit.tree import Replace
from grader.package.source.counter import targets_of
from grader.package.source.endless import calls_of_methods
from grader.package.source.module import Function
from grader.package.source.names import calls_in, dotted, last_part, own_name
from grader.package.source.node import NodeSource
from grader.package.source.period import origin_of, seconds_of
from grader.package.source.place import block_of, function_at
from grader.package.source.until_ctrl_c import parts_until_ctrl_c

LONG = 100.0  # seconds; a longer period was meant in milliseconds
WORDS = ("timer", "callback", "on", "log", "hello", "say", "count", "counter", "tick", "time")
"""Words that names of callbacks have; of two names, one with fewer of them is misspelt."""

REAL_NUMBER = (
    r"float\(\) argument must be .{1,60}not '(?P<type>\w{1,120})'"
    r"|must be real number, not (?P<old>\w{1,120})"
)
CALLABLE = ("method", "function")
CALLED = msg(
    "create_timer takes the period in seconds and the callback itself, and calls it later. With () "
    "after its name the callback runs now, and its result (None) is passed instead."
)
TIMER = msg("Write create_timer({period}, self.{callback})")


def _called(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    del match
    called = [timer for timer in raised.source.timers if timer.called]
    return raised.finding("callback_called", at=called[0].call) if called else None


def _called_with(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The callback is called with arguments where the timer is created."""
    for timer in raised.source.timers:
        if timer.called and timer.method == match["name"] and raised.line == timer.call.lineno:
            return raised.finding("callback_called", at=timer.call)
    return None


def _called_early(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The callback runs in __init__, before the line that sets what it needs."""
    early = attribute_needed_early(raised, match)
    inside = list(ast.walk(early.needs)) if early is not None else []
    for timer in raised.source.timers:
        if timer.called and timer.call in inside:
            return raised.finding("callback_called", at=timer.call)
    return None


def _by_hand_early(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    early = attribute_needed_early(raised, match)
    names = {timer.method for timer in raised.source.timers} - {""}
    for call, _ in calls_in(early.needs) if early is not None else ():
        if own_name(call.func) in names:
            return raised.finding("called_by_hand", at=call)
    return None


def _negative(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    del match
    for timer in raised.source.timers:
        if timer.period is None or raised.line not in (None, timer.call.lineno):
            continue
        code = raised.source.module_of(timer.call).text.code(timer.period)
        period = repr(raised.assignment.output.period)
        return raised.finding("period_negative", at=timer.call, name=code, written=period)
    return None


def _zero(suspect: Suspect) -> RecognisedMistake | None:
    """The period is 0: the timer is due again at once."""
    for timer in suspect.source.timers:
        if timer.period is None or seconds_of(suspect.source, timer.period) != 0:
            continue
        value = node_timer.value_of(suspect.source, timer.period) or timer.period
        code = suspect.source.module_of(value).text.code(value)
        period = repr(suspect.output.period)
        if value is timer.period and isinstance(value, ast.Constant):
            return suspect.finding("period_zero", timer.call, name=code, written=period)
        found = suspect.finding("period_zero", value, name=code, written=period)
        whole = any(isinstance(n, ast.FloorDiv) for n in ast.walk(value))
        return replace(found, variant="whole" if whole else "elsewhere")
    return None


def _in_quotes(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a text of the class that contains the line of the timer."""
    if suspect.source.timers:
        return None
    for node in suspect.source.own_nodes:
        value = node.value if isinstance(node, ast.Expr) else None
        if isinstance(value, ast.Constant) and "self.create_timer(" in str(value.value):
            return suspect.finding("timer_in_quotes", value)
    return None


def _calls_back_at_once(suspect: Suspect) -> RecognisedMistake | None:
    for timer in suspect.source.timers:
        if timer.called:
            return suspect.finding("callback_called", timer.call)
    return None


def _is_callback(raised: Raised, match: re.Match[str]) -> bool:
    """Whether the missing attribute is what a timer calls."""
    name = match["name"]
    return of_self(raised, match) and any(t.method == name for t in raised.source.timers)


def _inside_init(raised: Raised, name: str) -> ast.FunctionDef | None:
    init = raised.source.methods.get("__init__")
    for node in ast.walk(init) if init else ():
        if isinstance(node, ast.FunctionDef) and node.name == name:
            return node
    return None


def _callback_in_init(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    name = match["name"]
    at = _inside_init(raised, name) if _is_callback(raised, match) else None
    return raised.finding("callback_in_init", at=at, name=name) if at is not None else None


def _callback_misspelt(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    if not _is_callback(raised, match):
        return None
    name, methods = match["name"], raised.source.methods
    close = nearest(name, [m for m in methods if m != "__init__"])
    if close and _known_words(name) > _known_words(close):
        found = raised.finding("callback_misspelt", at=methods[close], name=close, close=name)
        return replace(found, variant="definition")
    found = raised.finding("callback_misspelt", name=name, close=close)
    return replace(found, variant="", words={**found.words, "callback": close or name})


def _known_words(name: str) -> int:
    return sum(part in WORDS for part in name.lower().split("_"))


def _outside_init(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    if match["name"] != "self" or not creates_timer(raised):
        return None
    return (
        None if function_at(raised.module, raised.line) else raised.finding("timer_at_class_level")
    )


def _dot_for_comma(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """A number and the next argument have a dot between them."""
    row = raised.module.line(raised.line)
    found = re.search(rf"(?P<number>\d+\.\d*|\d+)\.[ \t]*(?P<next>{match['name']})\b", row)
    if found is None:
        return None
    written = f"{found['number']}, {found['next']}"
    return raised.finding("dot_for_comma", name=found[0], written=written)


def _no_self_dot(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    name = match["name"]
    if all(timer.method != name for timer in raised.source.timers):
        return None
    if name not in raised.source.methods:
        return None
    function = function_at(raised.module, raised.line)
    inside = any(function in found.body for found in raised.module.classes)
    variables = raised.source.node_variables
    if function is not None and not inside and len(variables) == 1:
        written = f"{min(variables)}.{name}"
        found = raised.finding("callback_without_self_dot", name=name, written=written)
        return replace(found, variant="outside")
    return raised.finding("callback_without_self_dot", name=name)


def _swapped(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    kind = match.groupdict().get("type")
    if not raised.source.timers or kind not in (None, *CALLABLE):
        return None
    return raised.finding("timer_arguments_swapped")


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


def _missing(suspect: Suspect) -> RecognisedMistake | None:
    if suspect.source.timers:
        return None
    return suspect.finding("timer_missing", suspect.source.methods.get("__init__"))


def _called_once(suspect: Suspect) -> RecognisedMistake | None:
    """No timer is created, and __init__ calls the method that logs."""
    source, init = suspect.source, suspect.source.methods.get("__init__")
    if source.timers or source.calls_of("create_timer"):
        return None
    for call, _ in calls_in(init) if init is not None else ():
        method = source.methods.get(own_name(call.func))
        if method is not None and source.logs(method):
            code = source.module_of(call).text.code(call)
            new = f"self.create_timer({suspect.output.period!r}, self.{method.name})"
            found = suspect.finding("timer_missing", call, name=code, written=new)
            return replace(found, variant="by_hand")
    return None


def _cancelled(suspect: Suspect) -> RecognisedMistake | None:
    return _stop_of_timer(suspect, ".cancel", ".destroy_timer")


def _stopped(suspect: Suspect) -> RecognisedMistake | None:
    return _stop_of_timer(suspect, ".cancel", ".destroy_timer", logs=False)


def _stop_of_timer(suspect: Suspect, *endings: str, logs: bool = True) -> RecognisedMistake | None:
    """Look for a call that stops a timer, and that can run before spin has ended.

    With `logs`, no line came: then the callback must have one to be silent for.
    """
    source, callback = suspect.source, suspect.source.callback
    early = parts_until_ctrl_c(source)
    for call, name in source.calls:
        if not name.endswith(endings) or call not in early or not _is_of_timer(source, call, name):
            continue
        if logs and callback is not None and not _logs(source, callback):
            return None  # (that is a reason too)
        function = source.function_around(call)
        again = [t for t in source.timers if t.function is function and t.call.lineno > call.lineno]
        if again:
            continue
        return _with_line(suspect, call, name)
    return None


def _argument_missing(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """Complete the student's own call, if what is missing is known."""
    del match
    for timer in raised.source.timers:
        if raised.line not in (None, *lines_of(timer.call)):
            continue
        period = repr(raised.assignment.output.period)
        found = node_timer.completed(raised.source, timer, period)
        if found is None:
            return raised.finding("timer_argument_missing", at=timer.call)
        code = " ".join(raised.source.module_of(timer.call).text.code(timer.call).split())
        code = re.sub(r",? \)", ")", code.replace("( ", "("))
        params = {"name": code, "written": found.written}
        mistake = raised.finding("timer_argument_missing", at=timer.call, params=params)
        return replace(mistake, variant="written")
    return raised.finding("timer_argument_missing")


def _logs(source: NodeSource, callback: Function) -> bool:
    """Whether a callback logs, or calls a method that does."""
    inner = [method for _, method in calls_of_methods(source, callback)]
    return any(source.logs(m) or source.prints(m) for m in (callback, *inner))


def _is_of_timer(source: NodeSource, call: ast.Call, name: str) -> bool:
    """Whether a call of cancel() stops a timer, as far as its names tell."""
    owner = name.rpartition(".")[0]
    if name.endswith(".destroy_timer") or "timer" in owner.lower():
        return True
    made = {timer.call for timer in source.timers}
    if isinstance(call.func, ast.Attribute) and call.func.value in made:
        return True
    kept = [n for n in source.own_nodes if isinstance(n, ast.Assign | ast.AnnAssign)]
    names = {last_part(target) for n in kept if n.value in made for target in targets_of(n)}
    return last_part(owner) in names


def _with_line(suspect: Suspect, call: ast.Call, name: str) -> RecognisedMistake:
    """Say what to delete: only the .cancel() behind create_timer, else the line and its if."""
    found = suspect.finding("timer_cancelled", call)
    module = suspect.source.module_of(call)
    statement = module.parents.get(call)
    owner = call.func.value if isinstance(call.func, ast.Attribute) else None
    destroyed = name.endswith(".destroy_timer")
    if isinstance(owner, ast.Call):
        return found  # (create_timer(…).cancel())
    if not isinstance(statement, ast.Expr):
        return replace(found, variant="other", words={**found.words, "name": f"{name}()"})
    block, around = block_of(module, statement), module.parents.get(statement)
    if len(block) > 1:
        return replace(found, variant="destroyed" if destroyed else "line")
    alone = isinstance(around, ast.If) and around.body == block and not around.orelse
    if destroyed and not alone:
        return replace(found, variant="destroyed_alone")
    return replace(found, variant="if" if alone else "alone")


def _not_started(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a timer that is created with autostart=False, and that nothing starts."""
    source = suspect.source
    if source.calls_of("reset"):
        return None
    for timer in source.timers:
        for word in timer.call.keywords:
            off = isinstance(word.value, ast.Constant) and word.value.value is False
            if word.arg == "autostart" and off:
                return suspect.finding("timer_not_started", word.value)
    return None


def _reset(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a callback of another, faster timer that resets the timer of the lines."""
    source, callback = suspect.source, suspect.source.callback
    if callback is None:
        return None
    slow = [t for t in source.timers if t.method == callback.name]
    others = [t for t in source.timers if t.method != callback.name]
    if len(slow) != 1:
        return None
    made = source.module_of(slow[0].call).parents.get(slow[0].call)
    names = set(targets_of(made)) if made is not None else set()
    for timer in others:
        method = source.methods.get(timer.method)
        for call, name in calls_in(method) if method is not None else ():
            owner = name.removesuffix(".reset")
            if owner != name and owner in names:
                found = _with_line(suspect, call, name)
                variant = "" if found.variant == "line" else "alone"
                words = {**found.words, "name": f"{name}()", "method": timer.method}
                return replace(found, kind="node.timer_reset", words=words, variant=variant)
    return None


def _only_if(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a condition that decides whether the only timer is created."""
    source = suspect.source
    timer = source.timers[0] if len(source.timers) == 1 else None
    if timer is None or timer.function is None or timer.function.name != "__init__":
        return None
    if source.callback is not None and not _logs(source, source.callback):
        return None  # (that is a reason too)
    for part in source.module_of(timer.call).around(timer.call):
        if isinstance(part, Function):
            return None
        if isinstance(part, ast.If) and not part.orelse and len(part.body) == 1:
            if isinstance(part.test, ast.Constant) or dotted(part.test).endswith("ok()"):
                return None
            test = source.module_of(part).text.code(part.test)
            params: dict[str, str | int] = {"name": test[:80], "line": part.lineno}
            return suspect.finding("timer_if", timer.call, **params)
    return None


def _milliseconds(suspect: Suspect) -> RecognisedMistake | None:
    given = suspect.source.timers[0].period
    value = node_timer.value_of(suspect.source, given) if given is not None else None
    origin = origin_of(suspect.source, given)
    if value is None and origin is not None and origin.calculation is None:
        value = origin.number  # (the default of a parameter, or a constant of the class)
    number = value.value if isinstance(value, ast.Constant) else None
    if not isinstance(number, int | float) or not number >= LONG > suspect.output.period:
        return None
    return suspect.finding("period_milliseconds", value, written=f"{number:g}")


def _other_callback(suspect: Suspect) -> RecognisedMistake | None:
    source, callback = suspect.source, suspect.source.callback
    timer = source.timers[0]
    logging = [m for m in source.methods.values() if source.logs(m) and m.name != "__init__"]
    other = callback is None or callback.name != timer.method
    if not (timer.method and other and logging):
        return None
    return suspect.finding("timer_other_callback", timer.call, name=timer.method)


def _by_hand(suspect: Suspect) -> RecognisedMistake | None:
    source = suspect.source
    init = source.methods.get("__init__")
    names = {dotted(timer.callback) for timer in source.timers if timer.callback} - {""}
    for call, name in calls_in(init) if init else ():
        if name in names:
            found = suspect.finding("called_by_hand", call)
            made = [t.call for t in source.timers if t.callback and dotted(t.callback) == name]
            around = source.function_around(made[0])
            if len(made) == 1 and around is not None and around is source.callback:
                written = source.module_of(made[0]).text.code(made[0])
                words = {**found.words, "written": " ".join(written.split())[:80]}
                return replace(found, words=words, variant="inside")
            return found
    return None


DESTROYED = msg("destroy_timer() removes a timer: it no longer calls its callback.")
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
        "callback_called",
        "timer",
        msg("create_timer gets a call instead of the callback"),
        CALLED,
        msg("Remove the () after the callback's name: create_timer({period}, self.{callback})"),
        seen=r"TypeError: 'NoneType' object is not callable"
        r"|UnboundLocalError: .{0,60}'arg_name'",
        raised={
            "'NoneType' object is not callable|'arg_name'|is not a callable object": _called,
            r"TypeError: \w{1,120}\.(?P<name>\w{1,120})\(\) takes": _called_with,
            OWN_ATTRIBUTE: _called_early,
        },
        behind={"run.by_hand": _calls_back_at_once},
        fixed_by=(node_timer.callback,),
        examples=(
            example(
                "brackets_behind_callback",
                Replace(NODE, "self.timer_callback)", "self.timer_callback())"),
                fails="run.output",
                also={"run.period": "node.callback_called"},
                blocks=("run.interrupt",),
                note="one line at once, then 'NoneType' object is not callable",
            ),
            example(
                "callback_called_with_self",
                Replace(NODE, "self.timer_callback)", "self.timer_callback(self))"),
                fails="run.starts",
            ),
            example(
                "callback_called_before_counter",
                Replace(NODE, "        self.counter_ = 0\n", ""),
                Replace(
                    NODE,
                    "self.timer_callback)\n",
                    "self.timer_callback())\n        self.counter_ = 0\n",
                ),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "callback_in_init",
        "timer",
        msg("The callback is indented into __init__"),
        msg("A function inside __init__ is not a method of the class, so self does not have it."),
        msg(
            "Indent def {callback}(self): as far as def __init__, and move its lines to the left "
            "by as much."
        ),
        links.PYTHON_CLASSES,
        raised={OWN_ATTRIBUTE: _callback_in_init},
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
        fixes={"definition": msg("Write def {close}(self): instead of def {name}(self):")},
        raised={OWN_ATTRIBUTE: _callback_misspelt},
        fixed_by=(node_scope.definition, node_timer.callback),
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
            example(
                "definition_misspelt",
                Replace(NODE, "def timer_callback(self)", "def timer_callbak(self)"),
                fails="run.starts",
            ),
        ),
    ),
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
        "callback_without_self_dot",
        "timer",
        msg("self. is missing before the callback"),
        msg("A method is reached through its object: self.name."),
        TIMER,
        links.PYTHON_CLASSES,
        fixes={"outside": msg("Write {written} instead of {name}: there is no self here.")},
        raised={NAME_ERROR: _no_self_dot},
        fixed_by=(lines.written, node_timer.callback),
        examples=(
            example(
                "timer_in_main_without_node",
                Replace(NODE, "        self.create_timer(1.0, self.timer_callback)\n", ""),
                Replace(
                    NODE,
                    "    node = MyFirstNode()\n",
                    "    node = MyFirstNode()\n    node.create_timer(1.0, timer_callback)\n",
                ),
                fails="run.starts",
            ),
            example(
                "callback_without_self_dot",
                Replace(NODE, "self.timer_callback", "timer_callback"),
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
        seen=r"float\(\) argument must be a string or a real number, not '(?:method|function)'",
        raised={
            REAL_NUMBER: _swapped,
            r"float\(\) argument must be|not '?(?:method|function)'?": _swapped,
        },
        fixed_by=(node_timer.arguments,),
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
        seen=r"ValueError: could not convert string to float: (?P<text>'[^'\n]{0,60}')",
        raised={
            r"could not convert string to float: (?P<text>'[^'\n]{0,60}')": always("period_text")
        },
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
        fixes={"written": msg("Write {written} instead of {name}.")},
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
        whys={
            "whole": msg(
                "{name} is 0: // leaves out what is behind the point. A timer with the period 0 is "
                "always due: it calls the callback without a pause."
            )
        },
        fixes={
            "whole": msg("Write {written} instead of {name} in this line."),
            "elsewhere": msg("Write {written} instead of {name} in this line."),
        },
        behind={"run.too_much_output": _zero, "run.wrong_period": _zero},
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
        "timer_in_quotes",
        "timer",
        msg("The line that creates the timer is in quotes"),
        msg("Lines between three quotes are a text for the reader. Python does not run them."),
        msg("Remove the three quotes before and after the line with create_timer."),
        behind={"run.no_lines": _in_quotes},
        fixed_by=(node_timer.without_quotes,),
        examples=(
            example(
                "timer_in_three_quotes",
                Replace(
                    NODE,
                    "        self.create_timer(1.0, self.timer_callback)",
                    '        """\n        self.create_timer(1.0, self.timer_callback)\n        """',
                ),
                fails="run.output",
                blocks=SILENT,
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
            "by_hand": msg("{name} calls the method once. Only a timer calls it again and again.")
        },
        fixes={"by_hand": msg("Write {written} instead of {name}.")},
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
        "timer_cancelled",
        "timer",
        msg("The timer is stopped"),
        msg("cancel() stops a timer: it no longer calls its callback."),
        msg("Remove the .cancel()."),
        whys={
            "destroyed": DESTROYED,
            "destroyed_alone": DESTROYED,
        },
        fixes={
            "line": msg("Delete this line."),
            "destroyed": msg("Delete this line."),
            "destroyed_alone": msg("Write pass instead of this line."),
            "if": msg("Delete this line and the if above it."),
            "alone": msg("Write pass instead of this line."),
            "other": msg("Remove {name} from this line."),
        },
        behind={"run.no_lines": _cancelled, "run.stops": _stopped},
        fixed_by=(node_timer.cancelled, node_timer.without_cancel),
        examples=(
            example(
                "timer_cancelled",
                Replace(
                    NODE,
                    "self.create_timer(1.0, self.timer_callback)",
                    "self.create_timer(1.0, self.timer_callback).cancel()",
                ),
                fails="run.output",
                blocks=SILENT,
            ),
            example(
                "three_then_silence",
                Replace(
                    NODE,
                    "self.create_timer(1.0, self.timer_callback)",
                    "self.timer_ = self.create_timer(1.0, self.timer_callback)",
                ),
                Replace(
                    NODE,
                    "self.counter_ += 1",
                    (
                        "self.counter_ += 1\n"
                        "        if self.counter_ == 3:\n"
                        "            self.timer_.cancel()"
                    ),
                ),
                fails="run.output",
            ),
        ),
    ),
    _node(
        "timer_reset",
        "timer",
        msg("The timer begins again before its period has passed"),
        msg(
            "reset() begins the period of the timer again. Another timer calls {method}, so {name} "
            "runs again and again, and the period does not come to its end."
        ),
        msg("Delete this line."),
        fixes={"alone": msg("Write pass instead of this line.")},
        behind={"run.no_lines": _reset},
        fixed_by=(lines.deleted,),
        examples=(
            example(
                "timer_reset_by_other_timer",
                Replace(
                    NODE,
                    "        self.create_timer(1.0, self.timer_callback)\n",
                    "        self.timer_ = self.create_timer(1.0, self.timer_callback)\n"
                    "        self.create_timer(0.25, self.look_after)\n",
                ),
                Replace(
                    NODE,
                    "    def timer_callback",
                    "    def look_after(self):\n"
                    "        self.timer_.reset()\n\n"
                    "    def timer_callback",
                ),
                fails="run.output",
                blocks=SILENT,
            ),
        ),
    ),
    _node(
        "timer_not_started",
        "timer",
        msg("The timer is created, but not started"),
        msg("With autostart=False a timer calls nothing until its reset() is called."),
        msg("Delete autostart=False and the comma before it: the timer then starts by itself."),
        behind={"run.no_lines": _not_started},
        fixed_by=(node_timer.started,),
        examples=(
            example(
                "timer_without_autostart",
                Replace(NODE, "self.timer_callback)", "self.timer_callback, autostart=False)"),
                fails="run.output",
                blocks=SILENT,
            ),
        ),
    ),
    _node(
        "timer_if",
        "timer",
        msg("The timer is only created if a condition is true"),
        msg(
            "This line only runs if {name} is true when the node is created (line {line}). Without "
            "the timer nothing calls the callback."
        ),
        msg("Delete the if on line {line}, and indent this line as far as the if is indented now."),
        behind={"run.no_lines": _only_if},
        fixed_by=(node_timer.without_if,),
        examples=(
            example(
                "timer_under_flag",
                Replace(
                    NODE,
                    "        self.create_timer(",
                    "        self.running = False\n"
                    "        if self.running:\n"
                    "            self.create_timer(",
                ),
                fails="run.output",
                blocks=SILENT,
            ),
        ),
    ),
    _node(
        "period_milliseconds",
        "timer",
        msg("The period is written in milliseconds"),
        msg("create_timer takes seconds: {written} is {written} seconds."),
        TIMER,
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
        "timer_other_callback",
        "timer",
        msg("The timer calls another method"),
        msg("The timer calls the method that it gets, and no other."),
        TIMER,
        behind={"run.no_lines": _other_callback},
        examples=(
            example(
                "callback_is_another",
                Replace(NODE, "self.timer_callback)", "self.get_name)"),
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
        whys={
            "inside": msg(
                "{callback} makes the timer itself: each call makes one more timer, and the first "
                "call comes too early."
            )
        },
        fixes={
            "inside": msg(
                "Write {written} in __init__ instead of self.{callback}(), and delete the "
                "create_timer from {callback}."
            )
        },
        raised={OWN_ATTRIBUTE: _by_hand_early},
        behind={"run.by_hand": _by_hand},
        fixed_by=(node_timer.by_hand,),
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
