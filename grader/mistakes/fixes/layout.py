"""Fixes of the layout: the marker, the node's file, the inner folder, the exec bit."""

from __future__ import annotations

import re

from grader.mistakes.fixes.case import Case
from grader.package.edit.files import EXECUTABLE, Files
from grader.package.source.documents import script_of
from grader.package.source.names import misnamed_init, module_name
from grader.package.source.python import has_no_code


def marker(case: Case) -> Files | None:
    """Create the empty marker file, or rename the one that has a wrong name."""
    path = f"resource/{case.package}"
    if path in case.files.by_path or "resource" in files_in(case):
        return None
    old = str(case.finding.params.get("there", ""))
    if case.files.file(old) is not None and not case.files.data(old):
        return case.files.with_move(old, path)
    return case.with_data(path, b"")


def files_in(case: Case) -> set[str]:
    """Return the paths of all files of the package."""
    return {path for path, file in case.files.by_path.items() if file.kind != "folder"}


def inner_folder(case: Case) -> Files | None:
    """Rename the one folder with an __init__.py that holds the node's file."""
    files, name = case.files, case.assignment.node_file
    if case.finding.mistake != "source.misplaced_node_file" or case.package in files.by_path:
        return None
    path = _only_one_named(files, name)
    folder, _, rest = (path or "").partition("/")
    if path is None or rest != name or f"{folder}/__init__.py" not in files.by_path:
        return None
    for old in files.below(folder):
        if files.file(old) is None:
            return None
        files = files.with_move(old, case.package + old[len(folder) :])
    return files


def node_file(case: Case) -> Files | None:
    """Move the node's file to its place; of several files with its name, none is certain."""
    if case.finding.mistake != "source.misplaced_node_file" or case.node_path in case.files.by_path:
        return None
    name, path = case.assignment.node_file, str(case.finding.params.get("path", ""))
    if path.rpartition("/")[2] == name:
        path = _only_one_named(case.files, name) or ""
    if case.files.file(path) is None or case.package in files_in(case):
        return None
    return _with_entry(case.files.with_move(path, case.node_path), path, case.node_path)


def _with_entry(files: Files, old: str, new: str) -> Files:
    """Let setup.py name the module of a moved file, if it names it exactly once."""
    before, after = (module_name(path) for path in (old, new))
    setup = files.data("setup.py")
    # (an executable's name, before the =, is no module)
    named = re.compile(rf"(?<![\w.]){re.escape(before)}(?![\w.]|\s*=)".encode())
    if setup is None or len(named.findall(setup)) != 1:
        return files
    return files.with_data("setup.py", named.sub(after.encode(), setup))


def out_of_init(case: Case) -> Files | None:
    """Move the node from __init__.py into its own file, and leave __init__.py empty."""
    init = f"{case.assignment.folder}/__init__.py"
    there = case.files.data(case.node_path)
    if case.finding.params.get("path") != init or (there and not has_no_code(there)):
        return None
    code = case.files.data(init)
    if case.files.file(init) is None or code is None:
        return None
    if case.node_path in case.files.by_path:
        return case.files.with_data(case.node_path, code).with_data(init, b"")
    return case.files.with_move(init, case.node_path).with_data(init, b"")


def node_beside(case: Case) -> Files | None:
    """Copy the node from the file beside it into the empty file, which keeps its mode."""
    old = str(case.finding.params.get("there", ""))
    there = case.files.data(case.node_path)
    if case.finding.mistake != "source.empty_node_file" or there is None or not has_no_code(there):
        return None
    data = case.files.data(old) if case.files.file(old) else None
    return case.with_data(case.node_path, data) if data else None


def out_of_notebook(case: Case) -> Files | None:
    """Write the code of a notebook's cells into the node's file, which is missing or empty."""
    path = case.node_path
    notebook = case.files.data(str(case.finding.params.get("notebook", "")))
    script = script_of(notebook) if notebook is not None else None
    taken = path in case.files.by_path and case.files.data(path) != b""
    if script is None or taken or case.package in files_in(case):
        return None
    files = case.files.with_data(path, script)
    return files if path in case.files.by_path else files.with_mode(path, EXECUTABLE)


def out_of_inner_folder(case: Case) -> Files | None:
    """Move a file of the package's folder out of the inner folder."""
    old = str(case.finding.params.get("there", ""))
    folder, _, name = old.partition("/")
    if folder != case.assignment.folder or "/" in name or name in case.files.by_path:
        return None
    return case.files.with_move(old, name) if case.files.file(old) else None


def setup_renamed(case: Case) -> Files | None:
    """Rename a file with nearly the name of setup.py, if there is no setup.py."""
    old = str(case.finding.params.get("there", ""))
    if "/" in old or "setup.py" in case.files.by_path or case.finding.mistake != "setup.missing":
        return None
    return case.files.with_move(old, "setup.py") if case.files.file(old) else None


def _only_one_named(files: Files, name: str) -> str | None:
    found = [path for path in files.by_path if path.rpartition("/")[2] == name]
    return found[0] if len(found) == 1 and files.file(found[0]) is not None else None


def node_name(case: Case) -> Files | None:
    """Rename a node's file whose name is nearly right, unless the right name is taken."""
    old = f"{case.package}/{case.finding.params.get('name', '')}"
    if case.finding.mistake != "source.misnamed_node_file" or case.node_path in case.files.by_path:
        return None
    return case.files.with_move(old, case.node_path) if case.files.file(old) else None


def init_file(case: Case) -> Files | None:
    """Create the __init__.py without which find_packages() skips the folder."""
    path = f"{case.package}/__init__.py"
    if path in case.files.by_path or case.files.file(case.node_path) is None:
        return None
    there = misnamed_init(case.files.names_in(case.package))
    if there:
        return case.files.with_move(f"{case.package}/{there}", path)
    return case.with_data(path, b"")


def exec_bit(case: Case) -> Files | None:
    """Set the exec bit of the node's file for the owner and everyone who may read it."""
    file = case.files.file(case.judged_path)
    if file is None or file.mode & 0o100:
        return None
    return case.files.with_mode(case.judged_path, file.mode | (file.mode & 0o444) >> 2 | 0o100)
