"""Chooses between the two forms of a Korean particle, by the sound before it.

A translation has both forms, as in `{path}을(를)`, because a value is put before them.
"""

from __future__ import annotations

import re

FIRST, LAST = 0xAC00, 0xD7A3  # the Hangul syllables; each 28th has no final consonant
RIEUL = 8  # the final consonant after which 로 stands, as after a vowel
FORMS = {
    "을(를)": ("을", "를"),
    "이(가)": ("이", "가"),
    "은(는)": ("은", "는"),
    "과(와)": ("과", "와"),
    "와(과)": ("과", "와"),
    "(으)로": ("으로", "로"),
}
"""The form after a consonant, and after a vowel."""
PARTICLE = re.compile("|".join(map(re.escape, FORMS)))
SILENT = "'\"`’”)]}>»*_ /.:…"
DIGITS = {
    "0": 1,
    "1": RIEUL,
    "2": 0,
    "3": 1,
    "4": 0,
    "5": 0,
    "6": 1,
    "7": RIEUL,
    "8": RIEUL,
    "9": 0,
}
LATIN = {"l": RIEUL, "m": 1, "n": 1, "c": 1}
"""Letters with which a word, as Koreans say it, ends in a consonant: 토픽, 스핀, 엑스엠엘."""


def with_particles(text: str) -> str:
    """Return a Korean text with one form of each particle."""
    if "(" not in text:
        return text
    return PARTICLE.sub(lambda match: _form(match[0], text[: match.start()]), text)


def _form(both: str, before: str) -> str:
    """Return the form after a text; both if nothing is before it."""
    word = before[-40:].rstrip(SILENT)
    if not word:
        return both
    final = _final(word)
    after_consonant, after_vowel = FORMS[both]
    is_vowel = not final or (final == RIEUL and both == "(으)로")
    return after_vowel if is_vowel else after_consonant


def _final(word: str) -> int:
    """Return the final consonant with which a word is said; 0 if it ends in a vowel."""
    last = word[-1]
    if FIRST <= ord(last) <= LAST:
        return (ord(last) - FIRST) % 28
    if last in DIGITS:
        return DIGITS[last]
    return 1 if word.lower().endswith("ng") else LATIN.get(last.lower(), 0)
