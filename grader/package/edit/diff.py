"""The changes to a package as a unified diff in git's extended format (git-diff(1)).

`git apply` applies all of it, `patch -p1` all but the modes. The lines are the file's own bytes.
"""

from __future__ import annotations

import difflib
import hashlib
from collections.abc import Iterator

from grader.package.edit.files import Files
from grader.package.intake.model import SourceFile

CONTEXT = 3
MOST_COMPARED = 400
"""If more lines differ, all are shown as replaced: the cost of comparing is quadratic."""
NO_END = b"\\ No newline at end of file\n"
Opcode = tuple[bool, int, int, int, int]  # equal; start, end in old; start, end in new


def digest_of(patch: bytes) -> str:
    """Return by what a change is known that was tried: the SHA-256 of its diff."""
    return hashlib.sha256(patch).hexdigest()


def diff(old: Files, new: Files) -> bytes:
    """Return the diff from the old files to the new ones; empty if they are equal."""
    parts: list[bytes] = []
    for path, file in sorted(new.by_path.items()):
        if file.kind != "file" or file.unreadable:
            continue
        source = new.moved.get(path, path)
        before = old.by_path.get(source)
        if before is None or before.kind != "file":
            parts += _added(path, file)
        elif (before.data, before.mode & 0o111, source) != (file.data, file.mode & 0o111, path):
            parts += _changed(source, before, path, file)
    return b"".join(parts)


def _added(path: str, file: SourceFile) -> Iterator[bytes]:
    yield _head(path, path)
    yield b"new file mode %s\n" % _mode(file)
    if file.data:
        yield b"--- /dev/null\n+++ %s\n" % _quoted("b/" + path)
        yield from _hunks([], _lines(file.data))


def _changed(source: str, before: SourceFile, path: str, file: SourceFile) -> Iterator[bytes]:
    yield _head(source, path)
    if _mode(before) != _mode(file):
        yield b"old mode %s\nnew mode %s\n" % (_mode(before), _mode(file))
    if source != path:
        if before.data == file.data:
            yield b"similarity index 100%\n"
        yield b"rename from %s\nrename to %s\n" % (_quoted(source), _quoted(path))
    if before.data != file.data:
        yield b"--- %s\n+++ %s\n" % (_quoted("a/" + source), _quoted("b/" + path))
        yield from _hunks(_lines(before.data), _lines(file.data))


def _head(source: str, path: str) -> bytes:
    return b"diff --git %s %s\n" % (_quoted("a/" + source), _quoted("b/" + path))


def _mode(file: SourceFile) -> bytes:
    return b"100755" if file.mode & 0o100 else b"100644"  # git records no others


def _quoted(path: str) -> bytes:
    """Return a path quoted as git does (`core.quotePath`), and for patch also if it has a space."""
    plain = all(" " < c < "\x7f" and c not in '"\\' for c in path)
    if plain:
        return path.encode("ascii")
    written = []
    for byte in path.encode("utf-8", "surrogateescape"):
        c = chr(byte)
        if c in '"\\':
            written.append("\\" + c)
        else:
            written.append(c if " " <= c < "\x7f" else f"\\{byte:03o}")
    return ('"' + "".join(written) + '"').encode("ascii")


def _lines(data: bytes) -> list[bytes]:
    """Return the lines as git counts them: only a line feed ends a line."""
    lines = [line + b"\n" for line in data.split(b"\n")]
    last = lines.pop()[:-1]
    return [*lines, last] if last else lines


def _hunks(old: list[bytes], new: list[bytes]) -> Iterator[bytes]:
    for group in _groups(_opcodes(old, new)):
        first, last = group[0], group[-1]
        yield b"@@ -%s +%s @@\n" % (_range(first[1], last[2]), _range(first[3], last[4]))
        for equal, i, j, k, m in group:
            if equal:
                yield from (_row(b" ", line) for line in old[i:j])
            else:
                yield from (_row(b"-", line) for line in old[i:j])
                yield from (_row(b"+", line) for line in new[k:m])


def _row(sign: bytes, line: bytes) -> bytes:
    return sign + line if line.endswith(b"\n") else sign + line + b"\n" + NO_END


def _range(start: int, stop: int) -> bytes:
    length = stop - start
    begin = start + 1 if length else start  # an empty range begins after the line before it
    return b"%d" % begin if length == 1 else b"%d,%d" % (begin, length)


def _opcodes(old: list[bytes], new: list[bytes]) -> list[Opcode]:
    """Return the runs of equal and of different lines, in order."""
    most = min(len(old), len(new))
    head = 0
    while head < most and old[head] == new[head]:
        head += 1
    tail = 0
    while tail < most - head and old[-1 - tail] == new[-1 - tail]:
        tail += 1
    a, b = old[head : len(old) - tail], new[head : len(new) - tail]
    found: list[Opcode] = [(True, 0, head, 0, head)]
    if max(len(a), len(b)) > MOST_COMPARED:
        found.append((False, head, head + len(a), head, head + len(b)))
    else:
        matcher = difflib.SequenceMatcher(None, a, b, autojunk=False)
        for tag, i, j, k, m in matcher.get_opcodes():
            found.append((tag == "equal", head + i, head + j, head + k, head + m))
    found.append((True, len(old) - tail, len(old), len(new) - tail, len(new)))
    return [code for code in found if code[1] != code[2] or code[3] != code[4]]


def _groups(opcodes: list[Opcode]) -> Iterator[list[Opcode]]:
    """Yield the changes with their context lines; changes near each other form one group."""
    group: list[Opcode] = []
    for number, (equal, i, j, k, m) in enumerate(opcodes):
        if not equal:
            group.append((equal, i, j, k, m))
            continue
        last = number == len(opcodes) - 1
        if group and (last or j - i > 2 * CONTEXT):
            n = min(CONTEXT, j - i)
            yield [*group, (True, i, i + n, k, k + n)]
            group = []
        if not last:
            n = min(CONTEXT, j - i) if not group else j - i
            group.append((True, j - n, j, m - n, m))
    if any(not equal for equal, *_ in group):
        yield group
