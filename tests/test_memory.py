"""What the tests measure as memory is the command's own."""

from __future__ import annotations

import subprocess
import sys

from tests import processes
from tests.memory import peak_memory


def test_the_peak_of_a_command_is_not_that_of_the_process_that_starts_it() -> None:
    before = peak_memory()
    large = bytearray(b"x" * 300_000_000)
    command = [sys.executable, "-c", "from tests.memory import peak_memory; print(peak_memory())"]
    done = subprocess.run(
        command, cwd=processes.ROOT, capture_output=True, text=True, check=True, timeout=30
    )
    assert peak_memory() > max(before, len(large) / 1e6)
    assert float(done.stdout) < 100


def test_the_peak_stays_when_the_memory_is_given_back() -> None:
    large = bytearray(b"x" * 200_000_000)
    size = len(large) / 1e6
    del large
    assert peak_memory() > size
