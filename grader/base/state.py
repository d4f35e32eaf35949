"""The folder for what belongs to this installation of the grader: its keys."""

from __future__ import annotations

import os
from pathlib import Path

STATE = "GRADER_STATE"


def state_folder() -> Path:
    """Return the folder; it may not exist yet."""
    own = os.environ.get(STATE)
    if own:
        return Path(own)
    base = os.environ.get("XDG_STATE_HOME") or Path.home() / ".local" / "state"
    return Path(base) / "ros2_teaching_lab"
