"""Recorded evidence: equal bytes for equal evidence, the same verdict, and refused if it does not fit."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from grader.base.canonical_json import canonical_json
from grader.base.i18n.translator import Translator
from grader.report.model import CheckResult, Report
from grader.run.unforeseen import MORE_TICKS
from grader.verdict.mark import replay
from grader.verdict.recording import Recording, RecordingError, evidence_of
from tests import recorded
from tests.corpus.broken import BROKEN
from tests.corpus.build import write
from tests.corpus.right import RIGHT
from tests.marking import ASSIGNMENT, assert_full_marks, mark, taken_in

PACKAGES = {package.name: package for package in (*RIGHT, *BROKEN)}
# every kind of evidence: a count, no build, no run, no spinning, lines before the clock starts
BY_THE_WALL = "sleep_loop"  # the node does not follow /clock
KINDS = ("solution", "setup_syntax_error", "marker_missing", "spin_missing", "period_half")


def file_of(name: str, folder: Path) -> Path:
    return recorded.file_of(taken_in(write(PACKAGES[name], folder)))


def without_times(report: Report) -> list[CheckResult]:
    return [check.model_copy(update={"seconds": 0}) for check in report.checks]


def changed(content: bytes, **fields: object) -> bytes:
    return canonical_json({**json.loads(content), **fields})


@pytest.mark.parametrize("name", KINDS)
def test_a_recording_that_is_read_and_written_has_the_same_bytes(name: str, tmp_path: Path) -> None:
    content = file_of(name, tmp_path).read_bytes()
    assert Recording.from_bytes(content).to_bytes() == content


def test_canonical_json_does_not_depend_on_the_order_of_keys() -> None:
    assert canonical_json({"b": 1, "a": "ä"}) == canonical_json({"a": "ä", "b": 1})
    assert canonical_json({"b": 1, "a": "ä"}) == '{"a":"ä","b":1}\n'.encode()


def test_a_number_that_json_does_not_have_is_refused() -> None:
    with pytest.raises(ValueError, match="Out of range"):
        canonical_json({"seconds": float("nan")})


def assert_replayed(real: Report, kept: Recording, root: Path) -> None:
    again = replay(Recording.from_bytes(kept.to_bytes()), taken_in(root), ASSIGNMENT)
    assert without_times(again) == without_times(real)
    assert again.observed == real.observed
    assert again.evidence == real.evidence
    assert again.environment == real.environment


@pytest.mark.prefix
def test_the_solution_gets_full_marks_for_exact_times_and_so_does_its_replay(
    tmp_path: Path,
) -> None:
    kept: list[Recording] = []
    root = write(PACKAGES["solution"], tmp_path)
    real = mark(root, recordings=kept)
    assert_full_marks(PACKAGES["solution"], real)
    ticks = real.observed.ticks
    more = len(ticks) - ASSIGNMENT.output.ticks
    assert 1 <= more <= MORE_TICKS, "a node cannot foresee how many are watched"
    assert [tick.virtual for tick in ticks] == [float(k + 1) for k in range(len(ticks))]
    assert [tick.n for tick in ticks] == list(range(len(ticks)))
    stamps = [tick.wall for tick in ticks]
    assert None not in stamps
    assert stamps == sorted(stamps, key=lambda stamp: stamp or 0)
    assert real.observed.command == (
        "ros2 run my_robot_controller test_node --ros-args -p use_sim_time:=true"
    )
    assert real.observed.nodes == ["/my_first_node"]
    assert_replayed(real, kept[0], root)


@pytest.mark.full
@pytest.mark.prefix
def test_a_failing_verdict_and_its_replay_are_the_same(tmp_path: Path) -> None:
    kept: list[Recording] = []
    root = write(PACKAGES["period_half"], tmp_path)
    assert_replayed(mark(root, recordings=kept), kept[0], root)


def test_a_recording_of_another_submission_is_refused(tmp_path: Path) -> None:
    recording = Recording.from_bytes(file_of("solution", tmp_path / "a").read_bytes())
    other = taken_in(write(PACKAGES["spin_missing"], tmp_path / "b"))
    with pytest.raises(RecordingError, match="not of spin_missing"):
        replay(recording, other, ASSIGNMENT)


def test_a_recording_of_another_output_is_refused_and_of_other_points_is_not(
    tmp_path: Path,
) -> None:
    root = write(PACKAGES["solution"], tmp_path)
    submission = taken_in(root)
    recording = Recording.from_bytes(recorded.file_of(submission).read_bytes())
    output = ASSIGNMENT.output.model_copy(update={"period": 2.0})
    with pytest.raises(RecordingError, match="another version of hello_time"):
        replay(recording, submission, ASSIGNMENT.model_copy(update={"output": output}))
    half = tuple(use.model_copy(update={"points": use.points / 2}) for use in ASSIGNMENT.checks)
    report = replay(recording, submission, ASSIGNMENT.model_copy(update={"checks": half}))
    assert report.score == ASSIGNMENT.max_score / 2


@pytest.mark.parametrize(
    "fields", [{"schema": 2}, {"run": {}}, {"run": 5}, {"build": {"log": 3}}, {"unknown": 1}]
)
def test_a_file_that_is_not_a_recording_is_refused(
    fields: dict[str, object], tmp_path: Path
) -> None:
    content = changed(file_of("solution", tmp_path).read_bytes(), **fields)
    with pytest.raises(RecordingError, match=r"mine\.json is not a recording"):
        Recording.from_bytes(content, name="mine.json")


@pytest.mark.parametrize("missing", ["build", "run"])
def test_evidence_that_was_not_recorded_is_not_invented(missing: str, tmp_path: Path) -> None:
    root = write(PACKAGES["solution"], tmp_path)
    content = recorded.file_of(taken_in(root)).read_bytes()
    recording = Recording.from_bytes(changed(content, **{missing: None}))
    with pytest.raises(RecordingError, match=f"has no {missing}"):
        replay(recording, taken_in(root), ASSIGNMENT)


def test_what_the_clock_noted_is_translated(tmp_path: Path) -> None:
    root = write(PACKAGES[BY_THE_WALL], tmp_path)
    content = recorded.file_of(taken_in(root)).read_bytes()
    note = json.loads(content)["run"]["watch"]["note"]
    recording = Recording.from_bytes(content)
    found = evidence_of(recording, taken_in(root), ASSIGNMENT).run.watch.note
    assert Translator("ko")(found) != found == note != ""


def test_a_recorded_run_is_parsed_once(tmp_path: Path) -> None:
    root = write(PACKAGES["solution"], tmp_path)
    recording = Recording.from_bytes(recorded.file_of(taken_in(root)).read_bytes())
    assert recording.run is not None
    assert evidence_of(recording, taken_in(root), ASSIGNMENT).run is recording.run
