"""The content of a student's page: how the points were calculated, the checks, the run."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial

from grader.base.i18n.message import joined, say
from grader.base.i18n.translator import SOURCE, Translator
from grader.base.plain_text import first_lines
from grader.batch.model import GradebookEntry, Override
from grader.batch.words import local_instant
from grader.publish.pages.calculation import calculation
from grader.publish.pages.charts import PathPlot, Timeline, path_plots, timeline
from grader.publish.pages.overview import shown
from grader.publish.pages.value_plots import ValuePlot, value_plots
from grader.report.blocks import UNSEEN, evidence_of, roots
from grader.report.model import CheckResult, Report
from grader.report.report_page import drawn_values, ran_on
from grader.report.shown_patch import shown_patch
from grader.report.tracebacks import folded
from grader.verdict.checks.all import QUOTES

FIELD_LINES, FIELD_CHARACTERS = 30, 1_000
LOG_LINES, LOG_CHARACTERS = 2_000, 2_000  # a report has 40,000 characters of each
KEY, FOLDER = say("Key"), say("Folder")
ANCHORS = {"build_log": "build-log", "transcript": "transcript"}  # of the logs on the page


@dataclass(frozen=True)
class Field:
    """A labelled text of a check; `code` is shown verbatim."""

    label: str
    text: str
    code: bool = False


@dataclass(frozen=True)
class CheckView:
    """One check as the page shows it; `log` is the id of the text that shows why it failed."""

    check: CheckResult
    fields: tuple[Field, ...]
    because: tuple[str, ...]
    override: Override | None
    log: str

    @property
    def needs_block(self) -> bool:
        """Whether it needs more than its row of the table."""
        return self.check.status not in ("passed", "skipped")


@dataclass(frozen=True)
class StudentView:
    """A student's page."""

    entry: GradebookEntry
    checks: tuple[CheckView, ...]
    hidden: int
    calculation: tuple[str, ...]
    facts: tuple[tuple[str, str], ...]
    details: tuple[tuple[str, str], ...]
    timeline: Timeline | None
    paths: tuple[PathPlot, ...]
    plots: tuple[ValuePlot, ...]
    transcript: str
    build_log: str

    @property
    def advice(self) -> list[CheckView]:
        """The checks that passed and have advice."""
        return [v for v in self.checks if v.check.status == "passed" and v.check.advice]


def student_view(entry: GradebookEntry, *, show_hidden: bool, lang: str = SOURCE) -> StudentView:
    """Return the content of one student's page in a language.

    Without `show_hidden`, hidden checks are only counted.
    """
    translate = Translator(lang)
    report = entry.report
    checks = shown(entry, show_hidden=show_hidden)
    visible = {check.id for check in checks}
    evidence = report.evidence if report else None
    return StudentView(
        entry=entry,
        checks=tuple(_check(check, entry, visible, translate) for check in checks),
        hidden=len(report.checks) - len(checks) if report else 0,
        calculation=tuple(translate(line) for line in calculation(entry, visible)),
        facts=tuple((translate(name), translate(value)) for name, value in _facts(entry) if value),
        details=tuple((translate(n), translate(v)) for n, v in _details(report) if v)
        if report
        else (),
        timeline=timeline(report.observed) if report else None,
        paths=path_plots(report.runs) if report else (),
        plots=value_plots(report.runs) if report else (),
        transcript=_log(evidence.transcript, translate) if evidence else "",
        build_log=_log(evidence.build_log, translate) if evidence else "",
    )


def _check(
    check: CheckResult, entry: GradebookEntry, visible: set[str], translate: Translator
) -> CheckView:
    assert entry.report is not None
    because: list[str] = []
    if check.status == "skipped":
        names = [o.id if o.id in visible else UNSEEN for o in roots(check, entry.report.checks)]
        because = [translate(name) for name in dict.fromkeys(names)]
    found = evidence_of(check, entry.report, QUOTES)
    log = ""
    if found is not None and getattr(entry.report.evidence, found.log).strip():
        log = ANCHORS[found.log]
    return CheckView(
        check=check,
        fields=tuple(
            Field(translate(f.label), translate(f.text), f.code)
            for f in _fields(check, translate)
            if f.text.strip()
        ),
        because=tuple(because),
        override=next((o for o in entry.overrides if o.check == check.id), None),
        log=log,
    )


def _fields(check: CheckResult, translate: Translator) -> list[Field]:
    cut = partial(_cut, translate=translate)
    where = ""
    if check.where is not None:
        where = check.where.file
        if check.where.line is not None:
            where = say("{file}, line {line}", file=where, line=check.where.line)
    open_ = {
        "inconclusive": say(
            "No points given or taken: this could not be decided. Grade again; if it stays, ask the instructor."
        ),
        "error": say("No points given or taken: this is a fault of the grader. Please report it."),
    }
    return [
        Field(say("Expected"), cut(check.expected), code=True),
        Field(say("Found"), cut(check.actual), code=True),
        Field(say("Where"), where, code=True),
        Field(say("Why"), cut(check.rationale)),
        Field(say("Points"), open_.get(check.status, "")),
        Field(say("Fix"), cut(check.fix)),
        Field(say("Change"), cut(shown_patch(check.patch, translate), tabs=True), code=True),
        *(Field(say("Also"), cut(advice)) for advice in check.advice),
        Field(say("Mistake"), ", ".join(mistake.id for mistake in check.mistakes), code=True),
    ]


def _facts(entry: GradebookEntry) -> list[tuple[str, str]]:
    student, report = entry.student, entry.report
    facts: list[tuple[str, str]] = [
        (KEY, student.key if student.key != student.name else ""),
        (say("Number"), student.id_number),
        (say("User name"), student.username),
        (say("Email"), student.email),
        (say("Section"), student.section),
        (say("Submitted"), local_instant(entry.submitted)),
        (say("Due"), local_instant(entry.due)),
    ]
    if report is not None:
        facts += [
            (say("Package"), report.submission.package or say("none was found")),
            (FOLDER, report.submission.path),
            (say("Ran on"), ran_on(report)),
            (say("Command"), report.observed.command),
            (say("Drawn for this submission"), drawn_values(report)),
        ]
    return facts


def _details(report: Report) -> list[tuple[str, str]]:
    names = ("rclpy", "rmw", "python", "colcon", "setuptools", "image", "grader")
    env, found = report.environment, [(name, getattr(report.environment, name)) for name in names]
    for name, limit in env.limits.items():
        value = f"{limit.value:,.10g} {limit.unit}".strip()
        held = say("{limit}, enforced by {holder}", limit=value, holder=limit.held_by)
        found.append((joined(say("limit"), name, by=": "), held))
    spent = [f"{name} {seconds:.2f} s" for name, seconds in report.timing.model_dump().items()]
    found += [
        (say("time"), ", ".join(spent)),
        (say("node"), ", ".join(report.observed.nodes)),
        (say("started"), report.started),
        (say("SHA-256 of the submission"), report.submission.sha256),
        (say("SHA-256 of the assignment"), report.assignment.sha256),
    ]
    return found


def _cut(text: str, translate: Translator, *, tabs: bool = False) -> str:
    return _lines(text, translate, most_lines=FIELD_LINES, most=FIELD_CHARACTERS, tabs=tabs)


def _log(text: str, translate: Translator) -> str:
    text = folded(text, translate=translate)
    return _lines(text, translate, most_lines=LOG_LINES, most=LOG_CHARACTERS)


def _lines(
    text: str, translate: Translator, *, most_lines: int, most: int, tabs: bool = False
) -> str:
    found: Sequence[str] = first_lines(
        text, lines=most_lines, most=most, translate=translate, tabs=tabs
    )
    return "\n".join(found).rstrip()
