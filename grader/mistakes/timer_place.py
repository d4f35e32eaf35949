"""Mistakes in where and how often the timer is created."""

from __future__ import annotations

import ast
import re
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.example import NODE, SILENT, STEP_LINE, example
from grader.mistakes.fixes import node_callback, node_count, timer_place
from grader.mistakes.kind import Family
from grader.mistakes.recognised import Raised, RecognisedMistake, Suspect
from grader.package.edit.tree import Replace
from grader.package.source.after_spin import timer_after_spin
from grader.package.source.counter import logged_counter, targets_of
from grader.package.source.endless import calls_of_methods
from grader.package.source.module import Function, code_of
from grader.package.source.names import calls_in, dotted, last_part
from grader.package.source.node import NodeSource
from grader.package.source.place import block_of
from grader.package.source.timer import Timer
from grader.package.source.until_ctrl_c import parts_until_ctrl_c


def _again(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a timer that is created in what a timer calls, also through a method of it."""
    source = suspect.source
    called = {timer.method for timer in source.timers}
    for timer in source.timers:
        function = timer.function
        if function is None or source.methods.get(function.name) is not function:
            continue
        others = [t for t in source.timers if t.function is not function]
        callers = [
            method.name
            for method in source.methods.values()
            if method is function or function in (m for _, m in calls_of_methods(source, method))
        ]
        by_timer = [name for name in callers if name in called]
        if not by_timer or not others or _ends_timers(function):
            continue
        if timer.method in by_timer and function.name in by_timer:
            return suspect.finding("timer_again", timer.call, name=function.name)
        if others[0].method == function.name and timer.method in source.methods:
            words = {"name": function.name, "method": timer.method}
            return replace(suspect.finding("timer_again", timer.call, **words), variant="other")
    return _again_by_call(suspect)


def _again_by_call(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a call of a method that creates the timer, in that timer's own callback."""
    source, callback = suspect.source, suspect.source.callback
    if callback is None or _ends_timers(callback):
        return None
    for timer in source.timers:
        maker = timer.function
        if maker is None or maker is callback or source.methods.get(maker.name) is not maker:
            continue
        code = code_of(maker)
        calls = [s for s in callback.body if isinstance(s, ast.Expr) and _calls(s.value, maker)]
        elsewhere = any(
            _calls(call, maker) for call, _ in source.calls if call not in ast.walk(callback)
        )
        first = [t for t in source.timers if t is not timer and t.method == callback.name]
        if timer.method != callback.name or len(calls) != 1 or not (elsewhere or first):
            continue
        if maker.name == "__init__" or _ends_timers(maker):
            continue
        found = suspect.finding("timer_again", calls[0], name=callback.name)
        if len(code) == 1:
            return found
        words: dict[str, str | int] = {"maker": maker.name, "line": timer.call.lineno}
        variant = "maker_first" if first else "maker"
        params = {**found.params, **words}
        return replace(found, params=params, words={**found.words, **words}, variant=variant)
    return None


def _calls(call: ast.expr, method: Function) -> bool:
    return isinstance(call, ast.Call) and last_part(dotted(call.func)) == method.name


def _ends_timers(function: Function) -> bool:
    return any(last_part(name) in ("cancel", "destroy_timer") for _, name in calls_in(function))


def _after_spin(suspect: Suspect) -> RecognisedMistake | None:
    """Look for the only timers in lines that do not run before spin returns."""
    found = timer_after_spin(suspect.source)
    return suspect.finding("timer_after_spin", found[0], **_words(*found)) if found else None


def _created_at_end(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The same after Ctrl+C has shut ROS down: now the line runs, and fails."""
    del match
    found = timer_after_spin(raised.source)
    return raised.finding("timer_after_spin", at=found[0], params=_words(*found)) if found else None


def _words(call: ast.Call, spin: ast.Call) -> dict[str, str]:
    name = f"{dotted(call.func)}(…)" if call.args else f"{dotted(call.func)}()"
    return {"name": name, "line": str(spin.lineno)}


def _in_callback(suspect: Suspect) -> RecognisedMistake | None:
    timers, callback = suspect.source.timers, suspect.source.callback
    if callback is None or not timers or any(t.function is not callback for t in timers):
        return None
    return suspect.finding("timer_in_callback", timers[0].call)


def _two(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a second timer with the same callback, or with another one that logs."""
    source, timers = suspect.source, suspect.source.timers
    logging = [t for t in timers if _logs(source, t)]
    if len(logging) > 1:
        return _second(suspect, logging)
    return _in_loop(suspect) or _made_by_calls(suspect)


def _logs(source: NodeSource, timer: Timer) -> bool:
    """Whether the callback of a timer logs, or calls a method that does; also if it is unknown."""
    method = source.methods.get(timer.method)
    if method is None:
        return True
    inner = [m for _, m in calls_of_methods(source, method)]
    return any(source.logs(m) or source.prints(m) for m in (method, *inner))


def _second(suspect: Suspect, timers: list[Timer]) -> RecognisedMistake:
    """Name the timer that is too many: the second one, unless only that has the right period."""
    first, second = timers[:2]
    right = [suspect.period == t.seconds for t in (first, second)]
    if first.method != second.method:
        right = [_counts(suspect.source, t) for t in (first, second)]
    kept, other = (second, first) if right == [False, True] else (first, second)
    found = suspect.finding("two_timers", other.call)
    module = suspect.source.module_of(other.call)
    statement = next((n for n in module.around(other.call) if isinstance(n, ast.stmt)), None)
    same = suspect.source.module_of(kept.call) is module
    unsure = first.method != second.method and right[0] == right[1]
    if unsure or not same or statement is None or len(timers) > 2:
        return found
    words = {**found.words, "line": kept.call.lineno}
    names = {last_part(name) for name in targets_of(statement)}
    kept_statement = next((n for n in module.around(kept.call) if isinstance(n, ast.stmt)), None)
    if kept_statement is statement:
        return found
    names -= {last_part(name) for name in targets_of(kept_statement)} if kept_statement else set()
    uses = {
        n.lineno
        for n in suspect.source.all_nodes
        if isinstance(n, ast.Attribute | ast.Name) and last_part(dotted(n)) in names
    } - {statement.lineno}
    if uses:
        return replace(
            found, words={**words, "lines": ", ".join(map(str, sorted(uses)))}, variant="used"
        )
    alone = len(block_of(module, statement)) == 1
    return replace(found, words=words, variant="alone" if alone else "line")


def _counts(source: NodeSource, timer: Timer) -> bool:
    """Whether the callback of a timer logs the counter itself."""
    log, method = logged_counter(source), source.methods.get(timer.method)
    return log is not None and method is not None and log[0] in ast.walk(method)


def _in_loop(suspect: Suspect) -> RecognisedMistake | None:
    """Look for the only timer in a loop that creates it in each of its rounds."""
    source, timers = suspect.source, suspect.source.timers
    if len(timers) != 1:
        return None
    module = source.module_of(timers[0].call)
    around = list(module.around(timers[0].call))
    inside = next((n for n, part in enumerate(around) if isinstance(part, Function)), len(around))
    loops = [part for part in around[:inside] if isinstance(part, ast.For | ast.While)]
    if len(loops) != 1:
        return None
    found = suspect.finding("two_timers", timers[0].call)
    word = "for" if isinstance(loops[0], ast.For) else "while"
    words = {**found.words, "loop": word, "line": loops[0].lineno}
    return replace(found, words=words, variant="loop")


def _made_by_calls(suspect: Suspect) -> RecognisedMistake | None:
    """Look for two calls of the method that creates the timer."""
    source, timers = suspect.source, suspect.source.timers
    maker = timers[0].function if len(timers) == 1 else None
    own = any(maker in each.body for each in source.family)  # (also a base class of the package)
    if maker is None or not own or maker.name == "__init__":
        return None
    early = parts_until_ctrl_c(source)
    calls = [call for call, _ in source.calls if _calls(call, maker) and call in early]
    if len(calls) != 2 or _ends_timers(maker):
        return None
    found = suspect.finding("two_timers", calls[1])
    words = {**found.words, "maker": maker.name, "line": calls[0].lineno}
    statement = source.module_of(calls[1]).parents.get(calls[1])
    if isinstance(statement, ast.Expr):
        others = len(block_of(source.module_of(calls[1]), statement)) - 1
        return replace(found, words=words, variant="called_line" if others else "called")
    return replace(found, words=words, variant="called")


CALLED = msg(
    "This line calls {maker}, and line {line} does so too. Each call creates a timer, and each timer "
    "calls the callback on its own."
)
_node = Family("node", links.FIRST_NODE)
KINDS = (
    _node(
        "timer_again",
        "timer",
        msg("Each call of the callback creates one more timer"),
        msg(
            "A timer repeats by itself: it calls its callback in each period, not only once. With one "
            "more timer from each call of {name} there are more and more timers, and as many lines "
            "at a time."
        ),
        msg("Delete this line. The timer that is created first goes on by itself."),
        fixes={
            "other": msg(
                "Delete this line, and give {method} instead of {name} to the timer that calls "
                "{name}."
            ),
            "maker": msg(
                "This line calls {maker}, which creates a timer in each call. Move line {line}, "
                "which creates it, from {maker} to the end of __init__."
            ),
            "maker_first": msg(
                "This line calls {maker}, which creates a timer in each call. Delete line {line}, "
                "which creates it: the timer that is created first goes on by itself."
            ),
        },
        behind={
            "run.twice": _again,
            "run.wrong_period": _again,
            "run.too_much_output": _again,
        },
        deletes=("", "other"),
        fixed_by=(timer_place.only_first,),
        examples=(
            example(
                "timer_again_in_callback",
                Replace(
                    NODE,
                    STEP_LINE,
                    f"{STEP_LINE}        self.create_timer(1.0, self.timer_callback)  # next\n",
                ),
                fails="run.output",
                also={"run.period": "node.timer_again"},
            ),
            example(
                "timer_again_by_method",
                Replace(NODE, "self.create_timer(1.0, self.timer_callback)", "self.start()"),
                Replace(NODE, STEP_LINE, f"{STEP_LINE}        self.start()  # next\n"),
                Replace(
                    NODE,
                    "    def timer_callback",
                    "    def start(self):\n"
                    "        self.create_timer(1.0, self.timer_callback)\n\n"
                    "    def timer_callback",
                ),
                fails="run.output",
                also={"run.period": "node.timer_again"},
            ),
            example(
                "timer_of_timer",
                Replace(
                    NODE,
                    "self.create_timer(1.0, self.timer_callback)",
                    "self.create_timer(1.0, self.start)",
                ),
                Replace(
                    NODE,
                    "    def timer_callback",
                    "    def start(self):\n"
                    "        self.create_timer(1.0, self.timer_callback)\n\n"
                    "    def timer_callback",
                ),
                fails="run.output",
                also={"run.period": "node.timer_again"},
            ),
        ),
    ),
    _node(
        "timer_hides_method",
        "timer",
        msg("The timer is assigned to the name of its own callback"),
        msg(
            "It works, because create_timer gets the method before the name is assigned. From then "
            "on, self.{name} is the timer, and the method can no longer be called by this name."
        ),
        msg("Use another name for the timer, for example self.timer_."),
    ),
    _node(
        "timer_after_spin",
        "timer",
        msg("The timer is created below rclpy.spin"),
        msg(
            "rclpy.spin on line {line} waits until Ctrl+C. No line below it runs before that: "
            "{name} comes too late, and while the node spins there is no timer."
        ),
        msg(
            "Move this line above line {line}, the call of rclpy.spin, indented as far as that line."
        ),
        links.EXECUTORS,
        raised={r"failed to create timer: the given context is not valid": _created_at_end},
        behind={"run.no_lines": _after_spin},
        deletes=("",),
        fixed_by=(timer_place.above_spin,),
        examples=(
            example(
                "timer_started_after_spin",
                Replace(NODE, "        self.create_timer(1.0, self.timer_callback)\n", ""),
                Replace(
                    NODE,
                    "    def timer_callback",
                    "    def start(self):\n"
                    "        self.create_timer(1.0, self.timer_callback)\n\n"
                    "    def timer_callback",
                ),
                Replace(
                    NODE,
                    "        rclpy.spin(node)\n",
                    "        rclpy.spin(node)\n        node.start()\n",
                ),
                fails="run.output",
                blocks=SILENT,
            ),
            example(
                "timer_created_after_try",
                Replace(NODE, "        self.create_timer(1.0, self.timer_callback)\n", ""),
                Replace(
                    NODE,
                    "    finally:\n        node.destroy_node()\n        rclpy.try_shutdown()\n",
                    "    node.timer_ = node.create_timer(1.0, node.timer_callback)\n"
                    "    rclpy.try_shutdown()\n",
                ),
                fails="run.output",
                also={"run.interrupt": "node.timer_after_spin"},
                blocks=SILENT,
            ),
        ),
    ),
    _node(
        "timer_in_callback",
        "timer",
        msg("The timer is created in its own callback"),
        msg("The timer calls the callback: as long as there is no timer, nothing calls it."),
        msg("Move create_timer to __init__."),
        behind={"run.no_lines": _in_callback},
        fixed_by=(node_callback.into_constructor,),
        examples=(
            example(
                "timer_in_callback",
                Replace(NODE, "        self.create_timer(1.0, self.timer_callback)\n", ""),
                Replace(
                    NODE,
                    "self.get_logger().info('Hello time: ' + str(self.counter_))",
                    (
                        "self.create_timer(1.0, self.timer_callback)\n"
                        "        self.get_logger().info('Hello time: ' + str(self.counter_))"
                    ),
                ),
                fails="run.output",
                blocks=SILENT,
            ),
        ),
    ),
    _node(
        "two_timers",
        "timer",
        msg("More than one timer makes the lines"),
        msg("Each timer calls its callback on its own: two timers make two lines at a time."),
        msg("Keep only one create_timer."),
        whys={
            "loop": msg(
                "This line is in a {loop} (line {line}): each round creates one more timer, and "
                "each timer calls the callback on its own."
            ),
            "called": CALLED,
            "called_line": CALLED,
        },
        fixes={
            "line": msg("Delete this line: line {line} creates the timer."),
            "alone": msg("Write pass instead of this line: line {line} creates the timer."),
            "used": msg(
                "Delete this line, and what uses this timer (lines: {lines}): line {line} creates "
                "the timer."
            ),
            "loop": msg("Create the timer only once, without the {loop} of line {line}."),
            "called": msg("Call {maker} only once, on line {line}."),
            "called_line": msg("Delete this line: line {line} calls {maker}."),
        },
        behind={"run.twice": _two},
        deletes=("line", "used", "called_line"),
        fixed_by=(node_count.twice, timer_place.one_timer),
        examples=(
            example(
                "two_timers",
                Replace(
                    NODE,
                    "self.create_timer(1.0, self.timer_callback)",
                    (
                        "self.create_timer(1.0, self.timer_callback)\n"
                        "        self.create_timer(1.0, self.timer_callback)"
                    ),
                ),
                fails="run.output",
            ),
        ),
    ),
)
