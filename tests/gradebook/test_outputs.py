"""The output files of a class: complete, readable by their owner only, never partial."""

from __future__ import annotations

import dataclasses
import stat
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from grader.base.errors import SurroundingsError, UsageError
from grader.batch.model import ClassResult
from grader.batch.systems.canvas.write import read_gradebook
from grader.batch.systems.moodle.worksheet import read_worksheet
from grader.publish import gradebooks as outputs
from grader.publish.gradebooks import write_outputs
from grader.publish.written import raise_failures
from tests.gradebook.hostile_texts import hostile_class, texts
from tests.gradebook.test_canvas import POSSIBLE, export, student
from tests.gradebook.test_moodle_worksheet import english


def files(out: Path) -> set[Path]:
    return {path for path in out.rglob("*") if path.is_file()}


def test_every_file_is_written_and_returned(mixed: ClassResult, tmp_path: Path) -> None:
    messages: list[str] = []
    out = tmp_path / "new" / "out"
    written = write_outputs(
        dataclasses.replace(mixed, title="Hello time"),
        out,
        sheets={
            "moodle-worksheet.csv": read_worksheet(english(*range(23))),
            "canvas-gradebook.csv": read_gradebook(
                export(POSSIBLE, *(student(n) for n in range(24))), column="4711"
            ),
        },
        notify=messages.append,
    ).files
    assert set(written) == files(out)
    names = {path.name for path in written if path.parent == out}
    assert names == {
        "gradebook.csv",
        "junit.xml",
        "by-hand.csv",
        "feedback.csv",
        "moodle-feedback.zip",
        "moodle-worksheet.csv",
        "moodle-gradebook.csv",
        "canvas-gradebook.csv",
    }
    for entry in mixed.entries:
        for ending in ("md", "html"):
            found = [path for path in written if path.suffix == f".{ending}"]
            (page,) = [
                path
                for path in found
                if path.stem.endswith(f"_{entry.student.id_number or entry.student.key}")
            ]
            assert page.parent == out / "feedback"
            assert page.stem.startswith(entry.student.name.split()[0])
    assert any(mixed.entries[23].student.name in text for text in messages)


def test_only_the_owner_can_read_them(mixed: ClassResult, tmp_path: Path) -> None:
    out = tmp_path / "out"
    for path in [out, *write_outputs(mixed, out).files, out / "feedback"]:
        assert stat.S_IMODE(path.stat().st_mode) & 0o077 == 0, path


def test_the_same_result_gives_the_same_bytes(mixed: ClassResult, tmp_path: Path) -> None:
    first = {p.name: p.read_bytes() for p in write_outputs(mixed, tmp_path / "a").files}
    assert first == {p.name: p.read_bytes() for p in write_outputs(mixed, tmp_path / "b").files}


def test_the_other_outputs_are_written_if_one_is_refused(
    mixed: ClassResult, tmp_path: Path
) -> None:
    worksheet = read_worksheet(english(*range(24), maximum="10.00"))
    refused = write_outputs(mixed, tmp_path / "some", sheets={"moodle-worksheet.csv": worksheet})
    assert [type(failure) for failure in refused.failures] == [UsageError]
    whole = write_outputs(mixed, tmp_path / "all")
    assert not whole.failures
    names = {path.relative_to(tmp_path / "all") for path in whole.files}
    assert {path.relative_to(tmp_path / "some") for path in refused.files} == names
    with pytest.raises(UsageError, match="more points") as caught:
        raise_failures(refused.failures)
    assert "All other files were written" in caught.value.remedy


def test_a_failing_output_does_not_prevent_the_others(
    mixed: ClassResult, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def broken(result: ClassResult, *, bom: bool) -> bytes:
        raise KeyError(bom)

    monkeypatch.setattr(outputs, "gradebook_csv", broken)
    written = write_outputs(mixed, tmp_path)
    assert (tmp_path / "junit.xml").is_file()
    assert len(list((tmp_path / "feedback").iterdir())) == 2 * len(mixed.entries)
    with pytest.raises(KeyError):  # it is reported with its traceback
        raise_failures(written.failures)


def test_a_link_at_the_output_path_is_not_followed(mixed: ClassResult, tmp_path: Path) -> None:
    out, theirs = tmp_path / "out", tmp_path / "theirs"
    out.mkdir()
    theirs.mkdir()
    (theirs / "file").write_text("kept")
    (out / "gradebook.csv").symlink_to(theirs / "file")
    (out / "feedback").symlink_to(theirs)
    failures = write_outputs(mixed, out).failures
    with pytest.raises(SurroundingsError) as caught:
        raise_failures(failures)
    assert caught.value.message.count("feedback") < 10, "told once, and not for each student"
    assert (theirs / "file").read_text() == "kept"
    assert files(theirs) == {theirs / "file"}
    assert (out / "junit.xml").is_file()


@settings(max_examples=25, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(found=st.lists(texts, min_size=1, max_size=3))
def test_hostile_keys_give_safe_file_names(found: list[str], tmp_path: Path) -> None:
    result = hostile_class(*found)
    keys = [f"{text}{n}" for n, text in enumerate(found)]
    entries = [
        dataclasses.replace(entry, student=dataclasses.replace(entry.student, key=key))
        for entry, key in zip(result.entries, keys, strict=True)
    ]
    out = tmp_path / "out"
    written = write_outputs(dataclasses.replace(result, entries=tuple(entries)), out).files
    feedback = [path for path in written if path.parent.name == "feedback"]
    assert len(set(feedback)) == 2 * len(keys)
    for path in written:
        assert path.resolve().is_relative_to(out)
        assert path.name.isprintable()
        assert not set(path.name) & set('/\\:*?"<>| ')
