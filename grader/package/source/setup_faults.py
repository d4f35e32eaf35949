"""Why a setup.py stops with an error: the line that is to be changed, and how, if that is certain."""

from __future__ import annotations

import ast
import re
from collections.abc import Callable
from dataclasses import dataclass, field

from grader.base.nearest import nearest
from grader.base.shown import shown
from grader.package.edit.text import Positioned, Splice
from grader.package.source.module import Module
from grader.package.source.python import can_parse
from grader.package.source.setup_packages import FINDERS, parsed_setup, setup_call
from grader.package.source.values import Evaluator, Table, Text

CONSTANTS = {"true": "True", "false": "False", "null": "None", "none": "None"}
"""What other languages call Python's constants."""


@dataclass(frozen=True)
class SetupFault:
    """What is wrong, its line, and the values of the placeholders in its texts.

    `fixed` is the file after the change; None if no change is certain.
    """

    variant: str
    line: int
    words: dict[str, str] = field(default_factory=dict)
    fixed: bytes | None = None


def setup_fault(found: bytes, error: str, package: str) -> SetupFault | None:
    """Return why a setup.py stops with an error; None if it is not known."""
    module = parsed_setup(found)
    for pattern, look in LOOKS if module is not None else ():
        match = re.match(pattern, error)
        fault = look(module, match, package) if module is not None and match is not None else None
        if fault is not None:
            return fault
    return None


def _fault(
    module: Module, variant: str, at: Positioned, *splices: Splice, **words: str
) -> SetupFault:
    new = module.text.spliced(splices) if splices and module.exact else None
    fixed = new if new is not None and can_parse(new) else None
    return SetupFault(variant, at.lineno, {key: shown(one) for key, one in words.items()}, fixed)


def _name(module: Module, match: re.Match[str], package: str) -> SetupFault | None:
    """A name that nothing defines."""
    name, text = match["name"], module.text
    uses = [n for n in module.nodes if isinstance(n, ast.Name) and n.id == name]
    if not uses or any(not isinstance(use.ctx, ast.Load) for use in uses) or name in module.names:
        return None
    first = min(uses, key=lambda n: (n.lineno, n.col_offset))
    longer = [one for one in module.names if one.startswith(f"{name}_")]
    close = CONSTANTS.get(name) or nearest(name, module.names, cutoff=0.75)
    close = close or (longer[0] if len(longer) == 1 else "")
    if close:
        swaps = [text.swap(use, close) for use in uses]
        return _fault(module, "misspelt", first, *swaps, name=name, close=close)
    call = setup_call(module)
    if name == "package_name":
        row = f"package_name = {text.quote}{package}{text.quote}"
        above = next((s for s in module.tree.body if call and call in ast.walk(s)), None)
        insert = [text.before(above.lineno, row, "")] if above is not None else []
        return _fault(module, "variable", first, *insert, name=name, statement=row)
    swaps = [text.swap(first, f"{text.quote}{name}{text.quote}")]
    is_key = isinstance(module.parents.get(first), ast.Dict | ast.List)
    return _fault(module, "undefined", first, *(swaps if is_key else []), name=name)


def _imported(module: Module, match: re.Match[str], _: str) -> SetupFault | None:
    """A misspelt name in `from setuptools import …`, or setuptools itself."""
    name = match["name"]
    close = nearest(name, ("setuptools", "setup", *FINDERS), cutoff=0.75)
    imports = [n for n in module.nodes if isinstance(n, ast.Import | ast.ImportFrom)]
    named = [n for n in imports if name in {*(a.name for a in n.names), getattr(n, "module", "")}]
    if not close or not named:
        return None
    uses: list[Positioned] = [n for n in module.nodes if isinstance(n, ast.Name) and n.id == name]
    row = module.text.line(named[0].lineno)
    at = module.text.start_of(named[0].lineno) + row.find(name)
    splices = [Splice(at, at + len(name), close), *(module.text.swap(n, close) for n in uses)]
    once = row.count(name) == 1
    return _fault(module, "misspelt", named[0], *(splices if once else []), name=name, close=close)


LOOKS: tuple[tuple[str, Callable[[Module, re.Match[str], str], SetupFault | None]], ...] = (
    (r"NameError: name '(?P<name>\w{1,80})' is not defined", _name),
    (r"ImportError: cannot import name '(?P<name>\w{1,80})' from 'setuptools'", _imported),
    (r"ModuleNotFoundError: No module named '(?P<name>\w{1,80})'", _imported),
)


def argument_line(found: bytes, name: str) -> int | None:
    """Return the line of an argument of setup(); None if it is not given."""
    module = parsed_setup(found)
    call = setup_call(module) if module is not None else None
    keywords = call.keywords if call is not None else []
    return next((k.value.lineno for k in keywords if k.arg == name), None)


def source_folders(found: bytes) -> dict[str, int]:
    """Return the folders to which `package_dir` of a setup.py leads, and the line of each."""
    module = parsed_setup(found)
    call = setup_call(module) if module is not None else None
    given = [k.value for k in call.keywords if k.arg == "package_dir"] if call is not None else []
    folders: dict[str, int] = {}
    for node in given if module is not None else ():
        table = Evaluator(module.tree, module.text.text).value(node) if module else None
        named = [v for _, v in table.pairs] if isinstance(table, Table) else []
        folders |= {v.value.strip("/"): v.line for v in named if isinstance(v, Text)}
    return {folder: line for folder, line in folders.items() if folder}
