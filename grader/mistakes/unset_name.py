"""Names that have no value: a colon for the =, a letter for a digit, a module that is not imported."""

from __future__ import annotations

import ast
import re
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.example import NODE, example
from grader.mistakes.fixes import lines, node_names
from grader.mistakes.imports import IMPORTS
from grader.mistakes.kind import Family
from grader.mistakes.recognised import NAME_ERROR, Raised, RecognisedMistake
from grader.package.edit.tree import Replace
from grader.package.source.module import Function, Module
from grader.package.source.names import dotted

UNBOUND = (
    r"UnboundLocalError: (?:cannot access )?local variable '(?P<name>\w{1,120})' "
    r"(?:where it is not associated|referenced before)"
)
DIGITS = {"l": "1", "I": "1", "O": "0", "o": "0"}
"""Letters that look like a digit in many fonts."""
OF_TYPING = (
    *("Any", "Callable", "ClassVar", "Dict", "Final", "Iterable", "Iterator", "List", "Optional"),
    *("Sequence", "Set", "Tuple", "Type", "Union"),
)
FROM = {
    **dict.fromkeys(OF_TYPING, "typing"),
    **dict.fromkeys(("sleep", "perf_counter"), "time"),
    **dict.fromkeys(("ABC", "abstractmethod"), "abc"),
    **dict.fromkeys(("deque", "defaultdict", "namedtuple", "OrderedDict"), "collections"),
    **dict.fromkeys(("partial", "cached_property"), "functools"),
    **dict.fromkeys(("count", "cycle"), "itertools"),
    **dict.fromkeys(("randint", "uniform"), "random"),
    **dict.fromkeys(("sqrt", "floor", "ceil"), "math"),
    **dict.fromkeys(("timedelta",), "datetime"),
    **dict.fromkeys(("dataclass", "field"), "dataclasses"),
    **dict.fromkeys(("suppress", "contextmanager"), "contextlib"),
    **dict.fromkeys(("SimpleNamespace",), "types"),
    **dict.fromkeys(("Enum", "IntEnum"), "enum"),
    **dict.fromkeys(("Path",), "pathlib"),
    **dict.fromkeys(("Thread", "Lock", "Event"), "threading"),
}
"""Names of Python's standard modules that a node's file uses by themselves."""
MODULES = (
    *("argparse", "asyncio", "collections", "copy", "datetime", "enum", "functools", "itertools"),
    *("json", "logging", "math", "os", "pathlib", "queue", "random", "re", "signal", "socket"),
    *("string", "struct", "subprocess", "sys", "threading", "time", "traceback", "typing"),
)


def _colon(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The only line that is to give the variable its value has a colon for the `=`."""
    module, name = raised.module, match["name"]
    found = [
        n
        for n in module.nodes
        if isinstance(n, ast.AnnAssign) and n.value is None and dotted(n.target) == name
    ]
    set_elsewhere = [
        n
        for n in module.nodes
        if isinstance(n, ast.Name) and isinstance(n.ctx, ast.Store) and n.id == name
    ]
    if len(found) != 1 or len(set_elsewhere) != 1 or found[0].end_lineno != found[0].lineno:
        return None
    code, value = module.text.code(found[0]), module.text.code(found[0].annotation)
    if isinstance(found[0].annotation, ast.Name | ast.Subscript) or value == "None":
        mistake = raised.finding("colon_for_equals", at=found[0], name=code)
        return replace(mistake, variant="type")
    written = f"{name} = {value}"
    return raised.finding("colon_for_equals", at=found[0], name=code, written=written)


def _digit(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """A letter stands where a number is calculated with, or assigned."""
    module, name = raised.module, match["name"]
    uses = [n for n in module.nodes if isinstance(n, ast.Name) and n.id == name]
    if name not in DIGITS or name in module.names or len(uses) != 1:
        return None
    around = module.parents.get(uses[0])
    number = isinstance(
        around, ast.AugAssign | ast.BinOp | ast.Assign | ast.AnnAssign | ast.Compare
    )
    called = around.func if isinstance(around, ast.Call) and uses[0] in around.args[:1] else None
    timed = called is not None and dotted(called).endswith("create_timer")
    if not number and not timed:
        return None
    return raised.finding("letter_for_digit", at=uses[0], name=name, written=DIGITS[name])


def _statement(module: Module, name: str) -> str:
    """Return the import of a name of Python's own modules that the file uses; "" if unknown."""
    uses = [n for n in module.nodes if isinstance(n, ast.Name) and n.id == name]
    read = [isinstance(module.parents.get(use), ast.Attribute) for use in uses]
    called = [_is_called(module, use) for use in uses]
    if name in FROM and uses and not any(read) and (all(called) or not name.islower()):
        return f"from {FROM[name]} import {name}"
    if name == "datetime" and all(getattr(module.parents[u], "attr", "") == "now" for u in uses):
        return "from datetime import datetime"
    if name in MODULES and uses and all(read):
        return f"import {name}"
    return ""


def _is_called(module: Module, use: ast.Name) -> bool:
    """Whether a name is that of a call, or of a decorator."""
    around = module.parents.get(use)
    decorated = isinstance(around, Function | ast.ClassDef) and use in around.decorator_list
    return decorated or (isinstance(around, ast.Call) and around.func is use)


def _not_imported(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    module, name = raised.module, match["name"]
    statement = _statement(module, name)
    if not statement or name in IMPORTS or name in module.names - {FROM.get(name, "")}:
        return None
    same = _same_module(module, FROM.get(name, ""))
    if same is None:
        return raised.finding("module_not_imported", name=name, statement=statement)
    code = module.text.code(same)
    found = raised.finding("module_not_imported", at=same, name=code, written=f"{code}, {name}")
    return replace(found, variant="added")


def _same_module(module: Module, name: str) -> ast.ImportFrom | None:
    """Return the import on one line that takes other names from the same module."""
    for statement in module.tree.body:
        if (
            isinstance(statement, ast.ImportFrom)
            and statement.module == name
            and not statement.level
        ):
            plain = module.text.code(statement)
            if "(" not in plain and "*" not in plain and "\n" not in plain:
                return statement
    return None


_node = Family("node", links.PYTHON_ERRORS)
KINDS = (
    _node(
        "colon_for_equals",
        "start",
        msg("A colon stands where an = belongs"),
        msg(
            "In Python, a colon after a name only states a type, and gives no value. (In a YAML "
            "file it gives one.)"
        ),
        msg("Write {written} instead of {name}."),
        fixes={
            "type": msg(
                "Give the name a value on this line: write = and the value at the end of {name}."
            )
        },
        raised={UNBOUND: _colon, NAME_ERROR: _colon},
        fixed_by=(lines.written,),
        examples=(
            example(
                "period_with_colon",
                Replace(
                    NODE,
                    "        self.create_timer(1.0,",
                    "        timer_period: 1.0\n        self.create_timer(timer_period,",
                ),
                fails="run.starts",
            ),
            example(
                "constant_with_colon",
                Replace(NODE, "\n\nclass MyFirstNode", "PERIOD: 1.0\n\n\nclass MyFirstNode"),
                Replace(NODE, "create_timer(1.0,", "create_timer(PERIOD,"),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "letter_for_digit",
        "callback",
        msg("A letter stands where a digit belongs"),
        msg("The letter {name} looks like the digit {written}, but Python takes it for a name."),
        msg("Write the digit {written} instead of the letter {name} on this line."),
        raised={NAME_ERROR: _digit},
        fixed_by=(lines.written,),
        examples=(
            example(
                "letter_l_for_one",
                Replace(NODE, "self.counter_ += 1", "self.counter_ += l"),
                fails="run.output",
                blocks=("run.interrupt",),
            ),
            example(
                "letter_o_for_zero",
                Replace(NODE, "self.counter_ = 0", "self.counter_ = O"),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "module_not_imported",
        "start",
        msg("A name is used without being imported"),
        msg("Python knows only names that the file imports or defines."),
        msg("Add the import at the top of the file: {statement}"),
        fixes={"added": msg("Write {written} instead of {name} on this line.")},
        raised={NAME_ERROR: _not_imported},
        fixed_by=(lines.written, node_names.missing_import),
        examples=(
            example(
                "list_not_imported",
                Replace(
                    NODE, "import rclpy\nfrom", "from typing import Optional\n\nimport rclpy\nfrom"
                ),
                Replace(NODE, "(args=None)", "(args: Optional[List[str]] = None)"),
                fails="run.starts",
            ),
            example(
                "os_not_imported",
                Replace(
                    NODE, "self.counter_ = 0", "self.counter_ = 0\n        self.user_ = os.getcwd()"
                ),
                fails="run.starts",
            ),
        ),
    ),
)
