"""Whether each text of a report has its values: no reader may see `{topic}` of a template."""

from __future__ import annotations

import gettext
import re
from functools import cache

from grader.base.i18n.translator import DOMAIN, FOLDER
from grader.report.model import Report

PLACE = re.compile(r".{0,8}\{[a-z_]+\}.{0,8}")


def unfilled(report: Report) -> list[str]:
    """Return the parts of texts with a place that are in a template too; a program may have `{n}`."""
    texts = [report.message, *report.submission.notes]
    for check in report.checks:
        texts += [check.title, check.rationale, check.expected, check.actual, check.fix]
        texts += check.advice
    found = [match[0] for text in texts for match in PLACE.finditer(text)]
    return [part for part in found if part in _templates()] if found else []


@cache
def _templates() -> str:
    """Return all templates: each has a translation, so they are the keys of the compiled file."""
    with (FOLDER / "ko" / "LC_MESSAGES" / f"{DOMAIN}.mo").open("rb") as file:
        texts = gettext.GNUTranslations(file)._catalog  # type: ignore[attr-defined]
    return "\n".join(key if isinstance(key, str) else key[0] for key in texts)
