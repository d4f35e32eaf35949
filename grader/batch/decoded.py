"""Decodes a CSV file of a learning management system or a spreadsheet, whatever its encoding.

UTF-8 comes first, because it is recognised reliably. Other files were saved by a spreadsheet in a
regional encoding: CP949 on Korean Windows, CP1252 on Western Windows.
"""

from __future__ import annotations

from dataclasses import dataclass

from grader.base.errors import UsageError
from grader.base.i18n.message import say

BOM = b"\xef\xbb\xbf"
MARKS = ((BOM, "utf-8"), (b"\xff\xfe", "utf-16"), (b"\xfe\xff", "utf-16"))
AS_CSV = "Save it in the spreadsheet as 'CSV UTF-8'."
HEAD = 4_000  # bytes that are searched for a zero byte: the sign of a binary file
# Latin-1 text can be valid CP949, but is then rarely read as the common Hangul syllables
# (KS X 1001): `Å` before a lower-case letter is one of the other 8,822
KOREAN_SHARE = 0.8
FIRST_HANGUL, LAST_HANGUL = "\uac00", "\ud7a3"


@dataclass(frozen=True)
class Decoded:
    """A file's text, and in `note` what was assumed about its encoding.

    `marked` says whether a UTF-8 copy needs a byte order mark: the file had one, or it was not
    UTF-8 and its spreadsheet recognises UTF-8 only by the mark.
    """

    text: str
    marked: bool = False
    note: str = ""


def decoded(content: bytes, name: str) -> Decoded:
    """Return the text of a file, called `name` in errors; raise UsageError if it is not text."""
    for mark, encoding in MARKS:
        if content.startswith(mark):
            return Decoded(_after_mark(content, encoding, name), marked=True)
    if b"\0" in content[:HEAD]:
        raise UsageError(f"{name} is not a CSV file: it contains zero bytes", remedy=AS_CSV)
    try:
        return Decoded(content.decode("utf-8"))
    except UnicodeDecodeError:
        pass
    korean = _korean(content)
    if korean is not None:
        return _assumed(korean, name, "CP949 (Korean Windows)")
    try:
        return _assumed(content.decode("cp1252"), name, "Windows-1252 (Latin-1)")
    except UnicodeDecodeError:
        return _assumed(content.decode("latin-1"), name, "Latin-1")


def _after_mark(content: bytes, encoding: str, name: str) -> str:
    try:
        return content.decode(encoding).removeprefix("\ufeff")
    except UnicodeDecodeError as error:
        raise UsageError(
            f"{name} has the byte order mark of {encoding.upper()} but is not valid "
            f"{encoding.upper()} (byte {error.start})",
            remedy=AS_CSV,
        ) from None


def _korean(content: bytes) -> str | None:
    """Return the text if it is Korean: valid CP949, and mostly common Hangul syllables."""
    try:
        text = content.decode("cp949")
    except UnicodeDecodeError:
        return None
    foreign = [character for character in text if not character.isascii()]
    common = sum(_is_common_hangul(character) for character in foreign)
    return text if common >= KOREAN_SHARE * len(foreign) else None


def _is_common_hangul(character: str) -> bool:
    if not FIRST_HANGUL <= character <= LAST_HANGUL:
        return False
    try:
        return len(character.encode("euc_kr")) == 2  # the other syllables take 8 bytes
    except UnicodeEncodeError:
        return False


def _assumed(text: str, name: str, encoding: str) -> Decoded:
    note = say(
        "{name} is not UTF-8 and was read as {encoding}: check the names",
        name=name,
        encoding=encoding,
    )
    return Decoded(text, marked=True, note=note)
