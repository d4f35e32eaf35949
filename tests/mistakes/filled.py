"""Values for the placeholders of a template, for tests that only read it."""

from __future__ import annotations

import string
from collections.abc import Mapping

from grader.base.i18n.message import Value


def filled(template: str, params: Mapping[str, Value]) -> dict[str, Value]:
    """Return a value for every placeholder of a template; an unknown value is its name in <>."""
    names = [name for _, name, _, _ in string.Formatter().parse(template) if name]
    return {name: params.get(name, f"<{name}>") for name in names}
