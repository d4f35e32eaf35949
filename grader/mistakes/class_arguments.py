"""Mistakes in which a class takes no values: a decorator, a base or its __init__ is missing."""

from __future__ import annotations

import ast
import re
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.base.nearest import nearest
from grader.mistakes import links
from grader.mistakes.constructor import lines_of
from grader.mistakes.example import DATACLASS_IMPORTED, NODE, example
from grader.mistakes.fixes import lines
from grader.mistakes.fixes.case import Case
from grader.mistakes.kind import Family
from grader.mistakes.recognised import Raised, RecognisedMistake, on_line
from grader.package.edit.files import Files
from grader.package.edit.text import Splice, indent_of
from grader.package.edit.tree import Replace
from grader.package.source.module import Function, Module
from grader.package.source.names import dotted, last_part

TAKES_NONE = r"TypeError: (?P<name>\w{1,120})\(\) takes no arguments"
NO_MEMBER = (
    r"AttributeError: '(?:int|float|str|bool)' object has no attribute '(?P<name>value|name)'"
)
NOT_GIVEN = r"TypeError: \w{1,120}\.__init__\(\) missing 1 required positional argument: '(?P<name>\w{1,120})'"
CLASS = "    period: float = 1.0\n    start: int = 0\n"
MEMBERS = ("Enum", "IntEnum", "StrEnum")


def _own_class(raised: Raised, name: str) -> tuple[Module, ast.ClassDef] | None:
    """Return the student's only class of a name, if it inherits from nothing."""
    found = [(m, c) for m in raised.source.modules for c in m.classes if c.name == name]
    if len(found) != 1 or any(dotted(base) != "object" for base in found[0][1].bases):
        return None
    return found[0]


def _takes_none(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """Values are given to a class that has no __init__."""
    own = _own_class(raised, match["name"])
    if own is None or own[1].decorator_list or own[1].keywords:
        return None
    module, made = own
    methods = {s.name: s for s in made.body if isinstance(s, Function)}
    if "__init__" in methods or "__new__" in methods:
        return None
    params = {"name": made.name, "line": str(made.lineno)}
    meant = {name: m for name, m in methods.items() if len(m.args.args) > 1}
    plain = next((name for name in meant if name.strip("_") == "init"), "")
    near = plain or nearest("__init__", meant, cutoff=0.7)
    if near:
        found = raised.finding("class_takes_nothing", at=meant[near], method=near, params=params)
        return replace(found, variant="near")
    written = _base_lost(module, made)
    if written:
        found = raised.finding("class_takes_nothing", at=made, params=params, written=written)
        return replace(found, variant="base")
    if not _fits(raised, made):
        return raised.finding("class_takes_nothing", params=params)
    name = _dataclass(module)
    params["written"] = f"@{name or 'dataclass'}"
    found = raised.finding("class_takes_nothing", at=made, params=params)
    return replace(found, variant="dataclass" if name else "import")


def _stars_lost(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """An __init__ passes a parameter on with stars, and its def has the name without them."""
    name = match["name"]
    for module in raised.source.modules:
        for made in (s for c in module.classes for s in c.body if isinstance(s, Function)):
            stars = _passed_with(made, name)
            row = module.line(made.lineno)
            places = list(re.finditer(rf"(?<=[(,\s]){name}(?=\s*[,)])", row))
            if made.name != "__init__" or not stars or len(places) != 1:
                continue
            head = f"{row[: places[0].start()]}{stars}{row[places[0].start() :]}"
            if [a.arg for a in made.args.args][-1:] != [name]:
                continue
            params = {"name": name, "written": f"{stars}{name}"}
            found = raised.finding("stars_lost", at=made, params=params)
            return replace(found, words={**found.words, "head": head.strip()})
    return None


def _passed_with(made: Function, name: str) -> str:
    """Return the stars with which a function passes all that is in a parameter on; "" if none."""
    for node in ast.walk(made):
        if isinstance(node, ast.keyword) and node.arg is None and dotted(node.value) == name:
            return "**"
        if isinstance(node, ast.Starred) and dotted(node.value) == name:
            return "*"
    return ""


def _fields(made: ast.ClassDef) -> list[str]:
    """Return the names with a type in a class: `period: float`."""
    return [dotted(s.target) for s in made.body if isinstance(s, ast.AnnAssign)]


def _fits(raised: Raised, made: ast.ClassDef) -> bool:
    """Whether a dataclass with these fields would take what the line gives."""
    fields = _fields(made)
    for call, name in raised.source.calls:
        if last_part(name) == made.name and raised.line in lines_of(call):
            named = [keyword.arg for keyword in call.keywords]
            return len(call.args) + len(named) <= len(fields) and all(n in fields for n in named)
    return False


def _imported(module: Module, source: str, name: str) -> str:
    """Return the name that a file gives to one of a module; "" if it does not import it."""
    for node in module.nodes:
        if isinstance(node, ast.ImportFrom) and node.module == source:
            for alias in node.names:
                if alias.name == name:
                    return alias.asname or alias.name
        elif isinstance(node, ast.Import):
            for alias in node.names:
                if alias.name == source:
                    return f"{alias.asname or source}.{name}"
    return ""


def _dataclass(module: Module) -> str:
    return _imported(module, "dataclasses", "dataclass")


def _base_lost(module: Module, made: ast.ClassDef) -> str:
    """Return the class line with the base that the file imports for it and does not use."""
    bases = {last_part(dotted(base)) for c in module.classes for base in c.bases}
    tuples = [_imported(module, "typing", "NamedTuple")] if _fields(made) else []
    enums = [] if _fields(made) else [_imported(module, "enum", name) for name in MEMBERS]
    used = {dotted(d) for c in module.classes for d in c.decorator_list}
    if _fields(made) and _dataclass(module) and _dataclass(module) not in used:
        return ""  # (it is more likely to be a dataclass)
    found = [name for name in (*tuples, *enums) if name and last_part(name) not in bases]
    return f"class {made.name}({found[0]}):" if len(found) == 1 else ""


def _no_member(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """.value is read from what a class without the base Enum has."""
    for part in raised.module.nodes:
        if not isinstance(part, ast.Attribute) or part.attr != match["name"]:
            continue
        owner, _, member = dotted(part.value).rpartition(".")
        own = _own_class(raised, owner) if part.lineno == raised.line and owner else None
        if own is None or member not in _constants(own[1]):
            continue
        text, (module, made) = raised.module.text, own
        params = {"name": text.code(part), "written": text.code(part.value), "class": owner}
        head = _base_lost(module, made)
        if not head:
            return raised.finding("no_enum", at=part, params=params)
        found = raised.finding("no_enum", at=made, params={**params, "written": head})
        return replace(found, variant="base")
    return None


def _constants(made: ast.ClassDef) -> set[str]:
    return {dotted(t) for s in made.body if isinstance(s, ast.Assign) for t in s.targets}


def _decorated(case: Case) -> Files | None:
    """Write the decorator above the class."""
    module, written = case.module, str(case.finding.params.get("written", ""))
    if module is None or not written.startswith("@") or not _dataclass(module):
        return None
    line = case.finding.line or 0
    found = [c for c in module.classes if c.lineno == line]
    row = f"{indent_of(module.text.line(line))}{written}"
    return case.changed(module, module.text.before(line, row)) if found else None


def _with_base(case: Case) -> Files | None:
    """Write the class line with its base."""
    module, written = case.module, str(case.finding.params.get("written", ""))
    found = [c for c in module.classes if c.lineno == case.finding.line] if module else []
    if module is None or not found or not written.startswith("class "):
        return None
    row = module.text.line(found[0].lineno)
    head = re.match(r"[ \t]*(class[ \t]+\w+[ \t]*(?:\([ \t]*(?:object)?[ \t]*\))?[ \t]*:)", row)
    if head is None:
        return None
    new = f"{row[: head.start(1)]}{written}{row[head.end(1) :]}"
    line = found[0].lineno
    return case.changed(module, module.text.without(line), module.text.before(line + 1, new))


NO_INIT = msg(
    "A call of a class gives its values to __init__. The class {name} has no __init__, so it takes no "
    "values."
)


def _with_stars(case: Case) -> Files | None:
    """Write the stars before the parameter of the def."""
    module, line = case.module, case.finding.line
    name, written = (str(case.finding.params.get(key, "")) for key in ("name", "written"))
    if module is None or line is None or not name:
        return None
    places = list(re.finditer(rf"(?<=[(,\s]){re.escape(name)}(?=\s*[,)])", module.text.line(line)))
    if len(places) != 1:
        return None
    start = module.text.start_of(line)
    at, end = (start + place for place in places[0].span())
    return case.changed(module, Splice(at, end, written))


_node = Family("node", links.PYTHON_CLASSES)
KINDS = (
    _node(
        "class_takes_nothing",
        "start",
        msg("A class gets values, but has no __init__ that takes them"),
        NO_INIT,
        msg(
            "Write a def __init__ in the class {name} (line {line}), with self and one parameter for each "
            "value, that keeps the values in self. Or call {name}() without values."
        ),
        whys={
            "dataclass": msg(
                "The class {name} only lists its values with their types. The decorator {written} makes "
                "an __init__ from such a list, and it is not above this class."
            ),
            "import": msg(
                "The class {name} only lists its values with their types. The decorator {written} makes "
                "an __init__ from such a list, and it is not above this class."
            ),
            "base": msg(
                "A call of a class gives its values to __init__, and the class {name} has none. The file "
                "imports a class from which it would inherit one, and no class inherits from it."
            ),
            "near": msg(
                "Python calls __init__, with two underscores on both sides, when an object is created. "
                "The class {name} has no __init__, but a method {method}, which Python does not call."
            ),
        },
        fixes={
            "dataclass": msg("Write {written} on a line of its own above this line."),
            "import": msg(
                "Write {written} on a line of its own above this line, and from dataclasses import "
                "dataclass at the top of the file."
            ),
            "base": msg("Write {written} on this line."),
            "near": msg("Rename {method} to __init__: two underscores before and after."),
        },
        raised={TAKES_NONE: on_line(_takes_none)},
        fixed_by=(_decorated, _with_base),
        examples=(
            example(
                "dataclass_without_its_decorator",
                DATACLASS_IMPORTED,
                Replace(
                    NODE, "class MyFirstNode(", f"class Settings:\n{CLASS}\n\nclass MyFirstNode("
                ),
                Replace(NODE, "self.counter_ = 0", "self.counter_ = Settings(start=0).start"),
                fails="run.starts",
            ),
            example(
                "class_without_an_init",
                Replace(
                    NODE,
                    "class MyFirstNode(",
                    "class Count:\n    start = 0\n\n\nclass MyFirstNode(",
                ),
                Replace(NODE, "self.counter_ = 0", "self.counter_ = Count(0).start"),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "no_enum",
        "start",
        msg("A class is used as an Enum, and does not inherit from Enum"),
        msg(
            "Only a member of an Enum has .value and .name. {class} is a class without a base, so {name} "
            "reads them from the plain value."
        ),
        msg("Write {written} instead of {name}."),
        fixes={"base": msg("Write {written} on this line.")},
        raised={NO_MEMBER: on_line(_no_member)},
        fixed_by=(_with_base, lines.written),
        examples=(
            example(
                "enum_without_its_base",
                Replace(NODE, "import rclpy\nfrom", "from enum import Enum\n\nimport rclpy\nfrom"),
                Replace(
                    NODE,
                    "class MyFirstNode(",
                    "class Speed:\n    SLOW = 1.0\n\n\nclass MyFirstNode(",
                ),
                Replace(NODE, "create_timer(1.0,", "create_timer(Speed.SLOW.value,"),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "stars_lost",
        "start",
        msg("A parameter has lost its stars"),
        msg(
            "The block of this def passes on all that is in {name}, with {written}. The def itself has "
            "{name} without stars, so a call must give one value for it."
        ),
        msg("Write: {head}"),
        raised={NOT_GIVEN: on_line(_stars_lost)},
        fixed_by=(_with_stars,),
        examples=(
            example(
                "keyword_arguments_without_stars",
                Replace(NODE, "def __init__(self)", "def __init__(self, kwargs)"),
                Replace(
                    NODE,
                    "super().__init__('my_first_node')",
                    "super().__init__('my_first_node', **kwargs)",
                ),
                fails="run.starts",
            ),
        ),
    ),
)
