"""The probe's part of a scenario: topics, services, parameters, the graph, and a world.

The grader sends this module and those that it imports to the probe, which runs them under the
prefix's Python: they import nothing else of the grader. `commands(probe)` returns its commands:
- `prepare` makes the subscriptions (`watch`), publishers (`publish`), clients (`call`) and action
  clients (`goal`) that the scenario needs, and the `world`; `later` are the topics that are subscribed
  to once a node publishes on them; `unknown` has the types that do not exist;
- `tick` moves the world to `at`, whose messages go out, publishes this instant on /clock and makes
  a barrier: round trips, which are behind all of that in each node's queue; it does the same at each
  update of the world before that whose messages a node hears, `each` s of wall time for a barrier;
- `publish`, `call`, `goal`, `cancel`, `set` and `place` act on the nodes and the world, with a
  barrier after it;
- `look_closely` returns the whole graph; `parameters` those of the node `name`, `unproven` why a
  change of them that the node `name` has accepted does not show.

Messages are taken after a barrier, not by the executor: what a node published before it answered
has arrived then. `messages` has those of each topic in order, up to a limit, with their senders;
`senders` the nodes of publishers that the graph tells later; `counts` all of them.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from contextlib import ExitStack
from typing import Any

import rclpy
from rclpy.action import ActionClient
from rclpy.callback_groups import CallbackGroup
from rclpy.duration import Duration
from rclpy.impl.implementation_singleton import rclpy_implementation as _rclpy
from rclpy.qos import ReliabilityPolicy

from grader.run.in_probe.goals import Goals
from grader.run.in_probe.graph import ends_of_others, twins_on
from grader.run.in_probe.hearing import DEPTH, Hearing
from grader.run.in_probe.messages import (
    LONGEST_REASON,
    Values,
    fill,
    interface,
    taken_from,
    why_unusable,
)
from grader.run.in_probe.parameters import Changes, read_parameters, set_parameters
from grader.run.in_probe.senders import Senders, taken_with_sender

SECOND = 1_000_000_000
MOST_MESSAGES = 40  # of a topic in one answer
ACK_SECONDS = 1.0  # wall time for the acknowledgement of a message
MATCH_SECONDS = 2.0  # wall time for a publisher and a subscription to find each other
MISSING_TRIES, MISSING_SECONDS = 12, 0.3  # barriers and wall time after which a message is missing
SERVE_TURNS = 6  # of the executor
SERVE_SECONDS = 0.005  # wall time after which the executor runs if no answer comes
MOST_LOGS = 1_000  # records that are taken at once
TRIPS = 2  # at once: a node takes one request and one message of a topic at a time
REACTION_TRIES = 3  # further barriers after a stimulus
PAUSE_SECONDS = 0.002


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


class Scenario:
    """The commands of a scenario; see the module."""

    def __init__(self, probe: Any) -> None:
        self.probe = probe
        self.group = Untouched()
        self.hearing = Hearing(probe.node, self.group)
        self.watched = self.hearing.watched
        self.senders = Senders(probe.node)
        self.changes = Changes(probe, self.group, self.senders)
        self.publishers: dict[str, Any] = {}
        self.clients: dict[str, Any] = {}
        self.askers: dict[str, Any] = {}  # clients for round trips, by the node's name
        self.actions: dict[str, Any] = {}
        self.goals = Goals()
        self.calls: list[tuple[str, Any]] = []
        self.periods: dict[str, int] = {}  # ns between the messages that are awaited on topics
        self.latest: dict[str, int] = {}  # when a message was read last, and how long after another
        self.gaps: dict[str, int] = {}
        self.asked = False  # whether nodes have clients, which may ask the world
        self.at = 0  # ns, the instant that the clock shows
        self.began = 0  # ns of wall time, when the clock showed its first instant
        self.world: Any = None
        self.messages: list[list[Any]] = []
        self.counts: dict[str, int] = {}

    def prepare(self, command: dict[str, Any], _: float) -> dict[str, Any]:
        """Make the ends that the scenario needs, but those of types that cannot be used."""
        roles = ("watch", "later", "publish", "call", "goal")
        named = [one for role in roles for one in command[role]]
        students = {n for _, n in named if n.partition("/")[0] in command["students"]}
        unusable = {name: why for name in students if (why := why_unusable(name))}
        kinds = {name: interface(name) for _, name in named if name not in unusable}
        unknown = [name for name, kind in kinds.items() if kind is None]
        if unknown:
            return {"unknown": unknown}
        for ends in ("watch", "publish", "call", "goal"):
            command[ends] = [end for end in command[ends] if end[1] not in unusable]
        self.hearing.kinds, self.hearing.of_students = kinds, command["students"]
        self.hearing.later = {topic: name for topic, name in command["later"] if name in kinds}
        for topic, name in command["watch"]:
            self.hearing.watch(topic, name)
        for topic, name in command["publish"]:
            if topic not in self.publishers:
                self.publishers[topic] = self.probe.node.create_publisher(kinds[name], topic, 10)
        for service, name in command["call"]:
            self.clients[service] = self.probe.node.create_client(kinds[name], service)
        for action, name in command["goal"]:
            if action not in self.actions:
                self.actions[action] = ActionClient(self.probe.node, kinds[name], action)
                topic, kind = f"{action}/_action/feedback", kinds[name].Impl.FeedbackMessage
                feedback = self.hearing.subscribe(topic, kind, ReliabilityPolicy.RELIABLE)
                self.goals.feedback.append(feedback)
        self.periods = command["periods"]
        if command["plain"]:
            self.probe.hide_clock()
        if command["world"]:
            self.open_world(command["world"])
        return {"unknown": [], "unusable": unusable}

    def open_world(self, source: Sequence[str]) -> None:
        """Make the world of a module, given by its name and text."""
        world = self.probe.module(*source).World
        node = rclpy.create_node(world.NAME, enable_rosout=False, use_global_arguments=False)
        self.probe.ours.add("/" + world.NAME)
        self.hearing.worlds.add(world.NAME)
        self.probe.executor.add_node(node)
        self.world = world(node, self.group)

    def take(self) -> dict[str, int]:
        """Take the messages that have arrived; return how many of each topic the clock has caused.

        A message that was sent before the clock began, and comes late, is not among these.
        """
        found = {}
        for topic, subscriptions in self.watched.items():
            count = early = 0
            for subscription in subscriptions:
                for message, sent, gid in taken_with_sender(subscription, DEPTH - count):
                    count += 1
                    before = 0 < sent < self.began
                    early += before
                    sender = self.senders.of(gid, topic)
                    if count <= MOST_MESSAGES:
                        self.messages.append([topic, Values().of(message), before, sender])
            if count:
                self.counts[topic] = self.counts.get(topic, 0) + count
            found[topic] = count - early
        self.goals.take_feedback()
        return found

    def trips(self, count: int, deadline: float) -> bool | None:
        """Make `count` round trips to each node that answers, all requests at once.

        They do without the executor, which needs half a millisecond for each answer; it runs while
        none comes, for what the nodes ask of the world.
        """
        awaited = []
        for name, peer in self.probe.peers.items():
            if peer.answered and peer.ready():
                client = self.asker(name, peer, deadline)
                with client.handle:
                    numbers = {client.handle.send_request(peer.request) for _ in range(count)}
                awaited.append((client, numbers))
        if not awaited:
            return None
        while any(numbers for _, numbers in awaited):
            if time.monotonic() > deadline:
                return False
            self.wait_for([client for client, numbers in awaited if numbers])
            came = sum(self.take_answers(client, numbers) for client, numbers in awaited)
            if not came:
                self.probe.executor.spin_once(timeout_sec=0)
        self.take_logs()
        return True

    def asker(self, name: str, peer: Any, deadline: float) -> Any:
        """Return a client of the service by which a node is asked, which the executor leaves alone."""
        client = self.askers.get(name)
        if client is None or client.srv_name != peer.client.srv_name:
            client = self.askers[name] = self.probe.node.create_client(
                peer.client.srv_type, peer.client.srv_name, callback_group=self.group
            )
            while not client.service_is_ready() and time.monotonic() < deadline:
                self.probe.executor.spin_once(timeout_sec=PAUSE_SECONDS)
        return client

    def wait_for(self, clients: Sequence[Any] = (), subscriptions: Sequence[Any] = ()) -> None:
        """Wait until one of them has an answer or a message, for `SERVE_SECONDS` at most."""
        with ExitStack() as stack:
            for entity in (*clients, *subscriptions):
                stack.enter_context(entity.handle)
            context = self.probe.node.context.handle
            stack.enter_context(context)
            waiting = _rclpy.WaitSet(len(subscriptions), 0, 0, len(clients), 0, 0, context)
            stack.enter_context(waiting)
            waiting.clear_entities()
            for client in clients:
                waiting.add_client(client.handle)
            for subscription in subscriptions:
                waiting.add_subscription(subscription.handle)
            waiting.wait(int(SERVE_SECONDS * SECOND))

    def take_answers(self, client: Any, numbers: set[int]) -> int:
        """Take the answers that have come, and their numbers from a set; return how many."""
        came = 0
        while True:
            with client.handle:
                header, _ = client.handle.take_response(client.srv_type.Response)
            if header is None:
                return came
            numbers.discard(header.request_id.sequence_number)
            came += 1

    def take_logs(self) -> None:
        """Take the log records that have come: all of them, not one for each turn of the executor."""
        for log in taken_from(self.probe.rosout, MOST_LOGS):
            self.probe.on_log(log)

    def tick(self, command: dict[str, Any], deadline: float) -> dict[str, Any]:
        """Move the world and the clock to an instant."""
        self.began = self.began or time.time_ns()
        self.at = at = command["at"]
        self.hearing.look()
        found = dict.fromkeys(self.watched, 0)
        if self.world is not None:
            self.advance_world(at, found, command["each"])
            deadline = time.monotonic() + command["each"]
            self.probe.show(at)
            barrier = self.trips(TRIPS, deadline)
            if self.asked:
                self.serve()
        else:
            barrier = self.probe.set_clock(command, deadline)
        self.take_into(found)
        for _ in range(REACTION_TRIES if self.goals.open else 0):
            # a coroutine of a goal goes on at one of the executor's next turns, not at this one
            barrier = barrier and self.trips_later(found, deadline)
            self.serve()
        tries, began = 0, time.monotonic()
        while barrier and any(not found[topic] for topic in found if self.is_due(topic, at)):
            if tries >= MISSING_TRIES and time.monotonic() - began > MISSING_SECONDS:
                break
            tries += 1
            barrier = self.trips_later(found, deadline)
        for topic in [topic for topic, count in found.items() if count]:
            if self.latest.get(topic, at) < at:  # (an instant may be shown again)
                self.gaps[topic] = at - self.latest[topic]
            self.latest[topic] = at
        if self.world is not None:
            self.world.collect(at)
        return self.result(barrier)

    def advance_world(self, at: int, found: dict[str, int], seconds: float) -> None:
        """Move the world to an instant, update by update.

        Where nodes hear what an update sends, the clock shows it and the world waits for what they
        do, for `seconds` of wall time at most: the next update follows their commands. The last
        one before the instant is left to the caller, and so are all if nodes do not answer.
        """
        world, answers = self.world, True
        world.collect(at)
        while world.now + world.STEP <= at:
            world.advance(world.now + world.STEP)
            if world.now + world.STEP > at or not answers or not self.is_heard(world.sent):
                continue
            self.probe.show(world.now)
            until = time.monotonic() + seconds
            nodes = sum(peer.answered for peer in self.probe.peers.values())
            for _ in range(nodes):  # a reaction may go through all of them
                answers = bool(answers and self.trips(TRIPS, until))
            self.take_into(found)
            world.collect(world.now)

    def is_heard(self, publishers: Sequence[Any]) -> bool:
        """Whether somebody else subscribes to one of the world's topics."""
        return any(
            one.get_subscription_count() > self.hearing.own(one.topic_name) for one in publishers
        )

    def is_due(self, topic: str, at: int) -> bool:
        """Whether a message is awaited at an instant: by the checks, or as those before came."""
        if topic in self.periods:
            period = self.periods[topic]
            missed = at - self.latest.get(topic, 0) > 2 * period  # it does not keep to the period
            return at % period == 0 and not missed
        return topic in self.gaps and at - self.latest[topic] == self.gaps[topic]

    def trips_later(self, found: dict[str, int], deadline: float) -> bool | None:
        """Make another round trip after a moment, and count the messages that have come."""
        self.serve()
        barrier = self.trips(1, deadline)
        self.take_into(found)
        return barrier

    def serve(self) -> None:
        """Let the executor run what has come: answers to our calls, requests to the world."""
        self.probe.executor.spin_once(timeout_sec=PAUSE_SECONDS)
        for _ in range(SERVE_TURNS):  # (it runs one thing in a turn)
            self.probe.executor.spin_once(timeout_sec=0)

    def take_into(self, found: dict[str, int]) -> None:
        """Take the messages that have arrived, and add their numbers."""
        for topic, count in self.take().items():
            found[topic] += count

    def result(self, barrier: bool | None) -> dict[str, Any]:
        """Return what has come since the last answer."""
        said: dict[str, Any] = {"barrier": barrier}
        if self.messages:
            said["messages"], self.messages = self.messages, []
        if self.counts:
            said["counts"], self.counts = self.counts, {}
        if self.senders.open:
            said["senders"] = self.senders.found()
        done = [(name, future) for name, future in self.calls if future.done()]
        if done:
            self.calls = [one for one in self.calls if not one[1].done()]
            said["replies"] = [[name, Values().of(future.result())] for name, future in done]
        goals = self.goals.taken()
        if goals:
            said["goals"] = goals
        if self.world is not None:
            if self.world.steps:
                said["path"], self.world.steps = self.world.steps, []
            if self.world.events:
                said["events"], self.world.events = self.world.events, []
                said |= self.look_closely()  # (who asked for it may go at once)
        return said

    def react(self, deadline: float) -> bool | None:
        """Let the nodes run what a stimulus makes due."""
        barrier = self.trips(2, deadline)
        found = self.take()
        for _ in range(REACTION_TRIES):
            barrier = barrier and self.trips_later(found, deadline)
        if self.world is not None:
            self.world.collect(self.at)
        return barrier

    def await_ready(self, ready: Callable[[], bool], deadline: float) -> bool:
        """Wait for the other side of a topic, service or action; return whether it is there."""
        until = min(deadline, time.monotonic() + MATCH_SECONDS)
        while not ready() and time.monotonic() < until:
            self.probe.executor.spin_once(timeout_sec=PAUSE_SECONDS)
        return ready()

    def publish(self, command: dict[str, Any], deadline: float) -> dict[str, Any]:
        """Publish a message and wait until every subscriber has run its callback.

        If there is none, it is published only at the `last` try.
        """
        publisher = self.publishers.get(command["topic"])
        if publisher is None:
            return self.undone(deadline)
        ours = self.hearing.own(command["topic"])
        there = self.await_ready(lambda: publisher.get_subscription_count() > ours, deadline)
        if not there and not command["last"]:
            return {**self.result(self.trips(2, deadline)), "heard": 0}
        message, why = made(command, "")
        if why:
            return self.undone(deadline, why)
        heard = publisher.get_subscription_count() - ours
        publisher.publish(message)
        publisher.wait_for_all_acked(Duration(seconds=ACK_SECONDS))
        barrier = self.react(deadline)
        return {**self.result(barrier), "heard": heard}

    def call(self, command: dict[str, Any], deadline: float) -> dict[str, Any]:
        """Call a service; the reply comes with this answer or a later one."""
        client = self.clients.get(command["service"])
        request, why = made(command, "Request") if client is not None else (None, "")
        if client is None or request is None:
            return self.undone(deadline, why)
        heard = self.await_ready(client.service_is_ready, deadline)
        graph = self.look_closely()
        if heard:
            self.calls.append((command["name"], client.call_async(request)))
        barrier = self.react(deadline)
        return {**graph, **self.result(barrier), "heard": int(heard)}

    def undone(self, deadline: float, why: str = "") -> dict[str, Any]:
        """Return the answer for what a type does not allow; `why` is about its fields."""
        return {**self.result(self.react(deadline)), "heard": 0, "misfit": why[:LONGEST_REASON]}

    def place(self, command: dict[str, Any], deadline: float) -> dict[str, Any]:
        """Put a turtle into the world: a new one, or one that is there."""
        where = [command[key] for key in ("x", "y", "theta")]
        turtle = command["turtle"] or self.world.unnamed(command["how"])
        heard = int(getattr(self.world, command["how"])(turtle, *where))
        barrier = self.react(deadline)
        return {**self.result(barrier), "heard": heard}

    def goal(self, command: dict[str, Any], deadline: float) -> dict[str, Any]:
        """Send a goal; what becomes of it comes with this answer or later ones."""
        client = self.actions.get(command["action"])
        goal, why = made(command, "Goal") if client is not None else (None, "")
        if client is None or goal is None:
            return self.undone(deadline, why)
        heard = self.await_ready(client.server_is_ready, deadline)
        graph = self.look_closely()
        if heard:
            self.goals.send(command["name"], client, goal)
        barrier = self.react(deadline)
        return {**graph, **self.result(barrier), "heard": int(heard)}

    def cancel(self, command: dict[str, Any], deadline: float) -> dict[str, Any]:
        """Ask for the end of a goal."""
        heard = self.goals.cancel(command["name"])
        barrier = self.react(deadline)
        return {**self.result(barrier), "heard": int(heard)}

    def set(self, command: dict[str, Any], deadline: float) -> dict[str, Any]:
        """Set parameters of a node; `set` has for each whether it was accepted, and why not."""
        self.changes.forget()
        results = set_parameters(self.probe, command["name"], command["values"], deadline)
        barrier = self.react(deadline)
        found = {"set": results or [], "heard": int(results is not None)}
        return {**self.result(barrier), **found, **self.look_closely()}

    def unproven(self, command: dict[str, Any], deadline: float) -> dict[str, Any]:
        """Return which of the values that a node has accepted do not show, and in what."""
        found = self.changes.unproven(command["name"], command["values"], deadline)
        return {"unproven": found, **self.result(self.react(deadline))}

    def parameters(self, command: dict[str, Any], deadline: float) -> dict[str, Any]:
        """Return the parameters of a node."""
        return {"parameters": read_parameters(self.probe, command["name"], deadline)}

    def look_closely(self, *_: Any) -> dict[str, Any]:
        """Return every end of the nodes that are not ours, and the names that several nodes have."""
        self.hearing.look()
        topics = [("subscription", topic) for topic in self.watched]
        topics += [("publisher", topic) for topic in self.publishers]
        asked = (*self.watched, *self.clients, *self.actions)
        ends = ends_of_others(self.probe.node, topics, asked)
        self.asked = self.asked or any(end["role"] == "client" for end in ends)
        return {"ends": ends, "twins": twins_on(self.probe.node)}


def made(command: dict[str, Any], part: str) -> tuple[Any, str]:
    """Return a message with the values of a command, or None and why they do not fit its type.

    The type can be a student's, with other fields than the assignment asks for.
    """
    kind = interface(command["type"])
    message = (getattr(kind, part) if part else kind)()
    try:
        fill(message, command["values"])
    except Exception as error:
        return None, f"{type(error).__name__}: {error}"
    return message, ""


def commands(probe: Any) -> dict[str, Any]:
    """Return the commands that this module adds to a probe."""
    scenario = Scenario(probe)
    acts = ("publish", "call", "goal", "cancel", "place", "set")
    names = ("prepare", "tick", *acts, "parameters", "unproven", "look_closely")
    return {name: getattr(scenario, name) for name in names}
