"""setup.cfg: its settings, each with its line."""

from __future__ import annotations

import configparser
import re
from dataclasses import dataclass

from grader.base.i18n.message import say
from grader.base.nearest import nearest

MOST_BYTES = 100_000
NO_EQUALS = re.compile(r"[ \t]*(?P<key>script[_-]dir|install[_-]scripts)[ \t]*(?P<value>\$.*)")
KEYS = {"develop": "script_dir", "install": "install_scripts"}
"""The setting of each section that says where executables are installed."""
VARIABLE = re.compile(r"(?:\$\{?|%\(|\{)(?P<name>\w{1,80})(?:\}|\)s)?")
KNOWN = (
    *("base", "platbase", "usersite", "userbase", "prefix", "exec_prefix", "sys_prefix"),
    *("sys_exec_prefix", "dist_name", "dist_version", "dist_fullname", "py_version"),
    *("py_version_short", "py_version_nodot", "abiflags", "platlibdir", "implementation"),
    *("implementation_lower", "HOME"),
)
"""The names after $ that setuptools replaces in a path."""


class SetupCfgFault(Exception):  # noqa: N818 - a fault in the student's file, not an error
    """Why setuptools cannot read a setup.cfg, and on which line."""

    def __init__(
        self,
        text: str,
        line: int | None = None,
        variant: str = "",
        other: str = "",
        there: int = 0,
    ) -> None:
        super().__init__(text)
        self.text = text
        self.line = line
        self.variant = variant
        self.other = other
        self.there = there


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
        raise SetupCfgFault(say("not UTF-8 text"), first, "encoding") from None
    parser = configparser.RawConfigParser()
    parser.optionxform = str  # type: ignore[assignment,method-assign] # the documented way
    try:
        parser.read_string(text)
    except configparser.MissingSectionHeaderError as error:
        raise _without_section(text, error.lineno) from None
    except (configparser.DuplicateOptionError, configparser.DuplicateSectionError) as error:
        twice = getattr(error, "option", None) or f"[{error.section}]"
        section = getattr(error, "option", None) is None
        other = {"develop": "install", "install": "develop"}.get(error.section, "")
        missing = section and other and f"[{other}]" not in text
        raise SetupCfgFault(
            say("{twice} appears twice", twice=twice),
            error.lineno,
            "section" if missing else "twice",
            other,
        ) from None
    except configparser.ParsingError as error:
        line = error.errors[0][0] if error.errors else None
        sign = _comment_sign(text, line)
        key = NO_EQUALS.match(text.splitlines()[line - 1]) if line else None
        raise SetupCfgFault(
            say("a line that is neither a [section] nor key=value"),
            line,
            "comment" if sign else "equals" if key else "",
            sign or (f"{key['key']}={key['value'].strip()}" if key else ""),
        ) from None
    except (configparser.Error, ValueError) as error:
        raise SetupCfgFault(str(error).splitlines()[0]) from None
    return _with_lines(parser, text)


COMMENT = re.compile(r"[ \t]*(?P<sign>%+|//+|--+|/\*+|<!--+|\"\"\"|''')[^=\[\n]*")
"""A comment as other languages write it."""


def _comment_sign(text: str, line: int | None) -> str:
    """Return with what a line begins if it is a comment of another language; "" if it is none."""
    rows = text.splitlines()
    match = COMMENT.fullmatch(rows[line - 1]) if line and line <= len(rows) else None
    return match["sign"] if match is not None else ""


def _without_section(text: str, line: int) -> SetupCfgFault:
    """Return what is wrong with the first line of a file that does not begin with a section."""
    if text[:1] == "\ufeff":
        return SetupCfgFault(say("a byte order mark before the first [section]"), line, "mark")
    reason, rows = say("a line before the first [section]"), text.splitlines()
    sign = _comment_sign(text, line)
    if sign:
        return SetupCfgFault(reason, line, "comment", sign)
    if "[" not in text and all(key in text for key in KEYS.values()):
        bare = re.search(r"^(?:develop|install)[ \t]*:?[ \t]*$", text, re.MULTILINE)
        return SetupCfgFault(reason, line, "bare_headings" if bare else "headings")
    row = rows[line - 1] if line <= len(rows) else ""
    heading = re.fullmatch(r"\[?(develop|install)\]?[ \t]*", row)
    if heading is not None:
        return SetupCfgFault(reason, line, "half_heading", heading[1])
    key = re.split(r"[=:\s]", row.strip(), maxsplit=1)[0].replace("-", "_")
    section = next((name for name, known in KEYS.items() if known == key), "")
    there = next((n for n, r in enumerate(rows, 1) if r.strip() == f"[{section}]"), 0)
    if not section or row[:1].isspace():
        return SetupCfgFault(reason, line, "no_section")
    return SetupCfgFault(reason, line, "below" if there else "heading_above", section, there)


def indented_heading(text: str) -> int:
    """Return the line of the first heading that continues the value above it; 0 if there is none."""
    has_value = False
    for number, row in enumerate(text.splitlines(), 1):
        if re.match(r"[ \t]+\[\w+\][ \t]*$", row) and has_value:
            return number
        has_value = has_value or re.match(r"[\w-]+[ \t]*[=:]", row) is not None
    return 0


def meant_key(cfg: SetupCfg, section: str, wanted: str) -> str:
    """Return the key of a section that stands in place of the one it needs; "" if none does."""
    settings, key = cfg.sections.get(section, {}), KEYS[section]
    others = {name for name in KEYS.values() if name != key}
    close = nearest(key, settings)
    placed = (
        name
        for name, setting in settings.items()
        if name.replace("-", "_") in others or setting.value.rstrip("/") == wanted
    )
    return close or next(placed, "")


def is_swapped(cfg: SetupCfg) -> bool:
    """Whether each of the two sections has only the key of the other one."""
    there = {
        section: {key.replace("-", "_") for key in cfg.sections.get(section, {})}
        for section in KEYS
    }
    return there == {"develop": {KEYS["install"]}, "install": {KEYS["develop"]}}


def behind_heading(text: str, section: str) -> int:
    """Return the line of a heading with a setting behind it, which is not read; 0 if none has one."""
    pattern = re.compile(rf"\[{re.escape(section)}\][ \t]*[\w-]+[ \t]*[=:]")
    rows = enumerate(text.splitlines(), 1)
    return next((number for number, row in rows if pattern.match(row)), 0)


def slip_of_path(value: str, wanted: str) -> tuple[str, str]:
    """Return how a path differs from the right one, and a name that setup.cfg does not know.

    "" if it is another path.
    """
    if value[:1] in ("'", '"') and value.strip("'\"").rstrip("/") == wanted:
        return "quotes", ""
    if re.split(r"\s[#;]", value, maxsplit=1)[0].rstrip().rstrip("/") == wanted != value:
        return "comment", ""
    names = [m for m in VARIABLE.finditer(value) if m["name"] not in KNOWN]
    if names and value.replace(names[0][0], names[0][0].lower()).rstrip("/") == wanted:
        return "capitals", names[0][0]
    return ("variable", names[0][0]) if names else ("", "")


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
