"""English text that can still be translated.

The code that makes a text does not know its reader. `say` keeps the template and its parameters; a
`Translator` (grader.base.i18n.translator) renders them in the reader's language. As a plain string
it is English, so it can be used like any string.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from string import Formatter
from typing import Protocol

Value = str | int | float


class Catalogue(Protocol):
    """The translations into one language, such as `gettext.GNUTranslations`."""

    def gettext(self, template: str, /) -> str:
        """Return a template in the language."""

    def ngettext(self, one: str, many: str, count: int, /) -> str:
        """Return the template for a count in the language."""


class Template(str):
    """A text of the source that is filled later: no reader may see it as it is."""

    __slots__ = ()

    @property
    def places(self) -> list[str]:
        """The names of its places, such as `topic` of `{topic}`."""
        return [name for _, name, _, _ in Formatter().parse(self) if name is not None]


class UnfilledError(ValueError):
    """A text with places would have been shown without their values."""


def must_be_filled(value: Value) -> None:
    """Raise UnfilledError for a template with places: `say` or `Message` must fill it first."""
    if isinstance(value, Template) and value.places:
        raise UnfilledError(f"a text is shown without its values: {str(value)!r}")


class Message(str):
    """A template (gettext's msgid, in the form of `str.format`) and its parameters."""

    __slots__ = ("params", "template")

    template: str
    params: Mapping[str, Value]

    def __new__(cls, template: str, params: Mapping[str, Value] | None = None) -> Message:
        """Fill the template; KeyError if a placeholder has no value."""
        values = dict(params or {})
        for value in values.values():
            must_be_filled(value)
        made = super().__new__(cls, template.format(**values))
        made.template, made.params = template, values
        return made

    def __reduce__(self) -> tuple[object, ...]:
        return Message, (self.template, dict(self.params))

    def __add__(self, other: str) -> str:
        return joined(self, other, by="")

    def __radd__(self, other: str) -> str:
        return joined(other, self, by="")

    def translated(self, catalogue: Catalogue) -> str:
        """Return the text in another language; its parameters are translated too."""
        values = {name: _translated(value, catalogue) for name, value in self.params.items()}
        return self._translated_template(catalogue).format(**values)

    def _translated_template(self, catalogue: Catalogue) -> str:
        # (the empty msgid is the catalogue's header)
        return catalogue.gettext(self.template) if self.template else ""


class Plural(Message):
    """A text with a count: `template` is for 1, `many` for every other count."""

    __slots__ = ("many", "number")

    many: str
    number: int

    def __new__(
        cls, one: str, many: str, count: int, params: Mapping[str, Value] | None = None
    ) -> Plural:
        """Fill the template for the count; KeyError if a placeholder has no value."""
        values = {**(params or {}), "count": count}
        made = str.__new__(cls, (one if count == 1 else many).format(**values))
        made.template, made.many, made.number, made.params = one, many, count, values
        return made

    def __reduce__(self) -> tuple[object, ...]:
        return Plural, (self.template, self.many, self.number, dict(self.params))

    def _translated_template(self, catalogue: Catalogue) -> str:
        return catalogue.ngettext(self.template, self.many, self.number)


class Reworded(Message):
    """A text whose template names some code in another way, in every language.

    The values of its parameters stay as they are.
    """

    __slots__ = ("words",)

    words: tuple[tuple[str, str], ...]

    def __new__(
        cls, template: str, params: Mapping[str, Value], words: tuple[tuple[str, str], ...]
    ) -> Reworded:
        """Fill the template after these replacements, which may contain placeholders."""
        made = str.__new__(cls, _replaced(template, words).format(**params))
        made.template, made.params, made.words = template, dict(params), words
        return made

    def __reduce__(self) -> tuple[object, ...]:
        return Reworded, (self.template, dict(self.params), self.words)

    def _translated_template(self, catalogue: Catalogue) -> str:
        return _replaced(catalogue.gettext(self.template), self.words)


def _replaced(template: str, words: tuple[tuple[str, str], ...]) -> str:
    for old, new in words:
        template = template.replace(old, new)
    return template


class Joined(Message):
    """A sequence of texts, each translated by itself."""

    __slots__ = ("by", "parts")

    parts: tuple[str, ...]
    by: str

    def __new__(cls, parts: tuple[str, ...], by: str) -> Joined:
        """Join the parts with `by` between them."""
        for part in parts:
            must_be_filled(part)
        made = str.__new__(cls, by.join(parts))
        made.parts, made.by = parts, by
        made.template, made.params = "", {}
        return made

    def __reduce__(self) -> tuple[object, ...]:
        return Joined, (self.parts, self.by)

    def translated(self, catalogue: Catalogue) -> str:
        """Return the parts in another language, joined in the same way."""
        return self.by.join(str(_translated(part, catalogue)) for part in self.parts)


def _translated(value: Value, catalogue: Catalogue) -> Value:
    return value.translated(catalogue) if isinstance(value, Message) else value


def say(template: str, **params: Value) -> Message:
    """Return a text for a reader; `{name}` in the template stands for a parameter."""
    return Message(template, params)


def say_plural(one: str, many: str, count: int, **params: Value) -> Message:
    """Return a text with a count: `one` for 1, else `many`; `{count}` stands for the count."""
    return Plural(one, many, count, params)


def msg(template: str) -> Template:
    """Mark a template for translation; it is filled later."""
    return Template(template)


def reworded(text: str, words: tuple[tuple[str, str], ...]) -> str:
    """Return a text with other code in its templates; one that is no message as it is."""
    if isinstance(text, Joined):
        return Joined(tuple(reworded(part, words) for part in text.parts), text.by)
    if type(text) is not Message or not words:
        return text
    return Reworded(text.template, text.params, words)


def joined(*parts: str, by: str = " ") -> Message:
    """Join the texts that are not empty."""
    return Joined(tuple(part for part in parts if part), by)


def some_of(names: Sequence[str], most: int) -> Message:
    """Return the first `most` names, and how many more there are."""
    left = len(names) - most
    more = say(" and {count} more", count=left) if left > 0 else ""
    return joined(", ".join(names[:most]), more, by="")
