"""A package of interfaces whose CMakeLists.txt and package.xml are ours: only its texts are given."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from pathlib import Path

HERE = Path(__file__).resolve().parent
KINDS = ("msg", "srv", "action")
ALWAYS = ("action_msgs", "builtin_interfaces", "service_msgs", "unique_identifier_msgs")
"""Packages that the messages of services and actions use."""

PATH = re.compile(r"(msg|srv|action)/[A-Z][A-Za-z0-9]*\.\1")
USED = re.compile(r"^\s*([a-z][a-z0-9_]*)/[A-Z]\w*", re.MULTILINE)
"""The packages whose types a text uses."""
NAME = re.compile(r"[a-z][a-z0-9_]*")
MANIFEST = """<?xml version="1.0"?>
<package format="3">
  <name>{name}</name>
  <version>0.0.0</version>
  <description>The interfaces of {name}</description>
  <maintainer email="nobody@example.org">nobody</maintainer>
  <license>Apache-2.0</license>
  <buildtool_depend>ament_cmake</buildtool_depend>
  <member_of_group>rosidl_interface_packages</member_of_group>
</package>
"""
BUILD = """
set -e
. "$1/setup.bash"
python=$(command -v python3)
cmake -S "$2" -B "$2/build" -DBUILD_TESTING=OFF -DCMAKE_INSTALL_PREFIX="$3" \\
  -DPython3_EXECUTABLE="$python" -DPYTHON_EXECUTABLE="$python"
cmake --build "$2/build" -j 2
cmake --install "$2/build"
"""
"""Builds and installs it: the arguments are ROS, the package, and where it is installed."""


def interface_package(
    name: str, texts: Mapping[str, str], dependencies: Iterable[str] = ()
) -> dict[str, str]:
    """Return the files of a package that builds interface texts, by their paths.

    `texts` are those of files such as msg/Pose.msg. Raises ValueError for other paths or names.
    """
    wrong = [path for path in texts if not PATH.fullmatch(path)]
    needed = sorted({*dependencies, *ALWAYS} - {name})
    if wrong or not all(NAME.fullmatch(word) for word in (name, *needed)):
        raise ValueError(f"not the files of an interface package: {name}: {', '.join(wrong)}")
    fill = {
        "@PACKAGE@": name,
        "@FILES@": " ".join(f'"{path}"' for path in sorted(texts)),
        "@DEPENDENCIES@": " ".join(needed),
    }
    cmake = (HERE / "interfaces.cmake.in").read_text(encoding="utf-8")
    for mark, value in fill.items():
        cmake = cmake.replace(mark, value)
    return {
        **texts,
        "CMakeLists.txt": cmake,
        "package.xml": MANIFEST.format(name=name),
    }


def texts_in(folder: Path) -> dict[str, str]:
    """Return the interface texts in a folder, by their paths."""
    return {
        f"{kind}/{file.name}": file.read_text(encoding="utf-8")
        for kind in KINDS
        for file in sorted((folder / kind).glob(f"*.{kind}"))
    }
