"""The mistake of a node that spins below the `with` block at whose end ROS is shut down."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.example import BODY_OF_MAIN, NODE, example
from grader.mistakes.fixes.case import Case
from grader.mistakes.fixes.node_executor import executors_of
from grader.mistakes.fixes.node_order import SPINS
from grader.mistakes.kind import Family
from grader.mistakes.recognised import Raised, RecognisedMistake, Suspect
from grader.package.edit.files import Files
from grader.package.edit.text import Splice, indent_of
from grader.package.edit.tree import Replace
from grader.package.source.module import Function, Module
from grader.package.source.names import calls_in, dotted, last_part
from grader.package.source.place import block_of, statement_at

NO_CONTEXT = (
    r"'NoneType' object does not support the context manager protocol|AttributeError: __enter__"
    r"|RuntimeError: Context must be initialized"
)
NO_ROS = (
    rf"{NO_CONTEXT}"
    r"|NotInitializedException|context is (?:not valid|invalid)|InvalidHandle"
    r"|Context must be initialized"  # on kilted
)
SHUTS = ("shutdown", "try_shutdown")
OWN_CONTEXT = """\
class Ros:

    def __enter__(self):
        rclpy.init()

    def __exit__(self, *error):
        rclpy.try_shutdown()


"""


def _below(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The line is below a `with` of the student's own that shuts ROS down at its end."""
    del match
    module = raised.module
    for block, first in _ended(raised, module):
        statements = block_of(module, block)
        after = statements[statements.index(block) + 1 :]
        last = next(s for s in after if _has(s, raised.line))
        end = last.end_lineno or last.lineno
        params = {"line": str(block.lineno), "first": str(after[0].lineno), "last": str(end)}
        found = raised.finding("below_with", params=params)
        words = {**found.words, "indented": str(first)}
        return replace(found, words=words, variant="one" if after[0].lineno == end else "")
    return None


def _ended(raised: Raised, module: Module) -> Iterator[tuple[ast.With, int]]:
    """Yield the `with` above the line that shuts ROS down, and the first line of its block."""
    for node in module.nodes:
        if not isinstance(node, ast.With) or _has(node, raised.line):
            continue
        statements = block_of(module, node)
        after = statements[statements.index(node) + 1 :] if node in statements else []
        if any(_has(s, raised.line) for s in after) and any(
            _shuts(raised, item.context_expr) for item in node.items
        ):
            yield node, node.body[0].lineno


def _has(statement: ast.stmt, line: int | None) -> bool:
    return statement.lineno <= (line or 0) <= (statement.end_lineno or statement.lineno)


def _shuts(raised: Raised, given: ast.expr) -> bool:
    """Whether a `with` calls an own function, or an own class, that shuts ROS down at its end."""
    name = last_part(dotted(given.func)) if isinstance(given, ast.Call) else ""
    for module in raised.source.modules if name else ():
        made = module.functions.get(name)
        decorators = [last_part(dotted(d)) for d in made.decorator_list] if made else []
        if made is not None and decorators == ["contextmanager"]:
            return _always_shuts(made)
        for found in module.classes:
            exits = [s for s in found.body if isinstance(s, Function) and s.name == "__exit__"]
            if found.name == name and exits:
                return _always_shuts(exits[-1])
    return False


def _always_shuts(function: Function) -> bool:
    """Whether a function shuts ROS down, and no condition decides over it."""
    conditions = (ast.If, ast.While, ast.For, ast.Match, ast.ExceptHandler)
    unsure = {n for c in ast.walk(function) if isinstance(c, conditions) for n in ast.walk(c)}
    return any(last_part(name) in SHUTS and call not in unsure for call, name in calls_in(function))


def _not_running(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """Rclpy finds no running ROS when a line spins."""
    del match
    if not any(last_part(name) == "init" for _, name in raised.source.calls):
        return None
    if (found := _ended_by_finally(raised)) is not None:
        return found
    if (found := _other_context(raised)) is not None:
        return found
    statement = statement_at(raised.module, raised.line)
    calls = [last_part(name) for _, name in calls_in(statement)] if statement is not None else []
    spins = any(name in SPINS or name.endswith("Executor") for name in calls)
    return raised.finding("ros_not_running") if raised.inside == "rclpy" and spins else None


def _other_context(raised: Raised) -> RecognisedMistake | None:
    """Look for an init in a context of its own, where spin uses the default one."""
    source = raised.source
    statement = statement_at(raised.module, raised.line)
    spins = [c for c, name in calls_in(statement) if last_part(name) in SPINS] if statement else []
    plain = [c for c in spins if len(c.args) < 2 and not c.keywords]
    inits = [c for c, name in source.calls if name in ("rclpy.init", "init")]
    given = [k.value for c in inits for k in c.keywords if k.arg == "context" and dotted(k.value)]
    if len(inits) != 1 or len(given) != 1 or not plain:
        return None
    node = dotted(plain[0].args[0]) if plain[0].args else ""
    words = {"name": dotted(given[0]), "line": str(inits[0].lineno), "node": node or "node"}
    found = raised.finding("ros_not_running")
    return replace(found, variant="context", words={**found.words, **words})


def _ended_by_finally(raised: Raised) -> RecognisedMistake | None:
    """Look for a function that returns out of a try whose finally shuts ROS down."""
    source = raised.source
    for block in (n for n in source.all_nodes if isinstance(n, ast.Try)):
        function = source.function_around(block)
        shuts = [
            call for s in block.finalbody for call, name in calls_in(s) if last_part(name) in SHUTS
        ]
        returns = [n for s in block.body for n in ast.walk(s) if isinstance(n, ast.Return)]
        called = function is not None and function is not source.main
        inside = [call for call, name in calls_in(block) if last_part(name) in SPINS]
        if function is None or not called or not shuts or not returns or inside:
            continue
        code = source.module_of(shuts[0]).text.code(shuts[0])
        params = {"name": code, "line": str(returns[0].lineno), "called": function.name}
        found = raised.finding("ros_not_running", at=shuts[0], params=params)
        return replace(found, variant="finally")
    return None


def _executor_ended(suspect: Suspect) -> RecognisedMistake | None:
    """Look for an executor that a `with` makes, and that is spun only below its block."""
    source = suspect.source
    for module in source.modules:
        for block in module.nodes:
            if not isinstance(block, ast.With):
                continue
            spins = source.calls_of("spin", within=source.function_around(block) or module.tree)
            inside = list(ast.walk(block))
            for name in _executors_of(block, executors_of(source)):
                own = [call for call in spins if dotted(call.func) == f"{name}.spin"]
                below = [call for call in own if call.lineno > (block.end_lineno or 0)]
                if below and not any(call in inside for call in own):
                    return _below_executor(suspect, block, below[0], name)
    return None


def _below_executor(
    suspect: Suspect, block: ast.With, spin: ast.Call, name: str
) -> RecognisedMistake:
    """The next line can be indented; a line that is elsewhere has to be moved."""
    module = suspect.source.module_of(spin)
    around = block_of(module, block)
    after = around[around.index(block) + 1 :] if block in around else []
    next_one = bool(after) and isinstance(after[0], ast.Expr) and after[0].value is spin
    last = block.body[-1]
    found = suspect.finding("executor_ended", spin, name=name, line=block.lineno)
    words = {
        **found.words,
        "indented": str(block.body[0].lineno),
        "below": str(last.end_lineno or last.lineno),
    }
    in_try = isinstance(module.parents.get(module.parents.get(spin, spin)), ast.Try)
    variant = "" if next_one else "in_try" if in_try else "moved"
    return replace(found, words=words, variant=variant)


def _executors_of(block: ast.With, known: set[str]) -> list[str]:
    """Return the names of executors that a `with` makes, or that it only ends."""
    names = []
    for item in block.items:
        made, name = item.context_expr, dotted(item.optional_vars) if item.optional_vars else ""
        if isinstance(made, ast.Call) and last_part(dotted(made.func)).endswith("Executor"):
            names.append(name)
        elif dotted(made) in known:
            names.append(dotted(made))
    return [name for name in names if name]


def _indented(case: Case) -> Files | None:
    """Indent the lines below the `with` as far as its block."""
    module, params = case.module, case.finding.params
    found = [
        n
        for n in (module.nodes if module is not None else [])
        if isinstance(n, ast.With) and str(n.lineno) == str(params.get("line"))
    ]
    if module is None or len(found) != 1 or found[0].body[0].lineno == found[0].lineno:
        return None
    text, block = module.text, found[0]
    inner, outer = (indent_of(text.line(n)) for n in (block.body[0].lineno, block.lineno))
    rows = range(int(params.get("first", 0)), int(params.get("last", 0)) + 1)
    starts = [text.start_of(row) for row in rows if text.line(row).strip()]
    return case.changed(module, *(Splice(at, at, inner.removeprefix(outer)) for at in starts))


_node = Family("node", links.RCLPY)
KINDS = (
    _node(
        "below_with",
        "shutdown",
        msg("The node is used below the with block that shuts ROS down"),
        msg(
            "At the end of its block, the with in line {line} shuts ROS down. The lines below the block "
            "run after that, and without ROS no node can be created or spin."
        ),
        msg(
            "Move lines {first} to {last} into the block of the with: indent them further, so that line "
            "{first} begins below the beginning of line {indented}."
        ),
        fixes={
            "one": msg(
                "Move line {first} into the block of the with: indent it as far as line {indented}."
            )
        },
        raised={NO_ROS: _below},
        fixed_by=(_indented,),
        examples=(
            example(
                "spin_below_a_with_of_ros",
                Replace(NODE, "class MyFirstNode(", f"{OWN_CONTEXT}class MyFirstNode("),
                Replace(
                    NODE,
                    BODY_OF_MAIN,
                    "    with Ros():\n        node = MyFirstNode()\n    rclpy.spin(node)\n",
                ),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "ros_not_running",
        "shutdown",
        msg("ROS is not running at this line"),
        msg(
            "rclpy works only between rclpy.init() and the shutdown. On this line there is no running ROS: "
            "it has been shut down before, or rclpy.init() has not run."
        ),
        msg(
            "Follow {function} from its first line to this line, with all that it calls, and find what "
            "shuts ROS down before it: rclpy.shutdown(), rclpy.try_shutdown(), the end of a with block, or "
            "Ctrl+C, which ends spin. This line must run before that, or not at all."
        ),
        whys={
            "context": msg(
                "rclpy.init(context={name}) in line {line} starts ROS in the context {name} only. spin "
                "without an executor uses the default context, and ROS does not run there."
            ),
            "finally": msg(
                "The lines of a finally run as soon as its try is left, also by a return: {called} "
                "returns in line {line}, and {name} shuts ROS down before anything spins."
            ),
        },
        fixes={
            "context": msg(
                "Delete context={name} from rclpy.init, and the context that the node and the "
                "clean-up get: then all use the default one. Or write instead of this line: executor = "
                "rclpy.executors.SingleThreadedExecutor(context={name}), executor.add_node({node}) and "
                "executor.spin(), each on a line of its own."
            ),
            "finally": msg(
                "Delete the try and the finally of {called}, but keep the lines of the try. Write {name} "
                "as the last line of {function} instead, below the line that spins."
            ),
        },
        raised={NO_CONTEXT: _not_running},
        examples=(
            example(
                "context_of_its_own_without_an_executor",
                Replace(
                    NODE,
                    "super().__init__('my_first_node')",
                    "super().__init__('my_first_node', context=CONTEXT)",
                ),
                Replace(
                    NODE, "class MyFirstNode(", "CONTEXT = rclpy.Context()\n\n\nclass MyFirstNode("
                ),
                Replace(NODE, "rclpy.init(args=args)", "rclpy.init(args=args, context=CONTEXT)"),
                fails="run.starts",
            ),
            example(
                "finally_of_a_function_that_returns_the_node",
                Replace(
                    NODE,
                    "def main(",
                    "def made():\n    try:\n        return MyFirstNode()\n    finally:\n"
                    "        rclpy.try_shutdown()\n\n\ndef main(",
                ),
                Replace(NODE, "node = MyFirstNode()", "node = made()"),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "executor_ended",
        "spin",
        msg("The executor is spun below its with block"),
        msg(
            "The with in line {line} shuts {name} down at the end of its block. This line is below "
            "the block: there, {name}.spin() returns at once."
        ),
        msg("Indent this line as far as line {indented}: then it is in the block of the with."),
        links.EXECUTORS,
        fixes={
            "moved": msg(
                "Move this line into the block of the with: below line {below}, indented as far as "
                "line {indented}."
            ),
            "in_try": msg(
                "The with belongs in this try. Cut lines {line} to {below}, paste them above this line, "
                "and indent them by 4 spaces. Then indent this line by 4 spaces too."
            ),
        },
        behind={"run.exits_at_once": _executor_ended},
        deletes=("moved",),
        examples=(
            example(
                "executor_spun_below_its_with",
                Replace(
                    NODE,
                    "from rclpy.node",
                    "from rclpy.executors import SingleThreadedExecutor\nfrom rclpy.node",
                ),
                Replace(
                    NODE,
                    "        rclpy.spin(node)\n",
                    "        with SingleThreadedExecutor() as executor:\n"
                    "            executor.add_node(node)\n        executor.spin()\n",
                ),
                fails="run.starts",
            ),
            example(
                "executor_spun_far_below_its_with",
                Replace(
                    NODE,
                    "from rclpy.node",
                    "from rclpy.executors import SingleThreadedExecutor\nfrom rclpy.node",
                ),
                Replace(
                    NODE,
                    "    try:\n",
                    "    with SingleThreadedExecutor() as executor:\n"
                    "        executor.add_node(node)\n    try:\n",
                ),
                Replace(NODE, "        rclpy.spin(node)\n", "        executor.spin()\n"),
                fails="run.starts",
            ),
        ),
    ),
)
