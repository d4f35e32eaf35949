"""Why a setup.py stops with an error: the line that is to be changed, and how, if that is certain."""

from __future__ import annotations

import ast
import re
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field

from grader.base.nearest import nearest
from grader.base.shown import shown
from grader.package.edit.text import Positioned, Splice
from grader.package.source.module import Module
from grader.package.source.names import dotted
from grader.package.source.python import can_parse
from grader.package.source.setup_packages import FINDERS, parsed_setup, setup_call, value_of
from grader.package.source.setup_pairs import (
    TEXT,
    PairFault,
    absolute_file,
    absolute_folder,
    pair_fault,
)
from grader.package.source.setup_values import (
    RefusedValue,
    path_object,
    refused_value,
    refused_version,
    wrong_form,
)
from grader.package.source.values import Evaluator, Table, Text

CONSTANTS = {"true": "True", "false": "False", "null": "None", "none": "None"}
"""What other languages call Python's constants."""
PYTHON_2 = ("execfile", "unicode", "xrange", "raw_input", "basestring", "reduce", "file")
"""Functions that Python 2 had, and that Python 3 does not have."""
IMPORTED = ("setup", *FINDERS)
TEXTS = (
    *("version", "license", "maintainer", "maintainer_email", "author", "author_email"),
    *("description", "long_description", "url"),
)
OPTIONAL = (*TEXTS, "long_description_content_type", "classifiers", "keywords", "tests_require")
"""Arguments without which setup() installs the same."""


@dataclass(frozen=True)
class SetupFault:
    """What is wrong, its line, and the values of the placeholders in its texts.

    `fixed` is the file after the change; None if no change is certain.
    """

    variant: str
    line: int
    words: dict[str, str] = field(default_factory=dict)
    fixed: bytes | None = None


@dataclass(frozen=True)
class _Reader:
    module: Module
    call: ast.Call
    package: str
    files: tuple[str, ...] = ()

    def argument(self, name: str) -> ast.expr | None:
        """Return what setup() gets for an argument; of a variable, its only value."""
        given = next((k.value for k in self.call.keywords if k.arg == name), None)
        if not isinstance(given, ast.Name):
            return given
        sets = [s for s in self.module.tree.body if isinstance(s, ast.Assign)]
        values = [s.value for s in sets if given.id in [dotted(t) for t in s.targets]]
        return values[0] if len(values) == 1 else given

    def fault(self, variant: str, at: Positioned, *splices: Splice, **words: str) -> SetupFault:
        new = self.module.text.spliced(splices) if splices and self.module.exact else None
        fixed = new if new is not None and can_parse(new) else None
        filled = {key: shown(value) for key, value in words.items()}
        return SetupFault(variant, at.lineno, filled, fixed)

    def without(self, node: Positioned, siblings: Sequence[Positioned]) -> list[Splice]:
        """Return the splice that removes one of several values; none if it is the only one."""
        text, at = self.module.text, siblings.index(node)
        start, end = text.span(node)
        if at + 1 < len(siblings):
            return [Splice(start, text.span(siblings[at + 1])[0], "")]
        return [Splice(text.span(siblings[at - 1])[1], end, "")] if at else []


def setup_fault(
    found: bytes, error: str, package: str, files: Iterable[str] = ()
) -> SetupFault | None:
    """Return why a setup.py stops with an error; None if it is not known."""
    module = parsed_setup(found)
    call = setup_call(module) if module is not None else None
    if module is not None and call is None:
        return _misspelt_call(module, error)
    if module is None or call is None:
        return None
    reader = _Reader(module, call, package, tuple(sorted(files)))
    for pattern, look in LOOKS:
        match = re.match(pattern, error)
        fault = look(reader, match) if match is not None else None
        if fault is not None:
            return fault
    return None


def _misspelt_call(module: Module, error: str) -> SetupFault | None:
    """The call of setup() by another name: nothing calls setup()."""
    told = re.match(r"NameError: name '(?P<name>\w{1,80})' is not defined", error)
    name = told["name"] if told is not None else ""
    calls = [n for n in module.nodes if isinstance(n, ast.Call) and dotted(n.func) == name]
    alike = name.lower() == "setup" or bool(nearest("setup", [name.lower()], cutoff=0.75))
    if len(calls) != 1 or not alike:
        return None
    reader = _Reader(module, calls[0], "")
    swap = module.text.swap(calls[0].func, "setup")
    return reader.fault("misspelt", calls[0], swap, name=name, close="setup")


def _no_colon(reader: _Reader, match: re.Match[str]) -> SetupFault | None:
    """A key without its colon: Python reads an item of a text."""
    del match
    for node in reader.module.nodes:
        key = node.value if isinstance(node, ast.Subscript) else None
        if isinstance(key, ast.Constant) and isinstance(key.value, str):
            end = reader.module.text.span(key)[1]
            code = reader.module.text.code(key)
            around = reader.module.parents.get(node)
            if isinstance(around, ast.Tuple | ast.List):
                return reader.fault(
                    "no_comma", key, Splice(end, end, ","), name=code, wanted=f"{code},"
                )
            return reader.fault(
                "no_colon", key, Splice(end, end, ":"), name=code, wanted=f"{code}:"
            )
    return None


def _not_called(reader: _Reader, match: re.Match[str]) -> SetupFault | None:
    """`packages=find_packages`."""
    del match
    value = reader.argument("packages")
    if value is None or dotted(value).rpartition(".")[2] not in FINDERS:
        return None
    q = reader.module.text.quote
    wanted = f"{dotted(value)}(exclude=[{q}test{q}])"
    swap = reader.module.text.swap(value, wanted)
    return reader.fault("not_called", value, swap, name=dotted(value), wanted=f"packages={wanted}")


def _function_given(reader: _Reader, match: re.Match[str]) -> SetupFault | None:
    """A function instead of a list of files in `data_files`."""
    del match
    for _, files in _pairs(reader):
        name = dotted(files)
        if name and name.partition(".")[0] in reader.module.imports:
            return reader.fault("not_called_open", files, name=name)
    return None


def _list_in_list(reader: _Reader, match: re.Match[str]) -> SetupFault | None:
    """`packages=[find_packages()]`."""
    del match
    value = reader.argument("packages")
    if not isinstance(value, ast.List) or len(value.elts) != 1:
        return None
    inner = value.elts[0]
    if not isinstance(inner, ast.Call) or dotted(inner.func).rpartition(".")[2] not in FINDERS:
        return None
    code = reader.module.text.code(inner)
    swap = reader.module.text.swap(value, code)
    return reader.fault("list_in_list", value, swap, wanted=f"packages={code}")


def _no_file(reader: _Reader, match: re.Match[str]) -> SetupFault | None:
    """A file that setup.py reads and that is not there."""
    path = match["path"]
    base = path.rpartition("/")[2]
    named = [
        n
        for n in reader.module.nodes
        if isinstance(n, ast.Constant) and n.value in (path, f"./{path}", base)
    ]
    variant = "no_file_there" if path.startswith("/") else "no_file"
    if len(named) != 1:
        return None
    around = [named[0], *reader.module.around(named[0])]
    keyword = next((n for n in around if n in reader.call.keywords), None)
    if isinstance(keyword, ast.keyword):
        return _argument_reads(reader, keyword, variant, base)
    statement = next((n for n in around if n in reader.module.tree.body), None)
    if not isinstance(statement, ast.Assign | ast.With | ast.Expr):
        return reader.fault("no_file_other", named[0], name=base)
    splices = _without_statement(reader, statement)
    return reader.fault(f"{variant}_above", statement, *splices, name=base)


def _argument_reads(
    reader: _Reader, keyword: ast.keyword, variant: str, base: str
) -> SetupFault | None:
    q, name = reader.module.text.quote, keyword.arg or ""
    given = {"install_requires": f"[{q}setuptools{q}]", "version": f"{q}0.0.0{q}"}.get(name)
    if given is not None:
        swap = reader.module.text.swap(keyword.value, given)
        return reader.fault("no_file_value", keyword, swap, name=base, wanted=f"{name}={given}")
    if name not in OPTIONAL:
        return None
    splices = reader.without(keyword, reader.call.keywords)
    code = reader.module.text.code(keyword)
    return reader.fault(variant, keyword, *splices, name=base, wanted=code)


def _without_statement(reader: _Reader, statement: ast.stmt) -> list[Splice]:
    """Return the splices that remove a statement and the arguments that use what it binds."""
    stored = {
        n.id
        for n in ast.walk(statement)
        if isinstance(n, ast.Name) and isinstance(n.ctx, ast.Store)
    }
    inside = set(ast.walk(statement))
    uses = [
        n
        for n in reader.module.nodes
        if isinstance(n, ast.Name) and n.id in stored and n not in inside
    ]
    keywords = reader.call.keywords
    using = [k for k in keywords if any(n in uses for n in ast.walk(k))]
    counted = sum(n in uses for k in using for n in ast.walk(k))
    if counted != len(uses) or len(using) > 1 or any(k.arg not in OPTIONAL for k in using):
        return []
    text = reader.module.text
    end = text.start_of((statement.end_lineno or statement.lineno) + 1)
    splices = [Splice(text.start_of(statement.lineno), end, "")]
    for keyword in using:
        splices += reader.without(keyword, keywords)
    return splices


def _name(reader: _Reader, match: re.Match[str]) -> SetupFault | None:
    """A name that nothing defines."""
    module, name = reader.module, match["name"]
    uses = [
        n
        for n in module.nodes
        if isinstance(n, ast.Name) and n.id == name and isinstance(n.ctx, ast.Load)
    ]
    if not uses:
        return None
    first = min(uses, key=lambda n: (n.lineno, n.col_offset))
    if name in _bound(module):
        sets = [s for s in module.tree.body if _sets(s, name)]
        late = len(sets) == 1 and sets[0].lineno > first.lineno
        if not late:
            return None
        line, last = str(sets[0].lineno), str(sets[0].end_lineno)
        variant = "late" if line == last else "late_lines"
        return reader.fault(variant, first, name=name, line=line, last=last)
    longer = [one for one in _bound(module) if one.startswith(f"{name}_")]
    close = CONSTANTS.get(name) or nearest(name, _bound(module) - {name}, cutoff=0.75)
    close = close or (longer[0] if len(longer) == 1 else "")
    if close:
        swaps = [module.text.swap(use, close) for use in uses]
        return reader.fault("misspelt", first, *swaps, name=name, close=close)
    q = module.text.quote
    if name == "package_name":
        row = f"package_name = {q}{reader.package}{q}"
        above = next((s for s in module.tree.body if reader.call in ast.walk(s)), None)
        insert = [module.text.before(above.lineno, row, "")] if above is not None else []
        return reader.fault("variable", first, *insert, name=name, statement=row)
    if name in PYTHON_2:
        return reader.fault("python_2", first, name=name)
    parent = module.parents.get(first)
    is_text = isinstance(parent, ast.keyword) and parent.arg in TEXTS
    is_item = isinstance(parent, ast.List)
    swaps = [module.text.swap(first, f"{q}{name}{q}")] if is_text or is_item else []
    return reader.fault("undefined", first, *(swaps if len(uses) == 1 else []), name=name)


def _sets(statement: ast.stmt, name: str) -> bool:
    if isinstance(statement, ast.FunctionDef | ast.ClassDef):
        return statement.name == name
    targets = statement.targets if isinstance(statement, ast.Assign) else []
    return any(isinstance(t, ast.Name) and t.id == name for t in targets)


def _bound(module: Module) -> set[str]:
    """Return the names that imports and assignments of the file bind."""
    imports = (n for n in module.nodes if isinstance(n, ast.Import | ast.ImportFrom))
    names = {alias.asname or alias.name for n in imports for alias in n.names}
    stored = (n for n in module.nodes if isinstance(n, ast.Name))
    defined = {n.name for n in module.nodes if isinstance(n, ast.FunctionDef | ast.ClassDef)} | {
        n.arg for n in module.nodes if isinstance(n, ast.arg)
    }
    return names | defined | {n.id for n in stored if isinstance(n.ctx, ast.Store)}


def _not_in_setuptools(reader: _Reader, match: re.Match[str]) -> SetupFault | None:
    """A misspelt name in `from setuptools import …`."""
    module, name = reader.module, match["name"]
    close = nearest(name, IMPORTED, cutoff=0.75)
    named = [n for n in module.nodes if isinstance(n, ast.alias) and n.name == name]
    if not close or not named:
        return None
    uses = [n for n in module.nodes if isinstance(n, ast.Name) and n.id == name]
    plain = [n for n in named if n.asname is None]
    nodes: list[Positioned] = [*plain, *uses]
    swaps = [module.text.swap(node, close) for node in nodes] if plain else []
    return reader.fault("misspelt", named[0], *swaps, name=name, close=close)


def _no_module(reader: _Reader, match: re.Match[str]) -> SetupFault | None:
    """An import of a module that is not there."""
    module, name = reader.module, match["name"]
    statements = [
        s
        for s in module.tree.body
        if (isinstance(s, ast.Import) and any(a.name == name for a in s.names))
        or (isinstance(s, ast.ImportFrom) and s.module == name)
    ]
    if not statements:
        return None
    statement, row = statements[0], module.text.line(statements[0].lineno)
    if nearest("setuptools", [name], cutoff=0.75):
        at = module.text.start_of(statement.lineno) + row.find(name)
        swap = [Splice(at, at + len(name), "setuptools")] if row.count(name) == 1 else []
        return reader.fault("misspelt", statement, *swap, name=name, close="setuptools")
    bound = {a.asname or a.name.partition(".")[0] for a in statement.names}
    used = {n.id for n in module.nodes if isinstance(n, ast.Name)} & bound
    alone = statement.lineno == statement.end_lineno and ";" not in row and not used
    splices = [module.text.without(statement.lineno)] if alone else []
    return reader.fault("no_module", statement, *splices, name=name)


def _positional(reader: _Reader, match: re.Match[str]) -> SetupFault | None:
    """A value without its name in the call of setup()."""
    del match
    if not reader.call.args:
        return None
    value = reader.call.args[0]
    at = reader.module.text.span(value)[0]
    starred = isinstance(value, ast.Starred)
    inner = value.value if isinstance(value, ast.Starred) else value
    code = reader.module.text.code(inner)
    if _is_dict(reader.module, inner):
        stars = Splice(at, at, "*" if starred else "**")
        name = code if isinstance(inner, ast.Name) else f"{code.splitlines()[0]} …"
        return reader.fault("unpacked", value, stars, name=name, wanted=f"**{name}")
    if starred:
        return None
    is_name = len(reader.call.args) == 1 and reader.argument("name") is None
    splices = [Splice(at, at, "name=")] if is_name else []
    return reader.fault("positional", value, *splices, wanted=f"name={code}")


def _is_dict(module: Module, value: ast.expr) -> bool:
    """Whether an expression is a dict: as written, or by every assignment of its name."""
    if isinstance(value, ast.Dict):
        return True
    if isinstance(value, ast.Call):
        return dotted(value.func) == "dict" or _returns_dict(module, dotted(value.func))
    name = value.id if isinstance(value, ast.Name) else ""
    values = [s.value for s in module.tree.body if isinstance(s, ast.Assign) and _sets(s, name)]
    plain = [v for v in values if not isinstance(v, ast.Name)]
    return bool(plain) and len(plain) == len(values) and all(_is_dict(module, v) for v in plain)


def _returns_dict(module: Module, name: str) -> bool:
    """Whether a function of the file returns a dict as it is written."""
    function = module.functions.get(name)
    returned = (
        [n.value for n in ast.walk(function) if isinstance(n, ast.Return)] if function else []
    )
    return bool(returned) and all(isinstance(value, ast.Dict) for value in returned)


def _never_called(reader: _Reader, match: re.Match[str]) -> SetupFault | None:
    """An `if` that is never true around the call, or entry points of a form that is refused."""
    del match
    for statement in reader.module.tree.body:
        if isinstance(statement, ast.If) and reader.call in ast.walk(statement):
            guard = _wrong_guard(reader, statement)
            if guard is not None or statement.orelse:
                return guard
        if isinstance(statement, ast.If) and _calls_setup(reader, statement):
            guard = _wrong_guard(reader, statement)
            if guard is not None:
                return guard
    named = _named_function(reader)
    if named is not None:
        return named
    return _entries_form(reader) or _of_value(refused_value(reader.module, reader.call))


def _named_function(reader: _Reader) -> SetupFault | None:
    """A line names the function that calls setup(), without its brackets."""
    for node in ast.walk(reader.module.tree):
        if not isinstance(node, ast.Expr) or not isinstance(node.value, ast.Name):
            continue
        name = node.value.id
        function = reader.module.functions.get(name)
        if function is not None and reader.call in ast.walk(function):
            swap = reader.module.text.swap(node, f"{name}()")
            return reader.fault("named", node, swap, name=name, wanted=f"{name}()")
    return None


def _calls_setup(reader: _Reader, statement: ast.If) -> bool:
    """Whether a statement calls a function of the file that calls setup()."""
    calls = [n for s in statement.body for n in ast.walk(s) if isinstance(n, ast.Call)]
    called = [reader.module.functions.get(dotted(call.func)) for call in calls]
    return any(f is not None and reader.call in ast.walk(f) for f in called)


def _of_value(found: RefusedValue | None) -> SetupFault | None:
    """The fault of a value that setuptools refuses."""
    if found is None:
        return None
    words = {"argument": found.argument, "found": found.found}
    filled = {key: shown(value) for key, value in words.items()}
    return SetupFault(found.variant, found.line, filled)


def _refused_version(reader: _Reader, match: re.Match[str]) -> SetupFault | None:
    del match
    return _of_value(refused_version(reader.module, reader.call))


def _path_object(reader: _Reader, match: re.Match[str]) -> SetupFault | None:
    """A path of pathlib in a value that colcon reads."""
    del match
    return _of_value(path_object(reader.module, reader.call))


def _wrong_form(reader: _Reader, match: re.Match[str]) -> SetupFault | None:
    """An argument of setup() that has another type than setuptools can use."""
    del match
    return _of_value(wrong_form(reader.module, reader.call))


def _pair_form(reader: _Reader, match: re.Match[str]) -> SetupFault | None:
    """A line of data_files without its brackets, or with its two parts exchanged."""
    del match
    return _of_pair(reader, pair_fault(reader.module, reader.argument("data_files")))


def _absolute(reader: _Reader, match: re.Match[str]) -> SetupFault | None:
    """A file of data_files whose path begins at the root."""
    data_files = reader.argument("data_files")
    return _of_pair(reader, absolute_file(reader.module, data_files, match["path"], reader.package))


def _folder_absolute(reader: _Reader, match: re.Match[str]) -> SetupFault | None:
    """A folder of data_files that begins with a slash."""
    del match
    return _of_pair(reader, absolute_folder(reader.module, reader.argument("data_files")))


def _of_pair(reader: _Reader, found: PairFault | None) -> SetupFault | None:
    if found is None:
        return None
    code = reader.module.text.code(found.node)
    return reader.fault(found.variant, found.node, *found.splices, found=code, wanted=found.wanted)


def _py_modules(reader: _Reader, match: re.Match[str]) -> SetupFault | None:
    """The node's module in py_modules, which is for files beside setup.py."""
    keyword = next((k for k in reader.call.keywords if k.arg == "py_modules"), None)
    if keyword is None or any(k.arg is None for k in reader.call.keywords):
        return None
    q = reader.module.text.quote
    wanted = f"packages=[{q}{reader.package}{q}]"
    packages = next((k for k in reader.call.keywords if k.arg == "packages"), None)
    if packages is None:
        swaps = [reader.module.text.swap(keyword, wanted)]
        return reader.fault("py_modules", keyword, *swaps, name=match["name"], wanted=wanted)
    splices = reader.without(keyword, reader.call.keywords)
    if not isinstance(packages.value, ast.List) or packages.value.elts:
        return reader.fault("py_modules_too", keyword, *splices, name=match["name"])
    splices.append(reader.module.text.swap(packages, wanted))
    return reader.fault("py_modules", keyword, *splices, name=match["name"], wanted=wanted)


def _wrong_guard(reader: _Reader, statement: ast.If) -> SetupFault | None:
    """`if __name__ == 'main':`."""
    test, text = statement.test, reader.module.text
    is_name = isinstance(test, ast.Compare) and dotted(test.left) == "__name__"
    if not is_name or not isinstance(test, ast.Compare) or not isinstance(test.ops[0], ast.Eq):
        return None
    value = test.comparators[0]
    if not isinstance(value, ast.Constant) or value.value == "__main__":
        return None
    wanted = f"{text.quote}__main__{text.quote}"
    swap = text.swap(value, wanted)
    return reader.fault("guard", test, swap, name=text.code(value), wanted=wanted)


def _entries_form(reader: _Reader) -> SetupFault | None:
    """Entry points as a list, or console_scripts as a dict of executables."""
    points, text = reader.argument("entry_points") or _in_settings(reader), reader.module.text
    q = text.quote
    if isinstance(points, ast.Set):
        return _entries_set(reader, points)
    if isinstance(points, ast.List | ast.Tuple) and points.elts:
        pair = points.elts
        if len(pair) == 2 and isinstance(pair[0], ast.Constant) and isinstance(pair[1], ast.List):
            wanted = f"{{{text.code(pair[0])}: {text.code(pair[1])}}}"
            return reader.fault("entries_pair", points, text.swap(points, wanted))
        wanted = f"{{{q}console_scripts{q}: {text.code(points)}}}"
        return reader.fault("entries_list", points, text.swap(points, wanted))
    if not isinstance(points, ast.Dict):
        return None
    for key, value in zip(points.keys, points.values, strict=True):
        if not isinstance(value, ast.Dict) or not isinstance(key, ast.Constant):
            continue
        pairs = [(k, v) for k, v in zip(value.keys, value.values, strict=True)]
        texts = [
            f"{k.value!s} = {v.value!s}"
            for k, v in pairs
            if isinstance(k, ast.Constant) and isinstance(v, ast.Constant)
        ]
        if len(texts) != len(pairs) or not texts:
            return None
        wanted = f"[{', '.join(f'{q}{entry}{q}' for entry in texts)}]"
        swap = text.swap(value, wanted)
        return reader.fault("entries_dict", value, swap, wanted=wanted, name=str(key.value))
    return None


def _in_settings(reader: _Reader) -> ast.expr | None:
    """Return entry_points in `dict(…)` or `….update(…)`, if setup() gets a dict with two stars."""
    given = {dotted(k.value) for k in reader.call.keywords if k.arg is None} - {""}
    for node in reader.module.nodes:
        call = node.value if isinstance(node, ast.Assign | ast.Expr) else None
        if not isinstance(call, ast.Call):
            continue
        targets = {dotted(t) for t in node.targets} if isinstance(node, ast.Assign) else set()
        is_dict = dotted(call.func) == "dict" and targets & given
        if is_dict or dotted(call.func) in {f"{name}.update" for name in given}:
            found = [k.value for k in call.keywords if k.arg == "entry_points"]
            if found:
                return found[0]
    return None


def _entries_set(reader: _Reader, points: ast.Set) -> SetupFault | None:
    """A comma instead of the colon between the name of a group and its entries."""
    text = reader.module.text
    if len(points.elts) != 2 or not all(
        isinstance(e, ast.Constant | ast.Tuple) for e in points.elts
    ):
        return None
    group, entries = points.elts
    items = entries.elts if isinstance(entries, ast.Tuple) else [entries]
    codes = ", ".join(text.code(item) for item in items)
    wanted = f"{{{text.code(group)}: [{codes}]}}"
    return reader.fault("entries_set", points, text.swap(points, wanted), wanted=wanted)


def _no_source_folder(reader: _Reader, match: re.Match[str]) -> SetupFault | None:
    """`package_dir` leads to a folder that is not there."""
    keyword = next((k for k in reader.call.keywords if k.arg == "package_dir"), None)
    packages = reader.argument("packages")
    if keyword is None or packages is None or not _leads_to(reader, keyword.value, match["path"]):
        return None
    text = reader.module.text
    splices = reader.without(keyword, reader.call.keywords)
    words = {"name": match["path"]}
    if not isinstance(packages, ast.Call) or not (
        packages.args or any(k.arg in (None, "where") for k in packages.keywords)
    ):
        return reader.fault("package_dir_alone", keyword, *splices, **words)
    if dotted(packages.func).rpartition(".")[2] not in FINDERS:
        return None
    wanted = f"{dotted(packages.func)}(exclude=[{text.quote}test{text.quote}])"
    splices.append(text.swap(packages, wanted))
    return reader.fault("package_dir", keyword, *splices, **words, wanted=f"packages={wanted}")


def _leads_to(reader: _Reader, package_dir: ast.expr, path: str) -> bool:
    """Whether a folder is one that package_dir names, or is in it."""
    folders = _folders(reader.module, package_dir)
    return any(f"{path}/".startswith(f"{folder}/") for folder in folders)


def source_folders(found: bytes) -> list[str]:
    """Return the folders to which `package_dir` of a setup.py leads."""
    module = parsed_setup(found)
    call = setup_call(module) if module is not None else None
    if module is None or call is None:
        return []
    return [f for k in call.keywords if k.arg == "package_dir" for f in _folders(module, k.value)]


def _folders(module: Module, package_dir: ast.expr) -> list[str]:
    table = Evaluator(module.tree, module.text.text).value(package_dir)
    named = [v for _, v in table.pairs] if isinstance(table, Table) else []
    folders = [value.value.strip("/") for value in named if isinstance(value, Text)]
    return [folder for folder in folders if folder]


def _of_ros_1(reader: _Reader, match: re.Match[str]) -> SetupFault | None:
    """The setup.py of a catkin package."""
    del match
    for statement in reader.module.tree.body:
        if isinstance(statement, ast.ImportFrom) and str(statement.module).startswith("catkin_pkg"):
            return reader.fault("ros_1", statement, package=reader.package)
    return None


def _group_name(reader: _Reader, match: re.Match[str]) -> SetupFault | None:
    """A group of entry points whose name setuptools refuses."""
    points = reader.argument("entry_points")
    for key in points.keys if isinstance(points, ast.Dict) else ():
        if isinstance(key, ast.Constant) and str(key.value).strip() == match["name"]:
            return reader.fault("group_name", key, name=match["name"])
    return None


def _glob(reader: _Reader, match: re.Match[str]) -> SetupFault | None:
    """`import glob` with glob(…), or `from glob import glob` with glob.glob(…)."""
    del match
    module = reader.module
    calls = {dotted(n.func) for n in module.nodes if isinstance(n, ast.Call)}
    ways = {"glob": "from glob import glob", "glob.glob": "import glob"}
    wanted = [ways[call] for call in ways if call in calls]
    for statement in module.tree.body:
        code = " ".join(module.text.code(statement).split())
        if len(wanted) == 1 and code in ways.values() and code != wanted[0]:
            swap = module.text.swap(statement, wanted[0])
            return reader.fault("import_form", statement, swap, found=code, wanted=wanted[0])
    return None


def _pairs(reader: _Reader) -> list[tuple[ast.expr, ast.expr]]:
    """Return the folders of `data_files`, each with its files."""
    data_files = reader.argument("data_files")
    items = data_files.elts if isinstance(data_files, ast.List | ast.Tuple) else []
    pairs = [i.elts for i in items if isinstance(i, ast.Tuple | ast.List) and len(i.elts) == 2]
    return [(folder, files) for folder, files in pairs]


def _file_alone(reader: _Reader, match: re.Match[str]) -> SetupFault | None:
    """A file instead of a list of files in `data_files`."""
    del match
    code = reader.module.text.code
    alone = [files for _, files in _pairs(reader) if isinstance(files, TEXT)]
    if not alone:
        return None
    swaps = [reader.module.text.swap(files, f"[{code(files)}]") for files in alone]
    wanted = ", ".join(f"[{code(files)}]" for files in alone)
    return reader.fault("file_alone", alone[0], *swaps, wanted=wanted)


def _not_copied(reader: _Reader, match: re.Match[str]) -> SetupFault | None:
    """A file of `data_files` that is not in the package, or a folder without a list of files."""
    build, text = f"/build/{reader.package}/", reader.module.text
    path: str = match["path"].rpartition(build)[2] if build in match["path"] else match["path"]
    data_files = reader.argument("data_files")
    items = data_files.elts if isinstance(data_files, ast.List | ast.Tuple) else []
    plain = [i for i in items if isinstance(i, ast.BinOp | ast.Constant | ast.JoinedStr)]
    if plain and path == f"share/{reader.package}":
        code = text.code(plain[0])
        inside = f"{code}, [{text.quote}package.xml{text.quote}]"
        wanted, (start, end) = f"({inside})", text.span(plain[0])
        in_brackets = text.text[start - 1] == "(" and text.text[end : end + 1] == ")"
        new = inside if in_brackets else wanted
        whole = [text.swap(plain[0], new)] if len(plain) == 1 else []
        return reader.fault("no_files", plain[0], *whole, wanted=wanted)
    for pair, (_, files) in zip(
        [i for i in items if isinstance(i, ast.Tuple | ast.List) and len(i.elts) == 2],
        _pairs(reader),
        strict=True,
    ):
        named = files.elts if isinstance(files, ast.List | ast.Tuple) else []
        for node in named:
            if value_of(reader.module, node) == path:
                deeper = [name for name in reader.files if name.endswith(f"/{path}")]
                near = nearest(path, ["package.xml", *reader.files], cutoff=0.8)
                close = deeper[0] if len(deeper) == 1 else near
                if close:
                    wanted = f"{text.quote}{close}{text.quote}"
                    swap = text.swap(node, wanted)
                    return reader.fault("no_copy_close", node, swap, name=path, wanted=close)
                splices = reader.without(node, named) or reader.without(pair, items)
                return reader.fault("no_copy", node, *splices, name=path)
    return None


def _comma_behind(reader: _Reader, match: re.Match[str]) -> SetupFault | None:
    """A text above setup() with a comma behind it, which makes it a tuple."""
    del match
    text, found = reader.module.text, []
    for node in reader.module.tree.body:
        value = node.value if isinstance(node, ast.Assign) else None
        if not isinstance(value, ast.Tuple) or len(value.elts) != 1:
            continue
        target = dotted(node.targets[0]) if isinstance(node, ast.Assign) else ""
        code = text.code(value)
        used = any(dotted(part) == target for part in ast.walk(reader.call))
        if used and not code.startswith("(") and code.endswith(","):
            found.append((value, target, text.code(value.elts[0])))
    if len(found) != 1:
        return None
    value, target, code = found[0]
    splice = text.swap(value, code)
    return reader.fault("comma_behind", value, splice, name=target, wanted=f"{target} = {code}")


LOOKS: tuple[tuple[str, Callable[[_Reader, re.Match[str]], SetupFault | None]], ...] = (
    (r"TypeError: string indices must be integers", _no_colon),
    (r"TypeError: '(?:method|function)' object is not iterable", _not_called),
    (r"TypeError: expected string or bytes-like object", _list_in_list),
    (r"TypeError: .{0,80}\btuple\b", _comma_behind),
    (r"FileNotFoundError: .{0,60}No such file or directory: '(?P<path>[^'\n]{1,200})'", _no_file),
    (r"NameError: name '(?P<name>\w{1,80})' is not defined", _name),
    (r"ImportError: cannot import name '(?P<name>\w{1,80})' from 'setuptools'", _not_in_setuptools),
    (r"ModuleNotFoundError: No module named '(?P<name>[\w.]{1,80})'", _no_module),
    (r"TypeError: setup\(\) takes 0 positional arguments", _positional),
    (r"ValueError: \('Invalid group name', '(?P<name>[^'\n]{1,200})'\)", _group_name),
    (r"TypeError: 'module' object is not callable", _glob),
    (r"AttributeError: 'function' object has no attribute 'glob'", _glob),
    (r"AssertionError$", _file_alone),
    (r"AssertionError$", _folder_absolute),
    (r"TypeError: expected str, bytes or os\.PathLike object, not list", _pair_form),
    (
        r"AssertionError: 'data_files' must be relative, '(?P<path>[^'\n]{1,300})' is absolute",
        _absolute,
    ),
    (r"RuntimeError: Provided py_modules '(?P<name>[^'\n]{1,100})' does not exist", _py_modules),
    (r"error: can't copy '(?P<path>[^'\n]{1,300})': doesn't exist", _not_copied),
    (r"colcon cannot read", _function_given),
    (r"setup\(\) was never called", _never_called),
    (r"error: error in 'egg_base' option: '(?P<path>[^'\n]{1,200})'", _no_source_folder),
    (r"(?:error: )?package directory '(?P<path>[^'\n]{1,200})'", _no_source_folder),
    (r"OSError: Path ", _of_ros_1),
    (r"ValueError: malformed node or string", _path_object),
    (r"AttributeError: '\w{0,20}Path' object has no attribute", _path_object),
    (r"InvalidVersion: ", _refused_version),
    (r"inside of setup\(\)", _pair_form),
    (r"inside of setup\(\)", _wrong_form),
    (r"inside of setup\(\)", _comma_behind),
)
INSIDE = "inside of setup()"
"""Stands for an error that comes from inside of setuptools, and is not known."""
NOT_REACHED = "setup() was never called"
"""Stands for the error if setup.py ends before setup() has done its work."""
UNREAD = "colcon cannot read"
"""Stands for the error if colcon does not understand what setup.py answers."""
