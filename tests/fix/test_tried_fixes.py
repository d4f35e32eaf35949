"""A fix is in the report only if the package with it was built and run, and it helped.

What the package shows with a fix is here the recorded evidence of another package of the corpus.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import AbstractContextManager, contextmanager, nullcontext
from pathlib import Path

import pytest

from grader.base.errors import SurroundingsError
from grader.base.i18n.translator import Translator
from grader.package.submission import Submission
from grader.report.model import CheckResult
from grader.verdict.evaluate import evaluate_checks
from grader.verdict.evidence import Evidence
from grader.verdict.evidence_file import EvidenceFile, Judged, evidence_bytes
from grader.verdict.mark import replay
from grader.verdict.recording import Recording, evidence_of, record
from grader.verdict.trial import MOST_TRIED
from grader.verdict.try_fixes import with_tried_fix
from tests import marking, recorded
from tests.corpus.broken import BROKEN
from tests.corpus.build import write
from tests.corpus.right import RIGHT

ENGLISH = Translator("en")
BY_NAME = {package.name: package for package in (*BROKEN, *RIGHT)}
UNCHANGED = [
    ("counter_not_set", ["run.ended_early"]),
]


def recording_of(name: str, folder: Path) -> tuple[Recording, Submission]:
    submission = marking.taken_in(write(BY_NAME[name], folder / "tried"))
    file = recorded.file_of(submission)
    return Recording.from_bytes(file.read_bytes()), submission


def evidence(name: str, folder: Path) -> Evidence:
    return evidence_of(*recording_of(name, folder), marking.ASSIGNMENT)


def shows(name: str, folder: Path, fixed: Submission) -> Evidence:
    """Return the evidence of a fixed package that shows what another one does."""
    recording, _ = recording_of(name, folder)
    return evidence_of(
        recording.model_copy(update={"submission": fixed.sha256}), fixed, marking.ASSIGNMENT
    )


def first_failure(found: Evidence) -> CheckResult:
    return next(r for r in evaluate_checks(found, ENGLISH) if r.status == "failed")


def tried(name: str, folder: Path, *then: str) -> tuple[CheckResult, Evidence]:
    """Return the first failure of a package whose fixes lead to these packages, one by one.

    Its own name stands for a fix that changes the files, but not what the package shows.
    """
    found = evidence(name, folder)
    after = iter(then)

    def with_fix(_digest: str, fixed: Submission) -> AbstractContextManager[Evidence]:
        now, place = next(after), folder / str(len(found.tried))
        return nullcontext(shows(now, place, fixed) if now == name else evidence(now, place))

    found.with_fix = with_fix
    return with_tried_fix(first_failure(found), found, ENGLISH), found


def ids(result: CheckResult) -> list[str]:
    return [mistake.id for mistake in result.mistakes]


def test_a_fix_that_helps_is_shown(tmp_path: Path) -> None:
    result, found = tried("counter_not_set", tmp_path, "solution")
    assert "+        self.counter_ = 0" in result.patch
    assert ids(result)[0] == "node.attribute_not_set"
    assert len(found.tried) == 1


@pytest.mark.parametrize(("name", "left"), UNCHANGED)
def test_a_diagnosis_whose_fix_changes_nothing_is_dropped(
    name: str, left: list[str], tmp_path: Path
) -> None:
    before = first_failure(evidence(name, tmp_path / "before"))
    result, _ = tried(name, tmp_path, name, name)
    assert ids(result) == left
    assert result.patch == ""
    assert result.actual.partition("\n")[0] == before.actual.partition("\n")[0]


def test_a_fix_of_what_was_seen_is_left_out_if_it_changes_nothing(tmp_path: Path) -> None:
    before = first_failure(evidence("period_half", tmp_path / "before"))
    result, _ = tried("period_half", tmp_path, *["period_half"] * MOST_TRIED)
    assert before.mistakes == result.mistakes
    assert result.patch == ""
    assert result.fix.startswith("The usual change for this was tried")


def test_a_fix_after_which_an_earlier_check_fails_is_not_shown(tmp_path: Path) -> None:
    result, _ = tried("counter_not_set", tmp_path, "import_misspelt")
    assert result.patch == ""
    assert ids(result) == ["run.ended_early"]


def test_a_fix_that_cannot_be_tried_is_shown_as_before(tmp_path: Path) -> None:
    @contextmanager
    def broken(_digest: str, _fixed: Submission) -> Iterator[Evidence]:
        raise SurroundingsError("no sandbox opens")
        yield

    found = evidence("counter_not_set", tmp_path)
    untried = first_failure(found)
    found.with_fix = broken
    result = with_tried_fix(untried, found, ENGLISH)
    found.with_fix = None
    assert result == with_tried_fix(untried, found, ENGLISH)
    assert result.patch
    assert result.mistakes == untried.mistakes


def test_no_package_has_more_than_some_fixes_tried(tmp_path: Path) -> None:
    found = evidence("counter_not_set", tmp_path)
    found.tried = {str(n): found for n in range(MOST_TRIED)}

    def with_fix(_digest: str, _fixed: Submission) -> AbstractContextManager[Evidence]:
        raise AssertionError("one more was tried")

    found.with_fix = with_fix
    assert with_tried_fix(first_failure(found), found, ENGLISH).patch


def test_a_recording_has_what_the_fixes_showed(tmp_path: Path) -> None:
    recording, submission = recording_of("counter_not_set", tmp_path)
    untried = replay(recording, submission, marking.ASSIGNMENT)
    result, found = tried("counter_not_set", tmp_path / "again", *["counter_not_set"] * 2)
    written = record(found, recording.environment).to_bytes()
    report = replay(Recording.from_bytes(written), submission, marking.ASSIGNMENT)
    again = {check.id: check for check in report.checks}[result.id]
    assert (again.mistakes, again.patch, again.fix) == (result.mistakes, "", result.fix)
    assert again.fix != {check.id: check for check in untried.checks}[result.id].fix


def test_the_evidence_of_a_verdict_has_what_the_fixes_showed(tmp_path: Path) -> None:
    recording, submission = recording_of("counter_not_set", tmp_path)
    _, found = tried("counter_not_set", tmp_path / "again", "solution")
    recording = record(found, recording.environment)
    report = replay(recording, submission, marking.ASSIGNMENT)
    written = evidence_bytes(Judged(submission, recording), marking.ASSIGNMENT, report)
    read = EvidenceFile.from_bytes(written)
    assert list(read.recording.fixed) == list(found.tried)
    again = replay(read.recording, read.taken_in(), read.assignment)
    assert [(c.id, c.mistakes, c.patch, c.fix) for c in again.checks] == [
        (c.id, c.mistakes, c.patch, c.fix) for c in report.checks
    ]


def test_a_recording_without_tried_fixes_is_what_it_was(tmp_path: Path) -> None:
    recording, _ = recording_of("counter_not_set", tmp_path)
    assert b'"fixed"' not in recording.to_bytes()


def static_failure(name: str, folder: Path, after: str) -> tuple[CheckResult, Evidence]:
    """Return the first failure of a package, whose fix leads to another package's run."""
    found = evidence(name, folder)

    def with_fix(_digest: str, fixed: Submission) -> AbstractContextManager[Evidence]:
        return nullcontext(shows(after, folder / "after", fixed))

    found.with_fix = with_fix
    return with_tried_fix(first_failure(found), found, ENGLISH), found


def test_a_fix_of_the_files_is_tried_if_its_mistake_prevents_other_checks(tmp_path: Path) -> None:
    result, found = static_failure("comma_missing", tmp_path, "solution")
    assert result.patch
    assert len(found.tried) == 1


def test_a_fix_of_the_files_after_which_the_build_fails_is_not_shown(tmp_path: Path) -> None:
    untried = first_failure(evidence("node_in_scripts", tmp_path / "before"))
    result, _ = static_failure("node_in_scripts", tmp_path, "setup_raises")
    assert result.patch == ""
    assert (result.mistakes, result.fix) == (untried.mistakes, untried.fix)


def test_a_fix_of_what_prevents_nothing_is_not_tried(tmp_path: Path) -> None:
    result, found = static_failure("exec_bit_missing", tmp_path, "solution")
    assert result.patch
    assert not found.tried
