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


def test_terminals_that_end_together_leave_one_copy(tmp_path: Path) -> None:
    """Nor is one left that a killed terminal had begun."""
    (tmp_path / "ros2_ws" / ".lab" / "home.killed").mkdir(parents=True)
    line = f". {shlex.quote(str(HOME))}; : > ~/new"
    script = f"({line})\nfor n in 1 2 3 4; do ({line}) & done; wait"
    done = processes.run(["bash", "-c", script], env={"HOME": str(tmp_path)})
    kept = tmp_path / "ros2_ws" / ".lab"
    assert "cannot" not in done.stderr
    assert {path.relative_to(kept).as_posix() for path in kept.rglob("*")} == {
        *("home", "home/new", "home.lock")
    }
