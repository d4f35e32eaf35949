"""Mistakes in the student's own methods: self in a call, in a def, and names that a class sets."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.base.nearest import nearest
from grader.mistakes import links
from grader.mistakes.constructor import lines_of
from grader.mistakes.example import DEAD, LOG, NODE, example
from grader.mistakes.fixes import lines, node_timer
from grader.mistakes.kind import Family
from grader.mistakes.own_calls import DATACLASS
from grader.mistakes.recognised import OWN_ATTRIBUTE, Raised, RecognisedMistake, on_line
from grader.mistakes.scope import NODE_METHODS
from grader.package.edit.tree import Replace, Write
from grader.package.source.counter import targets_of
from grader.package.source.module import Function
from grader.package.source.names import called_name, dotted, last_part
from grader.package.source.place import function_at
from grader.package.source.scopes import class_of, has_self

TAKES_NONE = r"TypeError: (?P<type>\w{1,120})\.(?P<name>\w{1,120})\(\) takes 0 positional arguments but 1 was "
LACKS = r"TypeError: (?P<type>\w{1,120})\.(?P<name>\w{1,120})\(\) missing 1 required positional argument"
LACK = r"TypeError: (?P<type>\w{1,120})\.(?P<name>\w{1,120})\(\) missing \d{1,2} required positional argument"
TAKES = (
    r"TypeError: (?P<type>\w{1,120})\.(?P<name>\w{1,120})\(\) takes (?P<taken>\d{1,2}) positional "
    r"arguments? but (?P<given>\d{1,2}) were given"
)
STARTS_AGAIN = r"TypeError: .{1,200}__init__\(\) |RecursionError"
CALLED = r"TypeError: '\w{1,120}' object is not callable"

HELPER = """\
class Count:

    def __init__(self, start):
        self.value = start

    def text(self):
        return 'Hello time: ' + str(self.value)

    def step(self):
        self.value += 1


class MyFirstNode("""
WITH_HELPER = (
    Replace(NODE, "class MyFirstNode(", HELPER),
    Replace(NODE, "self.counter_ = 0", "self.counter_ = Count(0)"),
    Replace(NODE, LOG, "self.get_logger().info(self.counter_.text())"),
    Replace(NODE, "self.counter_ += 1", "self.counter_.step()"),
)


def _methods(raised: Raised, owner: str, name: str) -> list[Function]:
    """Return the methods of a name in the student's classes of another name."""
    classes = (
        c for module in raised.source.known_modules for c in module.classes if c.name == owner
    )
    return [s for c in classes for s in c.body if isinstance(s, Function) and s.name == name]


def _calls_here(raised: Raised) -> Iterator[ast.Call]:
    """Yield the calls on the line of the error."""
    for call, _ in raised.source.calls:
        if raised.source.module_of(call) is raised.module and raised.line in lines_of(call):
            yield call


def _no_self(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """A method of a helper class has nothing in the brackets of its def."""
    found = _methods(raised, match["type"], match["name"])
    if len(found) != 1 or found[0].decorator_list or found[0] in raised.source.methods.values():
        return None
    made = found[0]
    head = re.search(
        rf"\bdef\s+(?P<code>{made.name}\s*\(\s*\))", raised.source.module_of(made).line(made.lineno)
    )
    if head is None:
        return None
    params = {"name": head["code"], "written": f"{made.name}(self)", "type": match["type"]}
    return raised.finding("helper_no_self", at=made, params=params)


def _static(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """A method with self has @staticmethod above it, so that self gets the first value."""
    found = _methods(raised, match["type"], match["name"])
    if len(found) != 1 or len(found[0].decorator_list) != 1:
        return None
    made, decorator = found[0], found[0].decorator_list[0]
    timed = any(timer.method == made.name for timer in raised.source.timers)
    first = [a.arg for a in made.args.args[:1]]
    if timed or first != ["self"] or dotted(decorator) != "staticmethod":
        return None
    calls = [c for c in _calls_here(raised) if last_part(dotted(c.func)) == made.name]
    if len(calls) != 1 or dotted(calls[0].func) == f"{match['type']}.{made.name}":
        return None
    params = {"name": "staticmethod", "method": made.name}
    return raised.finding("static_with_self", at=decorator, params=params)


def _self_given(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """A call of a method gives self, which Python passes on its own."""
    if int(match["given"]) != int(match["taken"]) + 1:
        return None
    for call in _calls_here(raised):
        if not isinstance(call.func, ast.Attribute) or call.func.attr != match["name"]:
            continue
        owner, text = call.func.value, raised.module.text
        of_class = dotted(owner) in {*raised.source.known_classes, "Node"}
        around = raised.module.parents.get(call)
        if isinstance(around, ast.Call) and called_name(around) == "create_timer":
            continue  # (node.callback_called)
        if of_class or isinstance(owner, ast.Call) or not call.args:
            continue
        if dotted(call.args[0]) != "self" or len(call.args) != int(match["given"]) - 1:
            continue
        code = text.code(call)
        kept = [*map(text.code, call.args[1:]), *(text.code(k) for k in call.keywords)]
        written = f"{text.code(call.func)}({', '.join(kept)})"
        if "\n" in code:
            continue
        params = {"name": code, "written": written, "method": call.func.attr}
        return raised.finding("self_given", at=call, params=params)
    return None


def _self_left_out(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """A method of the base is called on the class, and self is not among its arguments."""
    here = class_of(raised.module, function_at(raised.module, raised.line))
    bases = [dotted(base) for base in here[0].bases] if here is not None else []
    if here is None or match["type"] not in bases or not has_self(here[1]):
        return None
    if match["type"] == "Node":
        return None  # (node.super_without_name)
    wanted = f"{match['type']}.{match['name']}"
    calls = [call for call in _calls_here(raised) if dotted(call.func) == wanted]
    text = raised.module.text
    code = text.code(calls[0]) if len(calls) == 1 else ""
    if not code or "\n" in code or any(dotted(a) == "self" for a in calls[0].args):
        return None
    given = [*map(text.code, calls[0].args), *(text.code(k) for k in calls[0].keywords)]
    written = f"{wanted}({', '.join(['self', *given])})"
    params = {"name": code, "written": written, "type": match["type"]}
    return raised.finding("self_left_out", at=calls[0], params=params)


def _inside_super(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """self.__init__(…) is in the brackets of super, so __init__ of the own class runs again."""
    del match
    for node in raised.module.nodes:
        if not isinstance(node, ast.Call) or dotted(node.func) != "super":
            continue
        inner = node.args[-1] if node.args else None
        if not isinstance(inner, ast.Call) or dotted(inner.func) != "self.__init__":
            continue
        text = raised.module.text
        code = text.code(node)
        if raised.line not in lines_of(node) or "\n" in code:
            continue
        given = [*map(text.code, inner.args), *(text.code(k) for k in inner.keywords)]
        params = {"name": code, "written": f"super().__init__({', '.join(given)})"}
        return raised.finding("init_inside_super", at=node, params=params)
    return None


def _hides_method(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The class gives an attribute the name of the method that the line calls."""
    del match
    for call in _calls_here(raised):
        name = call.func.attr if isinstance(call.func, ast.Attribute) else ""
        if not name or name in NODE_METHODS:
            continue
        found = [
            (c, s)
            for module in raised.source.modules
            for c in module.classes
            for s in c.body
            if isinstance(s, Function) and s.name == name and not s.decorator_list
        ]
        sets = _set_in(found[0][0], name) if len(found) == 1 else []
        if not sets:
            continue
        owner, method = found[0]
        uses = _uses(owner, name)
        rows = ", ".join(map(str, sorted({u.lineno for u in uses} - {sets[0].lineno})))
        params = {"name": name, "type": owner.name, "line": str(method.lineno), "lines": rows}
        mistake = raised.finding("attribute_hides_method", at=sets[0], params=params)
        return replace(mistake, variant="lines" if rows else "")
    return None


def _set_in(owner: ast.ClassDef, name: str) -> list[ast.stmt]:
    """Return the lines of a class that give an attribute of self a first value, in order."""
    found = [
        n
        for n in ast.walk(owner)
        if isinstance(n, ast.Assign | ast.AnnAssign) and f"self.{name}" in targets_of(n)
    ]
    return sorted(found, key=lambda n: n.lineno)


def _uses(owner: ast.ClassDef, name: str) -> list[ast.Attribute]:
    """Return where a class reads or sets an attribute of self without calling it."""
    called = {n.func for n in ast.walk(owner) if isinstance(n, ast.Call)}
    parts = (n for n in ast.walk(owner) if isinstance(n, ast.Attribute) and n not in called)
    return [n for n in parts if dotted(n) == f"self.{name}"]


def _never_set(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """A helper class reads an attribute that none of its lines sets."""
    name = match["name"]
    here = class_of(raised.module, function_at(raised.module, raised.line))
    if here is None or here[0].name != match["type"] or here[0] in raised.source.family:
        return None
    owner = here[0]
    bases = [dotted(base) for base in owner.bases if dotted(base) != "object"]
    row = raised.module.line(raised.line)
    data = [dotted(d.func if isinstance(d, ast.Call) else d) for d in owner.decorator_list]
    if bases or not set(data) <= set(DATACLASS) or not re.search(rf"\bself\.{name}\b", row):
        return None
    defined = {s.name for s in owner.body if isinstance(s, Function)}
    known = {target for s in owner.body for target in targets_of(s)} | defined | set(_fields(owner))
    if name in known or name in NODE_METHODS or _set_in(owner, name):
        return None
    if raised.source.held_node or nearest(name, defined):
        return None
    params = {"name": f"self.{name}", "type": owner.name, "line": str(raised.line)}
    local = _local(owner, name)
    if local is not None:
        found = raised.finding("helper_never_sets", at=local, params=params)
        return replace(found, variant="local", words={**found.words, "attribute": name})
    stored = {
        n.attr
        for n in ast.walk(owner)
        if isinstance(n, ast.Attribute) and isinstance(n.ctx, ast.Store)
        if dotted(n.value) == "self"
    }
    own = sorted({*stored, *_fields(owner)} - {name})
    near = nearest(name, dict.fromkeys(own))
    if near:
        found = raised.finding("helper_never_sets", params={**params, "written": f"self.{near}"})
        return replace(found, variant="near")
    found = raised.finding("helper_never_sets", params=params)
    words = {**found.words, "attribute": name}
    if data:
        return replace(found, variant="fields", words={**words, "names": ", ".join(own)})
    names = ", ".join(f"self.{each}" for each in own)
    return replace(found, variant="others" if own else "", words={**found.words, "names": names})


def _fields(owner: ast.ClassDef) -> list[str]:
    """Return the names with a type in a class, of which a dataclass makes attributes."""
    return [dotted(s.target) for s in owner.body if isinstance(s, ast.AnnAssign)]


def _local(owner: ast.ClassDef, name: str) -> ast.stmt | None:
    """Return the line of __init__ that gives a variable of this name a value."""
    for method in owner.body:
        if isinstance(method, Function) and method.name == "__init__":
            for node in ast.walk(method):
                if isinstance(node, ast.Assign | ast.AnnAssign) and name in targets_of(node):
                    return node
    return None


_node = Family("node", links.PYTHON_CLASSES)
KINDS = (
    _node(
        "helper_no_self",
        "callback",
        msg("A method has no parameter self"),
        msg(
            "Python passes the object as the first argument to each of its methods: self. This method of "
            "the class {type} has no parameter for it."
        ),
        msg("Write {written} instead of {name} in this line."),
        raised={TAKES_NONE: on_line(_no_self)},
        fixed_by=(lines.written,),
        examples=(
            example(
                "method_of_an_object_without_self",
                Write(
                    "my_robot_controller/clicker.py",
                    "class Clicker:\n    clicks = -1\n\n"
                    "    def click():\n        self.clicks += 1\n        return self.clicks\n",
                ),
                Replace(
                    NODE,
                    "import rclpy\n",
                    "import rclpy\n\nfrom my_robot_controller.clicker import Clicker\n",
                ),
                Replace(NODE, "self.counter_ = 0", "self.clicker = Clicker()"),
                Replace(NODE, "str(self.counter_)", "str(self.clicker.click())"),
                Replace(NODE, "        self.counter_ += 1\n", ""),
                fails="run.output",
                blocks=DEAD,
            ),
            example(
                "method_of_a_helper_without_self",
                *WITH_HELPER,
                Replace(NODE, "def step(self)", "def step()"),
                fails="run.output",
                blocks=("run.interrupt",),
            ),
        ),
    ),
    _node(
        "static_with_self",
        "callback",
        msg("A method with self is a static method"),
        msg(
            "@staticmethod makes a function of the method {method}: Python does not pass the object, and "
            "self gets the first value of the call."
        ),
        msg("Delete this line."),
        raised={LACKS: on_line(_static)},
        fixed_by=(node_timer.plain_method,),
        examples=(
            example(
                "method_of_a_helper_is_static",
                *WITH_HELPER,
                Replace(NODE, "    def step(self)", "    @staticmethod\n    def step(self)"),
                fails="run.output",
                blocks=("run.interrupt",),
            ),
        ),
    ),
    _node(
        "self_given",
        "callback",
        msg("A call of a method gives self"),
        msg("Python passes the object before the dot as self on its own."),
        msg("Write {written} instead of {name}."),
        raised={TAKES: on_line(_self_given)},
        fixed_by=(lines.written,),
        examples=(
            example(
                "own_method_called_with_self",
                Replace(
                    NODE,
                    "    def timer_callback",
                    "    def step(self, by):\n        self.counter_ += by\n\n    def timer_callback",
                ),
                Replace(
                    NODE,
                    "self.counter_))\n        self.counter_ += 1",
                    "self.counter_))\n        self.step(self, 1)",
                ),
                fails="run.output",
                blocks=("run.interrupt",),
            ),
        ),
    ),
    _node(
        "self_left_out",
        "class",
        msg("A method is called on the class, without self"),
        msg(
            "Behind the name of the class {type}, Python passes no object: the first value of the call "
            "goes to self."
        ),
        msg("Write {written} instead of {name}."),
        raised={LACK: on_line(_self_left_out)},
        fixed_by=(lines.written,),
        examples=(
            example(
                "init_of_own_base_without_self",
                Replace(
                    NODE,
                    "class MyFirstNode(Node):",
                    "class Base(Node):\n    def __init__(self, name):\n        super().__init__(name)\n\n\n"
                    "class MyFirstNode(Base):",
                ),
                Replace(
                    NODE, "super().__init__('my_first_node')", "Base.__init__('my_first_node')"
                ),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "init_inside_super",
        "class",
        msg("self.__init__() is in the brackets of super"),
        msg(
            "self.__init__() runs __init__ of your own class again. The __init__ of the class that yours "
            "inherits from is called on what super() returns."
        ),
        msg("Write {written} instead of {name}."),
        raised={STARTS_AGAIN: on_line(_inside_super)},
        fixed_by=(lines.written,),
        examples=(
            example(
                "own_init_inside_super",
                Replace(
                    NODE,
                    "super().__init__('my_first_node')",
                    "super(MyFirstNode, self.__init__('my_first_node'))",
                ),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "attribute_hides_method",
        "callback",
        msg("An attribute has the name of a method"),
        msg(
            "The class {type} has a method {name} (line {line}). This line gives an attribute of the object "
            "the same name, and a call finds the attribute."
        ),
        msg("Give the attribute another name: write self.{name}_ instead of self.{name} here."),
        fixes={
            "lines": msg(
                "Give the attribute another name: write self.{name}_ instead of self.{name}, here and in "
                "line {lines}. Calls of {name}() stay."
            )
        },
        raised={CALLED: on_line(_hides_method)},
        examples=(
            example(
                "attribute_named_like_its_method",
                Replace(NODE, "class MyFirstNode(", HELPER),
                Replace(NODE, "self.counter_ = 0", "self.counter_ = Count(0)"),
                Replace(NODE, LOG, "self.get_logger().info(self.counter_.text())"),
                Replace(NODE, "self.counter_ += 1", "self.counter_.step()"),
                Replace(NODE, "self.value = start", "self.value = start\n        self.text = ''"),
                fails="run.output",
                blocks=DEAD,
            ),
        ),
    ),
    _node(
        "helper_never_sets",
        "callback",
        msg("A class reads an attribute that it does not set"),
        msg("No line of the class {type} sets {name}."),
        msg("Give {name} its first value in __init__ of the class {type}."),
        whys={
            "local": msg(
                "A name without self. is a variable, which is gone when __init__ ends. Line {line} needs "
                "the attribute {name}."
            ),
        },
        fixes={
            "local": msg("Write {name} instead of {attribute} in this line, before the =."),
            "near": msg("Write {written} instead of {name}."),
            "fields": msg(
                "The class {type} has: {names}. Write what is meant instead of {attribute}. If nothing of "
                "this is meant, add {attribute}, with its type and its first value, to the lines at the "
                "beginning of {type}."
            ),
            "others": msg(
                "The class {type} sets: {names}. Write what is meant instead of {name}. If nothing of this is "
                "meant, give {name} its first value in __init__ of {type}."
            ),
        },
        raised={OWN_ATTRIBUTE: on_line(_never_set)},
        fixed_by=(lines.written,),
        examples=(
            example(
                "variable_in_the_init_of_a_helper",
                *WITH_HELPER,
                Replace(NODE, "        self.value = start", "        value = start"),
                fails="run.output",
                blocks=DEAD,
            ),
            example(
                "other_attribute_in_a_helper",
                *WITH_HELPER,
                Replace(NODE, "        self.value += 1", "        self.number += 1"),
                fails="run.output",
                blocks=("run.interrupt",),
            ),
        ),
    ),
)
