"""Removes all rows of students from a ledger, each with its link in the chain, and from the file."""

from __future__ import annotations

import json
import sqlite3
from collections.abc import Collection

from grader.base.signing import SigningKey
from grader.batch.ledger_file import LedgerFile
from grader.batch.ledger_rows import put, remove

TABLES = {
    "regrade": "student",
    "fault": "student",
    "override": "student",
    "remark": "student",
    "handed_in": "student",
    "verdict": "student",
    "student": "key",
}
"""The tables with rows of a student, by the column that names the student; `regrade` refers to verdicts."""
COUNTING, OUTPUTS = "counting verdicts of ", "outputs "


def rows_of(file: LedgerFile, student: str) -> dict[str, int]:
    """Return how many rows of a student each table has."""
    found = {}
    for table, column in TABLES.items():
        query = f"SELECT count(*) FROM {table} WHERE {column} = ?"  # noqa: S608 - our own names
        found[table] = int(file.rows(query, (student,))[0][0])
    return {table: count for table, count in found.items() if count}


def forget(file: LedgerFile, students: Collection[str], key: SigningKey | None) -> None:
    """Remove the students' rows; then nothing of them is in the file any more."""
    with file.write() as connection:
        for student in students:
            for table, column in TABLES.items():
                remove(connection, table, {column: student}, key)
        _forget_settings(connection, students, key)
        connection.execute(
            "DELETE FROM fingerprint WHERE submission NOT IN (SELECT submission FROM handed_in)"
        )
    file.compact()


def _forget_settings(
    connection: sqlite3.Connection, students: Collection[str], key: SigningKey | None
) -> None:
    rows = connection.execute("SELECT name, value FROM setting").fetchall()
    for name, value in rows:
        if name.startswith(COUNTING):
            kept = {
                one: verdict for one, verdict in json.loads(value).items() if one not in students
            }
            row = {"name": name, "value": json.dumps(kept, sort_keys=True)}
            put(connection, "setting", row, key, unique=("name",))
        elif name.startswith(OUTPUTS):  # it has the names of the files that were written
            remove(connection, "setting", {"name": name}, key)
