"""Recognise the mistake behind a known symptom of a run in the node's source.

Each function is for one symptom. It returns the mistake that causes it, or None; it does not
report code that only looks like a mistake.
"""

from __future__ import annotations

import ast
from collections.abc import Callable

from grader.mistakes.from_counter import constant, wrong_start, wrong_step
from grader.mistakes.kind import RecognisedMistake
from grader.mistakes.symptoms import Suspect
from grader.package.source.names import calls_in, dotted, last_part
from grader.package.source.node import NodeSource
from grader.report.model import Where

SLEEPS = ("time.sleep", "sleep")
WAITS = ("input", *SLEEPS)
EXITS = ("exit", "quit", "sys.exit", "os._exit")
LONG = 100.0  # seconds; a longer period was meant in milliseconds


Recognise = Callable[[Suspect], RecognisedMistake | None]


def no_spin(suspect: Suspect) -> RecognisedMistake | None:
    """Look for the reason why a program ends immediately."""
    source = suspect.source
    found = _no_node(suspect)
    if found is not None:
        return found
    spins = [(call, last_part(name)) for call, name in source.calls]
    names = {name for _, name in spins}
    if names & {"spin", "spin_until_future_complete"}:
        return None
    for call, name in spins:
        if name == "spin_once":
            return suspect.finding("spin_once", call)
    for node in source.all_nodes:
        named = node.value if isinstance(node, ast.Expr) else None
        if isinstance(named, ast.Attribute) and named.attr == "spin":
            return suspect.finding("spin_not_called", named)
    return suspect.finding("spin_missing", suspect.place_of_function)


def _no_node(suspect: Suspect) -> RecognisedMistake | None:
    source = suspect.source
    if not source.uses_ros:
        return suspect.finding("no_ros", Where(file=source.entry.path, line=1))
    made = source.makes_node() or any(n.endswith("create_node") for _, n in source.calls)
    if source.node_class is not None and not made:
        return suspect.finding("main_empty", suspect.place_of_function)
    return None


def no_node(suspect: Suspect) -> RecognisedMistake | None:
    """Look for the reason why a program runs but creates no node."""
    found = _no_node(suspect)
    main = suspect.function
    if found is not None or main is None:
        return found
    for call, name in calls_in(main):
        if suspect.source.is_node_class(call.func):
            return None
        if name in WAITS:
            return suspect.finding("waits_first", call, name=f"{name}()")
    return None


def no_lines(suspect: Suspect) -> RecognisedMistake | None:
    """Look for the reason why a node that spins logs nothing."""
    source = suspect.source
    callback = source.callback
    if not source.timers:
        init = source.methods.get("__init__")
        return suspect.finding("timer_missing", init)
    timer = source.timers[0]
    if callback is not None and all(t.function is callback for t in source.timers):
        return suspect.finding("timer_in_callback", timer.call)
    for call, name in source.calls:
        if name.endswith(".cancel"):
            return suspect.finding("timer_cancelled", call)
    if timer.seconds is not None and timer.seconds >= LONG > suspect.output.period:
        return suspect.finding("period_milliseconds", timer.call, written=f"{timer.seconds:g}")
    logging = [m for m in source.methods.values() if source.logs(m) and m.name != "__init__"]
    other = callback is None or callback.name != timer.method
    if timer.method and other and logging:
        params = {"name": timer.method}
        return suspect.finding("timer_other_callback", timer.call, **params)
    if callback is None:
        return None
    held = _never_ends(suspect)
    if held is not None:
        return held
    logs = source.logs(callback)
    if not logs and not source.prints(callback):
        return suspect.finding("log_missing", callback)
    debug = [log for log in logs if dotted(log.func).endswith(".debug")]
    return suspect.finding("debug_level", debug[0]) if debug else None


def twice(suspect: Suspect) -> RecognisedMistake | None:
    """Look for the reason why two lines come at a time."""
    source = suspect.source
    if len(source.timers) > 1:
        return suspect.finding("two_timers", source.timers[1].call)
    callback = source.callback
    if callback is None:
        return None
    logs = [*source.logs(callback), *source.prints(callback)]
    if len(logs) > 1:
        second = sorted(logs, key=lambda call: call.lineno)[1]
        return suspect.finding("logs_twice", second)
    return None


def printed(suspect: Suspect) -> RecognisedMistake | None:
    """Look for the print that writes the line."""
    callback = suspect.source.callback
    prints = suspect.source.prints(callback) if callback is not None else []
    prints = prints or [call for call, name in suspect.source.calls if name == "print"]
    return suspect.finding("print_used", prints[0]) if prints else None


def by_hand(suspect: Suspect) -> RecognisedMistake | None:
    """Look for the code that calls the callback before the timer does."""
    source = suspect.source
    for timer in source.timers:
        if timer.called:
            return suspect.finding("callback_called", timer.call)
    init = source.methods.get("__init__")
    names = {dotted(timer.callback) for timer in source.timers if timer.callback} - {""}
    for call, name in calls_in(init) if init else ():
        if name in names:
            return suspect.finding("called_by_hand", call)
    return None


def longest_sleep(source: NodeSource) -> tuple[ast.Call, float] | None:
    """Return the callback's longest sleep of those with a literal number of seconds."""
    calls = calls_in(source.callback) if source.callback is not None else ()
    found = [
        (call, float(call.args[0].value))
        for call, name in calls
        if name in SLEEPS
        and call.args
        and isinstance(call.args[0], ast.Constant)
        and isinstance(call.args[0].value, int | float)
    ]
    return max(found, key=lambda sleep: sleep[1], default=None)


def wrong_period(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a sleep that delays the lines although the timer's period is right."""
    slept = longest_sleep(suspect.source)
    timers = [timer.seconds for timer in suspect.source.timers]
    if (
        slept is None
        or slept[1] <= suspect.output.period
        or timers not in ([suspect.output.period], [None])
    ):
        return None
    return suspect.finding("sleeps_in_callback", slept[0], seconds=slept[1])


def never_spins(suspect: Suspect) -> RecognisedMistake | None:
    """Look for the loop that does a timer's work, or for the reason why nothing spins."""
    for node in suspect.source.all_nodes:
        if isinstance(node, ast.While | ast.For):
            for call, name in calls_in(node):
                if last_part(name) == "sleep":
                    return suspect.finding("sleep_loop", call)
    found = no_spin(suspect)
    named = any(isinstance(n, ast.Attribute) and n.attr == "spin" for n in suspect.source.all_nodes)
    missing = found is not None and found.kind == "node.spin_missing"
    return None if missing and named else found  # (as in Thread(target=rclpy.spin))


def stops(suspect: Suspect) -> RecognisedMistake | None:
    """Look for the code that stops the timer."""
    for call, name in suspect.source.calls:
        if name.endswith((".cancel", ".destroy_timer")):
            return suspect.finding("timer_cancelled", call)
    return _never_ends(suspect)


def _never_ends(suspect: Suspect) -> RecognisedMistake | None:
    """Look for the code that prevents the callback from returning."""
    callback = suspect.source.callback
    for node in ast.walk(callback) if callback is not None else ():
        if isinstance(node, ast.Call) and dotted(node.func) == "input":
            return suspect.finding("callback_never_ends", node, name="input()")
        if isinstance(node, ast.While) and _goes_on(node):
            return suspect.finding("callback_never_ends", node, name="while")
    return None


def _goes_on(loop: ast.While) -> bool:
    left = any(isinstance(node, ast.Break | ast.Return) for node in ast.walk(loop))
    return isinstance(loop.test, ast.Constant) and bool(loop.test.value) and not left


def ends(suspect: Suspect) -> RecognisedMistake | None:
    """Look for the code that ends the node without an exception."""
    for node in suspect.source.all_nodes:
        if not isinstance(node, ast.Raise | ast.Call):
            continue
        raised = dotted(node.exc) if isinstance(node, ast.Raise) and node.exc else ""
        called = dotted(node.func) if isinstance(node, ast.Call) else ""
        if raised.startswith(("SystemExit", "KeyboardInterrupt")) or called in EXITS:
            name = called or raised
            return suspect.finding("exits", node, name=name)
    for call, name in suspect.source.calls:
        if last_part(name) == "spin_once":
            return suspect.finding("spin_once", call)
    return None


BY_SYMPTOM: dict[str, Recognise] = {
    "run.exits_at_once": no_spin,
    "run.no_node": no_node,
    "run.no_lines": no_lines,
    "run.constant_counter": constant,
    "run.wrong_step": wrong_step,
    "run.wrong_start": wrong_start,
    "run.twice": twice,
    "run.print_not_logger": printed,
    "run.by_hand": by_hand,
    "run.wrong_period": wrong_period,
    "run.stops": stops,
    "run.never_spins": never_spins,
    "run.ended_early": ends,
}
