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
    catalogue: true

With `catalogue: true` the examples of the catalogue's mistakes are mutants too: they are edits of
the tutorial's package, so this is for an assignment with that solution. Examples for checks that
the assignment does not have are left out.

An edit is one of: `replace` (with old, new), `write` (text or base64, mode), `delete`, `rename`
(to), `copy` (to), `chmod` (mode), `crlf`, `link` (to), `nest`. Paths are relative to the package.
If the assignment has interface packages, a path may begin with `../` and the name of one of them,
such as `../my_robot_interfaces/msg/Distance.msg`.
"""

from __future__ import annotations

import base64
import binascii
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path, PurePosixPath
from typing import Annotated, Any, Literal, NoReturn

from pydantic import (
    AfterValidator,
    Discriminator,
    Field,
    Tag,
    ValidationError,
    ValidationInfo,
    model_validator,
)

from grader.base.errors import AssignmentError
from grader.base.nearest import nearest
from grader.base.part import Part
from grader.base.positioned_yaml import Document, Loc, read_yaml
from grader.base.yaml_model import TAG, Fault, Keys, broken, error_of, model_faults
from grader.course.assignment import OWN
from grader.mistakes.kind import Kind
from grader.package.edit import tree
from grader.ros.distro import Distro
from grader.validate.mutant import Mutant

MUTANTS = "mutants.yaml"


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
        """Return the reasons by mutant; one AssignmentError for all unknown or duplicate names."""
        names = tuple(automatic)
        faults = [
            f"{entry.where}: there is no automatic mutant '{entry.mutant}'"
            f"{_hint(entry.mutant, names)}"
            for entry in self.equivalent
            if entry.mutant not in names
        ]
        faults += [
            f"{mutant.where}: an automatic mutant has the same name"
            for mutant in self.mutants
            if mutant.name in names
        ]
        if faults:
            raise AssignmentError("\n".join(faults))
        return {entry.mutant: entry.why for entry in self.equivalent}


def read_mutants(
    path: Path,
    *,
    checks: Iterable[str],
    kinds: Mapping[str, Kind],
    distro: Distro,
    beside: bool = False,
) -> MutantsFile:
    """Read mutants.yaml; `kinds` are the catalogue's mistakes by id.

    The mutants are marked on `distro`: an example that is right there becomes an equivalent mutant.
    `beside`: the solution has other packages beside the one that the paths are relative to.

    Raises AssignmentError; each line of its message reads `file:line: what is wrong`.
    """
    document = read_yaml(path)
    try:
        content = _Content.model_validate(document.content, strict=True, context=beside)
    except ValidationError as error:
        raise error_of(document, model_faults(error, KEYS)) from None
    checks = tuple(checks)
    examples = tuple(_examples(kinds, checks, distro)) if content.catalogue else ()
    names = [mutant.name for mutant in examples]
    if found := list(_faults(content, checks, tuple(kinds), names)):
        raise error_of(document, found)
    written = (
        Mutant(
            name=named.name,
            edits=tuple(edit.made() for edit in named.edits),
            families=(named.check,),
            mistake=named.mistake,
            where=_where(document, ("mutants", n)),
        )
        for n, named in enumerate(content.mutants)
    )
    return MutantsFile(
        mutants=(*examples, *written),
        equivalent=tuple(
            Explained(entry.mutant, entry.why, _where(document, ("equivalent", n)))
            for n, entry in enumerate(content.equivalent)
        ),
    )


def _examples(kinds: Mapping[str, Kind], checks: Sequence[str], distro: Distro) -> Iterator[Mutant]:
    for kind in kinds.values():
        for example in kind.examples:
            if example.fails in checks:
                right = example.right_from and distro.not_before(example.right_from)
                yield Mutant(
                    name=example.name,
                    edits=example.edits,
                    families=(example.fails,),
                    mistake=kind.id,
                    equivalent=example.note if right else "",
                    where=f"catalogue: {kind.id}",
                )


def _where(document: Document, loc: Loc) -> str:
    return f"{document.path}:{document.line(loc)}"


def _inside(text: str, info: ValidationInfo) -> str:
    """Check a path; if the context is true, it may be in a package beside the first one."""
    path = PurePosixPath(text)
    parts = path.parts[1:] if info.context and path.parts[:1] == ("..",) else path.parts
    if not parts or path.is_absolute() or ".." in parts or str(path) != text:
        raise broken(f"not a path inside the package: {text}")
    return text


def _octal(text: str) -> str:
    if not (text.isascii() and len(text) <= 4 and text.strip("01234567") == ""):
        raise broken('a mode is octal digits in quotes: "0644"')
    return text


def _base64(text: str) -> str:
    try:
        base64.b64decode(text, validate=True)
    except (binascii.Error, ValueError) as error:
        raise broken(f"not base64: {error}") from None
    return text


_Text = Annotated[str, Field(min_length=1)]
_InPackage = Annotated[_Text, AfterValidator(_inside)]
_Mode = Annotated[_Text, AfterValidator(_octal)]
_Base64 = Annotated[_Text, AfterValidator(_base64)]


class _Replace(Part):
    path: _InPackage = Field(alias="replace")
    old: _Text
    new: str

    def made(self) -> tree.Edit:
        return tree.Replace(self.path, self.old, self.new)


class _Write(Part):
    path: _InPackage = Field(alias="write")
    text: str = ""
    base64: _Base64 = ""
    mode: _Mode = ""

    @model_validator(mode="after")
    def _one_content(self) -> _Write:
        if len({"text", "base64"} & self.model_fields_set) != 1:
            raise broken("write needs either 'text' or 'base64'")
        return self

    def made(self) -> tree.Edit:
        data = base64.b64decode(self.base64) if self.base64 else self.text.encode()
        return tree.Write(self.path, data, _bits(self.mode) if self.mode else None)


class _Delete(Part):
    path: _InPackage = Field(alias="delete")

    def made(self) -> tree.Edit:
        return tree.Delete(self.path)


class _Rename(Part):
    path: _InPackage = Field(alias="rename")
    to: _InPackage

    def made(self) -> tree.Edit:
        return tree.Move(self.path, self.to)


class _Copy(Part):
    path: _InPackage = Field(alias="copy")
    to: _InPackage

    def made(self) -> tree.Edit:
        return tree.Copy(self.path, self.to)


class _Chmod(Part):
    path: _InPackage = Field(alias="chmod")
    mode: _Mode

    def made(self) -> tree.Edit:
        return tree.Chmod(self.path, _bits(self.mode))


class _Crlf(Part):
    path: _InPackage = Field(alias="crlf")

    def made(self) -> tree.Edit:
        return tree.Crlf(self.path)


class _Link(Part):
    path: _InPackage = Field(alias="link")
    to: _Text

    def made(self) -> tree.Edit:
        return tree.Link(self.path, self.to)


class _Nest(Part):
    folder: _InPackage = Field(alias="nest")

    def made(self) -> tree.Edit:
        return tree.Nest(self.folder)


class _Unknown(Part):
    """Refuses an edit that has none of the known keys."""

    @model_validator(mode="before")
    @classmethod
    def _refuse(cls, item: Any) -> NoReturn:
        if not isinstance(item, dict) or not item:
            raise broken("an edit is a mapping, e.g. {delete: setup.py}")
        first = next(iter(item))
        raise broken(f"no such edit: {first}{_hint(first, VERBS)}")

    def made(self) -> NoReturn:
        raise AssertionError("it is never valid")


def _bits(mode: str) -> int:
    return int(mode, 8) & 0o777


EDITS: tuple[type[Part], ...] = (
    _Replace,
    _Write,
    _Delete,
    _Rename,
    _Copy,
    _Chmod,
    _Crlf,
    _Link,
    _Nest,
)


def _keys(model: type[Part]) -> tuple[str, ...]:
    return tuple(field.alias or name for name, field in model.model_fields.items())


VERBS = {_keys(model)[0]: model for model in EDITS}


def _tag(item: Any) -> str:
    """Return the tag of an edit's model: its verb; only TAG if it has no known verb."""
    verbs = [key for key in item if key in VERBS] if isinstance(item, dict) else []
    return TAG + verbs[0] if verbs else TAG


_AnyEdit = Annotated[
    Annotated[_Replace, Tag("|replace")]
    | Annotated[_Write, Tag("|write")]
    | Annotated[_Delete, Tag("|delete")]
    | Annotated[_Rename, Tag("|rename")]
    | Annotated[_Copy, Tag("|copy")]
    | Annotated[_Chmod, Tag("|chmod")]
    | Annotated[_Crlf, Tag("|crlf")]
    | Annotated[_Link, Tag("|link")]
    | Annotated[_Nest, Tag("|nest")]
    | Annotated[_Unknown, Tag("|")],
    Discriminator(_tag),
]


def _at_least_one(edits: tuple[_AnyEdit, ...]) -> tuple[_AnyEdit, ...]:
    if not edits:
        raise broken("a mutant needs at least one edit")
    return edits


class _Named(Part):
    name: _Text
    check: _Text
    mistake: _Text
    edits: Annotated[tuple[_AnyEdit, ...], AfterValidator(_at_least_one)]


class _Equivalent(Part):
    mutant: _Text
    why: _Text


class _Content(Part):
    schema_: Literal[1] = Field(alias="schema")
    mutants: tuple[_Named, ...] = ()
    equivalent: tuple[_Equivalent, ...] = ()
    catalogue: bool = False


KEYS: Keys = {
    (): _keys(_Content),
    ("mutants", "*"): _keys(_Named),
    ("equivalent", "*"): _keys(_Equivalent),
    **{("mutants", "*", "edits", "*", TAG + verb): _keys(model) for verb, model in VERBS.items()},
}


def _faults(
    content: _Content, checks: Sequence[str], mistakes: Sequence[str], taken: Iterable[str]
) -> Iterator[Fault]:
    names = set(taken)
    for n, named in enumerate(content.mutants):
        if named.check not in checks:
            text = f"the assignment has no check '{named.check}'{_hint(named.check, checks)}"
            yield ("mutants", n, "check"), text
        if named.mistake not in mistakes and not named.mistake.startswith(OWN):
            text = f"there is no mistake '{named.mistake}'{_hint(named.mistake, mistakes)}"
            yield ("mutants", n, "mistake"), text
        if named.name in names:
            yield ("mutants", n, "name"), f"there are two mutants '{named.name}'"
        names.add(named.name)
    explained: set[str] = set()
    for n, entry in enumerate(content.equivalent):
        if entry.mutant in explained:
            yield ("equivalent", n, "mutant"), f"'{entry.mutant}' is explained twice"
        explained.add(entry.mutant)


def _hint(word: str, known: Iterable[str]) -> str:
    close = nearest(word, known)
    return f": did you mean '{close}'?" if close else ""
