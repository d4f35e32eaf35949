"""Mistakes about Python itself: what async, yield, a property, a decorator or += does."""

from __future__ import annotations

import ast
import re
from dataclasses import replace

from grader.base.i18n.message import Value, msg
from grader.base.shown import shown
from grader.mistakes import links
from grader.mistakes.elsewhere import counted_at_other_times, counted_elsewhere
from grader.mistakes.example import (
    DATACLASS_IMPORTED,
    LOG,
    NODE,
    PARTIAL_IMPORTED,
    SILENT,
    STEP_LINE,
    example,
)
from grader.mistakes.fixes import lines, node_clock
from grader.mistakes.fixes.case import Case
from grader.mistakes.fixes.node_clock import count_of
from grader.mistakes.fixes.rename import def_renamed
from grader.mistakes.kind import Family
from grader.mistakes.placeholders import as_sum
from grader.mistakes.recognised import Raised, RecognisedMistake, Suspect
from grader.package.edit.files import Files
from grader.package.edit.tree import Replace
from grader.package.source.counter import logged_counter, targets_of
from grader.package.source.module import Function
from grader.package.source.names import dotted, last_part, own_name
from grader.package.source.node import NodeSource
from grader.package.source.place import place_of, statement_at

CLOCKS = ("time", "monotonic", "perf_counter", "now", "strftime", "seconds_nanoseconds", "ctime")
"""Functions and methods that return or show a time."""
MOST_CODE = 80  # characters of a piece of code that a text shows
MOST_STEPS = 3  # assignments through which a value is followed to the line


def _of_function(
    function: Function, kinds: type[ast.AST] | tuple[type[ast.AST], ...]
) -> ast.AST | None:
    """Return the first part of these kinds that belongs to a function, not to one inside it."""
    waiting: list[ast.AST] = list(function.body)
    for node in waiting:
        if isinstance(node, kinds):
            return node
        if not isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef | ast.Lambda):
            waiting += ast.iter_child_nodes(node)
    return None


def _yields(suspect: Suspect) -> RecognisedMistake | None:
    callback = suspect.source.callback
    found = _of_function(callback, (ast.Yield, ast.YieldFrom)) if callback is not None else None
    if not isinstance(found, ast.expr):
        return None
    module = suspect.source.module_of(found)
    loop = next((n for n in module.around(found) if isinstance(n, ast.While)), None)
    mistake = suspect.finding("callback_yields", found)
    if loop is None and isinstance(found, ast.Yield) and isinstance(found.value, ast.Call):
        code = shown(module.text.code(found.value))
        return replace(mistake, params={"value": code}, variant="value")
    if loop is None:
        return mistake
    params = {"row": loop.lineno}
    return replace(
        mistake, params=params, words={**mistake.words, "line": loop.lineno}, variant="loop"
    )


def _plain_callback(case: Case) -> Files | None:
    """Delete the yield, and the `while True` around it; a call behind the yield stays."""
    module = case.module
    if module is not None and "value" in case.finding.params:
        statement = statement_at(module, case.finding.line)
        value = statement.value if isinstance(statement, ast.Expr) else None
        if isinstance(value, ast.Yield) and value.value:
            return case.changed(module, module.text.swap(value, module.text.code(value.value)))
    files, row = lines.deleted(case), case.finding.params.get("row")
    if files is None or row is None:
        return files
    found = replace(case.finding, line=int(row))
    return lines.unwrapped(replace(case, files=files, finding=found))


def _dataclass(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    for found in raised.source.family:
        for decorator in found.decorator_list:
            named = decorator.func if isinstance(decorator, ast.Call) else decorator
            if found.name == match["name"] and last_part(dotted(named)) == "dataclass":
                mistake = raised.finding("class_is_dataclass", at=decorator, name=found.name)
                post = [m for m in found.body if getattr(m, "name", "") == "__post_init__"]
                if not post:
                    return mistake
                words = {**mistake.words, "line": str(post[0].lineno)}
                return replace(mistake, words=words, variant="post_init")
    return None


def _plain_class(case: Case) -> Files | None:
    """Remove @dataclass, and rename its __post_init__, if the class gives all fields a value."""
    node, module, line = case.node, case.module, case.finding.line
    owner = node.node_class if node is not None else None
    post = [s for s in owner.body if isinstance(s, ast.FunctionDef)] if owner is not None else []
    post = [s for s in post if s.name == "__post_init__"]
    if (
        owner is None
        or module is None
        or line is None
        or len(post) != 1
        or len(post[0].args.args) != 1
    ):
        return None
    fields = [s for s in owner.body if isinstance(s, ast.AnnAssign)]
    if not all(isinstance(s.value, ast.Constant) for s in fields):
        return None
    head = def_renamed(module, post[0], "__init__")
    if head is None or not module.text.line(line).startswith("@"):
        return None
    return case.changed(module, module.text.without(line), head)


def _read_only(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    name = match["name"] or match["old"] or ""
    if "'Parameter'" in match[0]:
        return replace(raised.finding("property_set", name=name), variant="parameter")
    for method in raised.source.own_methods:
        if method.name == name and any(dotted(d) == "property" for d in method.decorator_list):
            found = raised.finding("property_set", at=method, name=name)
            if (kept := _returned(method)) and kept != f"self.{name}":
                rows = _set_on(raised, name) or [raised.line or 0]
                words = {**found.words, "written": kept, "line": ", ".join(map(str, rows))}
                where = place_of(raised.source, _assignment(raised) or method)
                return replace(found, words=words, variant="kept", where=where)
            return found if _is_set(raised, name) else replace(found, variant="computed")
    return None


def _assignment(raised: Raised) -> ast.stmt | None:
    """Return the statement that raised the error, if it assigns a value."""
    found = statement_at(raised.module, raised.line)
    return found if isinstance(found, ast.Assign | ast.AugAssign | ast.AnnAssign) else None


def _returned(function: Function) -> str:
    """Return the attribute that a property gives back as it is; "" if it computes its value."""
    returns = [n for n in ast.walk(function) if isinstance(n, ast.Return)]
    named = dotted(returns[0].value) if len(returns) == 1 and returns[0].value else ""
    return named if named.startswith("self.") and named.count(".") == 1 else ""


def _set_on(raised: Raised, name: str) -> list[int]:
    """Return the lines of the file that give an attribute of self a value."""
    return sorted(
        {
            n.lineno
            for n in raised.module.nodes
            if isinstance(n, ast.Assign | ast.AugAssign | ast.AnnAssign)
            and f"self.{name}" in targets_of(n)
        }
    )


def _is_set(raised: Raised, name: str) -> bool:
    """Return whether __init__ itself gives an attribute its first value."""
    init = raised.source.methods.get("__init__")
    nodes = ast.walk(init) if init is not None else ()
    return any(not isinstance(n, ast.AugAssign) and f"self.{name}" in targets_of(n) for n in nodes)


def _skips_base(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """Look for super() with another first argument than the own class."""
    del match
    own = raised.source.class_names
    for call, _ in raised.source.calls:
        called = call.func.value if isinstance(call.func, ast.Attribute) else None
        if not isinstance(called, ast.Call) or dotted(called.func) != "super" or not called.args:
            continue
        named = last_part(dotted(called.args[0]))
        if named and named not in own and raised.line in (None, call.lineno):
            return raised.finding("super_of_base", at=call, name=named)
    return None


def _of_class(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a change to the class's variable, while the node's own is logged."""
    logged = logged_counter(suspect.source)
    if logged is None or not logged[1].startswith("self."):
        return None
    classes = {*suspect.source.class_names, "type(self)", "self.__class__", "cls"}
    for node in suspect.source.own_nodes:
        if isinstance(node, ast.AugAssign) and isinstance(node.target, ast.Attribute):
            owner, name = ast.unparse(node.target.value), node.target.attr
            if owner in classes and name == last_part(logged[1]):
                written = ast.unparse(node.target)
                found = suspect.finding("counter_of_class", node, name=logged[1], value=written)
                around = suspect.source.function_around(node)
                if owner == "cls" and around is not None:
                    words = {**found.words, "method": around.name}
                    return replace(found, words=words, variant="of_method")
                return found
    return None


def _logged(source: NodeSource, part: ast.AST) -> list[ast.expr]:
    """Return the texts that the log calls in a part of the source get."""
    return [arg for call in source.logs(part) for arg in call.args]


def _set_in(function: Function) -> set[str]:
    """Return the names that a function assigns to."""
    return {name for node in ast.walk(function) for name in targets_of(node)}


def _built_once(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a logged attribute that __init__ sets to a text with a value in it."""
    source, callback = suspect.source, suspect.source.callback
    init = source.methods.get("__init__")
    logged = set(map(dotted, _logged(source, callback or source.module.tree)))
    changed = _set_in(callback) if callback is not None else set()
    for node in ast.walk(init) if init is not None else ():
        for name in targets_of(node):
            value = getattr(node, "value", None)
            text = isinstance(value, ast.JoinedStr | ast.BinOp | ast.Call)
            if isinstance(node, ast.Assign) and text and name in logged - changed:
                return suspect.finding("text_built_once", node, name=name)
    return None


def _grows(suspect: Suspect) -> RecognisedMistake | None:
    """Look for += on a text that is logged."""
    source, callback = suspect.source, suspect.source.callback
    if callback is None:
        return None
    logged = set(map(dotted, _logged(source, callback))) - {""}
    set_anew = [n for n in ast.walk(callback) if isinstance(n, ast.Assign | ast.AnnAssign)]
    logged -= {name for node in set_anew for name in targets_of(node)}
    for node in ast.walk(callback):
        if isinstance(node, ast.AugAssign) and dotted(node.target) in logged:
            text = ast.unparse(node.value)
            if isinstance(node.value, ast.JoinedStr) or text.startswith(("str(", "'", '"')):
                name = dotted(node.target)
                return suspect.finding("text_grows", node, name=name, value=text)
    return None


def _next(source: NodeSource) -> ast.Call | None:
    """Return the callback's first call of next()."""
    callback = source.callback
    return next(iter(source.calls_of("next", within=callback)), None) if callback else None


def _used_up(suspect: Suspect) -> RecognisedMistake | None:
    call = _next(suspect.source)
    if call is not None and len(call.args) > 1:
        return None  # (with a second value, next() raises no StopIteration)
    given = call.args[0] if call is not None and call.args else None
    if isinstance(given, ast.Call) and dotted(given.func) == "iter":
        return None  # (it begins anew each time)
    return suspect.finding("iterator_ended", call) if call is not None else None


def _used_up_raised(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    del match
    call = _next(raised.source)
    if call is None:
        return None
    found = raised.finding("iterator_ended", at=call)
    once = [f for f in raised.module.functions.values() if _yields_once(f)]
    made = [f for f in once if any(called == f.name for _, called in raised.source.calls)]
    if len(made) != 1:
        return found
    lines = ", ".join(str(n.lineno) for n in ast.walk(made[0]) if isinstance(n, ast.Yield))
    words = {**found.words, "function": made[0].name, "lines": lines}
    return replace(found, words=words, variant="generator")


def _yields_once(function: Function) -> bool:
    """Whether a function has a yield and no loop."""
    parts = list(ast.walk(function))
    loops = any(isinstance(n, ast.While | ast.For | ast.YieldFrom) for n in parts)
    return any(isinstance(n, ast.Yield) for n in parts) and not loops


def _used_up_default(suspect: Suspect) -> RecognisedMistake | None:
    """The line has the second value of next(), which stands for a number that is not there."""
    head, tail = suspect.output.text.split("{n}")
    calls = [c for c in suspect.source.calls_of("next") if len(c.args) == 2]
    given = calls[0].args[1] if len(calls) == 1 else None
    if not isinstance(given, ast.Constant) or isinstance(given.value, bytes):
        return None
    if suspect.text != f"{head}{given.value}{tail}":
        return None
    found = suspect.finding("iterator_ended", calls[0])
    words = {**found.words, "value": repr(given.value)}
    return replace(found, words=words, variant="default")


def _frozen(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a callback that logs its own parameter: its value was passed with the timer."""
    source, callback = suspect.source, suspect.source.callback
    if callback is None:
        return None
    own = callback.args.args[:1] if callback in source.methods.values() else []
    parameters = [a for a in (*callback.args.args, *callback.args.kwonlyargs) if a not in own]
    given = {parameter.arg for parameter in parameters}
    logged = {dotted(n) for text in _logged(source, callback) for n in ast.walk(text)}
    for name in sorted(given & logged - _set_in(callback)):
        at = source.timers[0].call if source.timers else None
        timer = source.timers[0].callback if source.timers else None
        if isinstance(timer, ast.Lambda) and not timer.args.defaults:
            continue  # (it works out the arguments in each call)
        return _lambda_default(suspect, at) or suspect.finding("argument_frozen", at, name=name)
    return None


def _lambda_default(suspect: Suspect, call: ast.Call | None) -> RecognisedMistake | None:
    """The timer gets a lambda whose only parameter has the counter as its default value."""
    found = [n for n in ast.walk(call) if isinstance(n, ast.Lambda)] if call is not None else []
    given = found[0].args if len(found) == 1 else None
    if given is None or len(given.args) != 1 or len(given.defaults) != 1:
        return None
    text, name = suspect.source.module_of(found[0]).text, given.args[0].arg
    uses = [n for n in ast.walk(found[0].body) if isinstance(n, ast.Name) and n.id == name]
    code, body = text.code(found[0]), text.code(found[0].body)
    value = text.code(given.defaults[0])
    if len(uses) != 1 or not dotted(given.defaults[0]) or "\n" in code or len(code) > MOST_CODE:
        return None
    at = text.span(uses[0])[0] - text.span(found[0].body)[0]
    written = f"lambda: {body[:at]}{value}{body[at + len(name) :]}"
    mistake = suspect.finding("argument_frozen", found[0], name=code, written=written)
    return replace(mistake, words={**mistake.words, "value": value}, variant="lambda")


def _other_attribute(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a sum with the counter that is kept under another name."""
    logged, callback = logged_counter(suspect.source), suspect.source.callback
    if logged is None or callback is None:
        return None
    for node in ast.walk(callback):
        value = node.value if isinstance(node, ast.Assign) else None
        if isinstance(value, ast.BinOp) and isinstance(value.op, ast.Add) and not _has_text(value):
            names = {dotted(n) for n in ast.walk(value)}
            others = [name for name in targets_of(node) if name != logged[1]]
            if isinstance(node, ast.Assign) and logged[1] in names and others:
                return suspect.finding("counter_other_name", node, name=logged[1], value=others[0])
    return None


def _has_text(value: ast.expr) -> bool:
    """Whether a sum is of texts: it has a text, or a call of str()."""
    return any(
        isinstance(n, ast.JoinedStr)
        or (isinstance(n, ast.Constant) and isinstance(n.value, str))
        or (isinstance(n, ast.Call) and dotted(n.func) == "str")
        for n in ast.walk(value)
    )


def _condition(suspect: Suspect) -> RecognisedMistake | None:
    """Look for an exception's class as a condition."""
    for node in suspect.source.all_nodes:
        test = node.test if isinstance(node, ast.If | ast.While) else None
        name = last_part(dotted(test)) if test is not None else ""
        if test is not None and name.endswith(("Interrupt", "Exception", "Error")):
            return suspect.finding("exception_as_condition", test, name=name)
    return None


def _time(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a clock whose time the callback logs."""
    source, callback = suspect.source, suspect.source.callback
    if callback is None or not source.logs(callback):
        return None
    shown = _shown(suspect, callback)
    for call in source.calls_of(*CLOCKS):
        if call in shown:
            found = suspect.finding("time_for_count", call, name=ast.unparse(call.func)[:60])
            past = any(_is_difference(n) for n in shown)
            return _counted_instead(suspect, found, past=past)
    return None


def _is_difference(part: ast.AST) -> bool:
    """Whether a part is a value minus another one, which is no number of the source."""
    if not isinstance(part, ast.BinOp) or not isinstance(part.op, ast.Sub):
        return False
    return not isinstance(part.left, ast.Constant) and not isinstance(part.right, ast.Constant)


def _counted_instead(
    suspect: Suspect, found: RecognisedMistake, *, past: bool
) -> RecognisedMistake:
    """Return a finding of a time with the line that logs a count instead.

    `past` says that the line shows the difference of two times.
    """
    source, callback = suspect.source, suspect.source.callback
    logs = source.logs(callback) if callback is not None else []
    counter, counts = count_of(source)
    words: dict[str, Value] = {
        **found.words,
        "counter": counter,
        "written": f"{ast.unparse(logs[0].func)}({as_sum(suspect.output, counter)})",
        "line": logs[0].lineno,
    }
    of_ros = "get_clock" in str(words["name"])
    kind = "past" if past else "ros" if of_ros else ""
    variant = "_".join(filter(None, (kind, "counts" if counts else "")))
    return replace(found, variant=variant, words=words)


def _shown(suspect: Suspect, callback: Function) -> set[ast.AST]:
    """Return the parts of the callback whose value reaches a logged line."""
    shown = {n for text in _logged(suspect.source, callback) for n in ast.walk(text)}
    for _ in range(MOST_STEPS):
        names = {dotted(n) for n in shown} - {"", "self"}
        called = _called(suspect.source, shown)
        for node in (n for part in (callback, *called) for n in ast.walk(part)):
            given = isinstance(node, ast.Return) and node.value is not None and node not in shown
            if given and suspect.source.function_around(node) in called:
                shown |= set(ast.walk(node))
            if isinstance(node, ast.Assign | ast.AugAssign) and names & set(_targets(node)):
                shown |= set(ast.walk(node.value))
    return shown


def _called(source: NodeSource, parts: set[ast.AST]) -> list[Function]:
    """Return the node's methods that are called in these parts, and its properties read there."""
    calls = [part for part in parts if isinstance(part, ast.Call)]
    methods = [source.method(own_name(call.func)) for call in calls]
    read = [source.method(own_name(p)) for p in parts if isinstance(p, ast.Attribute)]
    methods += [m for m in read if m is not None and "property" in map(dotted, m.decorator_list)]
    return [method for method in dict.fromkeys(methods) if method is not None]


def _targets(node: ast.Assign | ast.AugAssign) -> list[str]:
    """Return the names that a statement sets, those of a tuple too."""
    targets = node.targets if isinstance(node, ast.Assign) else [node.target]
    return [dotted(n) for target in targets for n in ast.walk(target) if dotted(n)]


ROS_TIME = msg(
    "The number says how often the callback was called: {start} first, then {step} more each time. "
    "{name} is the time that a clock shows, and no count. Here ROS time began at 0; on your "
    "terminal the number is that of the seconds since 1970."
)
PAST_TIME = msg(
    "The number says how often the callback was called: {start} first, then {step} more each time. "
    "This line shows how much time has passed. A timer calls its callback for the first time when "
    "its first period has passed, and such a time is not exact."
)
LOG_COUNT = msg(
    "{counter} counts already. Write {written} in the place of the call that logs (line {line}). "
    "Delete what reads the clock."
)
_node = Family("node", links.PYTHON_CLASSES)
KINDS = (
    _node(
        "callback_yields",
        "callback",
        msg("The callback contains yield"),
        msg("A function with yield is a generator: calling it runs none of its lines."),
        msg("Remove the yield: the timer waits for you."),
        fixes={
            "value": msg("Delete the word yield in this line, and keep what follows it."),
            "loop": msg(
                "Remove the yield and the while in line {line}: indent the lines of the while as far as "
                "it is indented now. The timer calls {callback} again for the next step."
            ),
        },
        behind={"run.no_lines": _yields},
        fixed_by=(_plain_callback,),
        examples=(
            example(
                "callback_yields_in_a_loop",
                Replace(
                    NODE,
                    f"{LOG}\n{STEP_LINE}",
                    f"while True:\n            {LOG}\n    {STEP_LINE}            yield\n",
                ),
                fails="run.output",
                blocks=SILENT,
            ),
            example(
                "callback_yields",
                Replace(NODE, STEP_LINE, f"{STEP_LINE}        yield 1.0\n"),
                fails="run.output",
                blocks=SILENT,
            ),
        ),
    ),
    _node(
        "class_is_dataclass",
        "class",
        msg("The node's class is a dataclass"),
        msg(
            "@dataclass gives the class an __eq__ and takes its hash away, but an executor keeps "
            "its nodes in a set, which needs the hash."
        ),
        msg("Remove @dataclass, and set the attributes in __init__."),
        fixes={
            "post_init": msg(
                "Delete this line, and write def __init__(self): instead of def __post_init__ in line "
                "{line}. The values that the class sets above it stay. A name there that only has a "
                "type gets its value in __init__."
            )
        },
        fixed_by=(_plain_class,),
        raised={r"TypeError: unhashable type: '(?P<name>\w{1,120})'": _dataclass},
        examples=(
            example(
                "class_is_dataclass",
                DATACLASS_IMPORTED,
                Replace(NODE, "class MyFirstNode", "@dataclass\nclass MyFirstNode"),
                fails="run.starts",
            ),
            example(
                "class_is_dataclass_with_post_init",
                DATACLASS_IMPORTED,
                Replace(NODE, "class MyFirstNode", "@dataclass\nclass MyFirstNode"),
                Replace(
                    NODE,
                    "    def __init__(self):",
                    "    counter_: int = 0\n\n    def __post_init__(self):",
                ),
                Replace(NODE, "        self.counter_ = 0\n", ""),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "property_set",
        "class",
        msg("A value is assigned to a property that has no setter"),
        msg("@property makes {name} a value that can only be read."),
        msg("Delete the property {name}: in Python an attribute needs no method that returns it."),
        whys={
            "parameter": msg(
                "get_parameter returns an object of the type Parameter. Its {name} can only be read."
            )
        },
        fixes={
            "parameter": msg(
                "Keep the number in an attribute: in __init__, give it the value of the parameter, with "
                "self.count = self.get_parameter(…).value. Log and increase self.count in {callback}."
            ),
            "kept": msg(
                "The property only returns {written}. Assign to that attribute: write {written} "
                "instead of self.{name} in line {line}."
            ),
            "computed": msg(
                "Assign to an attribute with another name, from which the property makes its value."
            ),
        },
        raised={
            r"AttributeError: (?:property '(?P<name>\w{1,120})' of .{1,200} has no setter"
            r"|can't set attribute(?: '(?P<old>\w{1,120})')?)": _read_only
        },
        examples=(
            example(
                "value_of_a_parameter_set",
                Replace(
                    NODE,
                    "self.counter_ = 0",
                    "self.declare_parameter('n', 0)\n        self.counter_ = 0",
                ),
                Replace(NODE, "self.counter_ += 1", "self.get_parameter('n').value += 1"),
                fails="run.output",
                blocks=("run.interrupt",),
            ),
            example(
                "property_set",
                Replace(
                    NODE,
                    "    def timer_callback",
                    "    @property\n    def counter_(self):\n        return 0\n\n    def timer_callback",
                ),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "super_of_base",
        "class",
        msg("super() skips the base class"),
        msg(
            "super({name}, self) means the class after {name}, so the __init__ of {name} is not "
            "called. The first argument is your own class."
        ),
        msg("Write super().__init__('{node_name}')."),
        raised={r"TypeError: object.__init__\(\) takes exactly one argument": _skips_base},
        examples=(
            example(
                "super_of_base",
                Replace(NODE, "super().__init__", "super(Node, self).__init__"),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "counter_of_class",
        "counter",
        msg("The class's variable is increased, and the node's own is logged"),
        msg("{value} and {name} are two variables as soon as {name} is set on the node."),
        msg("Write {name} += {step} instead."),
        fixes={
            "of_method": msg(
                "Delete the line @classmethod above def {method}, and write self instead of cls in the def "
                "and in its lines: then {method} changes the node's own variable."
            )
        },
        behind={"run.constant_counter": _of_class},
        examples=(
            example(
                "counter_of_class",
                Replace(NODE, "self.counter_ += 1", "MyFirstNode.counter_ += 1"),
                Replace(NODE, "    def __init__", "    counter_ = 0\n\n    def __init__"),
                fails="run.output",
            ),
        ),
    ),
    _node(
        "text_built_once",
        "text",
        msg("The text is made once, in __init__"),
        msg("A text does not change when the counter changes later."),
        msg("Make the text in the callback, just before it is logged."),
        behind={"run.constant_counter": _built_once},
        examples=(
            example(
                "text_built_once",
                Replace(
                    NODE,
                    "self.counter_ = 0",
                    "self.counter_ = 0\n        self.text_ = 'Hello time: ' + str(self.counter_)",
                ),
                Replace(NODE, LOG, "self.get_logger().info(self.text_)"),
                fails="run.output",
            ),
        ),
    ),
    _node(
        "text_grows",
        "text",
        msg("The text grows each time"),
        msg("+= changes {name} for good: the next callback begins with the longer text."),
        msg("Delete this line, so that {name} keeps its text, and log {name} + {value}."),
        behind={"run.wrong_text": _grows},
        examples=(
            example(
                "text_grows",
                Replace(
                    NODE,
                    "self.counter_ = 0",
                    "self.counter_ = 0\n        self.text_ = 'Hello time: '",
                ),
                Replace(
                    NODE,
                    LOG,
                    "self.text_ += str(self.counter_)\n        self.get_logger().info(self.text_)",
                ),
                fails="run.output",
                blocks=("run.period",),
            ),
        ),
    ),
    _node(
        "iterator_ended",
        "counter",
        msg("The numbers of an iterator run out"),
        msg("next() raises StopIteration when the iterator has no more values, and the node ends."),
        msg("Count with a number: begin with {start}, and add {step} after each line."),
        raised={r"StopIteration": _used_up_raised},
        behind={
            "run.stops": _used_up,
            "run.ended_early": _used_up,
            "run.wrong_text": _used_up_default,
        },
        whys={
            "default": msg(
                "When the iterator has no more values, next() gives its second value instead: {value}."
            ),
            "generator": msg(
                "Each yield of {function} gives one value. There is no loop around the yield of line "
                "{lines}, so {function} ends after it, and next() then raises StopIteration."
            ),
        },
        fixes={
            "generator": msg(
                "Write while True: above the yield in {function}, and indent the yield and the lines "
                "below it that count by 4 more spaces."
            )
        },
        examples=(
            example(
                "iterator_ended",
                Replace(NODE, "self.counter_ = 0", "self.numbers_ = iter(range(4))"),
                Replace(NODE, "str(self.counter_)", "str(next(self.numbers_))"),
                Replace(NODE, STEP_LINE, ""),
                fails="run.output",
                blocks=("run.interrupt",),
            ),
            example(
                "generator_without_loop",
                Replace(
                    NODE,
                    "class MyFirstNode",
                    "def numbers():\n    n = 0\n    yield n\n    n += 1\n\n\nclass MyFirstNode",
                ),
                Replace(NODE, "self.counter_ = 0", "self.numbers_ = numbers()"),
                Replace(NODE, "str(self.counter_)", "str(next(self.numbers_))"),
                Replace(NODE, STEP_LINE, ""),
                fails="run.output",
                blocks=("run.period", "run.interrupt"),
            ),
        ),
    ),
    _node(
        "counts_elsewhere",
        "counter",
        msg("The counter is not increased where the line is logged"),
        msg("The timer calls {callback} once for each line. Code elsewhere runs at other times."),
        msg("Move the += into {callback}, below the line that logs."),
        whys={
            "outside": msg(
                "This line counts how often it runs itself. The timer calls {callback} once for each "
                "line: only there, each line is counted once. (spin_once() also returns after other "
                "work of the node, such as a request of a service.)"
            ),
            **dict.fromkeys(
                ("timer", "timer_too"),
                msg(
                    "{other} has a timer of its own. It adds when that timer is due, and not each time after "
                    "{callback} has logged a line."
                ),
            ),
            **dict.fromkeys(
                ("unused", "call_it"), msg("No line calls {other}, so its += never runs.")
            ),
        },
        fixes={
            "outside": msg(
                "Delete this line. Write in {callback}, below the line that logs: {written}"
            ),
            "call_it": msg("Write in {callback}, below the line that logs: {written}"),
            "timer": msg(
                "Move the += into {callback}, below the line that logs. Then delete {other}, which "
                "does nothing else, and the create_timer that calls it."
            ),
        },
        deletes=("", "outside", "timer_too", "unused"),
        behind={
            "run.constant_counter": counted_elsewhere,
            "run.wrong_start": counted_at_other_times,
            "run.wrong_step": counted_at_other_times,
        },
        examples=(
            example(
                "counts_in_a_method_without_call",
                Replace(NODE, STEP_LINE, ""),
                Replace(
                    NODE,
                    "    def timer_callback",
                    "    def count(self):\n        self.counter_ += 1\n\n    def timer_callback",
                ),
                fails="run.output",
            ),
            example(
                "counts_in_a_longer_method_without_call",
                Replace(NODE, STEP_LINE, ""),
                Replace(
                    NODE,
                    "    def timer_callback",
                    "    def count(self, more):\n        self.counter_ += 1\n        print(more)\n\n"
                    "    def timer_callback",
                ),
                fails="run.output",
            ),
            example(
                "counts_in_a_timer_due_before",
                Replace(NODE, STEP_LINE, ""),
                Replace(
                    NODE,
                    "        self.create_timer(1.0,",
                    "        self.create_timer(1.0, self.count)\n        self.create_timer(1.0,",
                ),
                Replace(
                    NODE,
                    "    def timer_callback",
                    "    def count(self):\n        self.counter_ += 1\n        self.changed = True\n\n"
                    "    def timer_callback",
                ),
                fails="run.output",
            ),
            example(
                "counts_in_the_loop_of_main",
                Replace(NODE, STEP_LINE, ""),
                Replace(
                    NODE,
                    "        rclpy.spin(node)\n",
                    "        while rclpy.ok():\n            rclpy.spin_once(node)\n"
                    "            node.counter_ = node.counter_ + 1\n",
                ),
                fails="run.output",
            ),
            example(
                "counts_in_loop",
                Replace(NODE, STEP_LINE, ""),
                Replace(
                    NODE,
                    "        rclpy.spin(node)\n",
                    (
                        "        while rclpy.ok():\n"
                        "            rclpy.spin_once(node, timeout_sec=0.1)\n"
                        "            node.counter_ += 3\n"
                    ),
                ),
                fails="run.output",
            ),
        ),
    ),
    _node(
        "argument_frozen",
        "counter",
        msg("The callback gets the number as an argument, which never changes"),
        msg("An argument is evaluated once, when the timer is created, and not at each call."),
        msg(
            "Give the timer the callback alone: self.{callback}. Leave only self in its def, and in it "
            "write the attribute that counts instead of {name}."
        ),
        whys={
            "lambda": msg(
                "A default value is evaluated once, when the lambda is made. So each call gets the "
                "value that {value} had at that moment."
            )
        },
        fixes={"lambda": msg("Write {written} instead of {name}.")},
        behind={"run.constant_counter": _frozen},
        fixed_by=(lines.written,),
        examples=(
            example(
                "argument_frozen",
                PARTIAL_IMPORTED,
                Replace(
                    NODE,
                    "self.create_timer(1.0, self.timer_callback)",
                    "self.create_timer(1.0, partial(self.timer_callback, self.counter_))",
                ),
                Replace(NODE, "def timer_callback(self)", "def timer_callback(self, number)"),
                Replace(NODE, "str(self.counter_)", "str(number)"),
                fails="run.output",
            ),
            example(
                "default_of_lambda_frozen",
                Replace(
                    NODE,
                    "self.create_timer(1.0, self.timer_callback)",
                    "self.create_timer(1.0, lambda n=self.counter_: self.show(n))",
                ),
                Replace(NODE, "def timer_callback(self)", "def show(self, number)"),
                Replace(NODE, "str(self.counter_)", "str(number)"),
                fails="run.output",
            ),
        ),
    ),
    _node(
        "counter_other_name",
        "counter",
        msg("The sum is kept under another name"),
        msg("This line sets {value}. {name}, which is logged, stays as it is."),
        msg("Write {name} += {step}"),
        behind={"run.constant_counter": _other_attribute},
        examples=(
            example(
                "counter_other_name",
                Replace(NODE, "self.counter_ += 1", "self.counter = self.counter_ + 1"),
                fails="run.output",
            ),
        ),
    ),
    _node(
        "exception_as_condition",
        "spin",
        msg("A class of exceptions is used as a condition"),
        msg(
            "A class always counts as true: if {name}: does not ask whether the exception came. "
            "try and except do."
        ),
        msg(
            "Delete this condition with the lines that belong to it. Ctrl+C raises {name}: a try: "
            "around the line that spins, and except {name}: below it, catches it."
        ),
        links.PYTHON_ERRORS,
        behind={
            "run.exits_at_once": _condition,
            "run.ended_early": _condition,
            "run.stops": _condition,
        },
        examples=(
            example(
                "exception_as_condition",
                Replace(
                    NODE,
                    "        rclpy.spin(node)\n",
                    (
                        "        while rclpy.ok():\n"
                        "            rclpy.spin_once(node)\n"
                        "            if KeyboardInterrupt:\n"
                        "                break\n"
                    ),
                ),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "time_for_count",
        "text",
        msg("The line shows a time instead of a count"),
        msg(
            "The number says how often the callback was called: {start} first, then {step} more "
            "each time. {name} is the time that a clock shows, and no count."
        ),
        msg(
            "Write {counter} = {start} in __init__. In the callback, write {written} in the place "
            "of the call that logs (line {line}), and {counter} += {step} below it. Delete what "
            "reads the clock."
        ),
        whys={
            "ros": ROS_TIME,
            "ros_counts": ROS_TIME,
            "past": PAST_TIME,
            "past_counts": PAST_TIME,
        },
        fixes={"counts": LOG_COUNT, "ros_counts": LOG_COUNT, "past_counts": LOG_COUNT},
        behind={
            "run.constant_counter": _time,
            "run.wrong_start": _time,
            "run.wrong_step": _time,
            "run.wrong_text": _time,
        },
        fixed_by=(node_clock.count_for_time,),
        examples=(
            example(
                "time_in_a_variable",
                Replace(NODE, "import rclpy\nfrom", "import time\n\nimport rclpy\nfrom"),
                Replace(NODE, "        self.counter_ = 0\n", ""),
                Replace(
                    NODE,
                    f"        {LOG}\n        self.counter_ += 1\n",
                    "        now = time.strftime('%H:%M:%S')\n"
                    "        self.get_logger().info('Hello time: ' + now)\n",
                ),
                fails="run.output",
                note="there is no counter",
            ),
            example(
                "property_that_asks_a_clock",
                Replace(NODE, "import rclpy\nfrom", "import time\n\nimport rclpy\nfrom"),
                Replace(NODE, "self.counter_ = 0", "self.start_ = time.monotonic()"),
                Replace(
                    NODE,
                    "    def timer_callback",
                    "    @property\n    def counter_(self):\n"
                    "        return round(time.monotonic() - self.start_)\n\n    def timer_callback",
                ),
                Replace(NODE, STEP_LINE, ""),
                fails="run.output",
            ),
            example(
                "time_of_day",
                Replace(NODE, "import rclpy\nfrom", "import time\n\nimport rclpy\nfrom"),
                Replace(NODE, "str(self.counter_)", "time.strftime('%H:%M:%S')"),
                fails="run.output",
            ),
            example(
                "seconds_of_the_clock",
                Replace(
                    NODE,
                    "str(self.counter_)",
                    "str(self.get_clock().now().seconds_nanoseconds()[0] + 7)",
                ),
                fails="run.output",
            ),
        ),
    ),
)
