"""Whether two names are one name with a typing mistake, and not two names with other meanings."""

from __future__ import annotations

import re
from collections.abc import Iterable
from difflib import SequenceMatcher

from grader.base.nearest import nearest, without_accents

SAME = 0.7  # how like two words are of which one is the other with a typing mistake
SPELT = {"ä": "ae", "ö": "oe", "ü": "ue", "ß": "ss", "å": "aa", "æ": "ae", "ø": "oe", "ł": "l"}
SHORTEST = 3  # letters of a word that can be the beginning of another
WORDS = re.compile(r"[A-Z]+(?![a-z])|[A-Z]?[a-z]+|\d+")


def is_typo(name: str, other: str) -> bool:
    """Whether each word of a name is nearly the word of the other at the same place.

    get_loger is get_logger; get_time is not get_name, though three of four letters are the same.
    """
    if name.replace("_", "").lower() == other.replace("_", "").lower():
        return True
    words, others = ([w.lower() for w in WORDS.findall(text)] for text in (name, other))
    if len(words) != len(others):
        first, joined = "".join(words), "".join(others)
        starts = others[: len(words)] == words or words[: len(others)] == others
        return starts or SequenceMatcher(None, first, joined).ratio() > 0.9
    return all(_is_word(word, known) for word, known in zip(words, others, strict=True))


def _is_word(word: str, known: str) -> bool:
    short, long = sorted((word, known), key=len)
    begins = len(short) >= SHORTEST and long.startswith(short)
    return begins or SequenceMatcher(None, word, known).ratio() >= SAME


def _is_swapped(name: str, other: str) -> bool:
    """Whether two letters beside each other changed places: mgs is msg."""
    places = [at for at, (a, b) in enumerate(zip(name, other, strict=False)) if a != b]
    if len(name) != len(other) or len(name) < SHORTEST or len(places) != 2:
        return False
    first, second = places
    return second == first + 1 and name[first] + name[second] == other[second] + other[first]


def meant_by(name: str, known: Iterable[str], cutoff: float) -> str:
    """Return the known name of which a name is a misspelling; "" if there is none."""
    known = list(known)
    swapped = {other for other in known if _is_swapped(name, other)}
    if len(swapped) == 1:
        return swapped.pop()
    return nearest(name, [other for other in known if is_typo(name, other)], cutoff=cutoff)


def plain_letters(word: str) -> str:
    """Return a word as it is written without the letters of other alphabets: `zähler` is zaehler."""
    return without_accents("".join(SPELT.get(sign, sign) for sign in word.casefold()))
