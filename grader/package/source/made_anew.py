"""What a callback makes anew in each call although it should keep its value: an object that counts."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from dataclasses import dataclass

from grader.package.source.counter import declares, starts_of, targets_of, texts_of
from grader.package.source.generators import is_plain_generator
from grader.package.source.module import Function, Module
from grader.package.source.names import called_name, dotted
from grader.package.source.node import NodeSource
from grader.package.source.own_imports import own_imports

COUNTING = ("count", "iter", "Counter", "list", "dict", "deque", "defaultdict", "array")
"""Functions and classes of Python whose new objects begin again."""
DISPLAYS = (ast.List, ast.Dict, ast.GeneratorExp)


@dataclass(frozen=True)
class MadeAnew:
    """A statement of a callback that makes an object, and the name that it gives to it."""

    made: ast.Assign
    name: str

    @property
    def is_local(self) -> bool:
        """Whether it is a variable of the callback, and not an attribute."""
        return "." not in self.name


def made_anew(source: NodeSource) -> MadeAnew | None:
    """Return the object that the callback makes in each call, changes, and logs; None if none."""
    callback = source.callback
    if callback is None:
        return None
    calls = [*source.logs(callback), *source.prints(callback)]
    makers = _makers(source, source.module_of(callback))
    for made in callback.body:
        name = next(targets_of(made), "") if isinstance(made, ast.Assign) else ""
        if not isinstance(made, ast.Assign) or len(made.targets) != 1 or not name:
            continue
        if not ((name.startswith("self.") and name.count(".") == 1) or "." not in name):
            continue
        if not _begins_again(made.value, makers) or declares(callback, name):
            continue
        sets = [n for n in ast.walk(callback) if name in targets_of(n)]
        shown = any(_shows(callback, call, name) for call in calls if call.lineno > made.lineno)
        if shown and sets == [made] and _changes(callback, name) and _alone(source, callback, name):
            return MadeAnew(made, name)
    return None


def _alone(source: NodeSource, callback: Function, name: str) -> bool:
    """Whether the callback reads nothing else that could be meant to count."""
    lasting = {name, "self.get_logger", "self.get_clock", *source.loggers}
    lasting |= {f"self.{own}" for own in _own_generators(source)}
    starts = starts_of(source)
    for node in ast.walk(callback):
        read = dotted(node) if isinstance(node, ast.Name | ast.Attribute) else ""
        own = read.startswith("self.") and read.count(".") == 1 and "()" not in read
        if read not in lasting and (own or read in starts):
            return False
    return True


def _makers(source: NodeSource, module: Module) -> set[str]:
    """Return the names of the classes and generators whose calls make an object that counts."""
    classes = {c.name for m in source.modules for c in m.classes} - source.class_names
    generators = {name for name, function in module.functions.items() if _yields(function)}
    imported = {i.bound for i in own_imports(module) if i.name[:1].isupper()}
    own = {f"self.{name}" for name in _own_generators(source)}
    names = {name.removeprefix("self.") for name in own}
    return {*classes, *generators, *own, *names, *COUNTING, *(imported - source.class_names)}


def _own_generators(source: NodeSource) -> list[str]:
    """Return the methods of the node that are generators, and use only their own variables."""
    return [
        name
        for name, method in source.methods.items()
        if _yields(method) and is_plain_generator(method)
    ]


def _yields(function: Function) -> bool:
    return any(isinstance(n, ast.Yield | ast.YieldFrom) for n in ast.walk(function))


def _begins_again(value: ast.expr, makers: set[str]) -> bool:
    """Whether an expression makes an object that depends on nothing that lasts."""
    if isinstance(value, DISPLAYS):
        return not _reads_self(value)
    if not isinstance(value, ast.Call) or called_name(value) not in makers:
        return False
    if isinstance(value.func, ast.Attribute) and dotted(value.func.value) == "self":
        return dotted(value.func) in makers
    return not any(_reads_self(v) for v in (*value.args, *(k.value for k in value.keywords)))


def _reads_self(value: ast.expr) -> bool:
    """Whether an expression reads a name that is no function: it may be what should count."""
    called = {n.func for n in ast.walk(value) if isinstance(n, ast.Call)}
    names = [n for n in ast.walk(value) if isinstance(n, ast.Name) and n not in called]
    own = {n.id for n in ast.walk(value) if isinstance(n, ast.Name) and not _is_read(n)}
    return any(_is_read(n) and n.id not in own for n in names)


def _is_read(name: ast.Name) -> bool:
    return isinstance(name.ctx, ast.Load)


def _shows(callback: Function, call: ast.Call, name: str) -> bool:
    """Whether a log line shows the object, or a text or a variable that comes from it."""
    parts: list[ast.AST] = [*call.args]
    for _ in range(3):
        known = {dotted(n) for part in parts for n in ast.walk(part)}
        parts += [
            s.value
            for s in ast.walk(callback)
            if isinstance(s, ast.Assign)
            and set(targets_of(s)) & known - {name}
            and s.value not in parts
        ]
    parts += texts_of(callback, call)
    return any(dotted(n) == name for part in parts for n in ast.walk(part))


def _changes(callback: Function, name: str) -> bool:
    """Whether the callback changes the object: with a method, with next(), or by assigning to a part."""
    return any(_is_change(node, name) for node in ast.walk(callback))


def _is_change(node: ast.AST, name: str) -> bool:
    if isinstance(node, ast.Call):
        on = dotted(node.func.value) if isinstance(node.func, ast.Attribute) else ""
        stepped = dotted(node.func) == "next" and bool(node.args) and dotted(node.args[0]) == name
        return on == name or stepped
    return any(_part_of(target) == name for target in _targets(node))


def _targets(node: ast.AST) -> Iterator[ast.expr]:
    if isinstance(node, ast.Assign):
        yield from node.targets
    elif isinstance(node, ast.AugAssign):
        yield node.target


def _part_of(target: ast.expr) -> str:
    """Return the object of which this is a part: x of `x[0]` and `x.n`."""
    return dotted(target.value) if isinstance(target, ast.Subscript | ast.Attribute) else ""
