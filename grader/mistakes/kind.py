"""The record of a mistake: its texts, and how it is recognised, fixed and made."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, Literal, TypedDict

from grader.base.i18n.message import Message, Value, joined, msg
from grader.mistakes.example import Example
from grader.mistakes.fixes.case import Fix
from grader.mistakes.recognised import FromError, FromSource

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from grader.package.source.node import NodeSource

Stage = Literal[
    "environment",
    "terminal",
    "general",
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


FOLLOWED = msg(
    "The code for this is there. Look at the conditions on the way to it, and at the values that it "
    "gets: it does not run at that time, or it does something else."
)
"""What is told in place of advice that the source follows already."""

INSTEAD = msg("Write {written} instead of {name}.")


@dataclass(frozen=True)
class Step:
    """A part of a fix, and whether a source has it already; `done` gets the placeholders' values."""

    text: str
    done: Callable[[NodeSource, Mapping[str, Value]], bool]


@dataclass(frozen=True, kw_only=True)
class Kind:
    """One kind of mistake. Its texts are templates of `grader.base.i18n.message`.

    `why` explains ROS's behaviour, `fix` says what to do; `whys` and `fixes` have other texts for
    variants, by the variant's name. `link` is a page of the documentation.

    How it is recognised: `seen` is a pattern of a terminal's output (its named groups become
    parameters), `raised` has functions by the pattern of an exception's last line, and `behind`
    functions by the symptom of a run. What the files alone show is recognised by the check.
    `fixed_by` are the fixes, in the order in which they are tried. `examples` are edits of a
    right package that make the mistake.

    `of_shape` is of what a node is made of: its ends, names and types, which no value decides. `steps`
    are the parts of the fix that a source may have already, by the variant: these are left out.
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
    of_shape: bool = False
    steps: Mapping[str, tuple[Step, ...]] = field(default_factory=dict)

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

    def fix_for(self, source: NodeSource | None, values: Mapping[str, Value], variant: str) -> str:
        """Return what to do in a source: no advice that it follows already."""
        steps = self.steps.get(variant if variant in self.fixes else "", ())
        left = [step for step in steps if source is None or not step.done(source, values)]
        if len(left) == len(steps):
            return self.fix_text(values, variant)
        return joined(*(Message(one.text, values) for one in left)) if left else Message(FOLLOWED)


class Parts(TypedDict, total=False):
    """The parts of a record that are not texts."""

    seen: str
    raised: Mapping[str, FromError]
    behind: Mapping[str, FromSource]
    fixed_by: tuple[Fix, ...]
    examples: tuple[Example, ...]
    of_shape: bool
    steps: Mapping[str, tuple[Step, ...]]


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
