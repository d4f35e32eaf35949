"""Mistakes with which a node does not start: rclpy.init()."""

from __future__ import annotations

import ast
import re
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.after_with import NO_CONTEXT
from grader.mistakes.example import INIT, NODE, example
from grader.mistakes.fixes import lines, node_init, node_life
from grader.mistakes.kind import Family
from grader.mistakes.recognised import Raised, RecognisedMistake
from grader.package.edit.tree import Replace, Write
from grader.package.source.counter import targets_of
from grader.package.source.imported import full_name
from grader.package.source.module import Function
from grader.package.source.names import calls_in, dotted, last_part

NOT_INITIALIZED = r"NotInitializedException"
NOT_READY = r"Context must be initialized"  # of rclpy on kilted
NODES_MADE = msg("rclpy.init() connects the program to ROS; no node can be created before it.")


def _inits(raised: Raised) -> list[ast.Call]:
    own = {f.name for f in raised.source.all_nodes if isinstance(f, Function)}
    return [
        call
        for call, name in raised.source.calls
        if (last_part(name) == "init" and (name == "rclpy.init" or "init" not in own))
        or full_name(raised.source.module_of(call), call.func) == "rclpy.init"
    ]


def _init_missing(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    del match
    if _inits(raised):
        return None
    written = node_init.new_call(raised.source)
    for node in raised.source.all_nodes:
        if isinstance(node, ast.Expr) and dotted(node.value) == "rclpy.init":
            found = raised.finding("init_missing", at=node, written=written)
            return replace(found, variant="not_called")
    return raised.finding("init_missing", written=written)


def _without_init(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """Look for a program without rclpy.init(), whose executor finds no running ROS."""
    return _init_missing(raised, match) if raised.inside == "rclpy" else None


def _made_on_import(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """Look for a node that is created outside of functions, when the file is imported."""
    del match
    found = node_init.made_on_import(raised.source)
    if found is None:
        return None
    made, init = found
    if any(node_init.used_elsewhere(raised.source, name) for name in targets_of(made)):
        return None  # (a variable of the entry function would not be known there)
    code = raised.source.entry.text.code(init) if init else node_init.new_call(raised.source)
    words = {"written": code, "line": str(init.lineno) if init else ""}
    mistake = raised.finding("made_on_import", at=made, params=words)
    return replace(mistake, variant="no_init" if init is None else "")


def _init_late(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """Look for the only rclpy.init(), which does not run above what the entry function makes."""
    del match
    inits, source, main = _inits(raised), raised.source, raised.source.main
    if len(inits) != 1 or dotted(inits[0].func) != "rclpy.init" or main is None:
        return None
    calls = [call for statement in main.body for call, _ in calls_in(statement)]
    made = [call.lineno for call in calls if source.is_node_class(call.func)]
    if not made or (inits[0] in calls and inits[0].lineno < min(made)):
        return None
    return raised.finding("init_late", at=inits[0], written=node_init.moved_call(source, inits[0]))


def _init_twice(raised: Raised, match: re.Match[str]) -> RecognisedMistake:
    del match
    inits = [call for call, name in raised.source.calls if name == "rclpy.init"]
    if len(inits) == 1:
        return replace(raised.finding("init_twice"), variant="imported")
    main = raised.source.main
    others = [call for call in inits if raised.source.function_around(call) is not main]
    surplus = others if 0 < len(others) < len(inits) else inits[1:]
    return raised.finding("init_twice", at=surplus[0] if surplus else None)


def _without_keyword(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The call of init on the line has a value that is not given by its name."""
    del match
    for call, name in raised.source.calls:
        if last_part(name) == "init" and call.args and raised.line == call.lineno:
            text = raised.source.module_of(call).text
            function, given = text.code(call.func), text.code(call.args[0])
            several = len(call.args) > 1
            written = node_init.new_call(raised.source) if several else f"{function}(args={given})"
            return raised.finding("init_arguments", at=call, name=text.code(call), written=written)
    return None


_node = Family("node", links.FIRST_NODE)
KINDS = (
    _node(
        "made_on_import",
        "start",
        msg("The node is created when the file is imported, before rclpy.init()"),
        msg(
            "A line outside of functions runs when Python imports the file. {function} runs later, "
            "and so does its rclpy.init()."
        ),
        msg("Move this line into {function}, below {written} (line {line})."),
        links.RCLPY,
        whys={
            "no_init": msg(
                "A line outside of functions runs when Python imports the file, before {function}. "
                "No node can be created before rclpy.init()."
            ),
        },
        fixes={"no_init": msg("Move this line into {function}, and write {written} above it.")},
        raised={NOT_INITIALIZED: _made_on_import},
        fixed_by=(node_init.into_main,),
        examples=(
            example(
                "node_made_on_import",
                Replace(NODE, "    node = MyFirstNode()\n", ""),
                Replace(NODE, "def main(", "node = MyFirstNode()\n\n\ndef main("),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "init_missing",
        "start",
        msg("rclpy.init() is not called"),
        NODES_MADE,
        msg("Write {written} as the first line of {function}."),
        links.RCLPY,
        fixes={"not_called": msg("Write () after rclpy.init: without them it is not called.")},
        seen=r"NotInitializedException",
        raised={NOT_INITIALIZED: _init_missing, f"{NO_CONTEXT}|{NOT_READY}": _without_init},
        fixed_by=(node_life.called_init, node_life.rclpy_init),
        examples=(
            example(
                "rclpy_init_not_called",
                Replace(NODE, "rclpy.init(args=args)", "rclpy.init"),
                fails="run.starts",
            ),
            example(
                "init_missing_before_an_executor",
                Replace(
                    NODE,
                    "    rclpy.init(args=args)\n",
                    "    executor = rclpy.executors.SingleThreadedExecutor()\n",
                ),
                Replace(
                    NODE, "rclpy.spin(node)", "executor.add_node(node)\n        executor.spin()"
                ),
                fails="run.starts",
            ),
            example(
                "rclpy_init_missing",
                Replace(NODE, "    rclpy.init(args=args)\n", ""),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "init_late",
        "start",
        msg("rclpy.init() does not run before the node is created"),
        NODES_MADE,
        msg("Move {written} to the first line of {function}."),
        links.RCLPY,
        raised={NOT_INITIALIZED: _init_late},
        fixed_by=(node_life.rclpy_init,),
        examples=(
            example(
                "rclpy_init_after_node",
                Replace(
                    NODE,
                    "    rclpy.init(args=args)\n    node = MyFirstNode()\n",
                    "    node = MyFirstNode()\n    rclpy.init(args=args)\n",
                ),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "init_arguments",
        "start",
        msg("rclpy.init() does not get its arguments as it takes them"),
        msg("rclpy.init() takes values only by their names, and the arguments are called args."),
        msg("Write {written}."),
        raised={r"\binit\(\) takes 0 positional arguments": _without_keyword},
        fixed_by=(lines.written,),
        examples=(
            example(
                "init_as_in_cpp",
                Replace(NODE, "import rclpy\nfrom", "import sys\n\nimport rclpy\nfrom"),
                Replace(NODE, "rclpy.init(args=args)", "rclpy.init(len(sys.argv), sys.argv)"),
                fails="run.starts",
            ),
            example(
                "init_args_without_keyword",
                Replace(NODE, "rclpy.init(args=args)", "rclpy.init(args)"),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "init_twice",
        "start",
        msg("rclpy.init() is called twice"),
        msg("rclpy.init() connects the program to ROS; calling it again is an error."),
        msg("Keep only one rclpy.init(args=args), in the first line of {function}."),
        links.RCLPY,
        seen=r"RuntimeError: Context\.init\(\) must only be called once",
        fixes={
            "imported": msg(
                "This file has one such call. Either this line runs twice: in a loop, or because {function} "
                "is called twice, also by a line outside of functions. Or another file calls rclpy.init() "
                "when it is imported: look in {package}/__init__.py, which should be empty. Let only one "
                "call run."
            ),
        },
        raised={r"Context\.init\(\) must only be called once": _init_twice},
        examples=(
            example(
                "init_in_the_init_file",
                Write(INIT, "import rclpy\n\nrclpy.init()\n"),
                fails="run.starts",
            ),
            example(
                "init_twice",
                Replace(
                    NODE,
                    "    rclpy.init(args=args)\n",
                    "    rclpy.init(args=args)\n    rclpy.init(args=args)\n",
                ),
                fails="run.starts",
            ),
        ),
    ),
)
