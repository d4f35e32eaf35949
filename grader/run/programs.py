"""One program of a scenario's run: which nodes are its own, and the run as that program showed it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from grader.base.nearest import nearest
from grader.course.assignment import Assignment
from grader.course.scenario import RunPlan, Start
from grader.ros.distro import Distro
from grader.run.observer import Event
from grader.run.run import Program, Run, ros2_run


def command_of(assignment: Assignment, begin: Start, distro: Distro, *, plain: bool = False) -> str:
    """Return the `ros2 run` command that starts a node of a plan; "" if it has no executable.

    With `plain` it has no arguments of ours.
    """
    node = assignment.nodes[begin.node]
    package = node.package or assignment.package
    if not node.executable:
        return ""
    return ros2_run(distro, package, node.executable, *begin.words(package, plain=plain))


def full_name(assignment: Assignment, begin: Start) -> str:
    """Return the full name of a node that a plan starts."""
    space = "/" + begin.namespace.strip("/")
    name = begin.name or assignment.nodes[begin.node].name
    return f"{space.rstrip('/')}/{name}"


def names_of(assignment: Assignment, plan: RunPlan, there: Sequence[str]) -> list[tuple[str, ...]]:
    """Return the full names of each program's nodes, in the order of the plan.

    `there` has the names on the graph. A node with the name of a started one is that program's. The
    others are of the programs whose node has another name: of a single such program all, of several
    the most similar one each.
    """
    wanted = [full_name(assignment, begin) for begin in plan.start]
    if len(wanted) == 1:
        return [tuple(there)]
    left = [name for name in there if name not in wanted]
    renamed = [name for name in wanted if name not in there]
    others = dict.fromkeys(renamed, tuple(left))
    if len(renamed) > 1:
        for name in renamed:
            best = nearest(name, left, cutoff=0.0)
            others[name] = (best,) if best else ()
            left = [one for one in left if one != best]
    return [others.get(name, (name,)) for name in wanted]


def of_program(run: Run, assignment: Assignment, plan: RunPlan, start: int) -> Run:
    """Return a run as one of its programs showed it: the `start`-th of the plan, from 0.

    Its nodes, its lines, its end and its transcript are those of that program.
    """
    own = _program(run, assignment, plan, start)
    if not plan.start[start].exits:
        return own
    done = own.ended_by_itself and own.status == 0
    early = own.ended_by_itself and not done
    # whether the probe saw the node of a short program is chance
    started = "Traceback (most" not in own.transcript if early else own.started or done
    return replace(own, exits=True, done=done, started=started, ended_by_itself=early)


def _program(run: Run, assignment: Assignment, plan: RunPlan, start: int) -> Run:
    if len(plan.start) == 1 or len(run.others) + 1 != len(plan.start):
        return run
    names = names_of(assignment, plan, [node.name for node in run.nodes])
    own = tuple(node for node in run.nodes if node.name in names[start])
    answers = any(node.answers for node in own)
    programs = [_first(run, plan), *run.others]
    this = programs[start]
    loggers = {name.strip("/").replace("/", ".") for other in names for name in other}
    loggers -= {node.logger for node in own}
    said = "".join(one.transcript for one in programs if one is not this)

    def is_own(event: Event) -> bool:
        if event.record is not None:
            return event.record.name not in loggers
        return event.text in this.transcript or event.text not in said

    watch = replace(
        run.watch,
        settled=answers,
        events=[event for event in run.watch.events if is_own(event)],
        before_start=[event for event in run.watch.before_start if is_own(event)],
    )
    return replace(
        run,
        command=this.command,
        watch=watch,
        nodes=own,
        started=bool(own) and (answers or not this.by_itself),
        ended_by_itself=this.by_itself,
        interrupted=not this.by_itself and not run.flooded,
        stop_seconds=this.stop_seconds,
        status=this.status,
        signal=this.signal,
        transcript=this.transcript,
        flooded=run.flooded and this is max(programs, key=lambda one: len(one.transcript)),
        others=[one for one in programs if one is not this],
    )


def _first(run: Run, plan: RunPlan) -> Program:
    """Return the first program of a run."""
    return Program(
        node=plan.start[0].node,
        command=run.command,
        started=run.started,
        by_itself=run.ended_by_itself,
        stop_seconds=run.stop_seconds,
        status=run.status,
        signal=run.signal,
        transcript=run.transcript,
    )
