"""The text of a fix says what its change does, in each language."""

from __future__ import annotations

import pytest

from grader.base.i18n.message import Message
from grader.base.i18n.translator import Translator
from grader.mistakes.catalogue import CATALOGUE
from grader.package.edit.files import Files
from grader.report.model import CheckResult, Mistake, Where
from grader.verdict.fix_text import matching_text

PATH = "a/node.py"
OLD = "class A:\n    def f(self):\n        self.x = self.y = 0\n        self.log()\n"
LINE = "        self.x = self.y = 0\n"
KINDS: tuple[tuple[str, str, dict[str, str]], ...] = (("node.exits", "", {}),)


def told(kind: str, variant: str, words: dict[str, str], new: str, lang: str) -> tuple[str, str]:
    """Return the text of the kind, and the text that fits the change."""
    translate = Translator(lang)
    fix = translate(CATALOGUE[kind].fix_text(words, variant))
    result = CheckResult(
        id="run.output",
        title="",
        status="failed",
        score=0,
        max_score=10,
        fix=fix,
        mistakes=[Mistake(id=kind)],
        where=Where(file=PATH, line=3),
    )
    files = [Files({}).with_data(PATH, text.encode()) for text in (OLD, new)]
    return fix, matching_text(result, files[0], files[1], translate)


@pytest.mark.parametrize("lang", ["en", "ko"])
@pytest.mark.parametrize(("kind", "variant", "words"), KINDS)
def test_delete_this_line_is_said_only_of_a_line_that_the_change_deletes(
    kind: str, variant: str, words: dict[str, str], lang: str
) -> None:
    instead = Message(
        "Write {written} instead of {name}.",
        {"written": "self.y = 0", "name": "self.x = self.y = 0"},
    )
    below = Message("Make the change below.")
    for new, wanted in (
        (OLD.replace(LINE, ""), None),
        (OLD.replace(LINE, "        pass\n"), None),
        (OLD.replace(LINE, "        self.y = 0\n"), instead),
        (OLD.replace("self.log()", "self.log(1)"), below),
        # the line above it is rewritten, as where async def becomes def and the await goes
        (OLD.replace("    def f(self):\n" + LINE, "    def f(self, more):\n"), None),
        (OLD.replace(LINE, "        self.y = 0\n        self.z = 0\n"), below),
    ):
        text, fits = told(kind, variant, words, new, lang)
        assert fits == (text if wanted is None else Translator(lang)(wanted))


def test_a_text_that_deletes_no_line_stays() -> None:
    words = {"name": "a", "written": "b"}
    fix, fits = told(
        "node.small_change", "", words, OLD.replace(LINE, "        self.y = 0\n"), "en"
    )
    assert fits == fix
