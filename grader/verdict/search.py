"""Looks for a small change with which a package passes, where its mistake has no fix.

All small changes of the node's files are run for some milliseconds each. The best of them are then
built and marked as a fix is, and only one that helps is shown.
"""

from __future__ import annotations

import ast
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from itertools import islice, pairwise

from grader.base.i18n.message import Message, joined, say
from grader.base.shown import shown
from grader.change.operator import Wanted
from grader.change.table import Candidate, candidates
from grader.course.assignment import Assignment, Output
from grader.mistakes.catalogue import CATALOGUE
from grader.mistakes.recognised import RecognisedMistake
from grader.package.source.names import module_name, named_in
from grader.package.source.node import NodeSource, read_node
from grader.package.source.place import last_row, statement_of
from grader.report.model import Where
from grader.run.observer import number_reader
from grader.run.variants import ShortRun, Values, Watched, run_variants
from grader.sandbox.base import Sandbox
from grader.verdict.checks.actual_node import actual_path
from grader.verdict.checks.parsed import data_of
from grader.verdict.evidence import Evidence, Search
from grader.verdict.found_change import NEARLY, WHOLE, FoundChange, Step, rank_of

KIND, FIRST = "node.change_helps", "node.one_of_two"
SECONDS = 20.0
"""The most processor time for all changes, and again for two changes together."""
LEAST_SECONDS = 40.0
"""The least wall time that has to be left of the verdict: the best changes are marked afterwards."""
MOST_SECOND = 150
"""The most second changes that are tried with a first one."""
MOST_FIRST = 3
"""The most first changes that are tried with a second one."""
MOST_FOUND = 12
MOST_VALUES = 3
"""The most pieces of code whose values a text shows."""
LEAVES = ast.Return | ast.Raise | ast.Continue | ast.Break | ast.Pass
LEAST_LINES = 6
ENOUGH_LINES = 10
"""The lines, each at another instant, after which a node that is too slow for a short run counts too."""
LONGEST = 90  # characters of a piece of code that a text shows
OF_NUMBERS = ("number", "digits")
"""The sorts of changes that can give another period: they have to give the right one."""
TEXT, STEP = 5, 6
"""How far a node gets that logs the right text, and that has the right step but not the start."""


def search_in(sandbox: Sandbox, until: float) -> Search:
    """Return what looks for changes in a sandbox whose workspace has been built.

    It does not begin if less than `LEAST_SECONDS` are left until then (of the run's clock).
    """

    def search(evidence: Evidence) -> list[FoundChange]:
        if until - sandbox.run_clock.now() < LEAST_SECONDS or evidence.assignment.runs:
            return []
        path = actual_path(evidence)
        read = partial(data_of, evidence)
        source = read_node(read, path, evidence.assignment.function)
        if source is None or source.main is None:
            return []
        return _Search(sandbox, evidence.assignment, source, read).found()

    return search


@dataclass(frozen=True)
class _Tried:
    steps: tuple[Step, ...]
    texts: Mapping[str, str]
    cost: int
    level: int
    ended: str
    last: Candidate | None = None

    @property
    def counts(self) -> bool:
        """Whether the node counts, in the right period if the change could have given another."""
        of_number = bool(self.steps) and self.steps[-1].sort in OF_NUMBERS
        return self.level >= (WHOLE if of_number else NEARLY)

    @property
    def shows(self) -> bool:
        """Whether one of the changes could take away what the program is meant to do."""
        return self.last is not None and self.last.row.shows


class _Search:
    """Runs the changes of one package."""

    def __init__(
        self,
        sandbox: Sandbox,
        assignment: Assignment,
        source: NodeSource,
        read: Callable[[str], bytes | None],
    ) -> None:
        self._sandbox = sandbox
        self._output = assignment.output
        self._function = assignment.function
        self._source = source
        self._read = read
        output = assignment.output
        texts = (*output.text.split("{n}"), assignment.node_name)
        numbers = (output.period, output.start, output.step)
        self._wanted = Wanted(numbers, tuple(filter(None, texts)))

    def found(self) -> list[FoundChange]:
        """Return the changes that help, the smallest first."""
        first = [self._step(change) for change in candidates(self._source, self._wanted)]
        base, *tried = self._run([_Tried((), {}, 0, 0, ""), *first])
        if base.level >= WHOLE:
            return []  # (what is wrong does not show in so short a run)
        good = [one for one in tried if one.level > base.level and one.counts]
        if not good:
            good = self._twice(base, tried)
        if not good and base.level < TEXT:
            good = [one for one in tried if one.level in (TEXT, STEP) and not one.shows]
        good.sort(key=lambda one: rank_of(one.level, one.cost))
        kept = self._without_skipped_blocks(good[:MOST_FOUND])
        return [
            FoundChange(
                one.steps,
                one.texts,
                one.cost,
                one.level,
                seen,
                shows=one.shows,
                certain=one.last is not None and one.last.row.certain,
            )
            for one, seen in zip(kept, self._values(kept))
        ]

    def _without_skipped_blocks(self, found: Sequence[_Tried]) -> list[_Tried]:
        """Return the changes without those after which a block that ran does not run any more.

        They hide what the block does, and it is the block that has the mistake or is too much. A
        change whose watched run was too slow is kept: it counted in a run that was not watched.
        """
        blocks = [block_of(one.last) if one.last is not None else None for one in found]
        asked = [(one, block) for one, block in zip(found, blocks) if block is not None]
        watched = [block for _, block in asked]
        before = self._variants([{}] * len(asked), watched)
        after = self._variants([_by_module(one.texts) for one, _ in asked], watched)
        skipped = [
            one
            for (one, _), old, new in zip(asked, before, after)
            if old is not None
            and new is not None
            and new.ended != "killed"
            and (any(old.values) or old.ended == "killed")
            and not any(new.values)
        ]
        return [one for one in found if one not in skipped]

    def _values(self, found: Sequence[_Tried]) -> list[Values]:
        """Return the values that the code of each change has, without the change."""
        asked = [one.last if len(one.steps) == 1 else None for one in found]
        watched = {n: watched_at(one) for n, one in enumerate(asked) if one is not None}
        values: list[Values] = [()] * len(found)
        for (n, at), run in zip(
            watched.items(), self._variants([{}] * len(watched), [*watched.values()])
        ):
            seen = run.values if run is not None else ()
            values[n] = tuple((code, each) for code, each in zip(at.code, seen) if each)
        return values

    def _twice(self, base: _Tried, tried: Sequence[_Tried]) -> list[_Tried]:
        """Return the pairs of changes that help."""
        further = [one for one in tried if one.level > base.level]
        further += [
            one
            for one in tried
            if one.level == base.level and one.ended != base.ended and one not in further
        ]
        further.sort(key=lambda one: (-one.level, one.cost))
        pairs: list[_Tried] = []
        for one in further[:MOST_FIRST]:
            read = partial(self._changed, one.texts)
            source = read_node(read, self._source.entry.path, self._function)
            if source is not None:
                changes = candidates(source, self._wanted)[:MOST_SECOND]
                pairs += [self._step(change, one) for change in changes]
        return [one for one in self._run(pairs) if one.level >= NEARLY]

    def _changed(self, texts: Mapping[str, str], path: str) -> bytes | None:
        return texts[path].encode() if path in texts else self._read(path)

    def _step(self, found: Candidate, before: _Tried | None = None) -> _Tried:
        steps, texts, cost = (before.steps, before.texts, before.cost) if before else ((), {}, 0)
        made = found.made
        name, written = (one_line(code).removesuffix(":") for code in (made.name, made.written))
        step = Step(found.row.sort, found.path, made.at.lineno, name, written)
        new = {**texts, found.path: found.text}
        return _Tried((*steps, step), new, cost + found.cost, 0, "", found)

    def _run(self, tried: Sequence[_Tried]) -> list[_Tried]:
        """Return the changes that were run, with how far the node gets."""
        texts = [_by_module(one.texts) for one in tried]
        return [
            replace(one, level=level(run, self._output), ended=run.ended)
            for one, run in zip(tried, self._variants(texts))
            if run is not None
        ]

    def _variants(
        self, texts: Sequence[Mapping[str, str]], watched: Sequence[Watched] = ()
    ) -> list[ShortRun | None]:
        if not texts:
            return []
        return run_variants(
            self._sandbox,
            module_name(self._source.entry.path),
            self._function,
            texts,
            period=self._output.period,
            seconds=SECONDS,
            watched=watched,
        )


def _by_module(texts: Mapping[str, str]) -> dict[str, str]:
    return {module_name(path): text for path, text in texts.items()}


def block_of(found: Candidate) -> Watched | None:
    """Return the lines of the loop or condition whose head a change is in; None if there is none.

    A condition that only leaves the function or the loop is none.
    """
    at = found.made.at
    for inner, outer in pairwise((at, *found.module.around(at))):
        heads = (getattr(outer, "test", None), getattr(outer, "iter", None))
        if isinstance(outer, ast.While | ast.For | ast.If) and inner in heads:
            block = outer.body
            if isinstance(outer, ast.If) and all(isinstance(s, LEAVES) for s in block):
                return None
            last = block[-1].end_lineno or block[0].lineno
            return Watched(found.path, block[0].lineno, last, ("True",))
        if isinstance(outer, ast.stmt):
            return None
    return None


def watched_at(found: Candidate) -> Watched:
    """Return the code whose values show what a change does: names in it, itself, and the new code."""
    module, made = found.module, found.made
    at = made.at
    statement = statement_of(module, at)
    names = [module.text.code(n) for n in named_in(at)] if isinstance(at, ast.expr) else []
    code = [c for c in (*names, made.name, made.written) if not _is_literal(c)]
    return Watched(found.path, statement.lineno, last_row(statement), tuple(dict.fromkeys(code)))


def _is_literal(code: str) -> bool:
    try:
        ast.literal_eval(code)
    except (ValueError, SyntaxError):
        return False
    return True


def level(run: ShortRun, output: Output) -> int:
    """Return how far a node gets: 0 if it ends before it waits, up to `WHOLE`."""
    slow = run.ended == "killed" and len({at for at, _, _ in run.lines}) >= ENOUGH_LINES
    if not run.lives and run.ended != "waits" and not slow:
        return 1 if run.steps else 0
    number = number_reader(output)
    counted = [(at, n) for at, _, text in run.lines if (n := number(text)) is not None]
    if len(counted) < LEAST_LINES:
        return 3 if run.lines else 2
    numbers = [n for _, n in counted]
    if numbers != [output.start + k * output.step for k in range(len(counted))]:
        steps = {later - earlier for earlier, later in zip(numbers, numbers[1:])}
        return STEP if steps == {output.step} else TEXT
    instants = [at for at, _ in counted]
    if len({*instants}) < len(instants):
        return STEP
    apart = {later - earlier for earlier, later in zip([0, *instants], instants)}
    return WHOLE if apart == {round(output.period * 1e9)} and not run.slept else NEARLY


def recognised(change: FoundChange) -> RecognisedMistake:
    """Return a change as a mistake of the catalogue, at its first step."""
    step = change.steps[0]
    return RecognisedMistake(
        kind=KIND if change.counts else FIRST,
        params={"name": step.name, "written": step.written},
        variant="several" if len(change.steps) > 1 and change.counts else _variant(step),
        where=Where(file=step.path, line=step.line),
    )


def fix_text(change: FoundChange, where: Where | None) -> Message | str:
    """Return what to do, for one change or two; lines are named unless the place is shown."""
    texts: list[Message | str] = []
    for step in change.steps:
        values = {"name": step.name, "written": step.written}
        kind = CATALOGUE[KIND if change.counts else FIRST]
        text = kind.fix_text(values, _variant(step))
        here = where is not None and where.line == step.line and len(change.steps) == 1
        texts.append(text if here else say("Line {line}: {fix}", line=step.line, fix=text))
    return joined(*texts, by=" ")


def value_texts(change: FoundChange) -> list[Message]:
    """Return what the code of a change was when the grader ran the node without the change."""
    step, *more = change.steps
    if more or change.shows or change.certain:
        return []
    known = dict(change.values)
    if known.get(step.name) == known.get(step.written, ()):
        return []
    texts = []
    for code, values in islice(known.items(), MOST_VALUES):
        given = {"name": one_line(code), "values": shown(", ".join(values))}
        if code == step.written:
            texts.append(say("{name} has the value {values} there.", **given))
        else:
            texts += values_seen([(code, values)])
    return texts


def values_seen(found: Iterable[tuple[str, Sequence[str]]]) -> list[Message]:
    """Return what pieces of code were in a line when the grader ran the node."""
    texts = []
    for code, values in found:
        given = {"name": one_line(code), "values": shown(", ".join(values))}
        if len(values) == 1:
            texts.append(
                say("When the grader ran the node, {name} was {values} in this line.", **given)
            )
        elif values:
            texts.append(
                say(
                    "When the grader ran the node, {name} was {values} in this line, one after the "
                    "other.",
                    **given,
                )
            )
    return texts


def _variant(step: Step) -> str:
    long = max(len(step.name), len(step.written)) > LONGEST
    return "long" if long else step.sort


def one_line(code: str) -> str:
    """Return code in one line, as a text shows it."""
    return shown(" ".join(code.split()))
