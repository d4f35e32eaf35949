"""The environment of the built workspace, read from colcon's data files instead of being sourced.

`install/local_setup.bash` extends the environment by what the `.dsv` files of the packages say, and
sources every script beside them: a script is a program that runs instead of `ros2 run`. Here the data
are read as colcon reads them (colcon-core, `prefix_util.py.em`), what colcon and ament make of a
package is taken over, and anything else is a fault.
"""

from __future__ import annotations

import posixpath
import re
import shlex
import sys
from collections.abc import Collection, Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import PurePosixPath

FOLDERS = {
    "AMENT_PREFIX_PATH": re.compile(""),
    "CMAKE_PREFIX_PATH": re.compile(""),
    "COLCON_PREFIX_PATH": re.compile(""),
    "LD_LIBRARY_PATH": re.compile("lib"),
    "PATH": re.compile("bin"),
    "PKG_CONFIG_PATH": re.compile("(?:lib|share)/pkgconfig"),
    "PYTHONPATH": re.compile(r"(?:local/)?lib/python3(?:\.\d+)?/(?:site|dist)-packages"),
}
"""The variables that colcon and ament extend for a package, each with the folders of its prefix."""
EXTENDS = ("prepend-non-duplicate", "prepend-non-duplicate-if-exists", "append-non-duplicate")
SHELLS = ("sh", "bash")  # of which scripts are sourced by bash
DEEPEST = 8  # files that name each other
STARTED = frozenset(("ros2", "python3", "env", "setsid", "bash", "sh"))  # on the way to a node
AT_START = frozenset(("sitecustomize", "usercustomize"))  # that Python imports by itself (site)
HARMLESS = frozenset(("test", "turtle", "turtledemo", "this", "antigravity", "idlelib", "tkinter"))
LOADED = AT_START | sys.stdlib_module_names - HARMLESS
MARKER = re.compile(r"install/[^/]+/share/ament_index/resource_index/packages/(?P<package>[^/]+)")
MODULE = re.compile(
    r"(?P<folder>.*)/(?P<name>(?!__init__\.)\w+)(?:\.py|\.[\w.-]+\.so|/__init__\.py)"
)


@dataclass(frozen=True)
class Fault:
    """What would run, or be found, instead of what the sources say: a `kind`, its path or line.

    The kinds: `script` (it is sourced), `variable` (it is set), `hides` (a file that hides a program,
    module or library of ROS or Python, or another package of the workspace).
    """

    kind: str
    path: str


@dataclass(frozen=True)
class Overlay:
    """The folders that each variable gets, the first to be found first, and the faults."""

    folders: dict[str, list[str]] = field(default_factory=dict)
    faults: tuple[Fault, ...] = ()

    def commands(self) -> str:
        """Return the commands of a shell that extend its environment."""
        return "".join(
            f'export {name}={shlex.quote(":".join(paths))}"${{{name}:+:${name}}}"; '
            for name, paths in self.folders.items()
        )


def read_overlay(
    paths: Mapping[str, str],
    texts: Mapping[str, str],
    *,
    workspace: str,
    hidden: Iterable[str] = (),
) -> Overlay:
    """Return the environment of a workspace with these files.

    `paths` are relative to the workspace, with their kinds (find's %y), `texts` the contents of the `.dsv` files and of
    `share/colcon-core/packages/*`, `hidden` the libraries with the name of one of the system or of ROS.
    """
    reader = _Reader(paths, texts, workspace)
    for name in _ordered(texts):
        reader.read(f"install/{name}/share/{name}/package.dsv", f"install/{name}", 0)
    for path in hidden:
        reader.faults.append(Fault("hides", path))
    reader.faults += _hiding(reader.folders, paths, workspace)
    if reader.folders:
        reader.folders["COLCON_PREFIX_PATH"] = [f"{workspace}/install"]
    return Overlay(reader.folders, tuple(dict.fromkeys(reader.faults)))


def _ordered(texts: Mapping[str, str]) -> Iterator[str]:
    """Yield the names of the packages, each after those that it needs at run time."""
    needs: dict[str, set[str]] = {}
    for path, text in texts.items():
        match PurePosixPath(path).parts:
            case ("install", prefix, "share", "colcon-core", "packages", name) if name == prefix:
                needs[name] = set(text.strip().split(":")) - {name}
    while needs:
        free = [name for name in needs if not needs[name] & needs.keys()]
        first = min(free or needs)
        yield first
        del needs[first]


class _Reader:
    """Reads the data of one package after the other."""

    def __init__(self, paths: Collection[str], texts: Mapping[str, str], workspace: str) -> None:
        self.paths, self.texts, self.workspace = paths, texts, workspace
        self.folders: dict[str, list[str]] = {}
        self.faults: list[Fault] = []

    def read(self, path: str, prefix: str, depth: int) -> None:
        """Read one file, then those that it names; they may be missing."""
        sources: dict[str, set[str]] = {}
        for line in self.texts.get(path, "").splitlines():
            kind, _, rest = line.partition(";")
            if not line.strip() or line.startswith("#"):
                continue
            if kind == "source":
                name, _, extension = rest.rpartition(".")
                sources.setdefault(posixpath.normpath(f"{prefix}/{name}"), set()).add(extension)
            elif not self._extend(kind, rest, prefix):
                self.faults.append(Fault("variable", f"{path}: {line[:100]}"))
        for name, extensions in sources.items():
            if f"{name}.dsv" in self.paths and depth < DEEPEST:
                self.read(f"{name}.dsv", prefix, depth + 1)
                continue
            scripts = [f"{name}.{shell}" for shell in SHELLS if shell in extensions]
            self.faults += [Fault("script", one) for one in scripts if self._may_exist(one)]

    def _may_exist(self, path: str) -> bool:
        return path in self.paths or not path.startswith(("install/", "build/"))

    def _extend(self, kind: str, rest: str, prefix: str) -> bool:
        """Take over what a line adds to a variable; return False if colcon makes no such line."""
        name, *values = rest.split(";")
        if kind not in EXTENDS or name not in FOLDERS:
            return False
        built = f"build/{PurePosixPath(prefix).name}"  # (by `setup.py develop`)
        for value in values:
            folder = posixpath.normpath(posixpath.join(self.workspace, prefix, value))
            folder = folder.removeprefix(f"{self.workspace}/")
            within = folder.removeprefix(prefix).strip("/") if folder.startswith(prefix) else "/"
            developed = name == "PYTHONPATH" and folder == built
            if not FOLDERS[name].fullmatch(within) and not developed:
                return False
            if kind != "prepend-non-duplicate-if-exists" or folder in self.paths:
                known = self.folders.setdefault(name, [])
                place = f"{self.workspace}/{folder}"
                if place not in known:
                    known.insert(len(known) if kind.startswith("append") else 0, place)
        return True


def _hiding(
    folders: Mapping[str, list[str]], paths: Mapping[str, str], workspace: str
) -> Iterator[Fault]:
    """Yield the files in these folders that hide a program on the way to a node, a module, or a package."""
    markers: dict[str, str] = {}
    found = {
        kind: {folder.removeprefix(f"{workspace}/") for folder in folders.get(kind, ())}
        for kind in ("PATH", "PYTHONPATH")
    }
    for path in sorted(paths):
        folder, _, name = path.rpartition("/")
        # (a folder of modules that is a link has its __init__.py elsewhere)
        linked = f"{path}/__init__.py" if paths[path] == "l" else ""
        module = MODULE.fullmatch(path) or MODULE.fullmatch(linked)
        marker = MARKER.fullmatch(path)
        if (
            (marker and markers.setdefault(marker["package"], path) != path)
            or (folder in found["PATH"] and name in STARTED)
            or (module and module["folder"] in found["PYTHONPATH"] and module["name"] in LOADED)
        ):
            yield Fault("hides", path)
