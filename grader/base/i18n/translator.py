"""The reader's language, and texts translated into it."""

from __future__ import annotations

import contextlib
import functools
import gettext
import os
from collections.abc import Iterator, Mapping
from pathlib import Path

from grader.base.errors import GraderError
from grader.base.i18n.message import Message, must_be_filled
from grader.base.i18n.particles import with_particles

DOMAIN = "grader"
FOLDER = Path(__file__).resolve().parent
LANGUAGES = ("en", "ko")
SAMPLES = {"en": "", "ko": "\uac00"}  # a character that an encoding must have
SOURCE = "en"  # the language of the templates
OWN = "GRADER_LANG"  # for a locale that has no language: a container has only C.UTF-8


class Translator:
    """Translates texts into one language; a text without a translation stays English."""

    def __init__(self, lang: str) -> None:
        self.lang = lang if lang in LANGUAGES else SOURCE

    def __call__(self, text: str) -> str:
        """Return a text in the language; a string that is not a `Message` is returned unchanged.

        UnfilledError for a template whose places have no values.
        """
        if not isinstance(text, Message):
            must_be_filled(text)
            return text
        if self.lang == SOURCE:
            return str(text)
        found = text.translated(_catalogue(self.lang))
        return with_particles(found) if self.lang == "ko" else found


def translated(template: str, lang: str) -> str:
    """Return a template in a language, not filled; English if it has no translation."""
    # (the empty msgid is the catalogue's header)
    return _catalogue(lang).gettext(template) if template else ""


@functools.lru_cache(maxsize=len(LANGUAGES))
def _catalogue(lang: str) -> gettext.NullTranslations:
    """Return a language's translations, loaded once: a class has thousands of texts."""
    if lang == SOURCE:
        return gettext.NullTranslations()
    return gettext.translation(DOMAIN, FOLDER, [lang], fallback=True)


@contextlib.contextmanager
def errors_in(lang: str | None) -> Iterator[None]:
    """Translate the texts of errors that a user can cause."""
    try:
        yield
    except GraderError as error:
        translate = Translator(lang or chosen_language(os.environ))
        error.message, error.remedy = translate(error.message), translate(error.remedy)
        raise


def chosen_language(environment: Mapping[str, str]) -> str:
    """Return the language that the environment asks for: GRADER_LANG, else as GNU gettext reads it.

    LC_ALL, LC_MESSAGES and LANG in this order give the locale; unless that is C, LANGUAGE lists
    the languages in order of preference (GNU gettext manual, "The LANGUAGE variable").
    """
    if _language(environment.get(OWN, "")) in LANGUAGES:
        return _language(environment[OWN])
    names = ("LC_ALL", "LC_MESSAGES", "LANG")
    locale = next((environment[name] for name in names if environment.get(name)), "")
    if _language(locale) in ("", "c", "posix"):
        return SOURCE
    for wanted in [*environment.get("LANGUAGE", "").split(":"), locale]:
        if _language(wanted) in LANGUAGES:
            return _language(wanted)
    return SOURCE


def _language(locale: str) -> str:
    """Return the language of a locale's name: `ko` of `ko_KR.UTF-8`."""
    return locale.partition(".")[0].partition("@")[0].partition("_")[0].lower()
