"""English text that can still be translated.

The code that makes a text does not know its reader. `say` keeps the template and its parameters; a
`Translator` (grader.base.i18n.translator) renders them in the reader's language. As a plain string
it is English, so it can be used like any string.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping

Translate = Callable[[str], str]
Value = str | int | float


class Message(str):
    """A template (gettext's msgid, in the form of `str.format`) and its parameters."""

    __slots__ = ("params", "template")

    template: str
    params: Mapping[str, Value]

    def __new__(cls, template: str, params: Mapping[str, Value] | None = None) -> Message:
        """Fill the template; KeyError if a placeholder has no value."""
        values = dict(params or {})
        made = super().__new__(cls, template.format(**values))
        made.template, made.params = template, values
        return made

    def __reduce__(self) -> tuple[object, ...]:
        return Message, (self.template, dict(self.params))

    def __add__(self, other: str) -> str:
        return joined(self, other, by="")

    def __radd__(self, other: str) -> str:
        return joined(other, self, by="")

    def translated(self, translate: Translate) -> str:
        """Return the text in another language; its parameters are translated too."""
        values = {name: _translated(value, translate) for name, value in self.params.items()}
        return translate(self.template).format(**values)


class Joined(Message):
    """A sequence of texts, each translated by itself."""

    __slots__ = ("by", "parts")

    parts: tuple[str, ...]
    by: str

    def __new__(cls, parts: tuple[str, ...], by: str) -> Joined:
        """Join the parts with `by` between them."""
        made = str.__new__(cls, by.join(parts))
        made.parts, made.by = parts, by
        made.template, made.params = "", {}
        return made

    def __reduce__(self) -> tuple[object, ...]:
        return Joined, (self.parts, self.by)

    def translated(self, translate: Translate) -> str:
        """Return the parts in another language, joined in the same way."""
        return self.by.join(str(_translated(part, translate)) for part in self.parts)


def _translated(value: Value, translate: Translate) -> Value:
    return value.translated(translate) if isinstance(value, Message) else value


def say(template: str, **params: Value) -> Message:
    """Return a text for a reader; `{name}` in the template stands for a parameter."""
    return Message(template, params)


def msg(template: str) -> str:
    """Mark a template for translation; it is filled later."""
    return template


def joined(*parts: str, by: str = " ") -> Message:
    """Join the texts that are not empty."""
    return Joined(tuple(part for part in parts if part), by)
