"""Looks for the smallest change with which a failed check of a run passes.

The goal is the check itself: each change runs through the check's scenario in a short run
(grader/run/scenes.py), and the checks judge what it did. Facts of one followed run say which places
come first.
"""

from __future__ import annotations

import copy
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from functools import partial
from typing import Any

from grader.change.operator import Wanted
from grader.change.table import Candidate, candidates
from grader.course.assignment import Assignment, CheckUse
from grader.explain.facts import Facts
from grader.package.source.node import NodeSource, read_node
from grader.report.model import CheckResult
from grader.run.observations import OURS
from grader.run.run import Run
from grader.run.scenes import STUCK, Scene, SceneRun, run_scenes
from grader.run.variants import Watched
from grader.sandbox.base import Sandbox
from grader.verdict.checks.actual_node import actual_path
from grader.verdict.checks.all import CHECKS
from grader.verdict.checks.declare import STARTED
from grader.verdict.checks.parsed import data_of
from grader.verdict.evidence import Evidence
from grader.verdict.follow import conditions_of, fact_of
from grader.verdict.found_change import FoundChange, Sought, Step
from grader.verdict.of_node import NodeEvidence, views
from grader.verdict.outcome import Failed, Passed

LIVES = (*STARTED, "run.stays")
"""Checks without parameters that a short run decides too."""
SECONDS = 8.0
"""The most processor time for the changes of one check."""
MOST_SECONDS = 16.0
"""The same, of all checks of a package."""
FOLLOWED_SECONDS = 10.0
LEAST_SECONDS = 60.0
"""The least time of the verdict that has to be left: the best changes are built and run afterwards."""
MOST_RUNS = 80
BATCHES = (20, 60)
"""How many changes are run together: the best ones first."""
MOST_FOUND = 3
ALIKE = 5
"""After how many changes of one operator the next one costs one more."""
FAR = 3
"""What a change costs more at a place that has nothing to do with what failed."""


class Seeker:
    """Looks for changes of one package, in a sandbox whose workspace has been built.

    `left` is the processor time (s) that is left for all its checks. It does not begin if less than
    `LEAST_SECONDS` are left until the time `until` of the run's clock.
    """

    def __init__(self, sandbox: Sandbox, until: float) -> None:
        self._sandbox, self._until = sandbox, until
        self._followed: dict[tuple[str, str, int], SceneRun | None] = {}
        self.left = MOST_SECONDS

    def __call__(self, evidence: Evidence, result: CheckResult) -> Sought:
        """Return what is found for a failed check."""
        if self._until - self._sandbox.run_clock.now() < LEAST_SECONDS:
            return Sought()
        search = _Search.of(self, evidence, result)
        return search.found(result) if search is not None else Sought()

    def follow(self, scene: Scene, source: NodeSource) -> SceneRun | None:
        """Return the followed run of a node as it is; it is made once."""
        key = (scene.plan.name, scene.assignment.node_file, scene.start)
        if key not in self._followed:
            files = [module.path for module in source.known_modules]
            conditions = conditions_of(source)
            for checked in (False, True):
                (run,) = self.run(
                    scene,
                    [{}],
                    FOLLOWED_SECONDS,
                    traced=files,
                    conditions=conditions,
                    checked=checked,
                )
                if run is None or run.ended != "killed":
                    break
            self._followed[key] = replace(run, checked=checked) if run is not None else None
        return self._followed[key]

    def run(
        self,
        scene: Scene,
        variants: Sequence[Mapping[str, str]],
        seconds: float,
        *,
        traced: Sequence[str] = (),
        conditions: Sequence[Watched] = (),
        checked: bool = False,
    ) -> list[SceneRun | None]:
        """Run variants of a scene; what they take is no longer left."""
        seconds = min(seconds, self.left)
        if seconds <= 0 or not variants:
            return [None] * len(variants)
        runs = run_scenes(
            self._sandbox,
            scene,
            variants,
            seconds=seconds,
            traced=traced,
            conditions=conditions,
            checked=checked,
        )
        self.left -= sum(run.used for run in runs if run is not None)
        return runs


class _Search:
    """The search for one check."""

    def __init__(
        self, seeker: Seeker, view: NodeEvidence, whole: Evidence, use: CheckUse, source: NodeSource
    ) -> None:
        self._seeker, self._view, self._whole, self._use = seeker, view, whole, use
        self._source = source
        self._plan = view.assignment.plan(view.run_name)
        self._scene = Scene(view.assignment, self._plan, view.start, _heard(view))
        self._judge = Judge(whole, view)
        self._checked = False  # (whether each field is: one of another type has ended the process)

    @classmethod
    def of(cls, seeker: Seeker, evidence: Evidence, result: CheckResult) -> _Search | None:
        """Return the search for a failed check; None if short runs cannot show it."""
        use = next((use for use in evidence.assignment.checks if use.id == result.id), None)
        check = CHECKS.get(use.kind) if use is not None else None
        if use is None or check is None or not (check.is_of_run or use.kind in LIVES):
            return None
        about = views(evidence, check, use)
        mine = [v for v in about if v.node == result.node and v.run_name == result.run] or about[:1]
        if not mine or not can_be_played(mine[0]):
            return None
        view = mine[0]
        source = read_node(partial(data_of, view), actual_path(view), view.assignment.function)
        if source is None or source.main is None:
            return None
        return cls(seeker, view, evidence, use, source)

    def found(self, result: CheckResult) -> Sought:
        """Follow the node, and look for changes."""
        base = self._seeker.follow(self._scene, self._source)
        if base is None or base.trace is None:
            return Sought()
        statuses = self._judge.statuses({self._plan.name: base.run})
        status = statuses.get(self._use.id)
        if status != "failed" and not (status == "skipped" and base.ended in STUCK):
            return self._certain()  # (what is wrong does not show in a short run)
        facts = Facts(self._source, base.trace, base.run, self._use)
        seen = result.mistakes[-1] if result.mistakes else None
        facts.field = str(seen.params.get("field", "")) if seen is not None else ""
        facts.wanted = result.expected.partition(": ")[2]
        facts.came = result.actual.partition("\n")[0].partition(": ")[2].partition(",")[0]
        self._checked = base.checked
        good, runs = self._that_help(self._candidates(facts), statuses)
        fact = fact_of(facts, seen.id) if seen is not None else None
        at = (fact.path, fact.line) if fact is not None else ("", 0)
        good.sort(
            key=lambda pair: (
                *(pair[1].row.shows, pair[0]),
                pair[1].cost - ((pair[1].path, pair[1].made.at.lineno) == at),
            )
        )
        best = _copies_first([one for left, one in good if left == good[0][0]])
        kept = self._with_other_values(best[: 2 * MOST_FOUND])
        return Sought(fact, tuple(map(_found, kept[:MOST_FOUND])), runs)

    def _certain(self) -> Sought:
        """Return changes that need no short run, such as another type: they are built and run later."""
        found = candidates(self._source, wanted_of(self._use, self._whole.asked))
        kept = [one for one in found if one.row.untried]
        return Sought(changes=tuple(map(_found, kept[:MOST_FOUND])))

    def _that_help(
        self, made: Sequence[Candidate], statuses: Mapping[str, str]
    ) -> tuple[list[tuple[int, Candidate]], int]:
        """Return the changes with which the check passes, with the failures that are left; and the runs."""
        good: list[tuple[int, Candidate]] = []
        count = 0
        for batch in _batches(made[:MOST_RUNS]):
            texts = [{one.path: one.text} for one in batch]
            runs = self._seeker.run(self._scene, texts, SECONDS, checked=self._checked)
            for one, run in zip(batch, runs):
                count += run is not None
                now = self._judge.statuses({self._plan.name: run.run}) if run is not None else {}
                if now and self._is_better(statuses, now):
                    left = sum(status == "failed" for status in now.values())
                    may_hide = one.row.hides or (self._use.kind in LIVES and not one.row.certain)
                    by_chance = may_hide and _new_failures(statuses, now)
                    good += [] if by_chance else [(left, one)]
            if any(not left and not one.row.shows for left, one in good):
                break
        return good, count

    def _is_better(self, before: Mapping[str, str], now: Mapping[str, str]) -> bool:
        """Whether the check passes, and no other one that passed fails."""
        worse = any(now[one] == "failed" for one, was in before.items() if was == "passed")
        return now.get(self._use.id) == "passed" and not worse

    def _candidates(self, facts: Facts) -> list[Candidate]:
        found = candidates(self._source, wanted_of(self._use, self._whole.asked))
        for at, one in enumerate(found):
            near = facts.distance(one.path, one.made.at.lineno, one.made.at.end_lineno)
            found[at] = replace(one, cost=one.cost + min(near, FAR))
        return _mixed(found)

    def _with_other_values(self, good: list[Candidate]) -> list[Candidate]:
        """Return the changes that help with other drawn values too: the rest fits these by chance."""
        other = other_drawn(self._view.assignment)
        if other is None or not good:
            return good
        scene = Scene(other, other.plan(self._plan.name), self._view.start, self._scene.heard)
        texts = [{one.path: one.text} for one in good]
        runs = self._seeker.run(scene, texts, SECONDS, checked=self._checked)
        judge = Judge(self._whole, self._view, other)
        kept = []
        for one, run in zip(good, runs):
            now = judge.statuses({self._plan.name: run.run}) if run is not None else {}
            if run is None or now.get(self._use.id) == "passed":
                kept.append(one)
        return kept


def _mixed(found: list[Candidate]) -> list[Candidate]:
    """Return the changes with the cheapest first, and those of one operator not all in a row.

    A program with many numbers has dozens of changes of numbers, and the time is for some dozens.
    """
    seen: Counter[str] = Counter()
    ranked = []
    for n, one in enumerate(sorted(found, key=lambda one: one.cost)):
        ranked.append((one.cost + seen[one.row.sort] / ALIKE, n, one))
        seen[one.row.sort] += 1
    return [one for _, _, one in sorted(ranked, key=lambda each: each[:2])]


def _copies_first(good: list[Candidate]) -> list[Candidate]:
    """Return the changes with the last of those first that are the best one in another line.

    Of two lines that are alike, the later one is the copy that was not adapted.
    """
    alike = [
        one
        for one in good
        if (one.row, one.made.name, one.made.written, one.cost)
        == (good[0].row, good[0].made.name, good[0].made.written, good[0].cost)
    ]
    return [alike[-1], *(one for one in good if one is not alike[-1])] if alike else good


def _new_failures(before: Mapping[str, str], now: Mapping[str, str]) -> int:
    """Return how many checks fail that did not fail before: those that were skipped count too."""
    return sum(now[one] == "failed" and was != "failed" for one, was in before.items())


def _batches(made: Sequence[Candidate]) -> Iterator[Sequence[Candidate]]:
    """Yield the changes in groups: if one of the first helps, the others are not run."""
    first = 0
    for size in BATCHES:
        if made[first:]:
            yield made[first : first + size]
        first += size


class Judge:
    """What the checks that runs decide say about short runs of one node."""

    def __init__(
        self, whole: Evidence, view: NodeEvidence, assignment: Assignment | None = None
    ) -> None:
        self._whole, self._node, self._run = whole, view.node, view.run_name
        self._assignment = assignment

    def statuses(self, runs: Mapping[str, Run]) -> dict[str, str]:
        """Return the status of each check of these runs and this node."""
        evidence = copy.copy(self._whole)
        if self._assignment is not None:
            evidence.assignment = evidence.asked = self._assignment
        evidence._runs = {**self._whole._runs, **runs}
        evidence.results, evidence.parts = {}, {}
        for use in self._whole.assignment.checks:
            known = self._whole.results.get(use.id)
            if known is not None and not _is_decided(use) and known.status == "passed":
                evidence.results[use.id] = known
        found: dict[str, str] = {}
        for use, view in self._uses(evidence):
            status, mistake, field_ = _judged(use, view)
            found[use.id] = status
            evidence.results[use.id] = CheckResult(
                id=use.id,
                title="",
                status=status,  # type: ignore[arg-type]
                score=0,
                max_score=0,
                visibility="visible",
                mistakes=[{"id": mistake, "params": field_}] if mistake else [],  # type: ignore[list-item]
            )
        return found

    def _uses(self, evidence: Evidence) -> Iterator[tuple[CheckUse, NodeEvidence]]:
        order = {kind: n for n, kind in enumerate(CHECKS)}
        uses = [use for use in evidence.assignment.checks if _is_decided(use)]
        for use in sorted(uses, key=lambda one: order[one.kind]):
            for view in views(evidence, CHECKS[use.kind], use):
                if view.node == self._node and view.run_name == self._run:
                    yield use, view


def _is_decided(use: CheckUse) -> bool:
    """Whether a short run decides a use of a check."""
    check = CHECKS.get(use.kind)
    return check is not None and (check.is_of_run or use.kind in LIVES)


def _judged(use: CheckUse, view: NodeEvidence) -> tuple[str, str, dict[str, Any]]:
    """Return the status of a use, its mistake and that one's parameters."""
    for needed in CHECKS[use.kind].depends:
        known = [r for one, r in view.results.items() if one == needed]
        if any(result.status not in ("passed", "error") for result in known):
            return "skipped", "", {}
    try:
        outcome = CHECKS[use.kind].evaluate(view, use)
    except Exception:  # (a hostile run: what cannot be judged has not passed)
        return "error", "", {}
    if isinstance(outcome, Passed):
        return "passed", "", {}
    if isinstance(outcome, Failed):
        return "failed", outcome.mistake.id, dict(outcome.mistake.params)
    return "skipped", "", {}


def can_be_played(view: NodeEvidence) -> bool:
    """Whether a short run can go through the scenario of a node."""
    plan = view.assignment.plan(view.run_name)
    acts = any(one.goal is not None or one.cancel is not None for one in plan.do)
    node = view.assignment.nodes.get(view.node)
    is_main = view.assignment.package == view.whole.assignment.package
    return not acts and node is not None and is_main and not plan.start[view.start].exits


def _heard(view: NodeEvidence) -> tuple[tuple[str, str, float, Any], ...]:
    """Return what others of the submission sent in the real run on topics that the node hears."""
    seen = view.run.seen
    if seen is None or len(view.assignment.plan(view.run_name).start) < 2:
        return ()
    own = {node.name for node in view.run.nodes}
    heard = {end.name for end in seen.ends if end.role == "subscription" and end.node in own}
    types = {end.name: end.type for end in seen.ends if end.role == "publisher"}
    return tuple(
        (one.topic, types[one.topic], one.at, one.values)
        for one in seen.messages
        if one.topic in heard and one.topic in types and one.sender not in (*own, OURS, "")
    )


def other_drawn(assignment: Assignment) -> Assignment | None:
    """Return an assignment with other drawn values; None if it draws none."""
    if not assignment.draw:
        return None
    now = assignment.drawn or {}
    values = {
        name: next((v for v in reversed(draw.values) if v != now.get(name)), draw.values[0])
        for name, draw in assignment.draw.items()
    }
    return assignment.with_drawn(values)


def wanted_of(use: CheckUse, assignment: Assignment) -> Wanted:
    """Return what a check asks for in plain values: none that is drawn, since no program may have it."""
    other = other_drawn(assignment)
    uses = [use]
    if other is not None:
        uses += [one for one in other.checks if one.id == use.id]
    kept = [_wanted(one.with_) for one in uses]
    first = kept[0]
    numbers = [n for n in first.numbers if all(n in one.numbers for one in kept)]
    return Wanted(
        (*numbers, *_periods(use, assignment)),
        tuple(dict.fromkeys(first.texts)),
        tuple(f for f in first.fields if all(f in one.fields for one in kept)),
        first.types,
        first.paths,
    )


def _periods(use: CheckUse, assignment: Assignment) -> list[float]:
    """Return the periods (s) that any check asks for on the same topic."""
    topic = use.with_.get("topic")
    alike = [one.with_ for one in assignment.checks if topic and one.with_.get("topic") == topic]
    found = [with_.get("period") for with_ in alike]
    return [float(one) for one in found if isinstance(one, int | float)]


def _wanted(given: Mapping[str, Any]) -> Wanted:
    numbers: list[float] = []
    texts: list[str] = []
    fields: list[tuple[str, object]] = []

    def take(value: Any) -> None:
        if isinstance(value, bool):
            return
        if isinstance(value, int | float):
            numbers.append(value)
        elif isinstance(value, str):
            texts.append(value.strip("^$") if value.startswith("^") else value)
        elif isinstance(value, Mapping):
            for key in ("equal", "about", "contains", "matches"):
                take(value.get(key))
            for bound in value.get("between", ()):
                take(bound)

    for key, value in given.items():
        if key == "each" and isinstance(value, Mapping):
            for path, form in value.items():
                take(form)
                plain = form.get("about", form.get("equal")) if isinstance(form, Mapping) else form
                if isinstance(plain, bool | int | float | str):
                    fields.append((str(path), plain))
        elif key not in ("type", "within", "at_least", "at_most", "apart", "covers"):
            take(value)
    types = (str(given["type"]),) if "type" in given else ()
    paths = tuple(map(str, given.get("each", ())))
    return Wanted(tuple(numbers), tuple(texts), tuple(fields), types, paths)


def _found(one: Candidate) -> FoundChange:
    step = Step(
        one.row.sort, one.path, one.made.at.lineno, _flat(one.made.name), _flat(one.made.written)
    )
    return FoundChange(
        (step,), {one.path: one.text}, one.cost, shows=one.row.shows, certain=one.row.certain
    )


def _flat(code: str) -> str:
    return " ".join(code.split())
