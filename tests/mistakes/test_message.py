"""Messages: English texts that can be translated."""

from __future__ import annotations

import copy
import gettext
import pickle
import string

import pytest
from hypothesis import given
from hypothesis import strategies as st

from grader.base.i18n.message import Message, joined, msg, say, say_plural
from grader.base.i18n.translator import Translator, chosen_language

DICTIONARY = {"a cat {what}": "eine Katze {what}", "in {place}": "in {place} drin", "red": "rot"}
PLURALS = {("1 cat {what}", "{count} cats {what}"): ("1 Katze {what}", "{count} Katzen {what}")}


class German(gettext.NullTranslations):
    def gettext(self, message: str) -> str:
        return DICTIONARY.get(message, message)

    def ngettext(self, msgid1: str, msgid2: str, n: int) -> str:
        return PLURALS[msgid1, msgid2][0 if n == 1 else 1]


german = German()


def test_a_message_can_be_used_as_an_english_string() -> None:
    text = say("there is no file {path}", path="setup.py")
    assert text == "there is no file setup.py"
    assert isinstance(text, str)
    assert f"{text}!" == "there is no file setup.py!"


def test_values_inside_a_message_are_translated_with_it() -> None:
    text = say("a cat {what}", what=say("in {place}", place=say("red")))
    assert text == "a cat in red"
    assert text.translated(german) == "eine Katze in rot drin"


@pytest.mark.parametrize(
    ("count", "english", "translation"),
    [
        (0, "0 cats in X", "0 Katzen in X drin"),
        (1, "1 cat in X", "1 Katze in X drin"),
        (2, "2 cats in X", "2 Katzen in X drin"),
    ],
)
def test_a_text_with_a_count_has_a_plural_form(count: int, english: str, translation: str) -> None:
    where = say("in {place}", place="X")
    text = say_plural("1 cat {what}", "{count} cats {what}", count, what=where)
    assert text == english
    assert text.translated(german) == translation


def test_joined_messages_are_translated_separately_and_empty_ones_left_out() -> None:
    text = joined(say("red"), "", "42", say("in {place}", place="X"), by=", ")
    assert text == "red, 42, in X"
    assert text.translated(german) == "rot, 42, in X drin"


def test_a_sum_of_messages_can_be_translated() -> None:
    for text in (say("red") + " 1", "1 " + say("red")):
        assert isinstance(text, Message)
        assert "rot" in text.translated(german)


@given(st.text())
def test_a_students_text_is_never_used_as_a_template(name: str) -> None:
    assert say("a cat {what}", what=name).translated(german) == f"eine Katze {name}"


@given(st.text(alphabet=string.ascii_letters + "{} ", max_size=20))
def test_a_value_with_braces_stays_unchanged(value: str) -> None:
    assert joined(say("red"), value or "x").translated(german) == f"rot {value or 'x'}"


def test_a_missing_value_is_an_error_when_the_message_is_made() -> None:
    with pytest.raises(KeyError):
        say(msg("there is no {thing}"))


@pytest.mark.parametrize(
    "text",
    [
        say("in {place}", place="X"),
        joined(say("red"), "y"),
        say_plural("1 cat {what}", "{count} cats {what}", 3, what="x"),
    ],
)
def test_a_message_can_be_copied_and_pickled(text: Message) -> None:
    for again in (copy.deepcopy(text), pickle.loads(pickle.dumps(text))):
        assert again == text
        assert again.translated(german) == text.translated(german)


@pytest.mark.parametrize(
    ("environment", "wanted"),
    [
        ({}, "en"),
        ({"LANG": "ko_KR.UTF-8"}, "ko"),
        ({"LANG": "ko"}, "ko"),
        ({"LANG": "en_US.UTF-8"}, "en"),
        ({"LANG": "de_DE.UTF-8"}, "en"),
        ({"LANG": "en_US.UTF-8", "LC_ALL": "ko_KR.UTF-8"}, "ko"),
        ({"LANG": "en_US.UTF-8", "LC_MESSAGES": "ko_KR.UTF-8"}, "ko"),
        ({"LANG": "ko_KR.UTF-8", "LC_ALL": "C"}, "en"),
        ({"LANG": "en_US.UTF-8", "LANGUAGE": "ko:en"}, "ko"),
        ({"LANG": "ko_KR.UTF-8", "LANGUAGE": "de:en:ko"}, "en"),
        ({"LANG": "C", "LANGUAGE": "ko"}, "en"),
        ({"LC_ALL": "POSIX", "LANG": "ko_KR"}, "en"),
    ],
)
def test_the_language_is_chosen_as_in_gnu_gettext(environment: dict[str, str], wanted: str) -> None:
    assert chosen_language(environment) == wanted


@pytest.mark.parametrize(
    ("own", "wanted"), [("ko", "ko"), ("ko_KR.UTF-8", "ko"), ("en", "en"), ("", "en"), ("de", "en")]
)
def test_grader_lang_works_without_locales(own: str, wanted: str) -> None:
    assert chosen_language({"LC_ALL": "C.UTF-8", "GRADER_LANG": own}) == wanted


def test_grader_lang_outranks_the_locale() -> None:
    assert chosen_language({"LANG": "ko_KR.UTF-8", "GRADER_LANG": "en"}) == "en"


def test_an_unsupported_language_falls_back_to_english() -> None:
    assert Translator("tlh").lang == "en"
    assert Translator("tlh")(say("there is no setup.cfg")) == "there is no setup.cfg"


def test_korean_is_available() -> None:
    assert Translator("ko")(say("there is no setup.cfg")) == "setup.cfg가 없습니다"
    assert Translator("ko")("there is no setup.cfg") == "there is no setup.cfg", (
        "not ours: as it is"
    )
