"""Mistakes in the head of a method: self in the wrong place, what `with` calls, a decorator."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.base.nearest import nearest
from grader.mistakes import links
from grader.mistakes.constructor import lines_of
from grader.mistakes.example import BODY_OF_MAIN, DEAD, NODE, example
from grader.mistakes.fixes import lines
from grader.mistakes.fixes.case import Case
from grader.mistakes.kind import Family
from grader.mistakes.recognised import Raised, RecognisedMistake, Suspect, on_line
from grader.package.edit.files import Files
from grader.package.edit.tree import Replace
from grader.package.source.module import Function, Module
from grader.package.source.names import dotted, last_part
from grader.package.source.node import NodeSource
from grader.package.source.place import function_at, statement_at

ENTER, EXIT = "__enter__", "__exit__"
VALUES = ("kind", "value", "trace")
"""The names for what `with` gives to __exit__."""
STATIC = ("staticmethod", "classmethod")
PROPERTY = ("property", "cached_property")
HEAD = re.compile(r"def\s+(?P<name>\w+)\s*\((?P<given>[^()\[\]]*)\)")
NOT_FOR_WITH = r"'(?P<type>\w{1,120})' object does not support the context manager protocol"
WITH_CALLS = (
    r"TypeError: (?:\w{1,120}\.)?(?P<name>__enter__|__exit__)\(\) "
    r"(?:takes|missing) .{1,60} positional argument"
)

RUNNER = """\
class Runner:

    def __init__(self, node):
        self.node = node

    def __enter__(self):
        return self.node

    def __exit__(self, kind, value, trace):
        self.node.destroy_node()
        rclpy.try_shutdown()
        return kind is KeyboardInterrupt


"""
WITH_RUNNER = (
    Replace(NODE, "def main(", f"{RUNNER}def main("),
    Replace(
        NODE,
        BODY_OF_MAIN,
        "    rclpy.init(args=args)\n    with Runner(MyFirstNode()) as node:\n"
        "        rclpy.spin(node)\n",
    ),
)


def _methods(source: NodeSource, owner: str = "") -> Iterator[Function]:
    """Yield the methods of the classes in the files, or of one class."""
    for module in source.modules:
        for found in module.classes:
            if not owner or found.name == owner:
                yield from (s for s in found.body if isinstance(s, Function))


def _decorators(method: Function) -> list[str]:
    return [dotted(d) for d in method.decorator_list]


def _head(module: Module, method: Function) -> re.Match[str] | None:
    """Return the head of a def that is on one line."""
    return HEAD.search(module.line(method.lineno))


# self in the wrong place


def _self_second(source: NodeSource) -> list[Function]:
    """Return the methods that have self, and not as their first parameter."""
    found = []
    for method in _methods(source):
        names = [a.arg for a in (*method.args.posonlyargs, *method.args.args)]
        static = set(_decorators(method)) & set(STATIC)
        if "self" in names[1:] and not static:
            found.append(method)
    return found


def _written_with_self(
    source: NodeSource, method: Function
) -> tuple[dict[str, str], dict[str, str]] | None:
    """Return the change of the head, and the words of the texts."""
    module = source.module_of(method)
    match = _head(module, method)
    if match is None:
        return None
    parts = [part.strip() for part in match["given"].split(",")]
    given = ", ".join(["self", *(part for part in parts if part != "self")])
    old, new = f"{method.name}({match['given']})", f"{method.name}({given})"
    row = module.line(method.lineno)
    if row.count(old) != 1:
        return None
    first = method.args.args[0].arg if method.args.args else parts[0]
    words = {"method": method.name, "parameter": first, "head": row.replace(old, new).strip()}
    return {"name": old, "written": new}, words


def _raised_second(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The line is in such a method, or calls it."""
    del match
    here = function_at(raised.module, raised.line)
    statement = statement_at(raised.module, raised.line)
    called = [last_part(dotted(n.func)) for n in _calls(statement)]
    for method in _self_second(raised.source):
        change = _written_with_self(raised.source, method)
        if change is not None and (method is here or method.name in called):
            found = raised.finding("self_second", at=method, params=change[0])
            return replace(found, words={**found.words, **change[1]})
    return None


def _seen_second(suspect: Suspect) -> RecognisedMistake | None:
    """The text shows an object of the class: the method writes its first parameter into it."""
    shown = re.findall(r"(\w{1,100}) object(?: [\w.<>]{1,100})? at 0x", suspect.text)
    found = [m for name in shown for m in _methods(suspect.source, name)]
    for method in _self_second(suspect.source):
        change = _written_with_self(suspect.source, method) if method in found else None
        if change is not None:
            mistake = suspect.finding("self_second", method, **change[0])
            return replace(mistake, words={**mistake.words, **change[1]})
    return None


def _calls(statement: ast.stmt | None) -> list[ast.Call]:
    parts = ast.walk(statement) if statement is not None else ()
    return [n for n in parts if isinstance(n, ast.Call)]


# what with calls


def _misspelt(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The class has the methods that with calls, one of them under another name."""
    methods = {m.name: m for m in _methods(raised.source, match["type"])}
    for wanted in (ENTER, EXIT):
        others = [name for name in methods if name not in (ENTER, EXIT)]
        bare = [name for name in others if name.replace("_", "").lower() == wanted.strip("_")]
        close = bare[0] if len(bare) == 1 else nearest(wanted, others, cutoff=0.8)
        if wanted in methods or not close:
            continue
        params = {"name": close, "written": wanted}
        found = raised.finding("with_method", at=methods[close], params=params)
        return replace(found, words={**found.words, "type": match["type"]})
    lacks = [name for name in (ENTER, EXIT) if name not in methods]
    classes = [c for m in raised.source.modules for c in m.classes if c.name == match["type"]]
    if len(lacks) != 1 or len(classes) != 1 or classes[0].bases:
        return None
    found = raised.finding("with_method", name=lacks[0])
    return replace(found, words={**found.words, "type": match["type"]}, variant="missing")


def _takes(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """A def of __enter__ or __exit__ cannot take what with passes."""
    name = match["name"]
    statement = statement_at(raised.module, raised.line)
    if not isinstance(statement, ast.With) or any(c for c in _called(statement, name)):
        return None
    made = [m for m in _methods(raised.source) if m.name == name]
    module = raised.source.module_of(made[0]) if len(made) == 1 else None
    head = _head(module, made[0]) if module is not None else None
    if module is None or head is None or made[0].decorator_list:
        return None
    given = [a.arg for a in made[0].args.args if a.arg != "self"]
    if name == EXIT:
        given += [value for value in VALUES if value not in given][: max(3 - len(given), 0)]
    if len(given) != (3 if name == EXIT else 0):
        return None
    old, new = f"{name}({head['given']})", f"{name}({', '.join(['self', *given])})"
    row = module.line(made[0].lineno)
    if row.count(old) != 1 or old == new:
        return None
    found = raised.finding("with_method", at=made[0], params={"name": old, "written": new})
    words = {**found.words, "head": row.replace(old, new).strip(), "line": str(raised.line)}
    return replace(found, words=words, variant="exit" if name == EXIT else "enter")


def _called(statement: ast.With, name: str) -> Iterator[ast.Call]:
    """Yield the calls of a method in the lines of a with."""
    yield from (c for c in _calls(statement) if last_part(dotted(c.func)) == name)


def _gives_nothing(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The name behind as is None, because __enter__ returns nothing."""
    statement = statement_at(raised.module, raised.line)
    parts = list(ast.walk(statement)) if statement is not None else []
    used = [n.value for n in parts if isinstance(n, ast.Attribute) and n.attr == match["name"]]
    if raised.inside:
        used = [n.args[0] for n in _calls(statement) if len(n.args) == 1]
    name = dotted(used[0]) if len(used) == 1 else ""
    around = list(raised.module.around(used[0])) if name else []
    for block in around:
        items = block.items if isinstance(block, ast.With) else []
        for item in items:
            made = item.context_expr
            if item.optional_vars is None or dotted(item.optional_vars) != name:
                continue
            owner = last_part(dotted(made.func)) if isinstance(made, ast.Call) else ""
            enters = [m for m in _methods(raised.source, owner) if owner and m.name == ENTER]
            if len(enters) == 1 and not _returns(enters[0]):
                found = raised.finding("with_method", at=enters[0], name=name)
                own = owner in raised.source.class_names
                return replace(found, variant="nothing_self" if own else "nothing")
    return None


def _returns(method: Function) -> bool:
    parts = list(ast.walk(method))
    yields = any(isinstance(n, ast.Yield | ast.YieldFrom) for n in parts)
    return yields or any(isinstance(n, ast.Return) and n.value is not None for n in parts)


# a decorator that makes a value of a method


def _decorated(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The line calls a method of the student's that a decorator has made a property."""
    del match
    statement = statement_at(raised.module, raised.line)
    for call in _calls(statement):
        if not isinstance(call.func, ast.Attribute) or raised.line not in lines_of(call):
            continue
        name = call.func.attr
        made = [m for m in _methods(raised.source) if m.name == name]
        of_property = made[0].decorator_list if len(made) == 1 else []
        code = raised.module.text.code(call.func)
        if len(of_property) != 1 or "\n" in code:
            continue
        decorator, method = of_property[0], made[0]
        written = dotted(decorator)
        others = method.args.args[1:] or call.args or call.keywords
        if last_part(written) in ("setter", "deleter", "getter") and "." in written:
            found = raised.finding("made_property", at=decorator, method=name, name=f"@{written}")
            return replace(found, variant="setter")
        if written not in PROPERTY:
            continue
        if others or not _returns(method):
            found = raised.finding("made_property", at=decorator, method=name, name=f"@{written}")
            return replace(found, variant="placed")
        params = {"name": raised.module.text.code(call), "written": code, "method": name}
        return raised.finding("made_property", at=call, params=params)
    return None


def _without_decorator(case: Case) -> Files | None:
    """Delete the line of a decorator of a property with another name."""
    module, line = case.module, case.finding.line
    name = str(case.finding.params.get("name", ""))
    if module is None or not line or module.line(line).strip() != name or "." not in name:
        return None
    return case.changed(module, module.text.without(line))


NO_RETURN = msg(
    "The name behind as gets what __enter__ returns. This __enter__ has no return with a value, so "
    "{name} is None."
)
_node = Family("node", links.PYTHON_CLASSES)
KINDS = (
    _node(
        "self_second",
        "callback",
        msg("self is not the first parameter of a method"),
        msg(
            "Python gives the object to the first parameter of a method, whatever its name is. In the "
            "def of {method} that is {parameter}, and self gets another value."
        ),
        msg("Write self as the first parameter: {head}"),
        raised={
            r"AttributeError: '\w{1,120}' object has no attribute": on_line(_raised_second),
            r"(?:Type|Value|Name)Error: ": on_line(_raised_second),
        },
        behind={"run.wrong_text": _seen_second},
        fixed_by=(lines.written,),
        examples=(
            example(
                "self_behind_the_number",
                Replace(
                    NODE,
                    "    def timer_callback",
                    "    def words_of(number, self):\n        return 'Hello time: ' + str(number)\n\n"
                    "    def timer_callback",
                ),
                Replace(
                    NODE, "'Hello time: ' + str(self.counter_)", "self.words_of(self.counter_)"
                ),
                fails="run.output",
            ),
            example(
                "self_behind_a_used_number",
                Replace(
                    NODE,
                    "    def timer_callback",
                    "    def add_up(step, self):\n        self.counter_ += step\n\n"
                    "    def timer_callback",
                ),
                Replace(NODE, "self.counter_ += 1", "self.add_up(1)"),
                fails="run.output",
                blocks=("run.interrupt",),
            ),
        ),
    ),
    _node(
        "with_method",
        "spin",
        msg("A method is not written as with calls it"),
        msg(
            "with calls the methods __enter__ and __exit__ of its object. The class {type} has {name}, "
            "and Python calls no method of this name."
        ),
        msg("Write {written} instead of {name}."),
        whys={
            "missing": msg(
                "with calls the methods __enter__ and __exit__ of its object. The class {type} has no "
                "{name}."
            ),
            "exit": msg(
                "At the end of its block, with (line {line}) calls __exit__ with three values, which "
                "describe the error of the block. The def in this line cannot take them."
            ),
            "enter": msg(
                "At the start of its block, with (line {line}) calls __enter__, and Python passes the "
                "object. The def in this line does not fit that."
            ),
            **dict.fromkeys(("nothing", "nothing_self"), NO_RETURN),
        },
        fixes={
            "missing": msg(
                "Write a method {name} in the class {type}. If nothing is to be done there, its block "
                "is pass."
            ),
            "exit": msg("Write: {head}"),
            "enter": msg("Write: {head}"),
            "nothing": msg(
                "Write, as the last line of __enter__, return and the object that {name} is to be in "
                "the block of the with."
            ),
            "nothing_self": msg("Write, as the last line of __enter__: return self"),
        },
        raised={
            NOT_FOR_WITH: on_line(_misspelt),
            WITH_CALLS: on_line(_takes),
            r"AttributeError: 'NoneType' object has no attribute '(?P<name>\w{1,120})'": (
                _gives_nothing
            ),
        },
        fixed_by=(lines.written,),
        examples=(
            example(
                "enter_of_with_misspelt",
                *WITH_RUNNER,
                Replace(NODE, "def __enter__(self)", "def __enter_(self)"),
                fails="run.starts",
            ),
            example(
                "exit_of_with_without_values",
                *WITH_RUNNER,
                Replace(NODE, "__exit__(self, kind, value, trace)", "__exit__(self)"),
                fails="run.interrupt",
            ),
            example(
                "enter_of_the_node_returns_nothing",
                Replace(
                    NODE,
                    "    def timer_callback",
                    "    def __enter__(self):\n        self.counter_ = 0\n\n"
                    "    def __exit__(self, *error):\n        return error[0] is KeyboardInterrupt\n\n"
                    "    def timer_callback",
                ),
                Replace(
                    NODE,
                    BODY_OF_MAIN,
                    "    rclpy.init(args=args)\n    with MyFirstNode() as node:\n        rclpy.spin(node)\n",
                ),
                fails="run.starts",
            ),
            example(
                "enter_of_with_returns_nothing",
                *WITH_RUNNER,
                Replace(NODE, "        return self.node\n", "        self.node.counter_ = 0\n"),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "made_property",
        "callback",
        msg("A decorator makes a method a value"),
        msg("@property makes {method} a value, which is read without ()."),
        msg("Write {written} instead of {name}."),
        whys={
            "setter": msg(
                "{name} is for a def that sets the property, and makes {method} a property too. A "
                "property is read without (), so {method} cannot be called."
            ),
            "placed": msg(
                "{name} makes {method} a value, which is read without (). This def is written to be "
                "called: it takes a value, or returns none."
            ),
        },
        fixes={
            "setter": msg("Delete the line {name} above the def of {method}."),
            "placed": msg(
                "Delete the line {name} above the def of {method}. If it belongs to another def, write "
                "it on the line above that def."
            ),
        },
        raised={r"TypeError: '\w{1,120}' object is not callable": on_line(_decorated)},
        fixed_by=(_without_decorator, lines.written),
        deletes=("setter", "placed"),
        examples=(
            example(
                "property_called_with_brackets",
                Replace(NODE, "'Hello time: ' + str(self.counter_)", "self.label()"),
                Replace(
                    NODE,
                    "    def timer_callback",
                    "    @property\n    def label(self):\n"
                    "        return 'Hello time: ' + str(self.counter_)\n\n    def timer_callback",
                ),
                fails="run.output",
                blocks=DEAD,
            ),
            example(
                "setter_above_another_method",
                Replace(NODE, "        self.counter_ += 1\n\n\n", "        self.count_on()\n\n\n"),
                Replace(NODE, "'Hello time: ' + str(self.counter_)", "self.label"),
                Replace(
                    NODE,
                    "    def timer_callback",
                    "    @property\n    def label(self):\n"
                    "        return 'Hello time: ' + str(self.counter_)\n\n    @label.setter\n"
                    "    def count_on(self):\n        self.counter_ += 1\n\n    def timer_callback",
                ),
                fails="run.output",
                blocks=("run.interrupt",),
            ),
        ),
    ),
)
