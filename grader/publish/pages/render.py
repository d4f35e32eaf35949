"""HTML from templates. Every text is treated as hostile, whatever its source.

Three defences, each sufficient by itself: every template expression escapes markup, makes invisible
characters visible and cuts long texts; the content security policy of each page allows, by their
hashes, only the style and script of this package; and no template puts a text into an address, a
style or a script.
"""

from __future__ import annotations

import base64
import hashlib
from functools import partial
from pathlib import Path

from jinja2 import Environment, FileSystemLoader, StrictUndefined
from markupsafe import Markup, escape

from grader.base.carets import pieces
from grader.base.i18n.message import joined, say, say_plural
from grader.base.i18n.translator import SOURCE, Translator
from grader.base.plain_text import one_line, points, shorten, visible
from grader.batch.model import Student
from grader.batch.points import in_points
from grader.batch.words import SIGNS, STATES, duration, lapsed_words, local_instant
from grader.report.blocks import WORDS, all_of
from grader.report.report_page import hidden_checks

TEMPLATES = Path(__file__).resolve().parent / "templates"
MOST = 1_000  # characters of a text that is not a whole log or field
MOST_NAME = 120


class Renderer:
    """Renders the templates in one language; `values` are available in all of them.

    Texts that a template marks with `say` or `say_plural` are translated on output.
    """

    def __init__(self, *, lang: str = SOURCE, **values: object) -> None:
        self._css = (TEMPLATES / "site.css").read_text(encoding="utf-8")
        self._js = (TEMPLATES / "site.js").read_text(encoding="utf-8")
        self._environment = _environment(Translator(lang))
        self._environment.globals.update(values)

    def page(self, template: str, *, script: bool, **values: object) -> bytes:
        """Return a page in UTF-8, with our script or without any."""
        js = self._js if script else ""
        style, code = Markup(self._css), Markup(js)  # noqa: S704 - files of this package
        known = {"css": style, "js": code, "policy": _policy(self._css, js)}
        text = self._environment.get_template(template).render(known, **values)
        return text.encode()


def _environment(translate: Translator) -> Environment:
    environment = Environment(
        loader=FileSystemLoader(TEMPLATES),
        autoescape=True,
        undefined=StrictUndefined,
        finalize=partial(_tamed, translate=translate),
        trim_blocks=True,
        lstrip_blocks=True,
    )
    environment.filters.update(
        seconds="{:.3f} s".format,
        whole=_whole,
        marked=_marked,
        short=lambda text: shorten(translate(text), most=MOST, translate=translate),
    )
    environment.globals.update(
        lang=translate.lang,
        say=say,
        say_plural=say_plural,
        joined=joined,
        students=lambda count: say_plural("{count} student", "{count} students", count),
        all_of=all_of,
        hidden_checks=hidden_checks,
        states=STATES,
        signs=SIGNS,
        words=WORDS,
        points=points,
        in_points=in_points,
        duration=duration,
        local_instant=local_instant,
        lapsed_words=lapsed_words,
        one_line=partial(one_line, translate=translate),
        who=_who,
    )
    return environment


def _who(student: Student) -> str:
    """Return a student's name for a heading or a link."""
    return one_line(student.name or student.key, most=MOST_NAME)


def _tamed(value: object, *, translate: Translator) -> object:
    """Translate a text, make its invisible characters visible, limit its length; our markup stays."""
    if not isinstance(value, str) or isinstance(value, Markup):
        return value
    return visible(shorten(translate(value), most=MOST, translate=translate))


def _whole(text: str) -> Markup:
    """Return an already shortened text escaped for use between two tags."""
    return escape(visible(text))


def _marked(text: str) -> Markup:
    """Return an already shortened text escaped; a line with marks below it is not wrapped.

    On a narrow screen such a block is scrolled sideways, so the keyboard must reach it.
    """
    html, prose = Markup(), list[str]()
    for piece in pieces(visible(text, tabs=True).split("\n")):
        if not piece.marked:
            prose += piece.lines
            continue
        block = Markup('<pre class="marks" tabindex="0" dir="ltr">{}</pre>')
        html += escape("\n".join(prose)) + block.format("\n".join(piece.lines))
        prose = []
    return html + escape("\n".join(prose))


def _policy(css: str, js: str) -> str:
    """Return the content security policy: only these two texts, and no requests."""
    script = f"'{_hash(js)}'" if js else "'none'"
    return (
        f"default-src 'none'; style-src '{_hash(css)}'; script-src {script}; "
        "base-uri 'none'; form-action 'none'"
    )


def _hash(text: str) -> str:
    return "sha256-" + base64.b64encode(hashlib.sha256(text.encode()).digest()).decode()
