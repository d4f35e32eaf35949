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

    `variable` is the dict of groups that holds it, if setup() does not get that.
    """

    text: str
    line: int
    argument: str
    variable: str = ""


def misplaced(tree: ast.Module, name: str) -> Misplaced | None:
    """Return the first text of a setup.py that is an entry with this name, outside of entry_points."""
    begins = re.compile(rf"\s{{0,20}}{re.escape(name)}\s{{0,20}}=")
    holders = _holders(tree)
    for node in ast.walk(tree):
        if not isinstance(node, ast.Constant) or not isinstance(node.value, str):
            continue
        argument = holders.get(id(node), "")
        if begins.match(node.value) and argument != "entry_points":
            variable = "" if argument else _variable(tree, node)
            return Misplaced(node.value.strip(), node.lineno, argument, variable)
    return None


def _variable(tree: ast.Module, entry: ast.Constant) -> str:
    """Return the variable with the groups that hold an entry, if it is not used; else ""."""
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
            return name
    return ""


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
