"""Fixes of the entry points, in setup.py or in setup.cfg."""

from __future__ import annotations

import ast
import re

from grader.base.nearest import nearest
from grader.base.shown import shown
from grader.mistakes.fixes.case import Case
from grader.mistakes.fixes.setup_call import FILE, read_setup_call
from grader.package.edit.files import Files
from grader.package.edit.text import SourceText, Splice, read_source, read_text
from grader.package.source.entry_points import Entry, EntryPoints, from_setup_cfg, from_setup_py
from grader.package.source.in_class import line_in_class
from grader.package.source.python import PythonFault
from grader.package.source.setup_cfg import SetupCfgFault, read_setup_cfg
from grader.package.source.setup_py import read_setup_py

GROUP = "console_scripts"
ROUNDS = 5


def comma(case: Case) -> Files | None:
    """Add the comma between entries that Python has joined into one."""
    setup = read_setup_call(case)
    entry = _entry(case)
    if setup is None or entry is None or len(entry.pieces) < 2:
        return None
    splices = []
    for piece, line in entry.pieces[:-1]:
        code = setup.source.line(line)
        written = [f"{q}{piece}{q}" for q in "'\""]
        match = next((w for w in written if code.strip().startswith(w)), None)
        if match is None or not re.search(r"=.*:", piece):
            return None
        at = setup.source.start_of(line) + code.find(match) + len(match)
        splices.append(Splice(at, at, ","))
    return case.with_data(FILE, setup.source.spliced(splices))


def replaced(case: Case) -> Files | None:
    """Replace the wrong entry with the required one."""
    entry = _entry(case)
    if entry is None or entry.pieces or not _is_meant(case, entry):
        return None
    data, given = case.files.data(case.node_path) or b"", entry.target.partition(":")[2]
    if line_in_class(data, given.strip(), case.assignment.function):
        return None
    text = _source(case, entry.file)
    if text is None:
        return None
    for line in range(entry.line, min(entry.line + ROUNDS, len(text.lines) + 1)):
        code = text.line(line)
        if code.count(entry.text) == 1:
            at = text.start_of(line) + code.find(entry.text)
            return case.with_data(
                entry.file, text.spliced([Splice(at, at + len(entry.text), case.entry)])
            )
    return None


def _is_meant(case: Case, entry: Entry) -> bool:
    """Whether an entry is the required one with a mistake in it."""
    wanted = case.assignment.executable
    target = "".join(entry.target.split()).removesuffix("()")
    stem = case.assignment.node_file.removesuffix(".py")
    near = entry.name == wanted or nearest(wanted, [entry.name], cutoff=0.7) == entry.name
    begins = re.match(rf"\s*{re.escape(wanted)}\b", entry.text) is not None
    return near or begins or (target == case.assignment.target and stem in entry.text)


def group(case: Case) -> Files | None:
    """Rename the group to console_scripts if its name is nearly that."""
    wrong = str(case.finding.params.get("group", ""))
    text = _source(case, case.finding.file)
    if (
        not wrong
        or text is None
        or case.finding.line is None
        or nearest(GROUP, [wrong], 0.75) != wrong
    ):
        return None
    line = text.line(case.finding.line)
    if len(re.findall(rf"(?<!\w){re.escape(wrong)}(?!\w)", line)) != 1:
        return None
    at = text.start_of(case.finding.line) + line.find(wrong)
    return case.with_data(case.finding.file, text.spliced([Splice(at, at + len(wrong), GROUP)]))


def added(case: Case) -> Files | None:
    """Add the entry to console_scripts, which is created if it is missing."""
    setup = read_setup_call(case)
    if setup is None or setup.unpacks or _has_entry(case) or not _leads_somewhere(case):
        return None
    entry = f"{setup.source.quote}{case.entry}{setup.source.quote}"
    scripts = f"{setup.source.quote}{GROUP}{setup.source.quote}"
    points = setup.argument("entry_points")
    splices: list[Splice] = []
    if points is None:
        rows = ["{", f"    {scripts}: [", f"        {entry},", "    ],", "},"]
        splices = setup.new_argument("entry_points", rows)
    elif isinstance(points, ast.Dict) and not points.keys:
        start, end = setup.source.span(points)
        if not setup.source.text[start + 1 : end - 1].strip():
            splices = [Splice(start, end, f"{{{scripts}: [{entry}]}}")]
    elif isinstance(points, ast.Dict):
        values = [v for k, v in zip(points.keys, points.values) if _is_group(k)]
        if len(values) == 1 and isinstance(values[0], ast.List):
            splices = setup.into_list(values[0], entry)
    return case.with_data(FILE, setup.source.spliced(splices)) if splices else None


def _is_group(key: ast.expr | None) -> bool:
    return isinstance(key, ast.Constant) and key.value == GROUP


def _has_entry(case: Case) -> bool:
    """Whether an entry of that name exists, right or wrong: a second one would not help."""
    points = _points(case)
    return points is not None and case.assignment.executable in [
        entry.name for entry in points.group(GROUP)
    ]


def _leads_somewhere(case: Case) -> bool:
    """Whether the node's file, the target of the entry, exists."""
    return case.files.file(case.node_path) is not None


def _entry(case: Case) -> Entry | None:
    """Return the entry that the finding refers to."""
    points, line = _points(case), case.finding.line
    entries = points.group(GROUP) if points is not None else []
    found = [e for e in entries if e.line == line]
    texts = set(case.finding.params.values())
    found = found if len(found) == 1 else [e for e in found if shown(e.text) in texts]
    return found[0] if len(found) == 1 else None


def _points(case: Case) -> EntryPoints | None:
    found = case.files.data(case.finding.file)
    if found is None:
        return None
    try:
        if case.finding.file == FILE:
            return from_setup_py(read_setup_py(found))
        return from_setup_cfg(read_setup_cfg(found))
    except (PythonFault, SetupCfgFault):
        return None


def _source(case: Case, path: str) -> SourceText | None:
    found = case.files.data(path)
    return read_source(found) if path.endswith(".py") else read_text(found)
