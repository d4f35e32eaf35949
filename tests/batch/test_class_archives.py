"""The archive of a whole class: unpacked once; hostile members affect only their own student."""

from __future__ import annotations

import io
import os
import signal
import stat
import struct
import subprocess
import sys
import tarfile
import zipfile
from pathlib import Path

import pytest

from grader.base.errors import SurroundingsError, UsageError
from grader.batch.discover import discover
from grader.batch.model import ClassFolder, HandedIn
from grader.package.intake.archive_limits import ArchiveLimits
from tests.installed import installed

from .archives import (
    PACKAGE,
    WINDOWS,
    everything_below,
    odd_member,
    package,
    take,
    tar_with,
    tarred,
    write,
    zip_of,
    zipped,
)


def two(**more: bytes) -> dict[str, bytes]:
    """Return a class of Ann and Joe, and other files."""
    return {**package(below="ann/ws"), **package(below="joe/ws"), **more}


def found_in(tmp_path: Path, data: bytes, name: str = "class.zip") -> ClassFolder:
    (tmp_path / name).write_bytes(data)
    return discover(tmp_path / name, unpack=tmp_path / "work")


def submission_of(folder: ClassFolder, key: str) -> HandedIn:
    (found,) = [given for given in folder.handed_in if given.student.key == key]
    return found


def notes_of(thing: ClassFolder | HandedIn) -> str:
    return "\n".join(thing.notes)


def are_marked(folder: ClassFolder, *keys: str) -> None:
    for key in keys:
        given = submission_of(folder, key)
        assert not given.problem
        found = take(given.path, modes_kept=given.modes_kept)
        assert found.problem == ""
        assert {f.path: f.data for f in found.files if f.kind == "file"} == package()


@pytest.mark.parametrize("top", ["", "hw1/", "hw1/all/"])
@pytest.mark.parametrize("kind", ["zip", "tar", "tar.gz", "tar.xz"])
def test_a_class_in_an_archive_is_discovered(tmp_path: Path, kind: str, top: str) -> None:
    files = {f"{top}{path}": data for path, data in two().items()}
    files[f"{top}kim.zip"] = zipped(package())
    mode = {"tar": "w"}.get(kind, f"w:{kind[4:]}")
    data = zipped(files) if kind == "zip" else tarred(files, mode)
    found = found_in(tmp_path, data, f"class.{kind}")
    assert found.path == tmp_path / f"class.{kind}"
    assert submission_of(found, "kim").path.name == "kim.zip"
    are_marked(found, "ann", "joe", "kim")


def test_an_archive_is_unpacked_only_once(tmp_path: Path) -> None:
    first = found_in(tmp_path, zipped(two()))
    before = (submission_of(first, "ann").path / "ws" / "setup.py").stat().st_ino
    again = found_in(tmp_path, zipped(two()), "renamed.zip")
    assert [given.path for given in again.handed_in] == [given.path for given in first.handed_in]
    assert (submission_of(again, "ann").path / "ws" / "setup.py").stat().st_ino == before
    other = found_in(tmp_path, zipped(two(**{"ann/ws/setup.py": b"changed"})))
    assert submission_of(other, "ann").path != submission_of(first, "ann").path


def test_unpacked_files_are_readable_by_their_owner_only(tmp_path: Path) -> None:
    found = found_in(tmp_path, zipped(two()))
    for path in (tmp_path / "work", *(tmp_path / "work").iterdir()):
        assert stat.S_IMODE(path.stat().st_mode) & 0o077 == 0
    assert submission_of(found, "ann").path.is_relative_to(tmp_path / "work")


def test_unpacking_resumes_after_a_kill(tmp_path: Path) -> None:
    (tmp_path / "class.zip").write_bytes(zipped(two()))
    script = (
        "import os, sys; from pathlib import Path\n"
        "from grader.batch import unpack\n"
        "from grader.batch.discover import discover\n"
        "real = unpack.ClassWriter.add\n"
        "def add(self, member):\n"
        "    real(self, member)\n"
        "    if member.name.startswith('joe'): os.kill(os.getpid(), 9)\n"
        "unpack.ClassWriter.add = add\n"
        "discover(Path(sys.argv[1]), unpack=Path(sys.argv[2]))\n"
    )
    words = [sys.executable, "-c", script, str(tmp_path / "class.zip"), str(tmp_path / "work")]
    assert subprocess.run(words, check=False).returncode == -signal.SIGKILL
    left = everything_below(tmp_path / "work")
    assert any(path.endswith("ann/ws/setup.py") for path in left)
    found = discover(tmp_path / "class.zip", unpack=tmp_path / "work")
    are_marked(found, "ann", "joe")
    assert not [path for path in everything_below(tmp_path / "work") if ".part" in path]


def test_an_altered_record_of_unpacking_unpacks_again(tmp_path: Path) -> None:
    found_in(tmp_path, zipped(two()))
    (record,) = (tmp_path / "work").glob("*/unpacked.json")
    other = '{"form": 0, "remarks": [["ann", "of old"]], "modes_recorded": true}'
    for text in ("", "[]", '{"form": 1, "remarks": 5, "modes_recorded": 1}', other):
        record.write_text(text)
        found = found_in(tmp_path, zipped(two()))
        are_marked(found, "ann", "joe")
        assert not notes_of(submission_of(found, "ann"))


def test_a_class_zip_made_on_windows_has_unknown_exec_bits(tmp_path: Path) -> None:
    found = found_in(tmp_path, zipped(two(), system=WINDOWS))
    assert [given.modes_kept for given in found.handed_in] == [False, False]


# hostile members


@pytest.mark.parametrize(
    "name", ["../evil", "/etc/evil", "ann/../../evil", "C:\\evil", "ann\\..\\..\\e"]
)
def test_a_member_outside_the_folder_is_left_out_and_reported(tmp_path: Path, name: str) -> None:
    before = everything_below(tmp_path)
    members = [(zipfile.ZipInfo(path), data) for path, data in two().items()]
    found = found_in(tmp_path, zip_of([*members, (zipfile.ZipInfo(name), b"evil")]))
    made = everything_below(tmp_path) - before
    assert not [path for path in made if "evil" in path]
    assert not Path("/etc/evil").exists()
    assert "leads out" in notes_of(found) + notes_of(submission_of(found, "ann"))
    are_marked(found, "ann", "joe")
    by_tar = found_in(tmp_path, tarred({**two(), name.replace("\\", "/"): b"evil"}), "class.tar")
    assert "leads out" in notes_of(by_tar) + notes_of(submission_of(by_tar, "ann"))
    are_marked(by_tar, "ann", "joe")


@pytest.mark.parametrize(
    "kind", [tarfile.SYMTYPE, tarfile.LNKTYPE, tarfile.CHRTYPE, tarfile.BLKTYPE, tarfile.FIFOTYPE]
)
def test_links_devices_and_pipes_are_never_created(tmp_path: Path, kind: bytes) -> None:
    odd = [
        odd_member("ann/ws/way", kind, "/etc"),
        odd_member("ann/ws/way/passwd", tarfile.REGTYPE),
        odd_member("eve", kind, "/etc"),
    ]
    found = found_in(tmp_path, tar_with(*odd, files=two()), "class.tar")
    for path in (tmp_path / "work").rglob("*"):
        assert path.is_dir() or path.is_file()
        assert not path.is_symlink()
    assert "ann/ws/way" in notes_of(submission_of(found, "ann"))
    assert "not unpacked" in submission_of(found, "eve").problem
    assert not notes_of(submission_of(found, "joe"))
    are_marked(found, "joe")


def test_a_hard_link_becomes_a_copy_of_its_file(tmp_path: Path) -> None:
    odd = odd_member("ann/ws/copy.py", tarfile.LNKTYPE, "ann/ws/setup.py")
    found = found_in(tmp_path, tar_with(odd, files=two()), "class.tar")
    copy = submission_of(found, "ann").path / "ws" / "copy.py"
    assert copy.read_bytes() == package()["setup.py"]
    assert copy.stat().st_nlink == 1


def test_a_damaged_file_affects_only_its_student(tmp_path: Path) -> None:
    """Other students are complete, and a student whose archive is damaged is still listed."""
    files = {**two(), "kim.zip": os.urandom(300), "max/ws/setup.py": os.urandom(300)}
    data = bytearray(zipped(files))
    with zipfile.ZipFile(io.BytesIO(bytes(data))) as archive:
        for name in ("kim.zip", "max/ws/setup.py"):
            at = archive.getinfo(name).header_offset + 30 + len(name) + 20
            data[at : at + 4] = bytes(byte ^ 0xFF for byte in data[at : at + 4])
    found = found_in(tmp_path, bytes(data))
    assert "damaged" in submission_of(found, "kim").problem
    assert "damaged" in notes_of(submission_of(found, "max"))
    are_marked(found, "ann", "joe")


def test_a_false_size_affects_only_its_student(tmp_path: Path) -> None:
    data = zipped({**two(), "kim.zip": bytes(3_000_000)})
    lied = data.replace(struct.pack("<I", 3_000_000), struct.pack("<I", 1_000))
    found = found_in(tmp_path, lied)
    assert submission_of(found, "kim").problem
    are_marked(found, "ann", "joe")


def test_files_beyond_a_students_limits_are_not_unpacked(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    limits = ArchiveLimits(members=50, unpacked=100_000, packed=60_000)
    monkeypatch.setattr("grader.batch.unpack_members.ONE_STUDENT", limits)
    files = {
        **{f"max/x/{n}": b"" for n in range(60)},
        "kim.zip": bytes(60_001),
        **{f"eve/x/{n}": bytes(40_000) for n in range(4)},
        **two(),
    }
    links = [odd_member(f"kit/x/{n}", tarfile.LNKTYPE, "eve/x/0") for n in range(4)]
    for found in (
        found_in(tmp_path, zipped(files)),
        found_in(tmp_path, tar_with(*links, files=files), "class.tar"),
    ):
        assert "not unpacked" in submission_of(found, "kim").problem
        assert len(list((submission_of(found, "max").path / "x").iterdir())) == 50
        assert len(list((submission_of(found, "eve").path / "x").iterdir())) == 2
        assert "its folder has more than" in notes_of(submission_of(found, "max"))
        assert "its folder has more than" in notes_of(submission_of(found, "eve"))
        are_marked(found, "ann", "joe")
    assert len(list((submission_of(found, "kit").path / "x").iterdir())) == 2


def test_members_with_conflicting_paths_are_left_out_and_reported(tmp_path: Path) -> None:
    files = [*two().items(), ("ann/ws", b""), ("joe/ws/setup.py/x", b""), ("n" * 300, b"")]
    found = found_in(tmp_path, zip_of([(zipfile.ZipInfo(name), data) for name, data in files]))
    assert "in conflict" in notes_of(submission_of(found, "ann"))
    assert "in conflict" in notes_of(submission_of(found, "joe"))
    are_marked(found, "ann", "joe")


def test_a_duplicate_name_is_reported(tmp_path: Path) -> None:
    good = [(zipfile.ZipInfo(name), data) for name, data in two().items()]
    with pytest.warns(UserWarning, match="Duplicate"):
        data = zip_of([*good, (zipfile.ZipInfo("ann/ws/setup.py"), b"last")])
    found = found_in(tmp_path, data)
    assert (submission_of(found, "ann").path / "ws/setup.py").read_bytes() == b"last"
    assert "twice" in notes_of(submission_of(found, "ann"))


def test_a_name_that_is_not_utf8_is_kept(tmp_path: Path) -> None:
    odd = odd_member("jos\udce9.zip", tarfile.REGTYPE)
    found = found_in(tmp_path, tar_with(odd, files=two()), "class.tar")
    assert submission_of(found, "jos\\udce9").path.name == "jos\udce9.zip"


@pytest.mark.parametrize("cut", [10, 300, -30])
@pytest.mark.parametrize("packing", ["zip", "tar.gz"])
def test_a_truncated_class_archive_is_refused(tmp_path: Path, packing: str, cut: int) -> None:
    """A part of a class must not be taken for the whole."""
    data = zipped(two()) if packing == "zip" else tarred(two(), "w:gz")
    with pytest.raises(UsageError, match="class archive cannot be unpacked") as error:
        found_in(tmp_path, data[:cut], f"class.{packing}")
    assert "again" in error.value.remedy
    assert not [path for path in everything_below(tmp_path / "work") if "setup.py" in path]


def packed_by_zip(folder: Path, files: dict[str, bytes], *locked: str) -> bytes:
    """Return a zip by Debian's `zip` in which the files with these names have a password."""
    write(folder, files)
    program = str(installed("zip", "zip"))
    for name in files:
        password = ("-P", "secret") if name in locked else ()
        subprocess.run([program, "-q", *password, "c.zip", name], cwd=folder, check=True)
    return (folder / "c.zip").read_bytes()


def test_a_class_archive_with_a_password_is_refused(tmp_path: Path) -> None:
    data = packed_by_zip(tmp_path / "made", two(), *two())
    with pytest.raises(UsageError, match="password") as error:
        found_in(tmp_path, data)
    assert "give the folder" in error.value.remedy


def test_one_file_with_a_password_affects_one_student(tmp_path: Path) -> None:
    data = packed_by_zip(tmp_path / "made", two(), "ann/ws/setup.py")
    found = found_in(tmp_path, data)
    assert "password" in notes_of(submission_of(found, "ann"))
    are_marked(found, "joe")
    assert "password" not in notes_of(submission_of(found, "joe"))


def test_an_unwritable_work_folder_is_a_surroundings_error(tmp_path: Path) -> None:
    (tmp_path / "work").write_text("a file in the way")
    with pytest.raises(SurroundingsError, match="cannot be unpacked"):
        found_in(tmp_path, zipped(two()))


def test_a_zip_of_a_single_package_is_not_a_class(tmp_path: Path) -> None:
    with pytest.raises(UsageError, match="one package"):
        found_in(tmp_path, zipped(package(below=PACKAGE)))


def test_concurrent_runs_unpack_an_archive_once(tmp_path: Path) -> None:
    (tmp_path / "class.zip").write_bytes(zipped(two()))
    script = (
        "import sys; from pathlib import Path\n"
        "from grader.batch.discover import discover\n"
        "found = discover(Path(sys.argv[1]), unpack=Path(sys.argv[2]))\n"
        "node = found.handed_in[0].path / 'ws' / 'setup.py'\n"
        "print(node.read_bytes(), node.stat().st_ino)\n"
    )
    words = [sys.executable, "-c", script, str(tmp_path / "class.zip"), str(tmp_path / "work")]
    runs = [subprocess.Popen(words, stdout=subprocess.PIPE, text=True) for _ in range(3)]
    said_by = {run.communicate(timeout=120)[0] for run in runs}
    assert [run.returncode for run in runs] == [0, 0, 0]
    assert len(said_by) == 1
    assert str(package()["setup.py"]) in said_by.pop()
