"""The lines of `data_files` in a setup.py: a folder and a list of files each."""

from __future__ import annotations

import ast
from dataclasses import dataclass
from posixpath import normpath

from grader.package.edit.text import Splice
from grader.package.source.module import Module
from grader.package.source.names import dotted

TEXT = (ast.Constant, ast.BinOp, ast.JoinedStr)


@dataclass(frozen=True)
class PairFault:
    """What is wrong with a line, the part to which that belongs, and how it should be written."""

    variant: str
    node: ast.expr
    wanted: str
    splices: tuple[Splice, ...] = ()


def pair_fault(module: Module, data_files: ast.expr | None) -> PairFault | None:
    """Return the first line without brackets around its two parts, or with the parts exchanged."""
    items = data_files.elts if isinstance(data_files, ast.List | ast.Tuple) else []
    text = module.text
    halves = list(zip(items[::2], items[1::2], strict=False))
    if halves and len(items) % 2 == 0 and all(_is_pair([*half]) for half in halves):
        wanted = f"({text.code(items[0])}, {text.code(items[1])})"
        splices = []
        for folder, files in halves:
            start, end = text.span(folder)[0], text.span(files)[1]
            splices += [Splice(start, start, "("), Splice(end, end, ")")]
        return PairFault("pair_open", items[0], wanted, tuple(splices))
    pairs = [item.elts for item in items if isinstance(item, ast.Tuple | ast.List)]
    swapped = [parts for parts in pairs if _is_pair(parts[::-1])]
    if not swapped:
        return None
    swaps = [
        text.swap(old, text.code(new)) for parts in swapped for old, new in (parts, parts[::-1])
    ]
    files, folder = swapped[0]
    wanted = f"({text.code(folder)}, {text.code(files)})"
    return PairFault("pair_swapped", files, wanted, tuple(swaps))


def _is_pair(parts: list[ast.expr]) -> bool:
    """Whether this is a text and a list."""
    return len(parts) == 2 and isinstance(parts[0], TEXT) and isinstance(parts[1], ast.List)


def absolute_file(
    module: Module, data_files: ast.expr | None, path: str, package: str
) -> PairFault | None:
    """Return the file whose path is not relative to the package's folder; `path` is that path."""
    relative = path.partition(f"/{package}/")[2]
    items = data_files.elts if isinstance(data_files, ast.List | ast.Tuple) else []
    pairs = [i.elts for i in items if isinstance(i, ast.Tuple | ast.List) and len(i.elts) == 2]
    files = [file for _, group in pairs if isinstance(group, ast.List) for file in group.elts]
    made = [file for file in files if not isinstance(file, ast.Constant)]
    named = [file for file in made if _constants(file) == relative]
    if not relative or len(named) != 1:
        return None
    q = module.text.quote
    names = _names(named[0])
    same = [file for file in made if _names(file) == names and _constants(file)]
    swaps = tuple(module.text.swap(file, f"{q}{_constants(file)}{q}") for file in same)
    return PairFault("absolute", named[0], f"{q}{relative}{q}", swaps)


def absolute_folder(module: Module, data_files: ast.expr | None) -> PairFault | None:
    """Return the first folder that begins with a slash."""
    items = data_files.elts if isinstance(data_files, ast.List | ast.Tuple) else []
    pairs = [i.elts for i in items if isinstance(i, ast.Tuple | ast.List) and len(i.elts) == 2]
    first = [_first_text(pair[0]) for pair in pairs]
    wrong = [node for node in first if node is not None and str(node.value).startswith("/")]
    if not wrong:
        return None
    q = module.text.quote
    codes = [f"{q}{str(node.value).lstrip('/')}{q}" for node in wrong]
    swaps = tuple(module.text.swap(node, code) for node, code in zip(wrong, codes, strict=True))
    return PairFault("folder_absolute", wrong[0], codes[0], swaps)


def _first_text(node: ast.expr) -> ast.Constant | None:
    """Return the text with which an expression begins; None if it begins with something else."""
    while isinstance(node, ast.BinOp):
        node = node.left
    if isinstance(node, ast.Call) and node.args and dotted(node.func).endswith("join"):
        node = node.args[0]
    text = isinstance(node, ast.Constant) and isinstance(node.value, str)
    return node if isinstance(node, ast.Constant) and text else None


def _constants(node: ast.expr) -> str:
    """Return the path of the texts in an expression."""
    texts = [n for n in ast.walk(node) if isinstance(n, ast.Constant) and isinstance(n.value, str)]
    texts.sort(key=lambda n: (n.lineno, n.col_offset))
    return normpath("/".join(str(n.value) for n in texts)).lstrip("/") if texts else ""


def _names(node: ast.expr) -> set[str]:
    return {n.id for n in ast.walk(node) if isinstance(n, ast.Name)}
