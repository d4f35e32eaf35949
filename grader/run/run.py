"""One run: `ros2 run` on a pseudo-terminal, the probe beside it, then Ctrl+C."""

from __future__ import annotations

import contextlib
import math
import shlex
import time
from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

from grader.base.i18n.message import say
from grader.course.assignment import Assignment
from grader.ros.distro import Distro
from grader.run.clock import GRID, STILL, ForeignClock, VirtualClock, watch_wall
from grader.run.observations import Observations
from grader.run.observer import Event, Observer, Watch, number_reader
from grader.run.probe_link import NodeSeen, ProbeError, ProbeLink
from grader.run.screen import stays
from grader.run.started_program import programs
from grader.run.terminal import Terminal
from grader.sandbox.base import UNRUNNABLE, Pipe, Sandbox

SIM_TIME = ("--ros-args", "-p", "use_sim_time:=true")
UNSEEN_SECONDS = (
    5.0  # of the run's time, from the first line within which a node appears on the graph
)
COMPLETE_SECONDS = 2.0  # of the run's time, within which all endpoints of a visible node appear
OWN_TRACEBACK = '/bin/ros2", line '  # in a traceback of the ros2 command itself
DYING_SECONDS = (
    3.0  # of the run's time, within which a program ends whose nodes have left the graph
)
WALL_TOLERANCE = 0.05  # of a period on the wall clock
GONE_SECONDS = 0.1  # of the run's time, for one more look at the graph
FOLLOW_SECONDS = 2.0  # of the run's time, in which a node that spins sets use_sim_time
TRY_SECONDS = 3.0  # of the run's time, in which one of a node's own services answers
SETTLE_SECONDS = (
    0.1  # of the run's time, in which lines come that were logged before the time stood still
)
PASSING_SECONDS = 0.25  # by which ROS time goes on at once while the node ends
MOST_BESIDE = 3  # programs beside a node that are told
END_SECONDS = 10.0  # of a run's time, reserved for killing what does not end by itself


@dataclass
class Program:
    """A program that a scenario starts beside its first one; `node` is its key in the assignment.

    `started` is False if it ended before the clock began, `by_itself` True if it ended before
    Ctrl+C; `stop_seconds` are counted from there. `instead` and `beside` are as in a Run.
    """

    node: str
    command: str
    started: bool = False
    by_itself: bool = False
    stop_seconds: float | None = None
    status: int | None = None
    signal: int | None = None
    transcript: str = ""
    instead: str = ""
    beside: list[str] = field(default_factory=list)


@dataclass
class Run:
    """The result of one run; times in seconds.

    `counting` is the node whose logger carried the count, "" if it is unknown.
    `first_line_seconds` is counted from the start of `ros2 run`; `logged` is the number of bytes
    that the log records would take on a terminal. `confirmed` is whether the node also counts as a
    person would run it, None if it was not run so. `doubled` is a node with two publishers on
    /rosout: its records prove nothing. `erased` is above 0 if the terminal no longer shows lines of
    the count. `held_up` is the median of the seconds for which the node held up its steps in two
    runs, 0 if it was at most a period. `name`, `seen` and `others` are of a run of a scenario, whose
    first program all the rest is about. `exits` is whether the program has to end by itself, `done`
    whether it did so, with status 0: that is no early end (`ended_by_itself`). `instead` is the
    command line of a program that had the node without the file of the entry point, `beside` those
    of the programs that ran beside it. `began` is when the programs were started, by the probe's clock
    (ns), 0 if that is unknown.
    """

    command: str
    watch: Watch = field(default_factory=Watch)
    nodes: tuple[NodeSeen, ...] = ()
    counting: str = ""
    started: bool = False
    ended_by_itself: bool = False
    interrupted: bool = False
    stop_seconds: float | None = None
    status: int | None = None
    signal: int | None = None
    transcript: str = ""
    flooded: bool = False
    logged: int = 0
    resource: str = ""
    inconsistent: bool = False
    confirmed: bool | None = None
    doubled: str = ""
    erased: int = 0
    held_up: float = 0.0
    seconds: float = 0
    node_seconds: float | None = None
    first_line_seconds: float | None = None
    name: str = ""
    seen: Observations | None = None
    others: list[Program] = field(default_factory=list)
    exits: bool = False
    done: bool = False
    instead: str = ""
    beside: list[str] = field(default_factory=list)
    began: int = 0

    @property
    def is_spun(self) -> bool:
        """Whether something shows that its node spins: what does not is judged nowhere else."""
        works = self.confirmed is not False or self.seen is None
        return works and (self.done or self._answers or self._follows)

    @property
    def _answers(self) -> bool:
        """Whether a service of the node that counts has answered; of any node if it is unknown."""
        node = self.counting_node
        if node is not None and len(self.nodes) > 1:
            return node.answers
        return self.watch.settled or any(each.answers for each in self.nodes)

    @property
    def _follows(self) -> bool:
        """Whether lines came at their instants on /clock, which only a node that spins receives."""
        virtual = self.watch.clock == "virtual"
        return virtual and any(event.due is not None for event in self.watch.counted)

    @property
    def counting_node(self) -> NodeSeen | None:
        """The node whose logger carried the count, None if it is unknown."""
        return next((node for node in self.nodes if node.name == self.counting), None)

    @property
    def plain(self) -> bool:
        """Whether the command had no arguments of ours."""
        return bool(self.command) and SIM_TIME[0] not in self.command

    @property
    def doubts_ros2(self) -> bool:
        """Whether `ros2` itself may have failed to run (the student's code can cause this too)."""
        unrunnable = self.status in UNRUNNABLE or OWN_TRACEBACK in self.transcript
        return self.ended_by_itself and not self.nodes and unrunnable


def ros2_run(distro: Distro, package: str, executable: str, *arguments: str) -> str:
    """Return the `ros2 run` command for a program that gets one Ctrl+C.

    Where `ros2 run` sends Ctrl+C on, the program gets a session of its own, in which that of the
    terminal does not reach it. A second one would stop the clean-up of most nodes somewhere, and
    what is wrong after that place would be seen or not by chance.
    """
    prefix = ["--prefix", "setsid"] if distro.forwards_interrupt else []
    return shlex.join(["ros2", "run", *prefix, package, executable, *arguments])


def observe(
    sandbox: Sandbox,
    assignment: Assignment,
    probe: ProbeLink,
    on_event: Callable[[Event], None],
    *,
    until: float = math.inf,
    fine: bool = False,
    grid: float = GRID,
    fine_ticks: int = 0,
    real_time: bool = False,
    more_ticks: int = 0,
    stay_seconds: float = 0,
    plain: bool = False,
) -> Run:
    """Run the node, drive its clock (in `fine` steps or coarse), press Ctrl+C, return the result.

    A period has `grid` fine steps; the last `fine_ticks` come in fine steps in any case. With
    `real_time` ROS time is as fast as the wall clock. With `plain` the command has no arguments of
    ours, so that the node follows the wall clock. The clock shows `more_ticks` beyond those that the
    assignment announces; the last of them comes `stay_seconds` of wall time after the node at the
    earliest.

    The run ends at `until` (by the run's clock) at the latest. Raises ProbeError if our own side
    failed. It is the run's `resource` instead if the probe exceeded a limit, because the node
    flooded it, or if the node still runs beyond its time limit when the probe fails.
    """
    limits = sandbox.limits
    added = () if plain else SIM_TIME
    run = Run(
        command=ros2_run(sandbox.ros.distro, assignment.package, assignment.executable, *added)
    )
    probe.until = until - limits.stop_seconds - END_SECONDS
    probe.ready()
    run.began = probe.now()
    begin = sandbox.run_clock.now()
    longest = limits.run_seconds + limits.stop_seconds
    terminal = start(sandbox, run.command, probe.pipe)
    try:
        observer = Observer(terminal, probe, assignment.output)
        clock: VirtualClock | None = None
        follows = _wait_for_node(run, observer, begin, limits.start_seconds)
        named = (assignment.package, assignment.executable)
        if run.nodes and not terminal.ended:
            look_at_programs(run, terminal, *named)
            deadline = min(begin + limits.run_seconds, probe.until)
            clock = VirtualClock(
                observer,
                assignment.output,
                deadline=deadline,
                fine=fine,
                grid=grid,
                fine_ticks=fine_ticks,
                real_time=real_time,
                more_ticks=more_ticks,
                stay_until=time.monotonic() + stay_seconds if stay_seconds else 0,
            )
            _watch(run, observer, clock, on_event, follows=follows, deadline=deadline)
        watch = run.watch
        watch.events += observer.settle()
        _keep_what_can_be_read(run, observer, terminal)
        counted = watch.counted
        if run.nodes and not counted and not watch.settled and not observer.over:
            # one that was destroyed at once may have been seen or not
            run.nodes = _still_there(observer)
        if counted:
            run.first_line_seconds = counted[0].wall - terminal.started
        run.ended_by_itself, run.flooded = terminal.ended, observer.flooded
        run.logged = observer.logged
        run.doubled = observer.doubled
        run.started = run.watch.settled or bool(run.nodes and (counted or not terminal.ended))
        if run.nodes:
            look_at_programs(run, terminal, *named, last=True)
        go_on = clock.go_on if clock is not None else None
        press_ctrl_c(run, terminal, go_on, limits.stop_seconds)
        run.watch.events += observer.take_last()
    except ProbeError:
        overdue = sandbox.run_clock.now() - begin > longest
        terminal.read()  # updates terminal.ended
        overdue = overdue and not terminal.ended
        run.resource = sandbox.probe_limit_hit() or ("wall time" if overdue else "")
        if not run.resource:
            raise
    finally:
        terminal.close()
        run.transcript = terminal.transcript
        run.flooded = run.flooded or terminal.flooded
        run.seconds = sandbox.run_clock.now() - begin
    return run


def _keep_what_can_be_read(run: Run, observer: Observer, terminal: Terminal) -> None:
    """Leave out what no person could read: lines that are not, or no longer, on the terminal."""
    watch = run.watch
    can_be_read = stays(terminal.raw)
    for seen in (watch.events, watch.before_start, watch.early):
        seen[:] = observer.visible(seen)
        if can_be_read is not None:
            kept = [event for event in seen if event.n is None or can_be_read(event.text)]
            run.erased += len(seen) - len(kept)
            seen[:] = kept


def counts_plainly(
    sandbox: Sandbox, assignment: Assignment, *, patience: float, until: float
) -> bool:
    """Return whether the node counts on the wall clock, without arguments: two lines are enough.

    Nobody else is on its network, as at a person's first terminal. It has `patience` seconds for
    the two lines; then, or at `until` (by the run's clock), the command is stopped by Ctrl+C.
    """
    output = assignment.output
    number = number_reader(output)
    network = sandbox.probe(["cat"])  # it has a network of its own until its input ends
    command = ros2_run(sandbox.ros.distro, assignment.package, assignment.executable)
    terminal = start(sandbox, command, network)
    try:
        wanted = [output.start, output.start + output.step]
        run_clock = sandbox.run_clock
        limit = run_clock.limit(min(patience, until - run_clock.now()))
        while not limit.over and not terminal.ended and not terminal.flooded:
            for line in terminal.read(0.2):
                texts = [part.text if part.log is None else part.log[3] for part in line.parts()]
                for text in texts:
                    if wanted and number(text) == wanted[0]:
                        del wanted[0]
            if not wanted:
                return True
        return False
    finally:
        terminal.interrupt()
        terminal.finish(min(1.0, sandbox.limits.stop_seconds))
        terminal.close()
        network.finish(1.0)


def start(sandbox: Sandbox, command: str, network: Pipe) -> Terminal:
    """Return a terminal with the student's command in their workspace, in the network of a pipe."""
    console = sandbox.console(["bash", "-c", sandbox.in_workspace(command)], probe=network)
    return Terminal(console, most=int(sandbox.limits.output), run_clock=sandbox.run_clock)


def look_at_programs(
    found: Run | Program, terminal: Terminal, package: str, executable: str, *, last: bool = False
) -> None:
    """Note what runs on a terminal whose node is on the graph, besides the file of its entry point.

    What is there at the beginning of the run and at its end runs instead of that file: a program that
    ends can be seen without it for a moment.
    """
    seen = programs(terminal.processes(), package=package, executable=executable)
    over = terminal.status != (None, None)
    if seen is None or over or seen.own:
        found.instead = ""
    elif not last and seen.others:
        found.instead = seen.others[0]
    if seen is not None and not over:
        more = [one for one in seen.others if one not in (*found.beside, found.instead)]
        found.beside += more[:MOST_BESIDE]


def _wait_for_node(run: Run, observer: Observer, begin: float, most: float) -> bool:
    """Wait for a node on the graph; return whether it follows `/clock`."""
    first_seen: float | None = None
    first_line = begin
    while not observer.over:
        answer = observer.probe.ask("wait", seconds=0.02)
        events = observer.take(answer)
        run.watch.before_start += events
        run.watch.events += events
        now = observer.run_clock.now()
        observer.linked(answer.nodes)
        if answer.nodes:
            first_seen = first_seen or now
            run.nodes = answer.nodes
            run.node_seconds = first_seen - begin
            complete = all(node.clock and node.services for node in answer.nodes)
            if complete and answer.matched:
                return True
            if now - first_seen > COMPLETE_SECONDS:
                return any(node.clock for node in answer.nodes)
        elif now - begin > most or (run.watch.counted and now - first_line > UNSEEN_SECONDS):
            return False
        if not run.watch.counted:
            first_line = now
    return False


def _watch(
    run: Run,
    observer: Observer,
    clock: VirtualClock,
    on_event: Callable[[Event], None],
    *,
    follows: bool,
    deadline: float,
) -> None:
    output, watch = observer.output, run.watch
    foreign = False
    if follows:
        try:
            clock.drive(watch, on_event)
        except ForeignClock as error:
            watch.events += error.events
            watch.note = say("the node publishes /clock itself")
            watch_wall(observer, output, watch, on_event, deadline=deadline)
            foreign = True
    else:
        watch.note = say("the node does not follow /clock")
        watch_wall(observer, output, watch, on_event, deadline=deadline)
    there = observer.probe.ask("look").nodes
    if not there:
        watch.events += _await_end(observer, deadline)
    run.nodes = there or run.nodes
    run.inconsistent = off_by_load(watch, output.period, observer.slack)
    run.counting = counting_node(run.nodes, watch.counted)
    if watch.clock == "wall" and watch.counted and not foreign and not observer.over:
        watch.while_still = _count_while_still(run, observer)
        run.nodes = observer.probe.ask("look").nodes or run.nodes


def _await_end(observer: Observer, deadline: float) -> list[Event]:
    """Wait for the end of a program whose nodes have left the graph; return what it still writes.

    A program with an error leaves the graph first, and ends a moment later, on a busy machine long
    after.
    """
    events: list[Event] = []
    until = min(deadline, observer.run_clock.now() + DYING_SECONDS)
    while not observer.over and observer.run_clock.now() < until:
        events += observer.take(observer.probe.ask("wait", seconds=0.05))
    return events


def counting_node(nodes: Sequence[NodeSeen], counted: Sequence[Event]) -> str:
    """Return the full name of the node whose logger carried most lines of the count, else ""."""
    loggers = {node.logger: node.name for node in nodes}
    records = Counter(
        event.record.name
        for event in counted
        if event.record is not None and event.record.name in loggers
    )
    return loggers[records.most_common(1)[0][0]] if records else ""


def _count_while_still(run: Run, observer: Observer) -> bool | None:
    """Return whether lines come while ROS time stands still; None if it cannot be made to.

    A node that did not get its arguments gets `use_sim_time` from its parameter service.
    """
    node = run.counting_node
    if node is None:
        return True if all(each.clock for each in run.nodes) else None
    if node.clock and node.sim_time is not False:
        return True  # time stood still while it was watched on the wall clock
    if not node.answers:
        if not node.services:
            accepts(observer, "try", node.name, TRY_SECONDS)
        return None
    if not accepts(observer, "follow", node.name, FOLLOW_SECONDS):
        return None
    run.watch.events += observer.watch_still(SETTLE_SECONDS)
    kinds = {event.kind for event in run.watch.counted}
    still = observer.watch_still(STILL * observer.output.period, decides=True)
    run.watch.events += still
    return any(event.kind in kinds for event in still)


def _still_there(observer: Observer) -> tuple[NodeSeen, ...]:
    """Return the nodes that are on the graph a moment later; none once there has been none."""
    limit = observer.run_clock.limit(GONE_SECONDS)
    while (nodes := observer.probe.ask("wait", seconds=GONE_SECONDS).nodes) and not limit.over:
        continue
    return nodes


def off_by_load(watch: Watch, wanted: float, slack: float) -> bool:
    """Whether a period on the wall clock is wrong, but by no more than the node waited for a core.

    `slack` is its wait between two lines, in seconds as the period: each gap has two ends.
    """
    if watch.clock != "wall" or watch.period is None:
        return False
    off = abs(watch.period - wanted) - WALL_TOLERANCE * wanted
    return 0 < off <= 2 * slack


def accepts(observer: Observer, do: str, name: str, seconds: float) -> bool:
    """Ask a node something until it accepts, or the seconds of the run's clock are over."""
    limit = observer.run_clock.limit(seconds)
    while True:
        answer = observer.probe.ask(do, name=name, seconds=limit.rest)
        observer.take(answer)
        if answer.barrier or limit.over or observer.over:
            return bool(answer.barrier)


def press_ctrl_c(
    run: Run, terminal: Terminal, go_on: Callable[[float], None] | None, seconds: float
) -> None:
    """Press Ctrl+C and record how the node ends; ROS time goes on, as it does for a person.

    Python's own signal handlers run when the node's wait returns: at its next timer, for example.
    """
    now = terminal.run_clock.now
    pressed = now()
    if run.flooded:
        return
    if not terminal.ended:
        run.interrupted = True
        terminal.interrupt()
    if ends(terminal, go_on, pressed + seconds):
        run.stop_seconds = now() - pressed
        run.status, run.signal = terminal.status


def ends(terminal: Terminal, go_on: Callable[[float], None] | None, until: float) -> bool:
    """Whether a program ends before `until` (by the run's clock), while ROS time goes on."""
    now = terminal.run_clock.now
    _, ended = terminal.finish(min(max(0.0, until - now()), PASSING_SECONDS))
    while not ended and (left := until - now()) > 0:
        if go_on is not None:
            with contextlib.suppress(ProbeError):
                go_on(PASSING_SECONDS)
        _, ended = terminal.finish(min(left, PASSING_SECONDS))
    return ended
