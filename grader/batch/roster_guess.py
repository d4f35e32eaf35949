"""Recognises the columns of a roster by their content, for headers in an unknown language.

Only columns with unknown names are examined, and only for fields that no known column has.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Collection, Sequence

from grader.batch.sheet import Sheet

PEEKED = 50  # rows that are examined
MOST = 0.9  # share of the rows that must fit in a column that people may have typed
LEAST_COLUMNS = 4  # of a Moodle worksheet: identifier, name, status, grade
PARTICIPANT = re.compile(r"([^\W\d_][^\d]*?)\s*(\d+)")  # a word in any script, then the number
PARTICIPANT_SYSTEM = "moodle"  # writes `Participant 123`
EMAIL = re.compile(r"[^@\s]+@[^@\s]+\.[^@\s]+")
NUMBER = re.compile(r"[A-Za-z]{0,3}[-.]?\d[\d.-]{3,14}")
NAME = re.compile(r"[^\W\d_]+(?:[ ,.'’·-]+[^\W\d_]+)*\.?")
CJK_NAME = re.compile(r"[\u3040-\u30ff\u3400-\u9fff\uac00-\ud7a3]{2,5}")  # written as one word
YEAR = re.compile(r"\b(?:19|20)\d\d\b|(?:19|20)\d\d(?=\D)")


def guessed(sheet: Sheet, unknown: Sequence[int], known: Collection[str]) -> dict[str, int]:
    """Return the column of each field that is recognised by content; `known` fields are skipped."""
    found: dict[str, int] = {}

    def look(field: str, fits: Callable[[list[str]], bool], *, unless: tuple[str, ...]) -> None:
        if any(other in known for other in unless):
            return
        for index in unknown:
            values = sheet.column(index)[:PEEKED]
            if index not in found.values() and any(values) and fits(values):
                found[field] = index
                return

    if unknown[:1] == [0] and len(sheet.header) >= LEAST_COLUMNS:
        look("key", _are_participants, unless=("key",))
    look("email", _are_emails, unless=("email",))
    look("id number", _are_numbers, unless=("id number", "username"))
    look("name", _are_names, unless=("name", "last name"))
    if "key" in known or "key" in found:
        look("submitted on", _are_dates, unless=())
    return found


def _are_participants(values: list[str]) -> bool:
    """Whether all values are the same word, each with a number of its own."""
    matches = [PARTICIPANT.fullmatch(value) for value in values]
    whole = [match for match in matches if match is not None]
    words, numbers = {match[1] for match in whole}, {match[2] for match in whole}
    return len(words) == 1 and len(numbers) == len(values)


def _are_emails(values: list[str]) -> bool:
    return all(EMAIL.fullmatch(value) for value in values if value)


def _are_numbers(values: list[str]) -> bool:
    """Whether all values are different numbers of several digits (1, 2, 3, … number the lines)."""
    given = [value for value in values if value]
    return (
        len(given) >= MOST * len(values)
        and len(set(given)) == len(given)
        and all(NUMBER.fullmatch(value) for value in given)
    )


def _are_names(values: list[str]) -> bool:
    """Whether these are people's names: several words of letters (or CJK), hardly any repeated."""
    given = [value for value in values if value]
    named = [value for value in given if NAME.fullmatch(value)]
    whole = [v for v in named if CJK_NAME.fullmatch(v) or len(re.findall(r"[^\W\d_]+", v)) > 1]
    return min(len(whole), len(set(named))) >= MOST * len(values)


def _are_dates(values: list[str]) -> bool:
    """Whether these are times, or `-` for none."""
    given = [value for value in values if value not in ("", "-")]
    return all(YEAR.search(value) and len(value) > len("2026") for value in given) and bool(given)
