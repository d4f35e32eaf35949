"""The mistake of a property or method whose first value Python keeps."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.example import CACHED_PROPERTY_IMPORTED, NODE, example
from grader.mistakes.fixes.case import Case
from grader.mistakes.kind import Family
from grader.mistakes.recognised import RecognisedMistake, Suspect
from grader.package.edit.files import Files
from grader.package.edit.tree import Replace
from grader.package.source.counter import parts_of_callback
from grader.package.source.module import Function
from grader.package.source.names import dotted, last_part
from grader.package.source.node import NodeSource

CACHED_PROPERTY = "cached_property"
CACHES = (CACHED_PROPERTY, "cache", "lru_cache")


def _kept(source: NodeSource) -> tuple[Function, ast.expr, str] | None:
    """Return the only method whose value is kept, its decorator, and the decorator's name."""
    found = []
    shown = {m for part in parts_of_callback(source) for m in _methods_read(source, part)}
    for method in {*source.methods.values(), *shown}:
        if len(method.args.args) > 1 or method.args.vararg or method.args.kwonlyargs:
            continue  # (a value is kept for each of the arguments)
        for decorator in method.decorator_list:
            called = decorator.func if isinstance(decorator, ast.Call) else decorator
            name = last_part(dotted(called))
            if name in CACHES:
                found.append((method, decorator, name))
    return found[0] if len(found) == 1 else None


def _methods_read(source: NodeSource, part: Function) -> Iterator[Function]:
    """Yield the methods of other classes of the files that a log call reads by their name."""
    read = {last_part(dotted(n)) for call in source.logs(part) for n in ast.walk(call)}
    for module in (*source.modules, *source.beside):
        for own in module.classes:
            methods = [s for s in own.body if isinstance(s, Function) and s.name in read]
            yield from (m for m in methods if own not in source.family)


def _cached(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a method of the node that is calculated once only."""
    kept = _kept(suspect.source)
    if kept is None:
        return None
    method, decorator, name = kept
    module = suspect.source.module_of(method)
    code = module.text.code(decorator)
    written = "@property" if name == CACHED_PROPERTY else ""
    words = {"name": f"@{code}", "written": written, "method": method.name}
    found = suspect.finding("value_cached", decorator, **words)
    return found if written else _without(found)


def _counts_when_read(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a property that counts on each time it is read, and that is read several times."""
    source, callback = suspect.source, suspect.source.callback
    for method in source.methods.values() if callback is not None else ():
        if "property" not in map(dotted, method.decorator_list) or callback is None:
            continue
        steps = [n for n in ast.walk(method) if isinstance(n, ast.AugAssign)]
        reads = [n for n in ast.walk(callback) if dotted(n) == f"self.{method.name}"]
        if steps and len(reads) > 1:
            rows = ", ".join(map(str, sorted({n.lineno for n in reads if isinstance(n, ast.expr)})))
            params = {"name": f"self.{method.name}", "lines": rows}
            found = suspect.finding("property_counts", steps[0], **params)
            words = {**found.words, "callback": callback.name, "line": method.lineno}
            return replace(found, words=words)
    return None


def _without(found: RecognisedMistake) -> RecognisedMistake:
    return RecognisedMistake(
        kind=found.kind, params=found.params, words=found.words, variant="call", where=found.where
    )


def _calculated_anew(case: Case) -> Files | None:
    """Write @property for the property that is kept."""
    kept = _kept(case.node) if case.node is not None else None
    if case.node is None or kept is None:
        return None
    module = case.node.module_of(kept[0])
    if kept[2] != CACHED_PROPERTY:
        row = kept[1].lineno
        alone = module.line(row) == f"@{module.text.code(kept[1])}"
        return case.changed(module, module.text.without(row)) if alone else None
    return case.changed(module, module.text.swap(kept[1], "property"))


_node = Family("node", links.PYTHON_CLASSES)
KINDS = (
    _node(
        "value_cached",
        "text",
        msg("Python keeps the first value"),
        msg("{name} calculates {method} once and keeps this first value for all later uses."),
        msg("Write {written} instead of {name}: it calculates the value each time."),
        fixes={"call": msg("Delete {name} above {method}.")},
        behind={"run.constant_counter": _cached},
        fixed_by=(_calculated_anew,),
        examples=(
            example(
                "text_in_cached_property",
                CACHED_PROPERTY_IMPORTED,
                Replace(
                    NODE,
                    "    def timer_callback(self)",
                    "    @cached_property\n    def text(self):\n"
                    "        return f'Hello time: {self.counter_}'\n\n    def timer_callback(self)",
                ),
                Replace(NODE, "'Hello time: ' + str(self.counter_)", "self.text"),
                fails="run.output",
            ),
            example(
                "cached_property_of_a_helper",
                CACHED_PROPERTY_IMPORTED,
                Replace(
                    NODE,
                    "class MyFirstNode",
                    "class Ticks:\n    value = 0\n\n    @cached_property\n    def text(self):\n"
                    "        return f'Hello time: {self.value}'\n\n\nclass MyFirstNode",
                ),
                Replace(NODE, "self.counter_ = 0", "self.ticks_ = Ticks()"),
                Replace(NODE, "'Hello time: ' + str(self.counter_)", "self.ticks_.text"),
                Replace(NODE, "self.counter_ += 1", "self.ticks_.value += 1"),
                fails="run.output",
            ),
            example(
                "text_in_cache",
                Replace(
                    NODE,
                    "import rclpy\nfrom",
                    "from functools import lru_cache\n\nimport rclpy\nfrom",
                ),
                Replace(
                    NODE,
                    "    def timer_callback(self)",
                    "    @lru_cache(maxsize=None)\n    def text(self):\n"
                    "        return f'Hello time: {self.counter_}'\n\n    def timer_callback(self)",
                ),
                Replace(NODE, "'Hello time: ' + str(self.counter_)", "self.text()"),
                fails="run.output",
            ),
        ),
    ),
    _node(
        "property_counts",
        "counter",
        msg("Each line that reads the number also counts on"),
        msg(
            "{name} is a property: each line that reads it runs its lines, also the one shown. "
            "{callback} reads it more than once (lines: {lines})."
        ),
        msg(
            "Read {name} once in {callback}, into a variable, and use the variable in these lines. Or "
            "let the property only return the number, and add to it in {callback}."
        ),
        links.PYTHON_CLASSES,
        behind=dict.fromkeys(("run.wrong_start", "run.wrong_step"), _counts_when_read),
        examples=(
            example(
                "property_that_counts_read_twice",
                Replace(
                    NODE,
                    "    def timer_callback",
                    "    @property\n    def number(self):\n        value = self.counter_\n"
                    "        self.counter_ += 1\n        return value\n\n    def timer_callback",
                ),
                Replace(
                    NODE,
                    "        self.get_logger().info('Hello time: ' + str(self.counter_))\n"
                    "        self.counter_ += 1\n",
                    "        self.get_logger().debug(f'tick {self.number}')\n"
                    "        self.get_logger().info(f'Hello time: {self.number}')\n",
                ),
                fails="run.output",
            ),
        ),
    ),
)
