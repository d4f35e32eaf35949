"""The interface types of the sourced packages: their names, files and Python classes."""

from __future__ import annotations

from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Any

from .ament_index import package_prefix, search_paths
from .parsing import CommandError

if TYPE_CHECKING:
    from collections.abc import Iterable

KINDS = {"msg": "message", "srv": "service", "action": "action"}
_INDEX = Path("share", "ament_index", "resource_index", "rosidl_interfaces")


def packages() -> list[str]:
    """Return the packages that provide interfaces, sorted; raises OSError as `search_paths`."""
    folders = [Path(prefix, _INDEX) for prefix in search_paths()]
    return sorted({path.name for folder in folders if folder.is_dir() for path in folder.iterdir()})


def names(package: str, kinds: Iterable[str] = KINDS) -> list[str] | None:
    """Return a package's interfaces of these kinds (``std_msgs/msg/String``), sorted.

    None if there is no such package of interfaces. Raises OSError as `search_paths` does.
    """
    for prefix in search_paths():
        resource = Path(prefix, _INDEX, package)
        if resource.is_file():
            found = {line.rpartition(".")[0] for line in resource.read_text().split()}
            return sorted(f"{package}/{name}" for name in found if name.split("/")[0] in set(kinds))
    return None


def by_package(kinds: Iterable[str]) -> dict[str, list[str]]:
    """Return the interfaces of every package that has any of these kinds."""
    wanted = set(kinds)
    found = {package: names(package, wanted) or [] for package in packages()}
    return {package: of_package for package, of_package in found.items() if of_package}


def definition(identifier: str) -> str:
    """Return the text of an interface's file; raises CommandError if it does not exist."""
    package, kind, name = _parts(identifier)
    prefix = package_prefix(package)
    if prefix is None:
        raise CommandError(f"Unknown package '{package}'")
    file = Path(prefix, "share", package, kind, f"{name}.{kind}")
    if not file.is_file():
        # (the real command falls back to this file)
        raise CommandError(f"Could not find the interface '{file.with_suffix('.idl')}'")
    return file.read_text(encoding="utf-8")


def _parts(identifier: str) -> tuple[str, str, str]:
    parts = identifier.split("/")
    if len(parts) != 3 or not all(parts) or parts[1] not in KINDS:
        raise CommandError(
            f"Invalid name '{identifier}'. Expected three parts separated by '/', for example "
            "'std_msgs/msg/String'"
        )
    return parts[0], parts[1], parts[2]


def load(identifier: str, kind: str) -> Any:
    """Return the Python class of an interface of a kind (`msg`, `srv` or `action`).

    The kind may be left out of the identifier (``std_msgs/String``). Raises CommandError if there
    is no such interface.
    """
    package, _, rest = identifier.partition("/")
    middle, _, name = rest.rpartition("/")
    try:
        if not package or not name or middle not in ("", kind):
            raise ValueError
        return getattr(import_module(f"{package}.{kind}"), name)
    except (ValueError, ModuleNotFoundError, AttributeError):
        raise CommandError(f"The passed {KINDS[kind]} type is invalid") from None
