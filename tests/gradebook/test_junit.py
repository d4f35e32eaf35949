"""JUnit XML, read by junitparser and checked by the rules of its schema."""

from __future__ import annotations

import dataclasses
import xml.etree.ElementTree as ET

from hypothesis import given, settings
from hypothesis import strategies as st
from junitparser import Error, Failure, JUnitXml, Skipped
from junitparser import TestSuite as Suite

from grader.batch.model import ClassResult
from grader.publish.junit import class_xml, report_xml
from grader.report.model import Report
from tests.gradebook.hostile_texts import hostile_class, texts
from tests.report import samples

# the children that an element may have, and its required attributes (Jenkins' junit-10.xsd)
PARTS = {
    "testsuites": {"testsuite"},
    "testsuite": {"properties", "testcase", "system-out", "system-err"},
    "testcase": {"properties", "skipped", "error", "failure", "system-out", "system-err"},
    "properties": {"property"},
}
NEEDED = {
    "testsuite": {"name", "tests", "failures", "errors", "skipped", "time"},
    "testcase": {"name", "classname", "time"},
    "property": {"name", "value"},
    "failure": {"message", "type"},
    "error": {"message", "type"},
}
KINDS = {
    "passed": None,
    "failed": Failure,
    "skipped": Skipped,
    "inconclusive": Error,
    "error": Error,
}


def suites(content: bytes) -> list[Suite]:
    """Check the schema's rules, then parse with junitparser."""
    for element in ET.fromstring(content).iter():
        assert {child.tag for child in element} <= PARTS.get(element.tag, set())
        assert NEEDED.get(element.tag, set()) <= set(element.attrib)
    parsed = JUnitXml.fromstring(content)
    assert isinstance(parsed, JUnitXml)
    return list(parsed)


def kinds(suite: Suite) -> dict[str, type | None]:
    return {str(case.name): type(case.result[0]) if case.result else None for case in suite}


def test_each_state_of_a_check_has_its_element(reports: tuple[Report, ...]) -> None:
    open_ = samples.check("run.period", "inconclusive", actual="too busy")
    ours = samples.check("run.logger", "error", actual="Traceback …")
    for report in (*reports, samples.report(open_, ours)):
        (suite,) = suites(report_xml(report))
        assert kinds(suite) == {check.id: KINDS[check.status] for check in report.checks}


def test_the_counts_of_a_suite_match_its_cases(mixed: ClassResult) -> None:
    content = class_xml(mixed)
    found = suites(content)
    assert [suite.name for suite in found] == [entry.student.key for entry in mixed.entries]
    sums = dict.fromkeys(("tests", "failures", "errors", "skipped"), 0)
    for suite in found:
        written = {name: getattr(suite, name) for name in sums}
        suite.update_statistics()  # type: ignore[no-untyped-call]  # it counts anew
        assert written == {name: getattr(suite, name) for name in sums}
        sums = {name: sums[name] + written[name] for name in sums}
    top = ET.fromstring(content)
    assert {name: int(top.get(name, "-1")) for name in sums} == sums


def test_a_student_without_a_report_is_distinguished(mixed: ClassResult) -> None:
    found = {
        suite.name: kinds(suite)["submission"]
        for suite in suites(class_xml(mixed))
        if len(list(suite)) == 1
    }
    assert found == {"1007": Skipped, "1013": Failure, "1017": Skipped}


def test_corrections_and_penalties_are_properties(mixed: ClassResult) -> None:
    text = {
        suite.name: [(p.name, p.value) for p in suite.properties()]  # type: ignore[no-untyped-call]
        for suite in suites(class_xml(mixed))
    }
    assert ("penalty", "5") in text["1003"]
    corrected = dict(text["1009"])["corrected"]
    assert "M. Curie" in corrected
    assert "shown to work in the laboratory" in corrected


def test_a_check_that_was_corrected_to_all_its_points_passes(broken: Report) -> None:
    from grader.batch.model import Override
    from tests.pages import classes

    override = Override("1001", "run.output", 10, "agreed")
    entry = dataclasses.replace(classes.entry(1, broken), overrides=(override,))
    (suite,) = suites(class_xml(classes.result([entry])))
    assert kinds(suite)["run.output"] is None


@settings(max_examples=80)
@given(st.lists(texts, min_size=1, max_size=2))
def test_every_text_gives_readable_xml(found: list[str]) -> None:
    content = class_xml(hostile_class(*found))
    assert len(suites(content)) == len(found)
    for element in ET.fromstring(content).iter():
        for text in (element.text or "", *element.attrib.values()):
            assert text.replace("\n", "").isprintable()
