"""The files of a class: all there, whole, for their owner only, and never half of them."""

from __future__ import annotations

import dataclasses
import stat
from pathlib import Path

import pytest
from hypothesis import HealthCheck
from hypothesis import given
from hypothesis import settings
from hypothesis import strategies as st

from grader.batch.model import ClassResult
from grader.errors import SurroundingsError
from grader.errors import UsageError
from grader.gradebook.outputs import write_outputs
from tests.gradebook.test_canvas import POSSIBLE
from tests.gradebook.test_canvas import export
from tests.gradebook.test_canvas import student
from tests.gradebook.test_moodle_worksheet import english
from tests.gradebook.texts import hostile_class
from tests.gradebook.texts import texts


def files(out: Path) -> set[Path]:
    return {path for path in out.rglob("*") if path.is_file()}


def test_every_file_is_written_and_returned(mixed: ClassResult, tmp_path: Path) -> None:
    (tmp_path / "worksheet.csv").write_bytes(english(*range(23)))
    (tmp_path / "canvas.csv").write_bytes(export(POSSIBLE, *(student(n) for n in range(24))))
    said: list[str] = []
    out = tmp_path / "new" / "out"
    written = write_outputs(
        dataclasses.replace(mixed, title="Hello time"),
        out,
        worksheet=tmp_path / "worksheet.csv",
        canvas=tmp_path / "canvas.csv",
        canvas_column="4711",
        say=said.append,
    )
    assert set(written) == files(out)
    names = {path.name for path in written if path.parent == out}
    assert names == {
        "gradebook.csv",
        "junit.xml",
        "moodle-worksheet.csv",
        "moodle-gradebook.csv",
        "canvas-gradebook.csv",
    }
    for entry in mixed.entries:
        for ending in ("md", "html"):
            assert (out / "feedback" / f"{entry.student.key}.{ending}") in written
    assert any(mixed.entries[23].student.name in text for text in said)
    assert (tmp_path / "worksheet.csv").read_bytes() == english(*range(23)), "theirs is untouched"


def test_only_the_owner_can_read_them(mixed: ClassResult, tmp_path: Path) -> None:
    out = tmp_path / "out"
    for path in [out, *(write_outputs(mixed, out)), out / "feedback"]:
        assert stat.S_IMODE(path.stat().st_mode) & 0o077 == 0, path


def test_the_same_result_gives_the_same_bytes(mixed: ClassResult, tmp_path: Path) -> None:
    first = {p.name: p.read_bytes() for p in write_outputs(mixed, tmp_path / "a")}
    assert first == {p.name: p.read_bytes() for p in write_outputs(mixed, tmp_path / "b")}


def test_nothing_is_written_if_the_worksheet_is_refused(mixed: ClassResult, tmp_path: Path) -> None:
    worksheet = tmp_path / "worksheet.csv"
    worksheet.write_bytes(english(*range(24), maximum="10.00"))
    with pytest.raises(UsageError):
        write_outputs(mixed, tmp_path / "out", worksheet=worksheet)
    with pytest.raises(UsageError, match="cannot be read"):
        write_outputs(mixed, tmp_path / "out", canvas=tmp_path / "none.csv")
    assert not (tmp_path / "out").exists()


def test_a_link_in_the_way_is_not_followed(mixed: ClassResult, tmp_path: Path) -> None:
    out, theirs = tmp_path / "out", tmp_path / "theirs"
    out.mkdir()
    theirs.mkdir()
    (theirs / "file").write_text("kept")
    (out / "gradebook.csv").symlink_to(theirs / "file")
    (out / "feedback").symlink_to(theirs)
    with pytest.raises(SurroundingsError):
        write_outputs(mixed, out)
    assert (theirs / "file").read_text() == "kept"
    assert files(theirs) == {theirs / "file"}


@settings(
    max_examples=25, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture]
)
@given(found=st.lists(texts, min_size=1, max_size=3))
def test_hostile_keys_give_safe_file_names(found: list[str], tmp_path: Path) -> None:
    result = hostile_class(*found)
    keys = [f"{text}{n}" for n, text in enumerate(found)]
    entries = [
        dataclasses.replace(entry, student=dataclasses.replace(entry.student, key=key))
        for entry, key in zip(result.entries, keys, strict=True)
    ]
    out = tmp_path / "out"
    written = write_outputs(dataclasses.replace(result, entries=tuple(entries)), out)
    feedback = [path for path in written if path.parent.name == "feedback"]
    assert len(set(feedback)) == 2 * len(keys)
    for path in written:
        assert path.resolve().is_relative_to(out)
        assert path.name.isascii()
