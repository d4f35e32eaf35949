"""Short runs of a scenario, for many variants of one node's files: without a build or a probe.

The node runs in one process with the scenario (grader/run/in_probe/short_scene.py), in ROS time that
jumps from one event to the next. What the run's other programs sent in the real run is sent again. It
is no verdict: it shows which of many changes may help.
"""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import asdict, dataclass
from typing import Any

from grader.course.assignment import Assignment
from grader.course.scenario import RunPlan, Stimulus
from grader.package.source.names import module_name
from grader.run.observations import Done, End, Message, Observations, Pose, parameter_from
from grader.run.observer import SECOND, Event, Watch
from grader.run.probe_link import LogRecord, NodeSeen, in_probe
from grader.run.programs import full_name
from grader.run.run import Run
from grader.run.variants import MALFORMED, Trace, Watched, answers, trace_from
from grader.sandbox.base import Sandbox

MODULES = ("messages", "short_scene")
MOST_LINES = 10_000
EACH_SECONDS = 12.0  # for one variant, without the time in which it waits for a core
MOST_REPLAYED = 2_000
ALIVE = ("time", "lines", "killed", "hangs", "waits")
"""How a run ends whose node still ran."""
STUCK = ("killed", "hangs", "waits")


@dataclass(frozen=True)
class Scene:
    """A node of an assignment in one of its runs; `start` is which of the run's programs it is.

    `assignment` is about the node. `heard` are the messages that others sent in the real run: the
    topic, its type, the instant (s) and the values.
    """

    assignment: Assignment
    plan: RunPlan
    start: int
    heard: tuple[tuple[str, str, float, Any], ...] = ()

    @property
    def module(self) -> str:
        """The module of the node's entry point."""
        return self.assignment.target.partition(":")[0]


@dataclass(frozen=True)
class SceneRun:
    """What a variant did: the run as the checks judge it, how it ended, and the trace if it was traced."""

    run: Run
    ended: str
    used: float
    trace: Trace | None = None
    checked: bool = False


def run_scenes(
    sandbox: Sandbox,
    scene: Scene,
    variants: Sequence[Mapping[str, str]],
    *,
    seconds: float,
    traced: Sequence[str] = (),
    conditions: Sequence[Watched] = (),
    checked: bool = False,
) -> list[SceneRun | None]:
    """Return what each variant did; None for those that were not run in `seconds` of processor time.

    A variant is the new texts of files by their paths; `traced` are the files that are followed, and
    `conditions` those in them whose values are kept. A field that gets a value of another type
    raises an exception if the fields are `checked`; otherwise ROS may end the process.
    """
    plan = scene.plan
    begin = plan.start[scene.start]
    asked = {
        "variants": [{module_name(path): text for path, text in one.items()} for one in variants],
        "watched": [None] * len(variants),
        "traced": list(traced),
        "conditions": [*map(asdict, conditions)],
        "checked": checked,
        "words": begin.words(scene.assignment.package, plain=True),
        "each": EACH_SECONDS,
        "lines": MOST_LINES,
        "scene": {
            "do": [*(each for one in plan.do for each in _asked(one)), *_replayed(scene)],
            "watch": list(plan.topics),
            "end": round(plan.clock.period * plan.clock.ticks * SECOND),
            "world": f"grader.run.in_probe.{plan.world}" if plan.world else "",
            "others": [],
        },
    }
    modules = [in_probe(name) for name in (*MODULES, *([plan.world] if plan.world else []))]
    found: list[SceneRun | None] = [None] * len(variants)
    function = scene.assignment.target.partition(":")[2]
    for said in answers(
        sandbox, scene.module, function, asked, period=1.0, seconds=seconds, modules=modules
    ):
        with suppress(*MALFORMED):
            one = json.loads(said)
            if isinstance(one["index"], int) and 0 <= one["index"] < len(found):
                found[one["index"]] = _seen(one, scene, traced, conditions)
    return found


def _asked(one: Stimulus) -> list[dict[str, Any]]:
    """Return a stimulus as the program reads it: one for each node whose parameters are set."""
    base = {"name": one.name, "at": round(one.at * SECOND)}
    if one.publish is not None:
        return [{**base, "how": "publish", **one.publish.model_dump()}]
    if one.call is not None:
        return [{**base, "how": "call", **one.call.model_dump()}]
    if one.spawn is not None:
        return [{**base, "how": "place", "kind": "spawn", **one.spawn.model_dump()}]
    if one.move is not None:
        return [{**base, "how": "place", "kind": "move", **one.move.model_dump()}]
    return [
        {**base, "how": "set", "node": f"/{node}", "values": values}
        for node, values in (one.set or {}).items()
    ]


def _replayed(scene: Scene) -> list[dict[str, Any]]:
    return [
        {
            "name": "",
            "at": round(at * SECOND),
            "how": "publish",
            "topic": topic,
            "type": kind,
            "values": values,
        }
        for topic, kind, at, values in scene.heard[:MOST_REPLAYED]
    ]


def _seen(one: Any, scene: Scene, traced: Sequence[str], conditions: Sequence[Watched]) -> SceneRun:
    """Read what a variant did; raises an error of Python if it has another form."""
    seen, used = one["seen"], float(one["used"])
    if seen is None:
        return SceneRun(_run(scene, {}, "killed"), "killed", used)
    ended = str(seen["ended"])
    trace = trace_from(seen, traced, conditions) if traced and seen["trace"] else None
    return SceneRun(_run(scene, seen["scene"], ended), ended, used, trace)


def _run(scene: Scene, said: Mapping[str, Any], ended: str) -> Run:
    """Return a run as a real one would be seen."""
    plan = scene.plan
    alive = ended in ALIVE
    now = float(said.get("now", 0)) / SECOND
    period = plan.clock.period
    last = plan.clock.ticks if ended == "time" else int(now / period + 1e-6)
    seen = Observations(period, [round((k + 1) * period, 6) for k in range(last)])
    seen.complete = ended == "time"
    if ended in STUCK:
        seen.stuck = seen.instants[-1] if seen.instants else 0.0
    for topic, at, values, sender in said.get("messages", ()):
        seen.messages.append(Message(str(topic), _at(at), values, str(sender)))
    seen.counts = {str(topic): int(count) for topic, count in said.get("counts", {}).items()}
    seen.ends = [End(**end) for end in said.get("ends", ())]
    for name, found in said.get("parameters", {}).items():
        seen.parameters[str(name)] = [parameter_from(each) for each in found]
    for each in said.get("done", ()):
        if each["name"]:
            replied = _at(each["replied"]) if each.get("replied") is not None else None
            seen.done.append(
                Done(
                    str(each["name"]),
                    _at(each["at"]),
                    int(each["heard"]),
                    {str(key): str(why) for key, why in each["accepted"].items()},
                    each.get("reply"),
                    replied,
                )
            )
    step = int(said.get("step", 0))
    turtles = len({pose[0] for pose in said.get("path", ())}) or 1
    for n, (turtle, x, y, theta, *put) in enumerate(said.get("path", ())):
        at = round((n // turtles + 1) * step / SECOND, 3)
        place = (round(x, 6), round(y, 6), round(theta, 6))
        seen.path.append(Pose(str(turtle), at, *place, put=any(put)))
    seen.events = [{**event, "at": _at(event["at"])} for event in said.get("events", ())]
    spins = bool(seen.instants) and ended != "killed"  # (time goes on only while it spins)
    names = [str(name) for name in said.get("nodes", ())]
    nodes = tuple(NodeSeen(name, True, True, True, True, spins, False) for name in names)
    watch = Watch(clock="virtual", events=list(_events(said)), settled=spins)
    return Run(
        command="",
        watch=watch,
        nodes=nodes
        or (NodeSeen(full_name(scene.assignment, plan.start[scene.start]), True, True, True),),
        started=bool(names),
        ended_by_itself=not alive,
        interrupted=alive,
        stop_seconds=0.1,
        status=0 if alive else 1,
        transcript="",
        name=plan.name,
        seen=seen,
    )


def _at(instant: Any) -> float:
    return round(float(instant) / SECOND, 6)


def _events(said: Mapping[str, Any]) -> list[Event]:
    found = []
    for at, level, name, text in said.get("logs", ()):
        record = LogRecord(int(level), str(name), str(text), "", "", 0, 0)
        found.append(
            Event(str(text), _at(at), _at(at), "logger", None, record=record, logger=str(name))
        )
    return found
