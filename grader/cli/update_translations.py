"""Collects all texts and compiles the translations: `python -m grader.cli.update_translations`.

It needs Babel, which is part of the tests' environment; the grader itself needs only the compiled
files. New texts get an empty translation: fill it in in `<lang>/LC_MESSAGES/grader.po` and run the
command again.

A translation is found by its English text. `--renamed FILE` keeps it if that text changes: FILE is
a JSON object of old texts and new ones.
"""

from __future__ import annotations

import io
import json
from collections.abc import Collection, Iterator, Mapping
from datetime import datetime, timezone
from functools import cache
from pathlib import Path

import click
from babel.messages.catalog import Catalog, Message
from babel.messages.extract import extract_from_file
from babel.messages.mofile import write_mo
from babel.messages.pofile import read_po, write_po

from grader.base.errors import UsageError
from grader.base.i18n.translator import DOMAIN, FOLDER, LANGUAGES, SOURCE
from grader.base.project import CHECKOUT
from grader.cli.localized import CLICK_PLURALS
from grader.verdict.checks.all import CHECKS

FOLDERS = ("grader", "lab")  # (the lab has no .po files of its own)
KEYWORDS = {"say": None, "msg": None}
WITH_PLURALS = {**KEYWORDS, "say_plural": (1, 2)}
TEMPLATE = "jinja2.ext:babel_extract"
MARKS = "from grader.base.i18n.message import "
CLICK_PLACE = "grader/cli/localized.py"
MADE = datetime(
    2026, 1, 1, tzinfo=timezone.utc
)  # constant, so that the files change only if a text changes


def templates() -> Iterator[tuple[str, str]]:
    """Yield every text that is marked for translation, and its file."""
    for found, place in _marked():
        if isinstance(found, str):
            yield found, place
    for check in CHECKS.values():
        yield check.title, f"{check.function.__module__.replace('.', '/')}.py"


def plurals() -> Iterator[tuple[tuple[str, str], str]]:
    """Yield every text with a plural form (its texts for 1 and for other counts), and its file."""
    for found, place in _marked():
        if not isinstance(found, str):
            one, many = found
            yield (one, many), place
    for pair in CLICK_PLURALS:
        yield pair, CLICK_PLACE


@cache
def _marked() -> list[tuple[str | tuple[str, ...], str]]:
    """Return the texts that the sources mark (those for 1 and for other counts), and their file."""
    strict = {"silent": "false"}  # (a template that cannot be parsed is an error)
    pages = sorted((CHECKOUT / "grader/publish/pages/templates").glob("*.j2"))
    return [
        (found, _place(path))
        for form, paths in (("python", _sources()), (TEMPLATE, pages))
        for path in paths
        for _, found, _, _ in extract_from_file(
            form, path, keywords=WITH_PLURALS, options=strict if form == TEMPLATE else None
        )
    ]


def _sources() -> Iterator[Path]:
    """Yield the files that can mark texts; another may have a function of such a name."""
    for path in sorted(path for folder in FOLDERS for path in (CHECKOUT / folder).rglob("*.py")):
        if MARKS in path.read_text(encoding="utf-8"):
            yield path


def _place(path: Path) -> str:
    return path.relative_to(CHECKOUT).as_posix()


def po_path(lang: str) -> Path:
    """Return the file with a language's translations."""
    return FOLDER / lang / "LC_MESSAGES" / f"{DOMAIN}.po"


def read(lang: str) -> Catalog:
    """Return a language's translations; empty if there are none yet."""
    path = po_path(lang)
    if not path.is_file():
        return Catalog(locale=lang)
    with path.open("rb") as file:
        return read_po(file, locale=lang, domain=DOMAIN)


def collect(lang: str, renamed: Mapping[str, str] | None = None) -> Catalog:
    """Return a language's catalogue of all current texts, with the known translations.

    `renamed` maps old texts to new ones, which keep the translation. Raises UsageError for a new
    text that is not marked in the source, or an old one that still is.
    """
    known = read(lang)
    before = _before(renamed or {}, {template for template, _ in templates()})
    catalog = Catalog(
        locale=lang,
        domain=DOMAIN,
        project="ros2_teaching_lab",
        header_comment="# Texts of the grader that students read. See grader/cli/update_translations.py.",
        creation_date=MADE,
        revision_date=MADE,
    )
    for template, place in templates():
        message = known.get(template) or known.get(before.get(template, template))
        catalog.add(template, message.string if message else "", locations=[(place, 0)])
    for pair, place in plurals():
        message = known.get(pair)
        forms = message.string if message and message.pluralizable else ("",)
        catalog.add(pair, forms, locations=[(place, 0)])
    return catalog


def _before(renamed: Mapping[str, str], marked: Collection[str]) -> dict[str, str]:
    """Return the old text of each new text."""
    unknown = [new for new in renamed.values() if new not in marked]
    still = [old for old in renamed if old in marked]
    if unknown or still:
        raise UsageError(
            "the map of renamed texts does not match the source: "
            + "; ".join(
                [f"{text!r} is not marked" for text in unknown]
                + [f"{text!r} is still marked" for text in still]
            )
        )
    return {new: old for old, new in renamed.items()}


def is_translated(message: Message) -> bool:
    """Whether a text, and each form of one with a count, has a translation."""
    text = message.string
    return bool(text) and (isinstance(text, str) or all(text or ()))


def po_bytes(catalog: Catalog) -> bytes:
    """Return the text of a .po file."""
    out = io.BytesIO()
    write_po(out, catalog, width=100, sort_output=False, include_lineno=False)
    return out.getvalue()


def mo_bytes(catalog: Catalog) -> bytes:
    """Return a compiled catalogue."""
    out = io.BytesIO()
    write_mo(out, catalog)
    return out.getvalue()


@click.command()
@click.option(
    "--renamed",
    type=click.Path(path_type=Path, exists=True, dir_okay=False),
    help="A JSON object with the old and the new English text of each changed text.",
)
def main(renamed: Path | None) -> None:
    """Write the .po and .mo files of every language."""
    texts: dict[str, str] = json.loads(renamed.read_text(encoding="utf-8")) if renamed else {}
    for lang in LANGUAGES:
        if lang == SOURCE:
            continue
        before = sum(is_translated(message) for message in read(lang) if message.id)
        catalog = collect(lang, texts)
        path = po_path(lang)
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(po_bytes(catalog))
        path.with_suffix(".mo").write_bytes(mo_bytes(catalog))
        left = sum(not is_translated(message) for message in catalog if message.id)
        print(
            f"{lang}: {len(catalog)} texts, {left} of them not translated "
            f"({before} were translated before, {len(texts)} renamed)"
        )


if __name__ == "__main__":
    main()
