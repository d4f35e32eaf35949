"""A right node in other forms, mistakes in it, their symptoms in a run, and the fixed code."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from tests.corpus.build import SOLUTION
from tests.static_bench import NODE

INNER = "my_robot_controller"
OTHER = f"{INNER}/hello.py"
RIGHT = (SOLUTION / NODE).read_text(encoding="utf-8")
HEAD, END = RIGHT.split("def main(")
LOG = "self.get_logger().info('Hello time: ' + str(self.counter_))"
STEP = "        self.counter_ += 1\n"
START = "        self.counter_ = 0\n"
TIMER = "self.create_timer(1.0, self.timer_callback)"
SUPER = "        super().__init__('my_first_node')\n"
HELPER = '''\
class Settings:
    """Not part of the node."""

    def __init__(self, text='Hello'):
        super().__init__()
        self.counter_ = 5
        self.text = text

    def show(self):
        print(self.text)
        self.counter_ += 5
        self.counter_ = 7


'''
CLOSURE = """\
        count = 0

        def timer_callback():
            nonlocal count
            self.get_logger().info('Hello time: ' + str(count))
            count += 1

        self.create_timer(1.0, timer_callback)


"""


def changed(text: str, *edits: tuple[str, str]) -> str:
    """Return a text after edits, each of one place."""
    for old, new in edits:
        assert text.count(old) == 1, (text.count(old), old)
        text = text.replace(old, new)
    return text


def in_two_files(statement: str, made: str) -> dict[str, str]:
    """Return the node with its class in one file and main in another that imports it."""
    entry = f"#!/usr/bin/env python3\nimport rclpy\n{statement}\n\n\ndef main({END}"
    return {NODE: changed(entry, ("MyFirstNode()", made)), OTHER: HEAD.rstrip() + "\n"}


FORMS: Mapping[str, Mapping[str, str]] = {
    "helper before": {NODE: changed(RIGHT, ("class MyFirst", f"{HELPER}class MyFirst"))},
    "helper after": {NODE: changed(RIGHT, ("def main(", f"{HELPER}def main("))},
    "logger in attribute": {
        NODE: changed(RIGHT, (LOG, LOG.replace("get_logger()", "logger")),
                      (START, f"{START}        self.logger = self.get_logger()\n")),
    },
    "logger of another name": {
        NODE: changed(RIGHT, (LOG, LOG.replace("get_logger()", "out")),
                      (START, f"{START}        self.out = self.get_logger()\n")),
    },
    "logger in variable": {
        NODE: changed(RIGHT, (LOG, "logger = self.get_logger()\n        "
                              + LOG.replace("self.get_logger()", "logger"))),
    },
    "counter of module": {
        NODE: changed(RIGHT, (START, ""), ("class MyFirst", "count = 0\n\n\nclass MyFirst"),
                      (LOG, f"global count\n        {LOG.replace('self.counter_', 'count')}"),
                      (STEP, "        count += 1\n")),
    },
    "counter of class": {
        NODE: changed(RIGHT, (START, ""), ("    def __init__", "    count = 0\n\n    def __init__"),
                      (LOG, LOG.replace("self.counter_", "MyFirstNode.count")),
                      (STEP, "        MyFirstNode.count += 1\n")),
    },
    "counter around callback": {
        NODE: RIGHT[: RIGHT.index(START)] + CLOSURE + f"def main({END}",
    },
    "class imported": in_two_files(f"from {INNER}.hello import MyFirstNode", "MyFirstNode()"),
    "class renamed": in_two_files("from .hello import MyFirstNode as Hello", "Hello()"),
    "module imported": in_two_files("from . import hello", "hello.MyFirstNode()"),
    "main imported": {
        NODE: f"#!/usr/bin/env python3\nfrom {INNER}.hello import main\n\nmain()\n", OTHER: RIGHT,
    },
}  # fmt: skip


@dataclass(frozen=True)
class Slip:
    """A mistake: the edit of a right node that makes it, and its symptom in a run.

    `error` is the exception's line, `at` a part of the line that raises it. `code` is what the
    fixed file contains if it is not the right file itself. Names in braces are replaced by
    what a form calls that part.
    """

    mistake: str
    old: str
    new: str
    symptom: str
    error: str = ""
    at: str = ""
    code: str = ""
    but: tuple[str, ...] = ()
    only: tuple[str, ...] = ()

    @property
    def forms(self) -> tuple[str, ...]:
        """The forms in which this mistake is possible."""
        return self.only or tuple(form for form in FORMS if form not in self.but)


CLOSED = "counter around callback"
KEPT = ("logger in attribute", "logger of another name", "logger in variable")
OF_MODULE = "counter of module"
OF_CLASS = "counter of class"
DIED, ENDED, COUNTS = "run.died_at_start", "run.ended_early", "run.wrong_step"
SILENT, EXITS = "run.no_lines", "run.exits_at_once"
SLIPS = (
    Slip("node.callback_called", "{callback})", "{callback}())", "run.by_hand",
         but=(CLOSED,)),
    Slip("node.callback_misspelt", "{callback})", "1.0, self.timer_calback)", DIED,
         "AttributeError: 'MyFirstNode' object has no attribute 'timer_calback'", "calback)",
         but=(CLOSED,)),
    Slip("node.callback_without_self_dot", "{callback})", "1.0, timer_callback)", DIED,
         "NameError: name 'timer_callback' is not defined", ", timer_callback)", but=(CLOSED,)),
    Slip("node.callback_no_self", "timer_callback(self)", "timer_callback()", ENDED,
         "TypeError: MyFirstNode.timer_callback() takes 0 positional arguments but 1 was given",
         but=(CLOSED,)),
    Slip("node.timer_arguments", "(1.0, self.timer_callback)",
         "(self.timer_callback, 1.0)", DIED,
         "TypeError: float() argument must be a string or a real number, not 'method'",
         "create_timer", but=(CLOSED,)),
    Slip("node.timer_missing", f"        {TIMER}\n", "", SILENT, but=(CLOSED,)),
    Slip("node.period_wrong", "(1.0,", "(1000.0,", SILENT),
    Slip("run.wrong_period", "(1.0,", "(0.5,", "run.wrong_period"),
    Slip("node.counter_not_increased", "{step}", "", "run.constant_counter",
         but=(CLOSED, OF_MODULE)),
    Slip("node.f_prefix", "'Hello time: ' + str({counter})", "'Hello time: {{counter}}'",
         "run.wrong_text", code="(f'Hello time: {{counter}}')", but=(OF_CLASS,)),
    Slip("node.str_plus_int", "str({counter})", "{counter}", ENDED,
         'TypeError: can only concatenate str (not "int") to str', "Hello time: '"),
    Slip("node.logger_call", "'Hello time: ' +", "'Hello time: ',", ENDED,
         "TypeError: RcutilsLogger.info() takes 2 positional arguments but 3 were given",
         "Hello time: '", code="'Hello time: ' + str({counter})"),
    Slip("node.debug_level", ".info(", ".debug(", SILENT),
    Slip("run.wrong_level", ".info(", ".error(", "run.wrong_level"),
    Slip("node.print_used", "{logger}.info(", "print(", "run.print_not_logger", but=(CLOSED,)),
    Slip("node.logger_call", "self.get_logger()", "self.get_logger", ENDED,
         "AttributeError: 'function' object has no attribute 'info'", ".info(", but=KEPT),
    Slip("node.not_called", "self.get_logger()", "self.get_logger", ENDED,
         "AttributeError: 'function' object has no attribute 'info'", ".info(", only=KEPT),
    Slip("node.attribute_unknown", "self.get_logger()", "self.get_loger()", ENDED,
         "AttributeError: 'MyFirstNode' object has no attribute 'get_loger'", "get_loger"),
    Slip("node.attribute_not_set", START, "", ENDED,
         "AttributeError: 'MyFirstNode' object has no attribute 'counter_'", "Hello time: '",
         but=(CLOSED, OF_MODULE, OF_CLASS)),
    Slip("node.counter_local", "        global count\n", "", ENDED,
         "UnboundLocalError: cannot access local variable 'count'", "Hello time: '",
         only=(OF_MODULE,)),
    Slip("node.counter_local", "            nonlocal count\n", "", ENDED,
         "UnboundLocalError: cannot access local variable 'count'", "Hello time: '",
         only=(CLOSED,)),
    Slip("node.super_without_name", "__init__('my_first_node')", "__init__()", DIED,
         "TypeError: Node.__init__() missing 1 required positional argument: 'node_name'",
         "super().__init__()"),
    Slip("node.super_missing", SUPER, "", DIED,
         "AttributeError: 'MyFirstNode' object has no attribute '_logger'"),
    Slip("node.not_a_node", "MyFirstNode(Node):", "MyFirstNode:", DIED,
         "TypeError: object.__init__() takes exactly one argument (the instance to initialize)",
         but=(CLOSED,)),
    Slip("run.wrong_node_name", "'my_first_node'", "'my_node'", "run.wrong_node_name"),
    Slip("node.spin_missing", "        rclpy.spin(node)\n", "        pass\n", EXITS),
    Slip("node.spin_missing", "rclpy.spin(node)", "rclpy.spin", EXITS),
    Slip("node.spin_missing", "rclpy.spin(node)", "rclpy.spin_once(node)", EXITS),
    Slip("node.spin_of_other", "rclpy.spin(node)", "rclpy.spin({made})", DIED,
         "TypeError: 'property' object is not iterable", "rclpy.spin("),
    Slip("node.init_missing", "    rclpy.init(args=args)\n", "", DIED,
         "rclpy.exceptions.NotInitializedException: ('rclpy.init() has not been called', ...)"),
    Slip("node.main_wants_args", "main(args=None)", "main(args)", DIED,
         "TypeError: main() missing 1 required positional argument: 'args'"),
)  # fmt: skip
CASES = [(slip, form) for slip in SLIPS for form in slip.forms]


def filled(text: str, form: str) -> str:
    """Return a text with what a form calls its parts."""
    counter, start, indent = "self.counter_", "self.counter_", "        "
    if form in (OF_MODULE, CLOSED):
        counter = start = "count"
    if form == OF_CLASS:
        counter, start = "MyFirstNode.count", "count"
    logger = {"logger in attribute": "self.logger", "logger of another name": "self.out",
              "logger in variable": "logger"}.get(form, "self.get_logger()")  # fmt: skip
    indent += "    " if form == CLOSED else ""
    for name, written in {
        "{counter}": counter,
        "{start}": start,
        "{step}": f"{indent}{counter} += 1\n",
        "{logger}": logger,
        "{log}": f"{indent}{logger}.info('Hello time: ' + str({counter}))\n",
        "{callback}": "1.0, timer_callback" if form == CLOSED else "1.0, self.timer_callback",
        "{made}": {"class renamed": "Hello", "module imported": "hello.MyFirstNode"}.get(
            form, "MyFirstNode"
        ),
    }.items():
        text = text.replace(name, written)
    return text


def with_slip(slip: Slip, form: str) -> dict[str, str]:
    """Return the files of a form with a mistake in the one that has the place."""
    files = dict(FORMS[form])
    old, new = filled(slip.old, form), filled(slip.new, form)
    (path,) = [path for path, text in files.items() if old in text]
    files[path] = changed(files[path], (old, new))
    return files


def lines_with(part: str, files: Mapping[str, str]) -> Iterator[tuple[str, int]]:
    """Yield the places (file, line) of a text in files."""
    for path, text in files.items():
        for number, line in enumerate(text.splitlines(), start=1):
            if part in line:
                yield path, number
