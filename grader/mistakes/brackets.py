"""Mistakes around the () of functions: not called, returned by no decorator, given to partial."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.constructor import lines_of
from grader.mistakes.example import DEAD, NODE, example
from grader.mistakes.fixes import lines, node_brackets
from grader.mistakes.kind import Family
from grader.mistakes.recognised import Raised, RecognisedMistake
from grader.package.edit.tree import Replace
from grader.package.source.counter import targets_of
from grader.package.source.declared import declared, read
from grader.package.source.module import Function
from grader.package.source.names import dotted, last_part, own_name
from grader.package.source.place import function_at, statement_at

OF_FUNCTION = (
    r"AttributeError: '(?:function|method|builtin_function_or_method)' object has no attribute "
    r"'(?P<name>\w{1,120})'"
)
NOTHING_CALLED = (
    r"'NoneType' object is not callable|TypeError: None is not a callable object"
    r"|UnboundLocalError: .{0,60}'arg_name'"
)
OF_PARTIAL = (
    r"TypeError: \w{1,120}\.(?P<function>\w{1,120})\(\) (?:takes \d{1,2} positional arguments? but "
    r"\d{1,2} w(?:as|ere) given|got an unexpected keyword argument '(?P<keyword>\w{1,120})'"
    r"|missing \d{1,2} required positional arguments?: '(?P<missing>\w{1,120})')"
)
REFUSED_PARTIAL = (
    r"ValueError: partial object functools\.partial\(<bound method \w{1,120}\.(?P<function>\w{1,120}) "
    r"of .{1,400} has incorrect arguments"
)
IMPORT = "import rclpy\nfrom"
DECORATOR = """\
def logged(function):
    def wrapper(self):
        function(self)


class MyFirstNode"""


def _not_called(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """Something is read from a function that the line, or one above it, does not call."""
    statement = statement_at(raised.module, raised.line)
    parts = [
        part.value
        for part in (ast.walk(statement) if statement is not None else ())
        if isinstance(part, ast.Attribute) and part.attr == match["name"]
    ]
    named = [part for part in parts if isinstance(part, ast.Name | ast.Attribute)]
    if len(named) != 1 or last_part(dotted(named[0])) == "get_logger" or not dotted(named[0]):
        return None
    around = raised.module.parents.get(named[0])
    if isinstance(around, ast.Attribute) and isinstance(around.ctx, ast.Store):
        return None
    given = _assigned(raised, named[0])
    part = named[0] if given is None else given
    if isinstance(part, ast.Call) or last_part(dotted(part)) == "get_logger":
        return None
    if given is None and isinstance(part, ast.Name) and part.id not in raised.module.functions:
        return None
    code = raised.module.text.code(part)
    method = raised.source.methods.get(own_name(part))
    function = raised.module.functions.get(code) if isinstance(part, ast.Name) else method
    if function is not None and isinstance(part, ast.Name) and not _gives_value(function):
        return None
    arguments = _arguments(raised, code, function)
    shown = raised.finding("not_called", at=part, name=code, written=f"{code}({arguments})")
    if "…" not in arguments:
        return shown
    return replace(shown, params={}, variant="open")


def _gives_value(function: Function) -> bool:
    """Whether a function has a return with a value, a yield, or a decorator."""
    return bool(function.decorator_list) or any(
        isinstance(n, ast.Yield | ast.YieldFrom)
        or (isinstance(n, ast.Return) and n.value is not None and ast.unparse(n.value) != "None")
        for n in ast.walk(function)
    )


def _assigned(raised: Raised, named: ast.expr) -> ast.expr | None:
    """Return what a variable or an attribute gets in the only line that assigns to it."""
    name, function = dotted(named), function_at(raised.module, raised.line)
    among = raised.source.own_nodes if "." in name else ast.walk(function or raised.module.tree)
    found = [
        n.value
        for n in among
        if isinstance(n, ast.Assign | ast.AnnAssign) and name in targets_of(n)
    ]
    return found[0] if len(found) == 1 else None


def _arguments(raised: Raised, code: str, function: Function | None) -> str:
    """Return what belongs in the () of a function: nothing, a parameter's name, or what is open."""
    if last_part(code) == "get_parameter":
        used = {parameter.name for parameter in read(raised.source)}
        free = [p for p in declared(raised.source) if p.name not in used]
        quote = raised.module.text.quote
        return f"{quote}{free[0].name}{quote}" if len(free) == 1 else f"{quote}…{quote}"
    if function is None:
        return ""
    own = 1 if code.startswith("self.") else 0
    return "…" if len(function.args.args) - len(function.args.defaults) > own else ""


def _nothing_returned(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """An own decorator returns nothing, so what it decorates is None."""
    del match
    for decorated, decorator in _decorators(raised):
        for function in node_brackets.lacking(raised.module, decorator):
            inner = node_brackets.inner_of(function)
            if inner is None or not _meets(raised, decorated):
                continue
            params = {"name": function.name, "written": f"return {inner.name}"}
            return raised.finding(
                "decorator_returns_none", at=function, params={**params, "method": decorated.name}
            )
    return None


def _decorators(raised: Raised) -> Iterator[tuple[Function, ast.expr]]:
    for function in raised.module.nodes:
        if isinstance(function, Function):
            for decorator in function.decorator_list:
                yield function, decorator


def _meets(raised: Raised, decorated: Function) -> bool:
    """Whether the line of the error calls what is decorated, or spins, or decorates it."""
    first = min((d.lineno for d in decorated.decorator_list), default=decorated.lineno)
    if raised.line is None or first <= raised.line <= decorated.lineno:
        return True
    statement = statement_at(raised.module, raised.line)
    used = {
        n.attr for n in ast.walk(statement or raised.module.tree) if isinstance(n, ast.Attribute)
    }
    used |= {n.id for n in ast.walk(statement or raised.module.tree) if isinstance(n, ast.Name)}
    passed = {timer.method for timer in raised.source.timers}
    spun = bool(used & {"spin", "spin_once", "create_timer"})
    return decorated.name in used or (spun and decorated.name in passed)


def _partial(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """A timer's partial gives its method other arguments than its def has."""
    return _of_partial(raised, match["function"], match["missing"])


def _refused_partial(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """From kilted on rclpy looks at the parameters before it calls a callback."""
    return _of_partial(raised, match["function"], None)


def _of_partial(raised: Raised, function: str, missing: str | None) -> RecognisedMistake | None:
    for timer in raised.source.timers:
        call = timer.callback
        if not isinstance(call, ast.Call) or last_part(dotted(call.func)) != "partial":
            continue
        method = raised.source.method(own_name(call.args[0])) if call.args else None
        if method is None or method.name != function or raised.line is None:
            continue
        if raised.line in lines_of(call) or method.args.vararg or method.args.kwarg:
            continue
        if any(isinstance(a, ast.Starred) for a in call.args):
            continue
        code = raised.source.module_of(call).text.code
        line = str(method.lineno)
        params = {"name": " ".join(code(call).split()), "method": method.name, "line": line}
        if missing is not None:
            params["parameter"] = missing
            mistake = raised.finding("partial_arguments", at=call, params=params)
            return replace(mistake, variant="missing")
        most, known = len(method.args.args), {a.arg for a in method.args.args}
        kept = [code(given) for given in call.args[:most]]
        kept += [code(k) for k in call.keywords if k.arg in known]
        params["written"] = f"{code(call.func)}({', '.join(kept)})"
        return raised.finding("partial_arguments", at=call, params=params)
    return None


_node = Family("node", links.PYTHON_ERRORS)
KINDS = (
    _node(
        "not_called",
        "callback",
        msg("The () after a function is missing"),
        msg("{name} is a function: only calling it, with (), gives its result."),
        msg("Write {written} instead of {name}."),
        fixes={
            "open": msg(
                "Write {written} instead of {name}, with what the function needs in the place of …"
            )
        },
        raised={OF_FUNCTION: _not_called},
        fixed_by=(lines.written,),
        examples=(
            example(
                "get_clock_not_called",
                Replace(
                    NODE, "self.counter_ += 1", "self.get_clock.now()\n        self.counter_ += 1"
                ),
                fails="run.output",
                blocks=("run.interrupt",),
            ),
            example(
                "parameter_value_not_called",
                Replace(
                    NODE,
                    "        self.create_timer(1.0,",
                    "        self.declare_parameter('period', 1.0)\n"
                    "        value = self.get_parameter('period').get_parameter_value\n"
                    "        self.create_timer(value.double_value,",
                ),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "decorator_returns_none",
        "callback",
        msg("A decorator returns nothing"),
        msg(
            "@{name} puts what the function {name} returns in the place of {method}. {name} has no "
            "return of its own, so {method} is None."
        ),
        msg("Write {written} as the last line of {name}, indented like the def inside it."),
        raised={NOTHING_CALLED: _nothing_returned},
        fixed_by=(node_brackets.returned,),
        examples=(
            example(
                "decorator_without_return",
                Replace(NODE, "class MyFirstNode", DECORATOR),
                Replace(NODE, "    def timer_callback", "    @logged\n    def timer_callback"),
                fails="run.output",
                blocks=DEAD,
            ),
        ),
    ),
    _node(
        "partial_arguments",
        "timer",
        msg("partial gets other arguments than the method takes"),
        msg(
            "The timer calls {method} with what partial got, and with nothing else except self. The "
            "def of {method} in line {line} has other parameters."
        ),
        msg("Write {written} instead of {name}."),
        fixes={
            "missing": msg(
                "Pass a value for {parameter} in the () of partial. Or remove {parameter} from the "
                "def in line {line}, if it is not needed."
            )
        },
        raised={OF_PARTIAL: _partial, REFUSED_PARTIAL: _refused_partial},
        fixed_by=(lines.written,),
        examples=(
            example(
                "partial_with_one_too_many",
                Replace(NODE, IMPORT, "import rclpy\nfrom functools import partial\nfrom"),
                Replace(NODE, "self.timer_callback)", "partial(self.timer_callback, 1))"),
                fails="run.output",
                blocks=DEAD,
            ),
        ),
    ),
)
