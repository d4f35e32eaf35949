"""Automatic mutants of the node's code: what is dropped, doubled, swapped, renamed or miscounted.

Each function yields (name, new source, checks), and one of these checks must fail.
"""

from __future__ import annotations

import ast
from collections.abc import Iterator
from itertools import pairwise

from grader.course.assignment import Assignment
from grader.validate.spots import Code, misspelt
from grader.verdict.checks.all import FAMILIES

Made = tuple[str, str, tuple[str, ...]]
NOT_CODE = ("package.", "build.")  # what the node's code is does not concern these
ANY = tuple(family for family in FAMILIES if family not in NOT_CODE)
TEXTS = ("run.output", "run.node_name", "run.starts")
COUNTS = ("run.output", "run.period", "run.starts")
LEVELS = ("debug", "warning", "error")
TIMES = (0.1, 0.5, 0.99, 1.01, 2.0, 10.0)  # factors for a float


def mutants_of(code: Code, assignment: Assignment) -> Iterator[Made]:
    """Yield every mutant of the node's source; those that hang first, to run beside others."""
    yield from _counting(code, assignment)
    for operator in (
        _dropped,
        _doubled,
        _swapped,
        _misspelt,
        _uncalled,
        _numbers,
        _steps,
        _texts,
        _calls,
        _definitions,
        _imports,
        _handlers,
    ):
        yield from operator(code)


def _dropped(code: Code) -> Iterator[Made]:
    for node in code.statements():
        yield f"drop {code.shown(node)}", code.put(node, "pass"), ANY


def _doubled(code: Code) -> Iterator[Made]:
    for node in code.statements():
        text = f"{code.of(node)}\n{code.indent(node)}{code.of(node)}"
        yield f"twice {code.shown(node)}", code.put(node, text), ANY


def _swapped(code: Code) -> Iterator[Made]:
    for block in code.blocks():
        for first, second in pairwise(block):
            if not isinstance(first, ast.Try) and not isinstance(second, ast.Try):
                name = f"swap {code.shown(first)} / {code.shown(second)}"
                yield name, code.put_both(first, second), ANY


def _misspelt(code: Code) -> Iterator[Made]:
    """Leave a letter out of each name where it is first used."""
    seen = {"__name__"}
    for node in code.walk():
        if isinstance(node, ast.Attribute) and isinstance(node.ctx, ast.Load):
            name = node.attr
            new = f"{code.of(node.value)}.{misspelt(name)}"
            yield f"misspell {code.shown(node)}", code.put(node, new), ANY
        elif isinstance(node, ast.Name) and node.id not in seen:
            seen.add(node.id)
            yield f"misspell {node.id}", code.put(node, misspelt(node.id)), ANY


def _uncalled(code: Code) -> Iterator[Made]:
    """Remove the parentheses of a call, or add them to an argument that must not be called."""
    for node in code.walk():
        if isinstance(node, ast.Call):
            yield f"no brackets {code.shown(node)}", code.put(node, code.of(node.func)), ANY
            for given in node.args:
                if isinstance(given, ast.Attribute):
                    name = f"brackets {code.shown(given)}"
                    yield name, code.put(given, f"{code.of(given)}()"), ANY


def _numbers(code: Code) -> Iterator[Made]:
    for node in code.walk():
        if not isinstance(node, ast.Constant) or isinstance(node.value, bool):
            continue
        if isinstance(node.value, float):
            for times in TIMES:
                new = repr(round(times * node.value, 6))
                name = f"number {code.shown(node)} is {new}"
                yield name, code.put(node, new), ("run.period", "run.output")
        elif isinstance(node.value, int):
            for other in (node.value + 1, node.value - 1, f"'{node.value}'"):
                name = f"number {node.value} is {other}"
                yield name, code.put(node, str(other)), COUNTS


def _steps(code: Code) -> Iterator[Made]:
    for node in code.walk():
        if isinstance(node, ast.AugAssign):
            target, value = code.of(node.target), code.of(node.value)
            for sign in ("=", "=+", "=-", "-=", "*="):
                name = f"step {sign}"
                yield name, code.put(node, f"{target} {sign} {value}"), ("run.output",)
            local = target.rpartition(".")[2]
            yield "step of a local", code.put(node, f"{local} += {value}"), COUNTS


def _texts(code: Code) -> Iterator[Made]:
    for node in code.walk():
        if isinstance(node, ast.JoinedStr):
            yield from _f_string(code, node)
        elif isinstance(node, ast.Constant) and isinstance(node.value, str):
            if node.value == "__main__":
                yield "guard misspelt", code.put(node, "'main'"), ANY
            elif id(node) not in code.docstrings:
                for name, new in _other_texts(node.value):
                    yield name, code.put(node, repr(new)), TEXTS


def _f_string(code: Code, node: ast.JoinedStr) -> Iterator[Made]:
    written = code.of(node)
    quote = min(written.find(sign) for sign in "'\"" if sign in written)
    yield f"f lost {code.shown(node)}", code.put(node, written[quote:]), TEXTS
    for part in node.values:
        if isinstance(part, ast.Constant) and str(part.value) in written[quote:]:
            for name, new in _other_texts(str(part.value)):
                text = written[:quote] + written[quote:].replace(str(part.value), new, 1)
                yield name, code.put(node, text), TEXTS


def _other_texts(text: str) -> Iterator[tuple[str, str]]:
    for name, new in {
        "swapped capitals": text.swapcase(),
        "letter lost": text[:1] + text[2:],
        "end lost": text[:-1],
        "mark added": f"{text}!",
        "blank before": f" {text}",
        "blank doubled": text.replace(" ", "  "),
        "empty": "",
    }.items():
        if new != text:
            yield f"text {text!r} {name}", new


def _calls(code: Code) -> Iterator[Made]:
    for node in code.walk():
        if not isinstance(node, ast.Call):
            continue
        shown = code.shown(node)
        if len(node.args) == 2:
            first, second = node.args
            yield f"swap arguments {shown}", code.put_both(first, second), ANY
        for n in range(len(node.args)):
            rest = ", ".join(code.of(other) for k, other in enumerate(node.args) if k != n)
            name = f"argument {n + 1} lost {shown}"
            yield name, code.put(node, f"{code.of(node.func)}({rest})"), ANY
        if isinstance(node.func, ast.Attribute) and node.func.attr == "info":
            logger = code.of(node.func.value)
            for level in LEVELS:
                name = f"log as {level}"
                yield name, code.put(node.func, f"{logger}.{level}"), ("run.logger", "run.output")
            yield "print for the logger", code.put(node.func, "print"), ("run.logger",)
        if isinstance(node.func, ast.Name) and node.func.id == "str":
            yield "no str()", code.put(node, code.of(node.args[0])), COUNTS
            yield "repr() of the text", code.put(node, f"repr({code.of(node)})"), ("run.output",)


def _definitions(code: Code) -> Iterator[Made]:
    for node in code.walk():
        if isinstance(node, ast.ClassDef):
            for base in node.bases:
                yield f"base is object, not {code.shown(base)}", code.put(base, "object"), ANY
        if isinstance(node, ast.FunctionDef):
            head = f"def {node.name}("
            yield f"rename {node.name}", code.text.replace(head, f"def {node.name}2("), ANY
            for given in node.args.args:
                lost = f"{head})" if len(node.args.args) == 1 and not node.args.defaults else ""
                if lost:
                    old = f"{head}{given.arg})"
                    yield f"no {given.arg} in {node.name}", code.text.replace(old, lost), ANY
                    more = code.put(given, f"{given.arg}, more")
                    yield f"another parameter in {node.name}", more, ANY
            for default in node.args.defaults:
                old = f"={code.of(default)})"
                yield f"no default in {node.name}", code.text.replace(old, ")", 1), ANY


def _imports(code: Code) -> Iterator[Made]:
    for node in code.tree.body:
        if isinstance(node, ast.Import | ast.ImportFrom):
            for alias in node.names:
                yield f"misspell {code.shown(node)}", code.put(alias, misspelt(alias.name)), ANY
        if isinstance(node, ast.ImportFrom) and node.module:
            module = f"from {node.module}x import {code.of(node.names[0])}"
            yield f"other module {code.shown(node)}", code.put(node, module), ANY


def _handlers(code: Code) -> Iterator[Made]:
    for node in code.walk():
        if isinstance(node, ast.ExceptHandler) and node.type is not None:
            yield (
                f"except {code.shown(node.type)} lost",
                code.put(node.type, "ZeroDivisionError"),
                ANY,
            )


def _counting(code: Code, assignment: Assignment) -> Iterator[Made]:
    """Yield mistakes in the callback that increments the counter."""
    for block in code.blocks():
        steps = [node for node in block if isinstance(node, ast.AugAssign)]
        if not steps:
            continue
        step, first = steps[0], block[0]
        counter, indent = code.of(step.target), code.indent(step)
        begin = assignment.output.start
        late = begin + 3 * assignment.output.step
        for name, line, families in (
            ("ends after three", f"if {counter} == {late}: raise SystemExit", ("run.output",)),
            ("raises after three", f"if {counter} == {late}: raise ValueError", ("run.output",)),
            ("starts again after three", f"if {counter} == {late}: {counter} = {begin}", COUNTS),
            ("leaves one out", f"if {counter} == {late}: {counter} += 1", COUNTS),
            ("returns early", "return", COUNTS),
            ("loops for ever", "while True: pass", COUNTS),
            ("sleeps three seconds", "import time; time.sleep(3)", ("run.period", "run.output")),
            ("asks the terminal", "input()", COUNTS),
            ("is reset", f"{counter} = {begin}", COUNTS),
        ):
            here = first if name in ("returns early", "is reset") else step
            old = code.of(here)
            text = f"{line}\n{indent}{old}" if here is first else f"{old}\n{indent}{line}"
            yield f"callback {name}", code.put(here, text), families
