"""A text that is English and can still be said in another language.

Who makes a text does not know who will read it. `say` keeps what it was made of; a `Translator`
(grader.base.i18n.translator) says it again in the reader's language. Read as a plain string it is
English, so it may go wherever a string goes.
"""

from __future__ import annotations

from collections.abc import Callable
from collections.abc import Mapping

Translate = Callable[[str], str]
Value = str | int | float


class Message(str):
    """A template (gettext's msgid, in the form of `str.format`) and what fills it."""

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
        """Return the text in another language; what fills it is translated as well."""
        values = {name: _told(value, translate) for name, value in self.params.items()}
        return translate(self.template).format(**values)


class Joined(Message):
    """Texts one after the other, each to be translated by itself."""

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
        return self.by.join(str(_told(part, translate)) for part in self.parts)


def _told(value: Value, translate: Translate) -> Value:
    return value.translated(translate) if isinstance(value, Message) else value


def say(template: str, **params: Value) -> Message:
    """Return a text for a reader; `{name}` in the template stands for a parameter."""
    return Message(template, params)


def msg(template: str) -> str:
    """Mark a template that is filled later: it is gathered for translation, and no more."""
    return template


def joined(*parts: str, by: str = " ") -> Message:
    """Return the texts that are not empty, one after the other."""
    return Joined(tuple(part for part in parts if part), by)
