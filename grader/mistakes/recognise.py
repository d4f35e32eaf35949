"""Recognise mistakes by the records of the catalogue, root causes first."""

from __future__ import annotations

import re
from collections.abc import Collection
from dataclasses import replace

from grader.mistakes.catalogue import CATALOGUE
from grader.mistakes.recognised import Raised, RecognisedMistake, Suspect

SYMPTOMS = frozenset(symptom for kind in CATALOGUE.values() for symptom in kind.behind)


def behind_error(raised: Raised, without: Collection[str] = ()) -> RecognisedMistake | None:
    """Return the mistake behind an exception, none of the kinds `without`; None if it is unknown."""
    raised = replace(raised, error=_as_written(raised))
    for kind in CATALOGUE.values():
        for pattern, look in kind.raised.items():
            match = re.search(pattern, raised.error)
            found = look(raised, match) if match else None
            if found is not None and found.kind not in without:
                return found
    return None


def _as_written(raised: Raised) -> str:
    """Return the error with names as the source has them: Python calls __x of the class A _A__x."""
    names = "|".join(re.escape(n.lstrip("_")) for n in raised.source.known_classes if n.strip("_"))
    mangled = rf"(?<=has no attribute ')_(?:{names})(?=__\w)"
    return re.sub(mangled, "", raised.error) if names else raised.error


def behind_symptom(
    symptom: str, suspect: Suspect, without: Collection[str] = ()
) -> RecognisedMistake | None:
    """Return the mistake of the source that causes a symptom, or None if none is recognised.

    Code that only looks like a mistake is not reported, nor is one of the kinds `without`.
    """
    for kind in CATALOGUE.values():
        look = kind.behind.get(symptom)
        found = look(suspect) if look is not None else None
        if found is not None and found.kind not in without:
            return found
    return None
