"""The probe: a small program that runs in a sandbox with the distro's own rclpy.

It drives `/clock`, watches the ROS graph and `/rosout`, and proves with a barrier that a node has
run the callbacks that were due. The protocol is JSON lines: one command in, one answer out. It
imports nothing of the grader, because it may run under another Python.

Commands (`do`); times are nanoseconds of ROS time, `seconds` is the most wall time to take:
- `look` answers at once;
- `wait` answers when something was logged or the graph changed;
- `clock` publishes `at` and makes two round trips to every node (docs/architecture.md, "The
  barrier"); with `until_log` it also answers when something was logged;
- `end` ends the probe.
The answer has `barrier` (true, false or null), `logs`, `nodes`, `clocks` (publishers of /clock).
"""

from __future__ import annotations

import json
import os
import sys
import time
from typing import Any

import rclpy
from rcl_interfaces.msg import Log
from rcl_interfaces.srv import GetParameters
from rclpy.executors import SingleThreadedExecutor
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from rosgraph_msgs.msg import Clock

NAME = "_grader_probe"
LONGEST_TEXT = 2_000  # characters of a log record that are passed on
MOST_LOGS = 2_000  # records in one answer
MOST_NODES = 8


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
        self.clients: dict[str, Any] = {}
        self.clock = self.node.create_publisher(Clock, "/clock", 10)
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
            }
        )

    def graph(self) -> list[dict[str, Any]]:
        """Return the other nodes, and which of their endpoints are known."""
        found: dict[str, dict[str, Any]] = {}
        for name, space in self.node.get_node_names_and_namespaces():
            if name != NAME and len(found) < MOST_NODES:
                full = (space if space.endswith("/") else space + "/") + name
                found[full] = {"name": full, "clock": False, "rosout": False, "parameters": False}
        for key, infos in (
            ("clock", self.node.get_subscriptions_info_by_topic("/clock")),
            ("rosout", self.node.get_publishers_info_by_topic("/rosout")),
        ):
            for info in infos:
                space = info.node_namespace
                full = (space if space.endswith("/") else space + "/") + info.node_name
                if full in found:
                    found[full][key] = True
        for full, node in found.items():
            node["parameters"] = self.client(full).service_is_ready()
        return list(found.values())

    def client(self, full: str) -> Any:
        """Return the client of a node's parameter service."""
        if full not in self.clients:
            self.clients[full] = self.node.create_client(GetParameters, full + "/get_parameters")
        return self.clients[full]

    def matched(self) -> bool:
        """Return whether a subscription has matched our /clock publisher."""
        return bool(self.clock.get_subscription_count() > 0)

    def barrier(self, trips: int, deadline: float, *, until_log: bool) -> bool | None:
        """Make round trips to every node with parameter services; return whether all answered.

        None if there is no such node, or if `until_log` and a log record came first: the
        parameter services of a node with many threads can be slow.
        """
        known = len(self.logs)
        ready = [client for client in self.clients.values() if client.service_is_ready()]
        if not ready:
            return None
        request = GetParameters.Request(names=["use_sim_time"])
        for _ in range(trips):
            futures = [client.call_async(request) for client in ready]
            while not all(future.done() for future in futures):
                left = deadline - time.monotonic()
                heard = until_log and len(self.logs) > known
                if left <= 0 or heard:
                    for client, future in zip(ready, futures):
                        client.remove_pending_request(future)
                    return None if heard else False
                self.executor.spin_once(timeout_sec=left)
        return True

    def answer(self, command: dict[str, Any]) -> dict[str, Any]:
        """Carry out one command and return its answer."""
        deadline = time.monotonic() + command.get("seconds", 0)
        barrier = None
        if command["do"] == "clock":
            at = command["at"]
            message = Clock()
            message.clock.sec, message.clock.nanosec = divmod(at, 1_000_000_000)
            self.clock.publish(message)
            until_log = bool(command.get("until_log"))
            barrier = self.barrier(2, deadline, until_log=until_log)
        elif command["do"] == "wait":
            before = self.graph()
            while not self.logs and self.graph() == before and time.monotonic() < deadline:
                self.executor.spin_once(timeout_sec=0.01)
        self.executor.spin_once(timeout_sec=0)
        logs, self.logs = self.logs, []
        answer = {"barrier": barrier, "logs": logs}
        if command["do"] != "clock":
            answer["nodes"] = self.graph()
            answer["matched"] = self.matched()
        answer["clocks"] = self.node.count_publishers("/clock")
        return answer


def main() -> None:
    """Answer commands until the end of the input."""
    # the output of C libraries must not get between the answers
    answers = os.fdopen(os.dup(1), "w", buffering=1)
    os.dup2(2, 1)
    probe = Probe()
    answers.write(json.dumps({"ready": True}) + "\n")
    for line in sys.stdin:
        command = json.loads(line)
        if command["do"] == "end":
            break
        answers.write(json.dumps(probe.answer(command)) + "\n")
    os._exit(0)  # no clean-up is needed: the namespaces end with this process


main()
