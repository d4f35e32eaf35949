"""What the code of the node still lacks, with hints that end with the line to write."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from dataclasses import dataclass

from grader.base.i18n.message import Message, say
from grader.course.assignment import CheckUse
from grader.package.source.names import called_name, last_part
from grader.package.source.node_class import derives_from_node
from grader.package.source.python import SHEBANG, PythonFault, parse_python
from lab.guide.action import Action
from lab.guide.changes import code
from lab.guide.found import mistake
from lab.guide.state import StudentState
from lab.guide.sure import sure_mistake


@dataclass(frozen=True)
class Need:
    """A call that a node must make: why, and the line, with the values of a check in it."""

    kind: str
    call: str
    why: Message
    line: str

    def line_for(self, use: CheckUse | None) -> str:
        """Return the line for a use of the kind of check."""
        given = dict(use.with_) if use is not None else {}
        kind = str(given.get("type", "")).rpartition("/")[2] or "Type"
        values = {
            "type": kind,
            "topic": given.get("topic", "/topic"),
            "service": given.get("service", "/service"),
            "action": given.get("action", "/action"),
            "name": given.get("name", "name"),
            "period": given.get("period", 1.0),
        }
        return self.line.format(**values)


NEEDS = (
    Need(
        "topic.subscribes",
        "create_subscription",
        say("A subscription calls your function with each message."),
        "self.create_subscription({type}, '{topic}', self.callback, 10)",
    ),
    Need(
        "topic.publishes",
        "create_publisher",
        say("A publisher sends messages to a topic."),
        "self.publisher_ = self.create_publisher({type}, '{topic}', 10)",
    ),
    Need(
        "service.offers",
        "create_service",
        say("A service calls your function with each request and sends what it returns."),
        "self.create_service({type}, '{service}', self.callback)",
    ),
    Need(
        "service.calls",
        "create_client",
        say("A client sends requests to another node's service."),
        "self.client_ = self.create_client({type}, '{service}')",
    ),
    Need(
        "action.offers",
        "ActionServer",
        say("An action server calls your function with each goal."),
        "self.server_ = ActionServer(self, {type}, '{action}', self.execute)",
    ),
    Need(
        "parameter.declared",
        "declare_parameter",
        say("A node has only the parameters that it declares."),
        "self.declare_parameter('{name}', …)",
    ),
    Need(
        "topic.period",
        "create_timer",
        say("A timer calls your function again and again, while the node spins."),
        "self.create_timer({period}, self.callback)",
    ),
)
"""What a node must call for a kind of check."""
TIMER = NEEDS[-1]


def code_action(state: StudentState) -> Action | None:
    """Return what to do next in the node's file; None if nothing more is seen to be missing."""
    name = state.assignment.node_file
    text = state.read(state.node)
    if not text.strip():
        elsewhere = state.submission.newer_copy if state.workspace.is_dir() else ""
        copy = say("a newer copy of {file} is {path}", file=name, path=f"~/ros2_ws/{elsewhere}")
        write = say("Write the node in {file}.", file=name)
        return Action(write, "node.write", found=copy if elsewhere else "", place=_path(state))
    return _unreadable(state, text) or _lacking(state) or sure_mistake(state)


def _unreadable(state: StudentState, text: bytes) -> Action | None:
    name = state.assignment.node_file
    try:
        parse_python(text)
    except PythonFault as fault:
        known = mistake(state, "source.node_file")
        if known is not None:
            return known
        found = say("Python cannot read {file}: {reason}.", file=name, reason=fault.text)
        where = _path(state)
        look = say("Correct {place}.", place=where)
        if fault.line:
            look = say(
                "Correct {place}.",
                place=say("{file}, line {line}", file=where, line=fault.line),
            )
            where = f"{where}:{fault.line}"
        return Action(look, "source.syntax_error", found=found, place=where)
    if not text.startswith(b"#!"):
        found = say("the first line of {file} does not name its interpreter", file=name)
        write = say("Write as the first line of {file}: {line}", file=name, line=SHEBANG)
        why = say(
            "The first line names the program that runs a file: without it, ./{file} fails.",
            file=name,
        )
        return Action(write, "source.no_shebang", found, (why,), place=f"{_path(state)}:1")
    return None


def _lacking(state: StudentState) -> Action | None:
    name = state.assignment.node_file
    node = state.source
    if node is None:
        return None  # (only if the file is too large; the checks test whether it works)
    makes_node = any(last_part(name) == "create_node" for _, name in node.calls)
    if not makes_node and not any(derives_from_node(each) for each in node.module.classes):
        found = say("{file} has no class that inherits from Node yet", file=name)
        write = say("Write the class in {file}.", file=name)
        why = say("A class gets from Node what makes it a node: timers, topics, the logger.")
        line = code("class MyNode(Node):", place=name)
        return Action(write, "node.class", found, (why, line), place=_path(state))
    calls = {called_name(call) for call, _ in node.calls}
    for need, use in _needs(state):
        if need.call not in calls:
            found = say("the node in {file} does not call {call} yet", file=name, call=need.call)
            add = say("Call {call} in {file}.", file=name, call=need.call)
            if need is TIMER:
                found = say("the node in {file} has no timer yet", file=name)
                add = say("Add a timer in {file}.", file=name)
            where = say("Write it in __init__, after the line with super().__init__.")
            hints = (need.why, where, code(need.line_for(use), place=name))
            return Action(add, f"node.{need.call}", found, hints)
    function = state.assignment.function
    if node.main is None:
        found = say("{file} has no function {function} yet", file=name, function=function)
        write = say("Write the function {function} in {file}.", file=name, function=function)
        why = say("The entry point names the function that starts the node.")
        line = code(f"def {function}(args=None):", place=name)
        return Action(write, "node.main", found, (why, line), place=_path(state))
    named = {n.attr for n in node.all_nodes if isinstance(n, ast.Attribute)}
    if not any(name.startswith("spin") for name in calls | named):
        found = say("{file} does not spin the node yet, so the node would end at once", file=name)
        add = say("Call rclpy.spin in {file}.", file=name)
        why = say("spin waits and calls your callbacks until you press Ctrl+C.")
        where = say(
            "Write it in {function}, behind the line that makes the node.", function=function
        )
        return Action(add, "node.spin", found, (why, where, code("rclpy.spin(node)", place=name)))
    return None


def _path(state: StudentState) -> str:
    """Return the node's file below the package's folder."""
    return f"{state.assignment.package}/{state.assignment.node_file}"


def _needs(state: StudentState) -> Iterator[tuple[Need, CheckUse | None]]:
    uses = {use.kind: use for use in reversed(state.assignment.checks)}
    for need in NEEDS:
        if need.kind in uses:
            yield need, uses[need.kind]
        elif need is TIMER and not state.assignment.runs:
            yield need, None
