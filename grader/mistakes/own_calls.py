"""Mistakes in which a call does not fit the student's own function or class that it calls."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from dataclasses import dataclass, replace

from grader.base.i18n.message import msg
from grader.base.nearest import nearest
from grader.mistakes import links
from grader.mistakes.constructor import lines_of
from grader.mistakes.example import DATACLASS_IMPORTED, DEAD, LOG, NODE, STEP_LINE, example
from grader.mistakes.fixes import lines
from grader.mistakes.kind import Family
from grader.mistakes.recognised import Raised, RecognisedMistake, on_line
from grader.package.edit.tree import Replace
from grader.package.source.module import Function
from grader.package.source.names import calls_in, dotted, last_part

FUNCTION = r"TypeError: (?P<function>[\w.]{1,200})\(\) "
MISSING = (
    FUNCTION + r"missing \d{1,3} required (?:positional|keyword-only) arguments?: (?P<names>'.+)"
)
UNKNOWN = FUNCTION + r"got an unexpected keyword argument '(?P<name>\w{1,120})'"
TWICE = FUNCTION + r"got multiple values for argument '(?P<name>\w{1,120})'"
MANY = FUNCTION + r"takes (?:from \d{1,3} to )?\d{1,3} positional arguments? but (?P<given>\d{1,3})"
ANY = FUNCTION + r"(?:missing|got|takes) "
DATACLASS = ("dataclass", "dataclasses.dataclass")


@dataclass(frozen=True)
class _Called:
    """A call on the line, and the definition that it does not fit: a def or a dataclass."""

    call: ast.Call
    made: Function | ast.ClassDef

    @property
    def parameters(self) -> list[str]:
        """The names to which a call can give values."""
        if isinstance(self.made, ast.ClassDef):
            return [dotted(s.target) for s in self.made.body if isinstance(s, ast.AnnAssign)]
        given = self.made.args
        return [
            a.arg for a in (*given.posonlyargs, *given.args, *given.kwonlyargs) if a.arg != "self"
        ]


def _definitions(raised: Raised, function: str) -> list[Function]:
    """Return the plain defs of a function of the student's, as an error names it."""
    owner, _, name = function.rpartition(".")
    bodies = [
        c.body
        for module in raised.source.known_modules
        for c in (module.classes if owner else [])
        if c.name == last_part(owner)
    ] or [raised.module.tree.body if not owner else []]
    found = [s for s in bodies[0] if isinstance(s, Function) and s.name == name]
    return [] if len(bodies) > 1 or any(s.decorator_list for s in found) else found


def _calls(raised: Raised, function: str) -> Iterator[ast.Call]:
    """Yield the calls on the line that can be of a function: by its name, or that of its class."""
    owner, _, name = function.rpartition(".")
    names = {name, last_part(owner)} if name == "__init__" else {name}
    for call, called in raised.source.calls:
        here = raised.source.module_of(call) is raised.module and raised.line in lines_of(call)
        if here and last_part(called) in names:
            yield call


def _called(raised: Raised, function: str) -> _Called | None:
    calls, defs = list(_calls(raised, function)), _definitions(raised, function)
    if len(calls) != 1:
        return None
    if defs:
        return _Called(calls[0], defs[-1])
    owner, _, name = function.rpartition(".")
    classes = [c for m in raised.source.modules for c in m.classes if c.name == last_part(owner)]
    if name != "__init__" or defs or len(classes) != 1:
        return None
    decorators = [
        dotted(d.func if isinstance(d, ast.Call) else d) for d in classes[0].decorator_list
    ]
    plain = len(decorators) == 1 and decorators[0] in DATACLASS and not classes[0].bases
    return _Called(calls[0], classes[0]) if plain else None


def _told(raised: Raised, found: _Called, variant: str, **params: str) -> RecognisedMistake:
    called = raised.module.text.code(found.call.func)
    given = {"called": f"{called}()", "line": str(found.made.lineno), **params}
    where = raised.source.module_of(found.made)
    if where is not raised.module:
        given["line"] = f"{found.made.lineno} ({where.path})"
    return replace(raised.finding("own_call", at=found.call, params=given), variant=variant)


def _missing(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The call gives no value to several parameters, or to one of a helper."""
    names = re.findall(r"'(\w{1,120})'", match["names"])
    found = _called(raised, match["function"])
    if found is not None and names == ["self"]:
        return _class_alone(raised, found, match["function"])
    if found is None or "self" in names or _is_of_class(found, match["function"]):
        return None
    of_class = _class_for_object(raised, found, match["function"])
    if of_class is not None:
        return of_class
    alone = len(names) == 1 and "positional" in match[0]
    owner, method = match["function"].rpartition(".")[::2]
    own = raised.source.method(method) is not None or owner in raised.source.known_classes
    node = raised.source.node_class
    if alone and own and node is not None and owner == node.name:
        return None  # (the value is looked for elsewhere)
    return _told(raised, found, "several" if len(names) > 1 else "", name=", ".join(names))


def _is_of_class(found: _Called, function: str) -> bool:
    """Whether a method is called on its class, without self: what is missing is that."""
    made = found.made.args.args[:1] if isinstance(found.made, Function) else []
    given = [dotted(value) for value in found.call.args[:1]]
    of_class = bool(made) and made[0].arg == "self" and "." in function
    return of_class and dotted(found.call.func) == function and given != ["self"]


def _class_for_object(raised: Raised, found: _Called, function: str) -> RecognisedMistake | None:
    """The call fits, but what it is called on is the class: the first value went to self."""
    made, call, owner = found.made, found.call, last_part(function.rpartition(".")[0])
    own = (
        isinstance(made, Function) and bool(made.args.args) and isinstance(call.func, ast.Attribute)
    )
    if not own or not owner or isinstance(made, ast.ClassDef) or made.name == "__init__":
        return None
    given = [*call.args, *(k.value for k in call.keywords)]
    starred = any(isinstance(a, ast.Starred) for a in call.args) or any(
        k.arg is None for k in call.keywords
    )
    needed = len(made.args.args) - 1 - len(made.args.defaults)
    if starred or not call.args or not needed <= len(given) < len(made.args.args):
        return None
    bare = [
        n for n in raised.source.all_nodes if isinstance(n, ast.Name) and _is_bare(raised, n, owner)
    ]
    name = raised.module.text.code(getattr(call.func, "value", call.func))
    words = {"name": name, "type": owner}
    if len(bare) != 1 or not _needs_nothing(raised, owner):
        return _told(raised, found, "of_class", **words)
    params = {"name": owner, "written": f"{owner}()", "called": f"{name}.{made.name}()"}
    line = str(raised.line)
    told = raised.finding("own_call", at=bare[0], params={**params, "line": line, "type": owner})
    return replace(told, variant="class_given")


def _class_alone(raised: Raised, found: _Called, function: str) -> RecognisedMistake | None:
    """A method is called on the class with no value, and the class stands at one place as a value."""
    owner, call = last_part(function.rpartition(".")[0]), found.call
    named = call.func.value if isinstance(call.func, ast.Attribute) else None
    bare = [
        n for n in raised.source.all_nodes if isinstance(n, ast.Name) and _is_bare(raised, n, owner)
    ]
    if named is None or dotted(named) == owner or len(bare) != 1 or call.args or call.keywords:
        return None
    if not _needs_nothing(raised, owner):
        return None
    called = f"{raised.module.text.code(call.func)}()"
    params = {"name": owner, "written": f"{owner}()", "called": called, "line": str(raised.line)}
    return replace(raised.finding("own_call", at=bare[0], params=params), variant="class_alone")


def _is_bare(raised: Raised, node: ast.Name, owner: str) -> bool:
    """Whether a name is that of the class, and stands as a value: of a call, or of a variable."""
    if node.id != owner:
        return False
    around = raised.source.module_of(node).parents.get(node)
    if isinstance(around, ast.Call):
        return node in around.args and dotted(around.func) not in ("isinstance", "issubclass")
    return isinstance(around, ast.Assign | ast.keyword) and around.value is node


def _needs_nothing(raised: Raised, owner: str) -> bool:
    """Whether an object of a class can be made with nothing in the ()."""
    classes = [c for m in raised.source.modules for c in m.classes if c.name == owner]
    heads = [s for s in classes[0].body if isinstance(s, Function) and s.name == "__init__"]
    if len(classes) != 1:
        return False
    if classes[0].decorator_list:
        fields = [n for n in classes[0].body if isinstance(n, ast.AnnAssign)]
        known = [dotted(d) in DATACLASS for d in classes[0].decorator_list] == [True]
        return known and not classes[0].bases and all(n.value is not None for n in fields)
    given = heads[0].args if heads else None
    return given is None or len(given.args) - 1 <= len(given.defaults)


def _unknown(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    found = _called(raised, match["function"])
    if found is None or not found.parameters:
        return None
    known = found.parameters
    untyped = _without_type(raised, found, match["name"])
    if untyped is not None:
        return untyped
    near = nearest(match["name"], dict.fromkeys(known))
    if near and all(keyword.arg != near for keyword in found.call.keywords):
        words = {"name": f"{match['name']}=", "written": f"{near}="}
        return _told(raised, found, "near", **words)
    return _told(raised, found, "unknown", name=match["name"], names=", ".join(known))


def _without_type(raised: Raised, found: _Called, name: str) -> RecognisedMistake | None:
    """A dataclass has the name with a value, but without a type: it is no parameter then."""
    if not isinstance(found.made, ast.ClassDef):
        return None
    module = raised.source.module_of(found.made)
    plain = [s for s in found.made.body if isinstance(s, ast.Assign) and len(s.targets) == 1]
    values = [(dotted(s.targets[0]), s.value, s.lineno) for s in plain]
    if name not in [target for target, *_ in values]:
        return None
    given = {keyword.arg for keyword in found.call.keywords}
    wanted = [(n, v, at) for n, v, at in values if n in given and isinstance(v, ast.Constant)]
    rows = [f"{n}: {type(v.value).__name__} = {module.text.code(v)}" for n, v, _ in wanted
            if isinstance(v, ast.Constant)]  # fmt: skip
    if name not in [n for n, *_ in wanted]:
        return None
    lines = ", ".join(str(at) for *_, at in wanted)
    return _told(raised, found, "untyped", name=name, names=" / ".join(rows), lines=lines)


def _twice(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    found = _called(raised, match["function"])
    if found is None:
        return None
    return _told(raised, found, "twice", name=match["name"], names=", ".join(found.parameters))


def _many(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The call gives more values than a function, or than a def with defaults, takes."""
    if "." in match["function"] and "takes from" not in match[0]:
        return None
    found = _called(raised, match["function"])
    if found is None or not found.parameters:
        return None
    return _told(raised, found, "many", names=", ".join(found.parameters))


def _several_defs(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """An earlier def of the same name would take what the call gives."""
    defs = _definitions(raised, match["function"])
    calls = list(_calls(raised, match["function"]))
    if len(defs) < 2 or len(calls) != 1:
        return None
    own = "." in match["function"]
    first = next((d for d in defs[:-1] if _takes(d, calls[0], own=own)), None)
    if first is None:
        return None
    last = defs[-1]
    params = {
        "name": last.name,
        "line": str(first.lineno),
        "called": f"{raised.module.text.code(calls[0].func)}()",
        "at": str(calls[0].lineno),
    }
    head = _with_defaults(raised, first, last)
    if head:
        params["written"] = head
    if len(calls[0].args) + own > len(last.args.args):
        return _first_is_meant(raised, first, last, params)
    found = raised.finding("last_def_counts", at=last, params=params)
    return replace(found, variant="defaults" if head else "")


def _first_is_meant(
    raised: Raised, first: Function, last: Function, params: dict[str, str]
) -> RecognisedMistake:
    """The last def takes less than the call gives: if it only calls the first, it gives defaults."""
    head = _with_defaults(raised, last, first)
    if head:
        params = {**params, "written": head}
    found = raised.finding("last_def_counts", at=last, params=params)
    return replace(found, variant="first_defaults" if head else "first")


def _takes(made: Function, call: ast.Call, *, own: bool) -> bool:
    """Whether a def takes the values of a call, which has no * and no names."""
    given = made.args
    count = len(call.args) + own
    plain = not call.keywords and not any(isinstance(a, ast.Starred) for a in call.args)
    least = len(given.args) - len(given.defaults)
    return plain and not given.vararg and least <= count <= len(given.args)


def _with_defaults(raised: Raised, first: Function, last: Function) -> str:
    """Return the head of the last def with the values that the first def calls it with."""
    module = raised.source.module_of(last)
    wanted = [a.arg for a in last.args.args]
    own = wanted[:1] == ["self"]
    calls = [c for c, name in calls_in(first) if name in (f"self.{last.name}", last.name)]
    if len(calls) != 1 or calls[0].keywords or last.args.defaults or last.args.kwonlyargs:
        return ""
    values = calls[0].args
    if len(values) != len(wanted) - own or not all(isinstance(v, ast.Constant) for v in values):
        return ""
    pairs = [f"{name}={module.text.code(v)}" for name, v in zip(wanted[own:], values)]
    return f"def {last.name}({', '.join([*wanted[:own], *pairs])}):"


_node = Family("node", links.PYTHON_CLASSES)
ONE_DEF = "def make(prefix):\n    return prefix + '0'\n\n\n"
KINDS = (
    _node(
        "last_def_counts",
        "class",
        msg("Several defs have the same name"),
        msg(
            "There is only one function of a name in the same place: the last def {name} replaces the one in line {line}. "
            "The call of {called} in line {at} fits only that earlier def."
        ),
        msg(
            "Keep one def {name}: in this line, give the parameters that the call leaves out a default "
            "(name=value). Move what you still need from the block of the def in line {line} into it, and "
            "delete that def."
        ),
        fixes={
            "defaults": msg(
                "Write {written} instead of this line, and delete the def in line {line} with its block."
            ),
            "first": msg(
                "Keep the def in line {line}. Delete the def in this line with its block."
            ),
            "first_defaults": msg(
                "Write {written} in line {line}, and delete the def in this line with its block."
            ),
        },
        raised={ANY: on_line(_several_defs)},
        examples=(
            example(
                "two_constructors",
                Replace(
                    NODE,
                    "    def __init__(self):\n",
                    "    def __init__(self):\n        self.__init__('my_first_node', 1.0)\n\n"
                    "    def __init__(self, name, period):\n",
                ),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "own_call",
        "callback",
        msg("A call does not fit the definition of what it calls"),
        msg(
            "A parameter without a default needs a value in each call. {called} is defined in line {line}."
        ),
        msg(
            "Write a value for {name} in the () of {called} on this line. Or give {name} a default in the "
            "definition: name=value."
        ),
        whys={
            "of_class": msg(
                "{name} is the class {type} itself here, and not an object of it. So Python passes no self, "
                "and the first value of the call goes to self."
            ),
            "class_alone": msg(
                "{name} without () is the class itself, and not an object of it. So {called} in line {line} "
                "passes no self."
            ),
            "class_given": msg(
                "{name} without () is the class itself, and not an object of it. So {called} in line {line} "
                "passes no self, and its first value goes to self."
            ),
            "near": msg(
                "name=value in a call works only for the names in the definition (line {line})."
            ),
            "unknown": msg(
                "name=value in a call works only for the names in the definition (line {line}): {names}"
            ),
            "untyped": msg(
                "A dataclass (line {line}) takes only values for names with a type: name: type = value. "
                "{name} has no type there."
            ),
            "twice": msg(
                "Values without a name go to the parameters in their order (line {line}): {names}. So "
                "{name} gets two values in this call: one by its place, and one by {name}=."
            ),
            "many": msg(
                "The definition in line {line} has fewer parameters than this call gives values. It has: "
                "{names}"
            ),
        },
        fixes={
            "several": msg(
                "Write a value for each of these in the () of {called} on this line: {name}. Or give them "
                "defaults in the definition: name=value."
            ),
            "of_class": msg(
                "Find where {name} gets its value. Create an object there: write () behind the name of the "
                "class, with the values that its __init__ needs."
            ),
            "class_alone": msg("Write {written} instead of {name}: the () create an object."),
            "class_given": msg("Write {written} instead of {name}: the () create an object."),
            "near": msg("Write {written} instead of {name} on this line."),
            "unknown": msg(
                "Write one of these names instead of {name} on this line. Or add {name} to the definition."
            ),
            "untyped": msg("Write in the class (lines: {lines}), with the types: {names}"),
            "twice": msg(
                "Delete one of the two values. If the value without a name is meant for another "
                "parameter, write the name of that one and = before it."
            ),
            "many": msg(
                "Remove what is too much from the () of {called} on this line. Or add a parameter for each "
                "value to the definition, and use it there."
            ),
        },
        raised={
            MISSING: on_line(_missing),
            UNKNOWN: on_line(_unknown),
            TWICE: on_line(_twice),
            MANY: on_line(_many),
        },
        fixed_by=(lines.written,),
        examples=(
            example(
                "class_of_a_helper_has_no_self",
                Replace(
                    NODE,
                    "class MyFirstNode",
                    "class Ticks:\n    def __init__(self):\n        self.n = -1\n\n"
                    "    def forward(self):\n        self.n += 1\n        return self.n\n\n\n"
                    "class MyFirstNode",
                ),
                Replace(NODE, "self.counter_ = 0", "self.counter_ = Ticks"),
                Replace(NODE, "str(self.counter_)", "str(self.counter_.forward())"),
                Replace(NODE, STEP_LINE, ""),
                fails="run.output",
                blocks=DEAD,
            ),
            example(
                "class_of_a_helper_for_its_object",
                Replace(
                    NODE,
                    "class MyFirstNode",
                    "class Wording:\n    def line(self, number):\n"
                    "        return f'Hello time: {number}'\n\n\nclass MyFirstNode",
                ),
                Replace(
                    NODE, "self.counter_ = 0\n", "self.counter_ = 0\n        self.words = Wording\n"
                ),
                Replace(
                    NODE, "'Hello time: ' + str(self.counter_)", "self.words.line(self.counter_)"
                ),
                fails="run.output",
                blocks=DEAD,
            ),
            example(
                "dataclass_without_types",
                DATACLASS_IMPORTED,
                Replace(
                    NODE,
                    "class MyFirstNode",
                    "@dataclass\nclass Settings:\n    text: str\n    start = 0\n\n\nclass MyFirstNode",
                ),
                Replace(
                    NODE,
                    "self.counter_ = 0",
                    "self.counter_ = Settings(text='Hello time: ', start=0).start",
                ),
                fails="run.starts",
            ),
            example(
                "constructor_with_three_parameters",
                Replace(NODE, "def __init__(self)", "def __init__(self, name, start)"),
                Replace(NODE, "super().__init__('my_first_node')", "super().__init__(name)"),
                Replace(NODE, "self.counter_ = 0", "self.counter_ = start"),
                fails="run.starts",
            ),
            example(
                "parameter_misspelt_in_a_call",
                Replace(NODE, "def __init__(self)", "def __init__(self, start=0)"),
                Replace(NODE, "self.counter_ = 0", "self.counter_ = start"),
                Replace(NODE, "MyFirstNode()", "MyFirstNode(strat=0)"),
                fails="run.starts",
            ),
            example(
                "helper_gets_too_many_values",
                Replace(NODE, "class MyFirstNode(", f"{ONE_DEF}class MyFirstNode("),
                Replace(NODE, LOG, "self.get_logger().info(make('Hello time: ', 1))"),
                fails="run.output",
                blocks=DEAD,
            ),
        ),
    ),
)
