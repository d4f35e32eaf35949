"""What a student's page says: the reckoning of the points, the checks, the run."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from grader.batch.model import Entry
from grader.batch.model import Override
from grader.report.blocks import UNSEEN
from grader.report.blocks import evidence_of
from grader.report.blocks import roots
from grader.report.model import CheckResult
from grader.report.model import Report
from grader.report.plain import first_lines
from grader.report.plain import points
from grader.site.charts import Timeline
from grader.site.charts import timeline
from grader.site.overview import shown
from grader.site.words import duration
from grader.site.words import instant

FIELD_LINES, FIELD_CHARACTERS = 30, 1_000
LOG_LINES, LOG_CHARACTERS = 2_000, 2_000  # the runner keeps 40,000 characters of each
LOGS = {"colcon build printed": "build-log", "ros2 run printed": "transcript"}


@dataclass(frozen=True)
class Field:
    """A labelled text of a check; `code` ones are shown letter by letter."""

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
        """Whether there is something to tell beside its line of the table."""
        return self.check.status not in ("passed", "skipped")


@dataclass(frozen=True)
class StudentView:
    """A student's page."""

    entry: Entry
    checks: tuple[CheckView, ...]
    hidden: int
    reckoning: tuple[str, ...]
    facts: tuple[tuple[str, str], ...]
    details: tuple[tuple[str, str], ...]
    timeline: Timeline | None
    transcript: str
    build_log: str

    @property
    def advice(self) -> list[CheckView]:
        """The checks that passed and still have something to say."""
        return [v for v in self.checks if v.check.status == "passed" and v.check.advice]


def student_view(entry: Entry, *, show_hidden: bool) -> StudentView:
    """Return what the page of one student shows; without `show_hidden` no word of hidden checks."""
    report = entry.report
    checks = shown(entry, show_hidden=show_hidden)
    visible = {check.id for check in checks}
    evidence = report.evidence if report else None
    return StudentView(
        entry=entry,
        checks=tuple(_check(check, entry, visible) for check in checks),
        hidden=len(report.checks) - len(checks) if report else 0,
        reckoning=tuple(_reckoning(entry, visible)),
        facts=tuple((name, value) for name, value in _facts(entry) if value),
        details=tuple((n, v) for n, v in _details(report) if v) if report else (),
        timeline=timeline(report.observed) if report else None,
        transcript=_log(evidence.transcript) if evidence else "",
        build_log=_log(evidence.build_log) if evidence else "",
    )


def _check(check: CheckResult, entry: Entry, visible: set[str]) -> CheckView:
    assert entry.report is not None
    because: list[str] = []
    if check.status == "skipped":
        names = [o.id if o.id in visible else UNSEEN for o in roots(check, entry.report.checks)]
        because = list(dict.fromkeys(names))
    _, title = evidence_of(check, entry.report.evidence)
    log = next((place for start, place in LOGS.items() if title.startswith(start)), "")
    return CheckView(
        check=check,
        fields=tuple(f for f in _fields(check) if f.text.strip()),
        because=tuple(because),
        override=next((o for o in entry.overrides if o.check == check.id), None),
        log=log if log and _log_text(entry.report, log).strip() else "",
    )


def _log_text(report: Report, place: str) -> str:
    return report.evidence.build_log if place == "build-log" else report.evidence.transcript


def _fields(check: CheckResult) -> list[Field]:
    where = ""
    if check.where is not None:
        where = check.where.file
        where += f", line {check.where.line}" if check.where.line is not None else ""
    open_ = {
        "inconclusive": "None taken, none given. Grade again when the machine is less busy.",
        "error": "None taken, none given: the fault is the grader's. Please report it.",
    }
    return [
        Field("Expected", _cut(check.expected), code=True),
        Field("Found", _cut(check.actual), code=True),
        Field("Where", where, code=True),
        Field("Why", _cut(check.rationale)),
        Field("Points", open_.get(check.status, "")),
        Field("Fix", _cut(check.fix)),
        Field("Change", _cut(check.patch), code=True),
        *(Field("Also", _cut(advice)) for advice in check.advice),
        Field("Mistake", ", ".join(mistake.id for mistake in check.mistakes), code=True),
    ]


def _reckoning(entry: Entry, visible: set[str]) -> list[str]:
    """Return how the final points came about, one step a line."""
    lines = []
    report = entry.report
    if report is not None and report.status == "error":
        lines.append(
            "Not graded: the fault is the grader's or its machine's, not the submission's."
        )
    elif report is not None:
        lines.append(f"The checks gave {points(report.score)} of {points(report.max_score)}.")
        if report.inconclusive:
            lines.append(f"{points(report.inconclusive)} points could be neither given nor taken.")
    lines += [_correction(override, entry, visible) for override in entry.overrides]
    if entry.overrides and entry.score is not None:
        lines.append(f"With that it is {points(entry.score)}.")
    if entry.late_seconds > 0 or entry.penalty:
        late = f"Late by {duration(entry.late_seconds)}" if entry.late_seconds > 0 else "Penalty"
        lines.append(f"{late}: {points(entry.penalty) if entry.penalty else 'no'} points taken.")
    if entry.attempts > 1:
        lines.append(f"Attempt {entry.attempt} of {entry.attempts} is the one that counts.")
    graded = report is not None and report.status == "graded"
    if len(lines) == 1 and graded and entry.final == entry.score:
        return ["As the checks gave them."]
    if entry.final is None:
        lines.append("Nothing goes into the gradebook yet.")
    else:
        lines.append(f"{points(entry.final)} of {points(entry.max_score)} go into the gradebook.")
    return lines


def _correction(override: Override, entry: Entry, visible: set[str]) -> str:
    known = {check.id: check for check in entry.report.checks} if entry.report else {}
    hidden = override.check in known and override.check not in visible
    check = known.get(override.check)
    was = "" if check is None else f" instead of {points(check.score)}"
    what = UNSEEN if hidden else override.check or "the total"
    signed = ", ".join(part for part in (override.by, instant(override.at)) if part)
    by = f" ({signed})" if signed else ""
    because = "" if hidden else f", because: {override.because}"
    return f"Corrected: {what} gives {points(override.points)}{was}{because}{by}."


def _facts(entry: Entry) -> list[tuple[str, str]]:
    student, report = entry.student, entry.report
    facts = [
        ("Key", student.key if student.key != student.name else ""),
        ("Number", student.id_number),
        ("User name", student.username),
        ("Email", student.email),
        ("Section", student.section),
        ("Handed in", instant(entry.submitted)),
    ]
    if report is not None:
        clock = f", {report.observed.clock} clock" if report.observed.clock else ""
        world = f"ROS 2 {report.environment.distro} ({report.environment.ros}), "
        box = report.environment.sandbox
        world += ("no sandbox" if box == "none" else f"sandbox {box}") + clock
        facts += [
            ("Package", report.submission.package or "none was found"),
            ("Folder", report.submission.path),
            ("Ran on", world),
            ("Command", report.observed.command),
        ]
    return facts


def _details(report: Report) -> list[tuple[str, str]]:
    names = ("rclpy", "rmw", "python", "colcon", "setuptools", "image", "grader")
    env, found = report.environment, [(name, getattr(report.environment, name)) for name in names]
    for name, limit in env.limits.items():
        value = f"{limit.value:,.10g} {limit.unit}".strip()
        found.append((f"limit: {name}", f"{value}, held by {limit.held_by}"))
    spent = [f"{name} {seconds:.2f} s" for name, seconds in report.timing.model_dump().items()]
    found += [
        ("time", ", ".join(spent)),
        ("nodes", ", ".join(report.observed.nodes)),
        ("started", report.started),
        ("submission's SHA-256", report.submission.sha256),
        ("assignment's SHA-256", report.assignment.sha256),
    ]
    return found


def _cut(text: str) -> str:
    return _lines(text, most_lines=FIELD_LINES, most=FIELD_CHARACTERS)


def _log(text: str) -> str:
    return _lines(text, most_lines=LOG_LINES, most=LOG_CHARACTERS)


def _lines(text: str, *, most_lines: int, most: int) -> str:
    found: Sequence[str] = first_lines(text, lines=most_lines, most=most)
    return "\n".join(found).rstrip()
