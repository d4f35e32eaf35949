"""A gradebook that can be shown to others tells nothing about who is who."""

from __future__ import annotations

import csv
import dataclasses
import io
from pathlib import Path

from grader.batch.ledger import Ledger
from grader.batch.model import ClassResult
from grader.publish.pseudonyms import gradebook, pseudonym_list, pseudonyms


def test_no_name_address_number_time_or_text_is_left(mixed: ClassResult, tmp_path: Path) -> None:
    with Ledger(tmp_path / "ledger.sqlite") as ledger:
        names = pseudonyms(mixed, ledger)
        assert pseudonyms(mixed, ledger) == names, "the same in each run"
    with Ledger(tmp_path / "other.sqlite") as other:
        assert not set(pseudonyms(mixed, other).values()) & set(names.values())
    assert len(set(names.values())) == len(mixed.entries)
    text = gradebook(mixed, names).decode("utf-8-sig")
    for entry in mixed.entries:
        student = entry.student
        secrets = (student.key, student.name, student.email, student.username, student.id_number)
        assert not [word for word in secrets if word and f'"{word}"' in text]
        assert student.name not in text
    assert "2026-11" not in text
    assert "M. Curie" not in text, "nor the instructor's words"
    rows = list(csv.DictReader(io.StringIO(text, newline="")))
    finals = sorted(row["final"] for row in rows if row["final"])
    wanted = [e.final for e in mixed.entries if e.final is not None]
    assert sorted(map(float, finals)) == sorted(wanted)
    assert [row["key"] for row in rows] == sorted(names.values()), "not in the order of the class"
    own = list(csv.DictReader(io.StringIO(pseudonym_list(mixed, names).decode("utf-8-sig"))))
    assert {row["key"]: row["pseudonym"] for row in own} == names


def test_the_order_of_the_class_changes_nothing(mixed: ClassResult, tmp_path: Path) -> None:
    turned = dataclasses.replace(mixed, entries=tuple(reversed(mixed.entries)))
    with Ledger(tmp_path / "ledger.sqlite") as ledger:
        assert pseudonyms(turned, ledger) == pseudonyms(mixed, ledger)
        names = pseudonyms(mixed, ledger)
    assert len(gradebook(turned, names)) == len(gradebook(mixed, names))
