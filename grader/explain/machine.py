"""The machine on which a text is explained: what its terminal, its folders and its Python say.

It may be another one than that of the text. So what is found here is told beside the explanation,
and never takes the place of what the text shows.
"""

from __future__ import annotations

import os
import subprocess
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path

from grader.base.i18n.message import Message, Value
from grader.ros.distro import Distro, distros, sourced

MOST_SECONDS = 10  # a Python that takes longer to start says nothing
VERSION = "from importlib.metadata import version; print(version('{}'))"


@dataclass(frozen=True)
class Machine:
    """What can be seen from a terminal: its variables, its folder, and the files below `root`."""

    environment: Mapping[str, str] = field(default_factory=lambda: dict(os.environ))
    folder: Path = field(default_factory=Path.cwd)
    root: Path = Path("/")

    @property
    def in_lab(self) -> bool:
        """Whether the terminal is one of the lab."""
        return "LAB_PROGRAMS" in self.environment

    @cached_property
    def installed(self) -> list[str]:
        """The distros that are below /opt/ros."""
        found = (self.root / "opt/ros").glob("*/setup.bash")
        return sorted(path.parent.name for path in found)

    @property
    def distro(self) -> Distro:
        """The distro of the terminal; if none is sourced, the one that is installed."""
        known = [name for name in self.installed if name in distros()]
        if "ROS_DISTRO" not in self.environment and len(known) == 1:
            return distros()[known[0]]
        return sourced(self.environment)

    @cached_property
    def workspace(self) -> Path | None:
        """The workspace of the folder, else ~/ros2_ws; None if there is none."""
        home = Path(self.environment.get("HOME", "/nonexistent"))
        places = [self.folder, *self.folder.parents, home / "ros2_ws"]
        return next((place for place in places if (place / "src").is_dir()), None)

    @property
    def prefixes(self) -> list[str]:
        """The prefixes that the terminal has sourced."""
        return self.environment.get("AMENT_PREFIX_PATH", "").split(":")

    @cached_property
    def python(self) -> Path | None:
        """The python3 that the terminal finds first."""
        folders = self.environment.get("PATH", "").split(":")
        found = (Path(folder) / "python3" for folder in folders if folder)
        return next((path for path in found if os.access(path, os.X_OK)), None)

    def version(self, package: str) -> str:
        """Return the version of a package of that python3; "" if it has none."""
        if self.python is None:
            return ""
        done = None
        try:
            done = subprocess.run(
                [self.python, "-c", VERSION.format(package)],
                env=dict(self.environment),
                stdin=subprocess.DEVNULL,
                capture_output=True,
                text=True,
                timeout=MOST_SECONDS,
                check=False,
            )
        except (OSError, subprocess.TimeoutExpired):
            return ""
        return done.stdout.strip()


Look = Callable[[Machine, Mapping[str, Value]], Message | None]
"""Returns what a machine shows of a mistake with these values, in one sentence; None if nothing."""
