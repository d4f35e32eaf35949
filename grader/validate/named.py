"""mutants.yaml: the mutants that the author of an assignment describes.

    schema: 1
    mutants:
      - name: exec_bit_missing
        check: source.exec_bit
        mistake: source.not_executable
        edits:
          - {chmod: my_package/my_node.py, mode: "0644"}
    equivalent:
      - {mutant: "name of an automatic mutant", why: "why it is correct nevertheless"}

An edit is one of: `replace` (with old, new), `write` (text or base64, mode), `delete`, `rename`
(to), `copy` (to), `chmod` (mode), `crlf`, `link` (to), `nest`. Paths are relative to the package.
"""

from __future__ import annotations

import base64
import binascii
import difflib
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path, PurePosixPath
from typing import Any

from grader.base.errors import AssignmentError
from grader.base.positioned_yaml import Document, Loc, read_yaml
from grader.validate import tree
from grader.validate.mutant import Mutant

MUTANTS = "mutants.yaml"
# each edit: its other required keys, its optional keys
VERBS: Mapping[str, tuple[tuple[str, ...], tuple[str, ...]]] = {
    "replace": (("old", "new"), ()),
    "write": ((), ("text", "base64", "mode")),
    "delete": ((), ()),
    "rename": (("to",), ()),
    "copy": (("to",), ()),
    "chmod": (("mode",), ()),
    "crlf": ((), ()),
    "link": (("to",), ()),
    "nest": ((), ()),
}
NAMED = ("name", "check", "mistake", "edits")
EXPLAINED = ("mutant", "why")


@dataclass(frozen=True)
class Explained:
    """An equivalent automatic mutant and the reason; `where` is its `file:line`."""

    mutant: str
    why: str
    where: str


@dataclass(frozen=True)
class MutantsFile:
    """The content of mutants.yaml."""

    mutants: tuple[Mutant, ...] = ()
    equivalent: tuple[Explained, ...] = ()

    def explained(self, automatic: Iterable[str]) -> dict[str, str]:
        """Return the reasons by mutant; AssignmentError for an unknown or duplicate name."""
        names = tuple(automatic)
        for entry in self.equivalent:
            if entry.mutant not in names:
                hint = _hint(entry.mutant, names)
                raise AssignmentError(
                    f"{entry.where}: there is no automatic mutant '{entry.mutant}'{hint}"
                )
        for mutant in self.mutants:
            if mutant.name in names:
                raise AssignmentError(f"{mutant.where}: an automatic mutant has the same name")
        return {entry.mutant: entry.why for entry in self.equivalent}


def read_mutants(path: Path, *, checks: Iterable[str], mistakes: Iterable[str]) -> MutantsFile:
    """Read mutants.yaml.

    Raises AssignmentError, whose message reads `file:line: what is wrong`.
    """
    return _Reader(read_yaml(path), tuple(checks), tuple(mistakes)).read()


class _Reader:
    def __init__(
        self, document: Document, checks: tuple[str, ...], mistakes: tuple[str, ...]
    ) -> None:
        self._document = document
        self._checks = checks
        self._mistakes = mistakes

    def read(self) -> MutantsFile:
        content = self._mapping((), self._document.content, ("schema", "mutants", "equivalent"))
        if content.get("schema") != 1:
            raise self._document.error(("schema",), "schema must be 1")
        mutants: dict[str, Mutant] = {}
        for n, item in enumerate(self._list(("mutants",), content.get("mutants", ()))):
            mutant = self._mutant(("mutants", n), item)
            if mutant.name in mutants:
                text = f"there are two mutants '{mutant.name}'"
                raise self._document.error(("mutants", n, "name"), text)
            mutants[mutant.name] = mutant
        whys: dict[str, Explained] = {}
        for n, item in enumerate(self._list(("equivalent",), content.get("equivalent", ()))):
            entry = self._explained(("equivalent", n), item)
            if entry.mutant in whys:
                text = f"'{entry.mutant}' is explained twice"
                raise self._document.error(("equivalent", n, "mutant"), text)
            whys[entry.mutant] = entry
        return MutantsFile(tuple(mutants.values()), tuple(whys.values()))

    def _explained(self, loc: Loc, item: Any) -> Explained:
        fields = self._mapping(loc, item, EXPLAINED)
        mutant, why = (self._text(loc, fields, key) for key in EXPLAINED)
        return Explained(mutant, why, self._place(loc))

    def _place(self, loc: Loc) -> str:
        return f"{self._document.path}:{self._document.line(loc)}"

    def _mutant(self, loc: Loc, item: Any) -> Mutant:
        fields = self._mapping(loc, item, NAMED)
        check = self._one_of(loc, fields, "check", self._checks, "the assignment has no check")
        mistake = self._one_of(loc, fields, "mistake", self._mistakes, "there is no mistake")
        edits = self._list((*loc, "edits"), fields.get("edits", ()))
        if not edits:
            raise self._document.error(loc, "a mutant needs at least one edit")
        return Mutant(
            name=self._text(loc, fields, "name"),
            edits=tuple(self._edit((*loc, "edits", n), edit) for n, edit in enumerate(edits)),
            families=(check,),
            mistake=mistake,
            where=self._place(loc),
        )

    def _edit(self, loc: Loc, item: Any) -> tree.Edit:
        if not isinstance(item, dict) or not item:
            raise self._document.error(loc, "an edit is a mapping, e.g. {delete: setup.py}")
        verb = next((key for key in item if key in VERBS), "")
        if not verb:
            first = next(iter(item))
            raise self._document.error(loc, f"no such edit: {first}{_hint(first, VERBS)}")
        needed, others = VERBS[verb]
        fields = self._mapping(loc, item, (verb, *needed, *others))
        values = {key: self._text(loc, fields, key, empty=key in ("new", "text")) for key in fields}
        for key in needed:
            if key not in values:
                raise self._document.error(loc, f"{verb} needs '{key}'")
        for key in {verb, "to"} & set(values):
            if key != "to" or verb != "link":
                self._path(loc, key, values[key])
        return _MADE[verb](self, loc, values)

    def _write(self, loc: Loc, values: Mapping[str, str]) -> tree.Edit:
        if ("text" in values) == ("base64" in values):
            raise self._document.error(loc, "write needs either 'text' or 'base64'")
        if "text" in values:
            data = values["text"].encode()
        else:
            try:
                data = base64.b64decode(values["base64"], validate=True)
            except (binascii.Error, ValueError) as error:
                raise self._document.error((*loc, "base64"), f"not base64: {error}") from None
        mode = self._mode(loc, values) if "mode" in values else None
        return tree.Write(values["write"], data, mode)

    def _mode(self, loc: Loc, values: Mapping[str, str]) -> int:
        text = values["mode"]
        if not (text.isascii() and len(text) <= 4 and text.strip("01234567") == "" and text):
            raise self._document.error((*loc, "mode"), 'a mode is octal digits in quotes: "0644"')
        return int(text, 8) & 0o777

    def _path(self, loc: Loc, key: str, text: str) -> None:
        path = PurePosixPath(text)
        if path.is_absolute() or ".." in path.parts or str(path) != text:
            raise self._document.error((*loc, key), f"not a path inside the package: {text}")

    def _mapping(self, loc: Loc, item: Any, keys: Iterable[str]) -> dict[str, Any]:
        keys = tuple(keys)
        if not isinstance(item, dict):
            raise self._document.error(loc, f"expected a mapping with the keys {', '.join(keys)}")
        for key in item:
            if key not in keys:
                hint = _hint(key, keys)
                raise self._document.error((*loc, key), f"unknown key '{key}'{hint}")
        return item

    def _list(self, loc: Loc, item: Any) -> tuple[Any, ...]:
        if not isinstance(item, tuple):
            raise self._document.error(loc, f"'{loc[-1]}' must be a list")
        return item

    def _text(self, loc: Loc, fields: Mapping[str, Any], key: str, *, empty: bool = False) -> str:
        if key not in fields:
            raise self._document.error(loc, f"'{key}' is missing")
        value = fields[key]
        if not isinstance(value, str) or not (value or empty):
            text = f"'{key}' must be a non-empty string (quote numbers)"
            raise self._document.error((*loc, key), text)
        return value

    def _one_of(
        self, loc: Loc, fields: Mapping[str, Any], key: str, known: tuple[str, ...], unknown: str
    ) -> str:
        value = self._text(loc, fields, key)
        if value not in known:
            hint = _hint(value, known)
            raise self._document.error((*loc, key), f"{unknown} '{value}'{hint}")
        return value


def _hint(word: str, known: Iterable[str]) -> str:
    close = difflib.get_close_matches(word, list(known), n=1)
    return f": did you mean '{close[0]}'?" if close else ""


_Maker = Callable[[_Reader, Loc, Mapping[str, str]], tree.Edit]
_MADE: Mapping[str, _Maker] = {
    "replace": lambda _r, _l, v: tree.Replace(v["replace"], v["old"], v["new"]),
    "write": _Reader._write,
    "delete": lambda _r, _l, v: tree.Delete(v["delete"]),
    "rename": lambda _r, _l, v: tree.Move(v["rename"], v["to"]),
    "copy": lambda _r, _l, v: tree.Copy(v["copy"], v["to"]),
    "chmod": lambda r, loc, v: tree.Chmod(v["chmod"], r._mode(loc, v)),
    "crlf": lambda _r, _l, v: tree.Crlf(v["crlf"]),
    "link": lambda _r, _l, v: tree.Link(v["link"], v["to"]),
    "nest": lambda _r, _l, v: tree.Nest(v["nest"]),
}
