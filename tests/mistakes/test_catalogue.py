"""The catalogue is complete: every mistake that is named anywhere has a readable entry."""

from __future__ import annotations

import ast
import string
from importlib import import_module
from pathlib import Path
from pkgutil import iter_modules
from urllib.parse import urlsplit

import pytest

from grader import mistakes
from grader.base.i18n.message import Message
from grader.base.i18n.translator import Translator
from grader.course.shorthands import SHORTHANDS
from grader.mistakes.catalogue import CATALOGUE, RANK
from grader.mistakes.kind import Kind
from grader.mistakes.links import address
from grader.mistakes.recognise import SYMPTOMS
from grader.ros.distro import distros
from grader.verdict.checks.all import CHECKS
from tests.corpus.broken import BROKEN
from tests.corpus.hostile import HOSTILE
from tests.mistakes.filled import filled

ROOT = Path(__file__).resolve().parents[2]
HOSTS = (
    *("docs.ros.org", "design.ros2.org", "www.ros.org", "docs.python.org"),
    *("setuptools.pypa.io", "colcon.readthedocs.io"),
)


def entries() -> list[object]:
    return [pytest.param(kind, id=kind.id) for kind in CATALOGUE.values()]


def named_in_the_code() -> set[str]:
    """Return every mistake id in the source of checks, intake and recognisers."""
    prefixes = {kind.partition(".")[0] for kind in CATALOGUE}
    files = {"setup.py", "setup.cfg", "setup.bash", "package.xml"}
    named: set[str] = set()
    for folder in ("grader/verdict/checks", "grader/package/intake", "grader/mistakes"):
        for path in (ROOT / folder).glob("*.py"):
            for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
                if isinstance(node, ast.Call) and node.args:
                    called = ast.unparse(node.func).rpartition(".")[2]
                    first = node.args[0]
                    if isinstance(first, ast.Constant) and isinstance(first.value, str):
                        slug = first.value
                        if called in ("finding", "always"):
                            named.add(f"node.{slug}")
                        elif called in ("Failed", "Problem", "_failed"):
                            named.add(slug)
                if isinstance(node, ast.Constant) and isinstance(node.value, str):
                    head, dot, slug = node.value.partition(".")
                    if head in prefixes and dot and slug.isidentifier():
                        named.add(node.value)
    return named - files - {*CHECKS, *SHORTHANDS}


def test_every_mistake_that_the_code_names_has_an_entry() -> None:
    named = named_in_the_code()
    assert len(named) > 150
    assert named - set(CATALOGUE) == set()


def test_each_record_of_each_module_is_in_the_catalogue_once() -> None:
    modules = [
        import_module(f"{mistakes.__name__}.{m.name}") for m in iter_modules(mistakes.__path__)
    ]
    records = [k for m in modules for k in getattr(m, "KINDS", ()) if isinstance(k, Kind)]
    assert sorted(kind.id for kind in records) == sorted(CATALOGUE)


def test_every_mistake_of_the_corpus_has_an_entry() -> None:
    expected = {m for p in (*BROKEN, *HOSTILE) for m in p.expect_failed.values() if m}
    assert expected - set(CATALOGUE) == set()


def test_there_are_many_kinds_over_all_stages() -> None:
    stages = {kind.stage for kind in CATALOGUE.values()}
    assert len(CATALOGUE) >= 60
    assert stages >= {"manifest", "marker", "setup.cfg", "entry point", "file", "exec bit"}
    assert stages >= {"first line", "build", "start", "class", "timer", "callback"}
    assert stages >= {"counter", "text", "logger", "spin", "shutdown"}


@pytest.mark.parametrize("kind", entries())
def test_an_entry_can_be_read_in_every_language(kind: Kind) -> None:
    for lang in ("en", "ko"):
        translate = Translator(lang)
        assert translate(kind.rationale(filled(kind.why, {}))).strip()
        assert translate(kind.fix_text(filled(kind.fix, {}))).strip()
        for variant, fix in kind.fixes.items():
            assert translate(kind.fix_text(filled(fix, {}), variant)).strip()
        for variant, why in kind.whys.items():
            assert translate(kind.rationale(filled(why, {}), variant)).strip()
    assert kind.title.strip()
    assert not [field for _, field, _, _ in string.Formatter().parse(kind.title) if field]


def test_titles_are_plain_text() -> None:
    """A backtick is markup only where a page renders it."""
    titles = [kind.title for kind in CATALOGUE.values()]
    titles += [str(check.title) for check in CHECKS.values()]
    for lang in ("en", "ko"):
        translate = Translator(lang)
        shown = [translate(Message(title, filled(title, {}))) for title in titles]
        assert [title for title in shown if "`" in title] == []


@pytest.mark.parametrize("kind", entries())
def test_an_entry_links_to_the_documentation(kind: Kind) -> None:
    for distro in distros().values():
        parts = urlsplit(address(kind.link, distro))
        assert parts.scheme == "https"
        assert parts.hostname in HOSTS
        of_a_release = parts.hostname == "docs.ros.org"
        assert not of_a_release or parts.path.startswith(f"/en/{distro.name}/")


def test_a_cause_comes_before_what_it_causes() -> None:
    for symptom in SYMPTOMS:
        for name, rank in RANK.items():
            if name.startswith(("node.", "setup.", "source.", "package.")):
                assert rank < RANK[symptom]
