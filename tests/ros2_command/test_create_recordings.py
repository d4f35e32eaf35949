"""Every recording of `ros2 pkg create`, with setup.py as ros2cli makes it since 0.32.6."""

from __future__ import annotations

import hashlib
import json
import re
import stat
from pathlib import Path
from typing import Any

import pytest

from .surroundings import Surroundings

RECORDING = Path(__file__).parents[1] / "recordings" / "ros2cli-jazzy-create-new.json"
CASES: list[dict[str, Any]] = json.loads(RECORDING.read_text())["cases"]
BY_NAME = {case["name"]: case for case in CASES}
NEW = "text of 0.32.6 and later, derived"
# The linters' tests have our own wording
OWN_TEXT = re.compile(r"/test/test_\w+\.py$")


def test_every_recording_is_replayed() -> None:
    assert (len(CASES), len(BY_NAME)) == (23, 23)


def created(folder: Path) -> dict[str, Any]:
    """Describe the content of a folder in the format of this recording."""
    found: dict[str, Any] = {}
    for path in sorted(folder.rglob("*")):
        name, mode = str(path.relative_to(folder)), oct(stat.S_IMODE(path.stat().st_mode))
        if path.is_dir():
            found[f"{name}/"] = mode
        else:
            content = path.read_bytes()
            digest = hashlib.sha256(content).hexdigest()
            found[name] = {"mode": mode, "bytes": len(content), "sha256": digest}
    return found


@pytest.mark.parametrize("name", BY_NAME)
def test_output_status_and_files_are_the_recorded_ones(
    jazzy: Surroundings, tmp_path: Path, name: str
) -> None:
    case = BY_NAME[name]
    folder = tmp_path / "created"
    folder.mkdir()

    done = jazzy.ros2(*case["argv"][1:], cwd=folder)

    assert done.stdout.replace(str(folder), "<ROOT>") == case["stdout"]
    assert done.stderr == case["stderr"]
    assert done.status == case["status"]
    texts = {**case["text"], **case.get(NEW, {})}
    assert {path: (folder / path).read_text() for path in texts} == texts
    made = created(folder)
    assert list(made) == sorted(case["created"])
    for path, recorded in case["created"].items():
        if OWN_TEXT.search(path) or path in case.get(NEW, {}):
            assert made[path]["mode"] == recorded["mode"], path
        else:
            assert made[path] == recorded, path
