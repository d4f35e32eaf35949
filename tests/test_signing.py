"""The key of an installation: made once, kept secret, and its signatures hold for exact bytes."""

from __future__ import annotations

from pathlib import Path

import pytest

from grader.base.errors import SurroundingsError, UsageError
from grader.base.signing import (
    PRIVATE_FILE,
    PUBLIC_FILE,
    PublicKey,
    make_key,
    own_key,
    read_public_key,
)
from tests import processes

# RFC 8032, section 7.1, test 2: a key, a message of one byte and its signature
RFC_PUBLIC = bytes.fromhex("3d4017c3e843895a92b70aa74d1b7ebc9c982ccf2ec4968cc0cd55f12af4660c")
RFC_MESSAGE = bytes.fromhex("72")
RFC_SIGNATURE = bytes.fromhex(
    "92a009a9f0d4cab8720e820b5f642540a2b27b5416503f8fb3762223ebdb69da"
    "085ac1e43e15996e458f3613d0f11d8c387b2eaeb4302aeeb00d291612bb0c00"
)


def test_signatures_are_those_of_the_standard() -> None:
    key = PublicKey(RFC_PUBLIC)
    assert key.verifies(RFC_SIGNATURE, RFC_MESSAGE)
    assert not key.verifies(RFC_SIGNATURE, b"")
    assert not key.verifies(RFC_SIGNATURE[:-1], RFC_MESSAGE)
    assert not key.verifies(b"", RFC_MESSAGE)


def test_a_key_is_made_once_and_only_its_owner_can_read_it(tmp_path: Path) -> None:
    place = tmp_path / "state"
    public = make_key(place)
    assert (place / PRIVATE_FILE).stat().st_mode & 0o777 == 0o600
    assert place.stat().st_mode & 0o777 == 0o700
    before = (place / PRIVATE_FILE).read_bytes()
    with pytest.raises(UsageError, match="there is a key already"):
        make_key(place)
    assert (place / PRIVATE_FILE).read_bytes() == before
    own = own_key(place)
    assert own is not None
    assert own.public == public == read_public_key(place / PUBLIC_FILE)
    assert public.verifies(own.sign(b"evidence"), b"evidence")


def test_two_keys_do_not_verify_each_others_signatures(tmp_path: Path) -> None:
    make_key(tmp_path / "a")
    make_key(tmp_path / "b")
    one, other = own_key(tmp_path / "a"), own_key(tmp_path / "b")
    assert one is not None
    assert other is not None
    assert one.public.fingerprint != other.public.fingerprint
    assert not other.public.verifies(one.sign(b"x"), b"x")


def test_without_a_key_there_is_none(tmp_path: Path) -> None:
    assert own_key(tmp_path) is None


def test_a_key_that_others_can_read_is_refused(tmp_path: Path) -> None:
    make_key(tmp_path)
    (tmp_path / PRIVATE_FILE).chmod(0o640)
    with pytest.raises(SurroundingsError, match="other users can read") as error:
        own_key(tmp_path)
    assert "chmod 600" in error.value.remedy


@pytest.mark.parametrize("content", [b"", b"not a key", b"-----BEGIN PRIVATE KEY-----\n"])
def test_what_is_not_a_key_is_refused(tmp_path: Path, content: bytes) -> None:
    (tmp_path / PRIVATE_FILE).write_bytes(content)
    (tmp_path / PRIVATE_FILE).chmod(0o600)
    with pytest.raises(SurroundingsError, match="not an Ed25519 key"):
        own_key(tmp_path)
    (tmp_path / PUBLIC_FILE).write_bytes(content)
    with pytest.raises(UsageError, match="not a public Ed25519 key"):
        read_public_key(tmp_path / PUBLIC_FILE)


def test_a_private_key_is_not_taken_for_a_public_one(tmp_path: Path) -> None:
    make_key(tmp_path)
    with pytest.raises(UsageError, match="not a public Ed25519 key"):
        read_public_key(tmp_path / PRIVATE_FILE)


def test_keygen_says_where_the_files_are_and_never_shows_the_key(tmp_path: Path) -> None:
    env = {"GRADER_STATE": str(tmp_path / "state")}
    done = processes.run(processes.grader("keygen"), env=env)
    assert done.returncode == 0, done.stderr
    public = read_public_key(tmp_path / "state" / PUBLIC_FILE)
    assert public.fingerprint in done.stdout
    assert str(tmp_path / "state" / PRIVATE_FILE) in done.stdout
    secret = (tmp_path / "state" / PRIVATE_FILE).read_text().splitlines()[1]
    assert secret not in done.stdout + done.stderr
    again = processes.run(processes.grader("keygen"), env=env)
    assert again.returncode == 2
    assert "there is a key already" in again.stderr


def test_a_key_that_cannot_be_used_is_said_before_anything_is_marked(tmp_path: Path) -> None:
    make_key(tmp_path)
    (tmp_path / PRIVATE_FILE).chmod(0o644)
    words = ("grade", processes.ROOT / "grader/keys/hello_time/solution", "--out", tmp_path / "out")
    done = processes.run(processes.replaying(*words), env={"GRADER_STATE": str(tmp_path)})
    assert done.returncode == 3
    assert "chmod 600" in done.stderr
    assert "building" not in done.stderr
    assert not (tmp_path / "out").exists()


def test_a_folder_that_cannot_be_written_is_said(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    done = processes.run(
        processes.grader("keygen"), env={"GRADER_STATE": str(tmp_path / "file" / "state")}
    )
    assert done.returncode == 3
    assert "GRADER_STATE" in done.stderr
    assert "Traceback" not in done.stderr
