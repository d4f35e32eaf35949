"""The evidence of one verdict as a file that can be signed, compared and judged again.

`evidence.json` has the assignment, the submission, the recording and the verdict, as canonical
JSON; `evidence.json.sig` is its signature (64 bytes), if there is a key. Nothing else is needed to
judge again, not even the submission's folder. docs/recordings.md describes the fields.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Annotated, Literal

from pydantic import AfterValidator, Field, ValidationError

from grader.base.canonical_json import canonical_json
from grader.base.errors import UsageError
from grader.base.part import Part
from grader.base.shown import utf8_name
from grader.course.assignment import Assignment
from grader.course.shorthands import with_kinds
from grader.package.submission import Submission
from grader.package.submission_json import submission_from_json, submission_json
from grader.report.files import report_json
from grader.report.model import CheckResult, Report
from grader.verdict.recording import Recording

MOST_BYTES = 200_000_000  # of a file: a submission's own limits are below


class EvidenceError(UsageError):
    """A file is not the evidence of a verdict."""


@dataclass(frozen=True)
class Judged:
    """The evidence that one marking yielded: the submission as it was marked, and the recording."""

    submission: Submission
    recording: Recording


class CheckVerdict(Part):
    """What makes two results of a check equal."""

    id: str
    status: str
    score: float
    max_score: float
    mistakes: tuple[str, ...] = ()

    @classmethod
    def of(cls, result: CheckResult) -> CheckVerdict:
        """Return that of a result."""
        return cls(
            id=result.id,
            status=result.status,
            score=result.score,
            max_score=result.max_score,
            mistakes=tuple(mistake.id for mistake in result.mistakes),
        )


class EvidenceFile(Part):
    """The evidence of one verdict."""

    schema_: Literal[1] = Field(default=1, alias="schema")
    kind: Literal["ros2_teaching_lab evidence"] = "ros2_teaching_lab evidence"
    assignment: Annotated[Assignment, AfterValidator(with_kinds)]
    files: dict[str, str] = Field(description="the SHA-256 of each file of the package")
    submission: str = Field(description="the submission with its contents, see submission_json")
    recording: Recording
    lang: str
    checks: tuple[CheckVerdict, ...]
    report: str = Field(description="the SHA-256 of report.json")
    digest: str = Field(
        default="", description="the SHA-256 of all of this but itself; none in an earlier file"
    )

    @classmethod
    def of(cls, judged: Judged, assignment: Assignment, report: Report) -> EvidenceFile:
        """Return the evidence of a report."""
        submission = judged.submission
        return cls(
            assignment=assignment,
            files={
                utf8_name(path): hashlib.sha256(file.data).hexdigest()
                for path, file in submission.all_files()
                if file.kind == "file"
            },
            submission=submission_json(submission),
            recording=judged.recording,
            lang=report.lang,
            checks=tuple(CheckVerdict.of(result) for result in report.checks),
            report=report_digest(report),
        )

    def for_report(self, report: Report) -> EvidenceFile:
        """Return the same evidence for the report of another member of the group."""
        return self.model_copy(update={"report": report_digest(report)})

    def taken_in(self) -> Submission:
        """Return the submission that was marked; raise EvidenceError if it is not one."""
        try:
            found = submission_from_json(self.submission)
        except (ValueError, TypeError, LookupError) as error:
            raise EvidenceError(f"the evidence has no submission: {error}") from None
        return found

    def to_bytes(self) -> bytes:
        """Return it as canonical JSON; raise ValueError for a number that JSON does not have."""
        fields = self.model_dump(mode="json", by_alias=True)
        return canonical_json({**fields, "digest": _digest(fields)})

    @classmethod
    def from_bytes(cls, content: bytes, *, name: str = "the evidence") -> EvidenceFile:
        """Read evidence; `name` is for the message of an EvidenceError."""
        try:
            if len(content) > MOST_BYTES:
                raise ValueError(f"it is larger than {MOST_BYTES} bytes")
            return cls.model_validate(json.loads(content))
        except ValidationError as error:
            first = error.errors()[0]
            at = ".".join(str(part) for part in first["loc"])
            raise EvidenceError(
                f"{name} is not evidence of schema 1: {at}: {first['msg']}"
            ) from None
        except (ValueError, TypeError, LookupError, RecursionError) as error:
            raise EvidenceError(f"{name} is not evidence of schema 1: {error}") from None


def is_as_written(content: bytes) -> bool | None:
    """Return whether evidence that can be read has its own digest; None if it has none."""
    fields = json.loads(content)
    return fields["digest"] == _digest(fields) if fields.get("digest") else None


def _digest(fields: Mapping[str, object]) -> str:
    rest = {name: value for name, value in fields.items() if name != "digest"}
    return hashlib.sha256(canonical_json(rest)).hexdigest()


def evidence_bytes(judged: Judged | None, assignment: Assignment, report: Report) -> bytes:
    """Return the content of a report's evidence file; b"" if there is none.

    Evidence that cannot be written loses no verdict: `grader verify` says that it is missing.
    """
    if judged is None:
        return b""
    try:
        return EvidenceFile.of(judged, assignment, report).to_bytes()
    except ValueError:  # a number that JSON does not have
        return b""


def report_digest(report: Report) -> str:
    """Return the SHA-256 of a report in its published form: that of the file report.json."""
    return hashlib.sha256(report_json(report).encode()).hexdigest()


def differences(ours: EvidenceFile, report: Report) -> Iterator[str]:
    """Yield a line for each check whose verdict in a report is not that of the evidence."""
    theirs = {result.id: CheckVerdict.of(result) for result in report.checks}
    for check in ours.checks:
        other = theirs.pop(check.id, None)
        if other is None:
            yield f"{check.id}: {_said(check)} -> not there"
        elif other != check:
            yield f"{check.id}: {_said(check)} -> {_said(other)}"
    for other in theirs.values():
        yield f"{other.id}: not there -> {_said(other)}"


def changed_files(ours: Submission, theirs: Submission) -> list[str]:
    """Return the names of the files that two versions of a submission do not share, sorted."""
    one, other = (
        {(path, file.kind, file.mode & 0o100, file.data) for path, file in version.all_files()}
        for version in (ours, theirs)
    )
    return sorted({utf8_name(entry[0]) for entry in one ^ other})


def _said(check: CheckVerdict) -> str:
    because = f" ({', '.join(check.mistakes)})" if check.mistakes else ""
    return f"{check.status}, {check.score:g} of {check.max_score:g}{because}"
