"""What the code of the node still lacks, with hints that end with the line to write."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from grader.base.i18n.message import Message, say
from grader.course.assignment import CheckUse
from grader.package.source.names import called_name
from grader.package.source.node_class import derives_from_node
from grader.package.source.python import SHEBANG, PythonFault, parse_python
from lab.guide.action import Action
from lab.guide.found import mistake
from lab.guide.state import StudentState


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
        return Action(write, "node.write", found=copy if elsewhere else "")
    return _unreadable(state, text) or _lacking(state)


def _unreadable(state: StudentState, text: bytes) -> Action | None:
    name = state.assignment.node_file
    try:
        parse_python(text)
    except PythonFault as fault:
        known = mistake(state, "source.node_file")
        if known is not None:
            return known
        found = say("Python cannot read {file}: {reason}.", file=name, reason=fault.text)
        look = say("Look at line {line}.", line=fault.line) if fault.line else ""
        return Action(look, "source.syntax_error", found=found)
    if not text.startswith(b"#!"):
        first = say("The first line of {file} must name its interpreter.", file=name)
        return Action(first, "source.no_shebang", hints=(SHEBANG,))
    return None


def _lacking(state: StudentState) -> Action | None:
    name = state.assignment.node_file
    node = state.source
    if node is None:
        return None  # (only if the file is too large; the checks test whether it works)
    if not any(derives_from_node(each) for each in node.module.classes):
        none = say("{file} has no class that inherits from Node yet.", file=name)
        return Action(none, "node.class", hints=("class MyNode(Node):",))
    calls = {called_name(call) for call, _ in node.calls}
    for need, use in _needs(state):
        if need.call not in calls:
            lacks = say("The node in {file} does not call {call} yet.", file=name, call=need.call)
            if need is TIMER:
                lacks = say("The node in {file} has no timer yet.", file=name)
            where = say("Write it in __init__, after the line with super().__init__.")
            return Action(lacks, f"node.{need.call}", hints=(need.why, where, need.line_for(use)))
    function = state.assignment.function
    if node.main is None:
        none = say("{file} has no function {function} yet.", file=name, function=function)
        why = say("The entry point names the function that starts the node.")
        return Action(none, "node.main", hints=(why, f"def {function}(args=None):"))
    if not any(call.startswith("spin") for call in calls):
        ends = say("{file} does not spin the node yet, so the node would end at once.", file=name)
        why = say("spin waits and calls your callbacks until you press Ctrl+C.")
        return Action(ends, "node.spin", hints=(why, "rclpy.spin(node)"))
    return None


def _needs(state: StudentState) -> Iterator[tuple[Need, CheckUse | None]]:
    uses = {use.kind: use for use in reversed(state.assignment.checks)}
    for need in NEEDS:
        if need.kind in uses:
            yield need, uses[need.kind]
        elif need is TIMER and not state.assignment.runs:
            yield need, None
