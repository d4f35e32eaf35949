"""A scenario in the process of the node itself, in ROS time without any waiting: a program for the sandbox.

`Scene` is given to a `ShortRun` (grader/run/run_variants.py), which calls it when a node was made and
each time the node has nothing to do. It acts on the node as the probe of a real run does, with
publishers and clients of its own and with the same worlds, and keeps what the node does. What it
finds is no proof: the student's code runs in the same process.
"""

from __future__ import annotations

import contextlib
import inspect
import sys
from collections.abc import Callable, Iterator
from types import FrameType
from typing import Any

from rclpy.callback_groups import CallbackGroup
from rclpy.executors import SingleThreadedExecutor
from rclpy.logging import LoggingSeverity
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.publisher import Publisher
from rclpy.qos import DurabilityPolicy, ReliabilityPolicy
from rclpy.subscription import Subscription

from grader.run.in_probe.messages import Values, fill, interface, is_sent_as_it_is

SECOND = 1_000_000_000
MOST_MESSAGES = 4_000
SOON, SELDOM = 20, 16  # how often it acts between two looks at the nodes, later on
MOST_LOGS = 600
MOST_POSES = 4_000
LONGEST = 2_000  # characters of a line
PATIENCE = 20_000_000  # ns of wall time in which what was sent arrives
OF_ROS = ("use_sim_time", "start_type_description_service")
TYPES = {
    Parameter.Type.BOOL: "bool",
    Parameter.Type.INTEGER: "integer",
    Parameter.Type.DOUBLE: "double",
    Parameter.Type.STRING: "string",
}


class Untouched(CallbackGroup):  # type: ignore[misc]
    """A callback group of which the executor runs nothing."""

    def can_execute(self, _: Any) -> bool:
        """Return False: what it holds is taken by hand."""
        return False

    def beginning_execution(self, _: Any) -> bool:
        """Return False."""
        return False

    def ending_execution(self, _: Any) -> None:
        """Do nothing."""


class Scene:
    """One scenario: `plan` has what is done (`do`), the `end` (ns), and the `world` if there is one.

    `is_working` is set while the scene itself uses ROS. `patience` is how long the node waits next for
    what was sent to it.
    """

    def __init__(self, plan: dict[str, Any], world: Any) -> None:
        self._waiting = sorted(plan["do"], key=lambda one: one["at"])
        self._watch = set(plan["watch"])
        self._end, self._world_class = plan["end"], world
        self._trace: Any = None
        self.is_working = False
        self.patience = 0
        self._tester: Any = None
        self._executor: Any = None
        self._world: Any = None
        self._home: Any = None  # the world's node
        self._nodes: list[Any] = []
        self._names: dict[str, None] = {}  # (a node that the program destroys has none any more)
        self._owners: dict[int, Any] = {}  # nodes by the id() of their publishers
        self._kept: list[Any] = []
        self._asked = False  # whether the node may have asked the world
        self._calls: list[tuple[dict[str, Any], Any, int]] = []  # what was done, its client, number
        self._publishers: dict[str, Any] = {}
        self._clients: dict[str, Any] = {}
        self._messages: list[list[Any]] = []
        self._counts: dict[str, int] = {}
        self._done: list[dict[str, Any]] = []
        self._events: list[dict[str, Any]] = []
        self._logs: list[list[Any]] = []
        self._parameters: dict[str, dict[str, dict[str, Any]]] = {}
        self._ends: dict[tuple[str, ...], dict[str, Any]] = {}
        self.now = 0  # ns since the start
        self._acts = 0
        self.is_plain = False  # whether the node is spun by one thread, which does nothing else
        self._inbox: list[tuple[Any, Any]] = []  # subscriptions, and what they get without ROS

    @property
    def limit(self) -> int:
        """When the scenario is over (ns)."""
        return int(self._end)

    def install(self, traced: Any) -> None:
        """Keep what the nodes publish; `traced` notes from where."""
        self._trace, scene = traced, self
        create, publish = Node.create_publisher, Publisher.publish

        def create_publisher(node: Any, *args: Any, **named: Any) -> Any:
            made = create(node, *args, **named)
            scene._owners[id(made)] = node
            scene._kept.append(made)
            return made

        def published(publisher: Any, message: Any) -> None:
            if not scene._passes_on(publisher, message):
                publish(publisher, message)
            scene._published(publisher, message)

        Node.create_publisher = create_publisher
        Publisher.publish = published
        from rclpy.client import Client  # noqa: PLC0415

        call = Client.call_async

        def call_async(client: Any, request: Any) -> Any:
            scene._asked = True
            if traced is not None and not scene.is_working:
                traced.asked(client.srv_name, scene.now, sys._getframe(1))
            return call(client, request)

        Client.call_async = call_async

    def _passes_on(self, publisher: Any, message: Any) -> bool:
        """Take a message that needs no ROS on its way: between the world and the node, or to nobody.

        The way through ROS costs a millisecond, a world sends a thousand messages in a run, and a search
        needs dozens of runs.
        """
        if self._world is None or self._tester is None:
            return False
        topic, kind = publisher.topic_name, type(message)
        heard = self._heard(topic)
        if not self.is_working:
            if not is_sent_as_it_is(message):
                return False
            is_reliable = publisher.qos_profile.reliability == ReliabilityPolicy.RELIABLE
            return bool(not heard and is_reliable and self._world.given(topic, message))
        if self._owners.get(id(publisher)) is not self._home:
            return False  # (a message of the scenario)
        fits = all(one.msg_type is kind and _takes_plainly(one) for one in heard)
        if heard and not (self.is_plain and fits):
            return False
        self._inbox += [(one, message) for one in heard]
        return True

    def _heard(self, topic: str) -> list[Any]:
        return [s for n in self._nodes for s in n.subscriptions if _topic_of(n, s) == topic]

    def _deliver(self) -> None:
        """Call the callbacks of what was taken, as the executor does."""
        taken, self._inbox = self._inbox, []
        for subscription, message in taken:
            subscription.callback(message)

    def _published(self, publisher: Any, message: Any) -> None:
        node = self._owners.get(id(publisher))
        topic = publisher.topic_name
        ours = self.is_working
        if topic in ("/rosout", "/parameter_events") or (ours and topic not in self._watch):
            return
        self._counts[topic] = self._counts.get(topic, 0) + 1
        if len(self._messages) >= MOST_MESSAGES:
            return
        name = node.get_fully_qualified_name() if node is not None and not ours else "-"
        with contextlib.suppress(Exception):  # (what cannot be sent cannot be shown)
            self._messages.append([topic, self.now, Values().of(message), name])
            if self._trace is not None and not ours:
                self._trace.published(topic, self.now, sys._getframe(2))

    def logged(self, severity: int, name: str, text: str) -> None:
        """Keep a line of a logger."""
        if len(self._logs) < MOST_LOGS:
            self._logs.append([self.now, severity, name, text[:LONGEST]])

    @contextlib.contextmanager
    def working(self) -> Iterator[None]:
        """Use ROS for the scene itself."""
        before, self.is_working = self.is_working, True
        try:
            yield
        finally:
            self.is_working = before

    def made(self, node: Any) -> None:
        """Take a node of the student's; the first one brings the scene's own node and world."""
        self._nodes.append(node)
        self._names[node.get_fully_qualified_name()] = None
        if self._tester is not None:
            return
        with self.working():
            own = {"enable_rosout": False, "use_global_arguments": False, "context": node.context}
            self._tester = Node("_ros2cli_daemon_0", start_parameter_services=False, **own)
            self._executor = SingleThreadedExecutor(context=node.context)
            if self._world_class is not None:
                home = Node(self._world_class.NAME, start_parameter_services=False, **own)
                self._home = home
                home.get_logger().set_level(LoggingSeverity.FATAL)  # (a line costs half a ms)
                self._executor.add_node(home)
                self._world = self._world_class(home, Untouched())

    def next(self) -> list[int]:
        """Return the instants (ns) at which something is to be done."""
        found = [one["at"] for one in self._waiting[:1]]
        if self._world is not None and self._hears():
            found.append(self._world.now + self._world.STEP)
        return [*found, self._end]

    def _hears(self) -> bool:
        return any(one.get_subscription_count() > 0 for one in self._sent())

    def _sent(self) -> list[Any]:
        return list(self._world.sent) or []

    def act(self) -> bool:
        """Do what is due now; return whether the node may have something to do because of it."""
        if self._trace is not None:
            self._trace.now = self.now
        self.is_plain = _is_plain(sys._getframe(1))
        self._acts += 1
        with self.working():
            if self._acts < SOON or self._acts % SELDOM == 0:
                self.look()
            self._take_replies()
            acted = self._serve()
            if self._world is not None:
                acted = self._move_world() or acted
            if not self._inbox and self._waiting and self._waiting[0]["at"] <= self.now:
                one = self._waiting.pop(0)
                self._do(one)
                return True
        self._deliver()
        return acted

    def _serve(self) -> bool:
        if not self._asked:
            return False
        self._asked = False
        for _ in range(6):
            self._executor.spin_once(timeout_sec=0)
        self._take_events()
        self.patience = PATIENCE
        return True

    def _move_world(self) -> bool:
        world, moved = self._world, False
        world.collect(self.now)
        hears = self._hears()
        while world.now + world.STEP <= self.now:
            world.advance(world.now + world.STEP if hears else self.now)
            moved = hears and not self._inbox
            if moved:
                self.patience = PATIENCE
        self._take_events()
        return moved

    def _take_events(self) -> None:
        if self._world is not None and self._world.events:
            self._events += [{**event, "at": self.now} for event in self._world.events]
            self._world.events = []

    def _do(self, one: dict[str, Any]) -> None:
        done = {"name": one["name"], "at": self.now, "heard": 0, "accepted": {}}
        self._done.append(done)
        self.patience = PATIENCE
        with contextlib.suppress(Exception):  # (a type that does not fit: nobody hears it)
            acts: dict[str, Callable[[dict[str, Any], dict[str, Any]], None]] = {
                "publish": self._publish,
                "call": self._call,
                "set": self._set,
                "place": self._place,
            }
            acts[one["how"]](one, done)

    def _publish(self, one: dict[str, Any], done: dict[str, Any]) -> None:
        kind, topic = interface(one["type"]), one["topic"]
        if topic not in self._publishers:
            self._publishers[topic] = self._tester.create_publisher(kind, topic, 10)
        message = kind()
        fill(message, one["values"])
        publisher = self._publishers[topic]
        done["heard"] = publisher.get_subscription_count()
        publisher.publish(message)

    def _ask(self, kind: Any, service: str, request: Any, done: dict[str, Any]) -> None:
        if service not in self._clients:
            self._clients[service] = self._tester.create_client(kind, service)
        client = self._clients[service]
        done["heard"] = int(client.service_is_ready())
        if done["heard"]:
            with client.handle:
                self._calls.append((done, client, client.handle.send_request(request)))

    def _call(self, one: dict[str, Any], done: dict[str, Any]) -> None:
        kind = interface(one["type"])
        request = kind.Request()
        fill(request, one["values"])
        self._ask(kind, one["service"], request, done)
        self._asked = self._world is not None  # (whose services are spun when something was asked)

    def _set(self, one: dict[str, Any], done: dict[str, Any]) -> None:
        from rcl_interfaces.srv import SetParameters  # noqa: PLC0415

        names = {node.get_fully_qualified_name() for node in self._nodes}
        name = one["node"] if one["node"] in names or len(names) != 1 else names.pop()
        wanted = [Parameter(key, value=value) for key, value in one["values"].items()]
        request = SetParameters.Request(parameters=[each.to_parameter_msg() for each in wanted])
        done["set"] = list(one["values"])
        self._ask(SetParameters, f"{name}/set_parameters", request, done)

    def _place(self, one: dict[str, Any], done: dict[str, Any]) -> None:
        turtle = one["turtle"] or self._world.unnamed(one["kind"])
        place = getattr(self._world, one["kind"])
        done["heard"] = int(place(turtle, one["x"], one["y"], one["theta"]))

    def _take_replies(self) -> None:
        for call in list(self._calls):
            done, client, _ = call
            with client.handle:
                _, reply = client.handle.take_response(client.srv_type.Response)
            if reply is None:
                continue
            self._calls.remove(call)
            if "set" in done:
                results = zip(done.pop("set"), reply.results)
                done["accepted"] = {
                    name: "" if one.successful else one.reason[:200] or "refused"
                    for name, one in results
                }
            else:
                done["reply"], done["replied"] = Values().of(reply), self.now

    def look(self) -> None:
        """Keep the ends and the parameters of the nodes as they are now."""
        for node in self._nodes:
            with contextlib.suppress(Exception):  # (the node may be gone)
                self._look_at(node)

    def _look_at(self, node: Any) -> None:
        name = node.get_fully_qualified_name()
        known = self._parameters.setdefault(name, {})
        for key, one in list(node._parameters.items()):
            if key not in known and key not in OF_ROS:
                about = node._descriptors.get(key)
                ranges = [*about.floating_point_range, *about.integer_range] if about else []
                known[key] = {
                    "name": key,
                    "type": TYPES.get(one.type_, one.type_.name.lower()),
                    "value": one.value,
                    "read_only": bool(about.read_only) if about else False,
                    "range": [ranges[0].from_value, ranges[0].to_value] if ranges else None,
                }
        for role, found in (
            ("publisher", node.publishers),
            ("subscription", node.subscriptions),
            ("service", node.services),
            ("client", node.clients),
        ):
            for end in list(found):
                of_topic = role in ("publisher", "subscription")
                called = end.topic_name if of_topic else end.srv_name
                kind = end.msg_type if of_topic else end.srv_type
                if not called.startswith("/"):
                    called = node.resolve_topic_name(called)
                key = (name, role, called)
                if key not in self._ends:
                    qos = end.qos_profile
                    self._ends[key] = {
                        "node": name,
                        "role": role,
                        "name": called,
                        "type": _type_name(kind),
                        "reliability": qos.reliability.name.lower() if of_topic else "",
                        "durability": qos.durability.name.lower() if of_topic else "",
                    }

    def found(self) -> dict[str, Any]:
        """Return what was seen."""
        with contextlib.suppress(Exception):
            self.look()
            with self.working():
                self._take_replies()
        path = [] if self._world is None else self._world.steps[:MOST_POSES]
        return {
            "messages": self._messages,
            "counts": self._counts,
            "done": [{k: v for k, v in one.items() if k != "set"} for one in self._done],
            "events": self._events,
            "logs": self._logs,
            "ends": list(self._ends.values()),
            "parameters": {name: list(each.values()) for name, each in self._parameters.items()},
            "path": [list(each) for each in path],
            "step": 0 if self._world is None else self._world.STEP,
            "nodes": list(self._names),
            "now": self.now,
        }


def _takes_plainly(subscription: Any) -> bool:
    """Whether a subscription only calls a plain function with the message, at any quality of service."""
    return (
        subscription.qos_profile.durability == DurabilityPolicy.VOLATILE
        and getattr(subscription, "_callback_type", None) is Subscription.CallbackType.MessageOnly
        and not inspect.iscoroutinefunction(subscription.callback)
        and not subscription.raw
    )


def _topic_of(node: Any, subscription: Any) -> str:
    name = str(subscription.topic_name)
    return name if name.startswith("/") else str(node.resolve_topic_name(name))


def _is_plain(frame: FrameType | None) -> bool:
    """Whether a wait comes from a call of spin in the one thread of an executor."""
    while frame is not None and frame.f_code.co_name != "_spin_once_impl":
        frame = frame.f_back
    if frame is None or type(frame.f_locals.get("self")) is not SingleThreadedExecutor:
        return False
    while frame is not None and frame.f_code.co_name.lstrip("_").startswith("spin_once"):
        frame = frame.f_back
    inside = frame is not None and "rclpy" in frame.f_code.co_filename
    return inside and frame is not None and frame.f_code.co_name == "spin"


def _type_name(kind: Any) -> str:
    """Return the name of an interface's class, such as std_msgs/msg/String."""
    package, part, *_ = kind.__module__.split(".")
    return f"{package}/{part}/{kind.__name__}"
