"""Changes of the quotes of a text, and of the braces of an f-string."""

from __future__ import annotations

import re
from collections.abc import Iterator

from grader.package.source.token_line import Change, Line

OPEN_TEXT = re.compile(r"(?P<quote>['\"])(?P<inside>_*)$")
CLOSED = re.compile(r"[ \t,;)\]}:]*$")


def quotes(line: Line) -> Iterator[Change]:
    """A quote is missing at the end or the beginning of a text, or is another one."""
    code = line.code.rstrip() if not line.code.endswith("_") else line.code
    match = OPEN_TEXT.search(code)
    written = line.broken.source.line(line.number)
    below = line.broken.code.line(line.number + 1).lstrip()
    if match is None or '"""' in code or "'''" in code or below.startswith(match["quote"]):
        return
    quote, begin = match["quote"], match.end("quote")
    rest = written[begin:].rstrip()
    other = "'" if quote == '"' else '"'
    if other in rest:
        at = begin + rest.index(other)
        yield line.change("quote_other", 1, (at, at + 1, quote))
    end = begin + len(CLOSED.sub("", rest))
    if end > begin:
        for at in range(end, begin + len(rest) + 1):
            yield line.change("quote_exact", 1.1 + 0.05 * (at - end), (at, at, quote))
        inside = written[begin:end]
        for far, end_of_text in enumerate(re.finditer(r" ?(?= *[+,] *\w)", inside)):
            at = begin + end_of_text.end()
            yield line.change("quote_exact", 1.05 + 0.01 * far, (at, at, quote))
    for match_of_f in re.finditer(r"(?<=[(,= ])[fF](?=[A-Z])", written[: match.start()]):
        yield line.change("quote_exact", 0.85, (match_of_f.end(), match_of_f.end(), quote))
    for before in re.finditer(r"(?:[(\[{=,]|^)[ \t]*(?=[\w/.$])", written[: match.start()]):
        closes = re.search(r"[\w/.]$", written[: match.start()]) and not re.match(r"\w", rest)
        cost = 0.9 if closes else 1.6
        yield line.change("quote_exact", cost, (before.end(), before.end(), quote))


def fields(line: Line) -> Iterator[Change]:
    """A brace of an f-string is missing or too much, or its quotes are those of the value."""
    written = line.broken.source.line(line.number)
    if re.search(r"\b[rR]?[fF][rR]?['\"]", written) is None:
        return
    for at, sign in enumerate(written):
        if sign in "{}":
            twice = written[at : at + 2] == sign * 2
            yield line.change("brace_extra", 1 if twice else 1.7, (at, at + 1, ""))
        elif sign in "'\"" and written[at - 1] != "}":
            yield line.change("brace_missing", 1.2, (at, at, "}"))
        if sign in ")]":
            yield line.change("brace_kind", 1.25, (at, at + 1, "}"))
        if sign in ")]" and written[at + 1 : at + 2] in ("}", "'", '"'):
            yield line.change("brace_missing", 1.3, (at + 1, at + 1, "}"))
    for match in re.finditer(r"(?<![\w{])[A-Za-z_][\w.]*(?=\})", written):
        yield line.change("brace_missing", 1.4, (match.start(), match.start(), "{"))
