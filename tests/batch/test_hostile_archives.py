"""Hostile archives: each gives a clear message for its student and has no other effect."""

from __future__ import annotations

import io
import lzma
import struct
import subprocess
import sys
import tarfile
import time
import zipfile
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from grader.package.intake.archive_limits import ArchiveLimits

from .archives import (
    NODE_PATH,
    everything_below,
    hand_in,
    notes,
    odd_member,
    package,
    tar_with,
    tarred,
    zip_of,
    zipped,
)

OUT = ["../evil", "a/../../evil", "/tmp/evil", "//evil", "C:/evil", "c:\\evil", "..\\evil", ".."]
SECONDS = 20  # in which a bomb must be reported, on a busy machine


@pytest.mark.parametrize("name", OUT)
def test_a_zip_with_a_path_outside_itself_is_refused(tmp_path: Path, name: str) -> None:
    (tmp_path / "in").mkdir()
    found = hand_in(tmp_path / "in", zipped({**package(), name: b"x"}))
    assert found.problem_mistake == "package.archive_unsafe"
    assert name.replace("\\", "/") in found.problem
    assert everything_below(tmp_path) == {"in", "in/jane.zip"}


@pytest.mark.parametrize("name", [n for n in OUT if "\\" not in n])
def test_a_tar_with_a_path_outside_itself_is_refused(tmp_path: Path, name: str) -> None:
    found = hand_in(tmp_path, tar_with(odd_member(name, tarfile.REGTYPE)), "jane.tar")
    assert found.problem_mistake == "package.archive_unsafe"
    assert everything_below(tmp_path) == {"jane.tar"}


@pytest.mark.parametrize("target", ["/etc/passwd", "../../etc/passwd", "a/../../..", "\udcff"])
def test_a_link_to_the_outside_is_left_out_and_noted(tmp_path: Path, target: str) -> None:
    found = hand_in(tmp_path, tar_with(odd_member("secret.py", tarfile.SYMTYPE, target)))
    assert found.root == "."
    assert found.links_out == ("secret.py",)
    assert not any(b"root:" in file.data for file in found.files)
    assert "leads out" in notes(found)
    assert all(line.isprintable() for line in found.notes)
    info = zipfile.ZipInfo("secret.py")
    info.external_attr = 0o120777 << 16
    members = [(zipfile.ZipInfo(p), d) for p, d in package().items()]
    by_zip = hand_in(tmp_path, zip_of([*members, (info, target.encode("utf-8", "replace"))]))
    assert by_zip.links_out == ("secret.py",) or target == "\udcff"


@pytest.mark.parametrize("target", ["/etc/passwd", "../../etc/passwd", "gone", "later.py"])
def test_a_hard_link_to_a_file_outside_the_archive_is_left_out(tmp_path: Path, target: str) -> None:
    odd = odd_member("secret.py", tarfile.LNKTYPE, target)
    found = hand_in(tmp_path, tar_with(odd, odd_member("later.py", tarfile.REGTYPE)))
    assert found.root == "."
    assert found.file("secret.py") is None
    assert f"secret.py -> {target}" in notes(found)


@pytest.mark.parametrize("kind", [tarfile.CHRTYPE, tarfile.BLKTYPE, tarfile.FIFOTYPE])
def test_devices_and_pipes_are_left_out_and_noted(tmp_path: Path, kind: bytes) -> None:
    found = hand_in(tmp_path, tar_with(odd_member("dev", kind)))
    assert found.root == "."
    assert found.file("dev") is None
    assert "neither a file nor a folder" in notes(found)


def test_a_file_below_a_link_or_a_file_is_left_out(tmp_path: Path) -> None:
    """The attack: a link to /etc, then a file written through it."""
    link = odd_member("way", tarfile.SYMTYPE, "/etc")
    found = hand_in(tmp_path, tar_with(link, odd_member("way/cron.d", tarfile.REGTYPE)))
    assert found.file("way/cron.d") is None
    assert "below a name that is not a folder: way/cron.d" in notes(found)


def test_a_file_in_the_place_of_a_folder_is_left_out(tmp_path: Path) -> None:
    found = hand_in(tmp_path, tar_with(odd_member("resource", tarfile.REGTYPE)))
    assert found.root == "."
    assert found.file("resource/my_robot_controller") is not None
    assert "has other files below that name: resource" in notes(found)


def test_a_members_mode_is_reduced_to_permission_bits(tmp_path: Path) -> None:
    found = hand_in(tmp_path, tar_with(odd_member("su", tarfile.REGTYPE, mode=0o104755)))
    su = found.file("su")
    assert su is not None
    assert su.mode <= 0o7777


def test_names_that_would_break_a_terminal_are_left_out(tmp_path: Path) -> None:
    names = {"\x1b[2J.py": b"", "a\nb.py": b"", "x\u202egp.py": b"", "n" * 3000: b""}
    for data in (zipped({**package(), **names}), tarred({**package(), **names})):
        found = hand_in(tmp_path, data)
        assert len(found.files) == len(package()) + 2  # the file and its two folders
        assert all(line.isprintable() for line in found.notes)
        assert len(found.notes) >= 2


# bombs


def bomb(tmp_path: Path, data: bytes, name: str) -> str:
    begin = time.thread_time()
    found = hand_in(tmp_path, data, name)
    assert time.thread_time() - begin < SECONDS
    assert found.root is None
    assert found.problem_fix
    return found.problem_mistake


def test_ten_gigabytes_of_zeros_in_a_small_tar_xz_are_not_unpacked(tmp_path: Path) -> None:
    """Made of many concatenated xz streams, so that it is small and quick to make."""
    header = tarfile.TarInfo("zeros")
    header.size = 10_000_000_000
    zeros = lzma.compress(bytes(10_000_000))
    data = lzma.compress(header.tobuf()) + zeros * 1000
    assert len(data) < 2_000_000
    assert bomb(tmp_path, data, "jane.tar.xz") == "package.archive_bomb"


def test_a_bomb_needs_bounded_memory(tmp_path: Path) -> None:
    """In a separate process, because the peak memory is that of the whole process."""
    header = tarfile.TarInfo("zeros")
    header.size = 10_000_000_000
    data = lzma.compress(header.tobuf()) + lzma.compress(bytes(50_000_000), preset=9) * 200
    (tmp_path / "jane.tar.xz").write_bytes(data)
    script = (
        "import sys; from pathlib import Path; from grader.package.submission import take_in\n"
        "found = take_in(Path(sys.argv[1]), package='p', node_file='n.py')\n"
        "status = Path('/proc/self/status').read_text()\n"
        "print(found.problem_mistake, status.partition('VmHWM:')[2].split()[0])"
    )
    words = [sys.executable, "-c", script, str(tmp_path / "jane.tar.xz")]
    done = subprocess.run(words, capture_output=True, text=True, check=True, timeout=120)
    mistake, peak = done.stdout.split()
    assert mistake == "package.archive_bomb"
    assert int(peak) < 200_000  # KiB


@pytest.mark.parametrize("mode", ["w:gz", "w:bz2", "w:xz"])
def test_a_file_of_zeros_in_a_tar_is_a_bomb(tmp_path: Path, mode: str) -> None:
    data = tarred({**package(), "zeros": bytes(60_000_000)}, mode)
    assert bomb(tmp_path, data, "jane.tar") == "package.archive_bomb"


def test_a_zip_that_declares_too_large_a_size_is_refused(tmp_path: Path) -> None:
    data = zipped({**package(), **{f"zeros{n}": bytes(8_000_000) for n in range(4)}})
    assert bomb(tmp_path, data, "jane.zip") == "package.archive_bomb"


def test_a_zip_with_a_false_size_is_damaged(tmp_path: Path) -> None:
    data = bytearray(zipped({**package(), "zeros": bytes(30_000_000)}))
    size = struct.pack("<I", 30_000_000)
    assert data.count(size) == 2  # in the local header and in the central directory
    lied = bytes(data).replace(size, struct.pack("<I", 1_000))
    assert bomb(tmp_path, lied, "jane.zip") == "package.archive_corrupt"


def test_overlapping_zip_members_are_a_bomb(tmp_path: Path) -> None:
    """Overlapping members, as in David Fifield's zip bombs: very many small files."""
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("0", bytes(4_900_000))
        first = archive.infolist()[0]
        for n in range(1, 5_000):
            info = zipfile.ZipInfo(f"{n}")
            for name in ("compress_type", "CRC", "compress_size", "file_size", "header_offset"):
                setattr(info, name, getattr(first, name))
            archive.filelist.append(info)
    assert bomb(tmp_path, stream.getvalue(), "jane.zip") == "package.archive_bomb"


def test_a_nested_bomb_is_detected(tmp_path: Path) -> None:
    """Like 42.zip: sixteen archives in each of sixteen archives, zeros at the bottom."""
    data = zipped({f"{n}": bytes(4_000_000) for n in range(4)})
    for _ in range(2):
        data = zipped({f"{n}.zip": data for n in range(16)})
    assert len(data) < 100_000
    mistake = bomb(tmp_path, data, "jane.zip")
    assert mistake in ("package.archive_bomb", "package.archive_too_large")


@pytest.mark.full
def test_a_tar_with_too_many_files_is_not_read(tmp_path: Path) -> None:
    limits = ArchiveLimits()
    stream = io.BytesIO()
    with tarfile.open(fileobj=stream, mode="w:gz", compresslevel=1) as archive:
        for n in range(limits.members + 1):
            archive.addfile(tarfile.TarInfo(f"{n}"))
    assert bomb(tmp_path, stream.getvalue(), "jane.tgz") == "package.archive_too_large"


@pytest.mark.full
def test_a_zip_with_too_many_files_is_not_read(tmp_path: Path) -> None:
    names = {f"{n}": b"" for n in range(ArchiveLimits().members + 1)}
    assert bomb(tmp_path, zipped(names), "jane.zip") == "package.archive_too_large"


def test_a_central_directory_with_too_many_names_is_not_read(tmp_path: Path) -> None:
    """A million members would take a gigabyte of memory before the first one is read."""
    entry = struct.pack("<4s24sH16s", b"PK\x01\x02", b"", 1, b"") + b"x"
    count = 1_000_000
    end = struct.pack("<4s4H2LH", b"PK\x05\x06", 0, 0, 65535, 65535, len(entry) * count, 4, 0)
    data = b"PK\x03\x04" + entry * count + end
    assert bomb(tmp_path, data, "jane.zip") == "package.archive_too_large"


def test_a_package_may_be_too_large_though_each_file_is_not(tmp_path: Path) -> None:
    noise = bytes(range(256)) * 20_000  # 5.12 MB; a file may have 5
    found = hand_in(tmp_path, tarred({**package(), "bag.db3": noise}), "jane.tar")
    bag = found.file("bag.db3")
    assert bag is not None
    assert bag.unreadable
    assert "larger than 5 MB" in bag.reason
    many = {f"{n}": noise[:4_900_000] for n in range(11)}
    found = hand_in(tmp_path, tarred({**package(), **many}), "jane.tar")
    assert found.problem_mistake == "package.too_large"
    many = {f"{n}": noise[:4_900_000] for n in range(21)}
    found = hand_in(tmp_path, tarred({**package(), **many}), "jane.tar")
    assert found.problem_mistake == "package.archive_too_large"


def test_a_header_that_asks_for_gigabytes_is_not_read(tmp_path: Path) -> None:
    long_name = tarfile.TarInfo("././@LongLink")
    long_name.type, long_name.size = tarfile.GNUTYPE_LONGNAME, 8_000_000_000
    pax = tarfile.TarInfo("pax")
    pax.type, pax.size = tarfile.XHDTYPE, 8_000_000_000
    for header in (long_name, pax):
        data = header.tobuf(tarfile.GNU_FORMAT) + bytes(100_000)
        assert bomb(tmp_path, data, "jane.tar") == "package.archive_corrupt"


def test_headers_that_loop_are_bounded(tmp_path: Path) -> None:
    """A negative size sends Python's tarfile back to the same header (CVE-2025-8194)."""
    header = bytearray(tarfile.TarInfo("a").tobuf())
    negative = (-(1 << 20)).to_bytes(12, "big", signed=True)
    header[124:136] = negative
    header[148:156] = b" " * 8
    header[148:156] = b"%06o\0 " % sum(header[:512])
    data = tarred(package())[:1024] + bytes(header) + bytes(10_240)
    assert bomb(tmp_path, data, "jane.tar") == "package.archive_corrupt"
    info = tarfile.TarInfo("a")
    info.pax_headers = {"size": "-1024"}
    stream = io.BytesIO()
    with tarfile.open(fileobj=stream, mode="w", format=tarfile.PAX_FORMAT) as archive:
        archive.addfile(info)
    assert bomb(tmp_path, stream.getvalue(), "jane.tar") == "package.archive_corrupt"


def test_endless_extended_headers_are_bounded(tmp_path: Path) -> None:
    pax = tarfile.TarInfo("pax")
    pax.type, pax.size = tarfile.XHDTYPE, 512
    block = pax.tobuf() + b"11 a=bbbbb\n".ljust(512, b"\0")
    assert bomb(tmp_path, block * 20_000, "jane.tar") == "package.archive_corrupt"


def test_pax_headers_with_many_digits_take_bounded_time(tmp_path: Path) -> None:
    """Python's tarfile searches pax headers in quadratic time (CVE-2024-6232)."""
    pax = tarfile.TarInfo("pax")
    pax.type, pax.size = tarfile.XHDTYPE, 1_000_000
    data = pax.tobuf() + b"1" * 1_000_448
    assert bomb(tmp_path, data + tarred(package()), "jane.tar") == "package.archive_corrupt"


# arbitrary archives


@settings(
    max_examples=150,
    suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.too_slow],
)
@given(
    names=st.lists(
        st.one_of(
            st.text(st.characters(codec="utf-8"), min_size=1, max_size=20),
            st.lists(st.sampled_from(["..", ".", "", "a", "A", "C:", "~"]), min_size=1).map(
                "/".join
            ),
        ),
        max_size=8,
    ),
    kinds=st.lists(st.sampled_from([b"0", b"1", b"2", b"3", b"5", b"6", b"g", b"S"]), min_size=8),
    targets=st.lists(st.sampled_from(["/etc", "..", "a", "../a", "", "a/b"]), min_size=8),
    mode=st.integers(0, 0o7777),
    noise=st.binary(max_size=30),
    at=st.integers(0, 4000),
)
def test_any_archive_is_read_or_refused(
    tmp_path: Path,
    names: list[str],
    kinds: list[bytes],
    targets: list[str],
    mode: int,
    noise: bytes,
    at: int,
) -> None:
    odd = [odd_member(n, k, t, mode) for n, k, t in zip(names, kinds, targets, strict=False)]
    odd = [info for info in odd if "\0" not in info.name and info.name.strip("/")]
    by_tar = tar_with(*odd)
    by_zip = zipped({**package(), **{n: b"x" for n in names if n.strip("/") and "\0" not in n}})
    for data, name in ((by_tar, "jane.tar"), (by_zip, "jane.zip")):
        for given_bytes in (data, data[:at] + noise + data[at + len(noise) :]):
            before = everything_below(tmp_path)
            if not given_bytes.startswith((b"PK", b"package.xml")):
                continue  # not an archive any more
            found = hand_in(tmp_path, given_bytes, name)
            assert everything_below(tmp_path) - before <= {name}
            assert (found.root is None) == bool(found.problem)
            for text in (found.problem, found.problem_fix, *found.notes):
                assert text.isprintable()
            for file in found.files:
                assert ".." not in file.path.split("/")
                assert not file.path.startswith("/")
            if found.root is None and found.problem_mistake.startswith("package.archive"):
                assert found.file(NODE_PATH) is None
