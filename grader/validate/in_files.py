"""Automatic mutants of the files: layout, manifest, setup.cfg, the script's first line and mode.

Each function yields (name, edits, checks), and one of these checks must fail.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from grader.course.assignment import Assignment
from grader.package.edit.tree import (
    Chmod,
    Copy,
    Crlf,
    Delete,
    Edit,
    Move,
    Nest,
    Tree,
    Write,
    text_of,
)
from grader.package.source.python import can_parse
from grader.validate.spots import misspelt
from grader.verdict.checks.all import FAMILIES

Made = tuple[str, tuple[Edit, ...], tuple[str, ...]]
ANY = FAMILIES
MANIFEST = "package.xml"
SETUP = "setup.py"
CFG = "setup.cfg"
REPEATED = ("maintainer", "license", "author", "url")  # REP 149 allows several


def needed(assignment: Assignment) -> tuple[str, ...]:
    """Return the paths of the files that a package of this assignment needs."""
    package = assignment.package
    inner = (f"{package}/__init__.py", f"{package}/{assignment.node_file}")
    return (MANIFEST, SETUP, CFG, f"resource/{package}", *inner)


def mutants_of(tree: Tree, assignment: Assignment) -> Iterator[Made]:
    """Yield every mutant of the package's files."""
    node = f"{assignment.package}/{assignment.node_file}"
    yield from _layout(tree, assignment)
    yield from _manifest(text_of(tree, MANIFEST), assignment)
    yield from _cfg(text_of(tree, CFG), assignment)
    yield from _script(tree, node)


def _layout(tree: Tree, assignment: Assignment) -> Iterator[Made]:
    package = assignment.package
    for path in needed(assignment):
        data = tree[path].data
        folder, _, name = path.rpartition("/")
        stem, dot, suffix = name.partition(".")
        other = f"{misspelt(stem)}{dot}{suffix}"
        to = f"{folder}/{other}" if folder else other
        yield f"delete {path}", (Delete(path),), ANY
        yield f"rename {path}", (Move(path, to),), ANY
        if folder:
            yield f"move {path} up", (Move(path, name + "_"),), ANY
        if data:
            yield f"empty {path}", (Write(path, b""),), ANY
            yield f"Word document for {path}", (Write(path, b"PK\3\4\x14\0\6\0\0\0!\0"),), ANY
    for folder in ("resource", package):
        yield f"delete folder {folder}", (Delete(folder),), ANY
        yield f"rename folder {folder}", (Move(folder, f"{folder}s"),), ANY
        yield f"folder {folder} in src", (Move(folder, f"src/{folder}"),), ANY
    nested = (Nest(f"src/{package}"), Copy(f"src/{package}", f"src/{package}_copy"))
    yield "copy of the package beside it", nested, ("build.colcon",)


def _manifest(text: str, assignment: Assignment) -> Iterator[Made]:
    checks = ("package.manifest", "package.depends")
    named = "package.depends" in {use.kind for use in assignment.checks}

    def made(name: str, new: str) -> Made:
        return f"package.xml {name}", (Write(MANIFEST, new.encode()),), checks

    for found in re.finditer(r"[ ]*<(\w+)([^<>]*)>([^<>]*)</\1>\n", text):
        element, tag, attributes, content = found[0], found[1], found[2], found[3]
        if named and tag == "depend":
            yield made(f"without {tag} {content}", text.replace(element, ""))
        if "depend" not in tag:
            yield made(f"without {tag}", text.replace(element, ""))
            empty = element.replace(f">{content}<", "><")
            yield made(f"{tag} empty", text.replace(element, empty))
        if tag not in REPEATED and "depend" not in tag:
            yield made(f"{tag} twice", text.replace(element, element * 2))
        yield made(f"{tag} not closed", text.replace(element, element.replace(f"</{tag}>", "")))
        wrong = element.replace(f"<{tag}", f"<{tag}x").replace(f"/{tag}>", f"/{tag}x>")
        yield made(f"{tag} misspelt", text.replace(element, wrong))
        if attributes:
            yield made(f"{tag} without attributes", text.replace(attributes, ""))
    for name, old, new in (
        ("format 9", 'format="3"', 'format="9"'),
        ("format 1", 'format="3"', 'format="1"'),
        ("format lost", ' format="3"', ""),
        ("root misspelt", "<package ", "<pakage "),
        ("end lost", "</package>", ""),
        ("text after the end", "</package>", "</package>x"),
        ("export lost", "<export>", ""),
        ("version of two numbers", ">0.0.0<", ">0.0<"),
        ("version of words", ">0.0.0<", ">first<"),
        ("ampersand", "<description>", "<description>You & me "),
        ("mail without at", "@", " at "),
        ("build type ament_cmake", "ament_python", "ament_cmake"),
        ("build type catkin", "ament_python", "catkin"),
        ("build type with a blank", "ament_python", "ament python"),
        ("build type capital", "ament_python", "Ament_Python"),
        (
            "name with a dash",
            f">{assignment.package}<",
            f">{assignment.package.replace('_', '-')}<",
        ),
        ("name capital", f">{assignment.package}<", f">{assignment.package.title()}<"),
        ("name letter lost", f">{assignment.package}<", f">{assignment.package[:-1]}<"),
        ("dependency that nobody has", ">rclpy<", ">rclpyy<"),
    ):
        if old in text:
            yield made(name, text.replace(old, new, 1))


def _cfg(text: str, assignment: Assignment) -> Iterator[Made]:
    def made(name: str, new: str) -> Made:
        return f"setup.cfg {name}", (Write(CFG, new.encode()),), ("package.setup_cfg",)

    lines = text.splitlines(keepends=True)
    for n, line in enumerate(lines):
        shown = line.strip()
        yield made(f"without {shown}", "".join(lines[:n] + lines[n + 1 :]))
        changes = {
            "other package": (assignment.package, assignment.package[:-1], -1),
            "no $base": ("$base", "", -1),
            "bin": ("/lib/", "/bin/", -1),
            "no folder": (f"/{assignment.package}", "", -1),
            "misspelt": ("s", "", 1),
            "no sign": ("=", " ", 1),
            "bracket lost": ("]", "", 1),
        }
        for name, (old, instead, times) in changes.items():
            new = line.replace(old, instead, times)
            if new != line:
                yield made(f"{name} in {shown}", "".join([*lines[:n], new, *lines[n + 1 :]]))


def _script(tree: Tree, path: str) -> Iterator[Made]:
    data = tree[path].data
    first, _, rest = data.partition(b"\n")
    shebang = ("source.shebang",)
    for name, new in {
        "lost": rest,
        "after a comment": b"# mine\n" + data,
        "after an empty line": b"\n" + data,
        "after a blank": b" " + data,
        "of bash": b"#!/bin/bash\n" + rest,
        "of python 2": b"#!/usr/bin/env python2\n" + rest,
        "without env": b"#!/usr/bin/env\n" + rest,
        "without slash": first.replace(b"#!/", b"#!") + b"\n" + rest,
        "without sign": first.replace(b"#!", b"#") + b"\n" + rest,
        "signs swapped": first.replace(b"#!", b"!#") + b"\n" + rest,
        "misspelt": first.replace(b"python3", b"pyhton3") + b"\n" + rest,
        "after a byte order mark": b"\xef\xbb\xbf" + data,
        "with a carriage return": first + b"\r\n" + rest,
    }.items():
        families = ("source.",) if name == "signs swapped" else shebang
        yield f"first line {name}", (Write(path, new),), families
    yield "first line Windows", (Crlf(path),), shebang
    for mode in (0o644, 0o600, 0o666, 0o444, 0o000):
        yield f"mode {mode:04o}", (Chmod(path, mode),), ("source.exec_bit",)
    encoding = ("source.",)
    yield "node in UTF-16", (Write(path, text_of(tree, path).encode("utf-16")),), encoding
    yield "node with tabs", (Write(path, data.replace(b"        ", b"\t", 1)),), encoding
    yield "node with a bracket lost", (Write(path, data.replace(b")", b"", 1)),), encoding
    yield "node with a colon lost", (Write(path, data.replace(b":\n", b"\n", 1)),), encoding
    yield "node indented by one", (Write(path, _indented(data)),), encoding


def _indented(data: bytes) -> bytes:
    """Return a source with one line indented too far: the first after which Python cannot read it."""
    for found in re.finditer(rb"\n    ", data):
        new = data[: found.end()] + b" " + data[found.end() :]
        if not can_parse(new):
            return new
    return b" " + data
