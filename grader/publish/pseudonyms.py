"""A gradebook that can be shown to others: no name, address, number, time or text of a student.

A pseudonym is the same in each run of one ledger, and nobody can work it out from the name: it is
keyed (HMAC-SHA-256) with random bytes that stay in the ledger.
"""

from __future__ import annotations

import csv
import hmac
import io
import secrets
from collections.abc import Mapping
from dataclasses import replace

from grader.batch import cells
from grader.batch.ledger import Ledger
from grader.batch.model import ClassResult, Student
from grader.publish.gradebook_csv import gradebook_csv

FOLDER, LIST = "pseudonyms", "pseudonyms.csv"
KEY = "key of the pseudonyms"
KEY_BYTES, DIGITS = 16, 8
LEFT_OUT = ("name", "email", "username", "id_number", "submitted", "due", "notes")


def pseudonyms(result: ClassResult, ledger: Ledger) -> dict[str, str]:
    """Return the pseudonym of each student, by key; no two are the same."""
    key = ledger.setting(KEY)
    if not key:
        key = secrets.token_hex(KEY_BYTES)
        ledger.note(KEY, key)
    found: dict[str, str] = {}
    taken: set[str] = set()
    for entry in result.entries:
        own = entry.student.key
        digest = hmac.digest(
            bytes.fromhex(key), own.encode("utf-8", "surrogatepass"), "sha256"
        ).hex()
        digits = next(n for n in range(DIGITS, len(digest) + 1) if digest[:n] not in taken)
        taken.add(digest[:digits])
        found[own] = f"student-{digest[:digits]}"
    return found


def gradebook(result: ClassResult, names: Mapping[str, str]) -> bytes:
    """Return the gradebook with pseudonyms, sorted by them: the order of the class tells nothing."""
    entries = [
        replace(
            entry,
            student=Student(names[entry.student.key], "", section=entry.student.section),
            same_as=(),
        )
        for entry in result.entries
    ]
    entries.sort(key=lambda entry: entry.student.key)
    rows = csv.reader(io.StringIO(gradebook_csv(replace(result, entries=tuple(entries))).decode()))
    header = next(rows)
    kept = [n for n, name in enumerate(header) if name not in LEFT_OUT]
    out = io.StringIO()
    table = csv.writer(out, quoting=csv.QUOTE_ALL)
    table.writerows([row[n] for n in kept] for row in [header, *rows])
    return out.getvalue().encode("utf-8-sig")


def pseudonym_list(result: ClassResult, names: Mapping[str, str]) -> bytes:
    """Return whose pseudonym is which: for the instructor only."""
    out = io.StringIO()
    table = csv.writer(out, quoting=csv.QUOTE_ALL)
    table.writerow(("key", "name", "pseudonym"))
    for entry in result.entries:
        who = (entry.student.key, entry.student.name)
        table.writerow([*(cells.text(word) for word in who), names[entry.student.key]])
    return out.getvalue().encode("utf-8-sig")
