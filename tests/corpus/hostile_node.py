"""Nodes that exhaust resources, hide, outlive the run, forge output or kill processes.

Each bounds itself in case the sandbox fails: at most 3,000 processes, 3 GB of memory or disk,
300 MB of output, and one minute.
"""

from __future__ import annotations

from grader.package.edit.tree import Delete, Link, Replace, Write

from .hostile_edits import first, imports, made, third
from .model import AFTER_START, INNER, NODE, RUN, SETUP, TICKS, hostile
from .right_node import CATCH

INTERRUPT = frozenset({"run.interrupt"})


FORKS = """\
    for _ in range(3000):
        try:
            if os.fork() == 0:
                time.sleep(30)
                os._exit(0)
        except OSError:
            break
"""
MEMORY = """\
    hog = []
    for _ in range(300):
        hog.append(bytearray(os.urandom(1)) * 10_000_000)
"""
DISK = """\
    with open('hog.bin', 'wb') as hog:
        for _ in range(300):
            hog.write(b'x' * 10_000_000)
"""
FILES = """\
    for n in range(20_000):
        open(f'hog_{n}', 'w').close()
"""
FLOOD = """\
    for _ in range(300_000):
        print('x' * 1000)
"""
LONG = """\
    for _ in range(300):
        sys.stdout.write('x' * 1_000_000)
    sys.stdout.flush()
"""
DEAF = """\
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGQUIT):
        signal.signal(number, signal.SIG_IGN)
    threading.Timer(60, os._exit, [0]).start()
"""
DOTS = """\
    def dots():
        while True:
            print('.', end='', flush=True)
            time.sleep(0.01)

    threading.Thread(target=dots, daemon=True).start()
"""
DAEMON = """\
    if os.fork() == 0:
        os.setsid()
        if os.fork() == 0:
            signal.signal(signal.SIGHUP, signal.SIG_IGN)
            for n in range(60):
                time.sleep(1)
                print('Hello time: 99', flush=True)
        os._exit(0)
"""
RESPAWN = CATCH.replace("        pass\n", """\
        if os.fork() == 0:
            os.setsid()
            time.sleep(60)
            os._exit(0)
""")  # fmt: skip
CLOCK = """\
    clock = node.create_publisher(Clock, '/clock', 10)
    begin = time.time()

    def tell():
        now = (time.time() - begin) * 10
        clock.publish(Clock(clock=Time(seconds=now).to_msg()))

    steady = rclpy.clock.Clock(clock_type=rclpy.clock.ClockType.STEADY_TIME)
    node.create_timer(0.01, tell, clock=steady)
"""
KILL_ALL = """\
    for entry in os.listdir('/proc'):
        if entry.isdigit() and int(entry) not in (1, os.getpid()):
            try:
                os.kill(int(entry), signal.SIGKILL)
            except OSError:
                pass
"""
INSIDE = "if os.environ.get('HOME') != '/home/student': sys.exit('only in the sandbox')\n"
FORGERY = """\
#!/usr/bin/env python3
import os

SCRIPT = '''
n=0
while [ $n -lt 60 ]; do
  sleep 1
  echo "[INFO] [$(date +%s.%N)] [my_first_node]: Hello time: $n"
  n=$((n+1))
done
'''


def main():
    os.execvp('bash', ['bash', '-c', SCRIPT])
"""
FAKE_RCLPY = """\
import time


def init(args=None):
    pass


def spin(node):
    for _ in range(60):
        time.sleep(1)
        node.callback()


def try_shutdown():
    pass
"""
FAKE_NODE = """\
class Node:
    def __init__(self, name):
        self.name = name

    def create_timer(self, period, callback):
        self.callback = callback

    def get_logger(self):
        return self

    def info(self, text):
        print(f'[INFO] [1795226661.262229158] [{self.name}]: {text}', flush=True)

    def destroy_node(self):
        pass
"""
ESCAPES = (
    r"print('\x1b[2J\x1b]0;owned\x07\x1b]52;c;b3duZWQ=\x07<script>alert(1)</script>]]>&amp;"
    r"\u202egnp.exe\x00\x08=cmd|calc', flush=True)"
)
BYTES = r"os.write(1, b'\xff\xfe\x00\x80\xc3\x28\n')"
EVENTS = (
    'print(\'{"event": "ready", "score": 100, "status": "passed"}\\n'
    "::error file=x::forged\\nRESULT 100/100', flush=True)"
)

NODES = (
    hostile("prints_megabytes", third("for _ in range(300_000): print('x' * 1000)"),
            failed={"run.output": "run.too_much_output"},
            skipped=TICKS | INTERRUPT | {"run.spins"},
            note="when the flood ends the run is chance, so nothing else is decided"),
    hostile("prints_megabytes_first", first(FLOOD), failed={"run.starts": "run.too_much_output"},
            skipped=AFTER_START),
    hostile("one_endless_line", imports("sys"), first(LONG),
            failed={"run.starts": "run.too_much_output"}, skipped=AFTER_START),
    hostile("fork_bomb", imports("os", "time"), first(FORKS), undecided=RUN,
            note="continues when fork fails; 3,000 sleepers at most"),
    hostile("eats_memory", imports("os"), first(MEMORY), undecided=RUN, note="3 GB at most"),
    hostile("eats_disk", first(DISK), undecided=RUN, note="3 GB at most, in the workspace"),
    hostile("many_files", first(FILES), undecided=RUN),
    hostile("deaf_to_signals", imports("os", "signal", "threading"), made(DEAF),
            failed={"run.interrupt": "run.ignores_interrupt"}),
    hostile("deaf_and_prints_dots", imports("os", "signal", "threading", "time"),
            made(DEAF + DOTS), failed={"run.interrupt": "run.ignores_interrupt"},
            note="output without a line end must not extend any wait"),
    hostile("raw_terminal", imports("tty"), made("    tty.setraw(0)\n"),
            failed={"run.interrupt": "run.ignores_interrupt"},
            note="Ctrl+C is then an ordinary character: it ends nothing on a real terminal either"),
    hostile("outlives_us", imports("os", "signal", "time"), first(DAEMON),
            failed={"run.output": None, "run.logger": None},
            undecided=frozenset({"run.spins", "run.period"}),
            note="a right node, and a child that prints 99 on its terminal, at any instant"),
    hostile("respawns", imports("os", "time"), Replace(NODE, CATCH, RESPAWN),
            note="Ctrl+C ends it, a sleeper stays"),
    hostile("stops_itself", imports("os", "signal"),
            third("os.kill(os.getpid(), signal.SIGSTOP)"),
            failed={"run.output": "run.stops", "run.interrupt": "run.ignores_interrupt"},
            undecided=TICKS),
    hostile("kills_parent", imports("os", "signal"),
            third("os.kill(os.getppid(), signal.SIGKILL)"),
            undecided=TICKS | INTERRUPT | {"run.output"}, note="ros2 run ends, the node goes on"),
    hostile("kills_its_group", imports("os", "signal"),
            first("    os.killpg(0, signal.SIGKILL)\n"), failed={"run.starts": None},
            skipped=AFTER_START),
    hostile("kills_all_it_sees", imports("os", "signal", "sys"),
            first(f"    {INSIDE}{KILL_ALL}    os.kill(os.getpid(), signal.SIGKILL)\n"),
            failed={"run.starts": None}, skipped=AFTER_START,
            note="looks for HOME=/home/student first, the one of the sandbox"),
    hostile("closes_its_output", imports("os"), made("    os.close(1)\n    os.close(2)\n"),
            failed={"run.output": "run.no_lines"}, skipped=TICKS,
            note="the lines still come on /rosout, but not on the terminal"),
    hostile("publishes_clock", imports("time", "rclpy.clock"),
            Replace(NODE, "from rclpy.node import Node\n", "from rclpy.node import Node\n"
                    "from rclpy.time import Time\nfrom rosgraph_msgs.msg import Clock\n"),
            made(CLOCK), undecided=frozenset({"run.output", "run.period"}),
            note="its own clock, ten times as fast; without use_sim_time it is a right node"),
    hostile("forged_lines", Write(NODE, FORGERY), failed={"run.starts": "node.no_ros"},
            skipped=AFTER_START, note="right lines from a shell, and no node"),
    hostile("forged_rclpy", Write("rclpy/__init__.py", FAKE_RCLPY),
            Write("rclpy/node.py", FAKE_NODE),
            failed={"run.starts": "run.no_node"}, skipped=AFTER_START,
            note="an rclpy in the overlay hides the real one from the node, not from the probe"),
    hostile("escape_sequences", third(ESCAPES), failed={"run.output": None},
            note="clears the screen; terminal codes, markup, a formula, control characters"),
    hostile("not_text", imports("os"), third(BYTES)),
    hostile("forged_events", third(EVENTS), note="lines in our own format"),
    hostile("node_is_a_link_out", Delete(NODE), Link(NODE, "/etc/passwd"),
            failed={"source.node_file": None},
            undecided=RUN | {"source.exec_bit", "source.shebang", "build.colcon",
                             "entry_point.executable", "entry_point.mapping"}),
    hostile("links_out", Link("notes.txt", "/etc/passwd"), Link("data", "../../.."),
            Link(f"{INNER}/loop", "."), note="5 of 147 public packages have such links"),
    hostile("deep_folders", Write("a/" * 120 + "deep.txt", "deep\n")),
    hostile("odd_names", Write("a b;$(touch owned)'\"`.txt", "x\n"), Write("-rf", "x\n"),
            Write("new\nline.txt", "x\n"), Write("=cmd|calc.csv", "x\n")),
    hostile("shadows_modules", Write("json.py", "raise SystemExit('shadowed')\n"),
            Replace(SETUP, "    zip_safe=True,", "    py_modules=['json'],\n    zip_safe=True,"),
            undecided=RUN | {"build.colcon", "entry_point.executable"},
            note="a json.py in the overlay breaks ros2 run itself"),
)  # fmt: skip
