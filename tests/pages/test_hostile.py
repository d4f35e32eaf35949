"""Hostile texts of students are shown literally and do nothing."""

from __future__ import annotations

import socket
from dataclasses import replace
from pathlib import Path

import pytest

from grader.batch.model import ClassResult, GradebookEntry, Override, Student
from grader.batch.systems.known import FOLDERS
from grader.publish.pages import write_site
from grader.publish.pages.names import page_names
from tests.pages import classes
from tests.pages.browser import Open
from tests.report.samples import failing_report

pytestmark = pytest.mark.full  # `make test` has no Chromium

PAYLOADS = [
    "<script>alert(1); window.ran = 1</script>",
    "</pre></style></title></script><script>alert(1); window.ran = 1</script>",
    "<img src=x onerror='alert(1); window.ran = 1'><svg onload='window.ran = 1'>",
    "\"' onmouseover='window.ran = 1' autofocus onfocus='window.ran = 1' x='\"",
    "javascript:alert(document.domain)",
    "<iframe src='https://example.org/'></iframe><link rel=stylesheet href=//example.org/x.css>",
    "<style>@import 'https://example.org/x.css'; body { display: none }</style>",
    "<meta http-equiv=refresh content='0; url=https://example.org/'><base href='//example.org/'>",
    "{{ 7 * 7 }}{% raw %}{{ cycler.__init__.__globals__ }}{# #}",
    "<!--", "]]>", "&lt;script&gt;", "`${alert(1)}`",
    "\u202egpj.exe\u2066 \u200b\u00ad\ufeff",
    "\x1b[2J\x1b]0;title\x07\x00\x08\x7f\x9b31m",
    "line one\r\nline two\u2028line three\x0cnew page",
    "\ud800 a lone surrogate",
    "x" * 100_000,
    "\n" * 20_000 + "the end",
]  # fmt: skip
DIRECTIVES = ["script-src-elem", "script-src-attr", "style-src-elem", "style-src-attr", "img-src",
              "frame-src"]  # fmt: skip
# adds hostile markup to the page; returns the directives of the policy that blocked it
INJECTED = """address => new Promise(done => {
    const seen = new Set();
    document.addEventListener("securitypolicyviolation", event => {
        seen.add(event.effectiveDirective);
        if (seen.size === 6) done([...seen]);
    });
    const script = document.createElement("script");
    script.textContent = "window.ran = 1";
    document.body.append(script);
    document.body.insertAdjacentHTML("beforeend",
        `<img src="${address}x.png"><link rel=stylesheet href="${address}x.css">` +
        "<iframe src='data:text/html,x'></iframe>" +
        "<p id=attribute onclick='window.ran = 1' style='color: red'>x</p>");
    document.getElementById("attribute").click();
})"""


def hostile_class(texts: list[str]) -> ClassResult:
    """Return a class in which each student has one of the texts in every field they control."""
    entries = []
    for text in texts:
        # a report is read from JSON, which cannot contain a lone surrogate
        bad = classes.with_every_text(failing_report(), text.encode(errors="replace").decode())
        student = Student(text, text, text, text, text, text)
        override = Override(text, text, 5, text, text)
        graded = GradebookEntry(student, "graded", bad, 50, final=50, notes=(text,), problem=text)
        entries += [
            replace(graded, overrides=(override,), same_as=(texts[0],)),
            GradebookEntry(Student(f"{text}!", text), "ungradable", problem=text),
        ]
    everything = "".join(texts)
    return ClassResult(
        title=everything,
        assignment=everything,
        system=FOLDERS,
        entries=tuple(entries),
        max_score=100,
        distros=(everything,),
        notes=(everything,),
        identical=(tuple(texts),),
    )


@pytest.fixture(scope="module")
def hostile_site(tmp_path_factory: pytest.TempPathFactory) -> Path:
    out = tmp_path_factory.mktemp("hostile")
    write_site(hostile_class(PAYLOADS), out)
    return out


def test_hostile_text_does_not_run_load_or_become_markup(visit: Open, hostile_site: Path) -> None:
    index = hostile_site / "index.html"
    pages = [index, *sorted((hostile_site / "students").iterdir())]
    assert len(pages) == 1 + 2 * len(PAYLOADS)
    witness = visit()
    for path in pages:
        page = witness.open(path)
        page.mouse.move(200, 200)
        did = (witness.requests, witness.complaints, witness.dialogs)
        assert did == ([path.as_uri()], [], []), path
        assert page.evaluate("window.ran") is None, path
        tags = page.evaluate("[...document.querySelectorAll('*')].map(e => e.localName)")
        assert not {"img", "iframe", "link", "base", "object", "embed", "form"} & set(tags), path
        assert tags.count("script") == (1 if path == index else 0), path
        assert (tags.count("style"), tags.count("meta")) == (1, 6), path
        for address in page.evaluate("[...document.links].map(a => a.href)"):
            assert address.startswith(hostile_site.as_uri()), (path, address)


def test_hostile_text_does_not_make_a_page_wide_or_large(visit: Open, hostile_site: Path) -> None:
    """A word of a hundred thousand letters, and twenty thousand empty lines."""
    witness = visit(viewport={"width": 320, "height": 640})
    for path in sorted(hostile_site.rglob("*.html")):
        assert path.stat().st_size < 500_000, path
        page = witness.open(path)
        assert page.evaluate("document.documentElement.scrollWidth") == 320, path


def test_hostile_text_is_shown_literally(visit: Open, tmp_path: Path) -> None:
    text = PAYLOADS[1]
    write_site(hostile_class([text]), tmp_path)
    page = visit().open(tmp_path / "students" / page_names([text, f"{text}!"])[text])
    assert page.locator("h1").inner_text() == text
    assert page.title().startswith(text)
    assert page.locator("pre").first.inner_text() == text
    assert page.locator(".fields dd").first.inner_text() == text


def test_invisible_characters_are_spelled_out(visit: Open, tmp_path: Path) -> None:
    index = write_site(hostile_class(["a\u202eb\x1bc\x00d"]), tmp_path)
    assert visit().open(index).locator("h1").inner_text() == r"a\u202eb\x1bc\x00d"


def test_injected_markup_would_not_run(visit: Open, hostile_site: Path) -> None:
    """The second defence: the policy blocks what escaping would have missed."""
    for path in (hostile_site / "index.html", next((hostile_site / "students").iterdir())):
        with socket.create_server(("127.0.0.1", 0)) as server:
            page = visit().open(path)
            blocked = page.evaluate(INJECTED, f"http://127.0.0.1:{server.getsockname()[1]}/")
            assert set(blocked) == set(DIRECTIVES)
            assert page.evaluate("window.ran") is None
            server.setblocking(False)
            with pytest.raises(BlockingIOError):  # no request has arrived
                server.accept()
