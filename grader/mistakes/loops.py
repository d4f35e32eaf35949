"""Mistakes in which a loop of the node does what a timer does, so that nothing spins."""

from __future__ import annotations

import ast
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.base.shown import shown
from grader.mistakes import links
from grader.mistakes.example import DEAD, LOG_LINE, NODE, SILENT, STEP_LINE, example
from grader.mistakes.fixes import node_loops
from grader.mistakes.kind import Family
from grader.mistakes.recognised import RecognisedMistake, Suspect
from grader.mistakes.timer import cancel_in
from grader.package.edit.tree import Replace
from grader.package.source.counter import parts_of_callback
from grader.package.source.endless import Loop, calls_of_methods, endless_loop, goes_on, sleeps_in
from grader.package.source.names import calls_in, dotted, last_part
from grader.package.source.node import NodeSource
from grader.package.source.place import statement_at

SHORT = 2.0  # seconds
IMPORT = Replace(NODE, "import rclpy\nfrom", "import rclpy\nfrom time import sleep\nfrom")
TIMER_LINE = "        self.create_timer(1.0, self.timer_callback)\n"
WHILE_OK = Replace(
    NODE,
    LOG_LINE + STEP_LINE,
    f"        while rclpy.ok():\n    {LOG_LINE}    {STEP_LINE}            sleep(1.0)\n",
)


def _word(loop: Loop) -> str:
    return "while" if isinstance(loop, ast.While) else "for"


def _is_short(source: NodeSource, loop: Loop) -> bool:
    """Whether a loop of a few rounds with short sleeps is over soon, and does not log."""
    rounds = loop.iter if isinstance(loop, ast.For) else None
    if not isinstance(rounds, ast.Call) or dotted(rounds.func) != "range" or source.logs(loop):
        return False
    given = [*rounds.args[-1:], *(arg for c in sleeps_in(source, loop) for arg in c.args)]
    values = [arg.value if isinstance(arg, ast.Constant) else None for arg in given]
    numbers = [value for value in values if isinstance(value, int | float)]
    calls = [method for _, method in calls_of_methods(source, loop)]
    known = len(numbers) == len(values) and len(rounds.args) == 1 and not calls
    return known and numbers[0] * sum(numbers[1:]) < SHORT


def _in_callback(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a loop that does not end, or that sleeps, in what the timer calls."""
    source, callback = suspect.source, suspect.source.callback
    if callback is None or callback.name not in {timer.method for timer in source.timers}:
        return None
    for function in (callback, *(method for _, method in calls_of_methods(source, callback))):
        loop = endless_loop(source, function)
        if loop is not None and not _is_short(source, loop):
            found = suspect.finding("callback_repeats", loop, name=_word(loop))
            stop = cancel_in(source, function)
            if stop is not None and stop.lineno < loop.lineno:
                code = shown(ast.unparse(stop))
                words = {**found.words, "code": code, "line": stop.lineno}
                return replace(found, variant="cancelled", words=words)
            return replace(found, variant="sleep" if sleeps_in(source, loop) else "")
    return None


def _waits_for_an_answer(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a loop of the callback that waits until a future is done."""
    callback = suspect.source.callback
    for loop in ast.walk(callback) if callback is not None else ():
        for call, name in calls_in(loop.test) if isinstance(loop, ast.While) else ():
            if last_part(name) == "done" and not call.args and isinstance(call.func, ast.Attribute):
                module = suspect.source.module_of(loop)
                future = module.text.code(call.func.value)
                return suspect.finding("answer_waited", call, name=future)
    return None


def _through_a_generator(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a for of the callback that asks an endless generator for all its values."""
    source = suspect.source
    methods = {**source.module.functions, **source.methods}
    for loop in (n for part in parts_of_callback(source) for n in ast.walk(part)):
        call = loop.iter if isinstance(loop, ast.For) else None
        made = methods.get(last_part(dotted(call.func))) if isinstance(call, ast.Call) else None
        if made is None or call is None or not isinstance(loop, ast.For):
            continue
        endless = [n for n in ast.walk(made) if isinstance(n, ast.While) and goes_on(n)]
        if endless and any(isinstance(n, ast.Yield) for n in ast.walk(endless[0])):
            if any(isinstance(n, ast.Break | ast.Return) for n in ast.walk(loop)):
                continue
            text = source.module_of(loop).text
            found = suspect.finding("endless_generator", loop, name=made.name)
            words = {
                **found.words,
                "line": endless[0].lineno,
                "written": text.code(call),
                "code": text.code(loop.target),
            }
            return replace(found, words=words)
    return None


def _sleeps_in_callback(suspect: Suspect) -> RecognisedMistake | None:
    """The same for a loop that sleeps: another one that is silent is no timer's work."""
    found = _in_callback(suspect)
    return found if found is not None and found.variant == "sleep" else None


def _floods_in_callback(suspect: Suspect) -> RecognisedMistake | None:
    """The same for a loop that logs or prints, and does not sleep."""
    found = _in_callback(suspect)
    if found is None or found.variant or found.where is None:
        return None
    line, module = found.where.line, suspect.source.module_at(found.where.file)
    loops = [n for n in module.nodes if isinstance(n, Loop) and n.lineno == line]
    logs = any(node_loops.prints_in(suspect.source, loop) for loop in loops)
    return replace(found, variant="flood") if logs else None


def _in_main(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a loop of main that prints or logs without a pause, and has no end."""
    loop = node_loops.printing_loop(suspect.source)
    if loop is None or not suspect.source.timers:
        return None
    found = suspect.finding("main_prints", loop, name=_word(loop))
    after = node_loops.spins_after(suspect.source, loop)
    return replace(found, variant="spins" if after else "")


def _in_constructor(suspect: Suspect) -> RecognisedMistake | None:
    """The same, told for a program that spins the node below the loop, or nowhere."""
    found = _constructor(suspect)
    variant = f"{found.variant}_unspun".lstrip("_") if found is not None else ""
    spins = any(last_part(name).startswith("spin") for _, name in suspect.source.calls)
    return replace(found, variant=variant) if found and variant in UNSPUN and not spins else found


def _constructor(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a loop that keeps __init__ from returning."""
    source, init = suspect.source, suspect.source.methods.get("__init__")
    if init is None:
        return None
    direct = endless_loop(source, init)
    for loop, call in [(direct, None)] + [
        (endless_loop(source, method), call) for call, method in calls_of_methods(source, init)
    ]:
        if loop is None or _is_short(source, loop):
            continue
        found = suspect.finding("constructor_repeats", loop, name=_word(loop))
        seconds = node_loops.seconds_of(source, loop, suspect.assignment)
        found = replace(found, words={**found.words, "period": seconds})
        if source.timers:
            return replace(found, variant="timer")
        only = node_loops.only_call(source, loop)
        if call is None and only:
            return replace(found, variant="calls", words={**found.words, "method": only})
        method = source.function_around(loop)
        if call is None or method is None:
            logging = [
                name for name, m in source.methods.items() if m is not init and source.logs(m)
            ]
            if len(logging) != 1:
                return found
            return replace(found, variant="calls", words={**found.words, "method": logging[0]})
        words = {**found.words, "method": method.name, "line": str(call.lineno)}
        module = source.module_of(call)
        alone = isinstance(module.parents.get(call), ast.Expr)
        statement = statement_at(module, call.lineno)
        kept = isinstance(statement, ast.Assign) and not alone
        if statement is not None and kept:
            words["code"] = shown(module.text.code(statement))
            words["name_kept"] = (
                ast.unparse(statement.targets[0]) if isinstance(statement, ast.Assign) else ""
            )
        return replace(found, variant="inside" if kept else "method", words=words)
    return None


UNSPUN = ("unspun", "timer_unspun", "calls_unspun", "method_unspun")
NOT_SPUN = msg(
    "While this loop runs, __init__ does not return, and ROS can call no callback of the node. No line "
    "of the program spins the node: there is no rclpy.spin."
)
_node = Family("node", links.EXECUTORS)
KINDS = (
    _node(
        "answer_waited",
        "callback",
        msg("A callback waits for an answer"),
        msg(
            "This loop waits until {name} is done. ROS runs one callback at a time: what brings the answer "
            "can run only when {callback} has returned, so the loop never ends."
        ),
        msg(
            "Delete the loop. Put what needs the answer into a method of its own that gets the future, and "
            "pass this method to {name}.add_done_callback(…): ROS calls it when the answer has come."
        ),
        behind=dict.fromkeys(
            ("run.never_spins", "run.no_lines", "run.stops"), _waits_for_an_answer
        ),
        examples=(
            example(
                "callback_waits_for_a_future",
                IMPORT,
                Replace(
                    NODE,
                    "from rclpy.node import Node\n",
                    "from rclpy.node import Node\nfrom rclpy.task import Future\n",
                ),
                Replace(
                    NODE,
                    LOG_LINE,
                    "        future = Future()\n"
                    "        self.create_timer(0.1, lambda: future.set_result(1))\n"
                    "        while not future.done():\n"
                    f"            sleep(0.01)\n{LOG_LINE}",
                ),
                fails="run.output",
                blocks=SILENT,
            ),
        ),
    ),
    _node(
        "endless_generator",
        "callback",
        msg("The callback runs through a generator that has no end"),
        msg(
            "for asks {name} for one value after the other until there is none left. The loop in line {line} "
            "has no end, so this for has none either, and {callback} does not return."
        ),
        msg(
            "Make the generator once: write self.values_ = {written} in __init__. In {callback}, write "
            "{code} = next(self.values_) instead of this for line, and indent its lines one step less."
        ),
        behind=dict.fromkeys(
            ("run.too_much_output", "run.twice", "run.never_spins", "run.no_lines", "run.stops"),
            _through_a_generator,
        ),
        examples=(
            example(
                "callback_runs_through_a_generator",
                Replace(
                    NODE,
                    "    def timer_callback",
                    "    def lines(self):\n        while True:\n"
                    "            yield 'Hello time: ' + str(self.counter_)\n"
                    "            self.counter_ += 1\n\n    def timer_callback",
                ),
                Replace(
                    NODE,
                    LOG_LINE + STEP_LINE,
                    "        for line in self.lines():\n            self.get_logger().info(line)\n",
                ),
                fails="run.output",
                blocks=("run.spins", "run.logger", "run.period", "run.interrupt"),
            ),
        ),
    ),
    _node(
        "callback_repeats",
        "callback",
        msg("The callback repeats in a loop what the timer repeats"),
        msg(
            "The timer calls {callback} again in each period. While the loop in it runs, it does "
            "not return, and the timer cannot call it again."
        ),
        msg("Delete this {name}, and indent its lines as far as the {name} is indented now."),
        whys={
            "cancelled": msg(
                "The timer calls {callback} only once: {code} (line {line}) stops it. While the loop runs, "
                "{callback} does not return, and ROS can call nothing else of the node, such as what wakes "
                "a rate."
            ),
            "flood": msg(
                "This loop does not wait, and logs without end. While it runs, the callback does "
                "not return, and the timer cannot call it again."
            ),
        },
        fixes={
            "sleep": msg(
                "Delete this {name} and the sleep in it, and indent its other lines as far as the "
                "{name} is indented now: the timer repeats them already."
            ),
            "cancelled": msg(
                "Delete {code} (line {line}), this {name}, and what waits in it, and indent its other lines "
                "as far as the {name} is indented now. Then the timer repeats them."
            ),
        },
        behind={
            "run.never_spins": _in_callback,
            "run.no_lines": _sleeps_in_callback,
            "run.stops": _sleeps_in_callback,
            "run.twice": _in_callback,
            "run.too_much_output": _floods_in_callback,
        },
        fixed_by=(node_loops.without_loop,),
        examples=(
            example(
                "while_and_sleep_in_callback",
                IMPORT,
                WHILE_OK,
                fails="run.spins",
            ),
            example(
                "callback_stops_its_timer_and_loops",
                IMPORT,
                Replace(
                    NODE, "        self.create_timer(", "        self.timer_ = self.create_timer("
                ),
                Replace(
                    NODE,
                    LOG_LINE + STEP_LINE,
                    "        self.timer_.cancel()\n"
                    f"        while rclpy.ok():\n    {LOG_LINE}    {STEP_LINE}            sleep(1.0)\n",
                ),
                fails="run.spins",
            ),
            example(
                "while_ok_logs_in_callback",
                Replace(NODE, LOG_LINE, f"        while rclpy.ok():\n    {LOG_LINE}"),
                fails="run.output",
                blocks=("run.spins", *DEAD),
            ),
        ),
    ),
    _node(
        "main_prints",
        "spin",
        msg("A loop prints without a pause, and the node does not spin"),
        msg(
            "This loop does not wait between two lines, and does not end. While it runs, the lines "
            "below it do not run, and ROS can call no callback."
        ),
        msg(
            "Delete this {name} and its lines, and write rclpy.spin({node}) instead: the timer "
            "calls {callback} in each period."
        ),
        fixes={
            "spins": msg(
                "Delete this {name} and its lines: rclpy.spin waits, and the timer calls "
                "{callback} in each period."
            )
        },
        behind=dict.fromkeys(
            (
                *("run.never_spins", "run.too_much_output", "run.constant_counter"),
                *("run.wrong_period", "run.twice", "run.print_not_logger", "run.no_node"),
            ),
            _in_main,
        ),
        fixed_by=(node_loops.spin_for_loop,),
        examples=(
            example(
                "while_prints_in_main",
                Replace(
                    NODE,
                    "        rclpy.spin(node)\n",
                    "        while True:\n            print('Hello time: 0')\n",
                ),
                fails="run.output",
                blocks=("run.spins", *DEAD),
            ),
        ),
    ),
    _node(
        "constructor_repeats",
        "spin",
        msg("A loop keeps __init__ from returning, so spin is not reached"),
        msg(
            "{function} creates the node and then spins it. While this loop runs, __init__ does "
            "not return: rclpy.spin is not called, and ROS can call no callback of the node."
        ),
        msg(
            "Put the lines of the loop into a method, without the {name} and without a sleep, and "
            "create a timer here that calls it: self.create_timer({period}, self.{callback})"
        ),
        whys=dict.fromkeys(UNSPUN, NOT_SPUN),
        fixes={
            "unspun": msg(
                "Put the lines of the loop into a method, without the {name} and without a sleep, and "
                "create a timer here that calls it: self.create_timer({period}, self.{callback}) Then "
                "call rclpy.spin with the node in {function}."
            ),
            "timer_unspun": msg(
                "Delete this {name} with all its lines, and call rclpy.spin with the node in {function}: "
                "the timer calls {callback} in each period then."
            ),
            "calls_unspun": msg(
                "Write self.create_timer({period}, self.{method}) instead of this {name} with all its "
                "lines, and call rclpy.spin with the node in {function}: the timer calls {method} in "
                "each period then."
            ),
            "method_unspun": msg(
                "Write self.create_timer({period}, self.{method}) instead of self.{method}() on "
                "line {line}. Delete this {name} and the sleep in it, and indent its other lines "
                "as far as the {name} is indented now. Then call rclpy.spin with the node in {function}."
            ),
            "timer": msg(
                "Delete this {name} with all its lines: the timer calls {callback} in each period."
            ),
            "calls": msg(
                "Write self.create_timer({period}, self.{method}) instead of this {name} with all its "
                "lines: the timer calls {method} in each period."
            ),
            "inside": msg(
                "Write self.create_timer({period}, self.{method}) instead of {code} (line {line}), and "
                "delete the lines below it that use {name_kept}. Delete this {name} and the sleep in "
                "it, and indent its other lines as far as the {name} is indented now."
            ),
            "method": msg(
                "Write self.create_timer({period}, self.{method}) instead of self.{method}() on "
                "line {line}. Delete this {name} and the sleep in it, and indent its other lines "
                "as far as the {name} is indented now."
            ),
        },
        deletes=("timer", "timer_unspun"),
        behind={
            "run.never_spins": _in_constructor,
            "run.no_lines": _in_constructor,
            "run.twice": _in_constructor,
        },
        fixed_by=(node_loops.timer_for_loop, node_loops.timer_for_calls),
        examples=(
            example(
                "while_in_method_of_constructor",
                IMPORT,
                WHILE_OK,
                Replace(NODE, TIMER_LINE, "        self.timer_callback()\n"),
                fails="run.spins",
            ),
            example(
                "while_with_a_rate_in_method_of_constructor",
                Replace(
                    NODE,
                    LOG_LINE + STEP_LINE,
                    f"        while rclpy.ok():\n    {LOG_LINE}    {STEP_LINE}"
                    "            self.rate.sleep()\n",
                ),
                Replace(
                    NODE,
                    TIMER_LINE,
                    "        self.rate = self.create_rate(1)\n        self.timer_callback()\n",
                ),
                fails="run.spins",
                also={"run.output": "node.rate_sleep"},
                blocks=("run.period",),
            ),
            example(
                "while_logs_in_constructor",
                IMPORT,
                Replace(
                    NODE,
                    TIMER_LINE,
                    f"        while True:\n    {LOG_LINE}    {STEP_LINE}            sleep(1.0)\n",
                ),
                fails="run.spins",
            ),
            example(
                "while_in_constructor_beside_timer",
                IMPORT,
                Replace(
                    NODE,
                    TIMER_LINE,
                    f"{TIMER_LINE}        while rclpy.ok():\n            self.timer_callback()\n"
                    "            sleep(1.0)\n",
                ),
                fails="run.spins",
            ),
            example(
                "while_in_constructor",
                IMPORT,
                Replace(
                    NODE,
                    TIMER_LINE,
                    "        while True:\n            self.timer_callback()\n"
                    "            sleep(1.0)\n",
                ),
                fails="run.spins",
            ),
        ),
    ),
)
