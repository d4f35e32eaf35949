"""A plain run of a scenario: as a person starts the nodes, on the wall clock, without our arguments.

It asks only whether anything happens: what came first in the judged run, a message or an answer, after
the same stimuli, and a line of each node that only logs. Values and periods are judged in ROS time.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass

from grader.base.unheard import unheard
from grader.course.assignment import Assignment
from grader.course.scenario import RunPlan, Stimulus
from grader.run.conduct import NOTHING, Scene
from grader.run.observations import Observations
from grader.run.observer import SECOND, Observer
from grader.run.prepare import prepare
from grader.run.probe_link import ProbeLink
from grader.run.programs import command_of
from grader.run.run import Run, start
from grader.run.terminal import Terminal
from grader.sandbox.base import Sandbox

EARLY_SECONDS = 4.0  # of ROS time, from the start or a stimulus: what must happen plainly too
PLAIN_SECONDS = 5.0  # of the run's time from the last stimulus, within which it must happen
APART_SECONDS = 0.3  # of the run's time between two stimuli
STOP_SECONDS = 1.0  # of the run's time, for the end after Ctrl+C
STEP = 0.02  # s between two looks


@dataclass(frozen=True)
class Early:
    """The first thing that happens in a run: messages on one of these topics, or an answer.

    `stimuli` are those up to the one after which it happens; `answered` is the last of them, if it is
    answered. `loggers` are of nodes that sent nothing, and logged a line by then.
    """

    topics: frozenset[str]
    answered: str
    stimuli: tuple[Stimulus, ...]
    loggers: frozenset[str] = frozenset()

    def is_in(self, seen: Observations, heard: Collection[str]) -> bool:
        """Whether a run showed it: of each kind at least one. `heard` are the loggers of its lines."""
        done = seen.stimulus(self.answered) if self.answered else None
        message = not self.topics or any(seen.counts.get(topic) for topic in self.topics)
        answer = not self.answered or (done is not None and done.reply is not None)
        return message and answer and self.loggers <= set(heard)


def early(
    plan: RunPlan, seen: Observations, lines: Sequence[tuple[str, float]] = ()
) -> Early | None:
    """Return the first thing that happened in the judged run, None if nothing was seen.

    `lines` are those of the plan's nodes: the logger, and the instant.
    """
    senders = {one.sender.strip("/").replace("/", ".") for one in seen.messages}
    quiet = [] if "" in senders else [one for one in lines if one[0] not in senders]
    stimuli = sorted(plan.do, key=lambda one: one.at)
    starts = [0.0, *(one.at for one in stimuli)]
    only_lines: Early | None = None
    for k, begin in enumerate(starts):
        after = stimuli[k - 1] if k else None
        end = min([begin + EARLY_SECONDS, *(at for at in starts[k + 1 :] if at > begin)])
        topics = {
            m.topic
            for m in seen.messages
            if begin <= m.at < end and seen.ends_of("publisher", m.topic)
        }
        done = seen.stimulus(after.name) if after is not None and after.call is not None else None
        answered = done.name if done is not None and done.reply is not None else ""
        loggers = {logger for logger, at in quiet if begin <= at < end}
        if answered and len(plan.start) == 1:
            loggers.clear()
        before = [one for one in stimuli if k and one.at <= begin]
        found = Early(frozenset(topics), answered, tuple(before), frozenset(loggers))
        if topics or answered or (loggers and k):
            return found
        only_lines = only_lines or (found if loggers else None)  # a program may just say hello
    return only_lines


def happens(
    sandbox: Sandbox,
    assignment: Assignment,
    plan: RunPlan,
    probe: ProbeLink,
    wanted: Early,
    *,
    until: float,
) -> bool:
    """Return whether it happens in a plain run too. Raises ProbeError if our own side failed."""
    left = list(wanted.stimuli)
    plan = plan.model_copy(update={"do": wanted.stimuli})
    commands = [command_of(assignment, one, sandbox.ros.distro, plain=True) for one in plan.start]
    run_clock = sandbox.run_clock
    probe.until = until
    seen = Observations(plan.clock.period)
    seen.unusable.update(prepare(probe, assignment, plan, plain=True))
    terminals: list[Terminal] = []
    try:
        terminals += [start(sandbox, command or NOTHING, probe.pipe) for command in commands]
        observer = Observer(terminals[0], probe, assignment.output, terminals[1:])
        run = Run(commands[0], seen=seen)
        scene = Scene(assignment, plan, probe, observer, terminals, run, unheard)
        scene.deadline = until
        scene.wait_for_nodes(run_clock.now(), sandbox.limits.start_seconds, plain=True)
        began = run_clock.now()
        due, limit = began, run_clock.limit(PLAIN_SECONDS)
        known = 0  # records of before the last stimulus

        def happened() -> bool:
            return wanted.is_in(seen, {record.name for record in observer.records[known:]})

        while not limit.over and not scene.over and (left or not happened()):
            scene.show(round((run_clock.now() - began) * SECOND))
            if left and run_clock.now() >= due:
                known = len(observer.records)
                scene.do_all(left[0].at)
                left = [one for one in left if one.at > left[0].at]
                due, limit = run_clock.now() + APART_SECONDS, run_clock.limit(PLAIN_SECONDS)
            observer.take(probe.ask("wait", seconds=STEP))
        return happened()
    finally:
        for terminal in terminals:
            terminal.interrupt()
        for terminal in terminals:
            terminal.finish(STOP_SECONDS)
            terminal.close()
