"""Which line of a package.xml breaks a rule of its format, by what catkin_pkg says."""

from __future__ import annotations

import re

from grader.package.source.manifest import Element, Manifest

OF_FORMAT = re.compile(
    r'format version,? |with format version [12]\)|^ValueError: invalid literal|^"?The "format" attribute'
)
WORD = re.compile(r"[\w.:-]{1,80}")


def line_of_rule(manifest: Manifest) -> int | None:
    """Return the line of the tag that a message of catkin_pkg names; None if none is known."""
    told = re.search(r"\bline (\d{1,6})\b", manifest.fault)
    if told is not None:
        return int(told[1])
    first = manifest.fault.partition("; ")[0]
    root = [e for e in manifest.elements if not e.within]
    of_format = OF_FORMAT.search(first) is not None and "format version 3" not in first
    found = root if of_format else _named(manifest, first)
    if "with the same name as this package" in first:
        found = [e for e in manifest.depends if e.text == manifest.name]
    return found[-1].line if found else None


def _named(manifest: Manifest, said: str) -> list[Element]:
    """Return the tags that a message names: by a value, by the text, or by the name of the tag."""
    words = set(WORD.findall(said.replace('"package"', ""))) - {""}
    inside = [element for element in manifest.elements if element.within]
    named = [element for element in inside if element.tag in words]
    if "empty" in words:
        return [element for element in named if not element.text][:1]
    quoted = [element for element in inside if _has_value(element, said)]
    same = [element for element in named if element.text in words]
    return quoted or same or named


def _has_value(element: Element, said: str) -> bool:
    """Whether a message has the value of one of the attributes in quotes."""
    return any(value and f'"{value}"' in said for value in element.attributes.values())
