"""Writes docker/docker-bake.json from distros.toml, so that a distro is added in one place.

`python -m grader.ros.image_files` writes the file, `--check` tests whether it is up to date.
"""

from __future__ import annotations

import json
import sys

from grader.base.project import CHECKOUT
from grader.ros.distro import Distro, distros
from grader.ros.images import REPOSITORY

BAKE = CHECKOUT / "docker" / "docker-bake.json"
STAGES = ("grade", "lab")


def bake_file() -> str:
    """Return the text of the bake file: a target per distro, base and stage, and the groups."""
    targets: dict[str, object] = {}
    groups: dict[str, list[str]] = {"default": ["lab-jazzy"]}
    for distro in distros().values():
        groups[distro.name] = [f"{stage}-{distro.name}" for stage in STAGES]
        for stage in STAGES:
            targets[f"{stage}-{distro.name}"] = _target(distro, stage)
        if distro.lock is not None:
            under = f"base-{distro.name}-wheels"
            targets[under] = _wheels_base(distro)
            groups[f"{distro.name}-wheels"] = [f"{s}-{distro.name}-wheels" for s in STAGES]
            for stage in STAGES:
                targets[f"{stage}-{distro.name}-wheels"] = _target(distro, stage, under)
    bake = {
        "group": {name: {"targets": members} for name, members in groups.items()},
        "target": targets,
    }
    return json.dumps(bake, indent=2) + "\n"


def _target(distro: Distro, stage: str, under: str = "") -> dict[str, object]:
    arguments = {
        "DISTRO": distro.name,
        "BASE": under or distro.pinned_image,
        "ROS": "wheels" if under else "image",
    }
    target: dict[str, object] = {
        "context": ".",
        "dockerfile": "docker/Dockerfile",
        "target": stage,
        "args": arguments,
        "tags": [f"{REPOSITORY}:{stage}-{distro.name}" + ("-wheels" if under else "")],
    }
    if under:
        target["contexts"] = {under: f"target:{under}"}
    return target


def _wheels_base(distro: Distro) -> dict[str, object]:
    return {
        "context": ".",
        "dockerfile": "docker/wheels.Dockerfile",
        "target": "wheels",
        "args": {"DISTRO": distro.name},
        "tags": [f"{REPOSITORY}:base-{distro.name}-wheels"],
    }


def main() -> int:
    """Write the file, or check it."""
    if sys.argv[1:] == ["--check"]:
        if BAKE.read_text(encoding="utf-8") == bake_file():
            return 0
        print(f"{BAKE} does not match distros.toml: run python -m grader.ros.image_files")
        return 1
    BAKE.write_text(bake_file(), encoding="utf-8")
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
