"""Fixes of setup.cfg."""

from __future__ import annotations

import re

from grader.base.nearest import nearest
from grader.mistakes.fixes.case import Case
from grader.package.edit.files import Files
from grader.package.edit.text import Splice, read_text
from grader.package.source.setup_cfg import KEYS, SetupCfgFault, read_setup_cfg

FILE = "setup.cfg"
HEADING = re.compile(r"\[(?P<name>[\w.:-]{1,60})\][ \t]*")


def _sections(package: str) -> str:
    """Return both sections as `ros2 pkg create` writes them."""
    return "".join(f"[{name}]\n{key}=$base/lib/{package}\n" for name, key in KEYS.items())


def missing(case: Case) -> Files | None:
    """Create the missing setup.cfg, or move a file with a nearly right name or place there."""
    if FILE in case.files.by_path:
        return None
    there = str(case.finding.params.get("there", ""))
    if there and case.files.file(there) is not None:
        return case.files.with_move(there, FILE)
    return case.with_data(FILE, _sections(case.package).encode())


def rewritten(case: Case) -> Files | None:
    """Write both sections anew, and keep the sections that are for other programs."""
    text = read_text(case.files.data(FILE))
    if text is None:
        return None
    kept: list[str] = []
    lost: list[str] = []
    is_kept = False
    for number in range(1, len(text.lines) + 1):
        row = text.line(number)
        heading = HEADING.fullmatch(row)
        if heading is not None:
            name = heading["name"]
            is_kept = name not in KEYS and not nearest(name, KEYS, cutoff=0.6)
        (kept if is_kept else lost).append(row)
    if any("=" in row and not re.search(r"script|\blib\b|\bbin\b", row) for row in lost):
        return None  # (something else is there)
    written = _sections(case.package) + "".join(f"{row}\n" for row in kept)
    written = written if text.text.endswith(("\n", "\r")) else written.removesuffix("\n")
    new = written.replace("\n", text.newline).encode()
    try:
        read_setup_cfg(new)
    except SetupCfgFault:
        return None
    return case.with_data(FILE, new)


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
