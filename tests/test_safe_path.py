"""Nothing is imported from the folder in which a command is started: it may be a student's."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest

from tests import processes

TRAPS = ("click", "json", "pathlib", "pydantic", "yaml", "selectors", "subprocess", "ctypes")
CODE = "open({mark!r}, 'a').write(__name__ + chr(10))\nraise SystemExit(99)\n"


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """Return a folder with modules of ours and of libraries that must not be imported."""
    made = tmp_path / "submissions"
    made.mkdir()
    for name in TRAPS:
        (made / f"{name}.py").write_text(CODE.format(mark=str(tmp_path / "imported")))
    return made


@pytest.mark.parametrize("module", ["grader", "lab"])
def test_a_command_imports_nothing_from_the_current_folder(folder: Path, module: str) -> None:
    done = processes.run([sys.executable, "-m", module, "--help"], cwd=folder, forked=False)
    assert not (folder.parent / "imported").exists()
    assert (done.returncode, done.stderr) == (0, "")
    assert "Usage" in done.stdout or "usage" in done.stdout


def test_workers_import_nothing_from_the_current_folder(folder: Path) -> None:
    (folder / "class" / "ada").mkdir(parents=True)
    (folder / "class" / "ada" / "README.md").write_text("nothing yet\n")
    command = processes.grader("grade-all", "class", "--out", folder.parent / "out", "--quiet")
    done = processes.run(command, cwd=folder, forked=False)
    assert not (folder.parent / "imported").exists()
    assert done.returncode == 1, done.stderr
    report = next((folder.parent / "out").rglob("report.json")).read_text(encoding="utf-8")
    assert "package.found" in report
