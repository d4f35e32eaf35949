"""The record of a mistake: its texts, and how it is recognised, fixed and made."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, Literal, TypedDict

from grader.base.i18n.message import Message, Value
from grader.mistakes.example import Example
from grader.mistakes.fixes.case import Fix
from grader.mistakes.recognised import FromError, FromSource

if TYPE_CHECKING:
    from typing_extensions import Unpack

Stage = Literal[
    "environment",
    "terminal",
    "hand-in",
    "manifest",
    "marker",
    "setup.cfg",
    "entry point",
    "file",
    "exec bit",
    "first line",
    "build",
    "start",
    "class",
    "timer",
    "callback",
    "counter",
    "text",
    "logger",
    "spin",
    "topic",
    "parameter",
    "service",
    "world",
    "shutdown",
    "limits",
]


@dataclass(frozen=True, kw_only=True)
class Kind:
    """One kind of mistake. Its texts are templates of `grader.base.i18n.message`.

    `why` explains ROS's behaviour, `fix` says what to do; `whys` and `fixes` have other texts for
    variants, by the variant's name. `link` is a page of the documentation.

    How it is recognised: `seen` is a pattern of a terminal's output (its named groups become
    parameters), `raised` has functions by the pattern of an exception's last line, and `behind`
    functions by the symptom of a run. What the files alone show is recognised by the check.
    `fixed_by` are the fixes, in the order in which they are tried. `examples` are edits of a
    right package that make the mistake. `deletes` are the variants whose fix takes away the statement
    of the finding ("" is the fix without a variant): if its block has no other, the text says what
    becomes of the block (`whole_block.py`).
    """

    id: str
    stage: Stage
    title: str
    why: str
    fix: str
    link: str
    whys: Mapping[str, str] = field(default_factory=dict)
    fixes: Mapping[str, str] = field(default_factory=dict)
    seen: str = ""
    raised: Mapping[str, FromError] = field(default_factory=dict)
    behind: Mapping[str, FromSource] = field(default_factory=dict)
    fixed_by: tuple[Fix, ...] = ()
    examples: tuple[Example, ...] = ()
    deletes: tuple[str, ...] = ()

    @cached_property
    def pattern(self) -> re.Pattern[str] | None:
        """The compiled `seen`; None if a terminal does not show this mistake."""
        return re.compile(self.seen, re.MULTILINE) if self.seen else None

    def rationale(self, values: Mapping[str, Value], variant: str = "") -> Message:
        """Return why it matters. KeyError if a placeholder has no value."""
        return Message(self.whys.get(variant, self.why), values)

    def fix_text(self, values: Mapping[str, Value], variant: str = "") -> Message:
        """Return what to do. KeyError if a placeholder has no value."""
        return Message(self.fixes.get(variant, self.fix), values)


class Parts(TypedDict, total=False):
    """The parts of a record that are not texts."""

    seen: str
    raised: Mapping[str, FromError]
    behind: Mapping[str, FromSource]
    fixed_by: tuple[Fix, ...]
    examples: tuple[Example, ...]
    deletes: tuple[str, ...]


class Variants(Parts, total=False):
    """The same, and texts for variants of the mistake, by the variant's name."""

    whys: Mapping[str, str]
    fixes: Mapping[str, str]


@dataclass(frozen=True)
class Family:
    """Makes kinds whose ids have the same prefix; `link` is their page of the documentation."""

    prefix: str
    link: str

    def __call__(
        self,
        slug: str,
        stage: Stage,
        title: str,
        why: str,
        fix: str,
        link: str = "",
        *,
        close: str = "",
        **parts: Unpack[Variants],
    ) -> Kind:
        """Return the kind `prefix.slug`; `close` is its fix if a similar name is known."""
        known = {"close": close} if close else {}
        parts["fixes"] = {**known, **parts.get("fixes", {})}
        return Kind(
            id=f"{self.prefix}.{slug}",
            stage=stage,
            title=title,
            why=why,
            fix=fix,
            link=link or self.link,
            **parts,
        )
