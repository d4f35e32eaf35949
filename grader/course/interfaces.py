"""The fields of ROS's own interfaces, so that an assignment can be checked when it is loaded.

The table `interfaces.json` is made from the texts of the wheels prefixes and of turtlesim:

    python -m grader.course.interfaces <prefix>/share …

It has an entry for each message; a service's are `…_Request` and `…_Response`, an action's
`…_Goal`, `…_Result` and `…_Feedback` (the names that rosidl gives them). Interfaces of other
packages (a student's own, for example) are not in it.
"""

from __future__ import annotations

import functools
import json
import re
import sys
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

from grader.base.nearest import meant, nearest
from grader.package.source.interface import message_text
from grader.ros.interfaces import TEXTS

TABLE = Path(__file__).with_name("interfaces.json")
PARTS = {
    "msg": ("",),
    "srv": ("_Request", "_Response"),
    "action": ("_Goal", "_Result", "_Feedback"),
}
IN_PARTS = frozenset(part for parts in PARTS.values() for part in parts if part)
EXAMPLES = {
    "msg": "std_msgs/msg/String",
    "srv": "std_srvs/srv/SetBool",
    "action": "turtlesim/action/RotateAbsolute",
}
NOUNS = {"msg": "a message", "srv": "a service", "action": "an action"}
NAME = re.compile(r"[a-z][a-z0-9_]*/(msg|srv|action)/[A-Z][A-Za-z0-9]*")
FIELD = re.compile(r"([^.\[\]]+)((?:\[\d+\])*)")
ARRAY = re.compile(r"(.+)\[(<=)?(\d*)\]")
SEPARATOR = re.compile(r"^---\s*$", re.MULTILINE)
SAME_PACKAGE = 0.8  # of 1: how alike a misspelt package's name must be
TURTLESIM = {"turtlesim_msgs": "turtlesim"}  # its name from kilted on

Table = Mapping[str, Mapping[str, str]]
"""The type of each field, by the message and the field's name."""


@dataclass(frozen=True)
class Field:
    """A field's type, "" if it cannot be judged; `fault` says why there is no such field."""

    type: str = ""
    fault: str = ""


UNKNOWN = Field()


@dataclass(frozen=True)
class Interfaces:
    """What is known about interfaces; what cannot be judged is right."""

    table: Table

    @functools.cached_property
    def types(self) -> frozenset[str]:
        """The names of all messages, services and actions."""
        return frozenset(_whole(name) for name in self.table)

    @functools.cached_property
    def packages(self) -> frozenset[str]:
        """The packages whose interfaces are known."""
        return frozenset(name.partition("/")[0] for name in self.types)

    def has_type(self, name: str) -> bool:
        """Whether there is a message, service or action of this name."""
        return _known(name) in self.types

    def has_package(self, name: str) -> bool:
        """Whether there is a package of interfaces of this name."""
        return _known(name) in self.packages

    def packages_with(self, name: str, kind: str) -> list[str]:
        """Return the packages that have a `msg`, `srv` or `action` of this name."""
        return sorted(one.split("/")[0] for one in self.types if one.endswith(f"/{kind}/{name}"))

    def type_fault(self, name: str, kind: str) -> str:
        """Return what is wrong with the name of a type that must be a `msg`, `srv` or `action`.

        It is "" for a type that is right, and for one of an unknown package.
        """
        known = _known(name)
        if not NAME.fullmatch(name):
            close = self._nearest(known, kind)
            return f"type must be such as {EXAMPLES[kind]}, not '{name}'{meant(close)}"
        given = name.split("/")[1]
        if given != kind:
            return f"'{name}' is {NOUNS[given]}, but {NOUNS[kind]} is needed here"
        if known in self.types:
            return ""
        close = self._nearest(known, kind)
        if known.partition("/")[0] in self.packages:
            return f"unknown type '{name}'{meant(close)}"
        return f"unknown type '{name}'{meant(close)}" if self._is_typo(known, close) else ""

    def field(self, message: str, path: str) -> Field:
        """Return the field `linear.x` or `ranges[0]` of a message, or what is wrong with it."""
        here, done = _known(message), ""
        parts = list(FIELD.finditer(path))
        for n, found in enumerate(parts):
            fields = self.table.get(here)
            if fields is None:
                return UNKNOWN
            if found[1] not in fields:
                return Field(fault=_no_field(here, found[1], fields, done))
            one = _indexed(f"{done}{found[1]}", fields[found[1]], found[2])
            if one.fault or n == len(parts) - 1:
                return one
            if ARRAY.fullmatch(one.type):
                return Field(fault=f"{done}{found[1]} is a list: write {done}{found[1]}[0]")
            if "/" not in one.type:
                return Field(fault=f"{done}{found[1]} is a {one.type}: it has no fields")
            here, done = one.type, f"{done}{found[0]}."
        return UNKNOWN

    def _nearest(self, name: str, kind: str) -> str:
        """Return the known type that is meant, "" if none is near."""
        of_kind = {one for one in self.types if f"/{kind}/" in one}
        package, last = name.partition("/")[0], name.rpartition("/")[2]
        if f"{package}/{kind}/{last}" in of_kind:
            return f"{package}/{kind}/{last}"
        same_name = [one for one in of_kind if one.rpartition("/")[2] == last]
        same_name.sort(key=lambda one: (not one.startswith("std_"), one))
        own = [one for one in of_kind if one.partition("/")[0] == package]
        for names in (own, same_name):
            if close := nearest(name, names):
                return close
        return same_name[0] if same_name else nearest(name, of_kind)

    def _is_typo(self, name: str, close: str) -> bool:
        """Whether an unknown package is a known one, misspelt: it has a type of that name."""
        package, _, rest = name.partition("/")
        theirs, _, same = close.partition("/")
        return bool(close) and rest == same and nearest(package, [theirs], SAME_PACKAGE) == theirs


@functools.cache
def ros_interfaces() -> Interfaces:
    """Return the interfaces of ROS and of turtlesim."""
    return Interfaces(json.loads(TABLE.read_text(encoding="utf-8")))


def part_names(kind: str) -> tuple[str, ...]:
    """Return the parts of a `srv` or an `action`, as in `response.success`; none of a `msg`."""
    return tuple(part.strip("_").lower() for part in PARTS[kind] if part)


def table_of(share: Path) -> dict[str, dict[str, str]]:
    """Return the table of the packages in a folder such as /opt/ros/jazzy/share."""
    found: dict[str, dict[str, str]] = {}
    for kind, parts in PARTS.items():
        for file in sorted(share.glob(f"*/{kind}/*.{kind}")):
            package = file.parts[-3]
            texts = SEPARATOR.split(file.read_text(encoding="utf-8"))
            for part, text in zip(parts, texts, strict=True):
                fields = message_text(text).declared
                found[f"{package}/{kind}/{file.stem}{part}"] = {
                    one.name: _full(one.type, package) for one in fields if not one.constant
                }
    return dict(sorted(found.items()))


def table_text(table: Table) -> str:
    """Return the content of `interfaces.json`: one line for each message."""
    rows = [f"{json.dumps(name)}: {json.dumps(dict(fields))}" for name, fields in table.items()]
    return "{\n" + ",\n".join(rows) + "\n}\n"


def _full(kind: str, package: str) -> str:
    """Return a field's type with its package: `Vector3[]` is `geometry_msgs/msg/Vector3[]`."""
    if kind[0].islower() and "/" not in kind:
        return re.sub(r"<=\d+(?=$|\[)", "", kind)  # how long a text may be
    owner, _, name = kind.rpartition("/")
    return f"{(owner or package).removesuffix('/msg')}/msg/{name}"


def _whole(name: str) -> str:
    """Return the interface of which a message is a part; most are their own."""
    whole, _, part = name.rpartition("_")
    return whole if f"_{part}" in IN_PARTS else name


def _known(name: str) -> str:
    """Return the name under which turtlesim's types are in the table."""
    package, slash, rest = name.partition("/")
    return TURTLESIM.get(package, package) + slash + rest


def _no_field(message: str, name: str, fields: Mapping[str, str], done: str) -> str:
    close = nearest(name, fields)
    hint = meant(f"{done}{close}") if close else ""
    there = ", ".join(fields) if fields else "none"
    return f"{_shown(message)} has no field '{name}'{hint}; it has {there}"


def _indexed(path: str, kind: str, indexes: str) -> Field:
    """Return a field of a type, or of its list's values if it has an index."""
    array = ARRAY.fullmatch(kind)
    if not indexes:
        return Field(type=kind)
    if array is None:
        return Field(fault=f"{path} is no list: it is a {kind}")
    last = int(array[3]) - 1 if array[3] else None
    if last is not None and int(indexes[1:].partition("]")[0]) > last:
        return Field(fault=f"{path} has {last + 1} values: the last is {path}[{last}]")
    return Field(type=array[1])


def _shown(name: str) -> str:
    """Return a message's name for a person."""
    whole, _, part = name.rpartition("_")
    return f"the {part.lower()} of {whole}" if f"_{part}" in IN_PARTS else name


def _shares(folders: list[str]) -> Iterator[Path]:
    yield from map(Path, folders)
    yield TEXTS


if __name__ == "__main__":
    made: dict[str, dict[str, str]] = {}
    for folder in _shares(sys.argv[1:]):
        made |= {name: fields for name, fields in table_of(folder).items() if name not in made}
    TABLE.write_text(table_text(dict(sorted(made.items()))), encoding="utf-8")
