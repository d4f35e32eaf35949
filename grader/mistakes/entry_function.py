"""Mistakes with which a node does not start: the entry point's function, and what it waits for."""

from __future__ import annotations

import ast
import re
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.base.nearest import nearest
from grader.mistakes import links
from grader.mistakes.example import BODY_OF_MAIN, NODE, example
from grader.mistakes.fixes import node_life, node_main, node_names
from grader.mistakes.kind import Family
from grader.mistakes.recognised import Raised, RecognisedMistake, Suspect
from grader.package.edit.tree import Replace
from grader.package.source.guard import guarded_code
from grader.package.source.module import Function
from grader.package.source.names import dotted
from grader.package.source.node import NodeSource
from grader.package.source.sleeps import SLEEPS

WAITS = ("input", *SLEEPS)
NO_FUNCTION = r"AttributeError: module '[\w.]{1,200}' has no attribute '(?P<function>\w{1,120})'"
MAIN = 'def main(args=None):\n    """Run the node until Ctrl+C."""\n'
LOOKED_FOR = msg(
    "The entry point ends in :{function}, so Python looks for a function {function} at the top "
    "level of the module."
)


def _close_function(raised: Raised) -> str:
    """Return the function with nearly the required name, or the only one, which starts ROS."""
    wanted = raised.assignment.function
    only = node_names.only_starter(raised.source, wanted)
    return nearest(wanted, raised.source.entry.functions) or (only.name if only is not None else "")


def _function_missing(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    if match["function"] != raised.assignment.function or _close_function(raised):
        return None
    entry = raised.source.entry
    if any(isinstance(n, Function) and n.name == match["function"] for n in entry.nodes):
        return None  # (it is there, in a block)
    guard = guarded_code(entry.tree)
    if guard is None:
        return _absent(raised)
    return replace(raised.finding("main_missing", at=guard), variant="guarded")


def _absent(raised: Raised) -> RecognisedMistake:
    """Return that there is no function, and what the class is called."""
    own = raised.source.node_class
    return raised.finding("main_missing", made=own.name if own is not None else "MyNode")


def _function_misspelt(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    function, close = raised.assignment.function, _close_function(raised)
    if match["function"] != function or not close:
        return None
    at = raised.source.entry.functions[close]
    return raised.finding("main_misspelt", at=at, name=close, close=function)


def _main_wants(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    if match["function"] != raised.assignment.function:
        return None
    return raised.finding("main_wants_args", at=raised.source.main)


def _main_empty(suspect: Suspect) -> RecognisedMistake | None:
    source = suspect.source
    made = source.makes_node() or any(n.endswith("create_node") for _, n in source.calls)
    if source.node_class is None or made or _hands_class_on(source):
        return None
    return suspect.finding("main_empty", suspect.place_of_function, name=source.node_class.name)


def _hands_class_on(source: NodeSource) -> bool:
    """Whether something may make the node without the class's name: cls(), or what gets the class."""
    names = (n for n in source.all_nodes if isinstance(n, ast.Name | ast.Attribute))
    used = (n for n in names if dotted(n) == "cls" or source.is_node_class(n))
    return any(not isinstance(source.module_of(n).parents.get(n), ast.ClassDef) for n in used)


_node = Family("node", links.FIRST_NODE)
KINDS = (
    _node(
        "main_missing",
        "start",
        msg("The module does not have the entry point's function"),
        LOOKED_FOR,
        msg(
            "Write it at the end of the file: def {function}(args=None): and, indented below it, "
            "rclpy.init(args=args), node = {made}() and rclpy.spin(node)."
        ),
        links.DEVELOPING,
        whys={
            "guarded": msg(
                "The entry point ends in :{function}, so Python looks for a function {function} at "
                "the top level of the module. The lines below this guard run only if the file is "
                "started directly: ros2 run imports the file, and __name__ is not '__main__' then."
            ),
        },
        fixes={
            "guarded": msg(
                "Put these lines into the function: write def {function}(args=None): instead of "
                "this line. Then write at the end of the file, without indentation, "
                "if __name__ == '__main__': and below it, indented, {function}()"
            ),
        },
        seen=r"AttributeError: module '[\w.]{1,200}' has no attribute '(?P<function>main)'",
        raised={NO_FUNCTION: _function_missing},
        fixed_by=(node_main.out_of_guard, node_names.main, node_main.appended),
        examples=(
            example(
                "main_under_guard",
                Replace(NODE, "def main(args=None):", "if __name__ == '__main__':"),
                Replace(NODE, "args=args", ""),
                Replace(NODE, "\n\nif __name__ == '__main__':\n    main()\n", ""),
                fails="run.starts",
            ),
            example(
                "main_missing",
                Replace(NODE, MAIN, ""),
                Replace(NODE, BODY_OF_MAIN, ""),
                Replace(NODE, "if __name__ == '__main__':\n    main()\n", ""),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "main_misspelt",
        "start",
        msg("The entry point's function has a different name"),
        LOOKED_FOR,
        msg("Rename {name} to {function}, also where it is called."),
        links.DEVELOPING,
        raised={NO_FUNCTION: _function_misspelt},
        fixed_by=(node_names.main,),
        examples=(
            example(
                "main_of_another_name",
                Replace(NODE, "def main(", "def run("),
                Replace(NODE, "\n    main()\n", "\n    run()\n"),
                fails="run.starts",
            ),
            example(
                "main_misspelt",
                Replace(NODE, "def main(", "def mein("),
                Replace(NODE, "\n    main()\n", "\n    mein()\n"),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "main_wants_args",
        "start",
        msg("The entry point's function needs an argument, but is called without any"),
        msg("The executable calls {function}() without arguments."),
        msg("Give each parameter of {function} a default, as in: def {function}(args=None):"),
        seen=r"TypeError: (?P<function>main)\(\) missing \d{1,3} required positional argument",
        raised={
            r"(?<![\w.])(?P<function>\w{1,120})\(\) missing \d{1,3} required positional": _main_wants
        },
        fixed_by=(node_life.main_arguments,),
        examples=(
            example(
                "main_wants_args",
                Replace(NODE, "def main(args=None)", "def main(args)"),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "main_empty",
        "start",
        msg("The entry point's function does not create the node"),
        msg(
            "The executable calls {function}() and ends when it returns. A class alone does "
            "nothing."
        ),
        msg(
            "Write in {function}: rclpy.init(args=args), then node = {name}(), then "
            "rclpy.spin(node)."
        ),
        links.NODES,
        behind={
            "run.exits_at_once": _main_empty,
            "run.no_node": _main_empty,
            "run.never_spins": _main_empty,
        },
        examples=(
            example(
                "main_empty",
                Replace(
                    NODE,
                    BODY_OF_MAIN,
                    "    pass\n",
                ),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "guard_misspelt",
        "start",
        msg("The guard does not compare with '__main__'"),
        msg(
            "Python sets __name__ to '__main__' in a file that is started directly. With any "
            "other text the line below never runs. (ros2 run does not need it.)"
        ),
        msg("Write: if __name__ == '__main__':"),
    ),
    _node(
        "guard_without_call",
        "start",
        msg("The () below the guard is missing"),
        msg(
            "A function's name alone does nothing; only calling it does. (ros2 run does not need "
            "this line, but python3 with the file does.)"
        ),
        msg("Write {name}() on this line."),
    ),
    _node(
        "guard_inside",
        "start",
        msg("The guard is inside of a function"),
        msg(
            "Nothing calls {name} if the file is started directly, because the call is inside of "
            "{name}. (ros2 run does not need it.)"
        ),
        msg("Move this line and the line below it to the left margin, below the function."),
    ),
)
