"""Mistakes in the callback that create_timer is given."""

from __future__ import annotations

import ast
import re
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.base.nearest import nearest
from grader.mistakes import links
from grader.mistakes.example import NODE, SILENT, example
from grader.mistakes.fixes import lines, node_scope, node_timer
from grader.mistakes.kind import Family
from grader.mistakes.order import attribute_needed_early
from grader.mistakes.recognised import (
    NAME_ERROR,
    OWN_ATTRIBUTE,
    Raised,
    RecognisedMistake,
    Suspect,
    of_self,
)
from grader.mistakes.timer_period import TIMER
from grader.package.edit.tree import Replace
from grader.package.source.imported import imports
from grader.package.source.module import Function
from grader.package.source.names import dotted, last_part
from grader.package.source.node import NodeSource
from grader.package.source.place import function_at
from grader.package.source.timer import Timer

WORDS = ("timer", "callback", "on", "log", "hello", "say", "count", "counter", "tick", "time")
"""Words that names of callbacks have; of two names, one with fewer of them is misspelt."""
CALLED = msg(
    "create_timer takes the period in seconds and the callback itself, and calls it later. With () "
    "after its name this line calls the callback now, and passes its result (None) instead, if it has one."
)

KEPT = msg(
    "create_timer takes the period in seconds and the callback itself, and calls it later. {name} runs "
    "now, and its result (None) is passed instead. The timer calls its callback with nothing in the ()."
)


def _called(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    del match
    called = [timer for timer in raised.source.timers if timer.called]
    return (
        _not_returned(raised, called[0]) or _without_brackets(raised, called[0]) if called else None
    )


def _not_returned(raised: Raised, timer: Timer) -> RecognisedMistake | None:
    """The method that is called defines the callback, and does not return it."""
    source, method = raised.source, raised.source.methods.get(timer.method)
    inner = [s for s in method.body if isinstance(s, Function)] if method is not None else []
    if method is None or len(inner) != 1 or not source.logs(inner[0]):
        return None
    used = [n for s in method.body if s is not inner[0] for n in ast.walk(s)]
    if source.logs(method) != source.logs(inner[0]) or any(isinstance(n, ast.Return) for n in used):
        return None
    if inner[0].name in {n.id for n in used if isinstance(n, ast.Name)}:
        return None
    found = raised.finding("callback_called", at=inner[0])
    words = {"method": method.name, "inner": inner[0].name, "line": str(timer.call.lineno)}
    return replace(found, words={**found.words, **words}, variant="not_returned")


def _without_brackets(where: Raised | Suspect, timer: Timer) -> RecognisedMistake | None:
    """Return that a timer's callback is called where it should be passed, and how it is passed."""
    call, source = timer.callback, where.source
    named = call.func if isinstance(call, ast.Call) else timer.call
    variant = ""
    if isinstance(call, ast.Call) and not _is_own(source, named):
        inside = [p.func if isinstance(p, ast.Call) else p for p in _given(call)]
        own = [part for part in inside if _is_own(source, part)]
        if len(own) != 1:
            return None  # (a function of a library: what it is for is not known)
        named, variant = own[0], "wrapped"
    written = source.module_of(named).text.code(named)
    if isinstance(call, ast.Call) and not variant:
        kept = _with_its_values(source, call)
        variant, written = kept if kept is not None else (variant, written)
    if isinstance(where, Suspect):
        found = where.finding("callback_called", timer.call, written=written)
    else:
        found = where.finding("callback_called", at=timer.call, written=written)
    code = source.module_of(timer.call).text.code
    given = code(call) if call is not None else ""
    if variant in ("lambda", "partial_here"):  # (nothing else of the file has to change)
        found = replace(found, params={**found.params, "name": given})
    return replace(found, words={**found.words, "name": given}, variant=variant or found.variant)


def _with_its_values(source: NodeSource, call: ast.Call) -> tuple[str, str] | None:
    """Return how a callback is passed that needs the values of its call, and the variant that says so."""
    module, name = source.module_of(call), last_part(dotted(call.func))
    made = [n for n in module.nodes if isinstance(n, Function) and n.name == name]
    given = _given(call)
    if len(made) != 1 or not given or any(isinstance(a, ast.Starred) for a in call.args):
        return None
    needed = [a.arg for a in made[0].args.args]
    bound = dotted(call.func).startswith("self.") or needed[:1] == ["self"]
    if len(given) > len(needed) - bound or any(k.arg is None for k in call.keywords):
        return None
    code, shown_call = module.text.code, module.text.code(call)
    if "\n" in shown_call:
        return None
    if not any(isinstance(n, ast.Call) for part in given for n in ast.walk(part)):
        return "lambda", f"lambda: {shown_call}"
    values = ", ".join([code(call.func), *map(code, call.args)])
    named = [f"{k.arg}={code(k.value)}" for k in call.keywords]
    here = any(bound == "partial" for bound, _, _ in imports(module))
    return "partial_here" if here else "partial", f"partial({', '.join([values, *named])})"


def _given(call: ast.Call) -> list[ast.expr]:
    return [*call.args, *(keyword.value for keyword in call.keywords)]


def _is_own(source: NodeSource, named: ast.expr) -> bool:
    """Whether a name is of a function or a method in the student's files."""
    functions = {n.name for m in source.modules for n in m.nodes if isinstance(n, Function)}
    return last_part(dotted(named)) in functions or isinstance(named, ast.Lambda)


def _called_with(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The callback is called with arguments where the timer is created."""
    for timer in raised.source.timers:
        if timer.called and timer.method == match["name"] and raised.line == timer.call.lineno:
            return _without_brackets(raised, timer)
    return None


def _called_early(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The callback runs in __init__, before the line that sets what it needs."""
    early = attribute_needed_early(raised, match)
    inside = list(ast.walk(early.needs)) if early is not None else []
    for timer in raised.source.timers:
        if timer.called and timer.call in inside:
            return _without_brackets(raised, timer)
    return None


def _in_quotes(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a text of the class that contains the line of the timer."""
    if suspect.source.timers:
        return None
    for node in suspect.source.own_nodes:
        value = node.value if isinstance(node, ast.Expr) else None
        if isinstance(value, ast.Constant) and "self.create_timer(" in str(value.value):
            found = suspect.finding("timer_in_quotes", value)
            rows = [row for row in str(value.value).splitlines() if row.strip()]
            words = {**found.words, "line": str(value.end_lineno or value.lineno)}
            return replace(found, variant="more", words=words) if len(rows) > 1 else found
    return None


def _calls_back_at_once(suspect: Suspect) -> RecognisedMistake | None:
    for timer in suspect.source.timers:
        if timer.called and not _makes_callback(suspect.source, timer):
            return _without_brackets(suspect, timer)
    return None


def _makes_callback(source: NodeSource, timer: Timer) -> bool:
    """Whether the method that is called returns a function, which the timer then calls."""
    method = source.methods.get(timer.method)
    parts = list(ast.walk(method)) if method is not None else []
    inner = {n.name for n in parts if isinstance(n, Function) and n is not method}
    returned = [n.value for n in parts if isinstance(n, ast.Return)]
    return any(isinstance(v, ast.Lambda) or (v and dotted(v) in inner) for v in returned)


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


def _class_ended(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """Look for the callback inside of a function at the margin, which ends the class."""
    name = match["name"]
    for function in raised.source.module.functions.values():
        inner = [n for n in function.body if isinstance(n, ast.FunctionDef) and n.name == name]
        if inner and [a.arg for a in inner[0].args.args] == ["self"]:
            params = {"name": name, "function": function.name, "line": str(function.lineno)}
            return raised.finding("class_ended", at=function, params=params)
    return None


def _callback_misspelt(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    if not _is_callback(raised, match):
        return None
    name, methods = match["name"], raised.source.methods
    close = nearest(name, [m for m in methods if m != "__init__"])
    if close and _known_words(name) > _known_words(close):
        found = raised.finding("callback_misspelt", at=methods[close], name=close, close=name)
        return replace(found, variant="definition")
    found = raised.finding("callback_misspelt", name=name, close=close)
    if not close:
        return replace(found, variant="no_method", words={**found.words, "callback": name})
    return replace(found, variant="", words={**found.words, "callback": close or name})


def _known_words(name: str) -> int:
    return sum(part in WORDS for part in name.lower().split("_"))


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


_node = Family("node", links.FIRST_NODE)
KINDS = (
    _node(
        "callback_called",
        "timer",
        msg("create_timer gets a call instead of the callback"),
        CALLED,
        msg("Remove the () after the callback's name: create_timer({period}, {written})"),
        fixes={
            "not_returned": msg(
                "Write return {inner} as the last line of {method}, indented as far as def {inner}."
            ),
            "wrapped": msg("Pass the callback itself: write {written} instead of {name}."),
            "lambda": msg("Write {written} instead of {name}."),
            "partial": msg(
                "Write {written} instead of {name}, and from functools import partial among the imports."
            ),
            "partial_here": msg("Write {written} instead of {name}."),
        },
        whys={
            "not_returned": msg(
                "{method} defines the function {inner}, and does not return it. So the call of {method} "
                "in line {line} gives the timer None in place of a callback."
            ),
            "lambda": KEPT,
            "partial": KEPT,
            "partial_here": KEPT,
            "wrapped": msg(
                "create_timer takes the period in seconds and the callback itself, and calls it later. "
                "{name} runs now, and its result (None) is passed instead."
            ),
        },
        seen=r"TypeError: 'NoneType' object is not callable"
        r"|UnboundLocalError: .{0,60}'arg_name'",
        raised={
            "'NoneType' object is not callable|'arg_name'|is not a callable object": _called,
            r"TypeError: \w{1,120}\.(?P<name>\w{1,120})\(\) takes": _called_with,
            OWN_ATTRIBUTE: _called_early,
        },
        behind={"run.by_hand": _calls_back_at_once},
        fixed_by=(node_timer.callback, lines.written),
        examples=(
            example(
                "callback_called_with_its_values",
                Replace(NODE, "self.timer_callback)", "self.timer_callback('Hello time: '))"),
                Replace(NODE, "def timer_callback(self)", "def timer_callback(self, text)"),
                Replace(NODE, "'Hello time: ' + str", "text + str"),
                fails="run.output",
                also={"run.period": "node.callback_called"},
                blocks=("run.interrupt",),
            ),
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
        "class_ended",
        "class",
        msg("A function at the margin ends the class"),
        msg(
            "def {function} in line {line} begins at the margin, and there the class ends. {name} below it "
            "is inside of {function}, and no method of the class."
        ),
        msg("Move def {function} with its own lines above the class. Leave {name} where it is."),
        raised={OWN_ATTRIBUTE: _class_ended},
        examples=(
            example(
                "function_at_the_margin_above_the_callback",
                Replace(
                    NODE,
                    "    def timer_callback(self)",
                    "def text_of(number):\n    return 'Hello time: ' + str(number)\n\n"
                    "    def timer_callback(self)",
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
            "definition": msg("Write def {close}(self): instead of def {name}(self):"),
            "no_method": msg(
                "The class has no method {name}. Write def {name}(self): above the lines that the timer "
                "is to run, indented like the other methods, or pass the name of the method that is "
                "meant."
            ),
        },
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
                "callback_of_nothing",
                Replace(NODE, "self.timer_callback)", "self.on_update)"),
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
        "callback_without_self_dot",
        "timer",
        msg("The object is missing before the callback"),
        msg(
            "A method is reached through its object: self.name in the class, the node's variable outside."
        ),
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
        "timer_in_quotes",
        "timer",
        msg("The line that creates the timer is in quotes"),
        msg("Lines between three quotes are a text for the reader. Python does not run them."),
        msg("Remove the three quotes before and after the line with create_timer."),
        fixes={
            "more": msg(
                "Take the line with create_timer out of the quotes: move it below the closing quotes in "
                "line {line}, and indent it as far as the other lines of __init__."
            )
        },
        behind={"run.no_lines": _in_quotes},
        fixed_by=(node_timer.without_quotes,),
        examples=(
            example(
                "timer_in_three_quotes_with_more",
                Replace(
                    NODE,
                    "        self.create_timer(1.0, self.timer_callback)",
                    '        """\n        The old version.\n'
                    '        self.create_timer(1.0, self.timer_callback)\n        """',
                ),
                fails="run.output",
                blocks=SILENT,
            ),
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
)
