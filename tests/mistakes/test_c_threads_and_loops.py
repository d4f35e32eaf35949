"""Diagnoses of threads, loops, the start and the end of a node: each statement is true."""

from __future__ import annotations

import pytest

from grader.mistakes.recognise import behind_symptom
from grader.mistakes.recognised import RecognisedMistake, Suspect
from grader.package.source.threads import own_threads
from tests.marking import ASSIGNMENT
from tests.mistakes.other_forms import RIGHT, TIMER, changed
from tests.mistakes.test_from_source import line_of, look, node_in, raised
from tests.mistakes.test_spun_and_ended import texts

SPIN = "        rclpy.spin(node)\n"
INIT = "    rclpy.init(args=args)\n"
MADE = "    node = MyFirstNode()\n"
THREADING = (
    "import rclpy\n",
    "import threading\nimport time\nfrom threading import Thread\nimport rclpy\n",
)
NO_TIMER = (f"        {TIMER}\n", "")
LOOP = "        while rclpy.ok():\n            time.sleep(1.0)\n            node.timer_callback()\n"
OWN = ("def main(", "def spin_node(node):\n    rclpy.spin(node)\n\n\ndef main(")


def kind_of(found: RecognisedMistake | None) -> str:
    return "" if found is None else found.kind


THREADS = [
    "Thread(None, rclpy.spin, None, (node,), daemon=True).start()",
    "Thread(target=lambda: rclpy.spin(node), daemon=True).start()",
    "Thread(target=spin_node, args=(node,), daemon=True).start()",
    "Thread(None, spin_node, args=[node], daemon=True).start()",
]


@pytest.mark.parametrize("thread", THREADS)
def test_a_loop_beside_any_thread_that_spins_is_beside_spin(thread: str) -> None:
    text = changed(RIGHT, THREADING, NO_TIMER, OWN, (SPIN, f"        {thread}\n{LOOP}"))
    found = look("run.never_spins", text)
    assert kind_of(found) == "node.sleep_loop"
    why, fix = texts(found)
    assert "beside rclpy.spin" in why
    assert f"delete the thread that spins the node now (lines: {line_of(text, thread)})" in fix


@pytest.mark.parametrize("thread", THREADS)
def test_a_daemon_that_spins_in_any_form_is_told(thread: str) -> None:
    text = changed(RIGHT, THREADING, OWN, (SPIN, f"        {thread}\n"))
    assert kind_of(look("run.exits_at_once", text)) == "node.spin_in_daemon"


@pytest.mark.parametrize("daemon", ["thread.daemon = True", "thread.setDaemon(True)"])
def test_a_thread_that_is_made_a_daemon_later_is_one(daemon: str) -> None:
    made = f"        thread = Thread(target=rclpy.spin, args=(node,))\n        {daemon}\n"
    end = "    finally:\n        node.destroy_node()\n        rclpy.try_shutdown()\n"
    start = f"{made}        thread.start()\n"
    text = changed(RIGHT, THREADING, (SPIN, start), (end, ""))
    assert kind_of(look("run.exits_at_once", text)) == "node.spin_in_daemon"


@pytest.mark.parametrize("given", ["timeout=2.0", "2.0"])
def test_a_join_with_a_limit_waits_for_a_time(given: str) -> None:
    start = (
        "        thread = Thread(target=rclpy.spin, args=(node,))\n        thread.start()\n"
        f"        thread.join({given})\n"
    )
    text = changed(RIGHT, THREADING, (SPIN, start))
    why, fix = texts(look("run.ended_early", text))
    assert f"thread.join({given}) in line {line_of(text, 'thread.join')}" in why
    first = line_of(text, "thread = ")
    assert fix.endswith(f"of the thread (lines: {first}, {first + 1}, {first + 2}).")
    text = text.replace(f"thread.join({given})", "thread.join()")
    assert kind_of(look("run.ended_early", text)) != "node.spin_in_daemon"


def test_the_join_of_a_path_waits_for_nothing() -> None:
    start = (
        "        Thread(target=rclpy.spin, args=(node,), daemon=True).start()\n"
        "        print(os.path.join('a', 'b'))\n"
    )
    text = changed(RIGHT, (THREADING[0], f"import os\n{THREADING[1]}"), (SPIN, start))
    assert kind_of(look("run.exits_at_once", text)) == "node.spin_in_daemon"


@pytest.mark.parametrize("thread", THREADS[:2])
def test_a_thread_in_any_form_and_main_spin_twice(thread: str) -> None:
    text = changed(RIGHT, THREADING, (SPIN, f"        {thread}\n{SPIN}"))
    line = text.splitlines().index(SPIN.rstrip()) + 1
    found = raised("ValueError: generator already executing", text, line, "rclpy")
    assert kind_of(found) == "node.spun_twice"


@pytest.mark.parametrize(
    "old", [(SPIN, f"        while True:\n            pass\n{SPIN}"), (MADE, f"{MADE}{{}}")]
)
def test_a_loop_that_does_nothing_above_spin_in_a_try_is_told(old: tuple[str, str]) -> None:
    waits = "    while rclpy.ok():\n        pass\n"
    text = changed(RIGHT, (old[0], old[1].format(waits)))
    why, fix = texts(look("run.never_spins", text))
    assert f"line {line_of(text, 'rclpy.spin(node)')}, which spins the node, is not reached" in why
    assert fix.startswith("Delete this loop")


STEP = "        self.counter_ += 1\n"
IMPORTS = ("import rclpy\n", "import sys\nimport rclpy\n")
LIMIT = f"{STEP}        if self.counter_ > 3:\n            {{}}\n"


@pytest.mark.parametrize("end", ["raise SystemExit", "raise KeyboardInterrupt", "sys.exit()"])
@pytest.mark.parametrize("test", ["True", "rclpy.ok()", "node.running"])
def test_a_loop_that_goes_on_does_not_end_the_program(end: str, test: str) -> None:
    loop = f"        while {test}:\n            rclpy.spin_once(node)\n"
    made = f"{MADE}    node.running = True\n"
    text = changed(RIGHT, IMPORTS, (SPIN, loop), (MADE, made), (STEP, LIMIT.format(end)))
    assert kind_of(look("run.ended_early", text)) == "node.exits"
    assert kind_of(look("run.exits_at_once", text)) == ""
    other = text.replace("node.running = True", "node.running = False")
    found = "node.spin_loop_ends" if test == "node.running" else "node.exits"
    assert kind_of(look("run.ended_early", other)) == found


def test_spin_once_below_the_end_of_main_is_not_the_cause() -> None:
    once = "        rclpy.spin_once(node)\n"
    text = changed(RIGHT, IMPORTS, (SPIN, once), (MADE, f"{MADE}    sys.exit()\n"))
    found = look("run.exits_at_once", text)
    assert kind_of(found) == "node.spin_not_reached"
    assert f"line {line_of(text, 'spin_once')}, which spins" in texts(found)[0]
    text = changed(RIGHT, (SPIN, once), (MADE, f"{MADE}    return\n"))
    assert kind_of(look("run.exits_at_once", text)) == "node.return_early"


def test_spin_once_above_spin_does_not_end_the_program() -> None:
    once = f"        rclpy.spin_once(node)\n{SPIN}"
    text = changed(RIGHT, (SPIN, once), (STEP, LIMIT.format("rclpy.shutdown()")))
    assert kind_of(look("run.ended_early", text)) == "node.ends_in_callback"


def test_an_end_above_spin_did_not_run_if_the_lines_of_the_timer_came() -> None:
    usage = f"{INIT}    if len(sys.argv) > 20:\n        print('too many')\n        sys.exit(1)\n"
    text = changed(RIGHT, IMPORTS, (INIT, usage), (STEP, LIMIT.format("rclpy.shutdown()")))
    suspect = Suspect(node_in(text), ASSIGNMENT, lines=("Hello time: 0", "Hello time: 1"))
    found = behind_symptom("run.ended_early", suspect)
    assert kind_of(found) == "node.ends_in_callback"


def test_an_end_that_is_alone_in_its_function_leaves_a_pass() -> None:
    stop = "    def stop(self):\n        sys.exit()\n\n    def timer_callback"
    text = changed(
        RIGHT, IMPORTS, (STEP, LIMIT.format("self.stop()")), ("    def timer_callback", stop)
    )
    assert texts(look("run.ended_early", text))[1] == "Write pass instead of this line."


def test_the_end_of_another_node_does_not_end_this_one() -> None:
    made = "        self.counter_ = 0\n"
    helper = f"{made}        self.helper = rclpy.create_node('helper')\n"
    text = changed(RIGHT, (made, helper), (STEP, f"{STEP}        self.helper.destroy_node()\n"))
    assert kind_of(look("run.ended_early", text)) == ""
    text = changed(RIGHT, (STEP, f"{STEP}        self.destroy_node()\n"))
    assert kind_of(look("run.ended_early", text)) == "node.ends_in_callback"


RUN = """\
    def run(self):
        while rclpy.ok():
            self.timer_callback()
            time.sleep(1.0)

    def timer_callback"""
RUNS = ("    def timer_callback", RUN)


@pytest.mark.parametrize(
    "start", ["node.run()", "t = Thread(target=node.run)\n        t.start()\n        t.join()"]
)
def test_a_loop_in_a_method_is_not_in_main(start: str) -> None:
    text = changed(RIGHT, THREADING, NO_TIMER, RUNS, (SPIN, f"        {start}\n"))
    fix = texts(look("run.never_spins", text))[1]
    assert "what the loop in run does" in fix
    assert "rclpy.spin(node) in main instead of what calls or starts run now" in fix


@pytest.mark.parametrize("looped", [True, False])
def test_a_loop_above_spin_is_deleted_and_spin_stays(looped: bool) -> None:
    spin = f"    {SPIN}" if looped else SPIN
    text = changed(RIGHT, THREADING, NO_TIMER, (SPIN, LOOP + spin))
    fix = texts(look("run.never_spins", text))[1]
    line = line_of(text, "rclpy.spin(node)")
    assert fix.endswith(f"delete the loop: line {line} spins the node.") is not looped


@pytest.mark.parametrize("beside", [True, False])
def test_a_thread_is_beside_spin_only_if_spin_is_reached(beside: bool) -> None:
    start = "        self.counter_ = 0\n"
    made = f"{start}        t = Thread(target=self.run)\n        t.start()\n"
    for end, spin in (("", "        pass\n"), ("        t.join()\n", SPIN)):
        edit, spun = (made, SPIN) if beside else (made + end, spin)
        text = changed(RIGHT, THREADING, NO_TIMER, RUNS, (start, edit), (SPIN, spun))
        wanted = "node.thread_for_timer" if beside else "node.sleep_loop"
        assert kind_of(look("run.never_spins", text)) == wanted
        # (and daemon=True would not help there: nothing else keeps the program running)
        found = kind_of(look("run.ignores_interrupt", text))
        assert found == ("node.thread_for_timer" if beside else "")


LOG = "        self.get_logger().info('Hello time: ' + str(self.counter_))\n"
SET_UP = ("import rclpy\n", "import logging\nimport rclpy\nlogging.basicConfig(level=10)\n")


@pytest.mark.parametrize(
    ("line", "found"),
    [
        ("print('Hello time: ' + str(self.counter_))", False),
        ("logging.info('Hello time: ' + str(self.counter_))", True),
    ],
)
def test_logging_that_is_only_set_up_logs_nothing(line: str, found: bool) -> None:
    text = changed(RIGHT, SET_UP, (LOG, f"        {line}\n"))
    for symptom in ("run.print_not_logger", "run.wrong_text"):
        assert (kind_of(look(symptom, text)) == "node.python_logging") is found


def test_logging_beside_the_logger_of_the_node_does_not_log_the_lines() -> None:
    text = changed(RIGHT, SET_UP, (MADE, f"{MADE}    logging.info('made')\n"))
    assert kind_of(look("run.wrong_text", text)) != "node.python_logging"


def test_a_timer_of_python_for_something_else_is_not_the_cause() -> None:
    end = "    def end(self):\n        self.ended = True\n\n    def timer_callback"
    edits = (THREADING, ("    def timer_callback", end))
    made = "threading.Timer(9.0, self.{}).start()"
    text = changed(RIGHT, *edits, (TIMER, made.format("end")))
    assert kind_of(look("run.no_lines", text)) == "node.timer_missing"
    text = changed(RIGHT, *edits, (TIMER, made.format("timer_callback")))
    assert kind_of(look("run.no_lines", text)) == "node.threading_timer"


@pytest.mark.parametrize(("test", "ends"), [("running", True), ("other", False)])
def test_a_handler_of_ctrl_c_that_ends_the_loop_is_not_the_cause(test: str, ends: bool) -> None:
    stop = "    def stop(self, *_):\n        self.running = False\n\n    def timer_callback"
    made = (
        f"{MADE}    signal.signal(signal.SIGINT, node.stop)\n    node.running = node.other = True\n"
    )
    loop = f"        while node.{test}:\n            rclpy.spin_once(node, timeout_sec=0.1)\n"
    signals = ("import rclpy\n", "import signal\nimport rclpy\n")
    text = changed(RIGHT, signals, (MADE, made), ("    def timer_callback", stop), (SPIN, loop))
    found = kind_of(look("run.ignores_interrupt", text))
    assert (found != "node.signal_handler") is ends


def test_an_executor_may_get_the_node_through_a_name_of_add_node() -> None:
    spin = (
        "        executor = rclpy.executors.SingleThreadedExecutor()\n{}        executor.spin()\n"
    )
    add = "        add = executor.add_node\n        add(node)\n"
    for added, found in ((add, False), ("", True)):
        text = changed(RIGHT, (SPIN, spin.format(added)))
        kind = kind_of(look("run.never_spins", text))
        assert (kind == "node.executor_without_node") is found


@pytest.mark.parametrize(
    ("test", "found"),
    [("is None", False), ("< 0", False), ("> 3", True), (">= 3", True), ("== 3", True)],
)
def test_a_limit_is_a_condition_that_the_counter_makes_true(test: str, found: bool) -> None:
    early = f"        if self.counter_ {test}:\n            return\n{LOG}"
    text = changed(RIGHT, (LOG, early))
    assert (kind_of(look("run.stops", text)) == "node.return_early") is found


RUNNER = """\
class Runner(Thread):
    def __init__(self, node):
        super().__init__()
        self.node = node

    def run(self):
        rclpy.spin(self.node)


class MyFirstNode"""


def test_the_run_of_a_thread_is_called_by_its_start() -> None:
    start = "        Runner(node).start()\n"
    text = changed(RIGHT, THREADING, ("class MyFirstNode", RUNNER), (SPIN, start))
    assert kind_of(look("run.exits_at_once", text)) != "node.spin_not_reached"


def test_a_thread_that_is_not_started_does_not_spin() -> None:
    made = "        thread = Thread(target=rclpy.spin, args=(node,), daemon=True)\n"
    for start, kind in (
        ("", "node.spin_missing"),
        ("        thread.start()\n", "node.spin_in_daemon"),
    ):
        text = changed(RIGHT, THREADING, (SPIN, made + start))
        assert kind_of(look("run.exits_at_once", text)) == kind


@pytest.mark.parametrize(
    ("given", "kind"),
    [
        ("threading.Timer(0.1, rclpy.spin, [node]).start()", ""),
        ("Thread(target=partial(rclpy.spin, node), daemon=True).start()", "node.spin_in_daemon"),
        ("print(node)", "node.spin_missing"),
    ],
)
def test_spin_that_is_passed_on_is_not_missing(given: str, kind: str) -> None:
    text = changed(RIGHT, THREADING, (SPIN, f"        {given}\n"))
    assert kind_of(look("run.exits_at_once", text)) == kind


@pytest.mark.parametrize(
    ("tried", "line", "found"),
    [
        ("rclpy.spin_once(node)", "pass", True),
        ("rclpy.spin_once(node)", "running = False", False),
        ("node.value = int('3')", "pass", False),
    ],
)
def test_an_except_that_lets_the_loop_end_is_not_the_cause(
    tried: str, line: str, found: bool
) -> None:
    loop = (
        "        running = True\n        while running:\n            try:\n"
        f"                {tried}\n            except:\n                {line}\n"
        f"            rclpy.spin_once(node, timeout_sec=0)\n"
    )
    if "spin" in tried:
        loop = loop.replace("            rclpy.spin_once(node, timeout_sec=0)\n", "")
    text = changed(RIGHT, (SPIN, loop))
    kind = kind_of(look("run.ignores_interrupt", text))
    assert (kind == "node.interrupt_swallowed") is found


@pytest.mark.parametrize(("test", "found"), [("rclpy.ok()", False), ("self.counter_ < 3", True)])
def test_a_condition_that_is_always_true_does_not_stop_the_lines(test: str, found: bool) -> None:
    text = changed(RIGHT, (LOG, f"        if {test}:\n    {LOG}"))
    assert (kind_of(look("run.stops", text)) == "node.log_if") is found


@pytest.mark.parametrize(("rounds", "found"), [(3, False), (300, True)])
def test_a_loop_that_is_over_soon_does_not_keep_init_from_returning(
    rounds: int, found: bool
) -> None:
    loop = f"        for _ in range({rounds}):\n            time.sleep(0.1)\n"
    text = changed(RIGHT, THREADING, (TIMER, f"{TIMER}\n{loop}"))
    kind = kind_of(look("run.never_spins", text))
    assert (kind == "node.constructor_repeats") is found
    text = changed(RIGHT, THREADING, (STEP, STEP + loop))
    assert (kind_of(look("run.stops", text)) == "node.callback_repeats") is found


NOT_INITIALIZED = "rclpy.exceptions.NotInitializedException: rclpy.init() has not been called"
BUILD = "def build():\n    return MyFirstNode()\n\n\n"


@pytest.mark.parametrize("on_import", [True, False])
def test_a_function_that_is_called_on_import_makes_the_node_then(on_import: bool) -> None:
    made, inside = ("node = build()\n\n\n", "") if on_import else ("", "    node = build()\n")
    text = changed(RIGHT, (INIT + MADE, inside + INIT), ("def main(", f"{BUILD}{made}def main("))
    found = raised(NOT_INITIALIZED, text, line_of(text, "super()"), "rclpy")
    assert (kind_of(found) == "node.made_on_import") is on_import
    if on_import:
        assert found is not None
        assert found.where is not None
        assert found.where.line == line_of(text, "node = build()")
        assert texts(found)[1].startswith("Move this line into main, below rclpy.init(args=args)")


COUNTS = """\
class CountOnRead:
    def __init__(self):
        self._n = -1

    @property
    def number(self):
        self._n += 1
        return self._n


class MyFirstNode"""


@pytest.mark.parametrize(("second", "once"), [("else:", True), ("if self.other:", False)])
def test_a_property_in_two_branches_is_read_once(second: str, once: bool) -> None:
    log = "            self.get_logger().info('Hello time: ' + str(self.counter_.number))\n"
    text = changed(
        RIGHT,
        ("class MyFirstNode", COUNTS),
        ("self.counter_ = 0", "self.counter_ = CountOnRead()"),
        (LOG, f"        if self.active:\n{log}        {second}\n{log}"),
        (STEP, ""),
    )
    for symptom in ("run.wrong_start", "run.wrong_step"):
        assert (kind_of(look(symptom, text)) != "node.read_counts") is once


@pytest.mark.parametrize(("imports", "moves"), [("    import os\n", True), ("", False)])
def test_an_import_under_the_guard_moves_with_the_line_that_needs_it(
    imports: str, moves: bool
) -> None:
    guard = "if __name__ == '__main__':\n"
    at_top = "" if moves else "import os\n"
    text = changed(
        RIGHT,
        ("import rclpy\n", f"{at_top}import rclpy\n"),
        ("self.counter_ = 0", "self.counter_ = START"),
        (guard, f"{guard}{imports}    START = os.getpid()\n"),
    )
    line = line_of(text, "self.counter_ = START")
    fix = texts(raised("NameError: name 'START' is not defined", text, line))[1]
    assert ("the lines of that block that it needs" in fix) is moves


@pytest.mark.parametrize("daemon", ["t.daemon = True", "t.setDaemon(True)", "pass"])
@pytest.mark.parametrize("given", ["target=self.run", "None, self.run"])
def test_a_thread_with_a_loop_is_seen_in_each_form(given: str, daemon: str) -> None:
    start = f"        t = Thread({given})\n        {daemon}\n        t.start()\n"
    text = changed(RIGHT, THREADING, RUNS, (NO_TIMER[0], start))
    (thread,) = own_threads(node_in(text))
    assert thread.daemon is (daemon != "pass")
