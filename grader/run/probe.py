"""The probe: a small program that runs in a sandbox with the distro's own rclpy.

It drives `/clock`, watches the ROS graph and `/rosout`, and proves with a barrier that a node has
run the callbacks that were due. The protocol is JSON lines: one command in, one answer out. It
imports nothing of the grader, because it may run under another Python.

Commands (`do`); times are nanoseconds of ROS time, `seconds` is the most wall time to take:
- `look` answers at once;
- `wait` answers when something was logged or the graph changed;
- `clock` publishes `at` and makes two round trips to every node that has ever answered
  (docs/architecture.md, "The barrier"); with `until_log` it also answers when something was logged;
  with `patient` it waits for every node that has a service to ask;
- `follow` sets `use_sim_time` of the node `name`; `barrier` is whether the node accepted it;
- `try` asks the other services of the node `name`; `barrier` is whether one answered;
- `extend` adds the commands of the last of some `modules` (name and text) of grader/run/in_probe;
- `end` ends the probe.
The answer has `barrier` (true, false or null), `logs`, `nodes`, `clocks` (publishers of /clock),
`silent` (the number of nodes that were asked and have never answered), `doubled` (the nodes with
more than one publisher on /rosout), `now` (its clock, ns).
"""

from __future__ import annotations

import importlib
import json
import os
import sys
import time
import types
from collections import Counter
from typing import Any

import rclpy
from rcl_interfaces.msg import Log, Parameter, ParameterType, ParameterValue
from rcl_interfaces.srv import GetParameters, SetParameters
from rclpy.executors import SingleThreadedExecutor
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from rosgraph_msgs.msg import Clock

NAME = "_ros2cli_daemon_0"  # a node that a graph at home has too, once `ros2 node list` has run
LONGEST_TEXT = 2_000  # characters of a log record that are passed on
MOST_LOGS = 2_000  # records in one answer
MOST_NODES = 8
MOST_LATE = 4  # unanswered requests to one node that may still be answered
OTHER_SERVICE_SECONDS = 1.0  # after which a node without parameter services is asked otherwise
AGAIN_SECONDS = 1.0  # between two requests to a node that does not answer
ASKABLE = ("std_srvs", "example_interfaces", "rcl_interfaces", "type_description_interfaces")
DESCRIPTIONS = "type_description_interfaces/srv/GetTypeDescription"  # from jazzy on


def service_type(name: str) -> Any:
    """Return the class of a service type such as std_srvs/srv/Empty; None if it is not known."""
    package, _, kind = name.partition("/srv/")
    if package not in ASKABLE:  # the name comes from the student's node
        return None
    try:
        return getattr(importlib.import_module(package + ".srv"), kind, None)
    except ImportError:
        return None


def full_name(space: str, name: str) -> str:
    """Return a node's full name, such as /robot/talker."""
    return (space if space.endswith("/") else space + "/") + name


class Peer:
    """A node, and the service by which it is asked whether it has run what was due."""

    def __init__(self, client: Any, request: Any) -> None:
        self.client = client
        self.request = request
        self.answered = False  # ever
        self.sim_time: bool | None = None
        self.left = 0  # round trips of the current barrier that are missing
        self.current: Any = None
        self.late: list[Any] = []
        self.sent = 0.0  # time.monotonic()

    def ready(self) -> bool:
        """Return whether the service is there."""
        return bool(self.client.service_is_ready())

    def begin(self, trips: int) -> None:
        """Begin a barrier; an older request may still be answered, but proves nothing for it."""
        self.left = trips
        self.drop()
        self.send()

    def send(self) -> None:
        """Send a request."""
        self.current = self.client.call_async(self.request)
        self.sent = time.monotonic()

    def drop(self) -> None:
        """No longer wait for the current request."""
        if self.current is not None:
            self.late.append(self.current)
            self.current = None
        for future in self.late[:-MOST_LATE]:
            self.client.remove_pending_request(future)
        self.late = self.late[-MOST_LATE:]

    def collect(self) -> None:
        """Take the answers that have come, and send the next request of the barrier."""
        for future in [f for f in self.late if f.done()]:
            self.late.remove(future)
            self.read(future)
        if self.current is not None and self.current.done():
            self.read(self.current)
            self.current = None
            self.left -= 1
            if self.left > 0:
                self.send()

    def read(self, future: Any) -> None:
        """Read an answer; that of the parameter service has the value of use_sim_time."""
        self.answered = True
        values: list[Any] = getattr(future.result(), "values", [])
        if len(values) == 1 and values[0].type == ParameterType.PARAMETER_BOOL:
            self.sim_time = bool(values[0].bool_value)


class Probe:
    """An rclpy node that observes the others."""

    def __init__(self) -> None:
        rclpy.init(args=[])
        self.node = rclpy.create_node(
            NAME, enable_rosout=False, start_parameter_services=False, use_global_arguments=False
        )
        self.executor = SingleThreadedExecutor()
        self.executor.add_node(self.node)
        self.logs: list[dict[str, Any]] = []
        self.peers: dict[str, Peer] = {}
        self.since: dict[str, float] = {}  # when a node was seen first
        self.ours: set[str] = set()  # the full names of other nodes in this process
        self.added: dict[str, Any] = {}  # the commands of `extend`
        self.clock: Any = self.node.create_publisher(Clock, "/clock", 10)
        rosout = QoSProfile(
            depth=1000,
            reliability=ReliabilityPolicy.RELIABLE,
            durability=DurabilityPolicy.TRANSIENT_LOCAL,
        )
        self.rosout = self.node.create_subscription(Log, "/rosout", self.on_log, rosout)

    def on_log(self, log: Log) -> None:
        """Keep a record until the next answer."""
        if len(self.logs) >= MOST_LOGS:
            return
        self.logs.append(
            {
                "level": int.from_bytes(log.level, "little")
                if isinstance(log.level, bytes)
                else int(log.level),
                "name": log.name[:256],
                "text": log.msg[:LONGEST_TEXT],
                "function": log.function[:256],
                "file": log.file[:512],
                "line": log.line,
                "stamp": log.stamp.sec * 1_000_000_000 + log.stamp.nanosec,
                "read": time.time_ns(),
            }
        )

    def graph(self) -> list[dict[str, Any]]:
        """Return the other nodes, and which of their endpoints are known."""
        found: dict[str, dict[str, Any]] = {}
        for name, space in self.node.get_node_names_and_namespaces():
            full = full_name(space, name)
            if name != NAME and full not in self.ours and len(found) < MOST_NODES:
                found[full] = {"name": full, "clock": False, "rosout": False, "parameters": False}
        for key, infos in (
            ("clock", self.node.get_subscriptions_info_by_topic("/clock")),
            ("rosout", self.node.get_publishers_info_by_topic("/rosout")),
        ):
            for info in infos:
                full = full_name(info.node_namespace, info.node_name)
                if full in found:
                    found[full][key] = True
        for full, node in found.items():
            peer = self.peer(full)
            peer.collect()
            node["parameters"] = isinstance(peer.request, GetParameters.Request) and peer.ready()
            node["services"] = peer.ready()
            node["answers"], node["sim_time"] = peer.answered, peer.sim_time
        return list(found.values())

    def doubled(self) -> list[str]:
        """Return the nodes with more publishers on /rosout than the one of their logger."""
        names = self.node.get_node_names_and_namespaces()
        nodes = Counter(full_name(space, name) for name, space in names)
        publishers = Counter(
            full_name(info.node_namespace, info.node_name)
            for info in self.node.get_publishers_info_by_topic("/rosout")
        )
        return [full for full, count in publishers.items() if 0 < nodes[full] < count][:MOST_NODES]

    def peer(self, full: str) -> Peer:
        """Return how a node is asked: by its parameter service, or by another without an effect."""
        now = time.monotonic()
        peer = self.peers.get(full)
        if peer is None:
            client = self.node.create_client(GetParameters, full + "/get_parameters")
            peer = Peer(client, GetParameters.Request(names=["use_sim_time"]))
            self.peers[full], self.since[full] = peer, now
        elif (
            isinstance(peer.request, GetParameters.Request)
            and now - self.since[full] > OTHER_SERVICE_SECONDS
            and not peer.ready()
            and self.services(full).get(full + "/get_type_description") == DESCRIPTIONS
        ):
            kind = service_type(DESCRIPTIONS)
            client = self.node.create_client(kind, full + "/get_type_description")
            peer = self.peers[full] = Peer(client, kind.Request())
        return peer

    def services(self, full: str) -> dict[str, str]:
        """Return the services of a node with their types."""
        space, _, name = full.rpartition("/")
        try:
            found = self.node.get_service_names_and_types_by_node(name, space or "/")
        except RuntimeError:  # the node has gone
            return {}
        return {service: kinds[0] for service, kinds in found if kinds}

    def matched(self, nodes: list[dict[str, Any]]) -> bool:
        """Return whether the nodes' subscriptions have matched our /clock publisher."""
        if self.clock is None:
            return True
        wanted = sum(node["clock"] for node in nodes)
        return bool(self.clock.get_subscription_count() >= max(1, wanted))

    def barrier(
        self, trips: int, deadline: float, *, until_log: bool, patient: bool
    ) -> bool | None:
        """Make round trips to every node that answers; return whether they succeeded.

        The others do not count: a node that is not spun may stand beside one that is. None if
        there is no node to ask, or if `until_log` and a log record came first: the services of a
        node with many threads can be slow.
        """
        known = len(self.logs)
        peers = [peer for peer in self.peers.values() if peer.ready()]
        if not peers:
            return None
        spun = any(peer.answered for peer in peers)
        for peer in peers:
            if patient or peer.answered or not spun:
                peer.begin(trips)
        while True:
            for peer in peers:
                peer.collect()
            answering = [peer for peer in peers if peer.answered]
            awaited = peers if patient else answering or peers
            if all(peer.left == 0 for peer in awaited):
                return True
            left = deadline - time.monotonic()
            heard = until_log and len(self.logs) > known
            if left <= 0 or heard:
                complete = bool(answering) and all(peer.left == 0 for peer in answering)
                return None if heard else complete
            self.executor.spin_once(timeout_sec=left)

    def ask_silent(self) -> None:
        """Ask the nodes again that have not answered: a first answer can be lost in discovery."""
        for peer in self.peers.values():
            idle = time.monotonic() - peer.sent > AGAIN_SECONDS
            if not peer.answered and idle and peer.ready():
                peer.begin(1)

    def follow(self, full: str, deadline: float) -> bool:
        """Set use_sim_time of a node; return whether it accepted."""
        value = ParameterValue(type=ParameterType.PARAMETER_BOOL, bool_value=True)
        wanted = Parameter(name="use_sim_time", value=value)
        client = self.node.create_client(SetParameters, full + "/set_parameters")
        answer = self.call(client, SetParameters.Request(parameters=[wanted]), deadline)
        results: list[Any] = getattr(answer, "results", [])
        return len(results) == 1 and bool(results[0].successful)

    def try_services(self, full: str, deadline: float) -> bool:
        """Ask the services of a node, whatever they do; return whether one answered."""
        for service, name in self.services(full).items():
            kind = service_type(name)
            if kind is not None:
                part = min(deadline, time.monotonic() + AGAIN_SECONDS)
                if self.call(self.node.create_client(kind, service), kind.Request(), part):
                    self.peer(full).answered = True
                    return True
        return False

    def call(self, client: Any, request: Any, deadline: float) -> Any:
        """Call a service and return its answer; None if none came."""
        while not client.service_is_ready() and time.monotonic() < deadline:
            self.executor.spin_once(timeout_sec=0.01)
        future = client.call_async(request)
        while not future.done() and time.monotonic() < deadline:
            self.executor.spin_once(timeout_sec=0.01)
        answer = future.result() if future.done() else None
        self.node.destroy_client(client)
        return answer

    def answer(self, command: dict[str, Any]) -> dict[str, Any]:
        """Carry out one command and return its answer."""
        deadline = time.monotonic() + command.get("seconds", 0)
        if command["do"] in self.added:
            return self.added_answer(command, deadline)
        barrier: bool | None = None
        if command["do"] == "extend":
            self.extend(command["modules"])
        if command["do"] == "clock":
            barrier = self.set_clock(command, deadline)
        elif command["do"] == "follow":
            barrier = self.follow(command["name"], deadline)
        elif command["do"] == "try":
            barrier = self.try_services(command["name"], deadline)
        elif command["do"] == "wait":
            self.ask_silent()
            before = self.graph()
            while not self.logs and self.graph() == before and time.monotonic() < deadline:
                self.executor.spin_once(timeout_sec=0.01)
        self.executor.spin_once(timeout_sec=0)
        logs, self.logs = self.logs, []
        answer: dict[str, Any] = {"barrier": barrier, "logs": logs}
        if command["do"] != "clock":
            answer["nodes"] = self.graph()
            answer["matched"] = self.matched(answer["nodes"])
        silent = [p for p in self.peers.values() if not p.answered and p.ready()]
        answer["silent"] = len(silent)
        answer["doubled"] = self.doubled()
        answer["clocks"] = self.node.count_publishers("/clock")
        answer["now"] = time.time_ns()
        return answer

    def extend(self, modules: list[list[str]]) -> None:
        """Make modules of their names and texts, and add the commands of the last one."""
        for name, text in modules:
            module = self.module(name, text)
        self.added.update(module.commands(self))

    def module(self, name: str, text: str) -> Any:
        """Return a module made of its text; others import it by its name."""
        module = types.ModuleType(name)
        sys.modules[name] = module
        exec(compile(text, name, "exec"), module.__dict__)  # noqa: S102 - the grader's own text
        return module

    def added_answer(self, command: dict[str, Any], deadline: float) -> dict[str, Any]:
        """Carry out an added command; its answer has the log records too, but no nodes."""
        answer: dict[str, Any] = {"barrier": None, **self.added[command["do"]](command, deadline)}
        self.executor.spin_once(timeout_sec=0)
        answer["logs"], self.logs = self.logs, []
        answer["clocks"] = self.node.count_publishers("/clock")
        return answer

    def hide_clock(self) -> None:
        """Leave no trace of a clock on the graph: nodes run on the wall clock."""
        self.node.destroy_publisher(self.clock)
        self.clock = None

    def show(self, at: int) -> None:
        """Publish an instant (ns)."""
        if self.clock is None:
            return
        message = Clock()
        message.clock.sec, message.clock.nanosec = divmod(at, 1_000_000_000)
        self.clock.publish(message)

    def set_clock(self, command: dict[str, Any], deadline: float) -> bool | None:
        """Publish an instant and make the barrier."""
        patient = bool(command.get("patient"))
        if patient:
            self.graph()  # nodes that were made after the first one was seen
        self.show(command["at"])
        until_log = bool(command.get("until_log"))
        return self.barrier(2, deadline, until_log=until_log, patient=patient)


def main() -> None:
    """Answer commands until the end of the input."""
    # the output of C libraries must not get between the answers
    answers = os.fdopen(os.dup(1), "w", buffering=1)
    os.dup2(2, 1)
    probe = Probe()
    answers.write(json.dumps({"ready": True, "now": time.time_ns()}) + "\n")
    for line in sys.stdin:
        command = json.loads(line)
        if command["do"] == "end":
            break
        answers.write(json.dumps(probe.answer(command)) + "\n")
    os._exit(0)  # no clean-up is needed: the namespaces end with this process


main()
