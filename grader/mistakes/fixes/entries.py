"""Fixes of the entry points, in setup.py or in setup.cfg."""

from __future__ import annotations

import ast
import re
from dataclasses import replace

from grader.base.nearest import nearest
from grader.base.shown import shown
from grader.mistakes.fixes.case import Case
from grader.mistakes.fixes.setup_call import FILE, read_setup_call
from grader.package.edit.files import Files
from grader.package.edit.text import SourceText, Splice, read_source, read_text
from grader.package.source.entry_points import Entry, EntryPoints, from_setup_cfg, from_setup_py
from grader.package.source.in_class import line_in_class
from grader.package.source.python import PythonFault, can_parse
from grader.package.source.setup_cfg import SetupCfgFault, read_setup_cfg
from grader.package.source.setup_py import read_setup_py

GROUP = "console_scripts"
ROUNDS = 5
TWICE = 2


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
    if (joined := _in_two_texts(case, text)) is not None:
        return case.with_data(entry.file, text.spliced([joined]))
    for line in range(entry.line, min(entry.line + ROUNDS, len(text.lines) + 1)):
        code = text.line(line)
        if code.count(entry.text) == 1:
            at = text.start_of(line) + code.find(entry.text)
            return case.with_data(
                entry.file, text.spliced([Splice(at, at + len(entry.text), case.entry)])
            )
    return _written_out(case, entry)


def swapped(case: Case) -> Files | None:
    """Write the required entry in the place of one with the node's file before the =."""
    text = _source(case, case.finding.file)
    line = case.finding.line
    if text is None or line is None:
        return None
    stem, module = case.assignment.node_file.removesuffix(".py"), case.assignment.target
    other = module.partition(":")[0].removesuffix(stem) + case.assignment.executable
    form = re.compile(rf"(?P<q>['\"])\s*{stem}\s*=\s*{re.escape(other)}\s*:[\w.]+\s*(?P=q)")
    found = list(form.finditer(text.line(line)))
    if len(found) != 1:
        return None
    start, quote = text.start_of(line), found[0]["q"]
    place = (start + found[0].start(), start + found[0].end())
    return case.with_data(
        case.finding.file, text.spliced([Splice(*place, f"{quote}{case.entry}{quote}")])
    )


def key_once(case: Case) -> Files | None:
    """Delete the second of two equal keys in a dict, if no entry is in its value."""
    setup = read_setup_call(case)
    line = case.finding.line
    if setup is None or case.finding.mistake != "setup.misplaced_entry":
        return None
    for found in (n for n in ast.walk(setup.tree) if isinstance(n, ast.Dict)):
        keys = [k.value if isinstance(k, ast.Constant) else None for k in found.keys]
        inside = [at for at, v in enumerate(found.values) if line in range(v.lineno, _end(v) + 1)]
        for at in inside:
            later = [n for n in range(at + 1, len(keys)) if keys[n] == keys[at] is not None]
            texts = [n for k in later for n in ast.walk(found.values[k]) if _is_entry(n)]
            if len(later) == 1 and not texts:
                start = setup.source.span(found.values[later[0] - 1])[1]
                end = setup.source.span(found.values[later[0]])[1]
                return case.with_data(FILE, setup.source.spliced([Splice(start, end, "")]))
    return None


def _end(node: ast.expr) -> int:
    return node.end_lineno or node.lineno


def _is_entry(node: ast.AST) -> bool:
    return isinstance(node, ast.Constant) and isinstance(node.value, str) and "=" in node.value


def _written_out(case: Case, entry: Entry) -> Files | None:
    """Write the required entry in place of the only expression that makes the wrong one."""
    setup = read_setup_call(case) if entry.file == FILE else None
    if setup is None:
        return None
    holders = [n for n in ast.walk(setup.tree) if isinstance(n, ast.Assign | ast.List | ast.Tuple)]
    values = [v for h in holders for v in ([h.value] if isinstance(h, ast.Assign) else h.elts)]
    made = [
        v
        for v in values
        if v.lineno == entry.line and isinstance(v, ast.BinOp | ast.JoinedStr | ast.Call)
    ]
    if len(made) != 1:
        return None
    new = f"{setup.source.quote}{case.entry}{setup.source.quote}"
    return case.with_data(FILE, setup.source.spliced([setup.source.swap(made[0], new)]))


def _in_two_texts(case: Case, text: SourceText) -> Splice | None:
    """Return the splice that joins the name and the module, which are two texts."""
    name, target = re.escape(case.assignment.executable), re.escape(case.assignment.target)
    two = re.compile(rf"(?P<q>['\"]){name}\s*=?\s*(?P=q)\s*,\s*(?P<other>['\"]){target}(?P=other)")
    found = list(two.finditer(text.text))
    if len(found) != 1:
        return None
    quote = found[0]["q"]
    return Splice(*found[0].span(), f"{quote}{case.entry}{quote}")


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


def keyword(case: Case) -> Files | None:
    """Correct the misspelt argument entry_points of setup()."""
    setup = read_setup_call(case)
    wrong = str(case.finding.params.get("argument", ""))
    value = setup.argument(wrong) if setup is not None and wrong else None
    if setup is None or value is None or setup.argument("entry_points") is not None:
        return None
    given = next(k for k in setup.call.keywords if k.arg == wrong)
    start = setup.source.span(given)[0]
    splice = Splice(start, start + len(wrong), "entry_points")
    return case.with_data(FILE, setup.source.spliced([splice]))


def header(case: Case) -> Files | None:
    """Write the line [console_scripts] above the entry, in the text of entry_points."""
    text, line = _source(case, FILE), case.finding.line
    code = text.line(line) if text is not None and line else ""
    if text is None or not line or "".join(code.split()) != "".join(case.entry.split()):
        return None
    row = f"{code[: len(code) - len(code.lstrip())]}[{GROUP}]"
    return case.with_data(FILE, text.spliced([text.before(line, row)]))


def uncommented(case: Case) -> Files | None:
    """Remove the # before the entry."""
    text = _source(case, FILE)
    if text is None or case.finding.line is None:
        return None
    line = text.line(case.finding.line)
    match = re.match(r"\s*(#+ ?)(['\"])(.*)\2,?\s*$", line)
    if match is None or "".join(match[3].split()) != "".join(case.entry.split()):
        return None
    at = text.start_of(case.finding.line)
    new = text.spliced([Splice(at + match.start(1), at + match.end(1), "")])
    return case.with_data(FILE, new) if new is not None and can_parse(new) else None


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


def moved(case: Case) -> Files | None:
    """Move the entry from another argument of setup() to console_scripts."""
    setup = read_setup_call(case)
    holder = setup.argument(str(case.finding.params.get("argument", ""))) if setup else None
    if isinstance(holder, ast.Dict):
        lists = [v for v in holder.values if isinstance(v, ast.List) and _has(case, v)]
        holder = lists[0] if len(lists) == 1 else None
    if setup is None or not isinstance(holder, ast.List):
        return None
    items = [
        item
        for item in holder.elts
        if isinstance(item, ast.Constant) and shown(str(item.value).strip()) == _text(case)
    ]
    splice = _removed(setup.source, holder, items[0]) if len(items) == 1 else None
    without = setup.source.spliced([splice]) if splice is not None else None
    if without is None or not can_parse(without):
        return None
    return added(replace(case, files=case.files.with_data(FILE, without)))


def _has(case: Case, holder: ast.List) -> bool:
    """Whether a list has the entry of the finding."""
    items = [item.value for item in holder.elts if isinstance(item, ast.Constant)]
    return any(shown(str(item).strip()) == _text(case) for item in items)


def _text(case: Case) -> str:
    return str(case.finding.params.get("entry", ""))


def _removed(source: SourceText, holder: ast.List, item: ast.expr) -> Splice | None:
    """Return the splice that removes an item from a list, with its line if it is alone there."""
    start, end = source.span(item)
    if source.line(item.lineno).strip().rstrip(",") == source.text[start:end]:
        return source.without(item.lineno)
    at = holder.elts.index(item)
    if at:
        return Splice(source.span(holder.elts[at - 1])[1], end, "")
    if len(holder.elts) > 1:
        return Splice(start, source.span(holder.elts[1])[0], "")
    first, last = source.span(holder)
    return Splice(first + 1, last - 1, "")


def passed(case: Case) -> Files | None:
    """Give setup() the variable that holds the entry points."""
    setup, name = read_setup_call(case), str(case.finding.params.get("variable", ""))
    if setup is None or not name:
        return None
    points = setup.argument("entry_points")
    splices = setup.new_argument("entry_points", [f"{name},"])
    if points is not None:
        splices = [setup.source.swap(points, name)]
    return case.with_data(FILE, setup.source.spliced(splices)) if splices else None


def grouped(case: Case) -> Files | None:
    """Put the argument console_scripts of setup() into entry_points."""
    setup = read_setup_call(case)
    value = setup.argument(GROUP) if setup is not None else None
    if setup is None or value is None or setup.argument("entry_points") is not None:
        return None
    keyword = next(k for k in setup.call.keywords if k.arg == GROUP)
    start, end = setup.source.span(value)
    q = setup.source.quote
    head = f"entry_points={{{q}{GROUP}{q}: "
    splices = [Splice(setup.source.span(keyword)[0], start, head), Splice(end, end, "}")]
    new = setup.source.spliced(splices)
    return case.with_data(FILE, new) if new is not None and can_parse(new) else None


def regrouped(case: Case) -> Files | None:
    """Rename the group that has the entry and nothing else, if there is no console_scripts."""
    points, text = _points(case), _source(case, case.finding.file)
    wrong = str(case.finding.params.get("group", ""))
    if points is None or text is None or points.group(GROUP):
        return None
    if wrong != "gui_scripts" and [e.name for e in points.group(wrong)] != [
        case.assignment.executable
    ]:
        return None
    line = text.line(case.finding.line or 0)
    if GROUP in points.groups or line.count(wrong) != 1:
        return None
    at = text.start_of(case.finding.line or 0) + line.find(wrong)
    return case.with_data(case.finding.file, text.spliced([Splice(at, at + len(wrong), GROUP)]))


def without_group(case: Case) -> Files | None:
    """Delete the second console_scripts, if its list is empty."""
    setup = read_setup_call(case)
    points = setup.argument("entry_points") if setup is not None else None
    if setup is None or not isinstance(points, ast.Dict):
        return None
    pairs = [(k, v) for k, v in zip(points.keys, points.values) if k and _is_group(k)]
    if len(pairs) != TWICE:
        return None
    key, value = pairs[1]
    source, last = setup.source, value.end_lineno or value.lineno
    first, end = source.start_of(key.lineno), source.end_of(last)
    written = source.text[source.span(key)[0] : source.span(value)[1]]
    alone = source.text[first:end].strip().rstrip(",") == written
    if not alone or not isinstance(value, ast.List) or value.elts or "#" in written:
        return None
    new = source.spliced([Splice(first, source.start_of(last + 1), "")])
    return case.with_data(FILE, new) if new is not None and can_parse(new) else None


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


def single(case: Case) -> Files | None:
    """Keep the right one of several entries with the same name."""
    points = _points(case)
    if points is None or case.finding.file != FILE:
        return None
    entries = [e for e in points.group(GROUP) if e.name == case.assignment.executable]
    text = _source(case, FILE)
    keep = next((e for e in entries if e.target == case.assignment.target), None)
    if text is None or keep is None:
        return None
    splices = []
    for entry in entries:
        if entry is keep:
            continue
        if text.line(entry.line).strip().rstrip(",")[1:-1] != entry.text:
            return None
        splices.append(text.without(entry.line))
    new = text.spliced(splices)
    return case.with_data(FILE, new) if new is not None and can_parse(new) else None


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
