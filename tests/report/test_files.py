"""Reports on disk: always complete, private, and never in another submission's folder."""

from __future__ import annotations

import hashlib
import json
import os
import re
import shutil
import stat
import subprocess
import threading
from collections.abc import Iterator
from pathlib import Path

import pytest

from grader.report.files import report_json, write_matrix, write_report
from grader.report.model import Report
from tests.report.samples import check, failing_report, report, report_at


def suffix(path: str | Path) -> str:
    """Return the eight hex digits that distinguish two submissions with the same name."""
    return hashlib.sha256(str(path).encode()).hexdigest()[:8]


def mode(path: Path) -> int:
    return stat.S_IMODE(path.lstat().st_mode)


@pytest.fixture
def open_umask() -> Iterator[None]:
    former = os.umask(0)
    yield
    os.umask(former)


def test_a_report_is_at_the_documented_path_and_is_read_back_equal(tmp_path: Path) -> None:
    marked = failing_report()
    written = write_report(marked, tmp_path / "reports", "anna")
    assert written == tmp_path / "reports" / "anna" / "jazzy" / "report.json"
    text = written.read_text(encoding="utf-8")
    assert Report.model_validate_json(text) == marked
    assert json.loads(text)["schema"] == 1
    assert text.endswith("}\n")


def test_a_report_is_readable_by_its_owner_only_and_ignored_by_git(
    tmp_path: Path, open_umask: None
) -> None:
    out = tmp_path / "deep" / "reports"
    written = write_report(report(), out, "anna")
    assert mode(written) == 0o600
    assert [mode(folder) for folder in (out, out / "anna", out / "anna" / "jazzy")] == [0o700] * 3
    assert (out / ".gitignore").read_text() == "*\n"
    assert sorted(path.name for path in written.parent.iterdir()) == ["report.json"]
    subprocess.run(["git", "init", "-q", tmp_path], check=True)
    status = subprocess.run(
        ["git", "-C", tmp_path, "status", "--porcelain"], capture_output=True, text=True, check=True
    )
    assert status.stdout == ""


def test_an_existing_folder_keeps_its_mode_and_gets_no_gitignore(tmp_path: Path) -> None:
    tmp_path.chmod(0o755)
    write_report(report(), tmp_path, "anna")
    assert mode(tmp_path) == 0o755
    assert [path.name for path in tmp_path.iterdir()] == ["anna"]


def test_a_students_folder_that_was_open_is_made_private(tmp_path: Path) -> None:
    (tmp_path / "anna" / "jazzy").mkdir(parents=True)
    for folder in (tmp_path / "anna", tmp_path / "anna" / "jazzy"):
        folder.chmod(0o777)
    (tmp_path / "anna" / "jazzy" / "report.json").write_text(report_json(report()))
    (tmp_path / "anna" / "jazzy" / "report.json").chmod(0o666)
    written = write_report(report(), tmp_path, "anna")
    assert written.parent == tmp_path / "anna" / "jazzy"
    assert (mode(written), mode(written.parent), mode(tmp_path / "anna")) == (0o600, 0o700, 0o700)


def test_the_same_submission_replaces_its_report_and_keeps_other_distros(tmp_path: Path) -> None:
    path = tmp_path / "submission"
    jazzy = write_report(report_at(path), tmp_path / "out", "anna")
    kilted = write_report(report_at(path, distro="kilted"), tmp_path / "out", "anna")
    again = write_report(report_at(path, message="again"), tmp_path / "out", "anna")
    assert again == jazzy
    assert kilted.parent.parent == jazzy.parent.parent
    assert json.loads(jazzy.read_text())["message"] == "again"


def test_two_submissions_with_the_same_name_have_two_folders(tmp_path: Path) -> None:
    first, second = tmp_path / "a" / "anna", tmp_path / "b" / "anna"
    out = tmp_path / "out"
    one = write_report(report_at(first), out, "anna")
    two = write_report(report_at(second), out, "anna")
    other_distro = write_report(report_at(second, distro="kilted"), out, "anna")
    assert one.parent.parent.name == "anna"
    assert two.parent.parent.name == f"anna-{suffix(second)}"
    assert other_distro.parent.parent == two.parent.parent
    assert json.loads(one.read_text())["submission"]["path"] == str(first)
    # each finds its own folder again, even if the first one is removed
    assert write_report(report_at(first), out, "anna") == one
    shutil.rmtree(one.parent.parent)
    assert write_report(report_at(second), out, "anna") == two


def test_a_submission_behind_a_link_is_the_same_submission(tmp_path: Path) -> None:
    (tmp_path / "real").mkdir()
    (tmp_path / "link").symlink_to("real")
    one = write_report(report_at(tmp_path / "real"), tmp_path / "out", "anna")
    assert write_report(report_at(tmp_path / "link"), tmp_path / "out", "anna") == one


def test_concurrent_submissions_with_the_same_name_have_a_folder_each(tmp_path: Path) -> None:
    paths = [tmp_path / str(number) for number in range(12)]
    written: dict[Path, Path] = {}

    def write(path: Path) -> None:
        for _ in range(3):
            written[path] = write_report(report_at(path), tmp_path / "out", "anna")

    threads = [threading.Thread(target=write, args=[path]) for path in paths]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(set(written.values())) == len(paths)
    for path, file in written.items():
        assert json.loads(file.read_text())["submission"]["path"] == str(path)


@pytest.mark.parametrize("content", ["", "{", "[]", '{"submission": 3}', "[" * 100_000])
def test_a_folder_with_an_unreadable_report_is_not_touched(tmp_path: Path, content: str) -> None:
    damaged = tmp_path / "anna" / "humble" / "report.json"
    damaged.parent.mkdir(parents=True)
    damaged.write_text(content)
    written = write_report(report_at("/s/anna"), tmp_path, "anna")
    assert written.parent.parent.name == f"anna-{suffix('/s/anna')}"
    assert damaged.read_text() == content


def test_reports_are_not_put_into_the_submission_itself(tmp_path: Path) -> None:
    submission = tmp_path / "anna"
    submission.mkdir()
    written = write_report(report_at(submission), tmp_path, "anna")
    assert written.parent.parent.name == f"anna-{suffix(submission)}"
    assert list(submission.iterdir()) == []


def test_a_long_name_leaves_space_for_the_digits(tmp_path: Path) -> None:
    name = "ü" * 127  # 254 bytes of the 255 that a name may have
    write_report(report_at("/s/1"), tmp_path, name)
    second = write_report(report_at("/s/2"), tmp_path, name)
    assert second.parent.parent.name.endswith(f"-{suffix('/s/2')}")


@pytest.mark.parametrize("name", ["", ".", "..", "a/b", "/etc", "a\0b"])
def test_an_invalid_file_name_is_refused(tmp_path: Path, name: str) -> None:
    with pytest.raises(ValueError, match="file name"):
        write_report(report(), tmp_path / "out", name)
    with pytest.raises(ValueError, match="file name"):
        write_report(report_at("/s", distro=name), tmp_path / "out", "anna")
    assert list(tmp_path.iterdir()) == []


def test_the_matrix_is_beside_the_reports_of_its_submission(tmp_path: Path) -> None:
    write_report(report_at("/s/1/anna"), tmp_path, "anna")
    broken = check("run.interrupt", "failed", mistakes=[{"id": "node.ignores_sigint"}])
    reports = [report_at("/s/2/anna", distro="humble"), report_at("/s/2/anna", distro="jazzy")]
    reports[1] = reports[1].model_copy(
        update={"checks": [broken if c.id == broken.id else c for c in reports[1].checks]}
    )
    files = [write_report(marked, tmp_path, "anna") for marked in reports]
    written = write_matrix(reports, tmp_path, "anna")
    assert written.name == "matrix.json"
    assert mode(written) == 0o600
    content = json.loads(written.read_text())
    assert [written.parent / total["report"] for total in content["distros"].values()] == files
    differing = [across for across in content["checks"] if across["differs"]]
    assert [across["id"] for across in differing] == ["run.interrupt"]
    cells = differing[0]["distros"]
    assert (cells["humble"]["status"], cells["jazzy"]["status"]) == ("passed", "failed")
    assert cells["jazzy"]["mistakes"] == [{"id": "node.ignores_sigint", "params": {}}]
    assert content["schema"] == 1


def test_only_reports_that_belong_together_make_a_matrix(tmp_path: Path) -> None:
    for wrong in (
        [],
        [report_at("/a"), report_at("/b", distro="kilted")],
        [report_at("/a"), report_at("/a")],
    ):
        with pytest.raises(ValueError, match="a matrix"):
            write_matrix(wrong, tmp_path / "out", "anna")
    assert not (tmp_path / "out").exists()


def test_the_file_is_json_without_control_characters_whatever_a_student_printed(
    tmp_path: Path,
) -> None:
    text = "\x1b[2J\x00\u202e\u2028 🤖 " + "x" * 100_000
    written = write_report(report_at("/s", evidence={"build_log": text, "transcript": text}),
                           tmp_path, "anna")  # fmt: skip
    raw = written.read_text(encoding="utf-8")
    assert json.loads(raw)["evidence"]["transcript"] == text
    assert not re.search(r"[\x00-\x09\x0b-\x1f]", raw)
