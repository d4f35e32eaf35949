"""The hash chain of a ledger: a changed, removed or inserted row is noticed.

Each row has a link, and one more for each change of it. A link has the digest of what the row then
had: the SHA-256 of a salt and of the row in canonical JSON ("" if the row was removed). Its own hash
is the SHA-256 of the hash before it and of this digest, so the last one (the head) stands for all
rows. The salt goes with the content: once a row is removed, nothing can be guessed from its digest,
and the chain is still whole. With a key the hash is signed: without the key nobody can make the
chain anew after a change. Rows that are missing at the end only show if the head was noted elsewhere.

The links of an earlier grader have no digest: their hash covers a verdict or a correction directly.
"""

from __future__ import annotations

import hashlib
import math
import secrets
import sqlite3
import zlib
from dataclasses import dataclass, field

from grader.base.canonical_json import canonical_json
from grader.base.shown import shown
from grader.base.signing import PublicKey, SigningKey, own_key

START = "0" * 64
TABLES = ("verdict", "override", "handed_in", "regrade", "fault", "student", "setting", "remark")
YOUNGER = ("remark",)  # tables that came after the links of all rows
ADOPTED = {"verdict": "marked", "override": "at"}  # when a row of the first grader was made
REMOVED = ""  # the digest of a row that is not there any more
SALT_BYTES = 16
PACKED = ("report", "evidence")
LATER = ("verdict",)  # a column that came later: without a value it is not part of the hash


@dataclass(frozen=True)
class Head:
    """The last link: how many there are, and its hash."""

    count: int = 0
    hash: str = START


@dataclass
class ChainCheck:
    """What a check of the chain found; `faults` is empty if all of it agrees.

    `removed` is the number of rows that were removed by a link of their own.
    """

    head: Head = field(default_factory=Head)
    signed: int = 0
    removed: int = 0
    faults: list[str] = field(default_factory=list)
    hashes: set[str] = field(default_factory=set)


@dataclass(frozen=True)
class _Link:
    number: int
    table: str
    row: int
    hash: str
    signature: bytes | None
    digest: str | None
    salt: bytes | None

    @property
    def name(self) -> str:
        return f"link {self.number}: {self.table} {self.row}"


def append(connection: sqlite3.Connection, table: str, row: int, key: SigningKey | None) -> None:
    """Add the link of a row that was inserted, changed or removed in the same transaction."""
    before, values = head_of(connection), _row(connection, table, row)
    salt = None if values is None else secrets.token_bytes(SALT_BYTES)
    digest = REMOVED if values is None or salt is None else _salted(salt, values)
    found = _hash(before, table, row, digest)
    signature = key.sign(_signed(before.count + 1, found)) if key is not None else None
    connection.execute("UPDATE link SET salt = NULL WHERE place = ? AND row = ?", (table, row))
    connection.execute(
        "INSERT INTO link (id, place, row, hash, signature, digest, salt) "
        "VALUES (?, ?, ?, ?, ?, ?, ?)",
        (before.count + 1, table, row, found, signature, digest, salt),
    )


def adopt(connection: sqlite3.Connection) -> None:
    """Add links for the rows of an earlier grader, which had none for them.

    The first one had no chain at all; later ones had links of verdicts and corrections only.
    """
    key = own_key()
    if head_of(connection).count == 0:
        rows = [
            (at, table, row)
            for table, column in ADOPTED.items()
            for row, at in connection.execute(f"SELECT id, {column} FROM {table}")  # noqa: S608
        ]
        for _, table, row in sorted(rows, key=lambda found: (found[0], found[1], found[2])):
            append(connection, table, row, key)
    for table in TABLES:
        if table not in (*ADOPTED, *YOUNGER):
            for row in _ids(connection, table):
                append(connection, table, row, key)


def head_of(connection: sqlite3.Connection) -> Head:
    """Return the last link."""
    row = connection.execute("SELECT id, hash FROM link ORDER BY id DESC LIMIT 1").fetchone()
    return Head(*row) if row else Head()


def check_chain(connection: sqlite3.Connection, key: PublicKey | None) -> ChainCheck:
    """Compute every hash again and check every signature, if there is a key."""
    check = ChainCheck()
    columns = "id, place, row, hash, signature, digest, salt"
    rows = connection.execute(f"SELECT {columns} FROM link ORDER BY id")  # noqa: S608
    links = [_Link(*row) for row in rows.fetchall()]
    last = {(link.table, link.row): link.number for link in links}
    there: dict[str, set[int]] = {table: set() for table in TABLES}
    for link in links:
        if link.number != check.head.count + 1:
            check.faults.append(f"link {link.number}: the links before it are not all there")
        if link.table not in TABLES or not isinstance(link.row, int):
            check.faults.append(f"link {link.number}: it is of no row")
            continue
        is_last = last[link.table, link.row] == link.number
        if is_last and link.digest == REMOVED:
            check.removed += 1
        elif is_last:
            there[link.table].add(link.row)
        check.faults += _faults(connection, check.head, link, is_last=is_last)
        check.signed += link.signature is not None
        if key is not None and not _is_signed_by(key, link):
            how = "is not signed" if link.signature is None else "has another key's signature"
            check.faults.append(f"{link.name} {how}")
        check.head = Head(link.number, str(link.hash))
        check.hashes.add(str(link.hash))
    for table, known in there.items():
        without = [row for row in _ids(connection, table) if row not in known]
        check.faults += [f"{table} {row} has no link: it was inserted" for row in without]
    return check


def _faults(
    connection: sqlite3.Connection, before: Head, link: _Link, *, is_last: bool
) -> list[str]:
    """Return what is wrong with a link's hash, or with the row that it is the last link of."""
    values = _row(connection, link.table, link.row) if is_last else None
    if is_last and values is None and link.digest != REMOVED:
        return [f"{link.name} was removed"]
    who = (
        f" of {shown(str(values['student']))}" if values is not None and "student" in values else ""
    )
    changed = [f"{link.name}{who}, or a link before it, was changed"]
    if link.digest is None:  # (of an earlier row only the hash is left)
        agrees = not is_last or _earlier_hash(before, link.table, values) == link.hash
        return [] if agrees else changed
    is_text = isinstance(link.digest, str)  # (anything can be in a column)
    if not is_text or _hash(before, link.table, link.row, link.digest) != link.hash:
        return changed
    if is_last and values is not None:
        salt = link.salt if isinstance(link.salt, bytes) else b""
        return [] if _salted(salt, values) == link.digest else changed
    return []


def _is_signed_by(key: PublicKey, link: _Link) -> bool:
    is_bytes = isinstance(link.signature, bytes)
    return is_bytes and key.verifies(link.signature or b"", _signed(link.number, link.hash))


def _ids(connection: sqlite3.Connection, table: str) -> list[int]:
    rows = connection.execute(f"SELECT id FROM {table} ORDER BY id")  # noqa: S608 - our own names
    return [row for (row,) in rows.fetchall()]


def _row(connection: sqlite3.Connection, table: str, row: int) -> dict[str, object] | None:
    """Return a row by its columns, contents as SHA-256; None if it is not there."""
    query = f"SELECT * FROM {table} WHERE id = ?"  # noqa: S608 - our own names
    cursor = connection.execute(query, (row,))
    values = cursor.fetchone()
    if values is None:
        return None
    names = [column[0] for column in cursor.description]
    return {
        name: _digest(value) if name in PACKED else _plain(value)
        for name, value in zip(names, values)
        if value is not None or name not in LATER
    }


def _plain(value: object) -> object:
    """Return a value of a column as JSON has it: anything can be in it, whatever its type says."""
    if isinstance(value, bytes):
        return {"bytes": value.hex()}
    if isinstance(value, float) and not math.isfinite(value):
        return {"number": str(value)}
    return value


def _digest(packed: object) -> object:
    """Return the SHA-256 of compressed content; what is not that stands for itself."""
    if not isinstance(packed, bytes):
        return packed if packed is None else {"not bytes": _plain(packed)}
    try:
        content = zlib.decompress(packed)
    except zlib.error:
        content = b"not compressed: " + packed
    return hashlib.sha256(content).hexdigest()


def _salted(salt: bytes, values: dict[str, object]) -> str:
    """Return the digest of a row; a column without a value is not part of it."""
    content = {name: value for name, value in values.items() if value is not None}
    return hashlib.sha256(salt + canonical_json(content)).hexdigest()


def _hash(before: Head, table: str, row: int, digest: str) -> str:
    content = {"before": before.hash, "number": before.count + 1, "place": table}
    return hashlib.sha256(canonical_json({**content, "row": row, "digest": digest})).hexdigest()


def _earlier_hash(before: Head, table: str, values: dict[str, object] | None) -> str:
    content = {"before": before.hash, "number": before.count + 1, "place": table, "row": values}
    return hashlib.sha256(canonical_json(content)).hexdigest()


def _signed(number: int, digest: str) -> bytes:
    text = f"ros2_teaching_lab ledger link {number} {digest}"
    return text.encode(errors="surrogateescape")
