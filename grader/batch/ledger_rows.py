"""Changes rows of a ledger, each with its link in the chain."""

from __future__ import annotations

import sqlite3
from collections.abc import Collection, Mapping

from grader.base.signing import SigningKey
from grader.batch import ledger_chain


def put(
    connection: sqlite3.Connection,
    table: str,
    values: Mapping[str, object],
    key: SigningKey | None,
    *,
    unique: Collection[str] = (),
    keeps: Collection[str] = (),
) -> int:
    """Insert a row, or change the one with the same values of `unique`; return its id.

    The columns in `keeps` stay as they were inserted. What changes nothing adds no link.
    """
    found = _ids(connection, table, {name: values[name] for name in unique}) if unique else []
    if not found:
        names, marks = ", ".join(values), ", ".join("?" * len(values))
        query = f"INSERT INTO {table} ({names}) VALUES ({marks})"  # noqa: S608 - our own names
        row = int(connection.execute(query, tuple(values.values())).lastrowid or 0)
        ledger_chain.append(connection, table, row, key)
        return row
    row = found[0]
    new = {name: value for name, value in values.items() if name not in (*unique, *keeps)}
    differs = " OR ".join(f"{name} IS NOT ?" for name in new) or "FALSE"
    sets = ", ".join(f"{name} = ?" for name in new) or "id = id"
    query = f"UPDATE {table} SET {sets} WHERE id = ? AND ({differs})"  # noqa: S608
    if connection.execute(query, (*new.values(), row, *new.values())).rowcount:
        ledger_chain.append(connection, table, row, key)
    return row


def remove(
    connection: sqlite3.Connection,
    table: str,
    values: Mapping[str, object],
    key: SigningKey | None,
) -> int:
    """Remove the rows with these values and return how many there were.

    The chain stays whole: it says that they were removed, and keeps nothing of their content.
    """
    found = _ids(connection, table, values)
    for row in found:
        connection.execute(f"DELETE FROM {table} WHERE id = ?", (row,))  # noqa: S608
        ledger_chain.append(connection, table, row, key)
    return len(found)


def _ids(connection: sqlite3.Connection, table: str, values: Mapping[str, object]) -> list[int]:
    where = " AND ".join(f"{name} = ?" for name in values)
    query = f"SELECT id FROM {table} WHERE {where}"  # noqa: S608 - our own names
    return [int(row) for (row,) in connection.execute(query, tuple(values.values())).fetchall()]
