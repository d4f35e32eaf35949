"""Which files outside the workspace are kept where only the workspace outlives the lab."""

from __future__ import annotations

import shlex
from pathlib import Path

import pytest

from tests import processes

HOME = processes.ROOT / "lab" / "shell" / "home.bash"


@pytest.mark.parametrize("number", range(5))
def test_a_file_made_as_soon_as_the_lab_is_open_is_kept(number: int, tmp_path: Path) -> None:
    (tmp_path / "old").write_text("of the image")
    (tmp_path / "ros2_ws").mkdir()
    script = f". {shlex.quote(str(HOME))}; : > ~/new"  # (builtins: both in one step of the clock)
    processes.run(["bash", "-c", script], env={"HOME": str(tmp_path)})
    kept = tmp_path / "ros2_ws" / ".lab" / "home"
    assert [path.name for path in kept.iterdir()] == ["new"]
    assert {path.name for path in tmp_path.iterdir()} == {".lab_opened", "new", "old", "ros2_ws"}
