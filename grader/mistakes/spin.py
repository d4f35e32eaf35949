"""Mistakes in spinning the node, and in how it ends."""

from __future__ import annotations

import ast
import re
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.mistakes import links, stop_in_branch
from grader.mistakes.example import NODE, SILENT, example
from grader.mistakes.fixes import lines, node_executor, node_life, node_order
from grader.mistakes.hidden import hides
from grader.mistakes.kind import Family
from grader.mistakes.other_end import (
    ENDED_BY,
    EXITS,
    ends_before,
    ends_elsewhere,
    spins_below,
    stays_true,
)
from grader.mistakes.placeholders import placeholder_values
from grader.mistakes.recognised import Raised, RecognisedMistake, Suspect
from grader.mistakes.stop_in_branch import in_branch
from grader.package.edit.tree import Edit, Replace, Write
from grader.package.source.endless import Loop, idle_loop
from grader.package.source.module import Function
from grader.package.source.names import SPINS as SPIN_CALLS
from grader.package.source.names import calls_in, dotted, last_part
from grader.package.source.node import NodeSource
from grader.package.source.place import block_of, statement_at
from grader.package.source.spinning_loop import (
    condition_of,
    loop_around,
    only_called,
    other_work,
    until_ros_ends,
)
from grader.package.source.spinning_threads import lines_of, spinning_threads
from grader.package.source.until_ctrl_c import parts_until_ctrl_c
from grader.report.model import Where

TWICE = "generator already executing|Executor is already spinning"
ENDED = ("loop", "condition")  # variants of a loop that ended before Ctrl+C
SPUN = ("spin", "rclpy.spin", "rclpy.spin_once")
ERRORS = ("Error", "Exception")
SPIN = msg("rclpy.spin(node) waits and calls the callbacks when they are due, until Ctrl+C.")


def _spins(suspect: Suspect) -> bool:
    names = {last_part(name) for _, name in suspect.source.calls}
    return bool(names & {"spin", "spin_until_future_complete"})


def _once_only(suspect: Suspect) -> RecognisedMistake | None:
    return None if _spins(suspect) else _once(suspect)


def _never_again(suspect: Suspect) -> RecognisedMistake | None:
    """The program goes on, so that a loop around spin_once has not ended."""
    found = None if _spins(suspect) else _first_once(suspect)
    if found is None or found.variant not in ENDED:
        return found
    return replace(found, variant="goes_on")


def _by_loop(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a loop that calls the callback itself, beside spin_once."""
    found, source = _never_again(suspect), suspect.source
    names = {timer.method for timer in source.timers} - {""}
    if found is None or found.variant != "goes_on":
        return None
    for call in source.calls_of("spin_once"):
        for loop in source.module_of(call).around(call):
            if isinstance(loop, ast.While) and any(
                last_part(name) in names for _, name in calls_in(loop)
            ):
                return found
    return None


def _once(suspect: Suspect) -> RecognisedMistake | None:
    """Look for spin_once, in a loop that may end before Ctrl+C or in none."""
    found, source = _first_once(suspect), suspect.source
    if found is None or ends_before(source) or spins_below(source):
        return None
    if found.where is None or found.variant not in ("loop", "condition"):
        return found
    module = source.module_at(found.where.file)
    at = [n for n in module.nodes if isinstance(n, ast.Call) and n.lineno == found.where.line]
    loops = [loop for call in at if (loop := loop_around(source, call)) is not None]
    goes_on = bool(loops) and (until_ros_ends(loops[0]) or stays_true(source, loops[0]))
    return None if goes_on and ends_elsewhere(source) else found


def _first_once(suspect: Suspect) -> RecognisedMistake | None:
    for call, name in suspect.source.calls:
        if last_part(name) == "spin_once":
            found = suspect.finding("spin_once", call)
            node = str(placeholder_values(suspect.assignment, suspect.source)["node"])
            wanted = node_executor.spun_by(suspect.source, node, name)
            loop = loop_around(suspect.source, call)
            if loop is None:
                own = wanted.startswith("rclpy.spin(")
                return found if own else _of_executor(suspect, call, wanted)
            return _once_in_loop(suspect, replace(found, params={"wanted": wanted}), loop)
    return None


def _loop_ends(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a loop around spin_once whose condition is false before Ctrl+C."""
    return _at_loop(suspect, _once(suspect))


def _loop_ends_at_once(suspect: Suspect) -> RecognisedMistake | None:
    return _at_loop(suspect, _once_only(suspect))


def _at_loop(suspect: Suspect, found: RecognisedMistake | None) -> RecognisedMistake | None:
    """Return what was found as a loop that ends, at the loop."""
    if found is None or found.variant != "condition" or found.where is None:
        return None
    module = suspect.source.module_at(found.where.file)
    at = [n for n in module.nodes if isinstance(n, ast.Call) and n.lineno == found.where.line]
    loops = [loop for call in at if (loop := loop_around(suspect.source, call)) is not None]
    if not loops:
        return None
    where = Where(file=found.where.file, line=loops[0].lineno)
    return replace(found, kind="node.spin_loop_ends", where=where, variant="")


def _once_in_loop(suspect: Suspect, found: RecognisedMistake, loop: Loop) -> RecognisedMistake:
    """Return a spin_once in a loop: with a timer, if nothing else does the loop's other work."""
    source = suspect.source
    for statement in loop.body:
        for cleanup, name in calls_in(statement) if isinstance(statement, ast.Expr) else ():
            if last_part(name) in node_order.CLEANUP:
                code = source.module_of(cleanup).text.code(cleanup)
                word = "while" if isinstance(loop, ast.While) else "for"
                inside = suspect.finding("cleanup_in_loop", cleanup, name=code, line=loop.lineno)
                return replace(inside, words={**inside.words, "loop": word})
    test = condition_of(source, loop)
    word = "while" if isinstance(loop, ast.While) else "for"
    words = {**found.words, "loop": word, "name": test}
    work = other_work(source, loop)
    if source.timers or not work:
        return replace(found, words=words, variant="condition" if test else "loop")
    call = only_called(work)
    code = source.module_of(loop).text.code(call.func) if call is not None else ""
    owner = code.rpartition(".")[0] or words["node"]
    timer = f"{owner}.create_timer({suspect.assignment.seconds}, {code})"
    lines = "function" if source.node_class is None else "lines"
    variant = "no_timer" if code else lines
    return replace(found, words={**words, "written": timer}, variant=variant)


def _of_executor(suspect: Suspect, call: ast.Call, wanted: str) -> RecognisedMistake:
    code = suspect.source.module_of(call).text.code(call)
    found = suspect.finding("spin_once", call, name=code, written=wanted)
    return replace(found, variant="executor")


def _spun_twice(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """Look for a thread that spins beside a call of spin."""
    del match
    source = raised.source
    threads = spinning_threads(source)
    inside = {part for thread in threads for part in thread.parts}
    spins = [call for call in source.calls_of("spin") if call not in inside]
    if len(threads) != 1 or len(spins) != 1:
        return None
    thread = threads[0].call
    rows = ", ".join(map(str, sorted(lines_of(source, thread) - {thread.lineno})))
    spun, other = threads[0].given, dotted(spins[0].args[0]) if spins[0].args else ""
    if spun and other and spun != other:
        return _two_at_once(raised, thread, spins[0], (spun, other), rows)
    params = {"line": str(spins[0].lineno), "lines": rows}
    found = raised.finding("spun_twice", at=thread, params=params)
    return replace(found, variant="used" if rows else "")


def _two_at_once(
    raised: Raised, thread: ast.Call, spin: ast.Call, nodes: tuple[str, str], rows: str
) -> RecognisedMistake:
    params = {"name": nodes[0], "written": nodes[1], "line": str(spin.lineno)}
    found = raised.finding("two_spun_at_once", at=thread, params=params)
    return replace(found, words={**found.words, "lines": rows}, variant="used" if rows else "")


def _spinning_function(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a line that only names the function in which the node is spun."""
    source = suspect.source
    spins = [call for call, name in source.calls if last_part(name) == "spin"]
    around = {source.function_around(call) for call in spins} - {suspect.function}
    functions = {f.name: f for f in around if f is not None}
    for node in source.all_nodes:
        named = node.value if isinstance(node, ast.Expr) else None
        name = dotted(named) if isinstance(named, ast.Attribute | ast.Name) else ""
        function = functions.get(last_part(name))
        if named is None or function is None:
            continue
        if any(last_part(called) == function.name for _, called in source.calls):
            return None
        given = len(function.args.args) - len(function.args.defaults) - ("." in name)
        node_name = str(placeholder_values(suspect.assignment, source)["node"])
        wanted = f"{name}({'' if given <= 0 else node_name if given == 1 else '…'})"
        return suspect.finding("spin_not_called", named, name=name, wanted=wanted)
    return None


def _not_called(suspect: Suspect) -> RecognisedMistake | None:
    if _spins(suspect):
        return _spinning_function(suspect)
    for node in suspect.source.all_nodes:
        named = node.value if isinstance(node, ast.Expr) else None
        if not isinstance(named, ast.Attribute | ast.Name):
            continue
        name, node_name = (
            dotted(named),
            placeholder_values(suspect.assignment, suspect.source)["node"],
        )
        if name in SPUN or (last_part(name) in ("spin", "spin_once") and "." in name):
            once = name if _in_loop(suspect, named) else name.removesuffix("_once")
            own = name.rpartition(".")[0] in executors(suspect)
            wanted = f"{once}()" if own else f"{once}({node_name})"
            return suspect.finding("spin_not_called", named, name=name, wanted=wanted)
    return None


def _in_loop(suspect: Suspect, node: ast.AST) -> bool:
    around = suspect.source.module_of(node).around(node)
    return any(isinstance(n, ast.While | ast.For) for n in around)


def executors(suspect: Suspect) -> set[str]:
    """Return the variables of executors."""
    return node_executor.executors_of(suspect.source)


def _under_guard(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a spin that only `python3 file.py` reaches: outside of every function."""
    source = suspect.source
    spins = source.calls_of("spin")
    if not spins or any(source.function_around(call) is not None for call in spins):
        return None
    main = suspect.function
    returns = [n for n in ast.walk(main) if isinstance(n, ast.Return)] if main is not None else []
    found = suspect.finding("spin_missing", spins[0])
    if len(returns) != 1 or returns[0].value is None:
        inside = {last_part(name) for _, name in calls_in(main)} if main is not None else set()
        made = inside & {*source.class_names, "create_node", "Node"}
        return replace(found, variant="guard" if made else "guard_all")
    words = {**found.words, "line": str(returns[0].lineno)}
    if isinstance(returns[0].value, ast.Call):
        code = source.module_of(returns[0]).text.code(returns[0].value)
        name = dotted(spins[0].args[0]) if spins[0].args else ""
        name = name if name.isidentifier() else "node"
        words |= {"name": name, "wanted": f"{name} = {code}"}
        return replace(found, variant="guard_makes", words=words)
    return replace(found, variant="guard_returns", words=words)


def _missing(suspect: Suspect) -> RecognisedMistake | None:
    if _spins(suspect):
        return _under_guard(suspect)
    if suspect.source.calls_of("spin_once") or _is_passed_on(suspect.source):
        return None
    beside = (n for module in suspect.source.beside for n in module.nodes)
    if any(
        isinstance(n, ast.Attribute | ast.Name) and last_part(dotted(n)) in SPIN_CALLS
        for n in beside
    ):
        return None  # (another file of the package spins, in a way that is not known here)
    for call, name in suspect.source.calls:
        before, _, method = name.rpartition(".")
        if method == "add_node" and before in executors(suspect):
            found = suspect.finding("spin_missing", call, name=before)
            return replace(found, variant="executor")
    return _unnamed(suspect) or suspect.finding("spin_missing", suspect.place_of_function)


def _is_passed_on(source: NodeSource) -> bool:
    """Whether spin itself is given to something that may call it: a Process, a Timer, a partial."""
    threads = source.calls_of("Thread")
    return any(
        isinstance(given, ast.Attribute) and given.attr == "spin"
        for call, _ in source.calls
        if call not in threads
        for given in (*call.args, *(word.value for word in call.keywords))
    )


def _unnamed(suspect: Suspect) -> RecognisedMistake | None:
    """Look for the only line that creates a node, and gives it no name."""
    source, main = suspect.source, suspect.function
    made = [n for n in (ast.walk(main) if main is not None else ()) if isinstance(n, ast.Expr)]
    made = [n for n in made if isinstance(n.value, ast.Call) and source.is_node_class(n.value.func)]
    if main is None or len(made) != 1 or source.node_variables:
        return None
    code = source.module_of(main).text.code(made[0])
    found = suspect.finding("spin_missing", made[0])
    words = {**found.words, "name": code, "written": f"node = {code}"}
    return replace(found, words=words, variant="unnamed")


def _sleep_loop(suspect: Suspect) -> RecognisedMistake | None:
    """Look for the loop that does a timer's work."""
    idle = idle_loop(suspect.source, suspect.function) if suspect.function else None
    in_method = _sleeps_in_method(suspect)
    if in_method is not None:
        return in_method
    for loop, call in _loops_that_sleep(suspect.source):
        if loop is not idle:
            found = suspect.finding("sleep_loop", call)
            return _spins_and_sleeps(suspect, loop, found) or _with_class(suspect, loop, found)
    return None


def _loops_that_sleep(source: NodeSource) -> list[tuple[Loop, ast.Call]]:
    """Return the loops that sleep, with the call: those first that do something else too.

    Beside a timer, one that only waits or shows a countdown does not do the timer's work.
    """
    found = [
        (loop, call)
        for loop in source.all_nodes
        if isinstance(loop, ast.While | ast.For)
        for call in [c for c, name in calls_in(loop) if last_part(name) in PAUSES][:1]
    ]
    works = [each for each in found if _works(source, each[0])]
    return works or ([] if source.timers else found)


def _works(source: NodeSource, loop: Loop) -> bool:
    """Whether a loop logs, calls a function of the student's, or prints until Ctrl+C."""
    names = {last_part(name) for _, name in calls_in(loop)}
    own = {node.name for node in source.all_nodes if isinstance(node, Function)}
    prints = isinstance(loop, ast.While) and "print" in names
    return bool(names & (own | {"spin_once", "publish"}) or source.logs(loop) or prints)


def _sleeps_in_method(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a loop of main that calls a method of the node, which logs and sleeps."""
    source, main = suspect.source, suspect.source.main
    if source.timers or source.node_class is None:
        return None
    for loop in ast.walk(main) if main is not None else ():
        if not isinstance(loop, ast.While):
            continue
        for call, name in calls_in(loop):
            method = source.methods.get(last_part(name))
            sleeps = [c for c, n in calls_in(method) if last_part(n) in PAUSES] if method else []
            if method is not None and len(sleeps) == 1 and source.logs(method):
                found = suspect.finding("sleep_loop", loop)
                words = {"method": method.name, "line": str(sleeps[0].lineno)}
                return replace(found, variant="in_method", words={**found.words, **words})
            del call
    return None


def _with_class(
    suspect: Suspect, loop: ast.While | ast.For, found: RecognisedMistake
) -> RecognisedMistake:
    """Return a loop with sleep; a node without a class of its own has no method and no __init__."""
    if suspect.source.node_class is not None:
        around = suspect.source.function_around(loop)
        beside = spinning_threads(suspect.source)
        inside = {part for thread in beside for part in thread.parts}
        spins = suspect.source.calls_of("spin", within=suspect.function or ast.Pass())
        spins, threads = [c for c in spins if c not in inside], [thread.call for thread in beside]
        if len(threads) == 1 and not spins:
            lines = ", ".join(map(str, sorted(lines_of(suspect.source, threads[0]))))
            return replace(found, variant="threaded", words={**found.words, "lines": lines})
        if around is None:
            return found
        if around is suspect.function:
            below = [spin for spin in spins if spin.lineno > (loop.end_lineno or loop.lineno)]
            words = {**found.words, "line": str(below[0].lineno) if below else ""}
            return replace(found, variant="spun" if below else "", words=words)
        if not spins:
            words = {**found.words, "name": around.name}
            called = not around.name.startswith("__")
            return replace(found, variant="elsewhere", words=words) if called else found
        variant = "beside" if _in_thread(suspect.source, around) else "above"
        return replace(found, variant=variant, words={**found.words, "name": around.name})
    word = "while" if isinstance(loop, ast.While) else "for"
    words = {**found.words, "loop": word, "wanted": f"rclpy.spin({found.words['node']})"}
    return replace(found, variant="function", words=words)


def _in_thread(source: NodeSource, function: Function) -> bool:
    """Whether a function may run in a thread for which the program does not wait."""
    names = {last_part(name) for _, name in source.calls}
    started = names & {"Thread", "Timer", "submit", "start_new_thread", "run_in_executor"}
    return (bool(started) or (function.name == "run" and "start" in names)) and "join" not in names


def _spins_and_sleeps(
    suspect: Suspect, loop: ast.While | ast.For, found: RecognisedMistake
) -> RecognisedMistake | None:
    """Look for a loop that only spins once and sleeps, beside a timer that does the work."""
    values = [s.value for s in loop.body if isinstance(s, ast.Expr)]
    calls = [value.value if isinstance(value, ast.Await) else value for value in values]
    names = [dotted(call.func) for call in calls if isinstance(call, ast.Call)]
    only = {last_part(name) for name in names} == {"spin_once", "sleep"}
    once = next((name for name in names if last_part(name) == "spin_once"), "")
    if not only or len(names) != len(loop.body) or not suspect.source.timers:
        return None
    owner = once.rpartition(".")[0]
    node = placeholder_values(suspect.assignment, suspect.source)["node"]
    wanted = f"{owner}.spin()" if owner in executors(suspect) else f"rclpy.spin({node})"
    word = "while" if isinstance(loop, ast.While) else "for"
    rows = f"{loop.lineno}-{loop.end_lineno or loop.lineno}"
    words = {**found.words, "wanted": wanted, "line": rows, "loop": word}
    return replace(found, kind="node.sleeps_beside_spin", words=words)


def _nowhere(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a node without spin, not even as in Thread(target=rclpy.spin)."""
    named = any(isinstance(n, ast.Attribute) and n.attr == "spin" for n in suspect.source.all_nodes)
    if named:
        return _loop_above(suspect)
    return _loop_of_calls(suspect) or _idle(suspect) or _missing(suspect)


def _loop_of_calls(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a while loop of main that only calls a method of the node, which logs."""
    source, main = suspect.source, suspect.function
    variables = source.node_variables
    for loop in ast.walk(main) if main is not None and not source.timers else ():
        if not isinstance(loop, ast.While) or len(loop.body) != 1:
            continue
        statement = loop.body[0]
        called = dotted(statement.value.func) if isinstance(statement, ast.Expr) and isinstance(
            statement.value, ast.Call) else ""  # fmt: skip
        owner, _, name = called.rpartition(".")
        method = source.methods.get(name)
        if owner in variables and method is not None and source.logs(method):
            found = suspect.finding("sleep_loop", loop)
            words = {**found.words, "node": owner, "method": name}
            return replace(found, variant="calls", words=words)
    return None


def _loop_above(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a loop that only waits, above the line that spins."""
    loop = idle_loop(suspect.source, suspect.function) if suspect.function else None
    body = list(node_order.always_run(suspect.function.body if suspect.function else []))
    spins = [s for s in body if last_part(node_executor.called(s)) == "spin"]
    below = [s for s in spins if loop is not None and s.lineno > loop.lineno]
    if loop is None or loop not in body or not below:
        return None
    if len(block_of(suspect.source.module_of(loop), loop)) == 1:
        return None  # (its block would be empty)
    found = suspect.finding("spin_missing", loop, line=str(below[0].lineno))
    return replace(found, variant="loop_above")


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
    """Look for what ends the program: a line of its own, or one in the except for an error."""
    early, after_error = parts_until_ctrl_c(suspect.source), None
    for node in suspect.source.all_nodes:
        if not isinstance(node, ast.Raise | ast.Call) or node not in early:
            continue
        raised = dotted(node.exc) if isinstance(node, ast.Raise) and node.exc else ""
        called = dotted(node.func) if isinstance(node, ast.Call) else ""
        if isinstance(node, ast.Call) and any(isinstance(arg, ast.Call) for arg in node.args):
            continue  # sys.exit(main())
        if raised.startswith(ENDED_BY) or called in EXITS:
            if _above_spin(suspect, node):
                continue
            module = suspect.source.module_of(node)
            found = suspect.finding("exits", node, name=called or raised)
            handlers = [n for n in module.around(node) if isinstance(n, ast.ExceptHandler)]
            if handlers:
                if not hides(handlers[0]):  # (or else: node.error_hidden)
                    after_error = after_error or _after_error(suspect, found, handlers[0])
                continue
            statement = statement_at(module, node.lineno)
            around = module.parents.get(statement) if statement is not None else None
            alone = isinstance(around, ast.If) and around.body == [statement] and not around.orelse
            branch = in_branch(suspect.source, module, statement)
            if branch is not None:
                return replace(found, variant=branch[0], words={**found.words, **branch[1]})
            if not alone and statement is not None and len(block_of(module, statement)) == 1:
                return replace(found, variant="alone")
            return replace(found, variant="if" if alone else "")
    return after_error


def _above_spin(suspect: Suspect, node: ast.Raise | ast.Call) -> bool:
    """Whether an end stands above spin in the entry function, and the timer's lines came: it did not run."""
    source, main = suspect.source, suspect.source.main
    spins = source.calls_of("spin", within=main) if main is not None else []
    if not (spins and suspect.lines and source.timers) or source.function_around(node) is not main:
        return False
    return node.lineno < spins[0].lineno


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
STEPS = """\
        self.get_logger().info('Hello time: ' + str(self.counter_))
        self.counter_ += 1
"""
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
NO_ARGUMENTS = Replace(NODE, "rclpy.init(args=args)", "rclpy.init(args=[])")


def _loop(new: str = LOOPS) -> tuple[Edit, ...]:
    """Return the edits that write a loop instead of the timer and of spin."""
    no_timer = Replace(NODE, "self.create_timer(1.0, self.timer_callback)", "pass")
    return IMPORT, no_timer, Replace(NODE, SPINS, new)


WHOLE_LOOP = msg("Write {wanted} instead of the whole {loop} loop around this line.")
INTO_METHOD = msg(
    "Write a method def tick(self): in the node's class, and move the other lines of the {loop} loop "
    "into it, without spin_once and sleep. In it, self stands for {node}. What the lines keep from "
    "round to round must be attributes (self.…) that __init__ sets. Then write two lines instead of "
    "the whole {loop} loop: {node}.create_timer({period}, {node}.tick), and below it {wanted}."
)
INTO_FUNCTION = msg(
    "Write a function def tick(): above the {loop} loop, and move the loop's other lines into it, "
    "without spin_once and sleep. If they change a variable, its first line is nonlocal (for a "
    "variable outside of all functions: global) with the variable's name. Then write two lines "
    "instead of the whole {loop} loop: {node}.create_timer({period}, tick), and below it {wanted}."
)
PAUSES = ("sleep", "sleep_for", "sleep_until")
IN_METHOD = msg(
    "Write in __init__: self.create_timer({period}, self.{method}) Delete the sleep in {method} (line {line}), "
    "and write rclpy.spin({node}) in {function} instead of this loop."
)
BESIDE_SPIN = msg(
    "A loop with sleep beside rclpy.spin does not follow ROS time: in a simulation or a replay it runs "
    "at the wrong speed, and it does not stop when time stops. A timer follows ROS time."
)
IN_EACH_ROUND = msg(
    "spin_once handles one callback and returns. The other lines of the {loop} loop around it run in "
    "each round, and not when a timer is due: no timer calls them."
)
GUARD = msg(
    "ros2 run calls only {function}. The lines below if __name__ == '__main__': run only if you start "
    "the file itself."
)
WHOLE_LOOP_AROUND = msg("Write {wanted} instead of this whole {loop} loop: it spins until Ctrl+C.")
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
        whys={"beside": BESIDE_SPIN, "threaded": BESIDE_SPIN},
        fixes={
            "in_method": IN_METHOD,
            "calls": msg(
                "Write {node}.create_timer({period}, {node}.{method}) on a line above this loop, and "
                "rclpy.spin({node}) in place of the whole loop. Then delete the line of {method} that "
                "waits: the timer keeps the time."
            ),
            "function": INTO_FUNCTION,
            "spun": msg(
                "Put what the loop does into a method, without the sleep, if it is not in one already. Call "
                "the method with a timer that __init__ creates: self.create_timer({period}, "
                "self.{callback}), and delete the loop: line {line} spins the node."
            ),
            "elsewhere": msg(
                "Put what the loop in {name} does into a method, without the sleep, if it is not in one "
                "already. Call the method with a timer that __init__ creates: self.create_timer({period}, "
                "self.{callback}). Then delete the loop, and write rclpy.spin({node}) in {function} instead "
                "of what calls or starts {name} now."
            ),
            "threaded": msg(
                "Put what the loop does into a method, without the sleep, if it is not in one already. "
                "Call the method with a timer that __init__ creates: self.create_timer({period}, self.{callback}). Then write "
                "rclpy.spin({node}) in {function} instead of the loop, and delete the thread that "
                "spins the node now (lines: {lines})."
            ),
            **dict.fromkeys(
                ("above", "beside"),
                msg(
                    "Put what the loop in {name} does into a method, and call it with a timer that "
                    "__init__ creates: self.create_timer({period}, self.{callback}). Then delete the "
                    "loop, and what starts {name} if nothing else is left in it. {function} spins the "
                    "node already."
                ),
            ),
        },
        behind={"run.never_spins": _sleep_loop},
        examples=(
            example(
                "loop_calls_what_waits_elsewhere",
                *_loop(LOOPS.replace("            time.sleep(1.0)\n", "")),
                Replace(
                    NODE, "\n\nclass", "\n\ndef delay(ms):\n    time.sleep(ms / 1000)\n\n\nclass"
                ),
                Replace(
                    NODE, "self.get_logger().info", "delay(1000)\n        self.get_logger().info"
                ),
                fails="run.spins",
            ),
            example(
                "sleep_loop_above_spin",
                *_loop(LOOPS.replace("    except", "        rclpy.spin(node)\n    except")),
                fails="run.spins",
            ),
            example(
                "sleep_loop_in_a_method_that_main_calls",
                *_loop(SPINS.replace("rclpy.spin(node)", "node.run()")),
                Replace(
                    NODE,
                    "    def timer_callback",
                    "    def run(self):\n        while rclpy.ok():\n            self.timer_callback()\n"
                    "            time.sleep(1.0)\n\n    def timer_callback",
                ),
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
                "loop_sleeps_by_the_clock_of_the_node",
                *_loop(LOOPS.replace("time.sleep(1.0)", "node.get_clock().sleep_for(SECOND)")),
                Replace(
                    NODE,
                    "\n\nclass",
                    "\nfrom rclpy.duration import Duration\n\nSECOND = Duration(seconds=1)\n\n\nclass",
                ),
                fails="run.spins",
                note="on /clock its time stands still, as it never spins",
            ),
            example(
                "procedural_sleep",
                Write(NODE, PROCEDURAL, 0o755),
                fails="run.spins",
                note="ends with the KeyboardInterrupt traceback",
            ),
            example(
                "sleep_loop_without_arguments",
                *_loop(),
                NO_ARGUMENTS,
                fails="run.spins",
                note="use_sim_time does not reach it",
            ),
            example(
                "sleep_loop_without_parameter_services",
                *_loop(),
                Replace(
                    NODE,
                    "super().__init__('my_first_node')",
                    "super().__init__('my_first_node', start_parameter_services=False)",
                ),
                fails="run.spins",
            ),
            example(
                "sleep_loop_beside_spin",
                *_loop(BESIDE + LOOPS),
                fails="run.spins",
                note="it answers, but ROS time stands still",
            ),
            example(
                "sleep_loop_beside_spin_without_arguments",
                *_loop(BESIDE + LOOPS),
                NO_ARGUMENTS,
                fails="run.spins",
                note="its parameter service sets use_sim_time, and the lines go on",
            ),
            example(
                "short_sleep_loop_beside_spin",
                *_loop(BESIDE + LOOPS.replace("sleep(1.0)", "sleep(0.1)")),
                fails="run.spins",
                also={"run.period": "run.wrong_period"},
                note="a line soon after each barrier seems to be on time",
            ),
            example(
                "spin_once_in_a_sleep_loop",
                *_loop(
                    LOOPS.replace(
                        "time.sleep(1.0)\n",
                        "time.sleep(1.0)\n            rclpy.spin_once(node, timeout_sec=0)\n",
                    )
                ),
                fails="run.spins",
            ),
            example(
                "sleep_loop_of_two_nodes",
                *_loop(),
                Replace(
                    NODE,
                    "    node = MyFirstNode()\n",
                    "    other = Node('other_node')\n"
                    + BESIDE.replace("node,", "other,")
                    + "    node = MyFirstNode()\n",
                ),
                fails="run.spins",
                note="another node spins, the one that counts does not",
            ),
        ),
    ),
    _node(
        "cleanup_in_loop",
        "spin",
        msg("The clean-up is inside of the loop that spins"),
        msg(
            "The first round of the loop in line {line} already comes to {name}. After that, the node or "
            "ROS is shut down, and nothing spins any more."
        ),
        msg(
            "Move the lines that clean up to below the loop: indent them as far as the {loop} in line "
            "{line}, or write them in a finally."
        ),
        links.EXECUTORS,
        examples=(
            example(
                "executor_shut_down_in_loop",
                Replace(
                    NODE,
                    "import rclpy\n",
                    "import rclpy\nfrom rclpy.executors import SingleThreadedExecutor\n",
                ),
                Replace(
                    NODE,
                    "        rclpy.spin(node)\n",
                    "        runner = SingleThreadedExecutor()\n"
                    "        runner.add_node(node)\n"
                    "        while rclpy.ok():\n"
                    "            runner.spin_once(timeout_sec=0.1)\n"
                    "            rclpy.shutdown()\n",
                ),
                fails="run.starts",
            ),
            example(
                "cleanup_in_the_loop_of_spin_once",
                Replace(
                    NODE,
                    "        rclpy.spin(node)\n",
                    "        while rclpy.ok():\n            rclpy.spin_once(node)\n"
                    "            node.destroy_node()\n            rclpy.try_shutdown()\n",
                ),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "spin_loop_ends",
        "spin",
        msg("The loop that spins the node ends before Ctrl+C"),
        msg(
            "The node is spun only as long as this loop goes on. It ends as soon as {name} is false, at once "
            "or later, and then {function} ends."
        ),
        WHOLE_LOOP_AROUND,
        links.EXECUTORS,
        behind={"run.exits_at_once": _loop_ends_at_once, "run.ended_early": _loop_ends},
        examples=(
            example(
                "spins_until_three",
                Replace(
                    NODE,
                    "rclpy.spin(node)",
                    "while node.counter_ < 3:\n            rclpy.spin_once(node)",
                ),
                fails="run.output",
                blocks=("run.interrupt",),
            ),
            example(
                "spins_while_ok_is_zero",
                Replace(
                    NODE,
                    "rclpy.spin(node)",
                    "while rclpy.ok() == 0:\n            rclpy.spin_once(node)",
                ),
                fails="run.starts",
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
            "loop": msg(
                "spin_once handles one callback and returns. The loop around it must go on until "
                "Ctrl+C, and this loop ended earlier. A message of a simulated clock is a callback "
                "too: in the grader's run, fewer lines can come than in your terminal."
            ),
            "condition": msg(
                "spin_once handles one callback and returns. The loop around it must go on until "
                "Ctrl+C, but it goes on only as long as {name} is true."
            ),
            "no_timer": IN_EACH_ROUND,
            "lines": IN_EACH_ROUND,
            "function": IN_EACH_ROUND,
            "executor": msg(
                "{name} handles one callback and returns: it does not wait for more callbacks."
            ),
            "goes_on": msg(
                "spin_once handles one callback and returns. The other lines of the loop around it "
                "run in each round, not when a timer is due."
            ),
        },
        fixes={
            "loop": WHOLE_LOOP,
            "condition": WHOLE_LOOP,
            "goes_on": WHOLE_LOOP,
            "no_timer": msg(
                "Write two lines instead of the whole {loop} loop around this line: first {written}, "
                "which creates the timer, and below it {wanted}."
            ),
            "lines": INTO_METHOD,
            "function": INTO_FUNCTION,
            "executor": msg("Write {written} instead of {name}."),
        },
        behind={
            "run.exits_at_once": _once_only,
            "run.never_spins": _never_again,
            "run.ended_early": _once,
            **dict.fromkeys(
                (
                    *("run.stops", "run.by_hand", "run.twice", "run.wrong_period"),
                    *("run.too_much_output", "run.wrong_start"),
                ),
                _by_loop,
            ),
        },
        fixed_by=(lines.written, node_life.spin),
        examples=(
            example(
                "spin_once",
                Replace(NODE, "rclpy.spin(node)", "rclpy.spin_once(node)"),
                fails="run.starts",
                note="one line on the wall clock; none under use_sim_time, because the first message on /clock is the only callback that it runs",
            ),
            example(
                "spin_once_and_callback_in_a_loop",
                Replace(
                    NODE,
                    "        rclpy.spin(node)\n",
                    "        while rclpy.ok():\n            rclpy.spin_once(node, timeout_sec=0.1)\n"
                    "            node.timer_callback()\n",
                ),
                fails="run.spins",
                also={"run.period": "node.spin_once"},
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
            "loop_above": msg(
                "This loop does not end until Ctrl+C, so that line {line}, which spins the node, is "
                "not reached before. The loop itself calls no callbacks."
            ),
            "guard": GUARD,
            "guard_all": GUARD,
            "guard_makes": GUARD,
            "guard_returns": GUARD,
            "executor": msg(
                "add_node only gives the node to the executor. {name}.spin() waits and calls the "
                "callbacks when they are due."
            ),
        },
        fixes={
            "guard": msg("Move the call of rclpy.spin into {function}, after creating the node."),
            "guard_all": msg(
                "Move the lines that create the node, spin it and clean up into {function}, indented like its "
                "other lines. Leave only {function}() outside."
            ),
            "guard_makes": msg(
                "Write {wanted} instead of the return in line {line}. Move the lines that use {name}, "
                "from try: to the clean-up, below it, indented like it. Leave only {function}() outside."
            ),
            "guard_returns": msg(
                "Write in {function}, instead of the return in line {line}, the lines that use the "
                "node: try:, rclpy.spin and the clean-up, with the variable of {function} for the "
                "node. Leave only {function}() outside."
            ),
            "executor": msg("Write {name}.spin() below this line."),
            "unnamed": msg(
                "Write {written} instead of {name} on this line, and below it: rclpy.spin(node)"
            ),
            "loop": msg("Write rclpy.spin({node}) instead of this loop."),
            "loop_above": msg("Delete this loop: line {line} waits and calls the callbacks."),
        },
        behind={
            "run.exits_at_once": _missing,
            "run.no_node": _under_guard,
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
                "node_without_name_not_spun",
                Replace(NODE, "node = MyFirstNode()", "MyFirstNode()"),
                Replace(NODE, SPINS, "    rclpy.shutdown()\n"),
                fails="run.starts",
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
                "spin_below_guard",
                Replace(NODE, SPINS, "    return node\n"),
                Replace(NODE, "    main()\n", "    rclpy.spin(main())\n"),
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
        "sleeps_beside_spin",
        "spin",
        msg("The loop that spins also sleeps"),
        msg(
            "While this line sleeps, ROS cannot call the node's callbacks: the timer is late, and "
            "ros2 param list gets no answer in that time. spin waits by itself until something is "
            "due."
        ),
        msg("Write {wanted} instead of the whole {loop} loop (line {line})."),
        links.EXECUTORS,
    ),
    _node(
        "spun_twice",
        "spin",
        msg("A thread spins the node, and the program spins it too"),
        msg(
            "The thread that this line creates spins the node, and so does line {line}. Only one of "
            "them can do that at a time: the other one stops with an error."
        ),
        msg("Delete this line: line {line} spins the node."),
        links.EXECUTORS,
        fixes={
            "used": msg(
                "Delete this line and the other lines of the thread (lines: {lines}): line {line} "
                "spins the node."
            )
        },
        raised={TWICE: _spun_twice},
        deletes=("",),
    ),
    _node(
        "two_spun_at_once",
        "spin",
        msg("Two nodes are spun with rclpy.spin at the same time"),
        msg(
            "The thread that this line creates spins {name}, and line {line} spins {written}. rclpy.spin "
            "uses the same executor for all nodes of a program, and only one thread at a time can spin an "
            "executor: the other one stops with an error."
        ),
        msg(
            "Delete this line, and give both nodes to one executor: write from rclpy.executors import "
            "SingleThreadedExecutor at the top of the file, and four lines instead of line {line}: executor "
            "= SingleThreadedExecutor(), executor.add_node({name}), executor.add_node({written}) and "
            "executor.spin()."
        ),
        links.EXECUTORS,
        fixes={
            "used": msg(
                "Delete this line and the other lines of the thread (lines: {lines}), and give both nodes to "
                "one executor: write from rclpy.executors import SingleThreadedExecutor at the top of the "
                "file, and four lines instead of line {line}: executor = SingleThreadedExecutor(), "
                "executor.add_node({name}), executor.add_node({written}) and executor.spin()."
            )
        },
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
            "alone": msg("Write pass instead of this line."),
            "in_except": msg(
                "Write raise instead of this line, and run the node again: the traceback then names the "
                "error and the line that raises it. Correct that line."
            ),
            **stop_in_branch.FIXES,
        },
        behind={"run.ended_early": _exits},
        fixed_by=(stop_in_branch.without_stop,),
        deletes=("",),
        examples=(
            example(
                "exit_in_the_if_of_an_else_that_logs",
                Replace(
                    NODE,
                    STEPS,
                    "        if self.counter_ == 3:\n"
                    "            self.get_logger().debug('the end')\n"
                    "            raise SystemExit\n"
                    "        else:\n"
                    "            self.get_logger().info('Hello time: ' + str(self.counter_))\n"
                    "        self.counter_ += 1\n",
                ),
                fails="run.output",
                blocks=("run.interrupt",),
            ),
            example(
                "exit_in_elif",
                Replace(
                    NODE,
                    "self.counter_ += 1",
                    "self.counter_ += 1\n"
                    "        if self.counter_ < 0:\n"
                    "            pass\n"
                    "        elif self.counter_ == 3:\n"
                    "            raise SystemExit",
                ),
                fails="run.output",
                blocks=("run.interrupt",),
            ),
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
