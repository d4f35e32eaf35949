"""Find packages and their executables as ament_index_python and ros2pkg do.

Source: ament_index_python 1.8.1 (``packages.py``, ``resources.py``, ``search_paths.py``).
``os.path`` instead of pathlib for speed: `ros2 run` uses this before the student's node starts.
"""
# ruff: noqa: PTH110, PTH112, PTH113, PTH118, PTH208

import os
import re

_PACKAGES = os.path.join("share", "ament_index", "resource_index", "packages")
_PACKAGE_NAME = re.compile(r"[a-zA-Z0-9][a-zA-Z0-9_-]+", re.ASCII)


def search_paths() -> list[str]:
    """Return the prefixes of AMENT_PREFIX_PATH that exist, the overlay first.

    Raises OSError if the variable is unset or empty: no ROS environment was sourced.
    """
    value = os.environ.get("AMENT_PREFIX_PATH")
    if not value:
        raise OSError("Environment variable 'AMENT_PREFIX_PATH' is not set or empty")
    return [path for path in value.split(os.pathsep) if path and os.path.exists(path)]


def package_prefix(package: str) -> str | None:
    """Return the first prefix with a marker of the package, or None if there is none.

    A dangling link (of a workspace that was moved or whose source is gone) does not count as a
    marker, and neither does a name that is not valid for a package (REP 127).

    Raises OSError as `search_paths` does.
    """
    if _PACKAGE_NAME.fullmatch(package) is None:
        return None
    for prefix in search_paths():
        if os.path.isfile(os.path.join(prefix, _PACKAGES, package)):
            return prefix
    return None


def share_directory(package: str) -> str | None:
    """Return the package's share directory, or None if the package is not found.

    Raises OSError as `search_paths` does.
    """
    prefix = package_prefix(package)
    return None if prefix is None else os.path.join(prefix, "share", package)


def package_names() -> list[str]:
    """Return the names of all packages that have a marker, sorted.

    Dangling markers count here, as they do for ament_index_python.

    Raises OSError as `search_paths` does.
    """
    names: set[str] = set()
    for prefix in search_paths():
        index = os.path.join(prefix, _PACKAGES)
        if os.path.isdir(index):
            names.update(
                name
                for name in os.listdir(index)
                if not name.startswith(".") and not os.path.isdir(os.path.join(index, name))
            )
    return sorted(names)


def package_executables(package: str) -> list[str] | None:
    """Return the paths of the package's executables, or None if the package is not found.

    Searches ``<prefix>/lib/<package>`` and all folders below it whose names do not start with a
    dot; a file counts if the caller may execute it.

    Raises OSError as `search_paths` does.
    """
    prefix = package_prefix(package)
    if prefix is None:
        return None
    found = []
    for folder, subfolders, files in os.walk(os.path.join(prefix, "lib", package)):
        subfolders[:] = sorted(name for name in subfolders if not name.startswith("."))
        for name in sorted(files):
            path = os.path.join(folder, name)
            if os.access(path, os.X_OK):
                found.append(path)
    return found
