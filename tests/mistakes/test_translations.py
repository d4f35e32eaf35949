"""Every text has a Korean translation with the same placeholders, and it is compiled."""

from __future__ import annotations

import ast
import re
import string
from collections.abc import Iterator
from pathlib import Path

import click
import pytest
from babel.messages.catalog import Catalog
from babel.messages.extract import extract_from_file
from click.testing import CliRunner

from grader.base.errors import UsageError
from grader.base.i18n.translator import LANGUAGES
from grader.cli import update_translations as update
from grader.cli.localized import CLICK, CLICK_PLURALS
from tests.processes import ROOT

OTHERS = [lang for lang in LANGUAGES if lang != "en"]
# texts to be typed or written literally, and texts of placeholders only
CODE = (
    "'{entry}': {because}",
    "[develop] script_dir={wanted} and [install] install_scripts={wanted}",
    "What {title}:",
    "{low} to {high}",
)


def placeholders(template: str) -> list[str]:
    return sorted(name for _, name, _, _ in string.Formatter().parse(template) if name is not None)


@pytest.mark.parametrize("lang", OTHERS)
def test_every_text_is_translated_with_the_same_placeholders(lang: str) -> None:
    catalog = update.read(lang)
    for template, place in update.templates():
        message = catalog.get(template)
        assert message is not None, (
            f"{place}: {template!r}: run python -m grader.cli.update_translations"
        )
        assert message.string, f"{place}: {template!r} has no translation"
        assert placeholders(str(message.string)) == placeholders(template), template
    for (one, many), _ in update.plurals():
        message = catalog.get(one)
        assert message is not None, one
        forms = tuple(message.string or ())
        # both forms are filled with the same values
        known = {*placeholders(one), *placeholders(many)}
        assert all(form and set(placeholders(form)) <= known for form in forms), one
        if "count" in placeholders(many):
            assert "count" in placeholders(forms[-1]), many


def marked() -> Iterator[str]:
    """Yield every text marked in the source, found in Python's syntax tree (Babel reads tokens)."""
    for path in sorted(path for name in update.FOLDERS for path in (ROOT / name).rglob("*.py")):
        source = path.read_text(encoding="utf-8")
        if update.MARKS not in source:
            continue
        for node in ast.walk(ast.parse(source)):
            if isinstance(node, ast.Call) and isinstance(node.func, ast.Name):
                first = node.args[0] if node.args else None
                if node.func.id in update.KEYWORDS and isinstance(first, ast.Constant):
                    yield str(first.value)


def test_every_marked_text_is_extracted() -> None:
    """Babel misses one inside an f-string or inside another marked text."""
    gathered = {template for template, _ in update.templates()}
    assert set(marked()) - gathered == set()


def test_the_texts_of_every_package_that_students_read_are_extracted() -> None:
    parts = ("publish", "cli", "verdict", "mistakes", "batch", "sandbox", "ros")
    folders = {place.rpartition("/")[0] for _, place in update.templates()}
    read = {folder.split("/")[1] if "/" in folder else folder for folder in folders}
    assert {*parts, "lab"} <= read


def test_korean_texts_are_korean() -> None:
    for message in update.read("ko"):
        if message.id and message.id not in CODE:
            assert re.search("[가-힣]", str(message.string)), message.id


def test_the_translated_texts_of_click_are_still_those_of_click() -> None:
    """A new version of click may change its texts, which would leave them untranslated."""
    folder = Path(click.__file__).parent
    keywords: dict[str, tuple[int, ...] | None] = {"_": None, "ngettext": (1, 2)}
    output = {
        found
        for path in folder.glob("*.py")
        for _, found, _, _ in extract_from_file("python", path, keywords=keywords)
    }
    assert {*CLICK, *CLICK_PLURALS} <= output


def test_korean_sentences_are_in_the_formal_polite_style() -> None:
    plain = re.compile(r"(?<![니마])다(?:[.)]|$)|(?:하라|해라|[하세되]요)(?:[.)]|$)")
    for message in update.read("ko"):
        assert not plain.search(str(message.string)), message.string


@pytest.mark.parametrize("lang", OTHERS)
def test_the_committed_translations_are_what_the_command_writes(lang: str) -> None:
    path = update.po_path(lang)
    catalog = update.collect(lang)
    again = "run python -m grader.cli.update_translations"
    assert path.read_bytes() == update.po_bytes(catalog), again
    assert path.with_suffix(".mo").read_bytes() == update.mo_bytes(catalog), again


def test_there_are_no_obsolete_translations() -> None:
    known = {template for template, _ in update.templates()}
    pairs = {pair for pair, _ in update.plurals()}
    assert {m.id for m in update.read("ko") if m.id} == known | pairs


def test_a_renamed_text_keeps_its_translation(monkeypatch: pytest.MonkeyPatch) -> None:
    known = Catalog(locale="ko")
    known.add("Delete the line.", "그 줄을 고치십시오.")
    monkeypatch.setattr(update, "read", lambda lang: known)
    monkeypatch.setattr(update, "templates", lambda: iter([("Fix the line.", "grader/a.py")]))
    kept = update.collect("ko", {"Delete the line.": "Fix the line."}).get("Fix the line.")
    assert kept is not None
    assert kept.string == "그 줄을 고치십시오."


@pytest.mark.parametrize(
    ("renamed", "reason"),
    [
        ({"Delete the line.": "Fix that line."}, "'Fix that line.' is not marked"),
        ({"Fix the line.": "Fix the line."}, "'Fix the line.' is still marked"),
    ],
)
def test_a_map_of_renamed_texts_that_does_not_match_the_source_is_refused(
    renamed: dict[str, str], reason: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(update, "templates", lambda: iter([("Fix the line.", "grader/a.py")]))
    with pytest.raises(UsageError, match=reason):
        update.collect("ko", renamed)


def test_a_text_with_a_count_that_has_no_translation_is_counted(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    known = Catalog(locale="ko")
    known.add("Fix the line.", "그 줄을 고치십시오.")
    known.add(("1 line", "{count} lines"), ("{count}줄",))
    pairs = [("1 line", "{count} lines"), ("1 check", "{count} checks")]
    monkeypatch.setattr(update, "FOLDER", tmp_path)
    monkeypatch.setattr(update, "read", lambda lang: known)
    monkeypatch.setattr(update, "templates", lambda: iter([("Fix the line.", "grader/a.py")]))
    monkeypatch.setattr(update, "plurals", lambda: iter([(pair, "grader/a.py") for pair in pairs]))
    done = CliRunner().invoke(update.main, [])
    assert done.output == (
        "ko: 3 texts, 1 of them not translated (2 were translated before, 0 renamed)\n"
    )
