"""The known ROS 2 releases, read from `distros.toml`."""

from __future__ import annotations

import sys
from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

from grader.base.errors import UsageError
from grader.base.i18n.message import joined, say
from grader.base.nearest import did_you_mean

if sys.version_info >= (3, 11):
    import tomllib
else:  # pragma: no cover - the backport
    import tomli as tomllib

DEFAULT = "jazzy"
HERE = Path(__file__).resolve().parent


@dataclass(frozen=True)
class Distro:
    """A ROS 2 release.

    `lock` is the lock file of its wheels prefix, None if PyPI has no wheels; `documentation` is a
    URL; `dds_profile` is the environment variable that names a Fast DDS profile; `turtlesim` is the
    package of turtlesim's interfaces; `forwards_interrupt`: `ros2 run` sends Ctrl+C on to the node.
    """

    name: str
    ubuntu: str
    ubuntu_name: str
    python: str
    setuptools: str
    image: str
    documentation: str
    dds_profile: str
    end_of_life: str = ""
    digest: str = ""
    rclpy: str = ""
    turtlesim: str = "turtlesim_msgs"
    forwards_interrupt: bool = False
    lock: Path | None = None

    @property
    def pinned_image(self) -> str:
        """The official image, with its digest if distros.toml has one (docker/pin.sh)."""
        return f"{self.image}@{self.digest}" if self.digest else self.image

    @property
    def python_version(self) -> tuple[int, ...]:
        """The version of its Python, such as (3, 12)."""
        return tuple(map(int, self.python.split(".")))

    def not_before(self, name: str) -> bool:
        """Whether this is the distro of that name or a newer one."""
        names = list(distros())
        return names.index(self.name) >= names.index(name)


@lru_cache(maxsize=1)
def distros() -> dict[str, Distro]:
    """Return the known distros by name, oldest first."""
    rows = tomllib.loads((HERE / "distros.toml").read_text(encoding="utf-8"))
    known = {}
    for name, row in rows.items():
        wheels = row.pop("wheels", {})
        lock = HERE / "locks" / wheels["lock"] if wheels else None
        known[name] = Distro(name=name, rclpy=wheels.get("rclpy", ""), lock=lock, **row)
    return known


def sourced(environment: Mapping[str, str]) -> Distro:
    """Return the distro of a terminal's environment, the default one if it is not known."""
    return distros().get(environment.get("ROS_DISTRO", ""), distros()[DEFAULT])


def find_distro(name: str) -> Distro:
    """Return the distro of that name; UsageError (with a "did you mean") if it is unknown."""
    known = distros()
    if name in known:
        return known[name]
    raise UsageError(
        say("'{name}' is not a ROS 2 distro that the grader knows", name=name),
        remedy=joined(did_you_mean(name, known), say("Known: {names}.", names=", ".join(known))),
    )
