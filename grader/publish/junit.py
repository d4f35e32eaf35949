"""JUnit XML of a report or a class, with the elements that pytest writes and Jenkins reads.

A failed check is a `failure`, a check that the grader or the machine's load left undecided is an
`error`, and a check that was not run is `skipped`. XML cannot hold control characters, so they are
written as visible text.
"""

from __future__ import annotations

import xml.etree.ElementTree as ET
from collections.abc import Sequence

from grader.base.i18n.message import say
from grader.base.i18n.translator import Translator
from grader.base.plain_text import first_lines, one_line, points
from grader.batch.check_text import check_text, headline
from grader.batch.model import ClassResult, GradebookEntry
from grader.batch.points import Mark, adjustments, marks, single
from grader.report.model import Report

SUBMISSION = "submission"  # the test case of a submission that could not be marked
MOST = 200  # characters of a name
NOTHING = {
    "missing": say("no submission"),
    "elsewhere": say("submitted elsewhere"),
    "unclear": say("not known whose submission it is"),
    "pending": say("not marked yet"),
}
COUNTS = ("tests", "failures", "errors", "skipped")
CLOSED = b"</testsuites>"


def report_xml(report: Report) -> bytes:
    """Return the XML of one report with all its checks."""
    return _document(report.assignment.title, [single(report)])


def class_xml(result: ClassResult) -> bytes:
    """Return the XML of a class, one test suite per student."""
    return _document(result.title or result.assignment, result.entries)


def _document(title: str, entries: Sequence[GradebookEntry]) -> bytes:
    """Return the document; suites are serialised one by one, to keep the tree small."""
    totals = dict.fromkeys(COUNTS, 0)
    suites = []
    for entry in entries:
        suite = _suite(entry)
        for name in COUNTS:
            totals[name] += int(suite.get(name, "0"))
        ET.indent(suite, space=" ", level=1)
        text: bytes = ET.tostring(suite, encoding="utf-8", xml_declaration=False)
        suites.append(b" " + text.strip() + b"\n")
    top = ET.Element("testsuites", name=one_line(title, most=MOST))
    for name, value in totals.items():
        top.set(name, str(value))
    top.text = "\n"
    opened: bytes = ET.tostring(top, encoding="utf-8", xml_declaration=True)
    return opened.replace(CLOSED, b"".join(suites) + CLOSED) + b"\n"


def _suite(entry: GradebookEntry) -> ET.Element:
    report, student = entry.report, entry.student
    suite = ET.Element("testsuite", name=one_line(student.key or student.name, most=MOST))
    _properties(suite, entry)
    seconds = 0.0
    if report is not None:
        seconds = report.timing.total
        if report.started:
            suite.set("timestamp", one_line(report.started[:19], most=40))
    judged = marks(entry) if report is not None and entry.status != "ungradable" else ()
    for mark in judged:
        assert report is not None
        _check_case(suite, mark, report)
    if not judged:
        _submission_case(suite, entry)
    suite.set("time", f"{seconds:.3f}")
    cases = suite.findall("testcase")
    suite.set("tests", str(len(cases)))
    for name, tag in (("failures", "failure"), ("errors", "error"), ("skipped", "skipped")):
        suite.set(name, str(sum(case.find(tag) is not None for case in cases)))
    return suite


def _late(entry: GradebookEntry) -> str:
    if entry.late_seconds is None:
        return "unknown"
    return points(entry.late_seconds) if entry.late_seconds else ""


def _properties(suite: ET.Element, entry: GradebookEntry) -> None:
    student, translate = entry.student, Translator(entry.lang)
    found = [
        ("student", student.name),
        ("email", student.email),
        ("status", entry.status),
        ("score", "" if entry.score is None else points(entry.score)),
        ("penalty", points(entry.penalty) if entry.penalty else ""),
        ("final", "" if entry.final is None else points(entry.final)),
        ("max_score", points(entry.max_score)),
        ("late_seconds", _late(entry)),
        ("attempt", f"{entry.attempt} of {entry.attempts}"),
        *(
            ("adjusted", f"{translate(adjustment.why)}: {points(adjustment.points)}")
            for adjustment in adjustments(entry)
        ),
        *(
            ("corrected", f"{mark.check.id}: {translate(mark.correction)}")
            for mark in marks(entry)
            if mark.correction
        ),
    ]
    if entry.report is not None:
        found.append(("distro", entry.report.environment.distro))
    properties = ET.SubElement(suite, "properties")
    for name, value in found:
        if value:
            ET.SubElement(properties, "property", name=name, value=one_line(value, most=1_000))


def _check_case(suite: ET.Element, mark: Mark, report: Report) -> None:
    check = mark.check
    stage = one_line(check.id, most=60).partition(".")[0]
    case = ET.SubElement(
        suite,
        "testcase",
        classname=f"{one_line(report.assignment.id, most=60)}.{stage}",
        name=one_line(check.id, most=60),
        time=f"{check.seconds:.3f}",
    )
    own = ET.SubElement(case, "properties")
    given = "" if mark.points is None else points(mark.points)
    for name, value in (("points", given), ("max_points", points(check.max_score))):
        ET.SubElement(own, "property", name=name, value=value)
    text, message = check_text(mark, report), headline(mark, report)
    if mark.passed:
        if check.advice or mark.correction:
            ET.SubElement(case, "system-out").text = text
    elif check.status == "skipped" and mark.override is None:
        ET.SubElement(case, "skipped", type="dependency", message=text.strip())
    elif mark.points is None:
        ET.SubElement(case, "error", type=check.status, message=message).text = text
    else:
        kinds = ", ".join(one_line(mistake.id, most=80) for mistake in check.mistakes)
        ET.SubElement(case, "failure", type=kinds or "failed", message=message).text = text


def _submission_case(suite: ET.Element, entry: GradebookEntry) -> None:
    """Add the test case of an entry without checks: ungradable, a grader error, or missing."""
    translate = Translator(entry.lang)
    case = ET.SubElement(suite, "testcase", classname=SUBMISSION, name=SUBMISSION, time="0.000")
    if entry.status in NOTHING and entry.report is None:
        ET.SubElement(case, "skipped", type=entry.status, message=translate(NOTHING[entry.status]))
        return
    problem = entry.problem or (entry.report.message if entry.report else "")
    text = translate(problem or say("not gradable"))
    tag = "failure" if entry.status == "ungradable" else "error"
    part = ET.SubElement(case, tag, type=entry.status, message=one_line(text))
    part.text = "\n".join(first_lines(text, lines=20, translate=translate))
