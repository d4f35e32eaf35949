"""Mistakes in which something of Python or of another library is used in place of ROS's own."""

from __future__ import annotations

import ast
import re
from dataclasses import replace

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.example import LOG, NODE, SILENT, SPIN_UNTIL_CTRL_C, STEP_LINE, example
from grader.mistakes.fixes import lines, node_logging, node_loops, node_threads
from grader.mistakes.fixes.case import Case
from grader.mistakes.fixes.node_timer import value_of
from grader.mistakes.kind import Family
from grader.mistakes.recognised import Raised, RecognisedMistake, Suspect
from grader.package.edit.files import Files
from grader.package.edit.tree import Replace
from grader.package.source.counter import targets_of
from grader.package.source.imported import full_name, imports
from grader.package.source.lost_flag import lost_flag
from grader.package.source.module import Function, Module
from grader.package.source.names import dotted, last_part, own_name
from grader.package.source.node import NodeSource
from grader.package.source.python_logging import is_of_logging, python_logs
from grader.package.source.thread_timers import row_ranges, thread_timer

TIMER = "        self.create_timer(1.0, self.timer_callback)\n"
INLINE = """\
        timer = threading.Timer(1.0, self.timer_callback)
        timer.daemon = True
        timer.start()
"""
ROS_NODE = ("rclpy.node", "rclpy.lifecycle", "rclpy.lifecycle.node")


def _threading_timer(suspect: Suspect) -> RecognisedMistake | None:
    if suspect.source.timers:
        return None  # (the node's own timer calls the callback)
    for call in suspect.source.calls_of("Timer"):
        if full_name(suspect.source.module_of(call), call.func) == "threading.Timer":
            if thread_timer(suspect.source) is not None:
                return None
            method = suspect.source.methods.get(
                own_name(call.args[1] if len(call.args) > 1 else None)
            )
            if method is not None and not _may_log(suspect.source, method):
                continue  # (it does something else than the lines)
            found = suspect.finding("threading_timer", call)
            lines = _lines_of_timer(suspect, call)
            if not lines:
                return found
            words = {**found.words, "line": ", ".join(map(str, lines))}
            return replace(found, variant="used", words=words)
    return None


def _may_log(source: NodeSource, method: Function) -> bool:
    """Whether a method is the callback, or logs or prints."""
    tells = source.logs(method) or node_loops.prints_in(source, method)
    return method is source.callback or bool(tells)


def _thread_timer(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a timer of Python that is started again and again beside rclpy.spin."""
    found = thread_timer(suspect.source) if suspect.source.calls_of("spin") else None
    if found is None:
        return None
    made = f"{found.kept} = " if found.kept else ""
    written = f"{made}self.create_timer({suspect.assignment.seconds}, self.{found.method})"
    mistake = suspect.finding("thread_timer", found.call, name=found.method, written=written)
    at = found.first.lineno if found.first is not None else 0
    words = {**mistake.words, "line": at, "lines": row_ranges(found.rows)}
    variant = "" if found.is_certain else "uncertain"
    return replace(mistake, words=words, variant=variant if at or variant else "added")


def _lines_of_timer(suspect: Suspect, call: ast.Call) -> list[int]:
    """Return the lines that start a timer and set it up, in the function that creates it."""
    module, function = suspect.source.module_of(call), suspect.source.function_around(call)
    made = module.parents.get(call)
    names = set(targets_of(made)) if made is not None else set()
    uses = [n for n in ast.walk(function or module.tree) if isinstance(n, ast.Attribute)]
    lines = {use.lineno for use in uses if dotted(use.value) in names}
    chained = isinstance(made, ast.Attribute) and made.attr == "start"
    return sorted(lines - ({call.lineno} if not chained else set()))


def _python_logging(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a logger of Python's logging where the lines are logged."""
    source = suspect.source
    set_up = [c for c in source.calls_of("getLogger", "basicConfig") if _of_logging(source, c)]
    logs = [c for module in source.modules for c in python_logs(source, module.tree)]
    own = bool(source.callback and source.logs(source.callback))
    beside = own and not (source.callback and python_logs(source, source.callback))
    made = any(last_part(dotted(call.func)) == "getLogger" for call in set_up)
    if beside or not (logs or made):
        return None  # (the lines are printed, or logged with the node's own logger)
    calls = set_up or logs
    return suspect.finding("python_logging", calls[0]) if calls else None


def _of_logging(source: NodeSource, call: ast.Call) -> bool:
    return is_of_logging(source.module_of(call), call.func)


def _python_logging_hidden(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a callback that logs only with Python's logging, whose level hides the lines."""
    source, callback = suspect.source, suspect.source.callback
    if callback is None or not source.timers:
        return None
    own = [call for call in source.own_logs if call in ast.walk(callback)]
    logs = python_logs(source, callback)
    if own or not logs:
        return None
    found = suspect.finding("python_logging", logs[0])
    written = node_logging.log_of_node(source, logs[0])
    variant = "hidden_written" if written and len(logs) == 1 else "hidden"
    return replace(found, variant=variant, words={**found.words, "written": written})


def _signal_handler(suspect: Suspect) -> RecognisedMistake | None:
    """Look for a handler of Ctrl+C that does not end the program."""
    source = suspect.source
    if lost_flag(source.module) is not None:
        return None
    for call in source.calls_of("signal"):
        module = source.module_of(call)
        given = [*call.args, *(word.value for word in call.keywords)]
        called = full_name(module, call.func) == "signal.signal"
        if not called or len(given) != 2 or last_part(dotted(given[0])) != "SIGINT":
            continue
        if last_part(dotted(given[1])) == "SIG_IGN":
            return replace(suspect.finding("signal_handler", call), variant="ignored")
        if not last_part(dotted(given[1])).startswith("SIG_") and not _may_end(source, given[1]):
            return _with_loop(source, suspect.finding("signal_handler", call))
    return None


def _with_loop(source: NodeSource, found: RecognisedMistake) -> RecognisedMistake:
    """Name the loop that spins, if nothing calls spin."""
    loops = [
        n
        for n in source.all_nodes
        if isinstance(n, ast.While) and source.calls_of("spin_once", within=n)
    ]
    if len(loops) != 1 or source.calls_of("spin", "spin_until_future_complete"):
        return found
    return replace(found, variant="loop", words={**found.words, "line": str(loops[0].lineno)})


def _may_end(source: NodeSource, handler: ast.expr) -> bool:
    """Whether a handler of a signal has a part that ends the program, or ROS, or is unknown."""
    name = last_part(dotted(handler))
    defined: list[ast.AST] = [
        n for n in source.all_nodes if isinstance(n, Function) and n.name == name
    ]
    parts = [handler] if isinstance(handler, ast.Lambda) else defined
    ends = {"exit", "_exit", "quit", "shutdown", "try_shutdown", "kill", "set", "set_result"}
    tested = {
        last_part(dotted(part))
        for loop in source.all_nodes
        if isinstance(loop, ast.While)
        for part in ast.walk(loop.test)
    } - {""}
    sets = {last_part(name) for part in parts for n in ast.walk(part) for name in targets_of(n)}
    return (
        bool(tested & sets)
        or not parts
        or any(
            isinstance(n, ast.Raise)
            or (isinstance(n, ast.Call) and last_part(dotted(n.func)) in ends)
            for part in parts
            for n in ast.walk(part)
        )
    )


def _duration(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    del match
    source = raised.source
    timers = [t for t in source.timers if raised.line in (None, t.call.lineno)]
    if not timers:
        return None
    period = timers[0].period
    value = period
    if period is not None and not isinstance(period, ast.Call):
        value = value_of(source, period)
    written = raised.assignment.seconds
    if not isinstance(value, ast.Call):
        return raised.finding("period_duration", at=timers[0].call, written=written)
    name = source.module_of(value).text.code(value)
    found = raised.finding("period_duration", at=value, name=name, written=written)
    return replace(found, variant="value" if "\n" not in name else "")


def _other_node_class(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """Look for a base class that is imported from elsewhere than rclpy."""
    del match
    own = {found.name for module in raised.source.known_modules for found in module.classes}
    for found in raised.source.family:
        for base in map(dotted, found.bases):
            for bound, full, node in imports(raised.source.module_of(found)):
                if (
                    base == bound
                    and base not in own
                    and isinstance(node, ast.ImportFrom)
                    and node.module not in ROS_NODE
                ):
                    mistake = raised.finding("other_node_class", at=node, name=base, module=full)
                    right = _imported_before(raised.source.module_of(found), base, node)
                    if right is None:
                        return mistake
                    words = {**mistake.words, "line": str(right)}
                    return replace(mistake, words=words, variant="twice")
    return None


def _imported_before(module: Module, name: str, other: ast.AST) -> int | None:
    """Return the line above an import that imports the Node of ROS under the same name."""
    rows = [
        node.lineno
        for bound, _, node in imports(module)
        if isinstance(node, ast.ImportFrom) and node.module in ROS_NODE and bound == name
    ]
    last = getattr(other, "lineno", 0)
    return rows[0] if len(rows) == 1 and rows[0] < last else None


def _only_import(case: Case) -> Files | None:
    """Delete the import that replaces the Node of ROS, if it imports nothing else."""
    module, line = case.module, case.finding.line
    found = [
        (bound, node)
        for bound, _, node in (imports(module) if module is not None else ())
        if getattr(node, "lineno", 0) == line
    ]
    if module is None or len(found) != 1 or _imported_before(module, *found[0]) is None:
        return None
    return lines.deleted(case)


HIDDEN_LOG = msg(
    "This line logs with Python's logging module, which shows only warnings and errors unless it "
    "is set up. ROS does not know that logger, so its lines do not reach /rosout either."
)
_node = Family("node", links.FIRST_NODE)
KINDS = (
    _node(
        "threading_timer",
        "timer",
        msg("threading.Timer calls its function once"),
        msg("It is no ROS timer: it calls its function one time, and ROS time does not drive it."),
        msg(
            "Write self.create_timer({period}, self.{callback}) instead, without .start(): a ROS "
            "timer starts by itself."
        ),
        fixes={
            "used": msg(
                "Write self.create_timer({period}, self.{callback}) instead, and delete what "
                "starts or sets up the old timer (line {line}): a ROS timer starts by itself."
            )
        },
        behind={
            "run.no_lines": _threading_timer,
            "run.stops": _threading_timer,
            "run.wrong_period": _threading_timer,
        },
        examples=(
            example(
                "threading_timer",
                Replace(NODE, "import rclpy\nfrom", "import threading\n\nimport rclpy\nfrom"),
                Replace(
                    NODE,
                    "self.create_timer(1.0, self.timer_callback)",
                    (
                        "self.timer_ = threading.Timer(1.0, self.timer_callback)\n"
                        "        self.timer_.daemon = True\n"
                        "        self.timer_.start()"
                    ),
                ),
                fails="run.output",
                blocks=("run.period",),
            ),
        ),
    ),
    _node(
        "thread_timer",
        "timer",
        msg("threading.Timer is Python's timer, not the node's"),
        msg(
            "This line starts a timer of Python, in a thread beside rclpy.spin. ROS time does not "
            "drive it: in a simulation or a replay it runs at the wrong speed, and it does not "
            "stop when time stops. The node's own timer repeats by itself."
        ),
        msg(
            "In __init__, write {written} instead of line {line}. Then delete what belongs to the "
            "old timer (lines: {lines}). The node's timer calls {name} again and again."
        ),
        fixes={
            "added": msg(
                "Write {written} as the last line of __init__. Then delete what belongs to the "
                "old timer (lines: {lines}). The node's timer calls {name} again and again."
            ),
            "uncertain": msg(
                "Write {written} in __init__, once. Then delete everything that creates, sets up "
                "or starts a threading.Timer, in __init__ and in the methods: the node's timer "
                "calls {name} again and again."
            ),
        },
        behind=dict.fromkeys(
            (
                *("run.never_spins", "run.by_hand", "run.wrong_period", "run.stops"),
                "run.ignores_interrupt",
            ),
            _thread_timer,
        ),
        fixed_by=(node_threads.timer_of_node,),
        examples=(
            example(
                "thread_timer",
                Replace(NODE, "import rclpy\nfrom", "import threading\nimport rclpy\nfrom"),
                Replace(NODE, TIMER, INLINE),
                Replace(NODE, STEP_LINE, STEP_LINE + INLINE),
                fails="run.spins",
            ),
            example(
                "thread_timer_in_method",
                Replace(NODE, "import rclpy\nfrom", "import threading\nimport rclpy\nfrom"),
                Replace(
                    NODE, TIMER, "        self.schedule()\n\n    def schedule(self):\n" + INLINE
                ),
                Replace(NODE, STEP_LINE, f"{STEP_LINE}        self.schedule()\n"),
                fails="run.spins",
            ),
        ),
    ),
    _node(
        "python_logging",
        "logger",
        msg("The lines go through Python's logging module"),
        msg("ROS does not know that logger: its lines have another form and do not reach /rosout."),
        msg(
            "Write self.get_logger().info(…) in the callback. Change all other lines that use the logging "
            "module as well, then remove it."
        ),
        links.LOGGING,
        whys={"hidden": HIDDEN_LOG, "hidden_written": HIDDEN_LOG},
        fixes={
            "hidden_written": msg(
                "Write {written} on this line: the node's own logger, which takes one string. Change all "
                "other lines that use the logging module as well, then remove it."
            ),
            "hidden": msg(
                "Write self.get_logger().info(…) on this line: the node's own logger. Change all other "
                "lines that use the logging module as well, then remove it."
            ),
        },
        behind={
            "run.no_lines": _python_logging_hidden,
            "run.wrong_text": _python_logging,
            "run.print_not_logger": _python_logging,
            "run.other_logger": _python_logging,
        },
        fixed_by=(node_logging.own_logger,),
        examples=(
            example(
                "python_logging_not_set_up",
                Replace(NODE, "import rclpy\nfrom", "import logging\nimport rclpy\nfrom"),
                Replace(NODE, "self.get_logger().info", "logging.info"),
                fails="run.output",
                blocks=SILENT,
            ),
            example(
                "python_logger_of_the_file",
                Replace(
                    NODE,
                    "import rclpy\nfrom rclpy.node import Node\n",
                    "import rclpy\nfrom logging import getLogger\n"
                    "from rclpy.node import Node\n\nlogger = getLogger(__name__)\n",
                ),
                Replace(NODE, LOG, "logger.info('Hello time: %d', self.counter_)"),
                fails="run.output",
                blocks=SILENT,
            ),
            example(
                "python_logger_of_the_node",
                Replace(NODE, "import rclpy\nfrom", "import logging\nimport rclpy\nfrom"),
                Replace(
                    NODE,
                    "        self.counter_ = 0\n",
                    "        self.counter_ = 0\n"
                    "        self.logger = logging.getLogger('my_first_node')\n"
                    "        self.logger.setLevel(logging.INFO)\n",
                ),
                Replace(NODE, "self.get_logger().info", "self.logger.info"),
                fails="run.output",
                blocks=SILENT,
            ),
            example(
                "python_logging",
                Replace(
                    NODE,
                    "import rclpy\nfrom",
                    "import logging\n\nimport rclpy\nfrom",
                ),
                Replace(
                    NODE,
                    "    rclpy.init",
                    "    logging.basicConfig(level=logging.INFO)\n    rclpy.init",
                ),
                Replace(
                    NODE,
                    LOG,
                    "logging.getLogger('my_first_node').info('Hello time: ' + str(self.counter_))",
                ),
                fails="run.output",
                also={"run.logger": "node.python_logging"},
            ),
            example(
                "python_logging_bare",
                Replace(NODE, "import rclpy\nfrom", "import logging\nimport rclpy\nfrom"),
                Replace(
                    NODE,
                    "    rclpy.init(args=args)",
                    (
                        "    rclpy.init(args=args)\n"
                        "    logging.basicConfig(level=logging.INFO, format='%(message)s')"
                    ),
                ),
                Replace(NODE, "self.get_logger().info", "logging.info"),
                fails="run.logger",
            ),
        ),
    ),
    _node(
        "signal_handler",
        "shutdown",
        msg("The program changes what Ctrl+C does"),
        msg(
            "signal.signal replaces what Python and rclpy do at Ctrl+C: no KeyboardInterrupt comes, "
            "and spin goes on unless your function ends it."
        ),
        msg("Remove signal.signal and its function: Ctrl+C ends rclpy.spin by itself."),
        links.EXECUTORS,
        whys={
            "ignored": msg(
                "signal.SIG_IGN makes the program ignore Ctrl+C: no KeyboardInterrupt comes, and "
                "spin goes on."
            )
        },
        fixes={
            "ignored": msg(
                "Delete this line. An except KeyboardInterrupt around the line that spins ends the node "
                "without a traceback."
            ),
            "loop": msg(
                "Remove signal.signal and its function, and call rclpy.spin({node}) in place of the loop "
                "that begins in line {line}: Ctrl+C ends rclpy.spin by itself."
            ),
        },
        behind={"run.ignores_interrupt": _signal_handler},
        examples=(
            example(
                "signal_handler",
                Replace(NODE, "import rclpy\nfrom", "import signal\n\nimport rclpy\nfrom"),
                Replace(
                    NODE,
                    "    try:\n",
                    "    signal.signal(signal.SIGINT, lambda *_: None)\n    try:\n",
                ),
                fails="run.interrupt",
            ),
            example(
                "ctrl_c_only_prints",
                Replace(NODE, "import rclpy\nfrom", "import signal\n\nimport rclpy\nfrom"),
                Replace(
                    NODE,
                    SPIN_UNTIL_CTRL_C,
                    "    signal.signal(signal.SIGINT, lambda *_: print('bye'))\n    while rclpy.ok():\n"
                    "        rclpy.spin_once(node, timeout_sec=0.1)\n",
                ),
                fails="run.interrupt",
            ),
            example(
                "ctrl_c_ignored",
                Replace(NODE, "import rclpy\nfrom", "import signal\n\nimport rclpy\nfrom"),
                Replace(
                    NODE,
                    "    try:\n",
                    "    signal.signal(signal.SIGINT, signal.SIG_IGN)\n    try:\n",
                ),
                fails="run.interrupt",
            ),
        ),
    ),
    _node(
        "period_duration",
        "timer",
        msg("create_timer gets a duration as its period, and not a number"),
        msg("create_timer takes the period as a number of seconds."),
        msg("Write {written} as the period."),
        fixes={"value": msg("Write {written} instead of {name}.")},
        raised={
            r"TypeError: float\(\) argument must be .{1,60}not '(?:Duration|datetime\.timedelta)'": _duration
        },
        fixed_by=(lines.written,),
        examples=(
            example(
                "period_duration",
                Replace(
                    NODE, "from rclpy.node", "from rclpy.duration import Duration\nfrom rclpy.node"
                ),
                Replace(NODE, "create_timer(1.0,", "create_timer(Duration(seconds=1.0),"),
                fails="run.starts",
            ),
        ),
    ),
    _node(
        "other_node_class",
        "class",
        msg("The base class is not the Node of ROS"),
        msg("This line imports {module}, another class of that name, which is no ROS node."),
        msg("Write: from rclpy.node import Node"),
        fixes={
            "twice": msg(
                "Delete this line: it replaces the {name} that line {line} imports from ROS."
            )
        },
        raised={r"TypeError: .{1,80}\.__init__\(\) ": _other_node_class},
        fixed_by=(_only_import,),
        examples=(
            example(
                "other_node_class_below_that_of_ros",
                Replace(
                    NODE,
                    "from rclpy.node import Node\n",
                    "from rclpy.node import Node\nfrom xml.dom.minidom import Node\n",
                ),
                fails="run.starts",
            ),
            example(
                "other_node_class",
                Replace(NODE, "from rclpy.node import Node", "from xml.dom import Node"),
                fails="run.starts",
            ),
        ),
    ),
)
