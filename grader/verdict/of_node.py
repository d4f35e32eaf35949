"""The evidence about one node of an assignment, as if the node were its only one.

A check that covers several nodes is a function of the evidence about one: it is evaluated for each
of them, and for each run that starts the node if it judges runs.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from functools import cached_property

from grader.course.assignment import Assignment, CheckUse
from grader.package.submission import Package, Submission
from grader.report.model import CheckResult, Where
from grader.run.names_of_ros import TOPICS
from grader.run.programs import of_program
from grader.run.run import Run
from grader.run.workspace import Build
from grader.verdict.checks.declare import INTAKE, STARTED, Check
from grader.verdict.evidence import Evidence

BESIDE = "package.beside"


class NodeEvidence(Evidence):
    """The evidence about one node (its key in the assignment) in one run ("": none in particular).

    `start` is which of the run's programs is the node's, from 0. `assignment` has the node's names,
    `submission` the package that it is in, `run` the run as its program showed it, and `results`
    what the checks found about this node.
    """

    def __init__(self, whole: Evidence, node: str, run: str, start: int) -> None:
        shared = {
            key: value for key, value in vars(whole).items() if key not in ("build", "results")
        }
        vars(self).update(shared)
        self.whole, self.node, self.run_name, self.start = whole, node, run, start
        self.assignment, self.asked = whole.assignment.about(node), whole.asked.about(node)
        self._main = whole.assignment.package
        self.submission = _submission(whole.submission, self._main, self.assignment)

    @property
    def build(self) -> Build:
        """The build; made on first access."""
        return self.whole.build

    @property
    def was_built(self) -> bool:
        """Whether the build was made."""
        return self.whole.was_built

    @property
    def named(self) -> Assignment:
        """The assignment with the names of the built package, about this node."""
        return self.whole.named.about(self.node)

    @cached_property
    def run(self) -> Run:
        """The run as the node's program showed it; made on first access."""
        name, start = self.run_name, self.start
        if not name:
            name, start = _first_start(self.whole, self.node)
        plan = self.assignment.plan(name)
        return of_program(self.run_of(name), self.assignment, plan, start)

    @property
    def has_run(self) -> bool:
        """Whether the run was made."""
        return self.assignment.plan(self.run_name).name in self._runs

    @property
    def results(self) -> dict[str, CheckResult]:  # type: ignore[override]
        """The results so far: of a check that covers several nodes, what it found about this one.

        They are by id and, after that, by kind.
        """
        found = {check: self.about(result) for check, result in self.whole.results.items()}
        for use in self.assignment.checks:
            if use.id in self.whole.parts and found.get(use.id) is not None:
                found.setdefault(use.kind, found[use.id])
        return {check: result for check, result in found.items() if result is not None}

    @property
    def lacking(self) -> str:
        """The check that says that the node's package is not there; "" if none does."""
        package = self.assignment.package
        if package == self._main:
            return ""
        there = [use for use in self.assignment.checks if use.with_.get("package") == package]
        failed = (use.id for use in there if use.kind == BESIDE and self.has_failed(use.id))
        return next(failed, "")

    def about(self, result: CheckResult) -> CheckResult | None:
        """Return what a result says about this node in this run; None if that is nothing."""
        parts = self.whole.parts.get(result.id)
        if parts is None:
            return result
        mine = [part for part in parts if part.node == self.node]
        mine = [part for part in mine if not self.run_name or part.run in ("", self.run_name)]
        return next((part for part in mine if part.status != "passed"), mine[0] if mine else None)

    def place(self, where: Where | None) -> Where | None:
        """Return a place in the node's package as the report has it."""
        if where is None or self.assignment.package == self._main:
            return where
        name, _, rest = where.file.partition("/")
        if name == self._main and self.submission.file(where.file) is None:
            return where.model_copy(update={"file": rest})
        return where.model_copy(update={"file": f"{self.assignment.package}/{where.file}"})


def _submission(submission: Submission, main: str, about: Assignment) -> Submission:
    """Return a submission as it is about a node: its main package is the node's.

    It has no files if that package is not there.
    """
    name, file = about.package, about.node_file
    named = tuple(path for path in submission.node_files if path.rpartition("/")[2] == file)
    copy = submission.newer_copy if submission.newer_copy.rpartition("/")[2] == file else ""
    if (named, copy) != (submission.node_files, submission.newer_copy):
        submission = replace(submission, node_files=named, newer_copy=copy)
    if name == main:
        return submission
    found = submission.package(name)
    rest = tuple(one for one in submission.packages if one.name != name)
    first = Package(main, submission.root or "", submission.files)
    files, root = (found.files, found.root) if found is not None else ((), None)
    return replace(submission, root=root, files=files, packages=(first, *rest))


def views(evidence: Evidence, check: Check, use: CheckUse) -> list[NodeEvidence]:
    """Return the evidence about each node that a use of a check is about; none if it is about no node.

    A check of a package's files that names a node is about the package of that node.
    """
    assignment = evidence.assignment
    if not assignment.runs:
        return []
    if check.covers == "files":
        nodes = [use.of] if use.of else _in_order(evidence)
        return [NodeEvidence(evidence, node, "", 0) for node in nodes]
    if check.stage == INTAKE and use.of:
        return [NodeEvidence(evidence, use.of, "", 0)]
    starts = [
        NodeEvidence(evidence, begin.node, plan.name, n)
        for plan in assignment.runs
        for n, begin in enumerate(plan.start)
    ]
    if check.covers == "runs" and not use.with_:
        mine = [one for one in starts if use.of in ("", one.node)]
        return [one for one in mine if use.run in ("", one.run_name)]
    if not check.is_of_run:
        return []
    plan = assignment.plan(use.run)
    mine = [one for one in starts if one.run_name == plan.name]
    return [one for one in mine if one.node == use.of][:1] or mine[:1]


def _in_order(evidence: Evidence) -> Iterator[str]:
    """Yield the nodes of an assignment, in the order in which its runs start them."""
    started = [begin.node for plan in evidence.assignment.runs for begin in plan.start]
    yield from dict.fromkeys((*started, *evidence.assignment.nodes))


def _first_start(evidence: Evidence, node: str) -> tuple[str, int]:
    """Return the run that starts a node first, and which program of it is the node's."""
    for plan in evidence.assignment.runs:
        for n, begin in enumerate(plan.start):
            if begin.node == node:
                return plan.name, n
    return evidence.assignment.runs[0].name, 0


def because_of_another(evidence: NodeEvidence, check: Check, use: CheckUse) -> str:
    """Return the check that failed for a program of a run of several, if this failure may follow from it.

    That is the node's own program if it did not go on to the end, else another one: if the use names
    no node, or if the node waits for what nobody sends or offers to the end. "" if there is none.
    """
    plan = evidence.assignment.plan(evidence.run_name)
    if not check.is_of_run or len(plan.start) == 1:
        return ""
    stays = evidence.id_of("run.stays")
    if evidence.run.ended_by_itself:
        return stays
    others = [
        NodeEvidence(evidence.whole, begin.node, plan.name, n)
        for n, begin in enumerate(plan.start)
        if n != evidence.start
    ]
    if use.of and not _waits(evidence, others):
        return ""
    for other in others:
        found = other.results
        lost = [found[kind] for kind in STARTED if kind in found and found[kind].status != "passed"]
        if lost:
            return lost[0].blocked_by or lost[0].id
        if other.run.ended_by_itself:
            return stays
        mine = [one for one in found.values() if (one.node, one.run) == (other.node, plan.name)]
        failed = [one.id for one in mine if one.status == "failed"]
        if failed:
            return failed[0]
    return ""


def _waits(evidence: NodeEvidence, others: Sequence[NodeEvidence]) -> bool:
    """Whether a topic or a service that the node uses has nobody at its other end."""
    run, plan = evidence.run, evidence.assignment.plan(evidence.run_name)
    own = {node.name for node in run.nodes}
    gone = {node.name for one in others if one.run.ended_by_itself for node in one.run.nodes}
    ends = run.seen.ends if run.seen is not None else []
    there = {(end.role, end.name) for end in ends if end.node not in own | gone}
    there |= {("publisher", one.publish.topic) for one in plan.do if one.publish is not None}
    wanted = {"subscription": "publisher", "client": "service"}
    return any(
        (wanted[end.role], end.name) not in there
        for end in ends
        if end.node in own and end.role in wanted and end.name not in TOPICS
    )
