"""Words of C#, Java and JavaScript for super() and for a method that belongs to its object."""

from __future__ import annotations

import ast
import re
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.example import NODE, example
from grader.mistakes.fixes import lines
from grader.mistakes.kind import Family
from grader.mistakes.recognised import NAME_ERROR, OWN_ATTRIBUTE, Raised, RecognisedMistake
from grader.package.edit.tree import Replace
from grader.package.source.names import dotted, last_part, own_name
from grader.package.source.place import function_at, statement_at

BASES = ("base", "parent", "Base", "Parent")
RUNS = ("run", "Run", "start", "Start", "listen", "serve_forever", "mainloop", "loop", "exec")
"""Methods with which the objects of other frameworks begin their work."""
STARTS = ("", "()", ".__init__", "().__init__", ".constructor", ".Node")


def _base(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """A statement of __init__ calls the constructor of the base class by another word."""
    name, function = match["name"], function_at(raised.module, raised.line)
    statement = statement_at(raised.module, raised.line)
    call = statement.value if isinstance(statement, ast.Expr) else None
    if name not in BASES or function is None or function.name != "__init__":
        return None
    if not isinstance(call, ast.Call) or dotted(call.func) not in {name + s for s in STARTS}:
        return None
    text = raised.module.text
    given = [text.code(p) for p in call.args if dotted(p) != "self"]
    given += [text.code(k) for k in call.keywords]
    params = {"name": text.code(call), "written": f"super().__init__({', '.join(given)})"}
    if "\n" in params["name"]:
        return None
    return raised.finding("base_for_super", at=statement, params=params)


def _bound(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """A method is bound to its object with bind, as in JavaScript."""
    del match
    statement = statement_at(raised.module, raised.line)
    calls = [n for n in ast.walk(statement) if isinstance(n, ast.Call)] if statement else []
    for call in calls:
        function = call.func
        if not isinstance(function, ast.Attribute) or function.attr != "bind":
            continue
        if not own_name(function.value) or [dotted(a) for a in call.args] != ["self"]:
            continue
        code = raised.module.text.code
        params = {"name": code(call), "written": code(function.value)}
        return raised.finding("method_bind", at=call, params=params)
    return None


def _runs(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """A statement starts the node with a method of other frameworks, and nothing spins."""
    source, statement = raised.source, statement_at(raised.module, raised.line)
    call = statement.value if isinstance(statement, ast.Expr) else None
    if not isinstance(call, ast.Call) or match["name"] not in RUNS:
        return None
    owner, _, method = dotted(call.func).rpartition(".")
    spins = any(last_part(name).startswith("spin") for _, name in source.calls)
    if spins or method != match["name"] or owner not in source.node_variables:
        return None
    params = {"name": raised.module.text.code(call), "written": f"rclpy.spin({owner})"}
    if "\n" in params["name"]:
        return None
    found = raised.finding("run_for_spin", at=statement, params=params)
    return replace(found, words={**found.words, "method": method})


INSTEAD = msg("Write {written} instead of {name}.")
_node = Family("node", links.PYTHON_CLASSES)
KINDS = (
    _node(
        "base_for_super",
        "class",
        msg("The base class is called by a word of another programming language"),
        msg("In Python, super() is the object as its base class knows it."),
        INSTEAD,
        raised={NAME_ERROR: _base},
        fixed_by=(lines.written,),
        examples=(
            example(
                "base_of_c_sharp",
                Replace(NODE, "super().__init__(", "base.__init__("),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "run_for_spin",
        "spin",
        msg("The node is started with a method that a node does not have"),
        msg("A node has no method {method}: rclpy.spin(…) calls its callbacks until Ctrl+C."),
        INSTEAD,
        links.EXECUTORS,
        raised={OWN_ATTRIBUTE: _runs},
        fixed_by=(lines.written,),
        examples=(
            example(
                "node_run_like_an_app",
                Replace(NODE, "rclpy.spin(node)", "node.run(debug=True)"),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "method_bind",
        "callback",
        msg("A method is bound with bind, which is JavaScript"),
        msg("In Python, {written} belongs to its object already: it gets self when it is called."),
        INSTEAD,
        raised={r"AttributeError: '(?:function|method)' object has no attribute 'bind'": _bound},
        fixed_by=(lines.written,),
        examples=(
            example(
                "callback_with_bind",
                Replace(NODE, "1.0, self.timer_callback)", "1.0, self.timer_callback.bind(self))"),
                fails="run.starts",
            ),
        ),
    ),
)
