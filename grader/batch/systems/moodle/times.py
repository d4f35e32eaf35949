"""The times in Moodle's worksheet: the status text and the column of the last modification.

By mod/assign/gradingtable.php: `col_status` joins its parts by ` - `: the state, `submittedlateshort`
(`{time} late`), `graded`, `userextensiondate` (`Extension granted until: {date}`); a time is that of
`format_time` (the two largest units, cut off), a date that of `strftimedaydatetime`, in the time zone
of the person who downloads. The words are those of the English and Korean language packs. Of other
languages only the dates are read.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from datetime import datetime

from grader.base.nearest import without_accents
from grader.batch.systems.moodle.words import says_submitted
from grader.batch.times import Times

UNITS = {
    31_536_000: ("year", "years", "년"),
    604_800: ("week", "weeks", "주"),
    86_400: ("day", "days", "일"),
    3_600: ("hour", "hours", "시간"),
    60: ("min", "mins", "minute", "minutes", "분"),
    1: ("sec", "secs", "second", "seconds", "초"),
}
SECONDS = {word: seconds for seconds, words in UNITS.items() for word in words}
AMOUNT = re.compile(rf"(\d+)\s*({'|'.join(sorted(SECONDS, key=len, reverse=True))})(?![a-z])")
LATE = re.compile(rf"((?:{AMOUNT.pattern}\s*)+)(?:late|늦음)")
ON_TIME = ("submitted for grading", "채점을 위해 제출")

# without accents; a month of a language that is not here is not read, never guessed from its beginning:
# Finnish `marraskuu` is not March. English, German, French, Spanish, Italian, Portuguese, Dutch,
# Swedish, Danish and Norwegian
MONTHS = tuple(
    frozenset(names.split())
    for names in (
        "january januar janvier enero gennaio janeiro januari",
        "february februar fevrier febrero febbraio fevereiro februari",
        "march marz mars marzo marco maart",
        "april avril abril aprile",
        "may mai mayo maggio maio mei maj",
        "june juni juin junio giugno junho",
        "july juli juillet julio luglio julho",
        "august aout agosto augustus augusti",
        "september septembre septiembre setiembre settembre setembro",
        "october oktober octobre octubre ottobre outubro",
        "november novembre noviembre novembro",
        "december dezember decembre diciembre dicembre dezembro desember",
    )
)
WORD = r"(?P<month>[^\W\d_]{3,})"
DATES = (
    re.compile(
        r"(?P<year>\d{4})\s*[년年]\s*(?P<number>\d{1,2})\s*[월月]\s*(?P<day>\d{1,2})\s*[일日]"
    ),
    re.compile(r"(?P<year>\d{4})-(?P<number>\d\d)-(?P<day>\d\d)"),
    re.compile(r"(?P<day>\d{1,2})\.\s?(?P<number>\d{1,2})\.\s?(?P<year>\d{4})"),
    re.compile(rf"(?P<day>\d{{1,2}})\.?\s+(?:de\s+)?{WORD},?\s+(?:de\s+)?(?P<year>\d{{4}})"),
    re.compile(rf"{WORD}\s+(?P<day>\d{{1,2}}),?\s+(?P<year>\d{{4}})"),
)
CLOCK = re.compile(
    r"(?P<before>am|pm|오전|오후|上午|下午|午前|午後)?\s*(?P<hour>\d{1,2})[:.h](?P<minute>\d\d)"
    r"(?::\d\d)?(?:\s*(?P<after>[ap]\.?\s?m\b))?"
)
MORNING, AFTERNOON = ("am", "오전", "上午", "午前"), ("pm", "오후", "下午", "午後")


def times(cells: Mapping[str, str]) -> Times:
    """Return what the cells of a student's row say about the time of submission."""
    status = cells["status"]
    if not says_submitted(status, cells["submitted on"]):
        return Times(extension=extension(status))
    return Times(date_in(cells["submitted on"]), late_by(status), extension(status))


def late_by(status: str) -> float | None:
    """Return by how many seconds a status says that a submission is late.

    0 if the words are known and say nothing of it, None in another language.
    """
    folded = status.casefold()
    found = LATE.search(folded)
    if found is not None:
        parts = AMOUNT.findall(found[1])
        return float(sum(int(count) * SECONDS[unit] for count, unit in parts))
    return 0.0 if folded.strip().startswith(ON_TIME) else None


def extension(status: str) -> datetime | None:
    """Return the only date in a status: until when the student's due date was extended."""
    return date_in(status)


def date_in(text: str) -> datetime | None:
    """Return the date and time in a text, without a zone; None if it cannot be read for sure."""
    # (NFKD would take Korean letters apart)
    folded = (
        without_accents(text) if text.isascii() or not _has_syllables(text) else text.casefold()
    )
    for form in DATES:
        match = form.search(folded)
        clock = CLOCK.search(folded, match.end()) if match else None
        if match is None or clock is None:
            continue
        month = _month(match.groupdict())
        hour = _hour(clock)
        try:
            return datetime(
                int(match["year"]), month, int(match["day"]), hour, int(clock["minute"])
            )
        except ValueError:
            return None
    return None


def _has_syllables(text: str) -> bool:
    return any("\uac00" <= character <= "\ud7a3" for character in text)


def _month(parts: Mapping[str, str | None]) -> int:
    """Return the number of a month, 0 if its name is not known."""
    if parts.get("number"):
        return int(parts["number"] or 0)
    name = parts["month"] or ""
    return next((n for n, names in enumerate(MONTHS, start=1) if name in names), 0)


def _hour(clock: re.Match[str]) -> int:
    half = (clock["before"] or clock["after"] or "").replace(".", "").replace(" ", "")
    hour = int(clock["hour"])
    if half in (*MORNING, *AFTERNOON):
        return hour % 12 + (12 if half in AFTERNOON else 0)
    return hour
