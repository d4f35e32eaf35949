"""One run of a scenario: its nodes on terminals, the world and the clock in the probe, then Ctrl+C."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

from grader.course.assignment import Assignment
from grader.course.scenario import Call, Publish, RunPlan, SendGoal, Stimulus
from grader.package.source.timer_periods import TimerPeriods
from grader.run.in_probe.turtlesim import STEP
from grader.run.observations import Done, Goal, Message, Observations, Pose, parameter_from
from grader.run.observer import SECOND, Event, Observer
from grader.run.prepare import prepare
from grader.run.probe_link import Answer, ProbeError, ProbeLink
from grader.run.programs import command_of, full_name, names_of
from grader.run.run import (
    COMPLETE_SECONDS,
    DYING_SECONDS,
    END_SECONDS,
    FOLLOW_SECONDS,
    Program,
    Run,
    accepts,
    ends,
    look_at_programs,
    press_ctrl_c,
    start,
)
from grader.run.terminal import Terminal
from grader.sandbox.base import Sandbox

MILLISECOND = 1_000_000
STEP_SECONDS = 2.0  # of the run's time, for one step
SETTLE_SECONDS = 3.0  # of the run's time, within which a spinning node gives its first answer
RECEIVED = ("publish", "call", "goal", "set")  # what a node must be there to receive
UNKNOWN_STEPS = 10.0  # of the clock's period, for timers of which the source does not say it
MOST_STEPS = 50  # of the clock's period
FINE_TICKS = 8  # before which the clock stops 1 ms earlier too
NOTHING = "false"  # the command in place of a node that has no executable
UNANSWERED = 5  # unanswered steps in a row after which the nodes count as stuck
ANSWERS = 4  # of all nodes, after which their services and subscriptions are known
LOOK_SECONDS = 2.0  # of the run's time, to read the graph, and the parameters of one node
MOST_MESSAGES = 20_000  # of a run
MOST_FEEDBACK = 1_000  # of a goal
MOST_POSES = 20_000  # of a turtle in a run: the 16 ms steps of five minutes


def conduct(
    sandbox: Sandbox,
    assignment: Assignment,
    plan: RunPlan,
    probe: ProbeLink,
    on_event: Callable[[Event], None],
    *,
    until: float,
    timers: TimerPeriods,
) -> Run:
    """Start the nodes, drive clock and world through the plan, press Ctrl+C, return the result.

    The run ends at `until` (by the run's clock) at the latest; `timers` are those of the source.
    Raises ProbeError if our own side
    failed, UsageError if the plan names a type or a field that ROS does not have.
    """
    limits = sandbox.limits
    seen = Observations(plan.clock.period)
    commands = [command_of(assignment, begin, sandbox.ros.distro) for begin in plan.start]
    others = [Program(one.node, line) for one, line in zip(plan.start, commands)][1:]
    run = Run(command=commands[0], name=plan.name, seen=seen, others=others)
    probe.until = until - limits.stop_seconds - END_SECONDS
    seen.unusable.update(prepare(probe, assignment, plan))
    run.began = probe.now()
    run_clock = sandbox.run_clock
    begin = run_clock.now()
    terminals: list[Terminal] = []
    try:
        terminals += [start(sandbox, command or NOTHING, probe.pipe) for command in commands]
        observer = Observer(terminals[0], probe, assignment.output, terminals[1:])
        scene = Scene(assignment, plan, probe, observer, terminals, run, on_event)
        scene.deadline = min(begin + limits.run_seconds, probe.until)
        scene.grid = _grid(plan, timers)
        scene.play(begin, limits.start_seconds)
        _end(run, scene, limits.stop_seconds)
    except ProbeError:
        run.resource = sandbox.probe_limit_hit()
        if not run.resource:
            raise
    finally:
        for terminal in terminals:
            terminal.read()
            terminal.close()
        programs: list[Run | Program] = [run, *run.others]
        for program, terminal in zip(programs, terminals):
            program.transcript = terminal.transcript
        run.flooded = run.flooded or any(terminal.flooded for terminal in terminals)
        run.seconds = run_clock.now() - begin
    return run


def _grid(plan: RunPlan, timers: TimerPeriods) -> int:
    """Return the steps (ns) in which the clock goes on between two instants; 0 for one step.

    A timer fires once after a jump of the clock, however long the jump is: one that is faster than
    the clock would be as slow as the clock. If the source does not say how fast the timers are, and
    a check asks for a period, the steps are a part of the clock's.
    """
    period = plan.clock.period
    unknown = bool(plan.periods) and not timers.are_known
    steps = UNKNOWN_STEPS if unknown else 1.0
    if timers.fastest is not None:
        steps = max(steps, min(MOST_STEPS, period / timers.fastest))
    return round(period / steps * SECOND) if steps > 1 else 0


class Scene:
    """A run that goes on."""

    def __init__(
        self,
        assignment: Assignment,
        plan: RunPlan,
        probe: ProbeLink,
        observer: Observer,
        terminals: Sequence[Terminal],
        run: Run,
        on_event: Callable[[Event], None],
    ) -> None:
        assert run.seen is not None
        self.assignment, self.plan, self.probe = assignment, plan, probe
        self.observer, self.terminals, self.run, self.seen = observer, terminals, run, run.seen
        self._lasting = [one for one, begin in zip(terminals, plan.start) if not begin.exits]
        self._on_event = on_event
        self._run_clock = observer.run_clock
        self.deadline = 0.0  # by the run's clock
        self.grid = 0  # ns, the steps of the clock between two instants; 0 for none
        self.at = 0  # ns
        self._unanswered = 0
        self._proven = 0  # events of the world until the last answer of all nodes
        self._dying_left = DYING_SECONDS
        self._names = {begin.node: full_name(assignment, begin) for begin in plan.start}
        self._unknown: set[str] = set()  # topics with messages of publishers that are not known
        self._waiting = sorted(plan.do, key=lambda one: one.at)

    @property
    def over(self) -> bool:
        """Whether the run cannot go on; it does without the programs that have to end."""
        ended = bool(self._lasting) and all(one.ended or one.flooded for one in self._lasting)
        stuck = self._unanswered >= UNANSWERED
        return ended or stuck or self.observer.flooded or self._run_clock.now() > self.deadline

    def play(self, begin: float, most: float) -> None:
        """Wait for the nodes, then go through all instants of the plan."""
        run, watch = self.run, self.run.watch
        self.observer.lossy = True
        self.wait_for_nodes(begin, most)
        if run.nodes and not self.over:
            watch.clock = "virtual"
            watch.settled = self._settle()
            self._await_dying()
            self.observer.lossy = len(self._lasting) < len(self.terminals)
            for other, terminal in zip(run.others, self.terminals[1:]):
                other.started = not terminal.ended
            self._look()
            self._look_at_programs()
            self.do_all(0.0)
            for k in range(1, self.plan.clock.ticks + 1):
                if self.over:
                    break
                self._tick(round(k * self.plan.clock.period * SECOND))
            self.seen.complete = len(self.seen.instants) == self.plan.clock.ticks
        self._await_dying()
        if self._unanswered >= UNANSWERED:
            self.seen.stuck = self.seen.instants[max(0, len(self.seen.instants) - UNANSWERED)]
            if len(self.terminals) > 1:
                names = self._names.values()
                self.seen.silent = [name for name in names if self._asked(name) is None]
        watch.events += self.observer.settle()
        watch.events[:] = self.observer.visible(watch.events)
        if run.nodes:
            self._look()
            self._look_at_programs(last=True)
        run.ended_by_itself = self.terminals[0].ended
        if run.ended_by_itself and len(self.terminals) == 1:
            self._forget_last_requests()
        run.flooded, run.logged = self.observer.flooded, self.observer.logged
        run.doubled = self.observer.doubled
        run.started = watch.settled or bool(run.nodes and not run.ended_by_itself)

    def _forget_last_requests(self) -> None:
        """Leave out what a program that has ended asked of the world after its last answer.

        Whether such a request still arrives is chance: the program leaves the network meanwhile.
        """
        last = self.seen.events[self._proven :]
        self.seen.events[self._proven :] = [event for event in last if event["kind"] == "bump"]

    def _look_at_programs(self, *, last: bool = False) -> None:
        """Note what runs besides the files of the entry points, once each program has its node."""
        if len(self.run.nodes) < len(self.terminals):
            return
        found: list[Run | Program] = [self.run, *self.run.others]
        for program, terminal, begin in zip(found, self.terminals, self.plan.start):
            node = self.assignment.nodes[begin.node]
            if node.executable:
                package = node.package or self.assignment.package
                look_at_programs(program, terminal, package, node.executable, last=last)

    def wait_for_nodes(self, begin: float, most: float, *, plain: bool = False) -> None:
        """Wait until each program has a node with all its ends, for `most` seconds at most.

        (Without our arguments, in a `plain` run, a node does not listen to /clock.)
        """
        first_seen: float | None = None
        while not self.over:
            answer = self.probe.ask("wait", seconds=0.02)
            events = self.observer.take(answer)
            self.run.watch.before_start += events
            self.run.watch.events += events
            self.observer.linked(answer.nodes)
            now = self._run_clock.now()
            if answer.nodes:
                first_seen = first_seen or now
                self.run.nodes = answer.nodes
                self.run.node_seconds = first_seen - begin
                complete = all((node.clock or plain) and node.services for node in answer.nodes)
                alone = len(answer.nodes) >= sum(not one.ended for one in self.terminals)
                if complete and answer.matched and alone:
                    break
                if now - first_seen > (COMPLETE_SECONDS if alone else most):
                    break
            elif now - begin > most or all(terminal.ended for terminal in self.terminals):
                return
        self._read_names()

    def _read_names(self) -> None:
        """Learn the names of the nodes on the graph: they may not be those of the assignment."""
        there = [node.name for node in self.run.nodes]
        own = names_of(self.assignment, self.plan, there)
        for begin, names in zip(self.plan.start, own):
            if len(names) == 1:
                self._names[begin.node] = names[0]

    def _settle(self) -> bool:
        """Start the clock at 1 ms; return whether a node answers, that is, whether it spins."""
        until = min(self._run_clock.now() + SETTLE_SECONDS, self.deadline)
        settled = False
        while not self.over:
            answer = self.probe.ask("clock", seconds=0.25, at=MILLISECOND, until_log=0, patient=1)
            self._take(answer)
            settled = settled or bool(answer.barrier)
            complete = settled and not answer.silent and self._all_answer()
            if complete or answer.barrier is None:
                break
            if self._run_clock.now() > until:
                break
        for node in self.run.nodes:
            if not node.clock and node.answers:
                accepts(self.observer, "follow", node.name, FOLLOW_SECONDS)
        return settled

    def _all_answer(self) -> bool:
        """Whether each node of several programs has answered: one may be known later than another."""
        if len(self.terminals) == 1:
            return True
        self.run.nodes = self.probe.ask("look").nodes or self.run.nodes
        return all(node.answers for node in self.run.nodes)

    def _tick(self, at: int) -> None:
        """Show an instant, and the steps before it; at first also the moment before it.

        A timer that is faster than the clock's period shows itself there.
        """
        if self.grid:
            first = (self.at // self.grid + 1) * self.grid
            for step in range(first, at - MILLISECOND, self.grid):
                if not self.over:
                    self.show(step)
        if len(self.seen.instants) < FINE_TICKS:
            self.show(at - MILLISECOND)
        self.show(at)
        self.seen.instants.append(round(at / SECOND, 6))
        heard, self._unknown = self._unknown, set()
        due = self._waiting and self._waiting[0].at <= at / SECOND + 1e-9
        if (due or heard) and not self.over:  # (what a stimulus changes, and who sent a message)
            self._look_at_ends()
        self.do_all(at / SECOND)

    def show(self, at: int) -> None:
        """Move the world and the clock to an instant (ns), and take what the nodes did."""
        barriers = 1 + (at // STEP - self.at // STEP if self.plan.world else 0)
        self.at = at
        self.observer.now = at / SECOND
        asked = {"each": STEP_SECONDS * self._run_clock.pace, "at": at}
        said = self.probe.said("tick", seconds=barriers * STEP_SECONDS, **asked)
        self._record(said)
        limit = self._run_clock.limit(
            STEP_SECONDS
        )  # (who is silent is not waited for in each step)
        while said["barrier"] is False and not limit.over and not self.over:
            said = self.probe.said("tick", seconds=limit.rest, **asked)
            self._record(said)
        if said["barrier"]:
            self._proven = len(self.seen.events)
        silent = said["barrier"] is False
        self._unanswered = self._unanswered + 1 if silent else 0
        if said["barrier"] is None:
            self._await_dying()

    def _await_dying(self) -> None:
        """Wait until the programs have ended whose nodes have left the graph.

        A program with an error leaves the graph first and ends some 0.1 s later: without a node to
        wait for, all instants of the plan would be over by then.
        """
        do = "look"
        began, known = self._run_clock.now(), {node.name for node in self.run.nodes}
        while not self.over and self._run_clock.now() - began < self._dying_left:
            answer = self.probe.ask(do, seconds=0.02)
            do = "wait"
            self._take(answer)
            there = sum(node.name in known for node in answer.nodes)
            if there >= sum(not terminal.ended for terminal in self.terminals):
                break
        self._dying_left -= self._run_clock.now() - began

    def do_all(self, until: float) -> None:
        """Do what is due at an instant (s)."""
        while self._waiting and self._waiting[0].at <= until + 1e-9 and not self.over:
            self._do(self._waiting.pop(0))

    def _do(self, one: Stimulus) -> None:
        done = Done(one.name, one.at)
        self.seen.done.append(done)
        if one.publish is not None:
            self._send(done, "publish", one.publish)
        elif one.call is not None:
            self._send(done, "call", one.call)
        elif one.goal is not None:
            self.seen.goals.append(Goal(one.name, one.at))
            self._send(done, "goal", one.goal)
        elif one.cancel is not None:
            self._act(done, "cancel", name=one.cancel)
        elif one.spawn is not None:
            self._act(done, "place", how="spawn", **one.spawn.model_dump())
        elif one.move is not None:
            self._act(done, "place", how="move", **one.move.model_dump())
        for node, values in (one.set or {}).items():
            name = self._names.get(node, f"/{node}")
            said = self._act(done, "set", name=name, values=values)
            for parameter, accepted, reason in said["set"]:
                done.accepted[str(parameter)] = "" if accepted else str(reason) or "refused"
            right = {one: value for one, value in values.items() if done.accepted.get(one) == ""}
            if right:
                done.unproven.update(self._unproven(name, right))

    def _unproven(self, name: str, values: Mapping[str, object]) -> dict[str, str]:
        """Return what does not show of values that a node has accepted, until the run's clock is over."""
        limit = self._run_clock.limit(LOOK_SECONDS)
        while True:
            said = self.probe.said("unproven", seconds=limit.rest, name=name, values=values)
            self._record(said)
            if not said["unproven"] or limit.over or self.over:
                return {str(one): str(what) for one, what in said["unproven"].items()}

    def _send(self, done: Done, command: str, what: Publish | Call | SendGoal) -> None:
        """Send something of a type, which may not have the fields that the assignment asks for."""
        said = self._act(done, command, name=done.name, **what.model_dump())
        if misfit := said.get("misfit"):
            self.seen.unusable[what.type] = str(misfit)

    def _act(self, done: Done, command: str, **more: object) -> Mapping[str, Any]:
        """Let the probe do something, count who received it, and keep what came of it.

        What nobody is there to receive waits until the run's clock says that nobody comes. Nodes
        that have answered `ANSWERS` times since then have told what they have, however busy the
        machine is.
        """
        limit, answered = self._run_clock.limit(STEP_SECONDS, decides=False), 0
        while True:
            last = limit.over or command not in RECEIVED
            said = self.probe.said(command, seconds=limit.rest, last=last, **more)
            self._record(said)
            answered += said["barrier"] is True
            if said["heard"] or last or self.over:
                if limit.over and not said["heard"] and answered < ANSWERS:
                    limit.decide()
                done.heard += int(said["heard"])
                return said

    def _record(self, said: Mapping[str, Any]) -> None:
        """Keep what an answer holds, at the present instant."""
        at, seen = round(self.at / SECOND, 6), self.seen
        self._take(self.probe.answer_of(said))
        seen.keep_graph(said)
        for topic, values, before, sender in said.get("messages", ()):
            if len(seen.messages) < MOST_MESSAGES:
                # one that was sent before the clock's first instant can arrive after it, under load
                sent = min(at, MILLISECOND / SECOND) if before else at
                seen.messages.append(Message(str(topic), sent, values, str(sender)))
        seen.name_senders(said.get("senders", {}))
        for topic, count in said.get("counts", {}).items():
            if topic not in seen.counts and not seen.ends_of("publisher", topic):
                self._unknown.add(topic)
            seen.counts[topic] = seen.counts.get(topic, 0) + int(count)
        for name, reply in said.get("replies", ()):
            found = seen.stimulus(str(name))
            if found is not None:
                found.reply, found.replied = reply, at
        for name, what, values in said.get("goals", ()):
            self._record_goal(str(name), str(what), values)
        path = said.get("path", ())
        turtles = len({pose[0] for pose in path}) or 1
        for n, (turtle, x, y, theta, *put) in enumerate(path):
            if len(seen.path) < MOST_POSES * turtles:
                behind = (len(path) - 1 - n) // turtles
                now = (self.at // STEP - behind) * STEP / SECOND
                place = (round(x, 6), round(y, 6), round(theta, 6))
                seen.path.append(Pose(str(turtle), round(now, 3), *place, put=any(put)))
        seen.events += [{**event, "at": at} for event in said.get("events", ())]

    def _record_goal(self, name: str, what: str, values: Any) -> None:
        """Keep what became of a goal, at the present instant."""
        at, goal = round(self.at / SECOND, 6), self.seen.goal(name)
        if goal is None:
            return
        if what == "accepted":
            goal.accepted = at
        elif what == "refused":
            goal.refused = at
        elif what == "feedback" and len(goal.feedback) < MOST_FEEDBACK:
            goal.feedback.append((at, values))
        elif what in ("succeeded", "canceled", "aborted"):
            goal.status, goal.result, goal.ended = what, values, at

    def _take(self, answer: Answer) -> None:
        events = self.observer.take(answer) + self.observer.catch_up(answer.logs)
        self.run.watch.events += events
        for event in events:
            self._on_event(event)

    def _look(self) -> None:
        """Read the graph and the parameters; a value counts as it was when it was read first."""
        self._look_at_ends()
        now = self.probe.ask("look").nodes
        left = {node.name: node for node in self.run.nodes if now and self.run.others}
        there = {**left, **{node.name: node for node in now}}  # (of several, one that has gone too)
        self.run.nodes = tuple(there.values()) or self.run.nodes
        self._read_names()
        if self.over:
            return
        for name in self._names.values():
            asked = self._asked(name)
            if asked is not None:
                found = {one.name: one for one in map(parameter_from, asked)}
                found |= {one.name: one for one in self.seen.parameters.get(name, ())}
                self.seen.parameters[name] = list(found.values())

    def _asked(self, name: str) -> Any:
        """Return what a node says about its parameters; None if it does not answer."""
        limit = self._run_clock.limit(LOOK_SECONDS)
        while True:
            said = self.probe.said("parameters", seconds=limit.rest, name=name)
            if said.get("parameters") is not None or limit.over or self.over:
                return said.get("parameters")

    def _look_at_ends(self) -> None:
        """Read the graph."""
        self.seen.keep_graph(self.probe.said("look_closely", seconds=LOOK_SECONDS))


def _end(run: Run, scene: Scene, seconds: float) -> None:
    """Press Ctrl+C on every terminal, and record how each program ends."""

    def go_on(passed: float) -> None:
        scene.at += round(passed * SECOND)
        scene.observer.take(scene.probe.ask("clock", at=scene.at, until_log=0, patient=0))

    now = scene.observer.run_clock.now
    pressed = now()
    others = list(zip(run.others, scene.terminals[1:]))
    for other, terminal in others:
        other.by_itself = terminal.ended
        if not terminal.ended:
            terminal.interrupt()
    press_ctrl_c(run, scene.terminals[0], go_on, seconds)
    for other, terminal in others:
        if ends(terminal, go_on, now() + seconds):
            other.stop_seconds = now() - pressed
            other.status, other.signal = terminal.status
    run.watch.events += scene.observer.take_last()
