"""Finds the mistake behind a failed check; the root cause comes before its consequences."""

from __future__ import annotations

import ast
import re
import shlex
from collections.abc import Collection, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from grader.base.i18n.message import Message, joined, reworded, say
from grader.base.nearest import compared, meant
from grader.base.shown import shown
from grader.course.assignment import OWN
from grader.mistakes.catalogue import CATALOGUE, RANK
from grader.mistakes.recognise import SYMPTOMS, behind_error, behind_symptom
from grader.mistakes.recognised import Raised, RecognisedMistake, Suspect
from grader.package.source.module import Module
from grader.package.source.names import SPINS, calls_in, last_part, misnamed_init
from grader.package.source.place import place_of, statement_at
from grader.package.source.setup_packages import packages_of
from grader.report.model import Mistake, Where
from grader.verdict.checks.faults import calls_to, raised_in, raised_inside
from grader.verdict.checks.not_python import unreadable_module
from grader.verdict.checks.parsed import data_of, file_of, has_subpackages, line_at, names_in
from grader.verdict.circular import circular_import
from grader.verdict.follows import follow_text, followed
from grader.verdict.node_files import source_around, source_of_node
from grader.verdict.node_words import words_for
from grader.verdict.outcome import Failed
from grader.verdict.own_modules import own_module
from grader.verdict.run_facts import fact_of_run

if TYPE_CHECKING:
    from grader.package.source.node import NodeSource
    from grader.verdict.evidence import Evidence

RAISES = ("run.died_at_start", "run.ended_early", "run.error_at_stop")
NEVER_SPINS = "run.never_spins"
SILENT = ("run.no_lines", "run.stops")
"""The symptoms that a node has also because it never spins."""
NOT_PARSED = re.compile(r"(?:Syntax|Indentation|Tab)Error\b")
SHORTEST = 3  # characters of a source line that is worth showing


@dataclass(kw_only=True)
class Diagnosis:
    """Why a check failed: the mistakes, the root cause first, with the texts of its entry.

    `consequence_of` is an earlier check that failed because of the same mistake, else "". `of_fact` is
    whether the root cause is a fact of the run.
    """

    mistakes: list[Mistake]
    rationale: str
    fix: str
    expected: str
    actual: str
    where: Where | None
    advice: Sequence[str]
    consequence_of: str = ""
    of_fact: bool = False

    @property
    def follows_a_fact(self) -> bool:
        """Whether a fact of the run that an earlier check tells explains all of it."""
        return self.of_fact and bool(self.consequence_of)

    @classmethod
    def of(cls, failed: Failed, source: NodeSource | None = None) -> Diagnosis:
        """Return the check's own diagnosis. KeyError if the catalogue lacks its mistake.

        Advice that the node's source follows already is left out.
        """
        if failed.mistake.id.startswith(OWN):
            return cls._in_own_words(failed)
        kind = CATALOGUE[failed.mistake.id]
        values = {**failed.mistake.params, **failed.words}
        return cls(
            mistakes=[failed.mistake],
            rationale=kind.rationale(values, failed.variant),
            fix=failed.fix or kind.fix_for(source, values, failed.variant),
            expected=failed.expected,
            actual=failed.actual,
            where=failed.where,
            advice=failed.advice,
        )

    @classmethod
    def _in_own_words(cls, failed: Failed) -> Diagnosis:
        """Return the diagnosis of an instructor's own mistake, which has no catalogue entry."""
        return cls(
            mistakes=[failed.mistake],
            rationale=failed.rationale,
            fix=failed.fix,
            expected=failed.expected,
            actual=failed.actual,
            where=failed.where,
            advice=failed.advice,
        )


def diagnose(
    failed: Failed,
    evidence: Evidence,
    without: Collection[str] = (),
    found: RecognisedMistake | None = None,
) -> Diagnosis:
    """Return the diagnosis of a failed check, with the root cause first if it is found.

    The root cause is none of the kinds `without`: their fixes were tried and did not help. It is
    `found`, if that is given.
    """
    symptom = failed.mistake.id
    kind = CATALOGUE.get(symptom)
    source = source_of_node(evidence) if kind is not None and kind.steps else None
    diagnosis = Diagnosis.of(failed, source)
    fact = found if evidence.assignment.runs else None
    fact = fact or fact_of_run(failed, evidence)
    if fact is not None and fact.kind not in without:
        return _because(diagnosis, fact, evidence, of_fact=fact is not found)
    if symptom not in SYMPTOMS and symptom not in RAISES and not symptom.startswith("run."):
        return _following(diagnosis, evidence)
    try:
        found = found or _root(symptom, diagnosis, evidence, without)
    except RecursionError:  # (a hostile source; the check's own diagnosis is kept)
        found = None
    if found is not None:
        _explain(diagnosis, found)
    elif symptom in RAISES:
        _say_where(diagnosis, failed, evidence)
    elif follows := failed.follows or _not_spun(symptom, evidence):
        return _left_to(diagnosis, follows)
    _show_line(diagnosis, evidence)
    diagnosis.mistakes.sort(key=lambda mistake: RANK[mistake.id])
    node = source_of_node(evidence)
    if node is not None:
        words = words_for(node)
        diagnosis.rationale = reworded(diagnosis.rationale, words)
        diagnosis.fix = reworded(diagnosis.fix, words)
    diagnosis.consequence_of = _same_root(diagnosis, evidence)
    return diagnosis


def _because(
    diagnosis: Diagnosis, fact: RecognisedMistake, evidence: Evidence, *, of_fact: bool
) -> Diagnosis:
    """Return the diagnosis of what a fact of the run explains, or a change, with that in front."""
    _explain(diagnosis, fact)
    _show_line(diagnosis, evidence)
    diagnosis.consequence_of, diagnosis.of_fact = _same_root(diagnosis, evidence), of_fact
    return diagnosis


def _following(diagnosis: Diagnosis, evidence: Evidence) -> Diagnosis:
    """Leave reason and fix to an earlier check, if its mistake is the cause of this one."""
    cause = followed(diagnosis.mistakes[0].id, diagnosis.where, evidence)
    return _left_to(diagnosis, cause) if cause else diagnosis


def _not_spun(symptom: str, evidence: Evidence) -> str:
    """Return the check that found why the node never spins, if that explains the symptom too."""
    for check, result in evidence.results.items() if symptom in SILENT else ():
        ids = [mistake.id for mistake in result.mistakes]
        visible = result.status == "failed" and result.visibility == "visible"
        if visible and NEVER_SPINS in ids[1:]:  # (behind the mistake that explains it)
            return check
    return ""


def _left_to(diagnosis: Diagnosis, cause: str) -> Diagnosis:
    """Leave reason and fix to a check."""
    diagnosis.consequence_of, diagnosis.rationale = cause, ""
    diagnosis.fix = follow_text(cause)
    return diagnosis


def _root(
    symptom: str, diagnosis: Diagnosis, evidence: Evidence, without: Collection[str]
) -> RecognisedMistake | None:
    if symptom in RAISES:
        error, where = raised_in(evidence, evidence.run)
        if error:
            found = (
                _not_installed(error, evidence)
                or own_module(error, where, evidence)
                or circular_import(error, where, evidence)
                or _cannot_be_read(error, where, evidence)
            )
            if found is not None and found.kind not in without:
                return found
            return _raised(error, where, evidence, without)
    source = source_of_node(evidence)
    if source is None:
        return None
    given = source.name_given or source.created_node
    if symptom == "run.wrong_node_name" and given is not None:
        diagnosis.where = place_of(source, given)
    text = str(diagnosis.mistakes[0].params.get("text", ""))
    lines = tuple(event.text for event in evidence.run.watch.counted)
    said = evidence.run.transcript
    stuck = evidence.run.watch.still_answers is False
    suspect = Suspect(source, evidence.assignment, text, diagnosis.where, lines, said, stuck)
    return behind_symptom(symptom, suspect, without)


def _cannot_be_read(
    error: str, where: Where | None, evidence: Evidence
) -> RecognisedMistake | None:
    """Return why Python cannot read a module of the package, which the node's file imports."""
    if where is None or not NOT_PARSED.match(error):
        return None
    found = data_of(evidence, where.file)
    return unreadable_module(where.file, found) if found is not None else None


def _raised(
    error: str, where: Where | None, evidence: Evidence, without: Collection[str]
) -> RecognisedMistake | None:
    source = source_around(evidence, where)
    inside = raised_inside(evidence, evidence.run)
    raised = Raised(error, where, source, evidence.assignment, inside) if source else None
    return behind_error(raised, without) if raised is not None else None


def _not_installed(error: str, evidence: Evidence) -> RecognisedMistake | None:
    """Return why the node's own module was not installed; None if another one is missing."""
    package = evidence.assignment.folder
    module = rf"{re.escape(package)}(?:\.{re.escape(evidence.assignment.node_file[:-3])})?"
    if not re.search(rf"No module named '{module}'", error):
        return None
    init = f"{package}/__init__.py"
    there = evidence.submission.file(init)
    if there is not None and there.kind == "folder":
        return RecognisedMistake(
            kind="source.no_init_file",
            words={"path": init},
            variant="folder",
            where=Where(file=init),
        )
    if there is None:
        return _no_init(package, init, evidence)
    setup = file_of(evidence, "setup.py")
    found = packages_of(
        setup.data if setup is not None else b"", package, nested=has_subpackages(evidence)
    )
    if found.is_there:
        return None
    return RecognisedMistake(
        kind="setup.not_packaged",
        words={"wanted": found.wanted, "statement": found.statement},
        variant="import" if found.statement else "",
        where=Where(file="setup.py", line=found.line),
    )


def _no_init(package: str, init: str, evidence: Evidence) -> RecognisedMistake:
    """Return that there is no __init__.py, with the file that has nearly this name."""
    close = misnamed_init(names_in(evidence, package))
    there, variant = f"{package}/{shown(close)}", "misnamed" if close else ""
    return RecognisedMistake(
        kind="source.no_init_file",
        params={"there": there} if close else {},
        words={"path": init, "there": shlex.quote(there)},
        variant=variant,
        where=Where(file=there if close else init),
    )


def _explain(diagnosis: Diagnosis, found: RecognisedMistake) -> None:
    """Use the texts of the root cause's catalogue entry."""
    kind = CATALOGUE[found.kind]
    values = {**found.params, **found.words}
    diagnosis.rationale = kind.rationale(values, found.variant)
    diagnosis.fix = kind.fix_text(values, found.variant)
    diagnosis.mistakes.insert(0, Mistake(id=found.kind, params=dict(found.params)))
    if found.where is not None and (found.where.line or diagnosis.where is None):
        diagnosis.where = found.where
    title = Message(kind.title)
    name, close = str(found.params.get("name", "")), str(found.params.get("close", ""))
    difference = compared(name, close) if close else ""
    diagnosis.actual = joined(diagnosis.actual, title + meant(close), difference, by="\n")


def _say_where(diagnosis: Diagnosis, failed: Failed, evidence: Evidence) -> None:
    """Say what the exception means, by which calls the program came to the line, and where to look.

    That is all that is known of an exception that no entry of the catalogue explains. No change is
    asked of a line that only spins, nor of one that is not there.
    """
    where, program = failed.where, evidence.run
    error, _ = raised_in(evidence, program)
    if not error or failed.fix:
        return
    source = source_around(evidence, where) if where is not None and where.line else None
    variant, library = failed.variant, raised_inside(evidence, program)
    if where is None or not where.line:
        variant = "no_line"
    elif library and source is not None and _spins(source.module_at(where.file), where.line):
        variant = "spins"
    elif library:
        variant = "inside"
    kind = CATALOGUE[failed.mistake.id]
    values = {**failed.mistake.params, **failed.words, "library": library}
    name = error.partition(":")[0]
    diagnosis.rationale = kind.rationale(values, name if name in kind.whys else variant)
    diagnosis.fix = kind.fix_text(values, variant)
    calls = calls_to(evidence, program)
    if len(calls) > 1:
        way = " > ".join(f"{function} ({line})" for function, line in calls)
        came = say("the calls that led there, with their lines: {way}", way=shown(way))
        diagnosis.actual = joined(diagnosis.actual, came, by="\n")


def _spins(module: Module, line: int) -> bool:
    """Whether a line calls spin, so that the callbacks are called in it."""
    statement = statement_at(module, line)
    calls = calls_in(statement) if isinstance(statement, ast.Expr) else ()
    return any(last_part(name) in SPINS for _, name in calls)


def _show_line(diagnosis: Diagnosis, evidence: Evidence) -> None:
    """Add the source line to the `actual` text."""
    where = diagnosis.where
    source = source_around(evidence, where) if where is not None and where.line else None
    if where is None or not where.line:
        return
    last = 0
    if source is not None:
        module = source.module_at(where.file)
        code, last = module.line(where.line), _last_line(module, where.line)
    else:
        code = line_at(evidence, where)
    if len(code) >= SHORTEST:
        line = say("line {line}: {code}", line=where.line or 0, code=shown(code))
        if last > where.line:
            line = say(
                "lines {line} to {last}: {code} …", line=where.line, last=last, code=shown(code)
            )
        diagnosis.actual = joined(diagnosis.actual, line, by="\n")


def _last_line(module: Module, line: int) -> int:
    """Return the last line of the statement that begins in a line; that line if it is a block."""
    statement = statement_at(module, line)
    if statement is None or statement.lineno != line or getattr(statement, "body", None):
        return line
    return statement.end_lineno or line


def _same_root(diagnosis: Diagnosis, evidence: Evidence) -> str:
    """Return the earlier check that failed because of the same mistake at the same place."""
    root = diagnosis.mistakes[0]
    for check_id, result in evidence.results.items():
        same = result.mistakes[:1] == [root] and result.where == diagnosis.where
        if result.status == "failed" and same and result.visibility == "visible":
            return check_id
    return ""
