"""Mistakes in the callback: its parameters, and what keeps it from returning in time."""

from __future__ import annotations

import ast
import re
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.base.shown import shown
from grader.mistakes import links
from grader.mistakes.example import DEAD, NODE, example
from grader.mistakes.fixes import node_callback, node_timer
from grader.mistakes.kind import Family
from grader.mistakes.recognised import MISSING_ARGUMENT, Raised, RecognisedMistake, Suspect
from grader.package.edit.tree import Replace
from grader.package.source.counter import targets_of
from grader.package.source.endless import goes_on
from grader.package.source.module import Function
from grader.package.source.names import calls_in, dotted, last_part
from grader.package.source.parameters import def_after, needed_besides_self, only_self, uses_of
from grader.package.source.sleeps import literal_sleeps, longest_sleep

DECORATORS = ("staticmethod", "classmethod", "property")
NO_PARAMETER = (
    r"(?:(?P<function>[\w.<>]{1,120})\(\) )?takes 0 positional arguments but 1 was given"
    "|invalid method signature"
)
ONLY_SELF = msg("The timer passes no argument to your callback except self.")


def _no_self(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """A method of the node, or the function that the timer calls, has no parameter at all."""
    function, callback = match["function"], raised.source.callback
    called = last_part(function) if function else ""
    method = raised.source.methods.get(called) if called else callback
    method = callback if callback is not None and callback.name == called else method
    method = method or (_of_object(raised, function) if function else None)
    if method is None or method.args.args or "staticmethod" in map(dotted, method.decorator_list):
        return None
    return _with_line(raised.finding("callback_no_self", at=method), raised, method)


def _of_object(raised: Raised, function: str) -> Function | None:
    """Return the only method of a name such as `Counter.next` in the classes of all files."""
    owner, _, name = function.rpartition(".")
    methods = [
        method
        for module in (*raised.source.modules, *raised.source.beside)
        for own in module.classes
        for method in own.body
        if own.name == owner and isinstance(method, Function) and method.name == name
    ]
    return methods[0] if len(methods) == 1 and name != "__init__" else None


def _with_line(found: RecognisedMistake, raised: Raised, method: Function) -> RecognisedMistake:
    """Return a mistake in a def with the line as it should be, if only parameters change in it."""
    text = raised.source.module_of(method).text
    change = only_self(text, method)
    if change is None:
        return found
    needed = {argument.arg for argument in needed_besides_self(method)}
    uses = uses_of(method, needed)
    words = {**found.words, "wanted": shown(def_after(text, method, change))}
    if not uses:
        return replace(found, variant="line", words=words)
    words |= {"found": uses[0].id, "line": str(min(use.lineno for use in uses))}
    words["wanted"] = shown(def_after(text, method, change, has_body=False))
    return replace(found, variant="used", words=words)


def _parameter(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    method = raised.source.methods.get(match["function"])
    if method is None or method is not raised.source.callback:
        return None
    if match["name"] == "self":
        return None  # (a decorator takes it away, or the method is called on the class)
    found = raised.finding("callback_parameter", at=method, name=match["name"])
    return _with_line(found, raised, method)


def _decorator(method: Function) -> ast.expr | None:
    """Return the decorator that takes self away from a method, or calls it."""
    found = [d for d in method.decorator_list if dotted(d) in DECORATORS]
    return found[0] if found else None


def _decorated(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    without_self = "required positional argument" in match[0]
    names = {timer.method for timer in raised.source.timers}
    for name, method in raised.source.methods.items():
        found = _decorator(method)
        if found is not None and dotted(found) == "staticmethod" and not without_self:
            continue  # (it can be called, and has no self)
        if found is not None and name in names:
            mistake = raised.finding("callback_decorated", at=found, name=dotted(found))
            return replace(mistake, variant=dotted(found))
    return None


def _sleeps(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a sleep that delays the lines although the timer's period is right."""
    slept = longest_sleep(suspect.source)
    timers = [timer.seconds for timer in suspect.source.timers]
    total = sum(seconds for _, seconds in literal_sleeps(suspect.source))
    if slept is None or total <= suspect.period or timers not in ([suspect.period], [None]):
        return None
    found = suspect.finding("sleeps_in_callback", slept[0], seconds=slept[1])
    if slept[1] <= suspect.period:
        words = {**found.words, "total": f"{total:g}"}
        return replace(found, words=words, variant="several")
    method = suspect.source.function_around(slept[0])
    return replace(found, words={**found.words, "callback": method.name}) if method else found


def _never_ends(suspect: Suspect) -> RecognisedMistake | None:
    source, callback = suspect.source, suspect.source.callback
    in_threads = bool(source.calls_of("MultiThreadedExecutor"))
    others = [source.methods[t.method] for t in source.timers if t.method in source.methods]
    for method in dict.fromkeys([*([callback] if callback is not None else []), *others]):
        found = never_ends_in(method)
        found = found or _waits_for_value(method)
        if found is None or (method is not callback and in_threads):
            continue
        name = "while" if isinstance(found, ast.While) else "input()"
        mistake = suspect.finding("callback_never_ends", found, name=name)
        if method is callback:
            return mistake
        words = {**mistake.words, "method": method.name}
        return replace(mistake, words=words, variant="other")
    return None


def _waits_for_value(method: Function) -> ast.While | None:
    """Return a loop that sleeps until an attribute changes, which nothing in the loop changes."""
    for loop in ast.walk(method):
        if not isinstance(loop, ast.While) or not isinstance(loop.test, ast.Compare | ast.UnaryOp):
            continue
        tested = {dotted(n) for n in ast.walk(loop.test) if isinstance(n, ast.Attribute)}
        left = any(isinstance(n, ast.Break | ast.Return | ast.Await) for n in ast.walk(loop))
        called = [name for _, name in calls_in(loop)]
        sleeps = bool(called) and all(last_part(name) == "sleep" for name in called)
        changed = {name for n in ast.walk(loop) for name in targets_of(n)}
        own = bool(tested) and all(name.startswith("self.") for name in tested)
        if own and sleeps and not left and not tested & changed:
            return loop
    return None


def never_ends_in(method: Function) -> ast.Call | ast.While | None:
    """Return what keeps a function from returning: an input, or a loop without an end."""
    for node in ast.walk(method):
        if isinstance(node, ast.Call) and dotted(node.func) == "input":
            return node
        if isinstance(node, ast.While) and goes_on(node):
            return node
    return None


_node = Family("node", links.FIRST_NODE)
KINDS = (
    _node(
        "callback_no_self",
        "callback",
        msg("A method has no parameter self"),
        msg("Python passes the object as the first argument to each of its methods: self."),
        msg("Write: def {callback}(self):"),
        links.PYTHON_CLASSES,
        fixes={"line": msg("Write: {wanted}")},
        seen=r"(?<!__init__\(\) )takes 0 positional arguments but 1 was given|ValueError: invalid method signature",
        raised={NO_PARAMETER: _no_self},
        fixed_by=(node_timer.callback_self,),
        examples=(
            example(
                "callback_without_self",
                Replace(NODE, "def timer_callback(self)", "def timer_callback()"),
                fails="run.output",
                blocks=DEAD,
            ),
        ),
    ),
    _node(
        "callback_decorated",
        "callback",
        msg("A decorator changes what the callback is"),
        msg("A timer needs a plain method, which gets the node as self."),
        msg("Delete the line @{name} above the callback."),
        links.PYTHON_CLASSES,
        whys={
            "staticmethod": msg(
                "@staticmethod makes a function of the method: the timer calls it without self."
            ),
            "classmethod": msg("@classmethod gives the method the class instead of the node."),
            "property": msg(
                "@property calls the method where only its name is meant: the timer gets what the "
                "method returns."
            ),
        },
        raised={
            "missing 1 required positional argument: 'self'|object is not callable": _decorated,
            "'arg_name'|is not a callable object|type object '": _decorated,
        },
        fixed_by=(node_timer.plain_method,),
        examples=(
            example(
                "callback_is_static",
                Replace(
                    NODE, "    def timer_callback", "    @staticmethod\n    def timer_callback"
                ),
                fails="run.output",
                blocks=DEAD,
            ),
        ),
    ),
    _node(
        "callback_parameter",
        "callback",
        msg("The callback has more parameters than self"),
        ONLY_SELF,
        msg("Write: def {callback}(self): (only a subscription passes a message to its callback)."),
        fixes={
            "line": msg("Only a subscription passes a message to its callback. Write: {wanted}"),
            "used": msg(
                "Only a subscription passes a message to its callback. In line {line}, write the "
                "value that you mean instead of {found}. Then write: {wanted}"
            ),
        },
        seen=r"TypeError: [\w.]{0,200}\(\) missing \d{1,3} required positional arguments?: "
        r"'(?P<name>\w{1,120})'",
        raised={MISSING_ARGUMENT: _parameter},
        fixed_by=(node_timer.callback_self,),
        examples=(
            example(
                "callback_wants_message",
                Replace(NODE, "def timer_callback(self)", "def timer_callback(self, msg)"),
                fails="run.output",
                blocks=DEAD,
            ),
        ),
    ),
    _node(
        "sleeps_in_callback",
        "callback",
        msg("The callback sleeps for longer than the period"),
        msg(
            "While a callback sleeps, it does not return, and the timer cannot call it again: the timer "
            "has to wait, and lines come late."
        ),
        msg("Remove the sleep from {callback}: the timer alone makes the pauses."),
        links.EXECUTORS,
        whys={
            "several": msg(
                "While a callback sleeps, it does not return, and the timer cannot call it again. The "
                "sleeps of one call take {total} s together: the timer has to wait, and lines come late."
            )
        },
        fixes={
            "several": msg(
                "Remove the sleeps from {callback}: the timer alone makes the pauses. What comes after a "
                "sleep belongs in the next call of a timer."
            )
        },
        behind={"run.wrong_period": _sleeps},
        deletes=("",),
        fixed_by=(node_callback.without_sleeps,),
        examples=(
            example(
                "sleeps_twice_in_callback",
                Replace(NODE, "import rclpy\nfrom", "import time\nimport rclpy\nfrom"),
                Replace(
                    NODE,
                    "self.counter_ += 1",
                    "self.counter_ += 1\n        time.sleep(1)\n        time.sleep(1)",
                ),
                fails="run.period",
            ),
            example(
                "sleeps_in_callback",
                Replace(NODE, "import rclpy\nfrom", "import time\nimport rclpy\nfrom"),
                Replace(NODE, "self.counter_ += 1", "self.counter_ += 1\n        time.sleep(2)"),
                fails="run.period",
            ),
        ),
    ),
    _node(
        "callback_never_ends",
        "callback",
        msg("The callback does not return"),
        msg("The timer can call a callback again only after it has returned."),
        msg("Remove {name} from {callback}: the timer does the repeating."),
        links.EXECUTORS,
        whys={
            "other": msg(
                "A timer calls {method} too. A node runs one callback after another: as long as "
                "{method} does not return, nothing calls {callback}."
            )
        },
        fixes={"other": msg("Remove {name} from {method}: its timer does the repeating.")},
        behind={"run.no_lines": _never_ends, "run.stops": _never_ends},
        fixed_by=(node_callback.without_question,),
        examples=(
            example(
                "asks_in_callback",
                Replace(NODE, "self.counter_ += 1", "self.counter_ += 1\n        input('more?')"),
                fails="run.output",
                blocks=("run.period",),
            ),
        ),
    ),
)
