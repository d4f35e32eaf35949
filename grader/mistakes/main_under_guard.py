"""The mistake of a def or a class below the guard: ros2 run imports the file and passes it over."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from dataclasses import dataclass, replace

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.entry_function import NO_FUNCTION
from grader.mistakes.example import NODE, example
from grader.mistakes.fixes.case import Case
from grader.mistakes.kind import Family
from grader.mistakes.recognised import NAME_ERROR, Raised, RecognisedMistake
from grader.package.edit.files import Files
from grader.package.edit.text import Splice, indent_of
from grader.package.edit.tree import Edit, Replace
from grader.package.source.guard import is_guard
from grader.package.source.module import Function, Module
from grader.package.source.node import read_module
from grader.package.source.place import function_at

Defined = ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef | ast.Import | ast.ImportFrom


@dataclass(frozen=True)
class _Hidden:
    """The lines below a guard that define something; `is_all` if the guard has no others."""

    guard: ast.If
    first: int
    last: int
    is_all: bool


def _bound(statement: ast.stmt) -> set[str]:
    if isinstance(statement, ast.Import | ast.ImportFrom):
        return {a.asname or a.name.partition(".")[0] for a in statement.names}
    return {statement.name} if isinstance(statement, Function | ast.ClassDef) else set()


def _first_line(statement: ast.stmt) -> int:
    above = statement.decorator_list if isinstance(statement, Function | ast.ClassDef) else []
    return min([statement.lineno, *(d.lineno for d in above)])


def _hidden(module: Module, name: str) -> _Hidden | None:
    """Return the guard below which a name is defined, and nowhere else in the file."""
    found = list(_below_guards(module, name))
    others = {n for s in module.tree.body for n in _bound(s)}
    if len(found) != 1 or name in others:
        return None
    guard, at = found[0]
    body = guard.body
    defining = [n for n, s in enumerate(body) if isinstance(s, Defined)]
    first, last = defining[0], defining[-1]
    if any(not isinstance(s, Defined | ast.Assign | ast.AnnAssign) for s in body[first : last + 1]):
        first = last = at
    end = body[last].end_lineno or body[last].lineno
    return _Hidden(guard, _first_line(body[first]), end, last - first + 1 == len(body))


def _below_guards(module: Module, name: str) -> Iterator[tuple[ast.If, int]]:
    for statement in module.tree.body:
        if isinstance(statement, ast.If) and is_guard(statement) and not statement.orelse:
            for n, inner in enumerate(statement.body):
                if name in _bound(inner):
                    yield statement, n


def _told(raised: Raised, module: Module, name: str) -> RecognisedMistake | None:
    hidden = _hidden(module, name)
    if hidden is None or hidden.first == hidden.guard.lineno:
        return None
    params = {"name": name, "first": str(hidden.first), "last": str(hidden.last)}
    found = raised.finding("defined_under_guard", at=hidden.guard, params=params)
    variant = "all" if hidden.is_all else "one" if hidden.first == hidden.last else ""
    return replace(found, variant=variant)


def _function(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    if match["function"] != raised.assignment.function:
        return None
    return _told(raised, raised.source.entry, match["function"])


def _name(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    if function_at(raised.module, raised.line) is None:
        return None  # (the name is needed above the guard, while the file is read)
    return _told(raised, raised.module, match["name"])


def moved(case: Case) -> Files | None:
    """Move the lines above the guard, to the left margin."""
    module = read_module(case.files.data, case.finding.file)
    hidden = _hidden(module, str(case.finding.params.get("name", ""))) if module else None
    if module is None or hidden is None:
        return None
    text, guard = module.text, hidden.guard
    indent = indent_of(text.line(guard.body[0].lineno))
    rows = [text.line(n) for n in range(hidden.first, hidden.last + 1)]
    if not indent or any(row.strip() and not row.startswith(indent) for row in rows):
        return None
    after = hidden.last + 1
    while after <= (guard.end_lineno or 0) and not text.line(after).strip():
        after += 1
    above = [row.removeprefix(indent) if row.strip() else "" for row in rows]
    if hidden.is_all:
        gap = text.start_of(hidden.first)
        code = text.newline.join(above)
        end = text.end_of(hidden.last)
        return case.changed(
            module, Splice(text.start_of(guard.lineno), gap, ""), Splice(gap, end, code)
        )
    cut = Splice(text.start_of(hidden.first), text.start_of(after), "")
    before = guard.lineno + 1
    blank = [text.without(n) for n in range(before, hidden.first) if not text.line(n).strip()]
    return case.changed(module, text.before(guard.lineno, *above, "", ""), *blank, cut)


GUARD = "if __name__ == '__main__':\n"
MAIN = """\
def main(args=None):
    \"\"\"Run the node until Ctrl+C.\"\"\"
    rclpy.init(args=args)
    node = MyFirstNode()
    try:
        rclpy.spin(node)
    except KeyboardInterrupt:
        pass
    finally:
        node.destroy_node()
        rclpy.try_shutdown()


if __name__ == '__main__':
    main()
"""
INDENTED = "".join(f"    {row}" for row in MAIN.partition("\n\n\n")[0].splitlines(keepends=True))


def _under_guard(call: str) -> Edit:
    return Replace(NODE, MAIN, f"{GUARD}{INDENTED}\n{call}")


_node = Family("node", links.DEVELOPING)
KINDS = (
    _node(
        "defined_under_guard",
        "start",
        msg("A part of the program is below the guard, and ros2 run does not see it"),
        msg(
            "The lines below this guard run only if the file is started directly. ros2 run imports "
            "the file, and __name__ is not '__main__' then: {name} does not exist."
        ),
        msg(
            "Cut lines {first} to {last} and paste them above this line. Then move them to the left "
            "margin: in VS Code, select them and press Shift+Tab. The other lines stay below this "
            "line, indented."
        ),
        fixes={
            "all": msg(
                "Move lines {first} to {last} to the left margin: in VS Code, select them and press "
                "Shift+Tab. Then delete this line."
            ),
            "one": msg(
                "Cut line {first} and paste it above this line, without indentation. The other lines "
                "stay below this line, indented."
            ),
        },
        raised={NO_FUNCTION: _function, NAME_ERROR: _name},
        fixed_by=(moved,),
        examples=(
            example("main_defined_under_guard", _under_guard("    main()\n"), fails="run.starts"),
            example("guard_above_main_alone", _under_guard(""), fails="run.starts"),
            example(
                "import_under_guard",
                Replace(NODE, "import rclpy\nfrom", "from"),
                Replace(NODE, f"{GUARD}    main()", f"{GUARD}    import rclpy\n    main()"),
                fails="run.starts",
            ),
        ),
    ),
)
