"""Where a node that logs nothing stops on its way to the line that logs, as a traced run shows it.

The way is followed backwards: from the line to what holds it, to the calls of its function, and to
the timer that should call that.
"""

from __future__ import annotations

import ast
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from grader.base.i18n.message import Message, joined, say
from grader.mistakes.placeholders import placeholder_values
from grader.mistakes.recognised import RecognisedMistake
from grader.package.source.module import Function, Module, is_text
from grader.package.source.names import calls_in, dotted, last_part, module_name, named_in
from grader.package.source.node import NodeSource
from grader.package.source.place import last_row, statement_at, statement_of
from grader.report.model import Where
from grader.run.variants import Place, Trace, Values, Watched, trace_node
from grader.sandbox.base import Sandbox
from grader.verdict.evidence import Evidence
from grader.verdict.node_files import source_of_node
from grader.verdict.search import one_line

NOT_REACHED, TIMERS = "node.not_reached", "node.several_timers"
SECONDS = 5.0
"""The most processor time of the followed run."""
MOST_TIMERS = 4
"""The most timers that a text names."""
MOST_CALLS = 6
"""The most calls that are followed backwards."""
SILENT = ("run.no_lines",)
SEVERAL = ("run.twice", "run.wrong_period")
"""The symptoms for which a followed run may show the reason."""
LEAVES = ast.Return | ast.Raise | ast.Continue | ast.Break
BLOCKS = ("body", "orelse", "finalbody")
LONGEST_CODE = 4  # pieces of code of one condition whose values are asked for


@dataclass(frozen=True)
class Stop:
    """The place where the way to a line ends: `sort` says how, `log` is the line.

    Sorts: "never_true" and "always_true" of a condition, "empty" of a loop, "leaves" of what leaves the
    function or the round, "waits" of what does not come back, "not_called" of a function, "not_spun" and
    "stopped" of a timer. `name` is the code or the function that the text names.
    """

    sort: str
    at: ast.stmt
    log: ast.stmt
    name: str = ""
    place: Place | None = None
    values: Values = ()


def trace_in(sandbox: Sandbox, until: float, evidence: Evidence) -> Trace | None:
    """Follow a node in a sandbox whose workspace has been built; None if too little time is left.

    `until` is of the run's clock.
    """
    source = source_of_node(evidence)
    if source is None or source.main is None or until - sandbox.run_clock.now() < SECONDS:
        return None
    return trace_node(
        sandbox,
        module_name(source.entry.path),
        evidence.assignment.function,
        [module.path for module in source.known_modules],
        period=evidence.assignment.output.period,
        seconds=SECONDS,
        conditions=conditions_of(source),
    )


def followed(evidence: Evidence, seen: str) -> tuple[RecognisedMistake, Values] | None:
    """Return what a followed run shows of a symptom (`seen`), and values at its place; None if nothing."""
    if seen not in (*SILENT, *SEVERAL) or evidence.assignment.runs:
        return None
    trace, source = evidence.trace, source_of_node(evidence)
    if trace is None or source is None:
        return None
    if seen in SEVERAL:
        found = _several_timers(source, trace, evidence)
        return (found, ()) if found is not None else None
    return _not_reached(source, trace, evidence)


def _not_reached(
    source: NodeSource, trace: Trace, evidence: Evidence
) -> tuple[RecognisedMistake, Values] | None:
    logs = [
        call
        for module in source.known_modules
        for call, _ in calls_in(module.tree)
        if source.is_own_log(call) or source.is_log(call)
    ]
    text = evidence.assignment.output.text.partition("{n}")[0].strip()
    wanted = [call for call in logs if text and text in ast.unparse(call)]
    stops = [stop_of(source, trace, call) for call in wanted or logs]
    stop = stops[0] if stops else None
    if stop is None or any(other is None or other.at is not stop.at for other in stops):
        return None
    module = source.module_of(stop.at)
    log = _line((source.module_of(stop.log).path, stop.log.lineno), module.path)
    place = _line(stop.place, module.path) if stop.place is not None else ""
    name = stop.name
    found = RecognisedMistake(
        kind=NOT_REACHED,
        params={"name": name},
        words={
            **placeholder_values(evidence.assignment, source),
            "name": name,
            "log": log,
            "place": place,
        },
        variant="" if stop.sort == "never_true" else stop.sort,
        where=Where(file=module.path, line=stop.at.lineno),
    )
    return found, tuple((code, _once(values)) for code, values in stop.values)


def _once(values: Sequence[str]) -> tuple[str, ...]:
    """Return values, one if all are the same."""
    return tuple(values[:1] if len({*values}) == 1 else values)


def _several_timers(
    source: NodeSource, trace: Trace, evidence: Evidence
) -> RecognisedMistake | None:
    by_place: dict[Place, set[int]] = {}
    for places, timer in trace.logged:
        if places and timer >= 0:
            by_place.setdefault(places[0], set()).add(timer)
    numbers = max(by_place.values(), key=len, default=set())
    made = [trace.timers[n].made for n in sorted(numbers) if n < len(trace.timers)]
    if not 1 < len(made) <= MOST_TIMERS or len({*made}) < len(made) or not all(made):
        return None
    path, line = made[-1][0]
    shown = joined(*(_made_in(each, path) for each in made), by="; ")
    return RecognisedMistake(
        kind=TIMERS,
        params={"count": len(made)},
        words={
            **placeholder_values(evidence.assignment, source),
            "count": len(made),
            "places": shown,
        },
        where=Where(file=path, line=line),
    )


def _made_in(made: Sequence[Place], path: str) -> Message:
    """Return the line that makes a timer, with that of the call of its function."""
    if len(made) == 1:
        return _line(made[0], path)
    return say(
        "{place} (called from {caller})", place=_line(made[0], path), caller=_line(made[1], path)
    )


def _line(place: Place, path: str) -> Message:
    """Return a place as a text of a report that shows a place of the file `path`."""
    if place[0] == path:
        return say("line {line}", line=place[1])
    return say("line {line} of {file}", line=place[1], file=place[0])


def conditions_of(source: NodeSource) -> list[Watched]:
    """Return the conditions of the files whose values tell why a block does not run."""
    found = []
    for module in source.known_modules:
        for part in module.nodes:
            if isinstance(part, ast.If | ast.While):
                called = {call.func for call, _ in calls_in(part.test)}
                pieces = [n for n in named_in(part.test) if n not in called]
                code = dict.fromkeys(map(module.text.code, pieces))
                last = part.test.end_lineno or part.lineno
                found.append(Watched(module.path, part.lineno, last, tuple(code)[:LONGEST_CODE]))
    return found


def stop_of(source: NodeSource, trace: Trace, log: ast.Call) -> Stop | None:
    """Return where the way to a call of the logger ends; None if it ran, or if this is not clear."""
    return _Way(source, trace, log).stop()


class _Way:
    def __init__(self, source: NodeSource, trace: Trace, log: ast.Call) -> None:
        self._source = source
        self._trace = trace
        self._log = self._statement(log)
        self._calls = 0

    def stop(self) -> Stop | None:
        return self._reach(self._log)

    def _statement(self, part: ast.AST) -> ast.stmt:
        return statement_of(self._source.module_of(part), part)

    def _count(self, statement: ast.stmt) -> int:
        """Return how often a statement ran; of a block, its head."""
        if isinstance(statement, ast.Try):
            return max(map(self._count, statement.body))
        path, rows = (
            self._source.module_of(statement).path,
            range(statement.lineno, last_row(statement) + 1),
        )
        return max(self._trace.count(path, row) for row in rows)

    def _found(
        self,
        sort: str,
        at: ast.stmt,
        name: str = "",
        *,
        place: Place | None = None,
        values: Values = (),
    ) -> Stop:
        return Stop(sort, at, self._log, name, place, values)

    def _reach(self, statement: ast.stmt) -> Stop | None:
        """Return where the way to a statement ends that did not run."""
        if self._count(statement):
            return None
        module = self._source.module_of(statement)
        child = statement
        for around in module.around(statement):
            if isinstance(around, Function):
                code = [s for s in around.body if not is_text(s)]
                ran = any(map(self._count, code))
                return self._in_block(code, child) if ran else self._not_entered(module, around)
            if isinstance(around, ast.Lambda | ast.ClassDef | ast.Module):
                return None
            if not isinstance(around, ast.stmt):
                continue  # (the cases of a match, the handlers of a try)
            if self._count(around):
                return self._in_statement(module, around, child)
            child = around
        return None

    def _in_statement(self, module: Module, around: ast.stmt, child: ast.stmt) -> Stop | None:
        """The same, of a statement in a block whose head ran."""
        name = next((b for b in BLOCKS if child in getattr(around, b, ())), "")
        block: list[ast.stmt] = getattr(around, name) if name else []
        if any(self._count(s) for s in block[: block.index(child) if block else 0]):
            return self._in_block(block, child)
        if isinstance(around, ast.If | ast.While) and name in ("body", "orelse"):
            place = (module.path, around.lineno)
            return self._found(
                "never_true" if name == "body" else "always_true",
                around,
                name=one_line(module.text.code(around.test)),
                values=dict(self._trace.values).get(place, ()),
            )
        if isinstance(around, ast.For) and name == "body":
            return self._found("empty", around, name=one_line(module.text.code(around.iter)))
        return None

    def _in_block(self, block: list[ast.stmt], child: ast.stmt) -> Stop | None:
        """The same, of a statement in a block of which an earlier statement ran."""
        before = [s for s in block[: block.index(child)] if self._count(s)]
        if not before:
            return None
        if self._waits_in(before[-1]):
            return self._found("waits", before[-1])
        leaving = [s for s in _leaving(before[-1]) if self._count(s)]
        rounds = max(map(self._count, block))
        if len(leaving) != 1 or self._count(leaving[0]) < rounds:
            return None
        return self._found("leaves", leaving[0])

    def _waits_in(self, statement: ast.stmt) -> bool:
        """Whether a thread was in a statement that is no block when the run ended."""
        path = self._source.module_of(statement).path
        last = statement.end_lineno or statement.lineno
        stand = [places[0] for places in self._trace.stand]
        plain = not getattr(statement, "body", None)
        return plain and any(_is_in(place, path, statement.lineno, last) for place in stand)

    def _not_entered(self, module: Module, function: Function) -> Stop | None:
        """The same, of a function of which no line ran."""
        self._calls += 1
        name = function.name
        if self._calls > MOST_CALLS or name.startswith("__") or function.decorator_list:
            return None
        uses = [
            use
            for use in self._uses(name)
            if function not in self._source.module_of(use).around(use)
        ]
        if not uses:
            classes = [c for c in module.around(function) if isinstance(c, ast.ClassDef)]
            plain = [
                b
                for c in classes
                for b in c.bases
                if last_part(dotted(b)) not in ("Node", "object")
            ]
            return None if plain else self._found("not_called", function, name=name)
        stops = [
            self._timer(statement, name) if self._count(statement) else self._reach(statement)
            for statement in map(self._statement, uses)
        ]
        first = stops[0]
        return first if first is not None and all(stop == first for stop in stops) else None

    def _uses(self, name: str) -> list[ast.AST]:
        return [
            n
            for module in self._source.known_modules
            for n in module.nodes
            if isinstance(n, ast.Name | ast.Attribute)
            and isinstance(n.ctx, ast.Load)
            and last_part(dotted(n)) == name
        ]

    def _timer(self, statement: ast.stmt, name: str) -> Stop | None:
        """The same, of a function that a timer should call: the statement made it, or called what did."""
        path = self._source.module_of(statement).path
        last = statement.end_lineno or statement.lineno
        here = [
            timer
            for timer in self._trace.timers
            if any(_is_in(place, path, statement.lineno, last) for place in timer.made)
        ]
        if len(here) != 1 or here[0].calls:
            return None
        made_in, line = here[0].made[0]
        at = statement_at(self._source.module_at(made_in), line) or statement
        if here[0].stopped:
            return self._found("stopped", at, name=name, place=here[0].stopped[0])
        return None if here[0].spun else self._found("not_spun", at, name=name)


def _is_in(place: Place, path: str, first: int, last: int) -> bool:
    return place[0] == path and first <= place[1] <= last


def _leaving(statement: ast.stmt) -> Iterator[ast.stmt]:
    """Yield the statements in a statement that leave it, without those of functions in it."""
    if isinstance(statement, LEAVES):
        yield statement
    if isinstance(statement, Function | ast.ClassDef):
        return
    for part in ast.iter_child_nodes(statement):
        if isinstance(part, ast.stmt):
            yield from _leaving(part)
        elif isinstance(part, ast.ExceptHandler | ast.match_case):
            for inner in part.body:
                yield from _leaving(inner)
