"""Fixes of setup.py except its entry points: the name, the marker, what makes the build fail."""

from __future__ import annotations

import ast

from grader.mistakes.fixes.case import Case
from grader.mistakes.fixes.setup_call import FILE, SetupCall, read_setup_call
from grader.package.edit.files import Files
from grader.package.edit.text import Splice, indent_of, read_source
from grader.package.source.python import can_parse
from grader.package.source.setup_faults import setup_fault
from grader.package.source.setup_packages import packages_of
from grader.package.source.setup_py import INDEX, called_value, entry_outside, missing_imports
from grader.package.source.values import Evaluator, Text

IMPORTS = ast.Import | ast.ImportFrom


def name(case: Case) -> Files | None:
    """Pass the package's name to setup(), through the variable if there is one."""
    setup = read_setup_call(case)
    literal = setup.literal(setup.argument("name")) if setup else None
    if setup is None or literal is None or literal.value == case.package:
        return None
    return case.with_data(FILE, setup.source.spliced([setup.text(literal, case.package)]))


def comma(case: Case) -> Files | None:
    """Write the comma that is missing between two values."""
    found = case.files.data(FILE)
    value, source = called_value(found or b""), read_source(found)
    if value is None or source is None:
        return None
    at = source.span(value)[1]
    new = source.spliced([Splice(at, at, ",")])
    return case.with_data(FILE, new) if new is not None and can_parse(new) else None


def entry_inside(case: Case) -> Files | None:
    """Move an entry that is below the list of console_scripts into it."""
    found = case.files.data(FILE)
    source = read_source(found)
    outside = entry_outside(found or b"")
    if source is None or outside is None or can_parse(found or b""):
        return None
    row = f"{indent_of(source.line(outside.above))}    {source.line(outside.line).strip()}"
    row = row if row.endswith(",") else f"{row},"
    new = source.spliced([source.without(outside.line), source.before(outside.above, row)])
    return case.with_data(FILE, new) if new is not None and can_parse(new) else None


def imports(case: Case) -> Files | None:
    """Add the imports that setup.py lacks above its first one."""
    found = case.files.data(FILE)
    setup, error = read_setup_call(case), str(case.finding.params.get("error", ""))
    missing = missing_imports(found or b"", error)
    first = [s.lineno for s in setup.tree.body if isinstance(s, IMPORTS)] if setup else []
    if setup is None or not missing or not first:
        return None
    new = setup.source.spliced([setup.source.before(first[0], *missing)])
    return case.with_data(FILE, new)


def packages(case: Case) -> Files | None:
    """Let setup() install the package."""
    found = case.files.data(FILE) or b""
    inner = f"{case.assignment.folder}/"
    nested = any(
        path.startswith(inner) and path.count("/") > 1 and path.endswith("/__init__.py")
        for path in case.files.by_path
    )
    return case.with_data(FILE, packages_of(found, case.package, nested=nested).fixed)


def fault(case: Case) -> Files | None:
    """Correct what setup.py stops at."""
    found, error = case.files.data(FILE) or b"", str(case.finding.params.get("error", ""))
    fault = setup_fault(found, error, case.package)
    return case.with_data(FILE, fault.fixed) if fault is not None else None


def marker(case: Case) -> Files | None:
    """Make data_files install the marker: correct its name, or add the missing line."""
    setup = read_setup_call(case)
    if setup is None:
        return None
    splices = _renamed(setup, case) or _added(setup, case)
    return case.with_data(FILE, setup.source.spliced(splices)) if splices else None


def _files_of_index(setup: SetupCall, item: ast.expr) -> ast.expr | None:
    """Return the files of an item of data_files whose folder is that of the markers."""
    if not isinstance(item, ast.Tuple | ast.List) or len(item.elts) != 2:
        return None
    folder = Evaluator(setup.tree, setup.source.text).value(item.elts[0])
    return item.elts[1] if isinstance(folder, Text) and folder.value.strip("/") == INDEX else None


def _renamed(setup: SetupCall, case: Case) -> list[Splice]:
    """Return the splice that corrects a wrong name in the marker's line."""
    data_files = setup.argument("data_files")
    items = data_files.elts if isinstance(data_files, ast.List | ast.Tuple) else []
    for item in items:
        files = _files_of_index(setup, item)
        if files is None:
            continue
        if not isinstance(files, ast.List | ast.Tuple) or len(files.elts) != 1:
            return []
        named = files.elts[0]
        whole = setup.literal(named)
        if whole is not None and whole.value != f"resource/{case.package}":
            return [setup.text(whole, f"resource/{case.package}")]
        if isinstance(named, ast.BinOp) and isinstance(named.op, ast.Add):
            start, last = setup.literal(named.left), setup.literal(named.right)
            lost = str(case.finding.params.get("path", ""))
            if start is not None and lost == str(start.value) + case.package:
                return [setup.text(start, "resource/")]
            if start is not None and last is not None and start.value == "resource/":
                return [setup.text(last, case.package)] if last.value != case.package else []
        if str(case.finding.params.get("path", "")):
            return [setup.source.swap(named, _marker_of(setup, case))]
    return []


def _added(setup: SetupCall, case: Case) -> list[Splice]:
    data_files = setup.argument("data_files")
    q = setup.source.quote
    row = f"({q}{INDEX}{q}, [{_marker_of(setup, case)}])"
    if data_files is None:
        return setup.new_argument("data_files", ["[", f"    {row},", "],"])
    if not isinstance(data_files, ast.List):
        return []
    if any(_files_of_index(setup, item) is not None for item in data_files.elts):
        return []
    return setup.into_list(data_files, row)


def _marker_of(setup: SetupCall, case: Case) -> str:
    """Return the code of the marker's path."""
    q = setup.source.quote
    package = setup.constant("package_name")
    known = isinstance(package, ast.Constant) and package.value == case.package
    return f"{q}resource/{q} + package_name" if known else f"{q}resource/{case.package}{q}"


def prints(case: Case) -> Files | None:
    """Remove print() from setup.py if it is a whole line at module level."""
    setup = read_setup_call(case)
    if setup is None or case.finding.mistake != "build.setup_prints":
        return None
    lines = [
        statement
        for statement in setup.tree.body
        if isinstance(statement, ast.Expr)
        and isinstance(statement.value, ast.Call)
        and isinstance(statement.value.func, ast.Name)
        and statement.value.func.id == "print"
    ]
    splices = []
    for statement in lines:
        start, end = setup.source.span(statement)
        number = statement.lineno
        rest = setup.source.line(number).replace(setup.source.text[start:end], "", 1).strip()
        if statement.end_lineno != number or (rest and not rest.startswith("#")):
            return None
        splices.append(setup.source.without(number))
    return case.with_data(FILE, setup.source.spliced(splices)) if splices else None
