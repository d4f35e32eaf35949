"""What in a package's source a person should look at, and what asks for a closer observation.

A node may ask where it runs (arguments, variables, files of the system) and behave otherwise there;
it may end, or stop to count, by itself. Both have honest uses: nothing here costs points. A node
that asks is run once more as a person would run it; one that could end is watched for longer.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Literal

from grader.package.intake.model import SourceFile
from grader.package.source.kept import keep_small
from grader.package.source.module import Module, parse_module
from grader.package.source.names import calls_in, dotted, last_part
from grader.package.source.python import PythonFault

Kind = Literal["asks", "ends", "hides", "rosout"]
MOST_REMARKS = 8  # of one kind
MOST_BYTES = 60_000
"""Of a file that is read; a larger one cannot be looked through, which is a remark itself."""

ASKS = {
    "sys.argv",
    "sys.orig_argv",
    "os.environ",
    "os.environb",
    "os.getenv",
    "os.getuid",
    "os.geteuid",
    "os.getlogin",
    "os.uname",
    "os.listdir",
    "os.scandir",
    "os.path.exists",
    "os.path.isdir",
    "os.path.isfile",
    "os.stat",
    "os.access",
    "os.isatty",
    "os.ttyname",
    "os.sched_getaffinity",
    "socket.gethostname",
    "getpass.getuser",
    "platform.node",
    "pwd.getpwuid",
    "environ",
    "getenv",
    "argv",
}
ASKS_BY_CALL = {  # files, programs, who else is on the graph, clocks that do not follow ROS time
    "check_output",
    "exists",
    "is_dir",
    "is_file",
    "iterdir",
    "open",
    "popen",
    "read_bytes",
    "read_text",
    "count_publishers",
    "count_subscribers",
    "get_node_names",
    "get_node_names_and_namespaces",
    "get_publishers_info_by_topic",
    "get_subscriptions_info_by_topic",
    "get_service_names_and_types",
    "get_topic_names_and_types",
    "get_publisher_names_and_types_by_node",
    "get_subscriber_names_and_types_by_node",
    "get_subscription_count",
    "wait_for_node",
    "monotonic",
    "monotonic_ns",
    "perf_counter",
    "perf_counter_ns",
    "process_time",
    "time",
    "time_ns",
    "clock_gettime",
}
OTHER_CLOCKS = {"STEADY_TIME", "SYSTEM_TIME"}
ASKED_TEXTS = re.compile(
    r"use_sim_time|^/clock$|^clock$|/proc\b|/etc/|/sys/|dockerenv|bwrap|grader"
)
ROSOUT = re.compile(r"rosout")
ENDS_ANYWHERE = {
    "_exit",
    "abort",
    "kill",
    "killpg",
    "alarm",
    "setitimer",
    "raise_signal",
    "Timer",
    "Thread",
    "Process",
    "Popen",
    "fork",
    "system",
    "dump_traceback_later",
    "execv",
    "execve",
}
ENDS_IN_A_CLASS = {
    "exit",
    "quit",
    "shutdown",
    "try_shutdown",
    "cancel",
    "destroy_timer",
    "destroy_node",
    "destroy_publisher",
    "monotonic",
    "time",
    "perf_counter",
}
HIDES = {"exec", "eval", "__import__", "import_module", "CDLL", "PyDLL", "loads"}
COMPILED = (".so", ".pyc", ".pyd", ".pyo")
NOT_THE_NODE = re.compile(r"(^|/)(setup\.py|test/.*|tests/.*|launch/.*|conftest\.py)$")


@dataclass(frozen=True)
class Remark:
    """A place in the source; `what` is the name or the text that was found there."""

    kind: Kind
    path: str
    line: int | None
    what: str


def remarks_on(files: Sequence[SourceFile]) -> list[Remark]:
    """Return the remarks on a package's files, at most MOST_REMARKS of each kind."""
    found: list[Remark] = []
    for file in files:
        if file.kind != "file" or NOT_THE_NODE.search(file.path):
            continue
        if file.path.endswith(COMPILED):
            found.append(Remark("hides", file.path, None, file.path.rpartition(".")[2]))
        elif file.path.endswith(".py"):
            found += _in_file(file.path, file.data)
    kept: list[Remark] = []
    for remark in dict.fromkeys(found):
        if sum(other.kind == remark.kind for other in kept) < MOST_REMARKS:
            kept.append(remark)
    return kept


@keep_small
def _in_file(path: str, found: bytes) -> tuple[Remark, ...]:
    """Return the remarks on one file; the session, a check and the report ask for them."""
    if len(found) > MOST_BYTES:
        return (Remark("hides", path, None, f"{len(found)} bytes"),)
    try:
        module = parse_module(path, found)
    except PythonFault:
        return ()
    return (*_names(module), *_texts(module), *_calls(module))


def _names(module: Module) -> Iterator[Remark]:
    for node in module.nodes:
        if not isinstance(node, ast.Attribute | ast.Name) or not isinstance(node.ctx, ast.Load):
            continue
        name = dotted(node)
        if (name in ASKS and not is_passed_on(module, node)) or last_part(name) in OTHER_CLOCKS:
            yield Remark("asks", module.path, node.lineno, name)


def is_passed_on(module: Module, node: ast.AST) -> bool:
    """Whether a name is only handed to rclpy.init or main, as many examples do.

    Also as one of two values: `args or sys.argv`, `sys.argv if args is None else args`.
    """
    inner, outer = node, module.parents.get(node)
    while isinstance(outer, ast.BoolOp) or (
        isinstance(outer, ast.IfExp) and inner is not outer.test
    ):
        inner, outer = outer, module.parents.get(outer)
    if isinstance(outer, ast.keyword):
        outer = module.parents.get(outer)
    return isinstance(outer, ast.Call) and last_part(dotted(outer.func)) in ("init", "main")


def _texts(module: Module) -> Iterator[Remark]:
    for node in module.nodes:
        if not isinstance(node, ast.Constant) or not isinstance(node.value, str):
            continue
        if isinstance(module.parents.get(node), ast.Expr):
            continue  # a docstring
        if ROSOUT.search(node.value):
            yield Remark("rosout", module.path, node.lineno, node.value[:60])
        if ASKED_TEXTS.search(node.value):
            yield Remark("asks", module.path, node.lineno, node.value[:60])
    for node in module.nodes:
        if isinstance(node, ast.keyword) and node.arg == "enable_rosout":
            yield Remark("rosout", module.path, node.value.lineno, "enable_rosout")


def _calls(module: Module) -> Iterator[Remark]:
    for call, name in calls_in(module.tree):
        last = last_part(name)
        if name == "compile" or last in HIDES or (last == "getattr" and _is_made_up(call)):
            yield Remark("hides", module.path, call.lineno, name)
        if last in ASKS_BY_CALL:
            yield Remark("asks", module.path, call.lineno, name)
        if last in ENDS_ANYWHERE or (last in ENDS_IN_A_CLASS and _is_in_a_class(module, call)):
            yield Remark("ends", module.path, call.lineno, name)
    for node in module.nodes:
        if isinstance(node, ast.Raise) and _is_in_a_class(module, node):
            yield Remark("ends", module.path, node.lineno, "raise")


def _is_made_up(call: ast.Call) -> bool:
    """Whether the name that getattr gets is not written in the source as it is."""
    return len(call.args) > 1 and not isinstance(call.args[1], ast.Constant)


def _is_in_a_class(module: Module, node: ast.AST) -> bool:
    return any(isinstance(outer, ast.ClassDef) for outer in module.around(node))
