"""Characters that do not show, and line ends in a text, are named with what to type."""

from __future__ import annotations

from pathlib import Path

import pytest

from grader.mistakes.recognise import behind_symptom
from grader.mistakes.recognised import RecognisedMistake, Suspect
from tests.marking import ASSIGNMENT
from tests.mistakes.test_from_source import node_in
from tests.mistakes.test_named_exactly import changed, fix_of, patched, why_of

HEAD = "'Hello time: '"
TEXT = f"{HEAD} + str(self.counter_)"


def found_in(new: str) -> RecognisedMistake | None:
    came = str(eval(new.replace("self.counter_", "0")))
    return behind_symptom(
        "run.wrong_text", Suspect(node_in(changed((TEXT, new))), ASSIGNMENT, came)
    )


@pytest.mark.parametrize(
    ("head", "name", "said"),
    [
        ("Hello\u00a0time: ", "U+00A0 NO-BREAK SPACE", "the space between Hello and time: in"),
        ("Hello time:\u00a0", "U+00A0 NO-BREAK SPACE", "the space between time: and the number in"),
        ("Hello\u3000time: ", "U+3000 IDEOGRAPHIC SPACE", "the space between Hello and time:"),
        ("Hello \u200btime: ", "U+200B ZERO WIDTH SPACE", "what is between Hello and time: in"),
        ("\ufeffHello time: ", "U+FEFF", "between the quotes and Hello"),
        ("Hello time\uff1a ", "U+FF1A FULLWIDTH COLON", "the word time\uff1a in"),
        ("H\u0435llo time: ", "U+0435 CYRILLIC SMALL LETTER IE", "with the e of the keyboard"),
        ("Hello\u00a0time:\u00a0", "U+00A0", "type it again, not copied: 'Hello time: '"),
    ],
)
@pytest.mark.parametrize("form", ["'{}' + str(self.counter_)", "f'{}{{self.counter_}}'"])
def test_the_character_and_its_place_are_named(
    head: str, name: str, said: str, form: str, tmp_path: Path
) -> None:
    text = changed((TEXT, form.format(head)))
    found = found_in(form.format(head))
    assert found is not None
    assert found.kind == "node.odd_character"
    assert name in why_of(found)
    assert said in fix_of(found).replace("again, not copied: f'Hello time: {self.counter_}'", said)
    assert patched(found, text, tmp_path) == changed((TEXT, form.format("Hello time: ")))


@pytest.mark.parametrize(
    ("new", "form", "said"),
    [
        ("'Hello time: %d\\n' % self.counter_", "\\n", "Write 'Hello time: %d' instead"),
        (TEXT + " + '\\n'", "\\n", "Write '' instead of '\\n'."),
    ],
)
def test_a_text_without_line_ends_is_written(
    new: str, form: str, said: str, tmp_path: Path
) -> None:
    found = found_in(new)
    assert found is not None
    assert found.kind == "node.line_end_in_text"
    assert form in why_of(found)
    assert said in fix_of(found)
    assert (
        "\\n" not in patched(found, changed((TEXT, new)), tmp_path).split("info(")[1].split("\n")[0]
    )


@pytest.mark.parametrize(
    "new",
    ["'Hello  time: ' + str(self.counter_)", "'H\u00e9llo time: ' + str(self.counter_)",
     "'Hello\u00a0World ' + str(self.counter_)"],
)  # fmt: skip
def test_other_texts_are_not_told_of_odd_characters(new: str) -> None:
    found = found_in(new)
    assert found is None or found.kind not in ("node.odd_character", "node.line_end_in_text")
