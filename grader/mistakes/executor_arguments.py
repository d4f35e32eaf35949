"""Mistakes in what an executor gets: a class instead of a node, or a node instead of a number."""

from __future__ import annotations

import ast
import re
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.constructor import lines_of
from grader.mistakes.example import NODE, example
from grader.mistakes.fixes import lines
from grader.mistakes.kind import Family
from grader.mistakes.recognised import Raised, RecognisedMistake
from grader.package.edit.tree import Replace
from grader.package.source.module import Function
from grader.package.source.names import dotted, last_part

EXECUTORS = ("SingleThreadedExecutor", "MultiThreadedExecutor")


def _class_added(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """An executor gets the class of the node, and no object of it."""
    del match
    source = raised.source
    classes = {c.name for module in source.modules for c in module.classes}
    for call in source.calls_of("add_node"):
        given = call.args[0] if len(call.args) == 1 and not call.keywords else None
        if given is None or isinstance(given, ast.Call) or dotted(given) not in classes:
            continue
        code = source.module_of(call).text.code
        variables = [*_made(raised, given), f"{code(given)}()"]
        written = f"{code(call.func)}({variables[0]})"
        params = {"name": code(call), "written": written}
        found = raised.finding("class_to_executor", at=call, params=params)
        return replace(found, words={**found.words, "type": code(given)})
    return None


def _made(raised: Raised, of_class: ast.expr) -> list[str]:
    """Return the variables that have an object of the class already, if there is one."""
    source = raised.source
    names = [
        dotted(n.targets[0])
        for n in source.all_nodes
        if isinstance(n, ast.Assign)
        and isinstance(n.value, ast.Call)
        and dotted(n.value.func) == dotted(of_class)
    ]
    return names if len(names) == 1 and names[0].isidentifier() else []


def _list_added(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """An executor gets a list of nodes in one call of add_node."""
    del match
    source = raised.source
    for call in source.calls_of("add_node"):
        if raised.line not in lines_of(call) or len(call.args) != 1 or call.keywords:
            continue
        code = source.module_of(call).text.code
        found = raised.finding("list_to_executor", at=call, name=code(call))
        words = {"owner": code(call.func), "list": code(call.args[0])}
        return replace(found, words={**found.words, **words})
    return None


def _node_for_number(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """An executor is made with the node as its argument."""
    del match
    source = raised.source
    calls = [c for c, name in source.calls if last_part(name) in EXECUTORS]
    here = [c for c in calls if raised.line in lines_of(c)]
    call = here[0] if len(here) == 1 else None
    if call is None or not call.args or any(isinstance(a, ast.Constant) for a in call.args):
        return None
    module = source.module_of(call)
    code, statement = module.text.code, module.parents.get(call)
    made = f"{code(call.func)}()"
    node = code(call.args[0])
    if isinstance(call.args[0], ast.List | ast.Tuple):
        return None
    if not isinstance(statement, ast.Assign) or len(statement.targets) != 1:
        return None
    owner = code(statement.targets[0])
    added = [a for a in source.calls_of("add_node") if dotted(a.func) == f"{owner}.add_node"]
    params = {"name": code(call), "written": made}
    found = raised.finding("executor_with_node", at=call, params=params)
    words = {**found.words, "call": f"{owner}.add_node({node})"}
    inside = isinstance(source.function_around(call), Function)
    return replace(found, words=words, variant="added" if added else "" if inside else "added")


INSTEAD = msg("Write {written} instead of {name}.")
_node = Family("node", links.EXECUTORS)
KINDS = (
    _node(
        "class_to_executor",
        "spin",
        msg("The executor gets a class instead of a node"),
        msg(
            "{type} is the class. add_node needs a node, which is an object of the class. The error "
            "comes only when the executor spins."
        ),
        INSTEAD,
        raised={r"'property' object|missing 1 required positional argument: 'self'": _class_added},
        fixed_by=(lines.written,),
        examples=(
            example(
                "class_added_to_executor",
                Replace(NODE, "import rclpy\n", "import rclpy\nimport rclpy.executors\n"),
                Replace(
                    NODE,
                    "rclpy.spin(node)",
                    "executor = rclpy.executors.SingleThreadedExecutor()\n"
                    "        executor.add_node(MyFirstNode)\n"
                    "        executor.spin()",
                ),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "list_to_executor",
        "spin",
        msg("The executor gets a list of nodes in one call"),
        msg("add_node takes one node, and no list or tuple of nodes."),
        msg(
            "Write two lines instead of {name}: for each_node in {list}: and, indented below it, "
            "{owner}(each_node)"
        ),
        raised={r"TypeError: unhashable type: 'list'|weak reference to 'tuple'": _list_added},
        examples=(
            example(
                "list_added_to_executor",
                Replace(NODE, "import rclpy\n", "import rclpy\nimport rclpy.executors\n"),
                Replace(
                    NODE,
                    "rclpy.spin(node)",
                    "executor = rclpy.executors.SingleThreadedExecutor()\n"
                    "        executor.add_node([node])\n"
                    "        executor.spin()",
                ),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "executor_with_node",
        "spin",
        msg("An executor is created with the node as its argument"),
        msg(
            "The first argument of MultiThreadedExecutor is a number of threads, and "
            "SingleThreadedExecutor takes none. An executor gets its nodes with add_node."
        ),
        msg("Write {written} instead of {name}, and {call} on a line of its own below it."),
        fixes={"added": INSTEAD},
        raised={
            r"'<=' not supported between|takes 1 positional argument but 2|'>' not supported": (
                _node_for_number
            )
        },
        examples=(
            example(
                "node_for_number_of_threads",
                Replace(NODE, "import rclpy\n", "import rclpy\nimport rclpy.executors\n"),
                Replace(
                    NODE,
                    "rclpy.spin(node)",
                    "executor = rclpy.executors.MultiThreadedExecutor(node)\n"
                    "        executor.spin()",
                ),
                fails="run.starts",
            ),
        ),
    ),
)
