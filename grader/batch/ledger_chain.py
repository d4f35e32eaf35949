"""The hash chain of a ledger: a changed, removed or inserted verdict or correction is noticed.

Each row has a link. A link's hash is the SHA-256 of the hash before it and of the row in canonical
JSON, so the last one (the head) stands for all rows. With a key the hash is signed: without the
key nobody can make the chain anew after a change. Rows that are missing at the end only show if
the head was noted elsewhere.
"""

from __future__ import annotations

import hashlib
import sqlite3
import zlib
from dataclasses import dataclass, field

from grader.base.canonical_json import canonical_json
from grader.base.signing import PublicKey, SigningKey, own_key

START = "0" * 64
TABLES = ("verdict", "override")
PACKED = ("report", "evidence")
LATER = ("verdict",)  # a column that came later: without a value it is not part of the hash


@dataclass(frozen=True)
class Head:
    """The last link: how many there are, and its hash."""

    count: int = 0
    hash: str = START


@dataclass
class ChainCheck:
    """What a check of the chain found; `faults` is empty if all of it agrees."""

    head: Head = field(default_factory=Head)
    signed: int = 0
    faults: list[str] = field(default_factory=list)
    hashes: set[str] = field(default_factory=set)


def append(connection: sqlite3.Connection, table: str, row: int, key: SigningKey | None) -> None:
    """Add the link of a row that was inserted in the same transaction."""
    before = head_of(connection)
    found = _hash(before, table, _row(connection, table, row))
    signature = key.sign(_signed(before.count + 1, found)) if key is not None else None
    connection.execute(
        "INSERT INTO link (id, place, row, hash, signature) VALUES (?, ?, ?, ?, ?)",
        (before.count + 1, table, row, found, signature),
    )


def adopt(connection: sqlite3.Connection) -> None:
    """Add links for all rows of a ledger that was made before there was a chain."""
    key = own_key()
    rows = [
        (at, table, row)
        for table, at_column in (("verdict", "marked"), ("override", "at"))
        for row, at in connection.execute(f"SELECT id, {at_column} FROM {table}")  # noqa: S608
    ]
    for _, table, row in sorted(rows, key=lambda found: (found[0], found[1], found[2])):
        append(connection, table, row, key)


def head_of(connection: sqlite3.Connection) -> Head:
    """Return the last link."""
    row = connection.execute("SELECT id, hash FROM link ORDER BY id DESC LIMIT 1").fetchone()
    return Head(*row) if row else Head()


def check_chain(connection: sqlite3.Connection, key: PublicKey | None) -> ChainCheck:
    """Compute every hash again and check every signature, if there is a key."""
    check = ChainCheck()
    linked: dict[str, set[int]] = {table: set() for table in TABLES}
    rows = connection.execute("SELECT id, place, row, hash, signature FROM link ORDER BY id")
    for number, table, row, stored, signature in rows.fetchall():
        name = f"link {number}"
        if number != check.head.count + 1:
            check.faults.append(f"{name}: the links before it are not all there")
        if table not in TABLES:
            check.faults.append(f"{name}: it is of no row")
            continue
        linked[table].add(row)
        values = _row(connection, table, row)
        if values is None:
            check.faults.append(f"{name}: {table} {row} was removed")
        elif _hash(check.head, table, values) != stored:
            who = values["student"]
            check.faults.append(f"{name}: {table} {row} of {who}, or a link before it, was changed")
        if signature is not None:
            check.signed += 1
        if key is not None and not (
            signature is not None and key.verifies(signature, _signed(number, stored))
        ):
            how = "is not signed" if signature is None else "has another key's signature"
            check.faults.append(f"{name}: {table} {row} {how}")
        check.head = Head(number, stored)
        check.hashes.add(stored)
    for table, known in linked.items():
        rows = connection.execute(f"SELECT id FROM {table} ORDER BY id")  # noqa: S608
        without = [row for (row,) in rows.fetchall() if row not in known]
        check.faults += [f"{table} {row} has no link: it was inserted" for row in without]
    return check


def _row(connection: sqlite3.Connection, table: str, row: int) -> dict[str, object] | None:
    """Return a row by its columns, contents as SHA-256; None if it is not there."""
    query = f"SELECT * FROM {table} WHERE id = ?"  # noqa: S608 - our own names
    cursor = connection.execute(query, (row,))
    values = cursor.fetchone()
    if values is None:
        return None
    names = [column[0] for column in cursor.description]
    return {
        name: _digest(value) if name in PACKED else value
        for name, value in zip(names, values)
        if value is not None or name not in LATER
    }


def _digest(packed: bytes | None) -> str | None:
    if packed is None:
        return None
    try:
        content = zlib.decompress(packed)
    except (zlib.error, TypeError):
        content = b"not compressed: " + bytes(packed)
    return hashlib.sha256(content).hexdigest()


def _hash(before: Head, table: str, values: dict[str, object] | None) -> str:
    content = {"before": before.hash, "number": before.count + 1, "place": table, "row": values}
    return hashlib.sha256(canonical_json(content)).hexdigest()


def _signed(number: int, digest: str) -> bytes:
    return f"ros2_teaching_lab ledger link {number} {digest}".encode()
