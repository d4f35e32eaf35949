"""A sign or a def in another place than was meant, where Python reads it as something else."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.example import DEAD, NODE, SPIN_UNTIL_CTRL_C, example
from grader.mistakes.fixes import lines
from grader.mistakes.fixes.case import Case
from grader.mistakes.kind import Family
from grader.mistakes.recognised import (
    NAME_ERROR,
    OWN_ATTRIBUTE,
    Raised,
    RecognisedMistake,
    Suspect,
    of_self,
    on_line,
)
from grader.package.edit.files import Files
from grader.package.edit.text import Splice, indent_of
from grader.package.edit.tree import Replace, Write
from grader.package.source.counter import targets_of
from grader.package.source.guard import is_guard
from grader.package.source.lost_flag import lost_flag
from grader.package.source.module import Function, Module
from grader.package.source.names import dotted, last_part
from grader.package.source.node import read_module
from grader.package.source.place import function_at, statement_at
from grader.package.source.scopes import bindings, has_self, scope_of

SPINS = ("spin", "spin_once", "spin_until_future_complete", "add_node")
NO_SELF = (
    r"AttributeError: (?:'\w{1,120}' object|type object '\w{1,120}'|module '[\w.]{1,120}') "
    r"has no attribute 'self'"
)

NODE_OF_FILE = """\
#!/usr/bin/env python3
import rclpy
from rclpy.node import Node

number = 0
node = None


def tick():
    global number
    node.get_logger().info('Hello time: ' + str(number))
    number += 1


def main(args=None):
    rclpy.init(args=args)
    node = Node('my_first_node')
    node.create_timer(1.0, tick)
    try:
        rclpy.spin(node)
    except KeyboardInterrupt:
        pass
    rclpy.try_shutdown()
"""


def _parts(raised: Raised, kind: type[ast.AST]) -> Iterator[ast.AST]:
    statement = statement_at(raised.module, raised.line)
    yield from (n for n in (ast.walk(statement) if statement else ()) if isinstance(n, kind))


# a dot for another sign


def _dot_for_comma(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """Two values of a call have a dot between them: the second one begins with self."""
    del match
    text = raised.module.text
    for call in _parts(raised, ast.Call):
        for given in getattr(call, "args", ()):
            inner = given
            while isinstance(inner, ast.Attribute) and inner.attr != "self":
                inner = inner.value
            if not isinstance(inner, ast.Attribute) or inner is given:
                continue
            if isinstance(inner.value, ast.Constant):  # (node.dot_for_comma)
                continue
            first, code = text.code(inner.value), text.code(given)
            rest = code.removeprefix(text.code(inner)).strip()
            if "\n" not in code:
                params = {"name": code, "written": f"{first}, self{rest}"}
                return raised.finding("dot_for_sign", at=given, params=params)
    return None


def _dot_for_plus(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """A dot joins two texts, as in PHP: str(…) is behind it."""
    del match
    text = raised.module.text
    for call in _parts(raised, ast.Call):
        joined = getattr(call, "func", None)
        if not isinstance(joined, ast.Attribute) or joined.attr != "str":
            continue
        name = text.code(joined)
        if "\n" in name:
            continue
        params = {"name": name, "written": f"{text.code(joined.value)} + str"}
        return replace(raised.finding("dot_for_sign", at=joined, params=params), variant="plus")
    return None


# a def inside of another one


def _def_inside(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The method that is missing stands in another method, indented too far."""
    name, module = match["name"], raised.module
    made = [n for n in module.nodes if isinstance(n, Function) and n.name == name]
    if not of_self(raised, match) or len(made) != 1 or not has_self(made[0]):
        return None
    outer = scope_of(module, made[0])
    if not isinstance(outer, Function) or made[0] not in outer.body:
        return None
    if not isinstance(scope_of(module, outer), ast.ClassDef):
        return None
    if outer.name == "__init__" and name in [timer.method for timer in raised.source.timers]:
        return None  # (node.callback_in_init)
    at = outer.body.index(made[0])
    if at == 0 or not all(isinstance(s, Function) and has_self(s) for s in outer.body[at:]):
        return None
    last = outer.end_lineno or outer.lineno
    params = {
        "name": name,
        "line": str(made[0].lineno),
        "last": str(last),
        "columns": str(made[0].col_offset - outer.col_offset),
    }
    found = raised.finding("def_inside", at=made[0], params=params)
    return replace(found, words={**found.words, "function": outer.name})


def _dedented(case: Case) -> Files | None:
    """Indent the lines of the def, and of those below it in the same block, less."""
    module, params = case.module, case.finding.params
    if module is None:
        return None
    first, last, columns = (int(params.get(key, 0)) for key in ("line", "last", "columns"))
    rows = [n for n in range(first, last + 1) if module.text.line(n).strip()]
    if any(len(indent_of(module.text.line(n))) < columns for n in rows):
        return None
    starts = [module.text.start_of(n) for n in rows]
    return case.changed(module, *(Splice(at, at + columns, "") for at in starts))


# a value that another part of the file sets


def _is_none_in_file(module: Module, name: str) -> bool:
    """Whether the file itself sets a variable, and only to None."""
    values = [getattr(s, "value", None) for s in module.tree.body if name in targets_of(s)]
    return bool(values) and all(isinstance(v, ast.Constant) and v.value is None for v in values)


def _global_lost(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """A variable of the file stays None, because a function sets its own one of the same name."""
    used: list[ast.AST] = [
        n for n in _parts(raised, ast.Attribute) if getattr(n, "attr", "") == match["name"]
    ]
    base = getattr(used[0], "value", None) if len(used) == 1 else None
    return _lost(raised, base)


def _spun_lost(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The same, where rclpy.spin or add_node gets the variable as the node."""
    del match
    given = [
        call.args[-1]
        for call in _parts(raised, ast.Call)
        if isinstance(call, ast.Call) and last_part(dotted(call.func)) in SPINS and call.args
    ]
    return _lost(raised, given[0]) if len(given) == 1 else None


def _lost(raised: Raised, base: ast.AST | None) -> RecognisedMistake | None:
    """Look for the only function that sets a variable of its own instead of this one of the file."""
    module = raised.module
    name = base.id if isinstance(base, ast.Name) else ""
    if not name or not _is_none_in_file(module, name):
        return None
    here = scope_of(module, base) if base is not None else None
    inside = [b for b in bindings(module, name) if b.scope is not None]
    setters = {b.scope for b in inside}
    owner = inside[0].scope if len(setters) == 1 else None
    if not isinstance(owner, Function) or owner is here or has_self(owner):
        return None
    if any(isinstance(b.part, ast.arg) for b in inside):
        return None
    if len([b for b in bindings(module, name) if b.scope is None]) != 1:
        return None
    params = {"name": name, "function": owner.name, "line": str(inside[0].line)}
    return raised.finding("global_lost", at=owner, params=params)


def _flag_lost(suspect: Suspect) -> RecognisedMistake | None:
    """A function that Ctrl+C calls sets a variable of its own, and the loop reads the other one."""
    module = suspect.source.module
    found = lost_flag(module)
    if found is None:
        return None
    sets = next(s for s in ast.walk(found.handler) if found.name in targets_of(s))
    params = {"name": found.name, "function": found.handler.name, "line": str(found.loop.lineno)}
    at = sets if isinstance(sets, ast.stmt) else found.handler
    told = suspect.finding("global_lost", at=at, **params, word=found.word)
    return replace(told, variant="flag")


def with_global(case: Case) -> Files | None:
    """Write the global as the first line of the function."""
    module, params = read_module(case.files.data, case.finding.file), case.finding.params
    made = module.functions.get(str(params.get("function", ""))) if module is not None else None
    if module is None or made is None:
        return None
    body = made.body[1:] if ast.get_docstring(made) is not None else made.body
    if not body or body[0].lineno == made.lineno:
        return None
    indent = indent_of(module.text.line(body[0].lineno))
    row = f"{indent}{params.get('word', 'global')} {params.get('name', '')}"
    return case.changed(module, module.text.before(body[0].lineno, row))


def _under_guard(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """Only the block of the guard sets the name, and ros2 run does not run that block."""
    name, module = match["name"], raised.module
    for block in module.tree.body:
        inside = block.body if isinstance(block, ast.If) and is_guard(block) else []
        found = [s for s in inside if name in targets_of(s)]
        if len(found) == 1 and len(bindings(module, name)) == 1:
            params = {"name": name, "line": str(found[0].lineno)}
            mistake = raised.finding("set_under_guard", at=found[0], params=params)
            main = raised.source.main
            if main is None or not _needs_program(module, inside, found[0]):
                return mistake
            here = function_at(module, raised.line) is main
            return replace(mistake, variant="in_main" if here else "passed")
    return None


def _needs_program(module: Module, block: list[ast.stmt], statement: ast.stmt) -> bool:
    """Whether a statement of the guard needs ROS, what the file defines, or a name of its block."""
    own = {name for s in block for name in targets_of(s)}
    imported = [s for s in block if isinstance(s, ast.Import | ast.ImportFrom)]
    own |= {(a.asname or a.name).partition(".")[0] for s in imported for a in s.names}
    own |= {n.name for n in module.tree.body if isinstance(n, Function | ast.ClassDef)}
    value = getattr(statement, "value", None)
    parts = list(ast.walk(value)) if isinstance(value, ast.expr) else []
    return any(isinstance(n, ast.Name) and n.id in own | {"rclpy"} for n in parts)


_node = Family("node", links.PYTHON_ERRORS)
KINDS = (
    _node(
        "dot_for_sign",
        "callback",
        msg("A dot is between two values"),
        msg("A dot reads a part of the object before it. A comma separates the values of a call."),
        msg("Write {written} instead of {name}."),
        whys={
            "plus": msg("A dot reads a part of the object before it. + joins two texts in Python.")
        },
        raised={
            NO_SELF: on_line(_dot_for_comma),
            r"AttributeError: 'str' object has no attribute 'str'": on_line(_dot_for_plus),
        },
        fixed_by=(lines.written,),
        examples=(
            example(
                "dot_for_the_comma_of_a_timer",
                Replace(
                    NODE,
                    "        self.create_timer(1.0,",
                    "        period = 1.0\n        self.create_timer(period.",
                ),
                fails="run.starts",
            ),
            example(
                "dot_joins_texts_as_in_php",
                Replace(NODE, "'Hello time: ' + str(", "'Hello time: ' . str("),
                fails="run.output",
                blocks=DEAD,
            ),
        ),
    ),
    _node(
        "def_inside",
        "class",
        msg("A method is inside of another method"),
        msg(
            "def {name} (line {line}) is indented further than def {function}, so it is a part of "
            "{function}, and no method of the class."
        ),
        msg("Delete {columns} spaces at the start of each line from line {line} to line {last}."),
        links.PYTHON_CLASSES,
        raised={OWN_ATTRIBUTE: on_line(_def_inside)},
        fixed_by=(_dedented,),
        examples=(
            example(
                "helper_inside_of_init",
                Replace(
                    NODE,
                    "    def timer_callback",
                    "        def count_one(self):\n            self.counter_ += 1\n\n"
                    "    def timer_callback",
                ),
                Replace(NODE, "        self.counter_ += 1\n\n\n", "        self.count_one()\n\n\n"),
                fails="run.output",
                blocks=("run.interrupt",),
            ),
        ),
    ),
    _node(
        "global_lost",
        "callback",
        msg("A function sets a variable of its own instead of the one outside of it"),
        msg(
            "A function that gives a name a value has a variable of its own with this name. Line {line} "
            "sets {name} in {function} only, and {name} of the file stays None."
        ),
        msg("Write global {name} as the first line of {function}."),
        whys={
            "flag": msg(
                "A function that gives a name a value has a variable of its own with this name. Ctrl+C "
                "calls {function}, which sets its own {name}. The loop in line {line} reads the other "
                "{name}, which stays as it was."
            )
        },
        fixes={"flag": msg("Write {word} {name} as the first line of {function}.")},
        behind={"run.ignores_interrupt": _flag_lost},
        raised={
            r"AttributeError: 'NoneType' object has no attribute '(?P<name>\w{1,120})'": on_line(
                _global_lost
            ),
            r"AttributeError: 'NoneType' object has no attribute '(?:executor|handle)'": _spun_lost,
        },
        fixed_by=(with_global,),
        examples=(
            example(
                "node_of_the_file_without_global",
                Write(NODE, NODE_OF_FILE),
                fails="run.output",
                blocks=DEAD,
            ),
            example(
                "flag_of_ctrl_c_without_global",
                Replace(NODE, "import rclpy\nfrom", "import signal\n\nimport rclpy\nfrom"),
                Replace(
                    NODE,
                    "def main(",
                    "running = True\n\n\ndef stop(signum, frame):\n    running = False\n\n\ndef main(",
                ),
                Replace(
                    NODE,
                    SPIN_UNTIL_CTRL_C,
                    "    signal.signal(signal.SIGINT, stop)\n    while running:\n"
                    "        rclpy.spin_once(node, timeout_sec=0.1)\n",
                ),
                fails="run.interrupt",
            ),
        ),
    ),
    _node(
        "set_under_guard",
        "start",
        msg("A name is set only if the file is run directly"),
        msg(
            "Line {line} sets {name} in the block of if __name__ == '__main__':. ros2 run imports the "
            "file and calls its function, and does not run that block."
        ),
        msg(
            "Move line {line} to the top of the file, below the imports, with no spaces before it."
        ),
        fixes={
            "in_main": msg(
                "Move line {line}, and the lines of that block that it needs, to the beginning of {function}."
            ),
            "passed": msg(
                "Move line {line}, and the lines of that block that it needs, to the beginning of "
                "{function}. Give {name} as an argument to each function that uses it."
            ),
        },
        raised={NAME_ERROR: _under_guard},
        examples=(
            example(
                "period_set_under_the_guard",
                Replace(NODE, "(1.0,", "(PERIOD,"),
                Replace(NODE, "__main__':\n", "__main__':\n    PERIOD = 1.0\n"),
                fails="run.starts",
            ),
        ),
    ),
)
