"""How long a submission is watched: the same each time, and not to be computed without the secret."""

from __future__ import annotations

import hashlib
import os
import stat
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest

from grader.base.state import STATE
from grader.run.unforeseen import KEY_BYTES, KEY_FILE, installation_key, unforeseen
from tests import processes

HASHES = [hashlib.sha256(str(n).encode()).hexdigest() for n in range(400)]


@pytest.fixture(autouse=True)
def own_installation(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv(STATE, str(tmp_path / "state"))
    installation_key.cache_clear()
    return tmp_path / "state"


def test_one_installation_always_observes_a_submission_alike(
    own_installation: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    before = [unforeseen(one, could_end=True) for one in HASHES]
    installation_key.cache_clear()
    assert [unforeseen(one, could_end=True) for one in HASHES] == before
    monkeypatch.setenv(STATE, str(own_installation / "other"))
    installation_key.cache_clear()
    assert [unforeseen(one, could_end=True) for one in HASHES] != before


def test_every_number_of_ticks_and_a_twentieth_of_the_sample_occur() -> None:
    observed = [unforeseen(one, could_end=False) for one in HASHES]
    assert {one.more_ticks for one in observed} == {1, 2, 3}
    assert {one.stay_seconds for one in observed} == {0.0}
    assert 5 <= sum(one.draw < 0.05 for one in observed) <= 45
    longer = [unforeseen(one, could_end=True) for one in HASHES]
    assert {one.more_ticks for one in longer} == set(range(1, 25))
    assert all(3 <= one.stay_seconds <= 6 for one in longer)


def test_a_node_that_says_when_it_ends_is_watched_until_then() -> None:
    for could_end in (False, True):
        observed = [unforeseen(one, could_end=could_end, ends_after=10) for one in HASHES]
        assert {one.stay_seconds for one in observed} == {11.0}
        longer = [unforeseen(one, could_end=could_end, ends_after=3600) for one in HASHES]
        assert longer == [unforeseen(one, could_end=could_end) for one in HASHES]


def test_a_node_that_says_how_far_it_counts_is_watched_until_then() -> None:
    for could_end in (False, True):
        observed = [unforeseen(one, could_end=could_end, counts_to=30) for one in HASHES]
        assert {one.more_ticks for one in observed} == {30}
        fewer = [unforeseen(one, could_end=could_end, counts_to=1) for one in HASHES]
        assert fewer == [unforeseen(one, could_end=could_end) for one in HASHES]


def test_the_secret_is_readable_by_its_owner_only(own_installation: Path) -> None:
    key = installation_key()
    file = own_installation / KEY_FILE
    assert file.read_bytes() == key
    assert len(key) == KEY_BYTES
    assert stat.S_IMODE(file.stat().st_mode) == 0o600
    assert stat.S_IMODE(own_installation.stat().st_mode) == 0o700
    assert list(own_installation.iterdir()) == [file]


def test_graders_that_start_together_agree_on_one_secret(own_installation: Path) -> None:
    code = "from grader.run.unforeseen import *; print(installation_key().hex())"
    command = [sys.executable, "-c", code]
    environment = {**os.environ, STATE: str(own_installation)}

    def ask(_: int) -> str:
        return subprocess.run(
            command, cwd=processes.ROOT, env=environment, capture_output=True, text=True, check=True
        ).stdout

    with ThreadPoolExecutor(4) as pool:
        assert len(set(pool.map(ask, range(4)))) == 1


def test_without_a_place_for_it_the_secret_is_the_process_own(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "file").write_text("in the way")
    monkeypatch.setenv(STATE, str(tmp_path / "file" / "state"))
    assert len(installation_key()) == KEY_BYTES
    assert installation_key() == installation_key()
