"""Names that have no value: a colon for the =, a letter for a digit, a module that is not imported."""

from __future__ import annotations

import ast
import re

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.example import NODE, example
from grader.mistakes.fixes import lines, node_names
from grader.mistakes.imports import IMPORTS
from grader.mistakes.kind import Family
from grader.mistakes.recognised import NAME_ERROR, Raised, RecognisedMistake
from grader.package.edit.tree import Replace
from grader.package.source.module import Function, Module

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
    return raised.finding("module_not_imported", name=name, statement=statement)


_node = Family("node", links.PYTHON_ERRORS)
KINDS = (
    _node(
        "module_not_imported",
        "start",
        msg("A name is used without being imported"),
        msg("Python knows only names that the file imports or defines."),
        msg("Add the import at the top of the file: {statement}"),
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
