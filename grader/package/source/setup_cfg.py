"""setup.cfg: its settings, each with its line."""

from __future__ import annotations

import configparser
import re
from dataclasses import dataclass

from grader.base.i18n.message import say

MOST_BYTES = 100_000
KEYS = {"develop": "script_dir", "install": "install_scripts"}
"""The setting of each section that says where executables are installed."""


class SetupCfgFault(Exception):  # noqa: N818 - a fault in the student's file, not an error
    """Why setuptools cannot read a setup.cfg, and on which line."""

    def __init__(self, text: str, line: int | None = None, *, is_encoding: bool = False) -> None:
        super().__init__(text)
        self.text = text
        self.line = line
        self.is_encoding = is_encoding


@dataclass(frozen=True)
class Setting:
    """A value and the line of its key."""

    value: str
    line: int


@dataclass(frozen=True)
class SetupCfg:
    """The sections of a setup.cfg, each with its settings; `lines` are their headings'."""

    sections: dict[str, dict[str, Setting]]
    lines: dict[str, int]
    text: str

    def line_of(self, words: str, start: int) -> int:
        """Return the first line from `start` on that contains `words`, else `start`."""
        for number, line in enumerate(self.text.splitlines(), start=1):
            if number >= start and words in line:
                return number
        return start


def read_setup_cfg(found: bytes) -> SetupCfg:
    """Read a setup.cfg as setuptools does (case-sensitive, `%` and `$` mean nothing).

    Raises SetupCfgFault.
    """
    if len(found) > MOST_BYTES:
        raise SetupCfgFault(say("the file is larger than {size} kB", size=MOST_BYTES // 1000))
    try:
        text = found.decode("utf-8")
    except UnicodeDecodeError as error:
        first = found.count(b"\n", 0, error.start) + 1
        raise SetupCfgFault(say("not UTF-8 text"), first, is_encoding=True) from None
    parser = configparser.RawConfigParser()
    parser.optionxform = str  # type: ignore[assignment,method-assign] # the documented way
    try:
        parser.read_string(text)
    except configparser.MissingSectionHeaderError as error:
        mark = text[:1] == "\ufeff"
        said = say("a line before the first [section]")
        said = say("a byte order mark before the first [section]") if mark else said
        raise SetupCfgFault(said, error.lineno, is_encoding=mark) from None
    except (configparser.DuplicateOptionError, configparser.DuplicateSectionError) as error:
        twice = getattr(error, "option", None) or f"[{error.section}]"
        raise SetupCfgFault(say("{twice} appears twice", twice=twice), error.lineno) from None
    except configparser.ParsingError as error:
        line = error.errors[0][0] if error.errors else None
        said = say("a line that is neither a [section] nor key=value")
        raise SetupCfgFault(said, line) from None
    except (configparser.Error, ValueError) as error:
        raise SetupCfgFault(str(error).splitlines()[0]) from None
    return _with_lines(parser, text)


def indented_heading(text: str) -> int:
    """Return the line of the first heading that continues the value above it; 0 if there is none."""
    has_value = False
    for number, row in enumerate(text.splitlines(), 1):
        if re.match(r"[ \t]+\[\w+\][ \t]*$", row) and has_value:
            return number
        has_value = has_value or re.match(r"[\w-]+[ \t]*[=:]", row) is not None
    return 0


def _with_lines(parser: configparser.RawConfigParser, text: str) -> SetupCfg:
    heads: dict[str, int] = {}
    keys: dict[tuple[str, str], int] = {}
    section = ""
    for number, line in enumerate(text.splitlines(), start=1):
        if line.startswith("[") and "]" in line:
            section = line[1 : line.rindex("]")]
            heads.setdefault(section, number)
        elif line[:1].strip():
            key = line.partition("=")[0].partition(":")[0].strip()
            keys.setdefault((section, key), number)
    sections = {
        name: {
            key: Setting((value or "").strip(), keys.get((name, key), heads.get(name, 1)))
            for key, value in parser.items(name)
        }
        for name in parser.sections()
    }
    return SetupCfg(sections, heads, text)
