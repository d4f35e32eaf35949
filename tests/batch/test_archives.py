"""Submitted archives: their content is marked like a folder."""

from __future__ import annotations

import bz2
import gzip
import shutil
import subprocess
import tarfile
import zipfile
from pathlib import Path
from typing import TYPE_CHECKING, cast

import pytest

from grader.base.i18n.message import Message
from grader.package.intake.model import Submission
from grader.package.submission import take_in
from grader.verdict.checks.source import exec_bit
from grader.verdict.diagnose import Diagnosis
from grader.verdict.outcome import Failed
from tests.marking import ASSIGNMENT
from tests.marking_catalogue import MarkingCatalogue

from ..installed import installed
from ..static_bench import StandIn
from .archives import (
    NODE,
    NODE_PATH,
    PACKAGE,
    WINDOWS,
    hand_in,
    mode_of,
    notes,
    odd_member,
    package,
    take,
    tar_with,
    tarred,
    write,
    zip_of,
    zipped,
)

if TYPE_CHECKING:
    from grader.verdict.evidence import Evidence

TARS = [("w", "jane.tar"), ("w:gz", "jane.tgz"), ("w:xz", "jane.tar.xz"), ("w:bz2", "jane.tar.bz2")]


def is_the_package(found: Submission, root: str) -> None:
    """Assert that this is the complete package of `package()`, with the node's exec bit set."""
    assert (found.problem, found.root) == ("", root)
    assert {f.path: f.data for f in found.files if f.kind == "file"} == package()
    assert found.modes == "recorded"
    node = found.file(NODE_PATH)
    assert node is not None
    assert node.mode == 0o755
    assert not found.notes


@pytest.mark.parametrize("below", ["", PACKAGE, f"ws/src/{PACKAGE}"])
@pytest.mark.parametrize(("mode", "name"), TARS)
def test_a_tar_is_read_with_any_compression(
    tmp_path: Path, mode: str, name: str, below: str
) -> None:
    found = hand_in(tmp_path, tarred(package(below=below), mode), name)
    is_the_package(found, below or ".")
    assert (found.origin, found.name) == ("tar", "jane")


@pytest.mark.parametrize("below", ["", f"ws/src/{PACKAGE}"])
def test_a_zip_made_on_unix_keeps_its_modes(tmp_path: Path, below: str) -> None:
    found = hand_in(tmp_path, zipped(package(below=below)))
    is_the_package(found, below or ".")
    assert (found.origin, found.name) == ("zip", "jane")


@pytest.mark.parametrize("name", ["jane.tar.gz", "jane.pdf", "jane"])
def test_the_archive_type_is_detected_by_content_not_by_name(tmp_path: Path, name: str) -> None:
    is_the_package(hand_in(tmp_path, zipped(package()), name), ".")


def test_archives_of_info_zip_and_gnu_tar_have_the_hash_of_the_folder(tmp_path: Path) -> None:
    """The same package has one hash in a folder, a zip and a tar."""
    folder = write(tmp_path / "jane" / PACKAGE, package())
    (folder / "setup_link").symlink_to("setup.py")
    (folder / "empty").mkdir()
    above = folder.parent
    for command in (
        [str(installed("zip", "zip")), "-qry", "../jane.zip", PACKAGE],
        ["tar", "-czf", "../jane.tar.gz", PACKAGE],
        ["tar", "--format=v7", "-cf", "../old.tar", PACKAGE],
    ):
        subprocess.run(command, cwd=above, check=True)
    by_folder = take(above)
    assert by_folder.origin == "directory"
    for name in ("jane.zip", "jane.tar.gz", "old.tar"):
        found = take(tmp_path / name)
        assert found.sha256 == by_folder.sha256
        assert found.files == by_folder.files
    (folder / NODE_PATH).chmod(0o644)
    subprocess.run(
        [str(installed("zip", "zip")), "-qry", "../other.zip", PACKAGE], cwd=above, check=True
    )
    other = take(tmp_path / "other.zip")
    assert other.sha256 != by_folder.sha256
    assert other.sha256 == take(above).sha256


def test_a_hard_link_is_read_as_a_copy_of_its_file(tmp_path: Path) -> None:
    odd = odd_member("copy.py", tarfile.LNKTYPE, "setup.py")
    found = hand_in(tmp_path, tar_with(odd))
    copy = found.file("copy.py")
    assert copy is not None
    assert copy.data == package()["setup.py"]


# exec bits


def test_a_zip_made_on_windows_has_unknown_exec_bits(tmp_path: Path) -> None:
    found = hand_in(tmp_path, zipped(package(), system=WINDOWS))
    assert found.modes == "unknown"
    assert not found.problem
    without = {path: data for path, data in package().items() if path != NODE_PATH}
    assert found.sha256 != hand_in(tmp_path, zipped(without)).sha256


def test_unknown_and_missing_exec_bits_have_different_hashes(tmp_path: Path) -> None:
    """They are marked differently, so one verdict must not be reused for the other."""
    folder = write(tmp_path / "jane", package())
    (folder / NODE_PATH).chmod(0o644)
    found = hand_in(tmp_path, zipped(package(), system=WINDOWS), "windows.zip")
    assert found.sha256 != take(folder).sha256
    assert take(folder, modes_kept=False).modes == "unknown"
    assert take(folder, modes_kept=False).sha256 == found.sha256


def test_exec_bits_are_known_in_the_zip_that_github_makes(tmp_path: Path) -> None:
    """`git archive` sets "made by Unix" only on executable files, and names the commit."""
    repository = write(tmp_path / "repository", package())
    commit = ["-c", "user.name=j", "-c", "user.email=j@x", "commit", "-qm", "x"]
    for words in (["init", "-q"], ["add", "."], commit, ["archive", "-o", "../jane.zip", "HEAD"]):
        subprocess.run(["git", *words], cwd=repository, check=True)
    is_the_package(take(tmp_path / "jane.zip"), ".")
    (repository / NODE_PATH).chmod(0o644)
    for words in (["add", "."], commit, ["archive", "-o", "../jane.zip", "HEAD"]):
        subprocess.run(["git", *words], cwd=repository, check=True)
    found = take(tmp_path / "jane.zip")
    node = found.file(NODE_PATH)
    assert node is not None
    assert (found.modes, node.mode) == ("recorded", 0o644)


def test_a_windows_zip_of_a_checkout_takes_exec_bits_from_the_git_index(tmp_path: Path) -> None:
    repository = write(tmp_path / "repository", package())
    for words in (["init", "-q"], ["add", "."], ["config", "core.fileMode", "false"]):
        subprocess.run(["git", *words], cwd=repository, check=True)
    files = {
        path.relative_to(repository).as_posix(): path.read_bytes()
        for path in repository.rglob("*")
        if path.is_file()
    }
    found = hand_in(tmp_path, zipped(files, system=WINDOWS))
    node = found.file(NODE_PATH)
    assert node is not None
    assert (found.modes, node.mode, found.origin) == ("recorded", 0o755, "zip")
    assert found.sha256 == take(repository).sha256


def test_the_assignments_policy_decides_what_unknown_exec_bits_cost(tmp_path: Path) -> None:
    submission = hand_in(tmp_path, zipped(package(), system=WINDOWS))
    passed = exec_bit.function(cast("Evidence", StandIn(ASSIGNMENT, submission)))
    assert passed is not None
    assert "unknown" in passed.actual
    assert passed.advice
    strict = ASSIGNMENT.model_copy(update={"modes": "require"})
    with pytest.raises(Failed) as caught:
        exec_bit.function(cast("Evidence", StandIn(strict, submission)))
    assert caught.value.mistake.id == "source.exec_bit_unknown"
    assert "tar" in Diagnosis.of(caught.value).fix


# files that tools and operating systems add


def test_files_that_macos_adds_are_left_out_and_noted(tmp_path: Path) -> None:
    extra = {
        f"__MACOSX/{PACKAGE}/._setup.py": b"x",
        f"{PACKAGE}/.DS_Store": b"x",
        f"{PACKAGE}/._package.xml": b"x",
        f"{PACKAGE}/{PACKAGE}/__pycache__/a.pyc": b"x",
    }
    found = hand_in(tmp_path, zipped({**package(below=PACKAGE), **extra}))
    assert {f.path for f in found.files if f.kind == "file"} == set(package())
    for name in ("__MACOSX/", ".DS_Store"):
        assert name in notes(found)


def test_backslashes_in_a_windows_zip_separate_folders(tmp_path: Path) -> None:
    files = {path.replace("/", "\\"): data for path, data in package(below=PACKAGE).items()}
    found = hand_in(tmp_path, zipped(files, system=WINDOWS))
    assert found.root == PACKAGE
    assert found.file(NODE_PATH) is not None
    assert "backslashes" in notes(found)


def test_names_in_code_page_437_and_in_unflagged_utf8_are_read(tmp_path: Path) -> None:
    """zipfile sets the UTF-8 flag on non-ASCII names, so the test clears it."""
    made = zipped({**package(), "grüße.txt": b"x"})
    unmarked = bytearray(made)
    for start, flags in ((b"PK\x03\x04", 6), (b"PK\x01\x02", 8)):
        at = unmarked.find(start)
        while at >= 0:
            unmarked[at + flags + 1] &= ~0x08
            at = unmarked.find(start, at + 4)
    found = hand_in(tmp_path, bytes(unmarked))
    assert found.file("grüße.txt") is not None
    assert not found.notes
    old = bytes(unmarked).replace("grüße.txt".encode(), b"gr\x81\xe1e___.txt"[:11])
    found = hand_in(tmp_path, old)
    assert any(f.path.startswith("grüße") for f in found.files)
    assert "code page 437" in notes(found)


def test_a_tar_name_that_is_not_utf8_is_left_out_and_noted(tmp_path: Path) -> None:
    odd = tar_with(files={**package(), "gr_sse.txt": b"x"}).replace(b"gr_sse.txt", b"gr\xfcsse.tx")
    fixed = bytearray(odd)
    at = fixed.find(b"gr\xfcsse.tx")
    fixed[at + 148 : at + 156] = b"        "
    fixed[at + 148 : at + 156] = b"%06o\0 " % sum(fixed[at : at + 512])
    found = hand_in(tmp_path, bytes(fixed), "jane.tar")
    assert found.root == "."
    assert "not plain UTF-8" in notes(found)
    assert all(line.isprintable() for line in found.notes)


def test_of_a_duplicate_name_the_last_file_counts_and_it_is_noted(tmp_path: Path) -> None:
    pairs = [(zipfile.ZipInfo(p), d) for p, d in package().items()]
    with pytest.warns(UserWarning, match="Duplicate"):
        data = zip_of([*pairs, (zipfile.ZipInfo(NODE_PATH), b"second")])
    found = hand_in(tmp_path, data)
    node = found.file(NODE_PATH)
    assert node is not None
    assert node.data == b"second"
    assert f"twice in the archive: the last one was used: {NODE_PATH}" in notes(found)


def test_names_that_differ_only_in_case_are_both_kept_and_noted(tmp_path: Path) -> None:
    found = hand_in(tmp_path, zipped({**package(), "Setup.py": b"other"}))
    assert found.file("setup.py") != found.file("Setup.py")
    assert "differ only in case" in notes(found)
    assert "Setup.py" in notes(found)


# archives in archives and in folders


@pytest.mark.parametrize("packed", [1, 2, 3])
def test_an_archive_in_an_archive_is_opened(tmp_path: Path, packed: int) -> None:
    data = tarred(package(below=PACKAGE), "w:gz")
    for depth in range(packed):
        data = zipped({f"week/inner{depth}.zip": data})
    found = hand_in(tmp_path, data)
    assert not found.problem
    assert found.root is not None
    assert found.root.endswith(f".zip/{PACKAGE}")
    assert (found.modes, found.origin) == ("recorded", "tar")
    assert found.sha256 == take(write(tmp_path / "folder", package())).sha256


def test_archives_nested_too_deeply_are_a_mistake(tmp_path: Path) -> None:
    data = zipped(package())
    for _ in range(6):
        data = zipped({"again.zip": data})
    found = hand_in(tmp_path, data)
    assert found.problem_mistake == "package.archive_nested"


def test_a_folder_that_holds_only_an_archive_is_opened(tmp_path: Path) -> None:
    """Moodle's download has such a folder for each student, with the zip in it."""
    (tmp_path / "Ann_1_assignsubmission_file").mkdir()
    found = hand_in(tmp_path / "Ann_1_assignsubmission_file", zipped(package()), "hw.zip")
    assert take(tmp_path / "Ann_1_assignsubmission_file").root == "hw.zip"
    assert take(tmp_path / "Ann_1_assignsubmission_file").sha256 == found.sha256


def test_an_archive_beside_a_package_is_not_opened(tmp_path: Path) -> None:
    write(tmp_path / "jane" / "src" / PACKAGE, package())
    found = hand_in(tmp_path / "jane", b"PK\x03\x04 broken", "old.zip")
    assert found.problem_mistake == "package.archive_corrupt"
    assert take(tmp_path / "jane").root == f"src/{PACKAGE}"


def test_a_broken_archive_in_a_folder_is_reported(tmp_path: Path) -> None:
    (tmp_path / "jane").mkdir()
    hand_in(tmp_path / "jane", zipped(package())[:300], "hw.zip")
    found = take(tmp_path / "jane")
    assert found.problem_mistake == "package.archive_corrupt"
    assert "hw.zip" in found.problem


def test_two_archives_with_the_package_are_ambiguous(tmp_path: Path) -> None:
    (tmp_path / "jane").mkdir()
    for name in ("first.zip", "second.zip"):
        hand_in(tmp_path / "jane", zipped(package()), name)
    found = take(tmp_path / "jane")
    assert found.problem_mistake == "package.duplicate"
    assert "first.zip" in found.problem


def test_an_office_document_is_not_opened_as_a_zip(tmp_path: Path) -> None:
    (tmp_path / "jane").mkdir()
    hand_in(tmp_path / "jane", zipped({"word/document.xml": b"x"}), "report.docx")
    found = take(tmp_path / "jane")
    assert found.problem_mistake == "package.no_manifest"
    assert "report.docx" in found.problem


# files that are not archives, or cannot be opened


@pytest.mark.parametrize(
    ("data", "name", "mistake", "words"),
    [
        (zipped(package())[:-30], "a.zip", "package.archive_corrupt", "a.zip"),
        (zipped(package())[:200], "a.zip", "package.archive_corrupt", "damaged"),
        (tarred(package(), "w:gz")[:-20], "a.tgz", "package.archive_corrupt", "damaged"),
        (tarred(package(), "w:xz")[:-20], "a.txz", "package.archive_corrupt", "damaged"),
        (tarred(package(), "w:bz2")[:-20], "a.tbz", "package.archive_corrupt", "damaged"),
        (tarred(package())[:3000], "a.tar", "package.archive_corrupt", "damaged"),
        (b"", "a.zip", "package.archive_corrupt", "is not one"),
        (b"<html>Sign in</html>", "a.zip", "package.archive_corrupt", "is not one"),
        (gzip.compress(b"x = 1\n" * 200), "a.gz", "package.archive_unsupported", "a single file"),
        (bz2.compress(b"x = 1\n" * 200), "a.bz2", "package.archive_unsupported", "a single file"),
        (b"Rar!\x1a\x07\x01\x00" + bytes(99), "a.rar", "package.archive_unsupported", "RAR"),
        (b"7z\xbc\xaf\x27\x1c" + bytes(99), "a.7z", "package.archive_unsupported", "7z"),
        (b"Rar!\x1a\x07\x01\x00" + bytes(99), "a.zip", "package.archive_unsupported", "RAR"),
        (zipped({}), "a.zip", "package.archive_empty", "is empty"),
        (tarred({}), "a.tar", "package.archive_empty", "is empty"),
        (tarred({}, "w:gz"), "a.tgz", "package.archive_empty", "is empty"),
        (zipped({"notes.txt": b"x"}), "a.zip", "package.no_manifest", "notes.txt"),
        (zipped({NODE: b"x"}), "a.zip", "package.only_node", NODE),
    ],
    # explicit ids: an archive may contain the time of its creation, and a test id must not
    ids=lambda value: value[:4].hex() if isinstance(value, bytes) else None,
)
def test_an_archive_that_cannot_be_opened_is_a_mistake_with_a_fix(
    tmp_path: Path, data: bytes, name: str, mistake: str, words: str
) -> None:
    found = hand_in(tmp_path, data, name)
    assert (found.root, found.problem_mistake) == (None, mistake)
    assert words in found.problem
    assert found.problem_fix
    assert len(found.sha256) == 64
    assert found.name == "a"


def test_why_an_archive_is_damaged_can_be_translated(tmp_path: Path) -> None:
    found = hand_in(tmp_path, tarred(package(), "w:xz")[:-20], "a.txz")
    assert isinstance(found.problem, Message)
    assert "<it ends in the middle>" in found.problem.translated(MarkingCatalogue())


def test_two_different_broken_archives_have_different_hashes(tmp_path: Path) -> None:
    first = hand_in(tmp_path, zipped(package())[:200])
    assert first.sha256 == hand_in(tmp_path, zipped(package())[:200], "john.zip").sha256
    assert first.sha256 != hand_in(tmp_path, zipped(package())[:201]).sha256


def test_a_damaged_byte_in_the_middle_is_detected(tmp_path: Path) -> None:
    for data, name in ((zipped(package()), "a.zip"), (tarred(package(), "w:gz"), "a.tgz")):
        broken = bytearray(data)
        at = data.find(b"PK\x03\x04", 10) + 30 if name == "a.zip" else len(data) // 2
        broken[at : at + 6] = b"\xff" * 6
        assert hand_in(tmp_path, bytes(broken), name).problem_mistake == "package.archive_corrupt"
    lost = bytearray(tarred(package()))
    lost[1024:1536] = b"x" * 512  # the second header
    assert hand_in(tmp_path, bytes(lost), "a.tar").problem_mistake == "package.archive_corrupt"


def test_a_zip_with_a_password_is_reported(tmp_path: Path) -> None:
    write(tmp_path / PACKAGE, package())
    words = [str(installed("zip", "zip")), "-qr", "-P", "secret", "jane.zip", PACKAGE]
    subprocess.run(words, cwd=tmp_path, check=True)
    found = take(tmp_path / "jane.zip")
    assert found.problem_mistake == "package.archive_encrypted"
    assert "password" in found.problem


@pytest.mark.parametrize("method", [zipfile.ZIP_BZIP2, zipfile.ZIP_LZMA])
def test_an_unsupported_zip_compression_is_named(tmp_path: Path, method: int) -> None:
    with zipfile.ZipFile(tmp_path / "jane.zip", "w", method) as archive:
        for path, data in package().items():
            archive.writestr(path, data)
    found = take(tmp_path / "jane.zip")
    assert found.problem_mistake == "package.archive_unsupported"


def test_an_archive_is_read_without_writing_to_disk(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Small archives are never written to disk, so a killed run leaves nothing."""
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path / "nowhere"))
    is_the_package(hand_in(tmp_path, tarred(package(), "w:xz"), "jane.tar.xz"), ".")


def test_the_students_name_comes_from_the_archive_or_from_its_folder(
    tmp_path: Path,
) -> None:
    (tmp_path / "jane").mkdir()
    assert hand_in(tmp_path / "jane", zipped(package()), f"{PACKAGE}.zip").name == "jane"
    assert hand_in(tmp_path, zipped(package()), "Jane Doe.tar.gz").name == "Jane_Doe"


def test_the_solution_in_an_archive_equals_the_solution_in_a_folder(tmp_path: Path) -> None:
    solution = Path("grader/keys/hello_time/solution")
    packed = shutil.make_archive(str(tmp_path / "jane"), "gztar", solution)
    by_folder = take_in(solution, package=PACKAGE, node_file=NODE)
    found = take(Path(packed))
    assert found.sha256 == by_folder.sha256
    assert mode_of(NODE) == 0o755
    assert found.file(NODE_PATH) == by_folder.file(NODE_PATH)
