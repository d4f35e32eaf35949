"""The bridge's loop: takes commands, looks at the graph and at the topics, and says what is new.

Commands (`do`):
- `watch` says what is looked at from now on: `views`, `series` (topic and field) of the plots, and
  whether a plot `seeks` a field that moves;
- `drive` commands a `turtle`'s velocity: `linear` (m/s) and `angular` (rad/s);
- `fields` asks for the numeric fields of a `topic`;
- `parameters` asks for those of a `node`, `set` sets the one called `name` from `text`.
The last three have an `id`, which the answer has too.

Messages (`kind`): `ready`, `graph`, `log`, `turtles`, `samples`, `moving`, `parameter_event`, and the
answers `fields`, `parameters`, `set`.

rclpy offers no guard condition of the graph, so the graph is compared with the one before, every
0.4 s, while somebody looks.
"""

from __future__ import annotations

import os
import time
from typing import Any

import rclpy
from rcl_interfaces.msg import ParameterEvent
from rclpy.executors import SingleThreadedExecutor
from rclpy.parameter import Parameter
from rclpy.qos import QoSProfile

from lab.window.bridge.fields import message_type, numeric_fields
from lab.window.bridge.graph import snapshot
from lab.window.bridge.moving import Search
from lab.window.bridge.parameters import KINDS, Parameters, parsed
from lab.window.bridge.plots import Plots
from lab.window.bridge.streams import Stream, logs
from lab.window.bridge.turtles import Turtles
from lab.window.bridge.wire import Wire

NAMES = ("_lab_window", "_lab_window_topics")  # hidden, as ROS hides names with an underscore
GRAPH_SECONDS = 0.4
FAST_SECONDS = 1 / 60  # between two looks while something moves
SLOW_SECONDS = 0.1  # while nothing does
UNWATCHED_SECONDS = 5.0  # the commands wake the loop up
MOST_LOGS = 300  # records in one message
LONGEST_TEXT = 2_000
EVENTS_KEPT = 100  # between two looks


class Bridge:
    """Two nodes: one is spun for services, the other one's subscriptions are read by us."""

    def __init__(self) -> None:
        rclpy.init(args=[])
        alone = Parameter(
            "start_type_description_service", value=False
        )  # (it would load numpy: 12 MB)
        quiet = {
            "enable_rosout": False,
            "start_parameter_services": False,
            "parameter_overrides": [alone],
        }
        self.node = rclpy.create_node(NAMES[0], **quiet)
        self.silent = rclpy.create_node(NAMES[1], **quiet)
        self.own = frozenset(f"/{name}" for name in NAMES)
        self.executor = SingleThreadedExecutor()
        self.executor.add_node(self.node)
        guard = self.node.create_guard_condition(lambda: None)
        self.wire = Wire(guard.trigger)
        self.parameters = Parameters(self.node)
        self.turtles = Turtles(self.silent, self.parameters)
        self.plots = Plots(self.silent)
        self.search = Search(self.silent)
        self.views: set[str] = set()
        self.graph: dict[str, Any] = {}
        self.graph_at = 0.0
        self.logs: Stream | None = None
        self.events: Stream | None = None

    def run(self) -> None:
        """Work until the server closes its end."""
        self.wire.send("ready", distro=os.environ.get("ROS_DISTRO", ""))
        while not self.wire.ended:
            started = time.monotonic()
            for command in self.wire.commands():
                self.obey(command)
            self.look()
            self.wait(started)

    def wait(self, started: float) -> None:
        """Spin until the next look; a command and an answer wake it up."""
        fast = self.turtles.moving or self.plots.active or self.parameters.waits
        pause = FAST_SECONDS if fast else SLOW_SECONDS
        if not self.views:
            pause = UNWATCHED_SECONDS
        self.executor.spin_once(timeout_sec=max(0.0, started + pause - time.monotonic()))

    def look(self) -> None:
        """Send what is new."""
        self.parameters.advance()
        if not self.views:
            return
        if time.monotonic() - self.graph_at >= GRAPH_SECONDS:
            self.look_at_graph()
        self.look_at_events()
        self.look_at_turtles()
        self.look_at_logs()
        moving = self.search.look() if self.search.active else None
        if moving is not None:
            self.wire.send("moving", topic=moving[0], field=moving[1])
        samples = self.plots.look()
        if samples:
            self.wire.send("samples", series=samples)

    def look_at_graph(self) -> None:
        """Send the graph if it has changed; begin and end with what it shows."""
        self.graph_at = time.monotonic()
        found = snapshot(self.node, self.own)
        if found != self.graph:
            self.graph = found
            self.wire.send("graph", **found)
            self.parameters.forget({node["name"] for node in found["nodes"]})
        self.plots.find(found["topics"])
        self.search.find(found["topics"])
        if "turtle" in self.views:
            self.turtles.find(found["topics"])

    def look_at_turtles(self) -> None:
        """Send the turtles if one has moved."""
        if "turtle" not in self.views:
            return
        self.turtles.publish()
        state = self.turtles.look()
        if state is not None:
            self.wire.send("turtles", **state)

    def look_at_events(self) -> None:
        """Say whose parameters have changed."""
        events = [] if self.events is None else list(self.events.take())
        for node in {event.node for event, _ in events}:
            self.wire.send("parameter_event", node=node)
            self.turtles.ask_background(node)

    def look_at_logs(self) -> None:
        """Send the new records of /rosout."""
        records = [] if self.logs is None else [_record(log) for log, _ in self.logs.take()]
        for start in range(0, len(records), MOST_LOGS):
            self.wire.send("log", records=records[start : start + MOST_LOGS])

    def obey(self, command: dict[str, Any]) -> None:
        """Carry out a command."""
        do = command["do"]
        if do == "watch":
            self.watch(set(command["views"]), [(t, f) for t, f in command["series"]])
            if command.get("seeks"):
                self.search.begin()
            else:
                self.search.end()
        elif do == "drive":
            self.turtles.drive(command["turtle"], command["linear"], command["angular"])
        elif do == "fields":
            self.tell_fields(command)
        elif do == "parameters":
            head = {"id": command["id"], "node": command["node"]}
            self.parameters.read(
                command["node"], lambda rows: self.wire.send("parameters", **head, rows=rows)
            )
        elif do == "set":
            self.set_parameter(command)

    def watch(self, views: set[str], series: list[tuple[str, str]]) -> None:
        """Look at these views from now on. What they show is sent anew."""
        self.views = views
        self.plots.want(series if "plot" in views else [])
        self.graph_at = 0.0
        if self.logs is None and views:
            self.logs = logs(self.silent)  # kept: the older records would come again
        if self.events is None and views:
            self.events = Stream(
                self.silent, "/parameter_events", ParameterEvent, QoSProfile(depth=EVENTS_KEPT)
            )
        if "turtle" not in views:
            self.turtles.close()

    def tell_fields(self, command: dict[str, Any]) -> None:
        """Answer with the numeric fields of a topic; None if its type is not installed."""
        found = [t for t in self.graph.get("topics", ()) if t["name"] == command["topic"]]
        kind = message_type(found[0]["types"][0]) if found else None
        fields = None if kind is None else numeric_fields(kind)
        self.wire.send("fields", id=command["id"], topic=command["topic"], fields=fields)

    def set_parameter(self, command: dict[str, Any]) -> None:
        """Set a parameter; `reason` is the node's, or wrong_value or no_answer."""
        head = {key: command[key] for key in ("id", "node", "name")}
        value = parsed(command["type"], command["text"]) if command["type"] in KINDS else None
        if value is None:
            self.wire.send("set", **head, done=False, reason="wrong_value")
            return
        self.parameters.change(
            command["node"],
            command["name"],
            value,
            lambda done, reason: self.wire.send("set", **head, done=done, reason=reason),
        )


def _record(log: Any) -> dict[str, Any]:
    level = log.level
    return {
        "level": level[0] if isinstance(level, bytes) else int(level),
        "name": log.name[:256],
        "text": log.msg[:LONGEST_TEXT],
        "file": log.file[:512],
        "line": log.line,
        "function": log.function[:256],
        "stamp": log.stamp.sec + log.stamp.nanosec / 1e9,
    }


def main() -> None:
    """Run the bridge until its input ends."""
    bridge = Bridge()
    try:
        bridge.run()
    except KeyboardInterrupt:  # Ctrl+C reaches every program of the terminal
        pass
    finally:
        rclpy.try_shutdown()
