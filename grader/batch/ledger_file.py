"""The file of a ledger: one process at a time, changed in transactions only.

SQLite in WAL mode, synchronised to the disk at each commit (https://sqlite.org/pragma.html).
"""

from __future__ import annotations

import contextlib
import os
import sqlite3
from collections.abc import Iterable, Iterator
from pathlib import Path
from types import TracebackType
from typing import Any

from grader.base.errors import SurroundingsError, UsageError
from grader.base.lock import HeldError, take_lock
from grader.batch.ledger_schema import PlantedError, bring_up_to_date, must_have_no_programs

BUSY_SECONDS = 20.0
OWNER_ONLY = 0o600


def _text(found: bytes) -> str:
    """Return a text of a row: whoever changed a ledger need not have written UTF-8."""
    return found.decode(errors="surrogateescape")


class PlantedInError(SurroundingsError):
    """A ledger has a trigger or a view."""


class LedgerFile:
    """An open ledger file; use it as a context manager."""

    def __init__(self, path: Path, *, makes: bool = True) -> None:
        """Open the ledger at `path`; create it if it does not exist and `makes` is True.

        Raises UsageError if another process has it open, if a newer grader wrote it, or if it does
        not exist and `makes` is False; SurroundingsError if it cannot be opened or is not a ledger.
        Nothing is changed in these cases.
        """
        self.path = path
        self._lock = -1
        if not makes and not path.is_file():
            raise UsageError(f"there is no ledger at {path}", remedy="Mark a class first.")
        try:
            path.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
            self._take_lock()
            self._connection = self._open()
        except OSError as error:
            self._release()
            raise SurroundingsError(
                f"the ledger {path} cannot be opened: {error.strerror}",
                remedy="Name another one with --ledger, or another folder with --out.",
            ) from error
        except BaseException:
            self._release()
            raise

    def __enter__(self) -> LedgerFile:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.close()

    def close(self) -> None:
        """Close the ledger and release its lock."""
        self._connection.close()
        self._release()

    def _take_lock(self) -> None:
        """Lock a file beside the ledger; the kernel releases the lock if this process is killed."""
        try:
            self._lock = take_lock(Path(f"{self.path}.lock"), waits=False)
        except HeldError:
            raise UsageError(
                f"another grader has the ledger {self.path} open",
                remedy="Wait until it is done, or name another ledger with --ledger.",
            ) from None

    def _release(self) -> None:
        if self._lock >= 0:
            os.close(self._lock)
            self._lock = -1

    def _open(self) -> sqlite3.Connection:
        os.close(os.open(self.path, os.O_RDWR | os.O_CREAT | os.O_CLOEXEC, OWNER_ONLY))
        connection = sqlite3.connect(self.path, timeout=BUSY_SECONDS, isolation_level=None)
        connection.text_factory = _text
        try:
            with self._readable_errors():
                must_have_no_programs(connection)
                connection.execute("PRAGMA journal_mode = WAL").fetchone()
                connection.execute("PRAGMA synchronous = FULL")
                connection.execute("PRAGMA foreign_keys = ON")
                known = bring_up_to_date(connection)
            if not known:
                raise UsageError(
                    f"the ledger {self.path} was written by a newer grader",
                    remedy="Use that grader, or name another ledger with --ledger.",
                )
        except BaseException:
            connection.close()
            raise
        return connection

    @contextlib.contextmanager
    def _readable_errors(self) -> Iterator[None]:
        """Raise SurroundingsError, with a remedy, instead of SQLite's own errors."""
        try:
            yield
        except sqlite3.IntegrityError:
            raise
        except PlantedError as error:
            raise PlantedInError(
                f"the ledger {self.path} is not as a grader made it: {error}",
                remedy="Nothing was changed. Find out who did this; go on with a copy from before.",
            ) from error
        except sqlite3.DatabaseError as error:
            raise SurroundingsError(
                f"the ledger {self.path} cannot be used: {error}",
                remedy="Nothing in it was changed. If it is damaged, `sqlite3 FILE .recover` "
                "saves what is left; or move it away and mark again.",
            ) from error

    @contextlib.contextmanager
    def write(self) -> Iterator[sqlite3.Connection]:
        """Open a transaction: at its end all of it is on the disk, or nothing."""
        with self._readable_errors():
            self._connection.execute("BEGIN IMMEDIATE")
            try:
                yield self._connection
            except BaseException:
                self._connection.execute("ROLLBACK")
                raise
            self._connection.execute("COMMIT")

    def compact(self) -> None:
        """Write the file anew without what was removed: no page of it is left, nor in the log."""
        with self._readable_errors():
            self._connection.execute("VACUUM")
            self._connection.execute("PRAGMA wal_checkpoint(TRUNCATE)").fetchall()

    def rows(self, sql: str, values: Iterable[object] = ()) -> list[Any]:
        """Return the rows of a query."""
        with self._readable_errors():
            return self._connection.execute(sql, tuple(values)).fetchall()
