"""Entry points as written in setup.py or setup.cfg, before setuptools reads them."""

from __future__ import annotations

import ast
import re
from dataclasses import dataclass, field

from grader.package.source.setup_cfg import SetupCfg
from grader.package.source.setup_py import SetupPy, is_setup_call
from grader.package.source.values import Listing, Table, Text, Value

# The form in which importlib.metadata.EntryPoint (Python 3.10 to 3.13) accepts an entry's value.
TARGET = re.compile(r"[\w.]+\s{0,9}(:\s{0,9}[\w.]+\s{0,9})?(\[[^\]]*\]\s{0,9})?")

GROUP_NAME = re.compile(r"\w+(\.\w+)*")


@dataclass(frozen=True)
class Entry:
    """One entry of a group: its text, file and line, and its literals if it has several."""

    text: str
    file: str
    line: int
    pieces: tuple[tuple[str, int], ...] = ()

    @property
    def name(self) -> str:
        """The part before the first `=`."""
        return self.text.partition("=")[0].strip()

    @property
    def target(self) -> str:
        """The part after the first `=`; empty if there is none."""
        return self.text.partition("=")[2].strip()

    @property
    def valid(self) -> bool:
        """Whether setuptools accepts it; one invalid entry stops the whole build."""
        return bool(self.name and TARGET.fullmatch(self.target))


@dataclass
class EntryPoints:
    """The groups; `is_static` is False if some entries are known only by running setup.py.

    `lost` has the entries of a group that is written again later: the later one replaces it.
    """

    groups: dict[str, list[Entry]] = field(default_factory=dict)
    lost: list[Entry] = field(default_factory=list)
    lines: dict[str, int] = field(default_factory=dict)
    is_static: bool = True

    def group(self, name: str) -> list[Entry]:
        """Return the entries of a group; empty if there is none of that name."""
        return self.groups.get(name, [])

    def _open(self, group: str, line: int) -> list[Entry]:
        self.lines[group] = line
        return self.groups.setdefault(group, [])


def is_refused(group: str) -> bool:
    """Return whether setuptools stops at the name of a group; it ignores spaces around the name."""
    return bool(group.strip()) and not GROUP_NAME.fullmatch(group.strip())


def from_setup_py(setup: SetupPy) -> EntryPoints:
    """Return the entry points in the argument `entry_points` of setup()."""
    found = EntryPoints()
    value = setup.argument("entry_points")
    if isinstance(value, Table):
        for key, entries in value.pairs:
            if isinstance(key, Text):
                found.lost += found.groups.pop(key.value, [])
                _add(found, found._open(key.value, key.line), entries)
            else:
                found.is_static = False
    elif isinstance(value, Text):
        _add_ini(found, value)
    elif value is not None:
        found.is_static = False
    return found


def from_setup_cfg(cfg: SetupCfg) -> EntryPoints:
    """Return the entry points in the section `[options.entry_points]`."""
    found = EntryPoints()
    for group, setting in cfg.sections.get("options.entry_points", {}).items():
        entries = found._open(group, setting.line)
        for row in setting.value.splitlines():
            if row.strip():
                line = cfg.line_of(row.strip(), setting.line)
                entries.append(Entry(row.strip(), "setup.cfg", line))
    return found


@dataclass(frozen=True)
class Misplaced:
    """An entry that is in setup.py, but not in entry_points; `argument` is "" outside of setup().

    `variable` is the dict of groups that holds it, if setup() does not get that; `is_late` if it
    is set below the call. `twice` is the key of a dict that has it and is written again in the line
    `again`.
    """

    text: str
    line: int
    argument: str
    variable: str = ""
    is_late: bool = False
    twice: str = ""
    again: int = 0


def misplaced(tree: ast.Module, name: str) -> Misplaced | None:
    """Return the first text of a setup.py that is an entry with this name, outside of entry_points."""
    begins = re.compile(rf"\s{{0,20}}{re.escape(name)}\s{{0,20}}=")
    holders = _holders(tree)
    for node in ast.walk(tree):
        if not isinstance(node, ast.Constant) or not isinstance(node.value, str):
            continue
        argument = holders.get(id(node), "")
        if begins.match(node.value) and argument != "entry_points":
            variable, is_late = ("", False) if argument else _variable(tree, node)
            twice, again = _written_again(tree, node)
            entry = node.value.strip()
            return Misplaced(entry, node.lineno, argument, variable, is_late, twice, again)
    return None


def _written_again(tree: ast.Module, entry: ast.Constant) -> tuple[str, int]:
    """Return the key of a dict whose value has an entry, and the line of the same key below it."""
    for found in (n for n in ast.walk(tree) if isinstance(n, ast.Dict)):
        keys = [(k.value, k.lineno) if isinstance(k, ast.Constant) else ("", 0) for k in found.keys]
        for at, (key, _) in enumerate(keys):
            later = [line for name, line in keys[at + 1 :] if name == key]
            if key and later and any(n is entry for n in ast.walk(found.values[at])):
                return str(key), later[-1]
    return "", 0


def _variable(tree: ast.Module, entry: ast.Constant) -> tuple[str, bool]:
    """Return the variable with the groups that hold an entry and is not used; and if it is late."""
    calls = [n.lineno for n in ast.walk(tree) if isinstance(n, ast.Call) and is_setup_call(n)]
    sets = [
        s for s in tree.body if isinstance(s, ast.Assign) and isinstance(s.targets[0], ast.Name)
    ]
    lists = {_target(s) for s in sets if any(node is entry for node in ast.walk(s.value))}
    for statement in sets:
        if not isinstance(statement.value, ast.Dict):
            continue
        keys = [key.value for key in statement.value.keys if isinstance(key, ast.Constant)]
        names = {n.id for n in ast.walk(statement.value) if isinstance(n, ast.Name)}
        name = _target(statement)
        if not ({name} | names) & lists or "console_scripts" not in keys:
            continue
        uses = [n for n in ast.walk(tree) if isinstance(n, ast.Name) and n.id == name]
        if len(uses) == 1 and len(calls) == 1:
            return name, statement.lineno > calls[0]
    return "", False


def _target(statement: ast.Assign) -> str:
    return statement.targets[0].id if isinstance(statement.targets[0], ast.Name) else ""


def _holders(tree: ast.Module) -> dict[int, str]:
    """Return the argument of setup() that holds each part of the file, by its identity."""
    holders: dict[int, str] = {}
    for call in (node for node in ast.walk(tree) if is_setup_call(node)):
        for keyword in call.keywords if isinstance(call, ast.Call) else ():
            holders.update((id(node), keyword.arg or "") for node in ast.walk(keyword.value))
    return holders


def _add(found: EntryPoints, entries: list[Entry], value: Value) -> None:
    if isinstance(value, Text):  # one string, one entry per line
        for row, line in _rows(value):
            entries.append(Entry(row, "setup.py", line))
    elif isinstance(value, Listing):
        for item in value.items:
            if isinstance(item, Text):
                entries.append(Entry(item.value.strip(), "setup.py", item.line, item.pieces))
            else:
                found.is_static = False
    else:
        found.is_static = False


def _add_ini(found: EntryPoints, value: Text) -> None:
    entries: list[Entry] = []
    for row, line in _rows(value):
        if row.startswith("[") and row.endswith("]"):
            entries = found._open(row[1:-1].strip(), line)
        else:
            entries.append(Entry(row, "setup.py", line))


def _rows(value: Text) -> list[tuple[str, int]]:
    rows = []
    for line, row in enumerate(value.value.splitlines(), start=value.line):
        if row.strip() and not row.strip().startswith("#"):
            rows.append((row.strip(), line))
    return rows
