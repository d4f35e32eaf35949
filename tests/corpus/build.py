"""Write a package of the corpus to disk."""

from __future__ import annotations

import shutil
from functools import singledispatch
from pathlib import Path

from .model import Chmod
from .model import Copy
from .model import Crlf
from .model import Delete
from .model import Edit
from .model import Link
from .model import Nest
from .model import Package
from .model import Raw
from .model import Rename
from .model import Replace
from .model import Write

ROOT = Path(__file__).parents[2]
SOLUTION = ROOT / "grader/keys/hello_time/solution/my_robot_controller"
# What counts of the solution, and its modes: not those of the checkout, which may keep none.
_MODES = {
    "package.xml": 0o644,
    "setup.py": 0o644,
    "setup.cfg": 0o644,
    "resource/my_robot_controller": 0o644,
    "my_robot_controller/__init__.py": 0o644,
    "my_robot_controller/my_first_node.py": 0o755,
}


class EditError(Exception):
    """An edit that does not fit the solution any more."""


def write(package: Package, folder: Path) -> Path:
    """Write the package to `folder/<its name in the corpus>` and return that path.

    Raises EditError where an edit does not apply, FileExistsError where the path is taken.
    """
    root = folder / package.name
    root.mkdir(parents=True)
    for path, mode in _MODES.items():
        _put(root / path, (SOLUTION / path).read_bytes(), mode)
    for edit in package.edits:
        try:
            _apply(edit, root)
        except (OSError, EditError) as error:
            raise EditError(f"{package.name}: {edit}: {error}") from error
    return root


def _put(path: Path, data: bytes, mode: int | None = None) -> None:
    if mode is None:
        mode = path.stat().st_mode & 0o777 if path.exists() else 0o644
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(data)
    path.chmod(mode)


@singledispatch
def _apply(edit: Edit, root: Path) -> None:
    raise EditError(f"no such edit: {edit}")


@_apply.register
def _(edit: Replace, root: Path) -> None:
    path = root / edit.path
    text = path.read_text(encoding="utf-8")
    if (found := text.count(edit.old)) != 1:
        raise EditError(f"found {found} times, not once")
    _put(path, text.replace(edit.old, edit.new).encode())


@_apply.register
def _(edit: Write, root: Path) -> None:
    _put(root / edit.path, edit.text.encode(), edit.mode)


@_apply.register
def _(edit: Raw, root: Path) -> None:
    _put(root / edit.path, edit.data)


@_apply.register
def _(edit: Delete, root: Path) -> None:
    path = root / edit.path
    if path.is_dir() and not path.is_symlink():
        shutil.rmtree(path)
    else:
        path.unlink()


@_apply.register
def _(edit: Rename, root: Path) -> None:
    target = root / edit.to
    if target.exists():
        raise EditError("taken")
    target.parent.mkdir(parents=True, exist_ok=True)
    (root / edit.path).rename(target)


@_apply.register
def _(edit: Copy, root: Path) -> None:
    path = root / edit.path
    target = root / edit.to
    if target.exists():
        raise EditError("taken")
    target.parent.mkdir(parents=True, exist_ok=True)
    if path.is_dir():
        shutil.copytree(path, target, symlinks=True)
    else:
        shutil.copy(path, target)


@_apply.register
def _(edit: Chmod, root: Path) -> None:
    (root / edit.path).chmod(edit.mode)


@_apply.register
def _(edit: Crlf, root: Path) -> None:
    path = root / edit.path
    _put(path, path.read_bytes().replace(b"\r\n", b"\n").replace(b"\n", b"\r\n"))


@_apply.register
def _(edit: Link, root: Path) -> None:
    path = root / edit.path
    path.parent.mkdir(parents=True, exist_ok=True)
    path.symlink_to(edit.target)


@_apply.register
def _(edit: Nest, root: Path) -> None:
    aside = root.with_name(f"{root.name}~")
    root.rename(aside)
    target = root / edit.folder
    target.parent.mkdir(parents=True)
    aside.rename(target)
