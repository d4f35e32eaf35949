"""Fixes of setup.cfg."""

from __future__ import annotations

import re

from grader.base.nearest import nearest
from grader.mistakes.fixes.case import Case
from grader.package.edit.files import Files
from grader.package.edit.text import SourceText, Splice, indent_of, read_text
from grader.package.source.setup_cfg import (
    COMMENT,
    KEYS,
    NO_EQUALS,
    SetupCfg,
    SetupCfgFault,
    behind_heading,
    indented_heading,
    is_swapped,
    meant_key,
    read_setup_cfg,
)

FILE = "setup.cfg"


def wanted(package: str) -> str:
    """Return the folder in which `ros2 run` looks for executables."""
    return f"$base/lib/{package}"


def missing(case: Case) -> Files | None:
    """Create the missing setup.cfg, or rename a file with a nearly right name."""
    if FILE in case.files.by_path:
        return None
    close = nearest(FILE, case.files.names_in(""), cutoff=0.8)
    if close and case.files.file(close) is not None:
        return case.files.with_move(close, FILE)
    rows = [(f"[{section}]", f"{key}={wanted(case.package)}") for section, key in KEYS.items()]
    return case.with_data(FILE, "".join(f"{row}\n" for pair in rows for row in pair).encode())


def setting(case: Case) -> Files | None:
    """Set the key in the section that the finding names."""
    found = case.files.data(FILE)
    text = read_text(found)
    section = str(case.finding.params.get("section", ""))
    if found is None or text is None or section not in KEYS:
        return None
    try:
        cfg = read_setup_cfg(found)
    except SetupCfgFault:
        return None
    if indented_heading(text.text):
        return _unindented(case, text)
    if is_swapped(cfg):
        return _swapped(case, text)
    if behind_heading(text.text, section):
        return _broken_line(case, text)
    if (joined := _joined(case, cfg, text)) is not None:
        return joined
    change = _change(cfg, text, section, f"{KEYS[section]}={wanted(case.package)}")
    return case.with_data(FILE, text.spliced([change])) if change else None


def _numbers(text: SourceText) -> range:
    return range(1, len(text.lines) + 1)


def _unindented(case: Case, text: SourceText) -> Files | None:
    """Move the headings and the keys to the margin."""
    splices = []
    for number in _numbers(text):
        match = re.match(r"[ \t]+(?=\[\w+\]|[a-z_-]+[ \t]*=)", text.line(number))
        start = text.start_of(number)
        splices += [Splice(start, start + match.end(), "")] if match is not None else []
    new = text.spliced(splices)
    if new is None or not _is_read(new):
        return None
    there = read_setup_cfg(new).sections
    right = all(key in there.get(section, {}) for section, key in KEYS.items())
    return case.with_data(FILE, new) if right else None


def _broken_line(case: Case, text: SourceText) -> Files | None:
    """Begin a new line behind each heading."""
    splices = []
    for number in _numbers(text):
        match = re.match(r"\[\w+\](?P<gap>[ \t]*)(?=[\w-]+[ \t]*[=:])", text.line(number))
        start = text.start_of(number)
        ends = (start + match.start("gap"), start + match.end()) if match else (0, 0)
        splices += [Splice(*ends, text.newline)] if match is not None else []
    new = text.spliced(splices) if splices else None
    return case.with_data(FILE, new) if new and _is_read(new) else None


def _joined(case: Case, cfg: SetupCfg, text: SourceText) -> Files | None:
    """Write two sections in place of one whose heading names both."""
    names = [name for name in cfg.sections if all(section in name for section in KEYS)]
    start = cfg.lines.get(names[0], 0) if len(names) == 1 else 0
    if not start or set(cfg.sections[names[0]]) - set(KEYS.values()):
        return None
    last = start
    while last < len(text.lines) and text.line(last + 1).strip()[:1] not in ("", "["):
        last += 1
    rows = [(f"[{section}]", f"{key}={wanted(case.package)}") for section, key in KEYS.items()]
    new = text.newline.join(row for pair in rows for row in pair)
    return case.with_data(
        FILE, text.spliced([Splice(text.start_of(start), text.end_of(last), new)])
    )


def _swapped(case: Case, text: SourceText) -> Files | None:
    """Exchange the keys of the two sections."""
    names = {KEYS["install"]: KEYS["develop"], KEYS["develop"]: KEYS["install"]}
    splices = []
    for number in _numbers(text):
        match = re.match(r"(install[_-]scripts|script[_-]dir)(?=[ \t]*[=:])", text.line(number))
        if match is not None:
            start = text.start_of(number)
            new = names[match[1].replace("-", "_")]
            splices.append(Splice(start, start + match.end(), new))
    new_text = text.spliced(splices) if len(splices) == 2 else None
    return case.with_data(FILE, new_text) if new_text else None


def _change(cfg: SetupCfg, text: SourceText, section: str, row: str) -> Splice | None:
    key = KEYS[section]
    if section not in cfg.sections:
        close = nearest(section, cfg.sections, cutoff=0.75)
        head = cfg.lines.get(close)
        if close and head is None:
            return None
        if head is not None:
            at = text.start_of(head) + text.line(head).find(close)
            return Splice(at, at + len(close), section)
        return text.before(len(text.lines) + 1, f"[{section}]", row)
    settings = cfg.sections[section]
    names = (key, key.replace("_", "-"), meant_key(cfg, section, row.partition("=")[2]))
    old = next((settings[name] for name in names if name in settings), None)
    if old is None:
        head = cfg.lines.get(section)  # None for an indented heading
        return text.before(head + 1, row) if head is not None else None
    if "\n" in old.value:
        return None
    line = text.line(old.line)
    match = re.match(r"([^=:]*?)(\s*[=:]\s*)(.*?)\s*$", line)
    if match is None or match[3] != old.value or match[1] not in names:
        return None
    at, (name, value) = text.start_of(old.line), row.split("=", 1)
    # a key with a dash is not wrong; it changes only along with the value
    return Splice(at, at + match.end(3), indent_of(line) + name + match[2] + value)


def dashes(case: Case) -> Files | None:
    """Replace `script-dir` with `script_dir`: some versions of setuptools reject the dash."""
    text = read_text(case.files.data(FILE))
    if text is None:
        return None
    splices = []
    for key in KEYS.values():
        dashed = re.escape(key.replace("_", "-"))
        for match in re.finditer(rf"^{dashed}(?=\s*[=:])", text.text, re.MULTILINE):
            if re.search(rf"^{key}\s*[=:]", text.text, re.MULTILINE):
                return None
            splices.append(Splice(match.start(), match.end(), key))
    return case.with_data(FILE, text.spliced(splices))


def syntax(case: Case) -> Files | None:
    """Close a heading's bracket, add the headings, or remove a byte order mark."""
    found = case.files.data(FILE)
    text = read_text(found)
    if text is None or found is None or _is_read(found):
        return None
    if text.mark:
        return case.with_data(FILE, found[len(text.mark) :])
    if "[" not in text.text:
        return _headings(case, text)
    line = text.line(case.finding.line or 0)
    comment = COMMENT.fullmatch(line)
    if comment is not None:
        return _comment(case, text, comment)
    equals = NO_EQUALS.fullmatch(line)
    if equals is not None:
        start = text.start_of(case.finding.line or 0)
        ends = (start + equals.end("key"), start + equals.start("value"))
        new = text.spliced([Splice(*ends, "=")])
        return case.with_data(FILE, new) if new and _is_read(new) else None
    if _key(line) in KEYS.values() and line[:1].strip():
        return _heading_above(case, text, line)
    if line.strip() in ("[develop]", "[install]"):
        return _other_section(case, text, line)
    match = re.fullmatch(r"(\[?)([A-Za-z_.]{1,40})(\]?)\s*", line)
    if match is None or bool(match[1]) == bool(match[3]) or match[2] not in KEYS:
        return None
    start = text.start_of(case.finding.line or 0)
    new = text.spliced([Splice(start, start + len(line), f"[{match[2]}]")])
    return case.with_data(FILE, new) if new and _is_read(new) else None


def _comment(case: Case, text: SourceText, found: re.Match[str]) -> Files | None:
    """Begin a comment with #."""
    start = text.start_of(case.finding.line or 0)
    new = text.spliced([Splice(start, start + found.end("sign"), "#")])
    return case.with_data(FILE, new) if new and _is_read(new) else None


def _headings(case: Case, text: SourceText) -> Files | None:
    """Write the heading of each section above its key."""
    splices = [
        text.before(number, f"[{section}]")
        for number, _ in enumerate(text.lines, 1)
        for section, key in KEYS.items()
        if text.line(number).replace("-", "_").startswith(key)
    ]
    new = text.spliced(splices) if len(splices) == len(KEYS) else None
    return case.with_data(FILE, new) if new and _is_read(new) else None


def _key(line: str) -> str:
    """Return the name that a line sets, with _ instead of -."""
    return re.split(r"[=:\s]", line.strip(), maxsplit=1)[0].replace("-", "_")


def _heading_above(case: Case, text: SourceText, line: str) -> Files | None:
    """Write the heading of a key above it, if the file does not have that heading."""
    section = next(name for name, key in KEYS.items() if key == _key(line))
    if any(row.strip() == f"[{section}]" for row in text.lines):
        return None
    new = text.spliced([text.before(case.finding.line or 1, f"[{section}]")])
    return case.with_data(FILE, new) if new and _is_read(new) else None


def _other_section(case: Case, text: SourceText, line: str) -> Files | None:
    """Give the second of two equal headings the name of the missing section, whose key is below."""
    other = {"[develop]": "[install]", "[install]": "[develop]"}[line.strip()]
    below = text.line((case.finding.line or 0) + 1).replace("-", "_")
    if other in text.text or not below.startswith(KEYS[other.strip("[]")]):
        return None
    start = text.start_of(case.finding.line or 0)
    new = text.spliced([Splice(start, start + len(line), other)])
    return case.with_data(FILE, new) if new and _is_read(new) else None


def entry_indented(case: Case) -> Files | None:
    """Indent the entry, and the entries below it that are not indented either."""
    found, line = case.files.data(FILE), case.finding.line
    text = read_text(found)
    if text is None or line is None:
        return None
    splices = []
    for number in range(line, len(text.lines) + 1):
        if not re.match(r"\w[\w.-]*[ \t]*=[ \t]*[\w.]+:\w+[ \t]*$", text.line(number)):
            break
        at = text.start_of(number)
        splices.append(Splice(at, at, "    "))
    new = text.spliced(splices) if splices else None
    return case.with_data(FILE, new) if new and _is_read(new) else None


def _is_read(found: bytes) -> bool:
    try:
        read_setup_cfg(found)
    except SetupCfgFault:
        return False
    return True


def without_entry(case: Case) -> Files | None:
    """Delete the line with an entry of console_scripts."""
    found, line = case.files.data("setup.cfg"), case.finding.params.get("entry")
    text = read_text(found)
    if text is None or not isinstance(line, int):
        return None
    return case.with_data("setup.cfg", text.spliced([text.without(line)]))
