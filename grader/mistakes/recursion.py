"""Mistakes in which a function calls itself, or an object makes another of its class, without end."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.example import DEAD, NODE, STEP_LINE, example
from grader.mistakes.fixes import lines
from grader.mistakes.fixes.case import Case
from grader.mistakes.kind import Family
from grader.mistakes.recognised import Raised, RecognisedMistake, Suspect
from grader.package.edit.files import Files
from grader.package.edit.tree import Replace
from grader.package.source.module import Function, Module
from grader.package.source.names import calls_in, dotted, last_part
from grader.package.source.place import block_of, function_at, place_of

RECURSION = "RecursionError"
PROPERTY = ("property", "cached_property", "functools.cached_property")


def _without_end(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    del match
    function = function_at(raised.module, raised.line)
    if function is None:
        return None
    return (
        _spins_by_itself(raised, function)
        or _own_class(raised, function)
        or _own_property(raised, function)
        or _itself(raised, function)
    )


def _calls(function: Function) -> Iterator[ast.Call]:
    """Yield the calls that run each time a function runs: none under a condition."""
    waiting: list[ast.AST] = list(function.body)
    for node in waiting:
        if isinstance(node, ast.Call):
            yield node
        if not isinstance(
            node, ast.If | ast.IfExp | ast.BoolOp | ast.Lambda | Function | ast.While
        ):
            waiting += ast.iter_child_nodes(node)


def _statement(raised: Raised, part: ast.AST) -> ast.stmt | None:
    found = (n for n in raised.module.around(part) if isinstance(n, ast.stmt))
    return next(found, None)


def _own_class(raised: Raised, function: Function) -> RecognisedMistake | None:
    """__init__ makes an object of its own class."""
    around = raised.module.parents.get(function)
    if function.name != "__init__" or not isinstance(around, ast.ClassDef):
        return None
    for call in _calls(function):
        statement = _statement(raised, call)
        if dotted(call.func) != around.name or statement is None:
            continue
        target = statement.targets[0] if isinstance(statement, ast.Assign) else None
        name = dotted(target) if target is not None else ""
        uses = [n for n in raised.module.nodes if name and dotted(n) == name and n is not target]
        uses = [n for n in uses if isinstance(n, ast.Name | ast.Attribute)]
        params = {"name": name, "type": around.name}
        found = raised.finding("makes_itself", at=call, params=params)
        if (
            isinstance(statement, ast.Assign | ast.Expr)
            and getattr(statement, "value", None) is call
        ):
            return replace(found, variant="used") if uses else found
        return None
    return None


def _own_property(raised: Raised, function: Function) -> RecognisedMistake | None:
    """A property reads or sets itself."""
    if any(dotted(d) == f"{function.name}.setter" for d in function.decorator_list):
        return _own_setter(raised, function)
    if not any(dotted(d) in PROPERTY for d in function.decorator_list):
        return None
    code = f"self.{function.name}"
    for part in ast.walk(function):
        if isinstance(part, ast.Attribute) and dotted(part) == code:
            params = {"name": code, "written": f"self._{function.name}", "method": function.name}
            counted = {
                dotted(n.target) for n in raised.module.nodes if isinstance(n, ast.AugAssign)
            }
            kept = [name for name in counted if name.startswith("self.")]
            if any(dotted(n) == params["written"] for n in raised.module.nodes):
                return raised.finding("property_of_itself", at=part, params=params)
            if len(kept) == 1 and kept[0] != code:
                params["written"] = kept[0]
                return raised.finding("property_of_itself", at=part, params=params)
            return replace(
                raised.finding("property_of_itself", at=part, params=params), variant="new"
            )
    return None


def _uses_of_itself(module: Module, function: Function) -> list[ast.Attribute]:
    """Return where the getter and the setter of a property use this property."""
    around = module.parents.get(function)
    return [
        n
        for method in (around.body if isinstance(around, ast.ClassDef) else ())
        if isinstance(method, Function) and method.name == function.name
        for n in ast.walk(method)
        if isinstance(n, ast.Attribute) and dotted(n) == f"self.{function.name}"
    ]


def _other_name(case: Case) -> Files | None:
    """Write the other name in all lines of a property that sets itself; else on the line."""
    module = case.module
    function = function_at(module, case.finding.line) if module is not None else None
    if module is None or function is None:
        return None
    if not any(dotted(d) == f"{function.name}.setter" for d in function.decorator_list):
        return lines.written(case)
    new = str(case.finding.params.get("written", ""))
    if new.endswith("="):  # (the setter alone is wrong)
        return lines.written(case)
    uses = _uses_of_itself(module, function)
    return case.changed(module, *(module.text.swap(use, new) for use in uses)) if new else None


def _own_setter(raised: Raised, function: Function) -> RecognisedMistake | None:
    """The setter of a property sets the property."""
    other = _sets_property(raised, function)
    if other is not None:
        return other
    code = f"self.{function.name}"
    parts = _uses_of_itself(raised.module, function)
    if not any(n in list(ast.walk(function)) and isinstance(n.ctx, ast.Store) for n in parts):
        return None
    params = {"name": code, "written": f"self._{function.name}"}
    found = raised.finding("property_of_itself", at=_statement(raised, parts[-1]), params=params)
    rows = ", ".join(map(str, sorted({n.lineno for n in parts})))
    return replace(found, words={**found.words, "lines": rows}, variant="setter")


def _sets_property(raised: Raised, function: Function) -> RecognisedMistake | None:
    """A setter sets the property, and not the attribute that the property returns."""
    code = f"self.{function.name}"
    sets = [
        n
        for n in ast.walk(function)
        if isinstance(n, ast.Attribute) and isinstance(n.ctx, ast.Store) and dotted(n) == code
    ]
    returned = {
        dotted(n.value)
        for getter in raised.module.nodes
        if isinstance(getter, Function) and getter.name == function.name and getter is not function
        for n in ast.walk(getter)
        if isinstance(n, ast.Return) and n.value is not None
    }
    kept = min(returned, default="")
    if len(sets) != 1 or len(returned) != 1 or not kept.startswith("self.") or kept == code:
        return None
    params = {"name": f"{code} =", "written": f"{kept} =", "method": function.name}
    found = raised.finding("property_of_itself", at=sets[0], params=params)
    return replace(found, variant="setter_only")


def _spins_by_itself(raised: Raised, function: Function) -> RecognisedMistake | None:
    """A function spins once and calls itself, in place of a loop or of spin."""
    calls = list(calls_in(function))
    again = [call for call, name in calls if last_part(name) == function.name]
    if not again or not any(last_part(name) == "spin_once" for _, name in calls):
        return None
    params = {"name": "", "function": function.name, "spins": "yes"}
    return replace(raised.finding("calls_itself", at=again[0], params=params), variant="spins")


def _itself(raised: Raised, function: Function) -> RecognisedMistake | None:
    """A function calls itself each time."""
    method = isinstance(raised.module.parents.get(function), ast.ClassDef)
    wanted = f"self.{function.name}" if method else function.name
    for call in _calls(function):
        statement = _statement(raised, call)
        if dotted(call.func) != wanted or not isinstance(statement, ast.Expr):
            continue
        if statement.value is not call:
            return None
        timed = any(timer.method == function.name for timer in raised.source.timers)
        alone = len(block_of(raised.module, statement)) == 1
        code = raised.module.text.code(call)
        found = raised.finding("calls_itself", at=call, name=code, function=function.name)
        return replace(found, variant="alone" if alone else "timed" if timed else "")
    return None


def _callback(suspect: Suspect) -> RecognisedMistake | None:
    """The callback calls itself: each period brings hundreds of lines."""
    source, callback = suspect.source, suspect.source.callback
    if callback is None or source.method(callback.name) is not callback:
        return None
    where = place_of(source, callback)
    always = _itself(Raised("", where, source, suspect.assignment), callback)
    return always or _itself_if(suspect, callback)


def _itself_if(suspect: Suspect, callback: Function) -> RecognisedMistake | None:
    """The timer's callback calls itself under a condition: the one call of the timer logs several lines."""
    source, name = suspect.source, f"self.{callback.name}"
    module = source.module_of(callback)
    calls = [call for call, called in calls_in(callback) if called == name]
    timed = any(timer.method == callback.name for timer in source.timers)
    if len(calls) != 1 or not timed or not isinstance(module.parents.get(calls[0]), ast.Expr):
        return None
    params = {"name": module.text.code(calls[0]), "function": callback.name}
    return replace(suspect.finding("calls_itself", calls[0], **params), variant="timed_if")


def _deleted(case: Case) -> Files | None:
    """Delete the call, unless the function spins the node with it."""
    return None if case.finding.params.get("spins") else lines.deleted(case)


_node = Family("node", links.PYTHON_CLASSES)
KINDS = (
    _node(
        "makes_itself",
        "class",
        msg("__init__ makes an object of its own class"),
        msg(
            "{type}() runs __init__, and this line of __init__ calls {type}() again: there is no "
            "end. In a method, self is the object that {function} has made."
        ),
        msg("Delete this line."),
        fixes={
            "used": msg("Delete this line, and write self instead of {name} on the other lines.")
        },
        raised={RECURSION: _without_end},
        fixed_by=(lines.deleted,),
        examples=(
            example(
                "init_makes_itself",
                Replace(
                    NODE,
                    "        super().__init__(",
                    "        self.node_ = MyFirstNode()\n        super().__init__(",
                ),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "property_of_itself",
        "callback",
        msg("A property reads or sets itself"),
        msg("{name} is this property: each time it is read, the property runs and reads it again."),
        msg("Write {written} instead of {name} on this line."),
        fixes={
            "new": msg(
                "Give the value another name than the property: write {written} instead of {name} on "
                "this line, and set {written} in __init__."
            ),
            "setter": msg(
                "Give the value another name than the property: write {written} instead of {name} in the "
                "lines of the property (lines: {lines}). All other lines keep {name}."
            ),
        },
        whys={
            "setter_only": msg(
                "This is the setter of the property {method}. Each time the property is set, the setter "
                "runs, and here it sets the property again."
            ),
            "setter": msg(
                "{name} is this property: each time it is set, the setter runs and sets it again."
            ),
        },
        fixed_by=(_other_name,),
        examples=(
            example(
                "property_reads_itself",
                Replace(NODE, "str(self.counter_))", "str(self.number))"),
                Replace(
                    NODE,
                    "    def timer_callback",
                    "    @property\n    def number(self):\n        return self.number\n\n"
                    "    def timer_callback",
                ),
                fails="run.output",
                blocks=DEAD,
            ),
        ),
    ),
    _node(
        "calls_itself",
        "callback",
        msg("A function calls itself without end"),
        msg("Each call of {function} comes to this line, which calls {function} again."),
        msg("Delete this line: {name}"),
        whys={
            "spins": msg(
                "{function} calls itself to go on. Python keeps a place for each call that has not "
                "returned, and stops the program after about 1000 of them."
            ),
            "timed_if": msg(
                "{function} calls itself here. So one call of the timer can log several lines at once. The "
                "timer calls {function} in each period already."
            ),
            "timed": msg(
                "Each call of {function} comes to this line, which calls {function} again. The timer "
                "calls {function} in each period already."
            ),
        },
        fixes={
            "spins": msg(
                "Delete the function {function}, and write rclpy.spin({node}) where it is called: spin "
                "repeats by itself, until Ctrl+C."
            ),
            "alone": msg("Write pass instead of this line: its block has no other line."),
        },
        behind=dict.fromkeys(
            (
                *("run.wrong_step", "run.wrong_start", "run.twice", "run.wrong_period"),
                *("run.too_much_output", "run.constant_counter", "run.by_hand"),
            ),
            _callback,
        ),
        deletes=("timed_if",),
        fixed_by=(_deleted,),
        examples=(
            example(
                "spins_by_calling_itself",
                Replace(
                    NODE,
                    "def main(",
                    "def run(node):\n    rclpy.spin_once(node, timeout_sec=0.01)\n"
                    "    return run(node)\n\n\ndef main(",
                ),
                Replace(NODE, "        rclpy.spin(node)\n", "        run(node)\n"),
                fails="run.output",
                blocks=("run.interrupt",),
            ),
            example(
                "callback_calls_itself",
                Replace(NODE, STEP_LINE, f"{STEP_LINE}        self.timer_callback()\n"),
                fails="run.output",
                blocks=("run.period", "run.interrupt"),
            ),
        ),
    ),
)
