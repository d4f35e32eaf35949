"""The data classes of the catalogue: a kind of mistake, and a recognised mistake."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import Literal

from grader.base.i18n.message import Message, Value
from grader.report.model import Mistake, Where

Stage = Literal[
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
    "shutdown",
    "limits",
]


@dataclass(frozen=True, kw_only=True)
class Kind:
    """One kind of mistake. Its texts are templates of `grader.base.i18n.message`.

    `why` explains ROS's behaviour, `fix` says what to do; `whys` and `fixes` have other texts for
    variants, by the variant's name. `link` is a page of the documentation. `seen` is a pattern
    that recognises the mistake in a terminal's output (its named groups become parameters).
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
        seen: str = "",
    ) -> Kind:
        """Return the kind `prefix.slug`; `close` is its fix if a similar name is known."""
        return Kind(
            id=f"{self.prefix}.{slug}",
            stage=stage,
            title=title,
            why=why,
            fix=fix,
            fixes={"close": close} if close else {},
            link=link or self.link,
            seen=seen,
        )


@dataclass(frozen=True, kw_only=True)
class RecognisedMistake:
    """A recognised mistake: the id of its kind, the values of the placeholders, and the place.

    `params` go into the report and are the same in every language; `words` only fill the texts.
    """

    kind: str
    params: Mapping[str, str | int | float] = field(default_factory=dict)
    words: Mapping[str, Value] = field(default_factory=dict)
    variant: str = ""
    where: Where | None = None

    @property
    def mistake(self) -> Mistake:
        """The mistake in the form of the report."""
        return Mistake(id=self.kind, params=dict(self.params))
