"""The mistake of a class with one object, whose __init__ runs in each call of the class."""

from __future__ import annotations

import ast
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.example import LOG, NODE, STEP_LINE, example
from grader.mistakes.kind import Family
from grader.mistakes.recognised import RecognisedMistake, Suspect
from grader.package.edit.tree import Replace
from grader.package.source.counter import parts_of_callback, targets_of
from grader.package.source.module import Function
from grader.package.source.names import calls_in, last_part


def _runs_again(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a class with a __new__ that gives one object, and an __init__ that sets a number."""
    source = suspect.source
    calls = [(c, last_part(n)) for part in parts_of_callback(source) for c, n in calls_in(part)]
    for call, name in calls:
        made = source.classes_by_name.get(name)
        methods = {n.name: n for n in made.body if isinstance(n, Function)} if made else {}
        new, init = methods.get("__new__"), methods.get("__init__")
        if new is None or init is None or not _keeps_one(new):
            continue
        sets = [s for s in init.body if isinstance(s, ast.Assign) and _number(s)]
        if len(sets) == 1:
            found = suspect.finding("init_runs_again", sets[0], name=f"{name}()")
            return replace(found, words={**found.words, "line": str(call.lineno)})
    return None


def _keeps_one(new: Function) -> bool:
    """Whether a __new__ makes an object under a condition, and returns what it has kept."""
    kept = {target for n in ast.walk(new) for target in targets_of(n) if "." in target}
    made = any(isinstance(n, ast.If) for n in ast.walk(new))
    return made and bool(kept)


def _number(statement: ast.Assign) -> bool:
    value = statement.value
    own = any(target.startswith("self.") for target in targets_of(statement))
    return own and isinstance(value, ast.Constant) and isinstance(value.value, int | float)


_node = Family("node", links.PYTHON_CLASSES)
KINDS = (
    _node(
        "init_runs_again",
        "counter",
        msg("The __init__ of the only object runs again"),
        msg(
            "__new__ returns the same object each time, but Python calls __init__ after it each time too. So "
            "{name} in line {line} begins the count again."
        ),
        msg(
            "Call {name} once, in the __init__ of the node, keep the object in an attribute, and use that in "
            "line {line}. Or set the number in __new__, where the object is made, and delete this line."
        ),
        behind={"run.constant_counter": _runs_again},
        examples=(
            example(
                "singleton_begins_again",
                Replace(
                    NODE,
                    "class MyFirstNode",
                    "class HelloCounter:\n"
                    "    _only = None\n\n"
                    "    def __new__(cls):\n"
                    "        if cls._only is None:\n"
                    "            cls._only = super().__new__(cls)\n"
                    "        return cls._only\n\n"
                    "    def __init__(self):\n"
                    "        self.value = 0\n\n"
                    "    def take(self):\n"
                    "        self.value += 1\n"
                    "        return self.value - 1\n\n\n"
                    "class MyFirstNode",
                ),
                Replace(
                    NODE, LOG, "self.get_logger().info(f'Hello time: {HelloCounter().take()}')"
                ),
                Replace(NODE, STEP_LINE, ""),
                fails="run.output",
            ),
        ),
    ),
)
