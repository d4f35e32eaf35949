"""The tables of the ledger, and the migration of an older ledger.

`PRAGMA user_version` counts the migration steps taken; the ledger of a newer grader is refused.
"""

from __future__ import annotations

import sqlite3
from collections.abc import Callable

from grader.batch import ledger_chain

APPLICATION = 0x524F5332  # "ROS2": tells a ledger from another program's database

FIRST = """
    CREATE TABLE handed_in (
        id INTEGER PRIMARY KEY,
        student TEXT NOT NULL,
        assignment TEXT NOT NULL,
        submission TEXT NOT NULL,
        submitted TEXT,
        late INTEGER,
        path TEXT NOT NULL,
        first_seen TEXT NOT NULL,
        UNIQUE (student, assignment, submission)
    );

    -- a row is never changed and never deleted
    CREATE TABLE verdict (
        id INTEGER PRIMARY KEY,
        student TEXT NOT NULL,
        key TEXT NOT NULL,
        round INTEGER NOT NULL,
        assignment TEXT NOT NULL,
        submission TEXT NOT NULL,
        distro TEXT NOT NULL,
        score REAL NOT NULL,
        max_score REAL NOT NULL,
        report BLOB NOT NULL,
        marked TEXT NOT NULL,
        UNIQUE (student, key, round)
    );
    CREATE INDEX verdict_by_submission ON verdict (assignment, student, submission);

    -- what is to be marked again, and its earlier verdict
    CREATE TABLE regrade (
        student TEXT NOT NULL,
        key TEXT NOT NULL,
        before INTEGER NOT NULL REFERENCES verdict (id),
        asked TEXT NOT NULL,
        PRIMARY KEY (student, key)
    );

    CREATE TABLE fault (
        id INTEGER PRIMARY KEY,
        student TEXT NOT NULL,
        key TEXT NOT NULL,
        message TEXT NOT NULL,
        at TEXT NOT NULL
    );

    -- an instructor's corrections: the newest row of a student and check counts
    CREATE TABLE override (
        id INTEGER PRIMARY KEY,
        student TEXT NOT NULL,
        assignment TEXT NOT NULL,
        check_id TEXT NOT NULL,
        points REAL,
        because TEXT NOT NULL,
        by TEXT NOT NULL,
        at TEXT NOT NULL
    );

    -- the students of the class, and the words that identify them
    CREATE TABLE student (
        assignment TEXT NOT NULL,
        key TEXT NOT NULL,
        name TEXT NOT NULL,
        email TEXT NOT NULL,
        username TEXT NOT NULL,
        id_number TEXT NOT NULL,
        section TEXT NOT NULL,
        PRIMARY KEY (assignment, key)
    );

    CREATE TABLE fingerprint (
        submission TEXT PRIMARY KEY,
        value TEXT NOT NULL
    );

    CREATE TABLE setting (
        name TEXT PRIMARY KEY,
        value TEXT NOT NULL
    );
"""
CHAIN = """
    ALTER TABLE verdict ADD COLUMN evidence BLOB;

    -- of each verdict and each correction, in the order in which they were recorded
    CREATE TABLE link (
        id INTEGER PRIMARY KEY,
        place TEXT NOT NULL,
        row INTEGER NOT NULL,
        hash TEXT NOT NULL,
        signature BLOB,
        UNIQUE (place, row)
    );
"""
SALTED = """
    -- a link for each change of a row: `digest` is of a salt and of what the row then had
    CREATE TABLE new_link (
        id INTEGER PRIMARY KEY,
        place TEXT NOT NULL,
        row INTEGER NOT NULL,
        hash TEXT NOT NULL,
        signature BLOB,
        digest TEXT,
        salt BLOB
    );
    INSERT INTO new_link (id, place, row, hash, signature)
        SELECT id, place, row, hash, signature FROM link;
    DROP TABLE link;
    ALTER TABLE new_link RENAME TO link;
    CREATE INDEX link_by_row ON link (place, row);

    -- the other rows that get links, with ids that stay
    CREATE TABLE new_regrade (
        id INTEGER PRIMARY KEY,
        student TEXT NOT NULL,
        key TEXT NOT NULL,
        before INTEGER NOT NULL REFERENCES verdict (id),
        asked TEXT NOT NULL,
        UNIQUE (student, key)
    );
    INSERT INTO new_regrade (student, key, before, asked)
        SELECT student, key, before, asked FROM regrade ORDER BY rowid;
    DROP TABLE regrade;
    ALTER TABLE new_regrade RENAME TO regrade;

    CREATE TABLE new_student (
        id INTEGER PRIMARY KEY,
        assignment TEXT NOT NULL,
        key TEXT NOT NULL,
        name TEXT NOT NULL,
        email TEXT NOT NULL,
        username TEXT NOT NULL,
        id_number TEXT NOT NULL,
        section TEXT NOT NULL,
        UNIQUE (assignment, key)
    );
    INSERT INTO new_student (assignment, key, name, email, username, id_number, section)
        SELECT assignment, key, name, email, username, id_number, section
        FROM student ORDER BY rowid;
    DROP TABLE student;
    ALTER TABLE new_student RENAME TO student;

    CREATE TABLE new_setting (
        id INTEGER PRIMARY KEY,
        name TEXT NOT NULL UNIQUE,
        value TEXT NOT NULL
    );
    INSERT INTO new_setting (name, value) SELECT name, value FROM setting ORDER BY rowid;
    DROP TABLE setting;
    ALTER TABLE new_setting RENAME TO setting;
"""


REMARKS = """
    -- what an instructor wrote to a student: the one row of an assignment
    CREATE TABLE IF NOT EXISTS remark (
        id INTEGER PRIMARY KEY,
        student TEXT NOT NULL,
        assignment TEXT NOT NULL,
        submission TEXT NOT NULL,
        text TEXT NOT NULL,
        by TEXT NOT NULL,
        at TEXT NOT NULL,
        UNIQUE (student, assignment)
    );
"""


def _add(table: str, **columns: str) -> Callable[[sqlite3.Connection], None]:
    """Return what adds columns to a table, unless they are there."""

    def add(connection: sqlite3.Connection) -> None:
        known = {row[1] for row in connection.execute(f"PRAGMA table_info({table})")}
        for name, kind in columns.items():
            if name not in known:
                connection.execute(f"ALTER TABLE {table} ADD COLUMN {name} {kind}")

    return add


# the tables of a step, and what is done with the rows that are there
STEPS: tuple[tuple[str, Callable[[sqlite3.Connection], None] | None], ...] = (
    (FIRST, None),
    (CHAIN, None),
    # the verdict that a correction is of: 0 if there was none, NULL in a row of an earlier grader
    ("", _add("override", verdict="INTEGER")),
    # what the system says of lateness
    ("", _add("handed_in", late_seconds="REAL", extension="TEXT")),
    (SALTED, ledger_chain.adopt),
    (REMARKS, None),
)


class PlantedError(sqlite3.DatabaseError):
    """A ledger has a trigger or a view, which no grader makes: it would run with our own rights."""


def must_have_no_programs(connection: sqlite3.Connection) -> None:
    """Raise PlantedError if the database has anything that runs when a row is read or changed."""
    query = "SELECT type, name FROM sqlite_master WHERE type NOT IN ('table', 'index')"
    found = connection.execute(query).fetchall()
    if found:
        kind, name = found[0]
        raise PlantedError(f"it has a {kind} '{name}', which no grader made")


def schema_faults(connection: sqlite3.Connection) -> list[str]:
    """Return how the tables and indexes differ from those of a new ledger."""
    new = sqlite3.connect(":memory:", isolation_level=None)
    bring_up_to_date(new)
    ours, theirs = _schema(new), _schema(connection)
    new.close()
    faults = [f"{name} is missing" for name in ours if name not in theirs]
    for name, text in theirs.items():
        if name not in ours:
            faults.append(f"{name} is not of a grader")
        elif text != ours[name]:
            faults.append(f"{name} was changed")
    return faults


def _schema(connection: sqlite3.Connection) -> dict[str, str]:
    """Return the statement that made each part of a database, without its white space."""
    query = "SELECT type, name, coalesce(sql, '') FROM sqlite_master WHERE name NOT GLOB 'sqlite_*'"
    rows = connection.execute(query).fetchall()
    return {f"{kind} '{name}'": " ".join(sql.replace('"', "").split()) for kind, name, sql in rows}


def bring_up_to_date(connection: sqlite3.Connection) -> bool:
    """Take the missing steps, each in one transaction; return False for a newer grader's ledger.

    Raises sqlite3.DatabaseError if the file is not a ledger.
    """
    (version,) = connection.execute("PRAGMA user_version").fetchone()
    (application,) = connection.execute("PRAGMA application_id").fetchone()
    (known,) = connection.execute("SELECT count(*) FROM sqlite_master").fetchone()
    if known and application != APPLICATION:
        raise sqlite3.DatabaseError("it is the database of another program")
    if version > len(STEPS):
        return False
    for number, (tables, fill) in enumerate(STEPS[version:], start=version + 1):
        try:
            connection.executescript(f"BEGIN IMMEDIATE; {tables}")
            if fill is not None:
                fill(connection)
            connection.execute(f"PRAGMA application_id = {APPLICATION}")
            connection.execute(f"PRAGMA user_version = {number}")
        except BaseException:
            if connection.in_transaction:
                connection.execute("ROLLBACK")
            raise
        connection.execute("COMMIT")
    return True
