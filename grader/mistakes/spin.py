"""Mistakes in spinning the node, and in how it ends."""

from __future__ import annotations

import ast
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.example import NODE, SILENT, example
from grader.mistakes.fixes import lines, node_executor, node_life
from grader.mistakes.hidden import hides
from grader.mistakes.kind import Family
from grader.mistakes.placeholders import placeholder_values
from grader.mistakes.recognised import RecognisedMistake, Suspect
from grader.package.edit.tree import Edit, Replace, Write
from grader.package.source.endless import Loop, idle_loop, methods_run_by
from grader.package.source.module import Function
from grader.package.source.names import SPINS as SPIN_CALLS
from grader.package.source.names import calls_in, dotted, last_part
from grader.package.source.node import NodeSource
from grader.package.source.spinning_loop import loop_around

ENDED_BY = ("SystemExit", "KeyboardInterrupt")
EXITS = (
    *("exit", "quit", "sys.exit", "os._exit"),
    *("rclpy.shutdown", "rclpy.try_shutdown", "self.destroy_node"),
)
SPUN = ("spin", "rclpy.spin", "rclpy.spin_once")
ERRORS = ("Error", "Exception")
SPIN = msg("rclpy.spin(node) waits and calls the callbacks when they are due, until Ctrl+C.")


def _spins(suspect: Suspect) -> bool:
    names = {last_part(name) for _, name in suspect.source.calls}
    return bool(names & {"spin", "spin_until_future_complete"})


def _once(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a spin_once that is in no loop, where nothing else spins."""
    source = suspect.source
    for call, name in () if _spins(suspect) else source.calls:
        if last_part(name) == "spin_once" and loop_around(source, call) is None:
            node = str(placeholder_values(suspect.assignment, source)["node"])
            wanted = node_executor.spun_by(source, node, name)
            if wanted.startswith("rclpy.spin("):
                return suspect.finding("spin_once", call)
            code = source.module_of(call).text.code(call)
            found = suspect.finding("spin_once", call, name=code, written=wanted)
            return replace(found, variant="executor")
    return None


def _not_called(suspect: Suspect) -> RecognisedMistake | None:
    if _spins(suspect):
        return None
    node = placeholder_values(suspect.assignment, suspect.source)["node"]
    for part in suspect.source.all_nodes:
        named = part.value if isinstance(part, ast.Expr) else None
        name = dotted(named) if isinstance(named, ast.Attribute | ast.Name) else ""
        if named is not None and (name in SPUN or name.endswith((".spin", ".spin_once"))):
            once = name if _in_loop(suspect, named) else name.removesuffix("_once")
            own = name.rpartition(".")[0] in executors(suspect)
            wanted = f"{once}()" if own else f"{once}({node})"
            return suspect.finding("spin_not_called", named, name=name, wanted=wanted)
    return None


def _in_loop(suspect: Suspect, node: ast.AST) -> bool:
    around = suspect.source.module_of(node).around(node)
    return any(isinstance(n, ast.While | ast.For) for n in around)


def executors(suspect: Suspect) -> set[str]:
    """Return the variables of executors."""
    return node_executor.executors_of(suspect.source)


def _missing(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a node without spin, not even as in Thread(target=rclpy.spin)."""
    source = suspect.source
    every = (n for module in (*source.modules, *source.beside) for n in module.nodes)
    named = (n for n in every if isinstance(n, ast.Attribute | ast.Name))
    if any(last_part(dotted(n)) in SPIN_CALLS for n in named):
        return None
    for call, name in source.calls:
        before, _, method = name.rpartition(".")
        if method == "add_node" and before in executors(suspect):
            found = suspect.finding("spin_missing", call, name=before)
            return replace(found, variant="executor")
    return suspect.finding("spin_missing", suspect.place_of_function)


def _sleep_loop(suspect: Suspect) -> RecognisedMistake | None:
    """Look for the loop that does a timer's work: it logs, publishes or calls a function, and sleeps."""
    source = suspect.source
    for loop in (n for n in source.all_nodes if isinstance(n, ast.While | ast.For)):
        pauses = [call for call, name in calls_in(loop) if last_part(name) in PAUSES]
        if pauses and _works(source, loop):
            found = suspect.finding("sleep_loop", pauses[0])
            return _without_loop(suspect, loop, found)
    return None


def _works(source: NodeSource, loop: Loop) -> bool:
    """Whether a loop logs, publishes, calls a function of the student's, or prints until Ctrl+C."""
    names = {last_part(name) for _, name in calls_in(loop)}
    own = {node.name for node in source.all_nodes if isinstance(node, Function)}
    prints = isinstance(loop, ast.While) and "print" in names
    return bool(names & (own | {"publish"}) or source.logs(loop) or prints)


def _without_loop(suspect: Suspect, loop: Loop, found: RecognisedMistake) -> RecognisedMistake:
    """Return a loop with sleep, with what to write instead of it."""
    source = suspect.source
    if source.node_class is None:
        word = "while" if isinstance(loop, ast.While) else "for"
        words = {**found.words, "loop": word, "wanted": f"rclpy.spin({found.words['node']})"}
        return replace(found, variant="function", words=words)
    threads = source.calls_of("Thread")
    inside = {part for each in (loop, *threads) for part in ast.walk(each)}
    spins = [call for call in source.calls_of("spin") if call not in inside]
    if spins:
        variant = "beside" if threads else "spun"
        return replace(found, variant=variant, words={**found.words, "line": spins[0].lineno})
    if threads:
        words = {**found.words, "lines": threads[0].lineno}
        return replace(found, variant="threaded", words=words)
    return found


def _nowhere(suspect: Suspect) -> RecognisedMistake | None:
    return _idle(suspect) or _missing(suspect)


def _idle(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a loop that waits where the node is to be spun."""
    source, function = suspect.source, suspect.function
    loop = idle_loop(source, function) if function else None
    names = source.node_variables
    if function is None or loop is None or len(names) != 1 or executors(suspect):
        return None
    made = [n for n in ast.walk(function) if isinstance(n, ast.Assign) and n.lineno < loop.lineno]
    if not any(dotted(target) in names for statement in made for target in statement.targets):
        return None
    found = suspect.finding("spin_missing", loop, node=next(iter(names)))
    return replace(found, variant="loop")


def _exits(suspect: Suspect) -> RecognisedMistake | None:
    """Look for what ends the node in the callback: a line of its own, or one in the except for an error."""
    source, after_error = suspect.source, None
    parts = [] if source.callback is None else [source.callback]
    parts += [method for part in [*parts] for method in methods_run_by(source, part)]
    ends = (n for part in parts for n in ast.walk(part) if isinstance(n, ast.Raise | ast.Call))
    for node in ends:
        raised = dotted(node.exc) if isinstance(node, ast.Raise) and node.exc else ""
        called = dotted(node.func) if isinstance(node, ast.Call) else ""
        if not raised.startswith(ENDED_BY) and called not in EXITS:
            continue
        module = source.module_of(node)
        found = suspect.finding("exits", node, name=called or raised)
        handlers = [n for n in module.around(node) if isinstance(n, ast.ExceptHandler)]
        if handlers:
            if not hides(handlers[0]):  # (or else: node.error_hidden)
                after_error = after_error or _after_error(suspect, found, handlers[0])
            continue
        statement = module.parents.get(node) if isinstance(node, ast.Call) else node
        around = module.parents.get(statement) if statement is not None else None
        if isinstance(around, ast.If) and around.orelse:
            continue  # (without this line, the other branch would have to go too)
        alone = isinstance(around, ast.If) and around.body == [statement]
        return replace(found, variant="if" if alone else "")
    return after_error


def _after_error(
    suspect: Suspect, found: RecognisedMistake, handler: ast.ExceptHandler
) -> RecognisedMistake | None:
    """Return an end in an except: a line of its try raised an error, which is the cause."""
    caught = dotted(handler.type) if handler.type is not None else "Exception"
    around = suspect.source.module_of(handler).parents.get(handler)
    inside = suspect.source.function_around(handler) is not None
    if not isinstance(around, ast.Try) or not inside or not caught.endswith(ERRORS):
        return None
    words = {**found.words, "line": str(around.lineno)}
    return replace(found, variant="in_except", words=words)


IMPORT = Replace(NODE, "import rclpy\nfrom", "import threading\nimport time\nimport rclpy\nfrom")
SPINS = """\
    try:
        rclpy.spin(node)
    except KeyboardInterrupt:
        pass
    finally:
        node.destroy_node()
        rclpy.try_shutdown()
"""
LOOPS = """\
    try:
        while rclpy.ok():
            time.sleep(1.0)
            node.timer_callback()
    except KeyboardInterrupt:
        pass
    rclpy.try_shutdown()
"""
BESIDE = "    threading.Thread(target=rclpy.spin, args=(node,), daemon=True).start()\n"
PROCEDURAL = """\
#!/usr/bin/env python3
import time

import rclpy


def main():
    rclpy.init()
    node = rclpy.create_node('my_first_node')
    n = 0
    while rclpy.ok():
        time.sleep(1)
        node.get_logger().info('Hello time: ' + str(n))
        n += 1


main() if __name__ == '__main__' else None
"""


def _loop(new: str = LOOPS) -> tuple[Edit, ...]:
    """Return the edits that write a loop instead of the timer and of spin."""
    no_timer = Replace(NODE, "self.create_timer(1.0, self.timer_callback)", "pass")
    return IMPORT, no_timer, Replace(NODE, SPINS, new)


INTO_FUNCTION = msg(
    "Write a function def tick(): above the {loop} loop, and move the loop's other lines into it, "
    "without spin_once and sleep. If they change a variable, its first line is nonlocal (for a "
    "variable outside of all functions: global) with the variable's name. Then write two lines "
    "instead of the whole {loop} loop: {node}.create_timer({period}, tick), and below it {wanted}."
)
PAUSES = ("sleep", "sleep_for", "sleep_until")
BESIDE_SPIN = msg(
    "A loop with sleep beside rclpy.spin does not follow ROS time: in a simulation or a replay it runs "
    "at the wrong speed, and it does not stop when time stops. A timer follows ROS time."
)
_node = Family("node", links.FIRST_NODE)
KINDS = (
    _node(
        "sleep_loop",
        "spin",
        msg("A loop with sleep() does the work of a timer"),
        msg(
            "While your loop runs or sleeps, ROS cannot call the node's callbacks: ros2 param list "
            "and ros2 service call get no answer, no message reaches the node, and it does not "
            "follow simulated time."
        ),
        msg(
            "Put what the loop does into a method, without the sleep, if it is not in one already. Call "
            "the method with a timer that __init__ creates: "
            "self.create_timer({period}, self.{callback}), and write rclpy.spin({node}) in "
            "{function} instead of the loop."
        ),
        links.EXECUTORS,
        whys={"threaded": BESIDE_SPIN, "beside": BESIDE_SPIN},
        fixes={
            "function": INTO_FUNCTION,
            **dict.fromkeys(
                ("spun", "beside"),
                msg(
                    "Put what the loop does into a method, without the sleep, if it is not in one already. Call "
                    "the method with a timer that __init__ creates: self.create_timer({period}, "
                    "self.{callback}), and delete the loop: line {line} spins the node."
                ),
            ),
            "threaded": msg(
                "Put what the loop does into a method, without the sleep, if it is not in one already. "
                "Call the method with a timer that __init__ creates: self.create_timer({period}, self.{callback}). Then write "
                "rclpy.spin({node}) in {function} instead of the loop, and delete the thread that "
                "spins the node now (lines: {lines})."
            ),
        },
        behind={"run.never_spins": _sleep_loop},
        examples=(
            example(
                "sleep_loop_above_spin",
                *_loop(LOOPS.replace("    except", "        rclpy.spin(node)\n    except")),
                fails="run.spins",
            ),
            example(
                "rate_in_a_loop_of_main",
                Replace(
                    NODE,
                    "self.create_timer(1.0, self.timer_callback)",
                    "self.rate = self.create_rate(1)",
                ),
                Replace(
                    NODE,
                    "        rclpy.spin(node)\n",
                    "        while rclpy.ok():\n            node.timer_callback()\n"
                    "            node.rate.sleep()\n",
                ),
                fails="run.spins",
                also={"run.output": "run.stops"},
                blocks=("run.period",),
            ),
            example(
                "sleep_loop",
                *_loop(),
                fails="run.spins",
                note="right lines and times, but no callback is ever called",
            ),
            example(
                "procedural_sleep",
                Write(NODE, PROCEDURAL, 0o755),
                fails="run.spins",
                note="ends with the KeyboardInterrupt traceback",
            ),
            example(
                "sleep_loop_beside_spin",
                *_loop(BESIDE + LOOPS),
                fails="run.spins",
                note="it answers, but ROS time stands still",
            ),
        ),
    ),
    _node(
        "spin_once",
        "spin",
        msg("spin_once is called instead of spin"),
        msg(
            "rclpy.spin_once handles one callback and returns: it does not wait for more callbacks."
        ),
        msg("Write rclpy.spin({node})."),
        links.EXECUTORS,
        whys={
            "executor": msg(
                "{name} handles one callback and returns: it does not wait for more callbacks."
            ),
        },
        fixes={
            "executor": msg("Write {written} instead of {name}."),
        },
        behind={"run.exits_at_once": _once, "run.ended_early": _once},
        fixed_by=(lines.written, node_life.spin),
        examples=(
            example(
                "spin_once",
                Replace(NODE, "rclpy.spin(node)", "rclpy.spin_once(node)"),
                fails="run.starts",
                note="one line on the wall clock; none under use_sim_time, because the first message on /clock is the only callback that it runs",
            ),
        ),
    ),
    _node(
        "spin_not_called",
        "spin",
        msg("The line that is to spin the node is not a call: the () is missing"),
        msg("A function's name alone does nothing; only calling it does."),
        msg("Write {wanted}."),
        links.EXECUTORS,
        behind={"run.exits_at_once": _not_called, "run.never_spins": _not_called},
        fixed_by=(node_life.called_spin, node_life.spin),
        examples=(
            example(
                "spin_not_called",
                Replace(NODE, "rclpy.spin(node)", "rclpy.spin"),
                fails="run.starts",
            ),
            example(
                "executor_spin_not_called",
                Replace(
                    NODE,
                    "rclpy.spin(node)",
                    "executor = SingleThreadedExecutor()\n        executor.add_node(node)\n"
                    "        executor.spin",
                ),
                Replace(
                    NODE,
                    "from rclpy.node",
                    "from rclpy.executors import SingleThreadedExecutor\nfrom rclpy.node",
                ),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "spin_missing",
        "spin",
        msg("Nothing that ros2 run starts spins the node"),
        SPIN,
        msg("Call rclpy.spin({node}) in {function}, after creating the node."),
        links.EXECUTORS,
        whys={
            "loop": msg(
                "This loop keeps the program alive, but it calls no callbacks. rclpy.spin(node) "
                "waits too, and calls the callbacks when they are due, until Ctrl+C."
            ),
            "executor": msg(
                "add_node only gives the node to the executor. {name}.spin() waits and calls the "
                "callbacks when they are due."
            ),
        },
        fixes={
            "executor": msg("Write {name}.spin() below this line."),
            "loop": msg("Write rclpy.spin({node}) instead of this loop."),
        },
        behind={
            "run.exits_at_once": _missing,
            "run.never_spins": _nowhere,
        },
        fixed_by=(node_life.executor, node_life.idle_loop, node_life.spin),
        examples=(
            example(
                "timer_and_sleep_loop",
                Replace(NODE, "import rclpy\nfrom", "import time\nimport rclpy\nfrom"),
                Replace(NODE, SPINS, LOOPS.replace("            node.timer_callback()\n", "")),
                fails="run.spins",
                blocks=("run.output", *SILENT),
                note="the timer is there, and nothing calls it",
            ),
            example(
                "executor_not_spun",
                Replace(
                    NODE,
                    "rclpy.spin(node)",
                    "executor = SingleThreadedExecutor()\n        executor.add_node(node)",
                ),
                Replace(
                    NODE,
                    "from rclpy.node",
                    "from rclpy.executors import SingleThreadedExecutor\nfrom rclpy.node",
                ),
                fails="run.starts",
            ),
            example(
                "spin_missing",
                Replace(NODE, "        rclpy.spin(node)\n", "        pass\n"),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "exits",
        "spin",
        msg("The node ends itself"),
        msg("{name} ends the program; a node runs until Ctrl+C."),
        msg("Delete this line."),
        links.EXECUTORS,
        whys={
            "in_except": msg(
                "A line of the try in line {line} raises an error. This line is in the except for it: {name} "
                "ends the program, and Python shows no traceback of the error."
            )
        },
        fixes={
            "if": msg("Delete this line and the if above it."),
            "in_except": msg(
                "Write raise instead of this line, and run the node again: the traceback then names the "
                "error and the line that raises it. Correct that line."
            ),
        },
        behind=dict.fromkeys(("run.ended_early", "run.stops", "run.exits_at_once"), _exits),
        fixed_by=(lines.deleted,),
        deletes=("",),
        examples=(
            example(
                "three_then_exit",
                Replace(
                    NODE,
                    "self.counter_ += 1",
                    (
                        "self.counter_ += 1\n"
                        "        if self.counter_ == 3:\n"
                        "            raise SystemExit"
                    ),
                ),
                fails="run.output",
                blocks=("run.interrupt",),
            ),
        ),
    ),
    _node(
        "shutdown_not_called",
        "shutdown",
        msg("The () after rclpy.shutdown is missing"),
        msg("A function's name alone does nothing; only calling it does."),
        msg("Write rclpy.try_shutdown()."),
        links.RCLPY,
    ),
)
