"""Mistakes in what Python calls by itself: __next__, __iadd__ and __post_init__."""

from __future__ import annotations

import ast
import re
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.base.nearest import nearest
from grader.mistakes import links
from grader.mistakes.example import DEAD, LOG, NODE, STEP_LINE, example
from grader.mistakes.fixes import lines, node_anew, node_words
from grader.mistakes.kind import Family
from grader.mistakes.made_by import statements_that_make
from grader.mistakes.recognised import OWN_ATTRIBUTE, Raised, RecognisedMistake, Suspect, on_line
from grader.package.edit.tree import Replace
from grader.package.source.counter import adds_to, parts_of_callback, starts_of, targets_of
from grader.package.source.module import Function
from grader.package.source.names import called_name, dotted, is_enum, last_part, own_name
from grader.package.source.place import function_at, statement_at

MOST_CODE = 80  # characters of a piece of code that a text shows
NOT_CALLED = ("method", "function")
NO_ITEMS = ("int", "float", "bool", "NoneType")
"""Types of which iter() makes no iterator."""


def _no_iterator(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The only next() of the line gets a function, or something that only has items."""
    kind, statement = match["type"], statement_at(raised.module, raised.line)
    calls = [
        n
        for n in (ast.walk(statement) if statement is not None else ())
        if isinstance(n, ast.Call) and dotted(n.func) == "next" and n.args
    ]
    code = raised.module.text.code(calls[0].args[0]) if len(calls) == 1 else ""
    if not code or not dotted(calls[0].args[0]) or len(code) > MOST_CODE:
        return None
    if kind in NO_ITEMS:
        return _of_number(raised, calls[0], code)
    if kind not in NOT_CALLED:
        precise = _named_next(raised, kind) or _made_once(raised, calls[0].args[0])
        if precise is not None:
            return precise
        own = [c for module in raised.source.modules for c in module.classes if c.name == kind]
        found = raised.finding("not_an_iterator", at=own[0] if own else None, name=code)
        words = {**found.words, "type": kind, "line": str(raised.line)}
        return replace(found, words=words, variant="own" if own else "")
    values = node_words.values_of(raised.source, calls[0].args[0])
    method = raised.source.methods.get(own_name(calls[0].args[0]))
    if method is not None and not values:
        return _of_method(raised, method, code) if _is_generator(method) else None
    named = values[0] if len(values) == 1 and dotted(values[0]) else None
    known = [
        n
        for n in raised.source.all_nodes
        if isinstance(n, Function) and named is not None and n.name == last_part(dotted(named))
    ]
    if named is None or len(known) != 1 or not _is_generator(known[0]):
        function = function_at(raised.module, raised.line)
        names = [a.arg for a in function.args.args] if function is not None else []
        if function is not None and code in names and not values:
            found = raised.finding("not_an_iterator", name=code)
            order = {"function": function.name, "names": ", ".join(names)}
            return replace(found, words={**found.words, **order}, variant="parameter")
        found = raised.finding("not_an_iterator", name=code)
        return replace(found, variant="function")
    name = raised.source.module_of(named).text.code(named)
    found = raised.finding("not_an_iterator", at=named, name=name, written=f"{name}()")
    return replace(found, words={**found.words, "function": known[0].name}, variant="kept")


def _of_number(raised: Raised, call: ast.Call, code: str) -> RecognisedMistake | None:
    """next() gets a number that another line adds to: the number itself is meant."""
    added = any(adds_to(n, code) for n in raised.source.own_nodes)
    whole = raised.module.text.code(call)
    if not added or len(call.args) > 1 or "\n" in whole or code not in starts_of(raised.source):
        return None
    found = raised.finding("not_an_iterator", name=whole, written=code)
    return replace(found, words={**found.words, "type": "int"}, variant="number")


def _of_method(raised: Raised, method: Function, code: str) -> RecognisedMistake:
    """next() gets a method with yield, which has to be called once."""
    attribute = node_anew.attribute_for(raised.source, method.name)
    found = raised.finding("not_an_iterator", name=code, written=f"{attribute} = {code}()")
    return replace(found, words={**found.words, "attribute": attribute}, variant="method")


def _named_next(raised: Raised, kind: str) -> RecognisedMistake | None:
    """The class has the method next, as Python 2 wants it, and nothing calls it by this name."""
    methods = [
        s
        for module in raised.source.modules
        for own in module.classes
        for s in own.body
        if own.name == kind and isinstance(s, ast.FunctionDef) and s.name == "next"
    ]
    called = any(name.endswith(".next") for _, name in raised.source.calls)
    if len(methods) != 1 or called:
        return None
    found = raised.finding("not_an_iterator", at=methods[0], name="next", written="__next__")
    return replace(found, words={**found.words, "type": kind}, variant="renamed")


def _made_once(raised: Raised, given: ast.expr) -> RecognisedMistake | None:
    """The only value of the name is a range or a list, and it is made before the callbacks."""
    values = node_words.values_of(raised.source, given)
    value = values[0] if len(values) == 1 else None
    known = isinstance(value, ast.List | ast.Tuple) or (
        isinstance(value, ast.Call) and dotted(value.func) in ("range", "list", "tuple")
    )
    around = raised.source.function_around(value) if value is not None else None
    if value is None or not known or (around is not None and around.name != "__init__"):
        return None
    code = raised.source.module_of(value).text.code(value)
    if "\n" in code or len(code) > MOST_CODE:
        return None
    found = raised.finding("not_an_iterator", at=value, name=code, written=f"iter({code})")
    kind = "list" if isinstance(value, ast.List) else "tuple"
    words = {"type": dotted(value.func) if isinstance(value, ast.Call) else kind}
    return replace(found, words={**found.words, **words}, variant="items")


def _is_generator(function: Function) -> bool:
    """Whether a function has a yield, and can be called with nothing in the ()."""
    needed = [a.arg for a in function.args.args if a.arg != "self"]
    gives = any(isinstance(n, ast.Yield) for n in ast.walk(function))
    return gives and len(needed) == len(function.args.defaults)


def _mutable(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The only field of the dataclass whose default value is a list, a dict or a set."""
    statement = statement_at(raised.module, raised.line)
    own = [c for c in raised.module.classes if c is statement or _begins_at(c, raised.line)]
    fields = [
        (s, s.value)
        for s in (own[0].body if len(own) == 1 else ())
        if isinstance(s, ast.AnnAssign) and _is_of(s.value, match["type"])
    ]
    code = raised.module.text.code(fields[0][1]) if len(fields) == 1 and fields[0][1] else ""
    if not code or "\n" in code or len(code) > MOST_CODE:
        return None
    empty = code in ("[]", "{}", f"{match['type']}()")
    written = f"field(default_factory={match['type'] if empty else f'lambda: {code}'})"
    row = raised.module.text.code(fields[0][0])
    new = f"{row.removesuffix(code)}{written}"
    found = raised.finding("mutable_default", at=fields[0][0], name=row, written=new)
    return replace(found, words={**found.words, "type": own[0].name})


def _begins_at(own: ast.ClassDef, line: int | None) -> bool:
    return line in (own.lineno, *(decorator.lineno for decorator in own.decorator_list))


def _is_of(value: ast.expr | None, kind: str) -> bool:
    """Whether a value is written as a list, a dict or a set."""
    literals = {"list": ast.List, "dict": ast.Dict, "set": ast.Set}
    called = isinstance(value, ast.Call) and dotted(value.func) == kind
    return called or (kind in literals and isinstance(value, literals[kind]))


def _object_added(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """One side of + or += is an object of a class of the files, such as a member of an Enum."""
    given = [name for name in match.groupdict("").values() if name]
    classes = [c for m in raised.source.modules for c in m.classes if c.name in given]
    if len(classes) != 1:
        return None
    own = classes[0]
    methods = {s.name for s in own.body if isinstance(s, ast.FunctionDef)}
    with_text = bool(match["given"]) or "str" in given
    if methods & {"__add__", "__radd__", "__iadd__"} or (with_text and "__str__" in methods):
        return None  # (it may be meant to be added, or to be made a text of)
    found = raised.finding("object_added")
    words = {**found.words, "type": own.name, "line": str(own.lineno)}
    if not is_enum(own):
        return replace(found, words=words)
    statement = statement_at(raised.module, raised.line)
    members = [
        dotted(n)
        for n in (ast.walk(statement) if statement is not None else ())
        if isinstance(n, ast.Attribute) and dotted(n.value) == own.name
    ]
    if len(members) != 1:
        return replace(found, words=words, variant="enum")
    found = raised.finding("object_added", name=members[0], written=f"{members[0]}.value")
    return replace(found, words={**found.words, "type": own.name}, variant="member")


def _from_the_end(suspect: Suspect) -> RecognisedMistake | None:
    """The numbers go down, and the only pop() of the callback has nothing in its ()."""
    numbers = [int(n[0]) for line in suspect.lines if (n := re.search(r"-?\d+", line)) is not None]
    down = [before - after for before, after in zip(numbers, numbers[1:])]
    calls = [
        n
        for part in parts_of_callback(suspect.source)
        for n in ast.walk(part)
        if isinstance(n, ast.Call) and isinstance(n.func, ast.Attribute) and n.func.attr == "pop"
    ]
    if len(calls) != 1 or calls[0].args or not down or set(down) != {suspect.output.step}:
        return None
    code = suspect.source.module_of(calls[0]).text.code(calls[0])
    if not code.endswith("pop()") or "\n" in code:
        return None
    return suspect.finding("pop_from_the_end", calls[0], name=code, written=f"{code[:-1]}0)")


def _truth_value(suspect: Suspect) -> RecognisedMistake | None:
    """The line shows True or False, which is the first value of what is added to."""
    head, tail = map(re.escape, suspect.output.text.split("{n}"))
    if not re.fullmatch(rf"{head}(?:True|False){tail}", suspect.text):
        return None
    made = statements_that_make(suspect.source, suspect.place)
    starts = [
        n
        for n in made
        if isinstance(n, ast.Assign | ast.AnnAssign)
        and isinstance(n.value, ast.Constant)
        and isinstance(n.value.value, bool)
    ]
    if len(starts) != 1 or not any(isinstance(n, ast.AugAssign) for n in made):
        return None
    value = suspect.source.module_of(starts[0]).text.code(starts[0])
    name = "True" if value.endswith("True") else "False"
    params = {"name": name, "written": str(suspect.output.start)}
    return suspect.finding("starts_as_truth_value", starts[0], **params)


def _sum_lost(suspect: Suspect) -> RecognisedMistake | None:
    """A line shows None: what += calls, __iadd__, returns nothing."""
    found = _without_value(suspect) if re.search(r"\bNone\b", suspect.text) else None
    if found is None:
        return None
    own, method = found
    mistake = suspect.finding("sum_not_returned", method, name=method.name)
    return replace(mistake, words={**mistake.words, "type": own.name})


def _without_value(suspect: Suspect) -> tuple[ast.ClassDef, ast.FunctionDef] | None:
    """Return the only __iadd__ or __add__ of the files, with its class, if it returns nothing."""
    methods = [
        (own, s)
        for module in suspect.source.modules
        for own in module.classes
        for s in own.body
        if isinstance(s, ast.FunctionDef) and s.name in ("__iadd__", "__add__")
    ]
    if len(methods) != 1:
        return None
    parts = list(ast.walk(methods[0][1]))
    gives = any(isinstance(n, ast.Return | ast.Yield) and n.value is not None for n in parts)
    return None if gives or any(isinstance(n, ast.Raise) for n in parts) else methods[0]


def _post_init(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """A dataclass sets the missing field in a method whose name is nearly __post_init__."""
    kind, name = last_part(match["type"]), match["name"]
    found = [c for m in raised.source.modules for c in m.classes if c.name == kind]
    given = [last_part(_decorator(d)) for own in found for d in own.decorator_list]
    if len(found) != 1 or "dataclass" not in given:
        return None
    for method in found[0].body:
        if not isinstance(method, ast.FunctionDef) or method.name == "__post_init__":
            continue
        sets = any(f"self.{name}" in targets_of(n) for n in ast.walk(method))
        plain = method.name.replace("_", "").lower()
        close = plain == "postinit" or nearest(method.name, ("__post_init__",), cutoff=0.8)
        if sets and close:
            params = {"name": method.name, "written": "__post_init__"}
            mistake = raised.finding("post_init_name", at=method, params=params)
            return replace(mistake, words={**mistake.words, "type": kind, "attribute": name})
    return None


def _decorator(given: ast.expr) -> str:
    return called_name(given) if isinstance(given, ast.Call) else dotted(given)


COUNTER_CLASS = (
    "class Ticks:\n    def __init__(self):\n        self.value = 0\n\n"
    "    def __iadd__(self, step):\n        self.value += step\n\n"
    "    def __str__(self):\n        return str(self.value)\n\n\nclass MyFirstNode"
)
GENERATOR = (
    "def numbers():\n    value = 0\n    while True:\n        yield value\n        value += 1\n\n\n"
    "class MyFirstNode"
)
STATE = (
    "@dataclass\nclass State:\n    count: int = field(init=False)\n\n"
    "    def __postinit__(self):\n        self.count = 0\n\n\nclass MyFirstNode"
)
ENUM = msg(
    "{type} is an Enum. A member of it is an object with a name and a value: .value is the value."
)
_node = Family("node", links.PYTHON_CLASSES)
KINDS = (
    _node(
        "not_an_iterator",
        "counter",
        msg("next() gets a value that is not an iterator"),
        msg("next() takes the next item of an iterator. The type {type} is none."),
        msg(
            "Find the line that gives {name} its value. A list, a range and everything else that for "
            "can go through becomes an iterator with iter(…). Make it once, before the first callback."
        ),
        links.PYTHON_ERRORS,
        whys={
            "items": msg(
                "next() takes the next item of an iterator. The type {type} has items, but is no iterator: "
                "iter(…) makes one of it."
            ),
            "renamed": msg(
                "next() calls the method __next__ of an object. The class {type} has only next, which is the "
                "name of this method in Python 2."
            ),
            "own": msg(
                "next() calls the method __next__ of an object. The class {type} has no such method."
            ),
            "function": msg(
                "next() takes the next item of an iterator. {name} is a function here, and only the call "
                "of a function can give an iterator."
            ),
            "parameter": msg(
                "next() takes the next item of an iterator. {name} is a parameter of {function} and gets a "
                "function here, not an iterator."
            ),
            **dict.fromkeys(
                ("kept", "method"),
                msg(
                    "Without (), {name} is the function itself. next() needs what the call of the function "
                    "gives."
                ),
            ),
            "number": msg(
                "next() takes the next item of an iterator. A number of the type {type} has no items."
            ),
        },
        fixes={
            "function": msg(
                "Find the line that gives {name} its value, and call the function there: write () behind "
                "its name, with the values that it needs. Call it once, before the first callback: each "
                "call begins again."
            ),
            "parameter": msg(
                "Find where {function} is called, or passed on with its values, and compare these with its "
                "parameters in their order: {names}. An iterator has to stand at the place of {name}."
            ),
            "kept": msg("Write {written} instead of {name} in this line."),
            "number": msg("Write {written} instead of {name} in this line."),
            "method": msg(
                "Call it once: write {written} in __init__, below super().__init__. In this line, write "
                "{attribute} instead of {name}."
            ),
            "items": msg("Write {written} instead of {name} in this line."),
            "renamed": msg("Write {written} instead of {name} in this line."),
            "own": msg(
                "Line {line} calls next({name}). Write in this class a method def __next__(self): that "
                "returns the next number."
            ),
        },
        raised={r"'(?P<type>\w{1,60})' object is not an iterator": on_line(_no_iterator)},
        fixed_by=(lines.written,),
        examples=(
            example(
                "next_of_a_number",
                Replace(NODE, "str(self.counter_)", "str(next(self.counter_))"),
                fails="run.output",
                blocks=DEAD,
            ),
            example(
                "next_of_a_method_with_yield",
                Replace(
                    NODE,
                    "    def timer_callback",
                    "    def numbers(self):\n        n = 0\n        while True:\n"
                    "            yield n\n            n += 1\n\n    def timer_callback",
                ),
                Replace(NODE, "str(self.counter_)", "str(next(self.numbers))"),
                Replace(NODE, STEP_LINE, ""),
                fails="run.output",
                blocks=DEAD,
            ),
            example(
                "generator_function_without_brackets",
                Replace(NODE, "class MyFirstNode", GENERATOR),
                Replace(NODE, "self.counter_ = 0", "self.counter_ = numbers"),
                Replace(NODE, "str(self.counter_)", "str(next(self.counter_))"),
                Replace(NODE, STEP_LINE, ""),
                fails="run.output",
                blocks=DEAD,
            ),
            example(
                "next_of_python_2",
                Replace(
                    NODE,
                    "class MyFirstNode",
                    "class Ticks:\n    def __init__(self):\n        self.value = -1\n\n"
                    "    def next(self):\n        self.value += 1\n        return self.value\n\n\n"
                    "class MyFirstNode",
                ),
                Replace(NODE, "self.counter_ = 0", "self.counter_ = Ticks()"),
                Replace(NODE, "str(self.counter_)", "str(next(self.counter_))"),
                Replace(NODE, STEP_LINE, ""),
                fails="run.output",
                blocks=DEAD,
            ),
            example(
                "next_of_a_range",
                Replace(NODE, "self.counter_ = 0", "self.counter_ = range(1000)"),
                Replace(NODE, "str(self.counter_)", "str(next(self.counter_))"),
                Replace(NODE, STEP_LINE, ""),
                fails="run.output",
                blocks=DEAD,
            ),
        ),
    ),
    _node(
        "object_added",
        "callback",
        msg("An object of a class is used with + like a text or a number"),
        msg(
            "One side of + is an object of the class {type} (line {line}), and this class has no method for +."
        ),
        msg(
            "Write the text or the number that is meant instead of the object: in the line that makes "
            "it, or here, as one of its attributes or what one of its methods returns."
        ),
        links.PYTHON_CLASSES,
        whys={
            "enum": ENUM,
            "member": ENUM,
        },
        fixes={
            "enum": msg("Write .value behind the member of {type}."),
            "member": msg("Write {written} instead of {name}."),
        },
        raised={
            r"unsupported operand type\(s\) for \+=?: '(?P<first>\w{1,60})' and '(?P<second>\w{1,60})'"
            r"|can only concatenate str \(not \"(?P<given>\w{1,60})\"\)": on_line(_object_added)
        },
        fixed_by=(lines.written,),
        examples=(
            example(
                "object_of_a_class_and_a_number",
                Replace(
                    NODE,
                    "class MyFirstNode",
                    "class Ticks:\n    def __str__(self):\n        return '0'\n\n\nclass MyFirstNode",
                ),
                Replace(NODE, "self.counter_ = 0", "self.counter_ = Ticks()"),
                fails="run.output",
                blocks=("run.interrupt",),
            ),
            example(
                "member_of_an_enum_added",
                Replace(NODE, "import rclpy\n", "from enum import Enum\n\nimport rclpy\n"),
                Replace(
                    NODE,
                    "class MyFirstNode",
                    "class Words(Enum):\n    HELLO = 'Hello time: '\n\n\nclass MyFirstNode",
                ),
                Replace(NODE, "'Hello time: ' +", "Words.HELLO +"),
                fails="run.output",
                blocks=DEAD,
            ),
        ),
    ),
    _node(
        "mutable_default",
        "class",
        msg("A field of a dataclass has a list, a dict or a set as its default value"),
        msg(
            "All objects of {type} would have the same list, dict or set. So a dataclass does not allow such "
            "a default value: a field needs a function that makes a new one for each object."
        ),
        msg(
            "Write {written} instead of {name}, and from dataclasses import field among the imports."
        ),
        raised={r"ValueError: mutable default <class '(?P<type>list|dict|set)'> for": _mutable},
        examples=(
            example(
                "list_as_default_of_a_dataclass",
                Replace(
                    NODE, "import rclpy\n", "from dataclasses import dataclass\n\nimport rclpy\n"
                ),
                Replace(
                    NODE,
                    "class MyFirstNode",
                    "@dataclass\nclass State:\n    values: list = []\n\n\nclass MyFirstNode",
                ),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "pop_from_the_end",
        "counter",
        msg("pop() takes the last item"),
        msg(
            "pop() without an index takes the last item of a list, so the numbers come from its end."
        ),
        msg("Write {written} instead of {name}: it takes the first item."),
        links.PYTHON_ERRORS,
        behind=dict.fromkeys(("run.wrong_start", "run.wrong_step"), _from_the_end),
        fixed_by=(lines.written,),
        examples=(
            example(
                "numbers_from_the_end_of_a_list",
                Replace(NODE, "self.counter_ = 0", "self.counter_ = list(range(1000))"),
                Replace(NODE, "str(self.counter_)", "str(self.counter_.pop())"),
                Replace(NODE, STEP_LINE, ""),
                fails="run.output",
            ),
        ),
    ),
    _node(
        "starts_as_truth_value",
        "counter",
        msg("The counter starts as True or False"),
        msg(
            "A text shows {name} as this word. With += it becomes a number only after the first line."
        ),
        msg("Write {written} instead of {name} on this line."),
        links.PYTHON_ERRORS,
        behind={"run.wrong_text": _truth_value},
        fixed_by=(lines.written,),
        examples=(
            example(
                "counter_starts_as_false",
                Replace(NODE, "self.counter_ = 0", "self.counter_ = False"),
                fails="run.output",
            ),
        ),
    ),
    _node(
        "sum_not_returned",
        "counter",
        msg("A method that Python calls for + or += returns nothing"),
        msg(
            "What stands in front of += gets the value that {name} of the class {type} returns. Without "
            "a return, this is None."
        ),
        msg("Write return self as the last line of {name}."),
        behind={"run.wrong_text": _sum_lost},
        examples=(
            example(
                "iadd_without_return",
                Replace(NODE, "class MyFirstNode", COUNTER_CLASS),
                Replace(NODE, "self.counter_ = 0", "self.counter_ = Ticks()"),
                fails="run.output",
                blocks=("run.period", "run.interrupt"),
            ),
        ),
    ),
    _node(
        "post_init_name",
        "class",
        msg("The method that sets a field of a dataclass has another name"),
        msg(
            "A dataclass has an __init__ that Python writes, and at its end only a method with the name "
            "{written} is called. This method sets {attribute}, and nothing called it when the object of the class {type} was made."
        ),
        msg("Write {written} instead of {name}."),
        raised={OWN_ATTRIBUTE: _post_init},
        fixed_by=(lines.written,),
        examples=(
            example(
                "post_init_without_underscore",
                Replace(
                    NODE,
                    "import rclpy\n",
                    "from dataclasses import dataclass, field\n\nimport rclpy\n",
                ),
                Replace(NODE, "class MyFirstNode", STATE),
                Replace(NODE, "self.counter_ = 0", "self.state_ = State()"),
                Replace(NODE, LOG, "self.get_logger().info(f'Hello time: {self.state_.count}')"),
                Replace(NODE, "self.counter_ += 1", "self.state_.count += 1"),
                fails="run.output",
                blocks=DEAD,
            ),
        ),
    ),
)
