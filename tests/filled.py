"""Whether each text of a report has its values: no reader may see `{topic}` of a template."""

from __future__ import annotations

import re
from functools import cache

from grader.cli.update_translations import plurals, templates
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
    """Return all templates, as they are in the source."""
    ones = [template for template, _ in templates()]
    return "\n".join([*ones, *(text for both, _ in plurals() for text in both)])
