"""Mistakes about which node is made, given to the executor and spun, and about what is called."""

from __future__ import annotations

import ast
import re
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.example import NODE, SILENT, example
from grader.mistakes.fixes import node_executor, node_main
from grader.mistakes.kind import Family
from grader.mistakes.recognised import Raised, RecognisedMistake, Suspect
from grader.mistakes.spin import executors
from grader.package.edit.tree import Replace
from grader.package.source.counter import targets_of
from grader.package.source.guard import called_on_import
from grader.package.source.module import Function
from grader.package.source.names import dotted

SPINS = ("spin", "spin_once", "spin_until_future_complete")
GUARD = msg(
    "ros2 run imports the file and then calls {name} itself. This call runs during the import, "
    "before that: {name} is called twice."
)


SPINS_ALL = msg(
    "The spin of an executor takes no node: it calls the callbacks of all nodes that were added to "
    "it with add_node."
)


def _executor_without_node(suspect: Suspect) -> RecognisedMistake | None:
    """Look for an executor that is spun and never gets a node."""
    source = suspect.source
    given = {
        dotted(n.value)
        for n in source.all_nodes
        if isinstance(n, ast.Attribute) and n.attr == "add_node"
    }
    for call, name in source.calls:
        owner, _, method = name.rpartition(".")
        if method not in SPINS or owner not in executors(suspect) - given:
            continue
        if not node_executor.is_passed(source, owner) and len(source.node_variables) == 1:
            code = source.module_of(call).text.code(call)
            params = {"name": owner, "node": min(source.node_variables), "written": code}
            return suspect.finding("executor_without_node", call, **params)
    return None


def _node_to_spin(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """Look for a node that is given to the spin of an executor, and not to add_node."""
    del match
    source = raised.source
    for call in source.calls_of("spin"):
        owner = dotted(call.func).rpartition(".")[0]
        if call.lineno != raised.line or len(call.args) != 1 or not owner:
            continue
        code = source.module_of(call).text.code
        added = any(dotted(add.func) == f"{owner}.add_node" for add in source.calls_of("add_node"))
        node = code(call.args[0])
        found = raised.finding("executor_without_node", at=call, name=owner, node=node)
        return replace(found, variant="added" if added else "given")
    return None


def _spins_in_init(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a spin in __init__; what is below it runs only after Ctrl+C."""
    init = suspect.source.methods.get("__init__")
    for call in suspect.source.calls_of("spin", within=init) if init is not None else ():
        around = suspect.source.module_of(call).around(call)
        inner = next((part for part in around if isinstance(part, Function | ast.Lambda)), None)
        end = call.end_lineno or call.lineno
        if inner is init and any(getattr(n, "lineno", 0) > end for n in ast.walk(init or call)):
            return suspect.finding("spin_in_init", call, name=ast.unparse(call))
    return None


def _main_at_import(suspect: Suspect) -> RecognisedMistake | None:
    function = suspect.function
    call = called_on_import(suspect.source.entry.tree, function.name) if function else None
    if call is None or function is None:
        return None
    return suspect.finding("main_at_import", call, name=function.name)


def _main_twice(suspect: Suspect) -> RecognisedMistake | None:
    function = suspect.function
    if function is None:
        return None
    same = [
        s
        for s in suspect.source.entry.tree.body
        if isinstance(s, Function) and s.name == function.name
    ]
    if len(same) < 2:
        return None
    return suspect.finding("main_twice", same[-1], name=function.name, line=same[0].lineno)


def _hides_class(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """Look for a variable that gets the name of its class in the function that makes the object."""
    name = match["name"]
    classes = {*raised.source.class_names, *(c.name for c in raised.module.classes)}
    for node in raised.module.nodes if name in classes else ():
        if isinstance(node, ast.Assign) and node.lineno == raised.line and name in targets_of(node):
            return raised.finding("variable_hides_class", at=node, name=name)
    return None


OWN_EXECUTOR = (
    Replace(
        NODE,
        "rclpy.spin(node)",
        (
            "executor = SingleThreadedExecutor()\n"
            "        executor.add_node(node)\n"
            "        executor.spin()"
        ),
    ),
    Replace(
        NODE,
        "from rclpy.node",
        "from rclpy.executors import SingleThreadedExecutor\nfrom rclpy.node",
    ),
)


_node = Family("node", links.EXECUTORS)
KINDS = (
    _node(
        "variable_hides_class",
        "start",
        msg("The variable has the same name as the class"),
        msg("In a function that sets {name}, {name} means the variable, which has no value yet."),
        msg(
            "Give the variable another name than {name} in this line, and write that name where the "
            "lines below it use the variable."
        ),
        links.PYTHON_CLASSES,
        raised={r"UnboundLocalError: .{0,60}'(?P<name>\w{1,120})'": _hides_class},
        examples=(
            example(
                "variable_hides_class",
                Replace(NODE, "node = MyFirstNode()", "MyFirstNode = MyFirstNode()"),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "main_twice",
        "spin",
        msg("The file defines the function of the entry point twice"),
        msg("The later definition replaces the earlier one, on line {line}, which is never run."),
        msg("Keep the one that you need, and delete the other."),
        links.PYTHON_CLASSES,
        behind={"run.exits_at_once": _main_twice, "run.no_node": _main_twice},
        examples=(
            example(
                "main_twice",
                Replace(
                    NODE,
                    "if __name__ ==",
                    "def main():\n    print('Hi from my_robot_controller.')\n\n\nif __name__ ==",
                ),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "main_at_import",
        "shutdown",
        msg("The file calls the function of the entry point when it is imported"),
        GUARD,
        msg("Write if __name__ == '__main__': above this line, and indent the line."),
        behind={"run.ignores_interrupt": _main_at_import},
        fixed_by=(node_main.under_guard,),
        examples=(
            example(
                "main_at_import",
                Replace(NODE, "if __name__ == '__main__':\n    main()", "main()"),
                *OWN_EXECUTOR,
                fails="run.interrupt",
            ),
        ),
    ),
    _node(
        "spin_in_init",
        "timer",
        msg("__init__ spins the node, and never comes to its end"),
        msg("{name} waits until Ctrl+C. The lines below it do not run before that."),
        msg("Remove this line. In {function}, spin the node after it was made: rclpy.spin({node})"),
        behind={"run.no_lines": _spins_in_init},
        examples=(
            example(
                "spin_in_init",
                Replace(
                    NODE,
                    "        self.counter_ = 0\n",
                    "        rclpy.spin(self)\n        self.counter_ = 0\n",
                ),
                fails="run.output",
                blocks=SILENT,
            ),
        ),
    ),
    _node(
        "executor_without_node",
        "spin",
        msg("The executor has no node"),
        msg(
            "An executor calls the callbacks of the nodes that were added to it, and of no others."
        ),
        msg("Write {name}.add_node({node}) on a line above {written}, and outside of a loop."),
        whys={
            "given": SPINS_ALL,
            "added": SPINS_ALL,
        },
        fixes={
            "given": msg(
                "Write {name}.add_node({node}) on a line of its own above this line, and "
                "{name}.spin() in this line."
            ),
            "added": msg("Write {name}.spin() in this line: {name} has the node already."),
        },
        raised={r"TypeError: \w{1,60}\.spin\(\) takes 1 positional argument but 2": _node_to_spin},
        behind={"run.never_spins": _executor_without_node, "run.no_lines": _executor_without_node},
        examples=(
            example(
                "executor_without_node",
                *OWN_EXECUTOR,
                Replace(NODE, "        executor.add_node(node)\n", ""),
                fails="run.spins",
                blocks=("run.output", *SILENT),
            ),
            example(
                "executor_spins_with_a_node",
                *OWN_EXECUTOR,
                Replace(NODE, "        executor.add_node(node)\n", ""),
                Replace(NODE, "executor.spin()", "executor.spin(node)"),
                fails="run.starts",
            ),
        ),
    ),
)
