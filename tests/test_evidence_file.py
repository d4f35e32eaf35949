"""The evidence of a verdict: complete, signed, and the verdict follows from it again."""

from __future__ import annotations

import hashlib
import json
import shutil
from pathlib import Path

import pytest

from grader.base.canonical_json import canonical_json
from grader.report.files import EVIDENCE, REPORT, SIGNATURE
from grader.verdict.evidence_file import EvidenceError, EvidenceFile, changed_files
from tests import processes
from tests.corpus.broken import BROKEN
from tests.corpus.build import write
from tests.corpus.model import NODE
from tests.corpus.right import RIGHT
from tests.marking import taken_in

PACKAGES = {package.name: package for package in (*RIGHT, *BROKEN)}
KINDS = ("solution", "setup_syntax_error", "marker_missing", "spin_missing", "only_a_text")


@pytest.fixture
def state(tmp_path: Path) -> dict[str, str]:
    """The variables of an installation without a key."""
    return {"GRADER_STATE": str(tmp_path / "state")}


def graded(name: str, tmp_path: Path, env: dict[str, str]) -> Path:
    """Return the folder of the report of a package, marked from its recording."""
    root = write(PACKAGES[name], tmp_path / "kim").rename(tmp_path / "kim" / "package")
    done = processes.run(
        processes.replaying("grade", root, "--out", tmp_path / "out", "--name", "kim"), env=env
    )
    assert done.returncode in (0, 1), done.stderr
    return tmp_path / "out" / "kim" / "jazzy"


def said(*words: str | Path, env: dict[str, str]) -> tuple[int, str]:
    done = processes.run(processes.grader(*words), env=env)
    assert "Traceback" not in done.stderr, done.stderr
    return done.returncode, done.stdout + done.stderr


def keygen(env: dict[str, str]) -> None:
    assert said("keygen", env=env)[0] == 0


@pytest.mark.parametrize("name", KINDS)
def test_the_verdict_follows_from_the_evidence_alone(
    name: str, tmp_path: Path, state: dict[str, str]
) -> None:
    place = graded(name, tmp_path, state)
    shutil.rmtree(tmp_path / "kim")
    status, text = said("replay", place / REPORT, env=state)
    assert status == 0, text
    assert text.startswith("the same verdict")


@pytest.mark.parametrize("switch", ["--all", "--verbose"])
def test_the_whole_report_can_be_printed_again(
    switch: str, tmp_path: Path, state: dict[str, str]
) -> None:
    place = graded("spin_missing", tmp_path, state)
    status, text = said("replay", place, switch, env=state)
    assert status == 0, text
    assert "Score" in text and "run.spins" in text and "the same verdict" in text
    assert ("Details" in text) is (switch == "--verbose")


def test_the_evidence_has_the_hash_of_each_file_and_of_the_report(
    tmp_path: Path, state: dict[str, str]
) -> None:
    place = graded("solution", tmp_path, state)
    found = json.loads((place / EVIDENCE).read_bytes())
    node = (tmp_path / "kim" / "package" / NODE).read_bytes()
    assert found["files"][NODE] == hashlib.sha256(node).hexdigest()
    assert found["report"] == hashlib.sha256((place / REPORT).read_bytes()).hexdigest()
    assert found["recording"]["build"]["log"]
    assert found["recording"]["run"]["transcript"]
    assert found["recording"]["environment"]["rclpy"]
    content = (place / EVIDENCE).read_bytes()
    assert EvidenceFile.from_bytes(content).to_bytes() == content
    for use in found["assignment"]["checks"]:  # as it was before these checks had kinds
        use.update(check="", **{"with": {}})
    assert EvidenceFile.from_bytes(json.dumps(found).encode()).to_bytes() == content


def test_without_a_key_nothing_is_signed_and_the_report_is_still_compared(
    tmp_path: Path, state: dict[str, str]
) -> None:
    place = graded("solution", tmp_path, state)
    assert not (place / SIGNATURE).exists()
    status, text = said("verify", place, env=state)
    assert (status, "as it was written" in text) == (0, True), text
    report = json.loads((place / REPORT).read_text())
    report["checks"][3]["score"] = 0
    (place / REPORT).write_text(json.dumps(report))
    status, text = said("verify", place, env=state)
    assert status == 1
    assert f"{report['checks'][3]['id']}: passed, 5 of 5 -> passed, 0 of 5" in text


@pytest.mark.parametrize(
    ("before", "after"),
    [
        (b'"transcript":"', b'"transcript":"[INFO] [1.0] [my_first_node]: Hello time: 0'),
        (b'"status":0', b'"status":1'),
        (b'"lang":"en"', b'"lang":"ko"'),
    ],
)
def test_without_a_key_changed_evidence_is_noticed(
    tmp_path: Path, state: dict[str, str], before: bytes, after: bytes
) -> None:
    """Also where neither the report nor the checks' results are changed."""
    place = graded("solution", tmp_path, state)
    content = (place / EVIDENCE).read_bytes()
    assert before in content
    assert "evidence    as it was written" in said("verify", place, env=state)[1]
    (place / EVIDENCE).write_bytes(content.replace(before, after, 1))
    status, text = said("verify", place, env=state)
    assert (status, "evidence    changed since it was written" in text) == (1, True), text


def test_the_evidence_of_an_earlier_grader_has_no_hash_and_that_is_said(
    tmp_path: Path, state: dict[str, str]
) -> None:
    place = graded("solution", tmp_path, state)
    found = json.loads((place / EVIDENCE).read_bytes())
    del found["digest"]
    (place / EVIDENCE).write_bytes(canonical_json(found))
    status, text = said("verify", place, env=state)
    assert (status, "an earlier grader wrote no hash of it" in text) == (0, True), text


def test_a_signature_holds_and_a_changed_file_does_not(
    tmp_path: Path, state: dict[str, str]
) -> None:
    keygen(state)
    place = graded("spin_missing", tmp_path, state)
    status, text = said("verify", place, "--submission", tmp_path / "kim", env=state)
    assert status == 0, text
    assert "good, by SHA256:" in text
    assert "the one that was marked" in text
    content = (place / EVIDENCE).read_bytes()
    (place / EVIDENCE).write_bytes(content.replace(b'"failed"', b'"passed"', 1))
    status, text = said("verify", place, env=state)
    assert (status, "wrong: evidence.json was changed" in text) == (1, True), text
    (place / EVIDENCE).write_bytes(content)
    (place / SIGNATURE).unlink()
    assert said("verify", place, env=state)[0] == 1, "who has a key expects a signature"


def test_another_key_does_not_verify_and_the_right_one_can_be_named(
    tmp_path: Path, state: dict[str, str]
) -> None:
    keygen(state)
    place = graded("solution", tmp_path, state)
    other = {"GRADER_STATE": str(tmp_path / "other")}
    keygen(other)
    assert said("verify", place, env=other)[0] == 1
    public = tmp_path / "state" / "signing_key.pub.pem"
    assert said("verify", place, "--key", public, env=other)[0] == 0
    without = {"GRADER_STATE": str(tmp_path / "none")}
    status, text = said("verify", place, env=without)
    assert (status, "give the public key" in text) == (1, True), text


def test_a_changed_submission_is_named(tmp_path: Path, state: dict[str, str]) -> None:
    place = graded("solution", tmp_path, state)
    node = tmp_path / "kim" / "package" / NODE
    node.write_text(node.read_text() + "# more\n")
    status, text = said("verify", place, "--submission", tmp_path / "kim", env=state)
    assert status == 1
    assert NODE in text
    before = EvidenceFile.from_bytes((place / EVIDENCE).read_bytes()).taken_in()
    assert changed_files(before, taken_in(tmp_path / "kim")) == [NODE]


def test_an_older_signature_is_never_beside_a_newer_report(
    tmp_path: Path, state: dict[str, str]
) -> None:
    keygen(state)
    place = graded("solution", tmp_path, state)
    assert (place / SIGNATURE).exists()
    shutil.rmtree(tmp_path / "state")
    shutil.rmtree(tmp_path / "kim")
    graded("solution", tmp_path, state)
    assert not (place / SIGNATURE).exists()


def test_other_points_give_another_verdict_from_the_same_evidence(
    tmp_path: Path, state: dict[str, str]
) -> None:
    place = graded("spin_missing", tmp_path, state)
    course = processes.ROOT / "lab/course/hello_time/assignment.yaml"
    mine = tmp_path / "assignment.yaml"
    text = course.read_text(encoding="utf-8")
    assert "package.manifest" in text
    mine.write_text(
        text.replace("{id: package.manifest, points: 5}", "{id: package.manifest, points: 6}")
    )
    assert mine.read_text() != text
    status, shown = said("replay", place, "--assignment", mine, env=state)
    assert status == 1
    assert "package.manifest: passed, 5 of 5 -> passed, 6 of 6" in shown


@pytest.mark.parametrize(
    "content", [b"", b"{}", b"[]", b"null", b'{"schema": 2}', b"\xff\xfe", b"[" * 100_000]
)
def test_what_is_not_evidence_is_refused(content: bytes) -> None:
    with pytest.raises(EvidenceError, match="not evidence"):
        EvidenceFile.from_bytes(content)


def test_evidence_with_another_submission_in_it_is_noticed(
    tmp_path: Path, state: dict[str, str]
) -> None:
    place = graded("solution", tmp_path, state)
    found = json.loads((place / EVIDENCE).read_bytes())
    other = json.loads(found["submission"])
    other["sha256"] = "0" * 64
    (place / EVIDENCE).write_bytes(canonical_json({**found, "submission": json.dumps(other)}))
    status, text = said("verify", place, env=state)
    assert (status, "do not belong together" in text) == (1, True), text
    assert said("replay", place, env=state)[0] == 2


def test_a_report_without_evidence_is_said(tmp_path: Path, state: dict[str, str]) -> None:
    place = graded("solution", tmp_path, state)
    (place / EVIDENCE).unlink()
    for command in ("verify", "replay"):
        status, text = said(command, place, env=state)
        assert (status, "there is no evidence.json" in text) == (2, True), text
