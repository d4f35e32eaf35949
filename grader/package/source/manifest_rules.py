"""Which rule of its format a package.xml breaks: the line, and how it should be, if that is certain."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass
from xml.sax.saxutils import escape, quoteattr

from grader.base.nearest import nearest
from grader.package.source.broken_xml import TAGS
from grader.package.source.manifest import Element, Manifest

TODO = "TODO"  # how texts begin that `ros2 pkg create` leaves to be filled in
ADDRESS = re.compile(
    r"[-\w%+]+(?:\.[-\w%+]+)*@[-a-zA-Z0-9%]+(?:\.[-a-zA-Z0-9%]+)*\.[a-zA-Z]{2,}", re.A
)
AT = re.compile(r"\s*(?:\(at\)|\[at\]|\{at\}|<at>|_at_|\sat\s|@)\s*", re.IGNORECASE)
DOT = re.compile(r"\s*(?:\(dot\)|\[dot\]|\{dot\}|\sdot\s)\s*", re.IGNORECASE)
NEEDS = {
    "maintainer": ("email",),
    "author": ("email",),
    "package": ("format",),
    "version": ("compatibility",),
    "license": ("file",),
    "url": ("type",),
}
"""The attributes of the tags, except the conditions of dependencies."""
HOLD_CONTENT = ("name", "value", "package", "pkg", "include", "text", "id")
"""Attributes in which other formats keep what package.xml has between a tag and its end."""


@dataclass(frozen=True)
class RuleFault:
    """A broken rule: its tag and line, and the line to which it is compared.

    `wanted` is what to write, `found` what is there; both are "" if the whole tag is wrong.
    """

    variant: str
    line: int
    tag: str = ""
    found: str = ""
    wanted: str = ""
    first: int = 0


def rule_fault(manifest: Manifest, package: str) -> RuleFault | None:
    """Return the first rule that a manifest breaks; None if the rule is not known."""
    for pattern, look in LOOKS:
        match = re.search(pattern, manifest.fault)
        fault = look(manifest, match) if match is not None else None
        if fault is not None and fault.variant == "twice" and fault.tag == "name":
            return _two_names(manifest, package)
        if fault is not None:
            return fault
    return None


def _two_names(manifest: Manifest, package: str) -> RuleFault:
    """Return the name that is to be deleted: the one that is not the package's."""
    names = manifest.all("name")
    kept = next((e for e in names if e.text == package), names[0])
    wrong = next(e for e in names if e is not kept)
    return RuleFault("twice", wrong.line, "name", first=kept.line)


def _twice(manifest: Manifest, match: re.Match[str]) -> RuleFault | None:
    found = manifest.all(match["tag"])
    if len(found) < 2:
        return None
    todo = [e for e in found if e.text.startswith(TODO) or _is_empty(manifest, e)]
    wrong = todo[0] if len(todo) == 1 else found[1]
    kept = next(e for e in found if e is not wrong)
    variant = "export_twice" if wrong.tag == "export" else "twice"
    return RuleFault(variant, wrong.line, wrong.tag, first=kept.line)


def _is_empty(manifest: Manifest, element: Element) -> bool:
    """Whether an element has neither text nor tags; those of a tag come before its end."""
    at = manifest.elements.index(element)
    return not element.text and not (at and manifest.elements[at - 1].within == element.tag)


def _redundant(manifest: Manifest, match: re.Match[str]) -> RuleFault | None:
    name, tag = match["name"], match["tag"]
    alike = [e for e in manifest.all("depend") if e.text == name]
    if len(alike) > 1:
        return RuleFault("redundant", alike[1].line, "depend", found=name, first=alike[0].line)
    pair = [[e for e in manifest.all(t) if e.text == name] for t in ("depend", tag)]
    if not all(pair):
        return None
    return RuleFault("redundant", pair[1][0].line, tag, found=name, first=pair[0][0].line)


def _email(manifest: Manifest, match: re.Match[str]) -> RuleFault | None:
    address = match["email"]
    element = next((e for e in _people(manifest) if e.attributes.get("email") == address), None)
    if element is None:
        return None
    return RuleFault(
        "email", element.line, element.tag, found=address, wanted=meant_address(address)
    )


def meant_address(written: str) -> str:
    """Return the address that was meant; "" if that is not certain."""
    inside = re.search(r"<([^<>\s]{3,80})>", written)
    text = inside[1] if inside is not None else written
    text = DOT.sub(".", AT.sub("@", text.strip().removeprefix("mailto:"))).rstrip(".,; ")
    return text if text != written and ADDRESS.fullmatch(text) else ""


def _no_email(manifest: Manifest, match: re.Match[str]) -> RuleFault | None:
    del match
    for element in _people(manifest):
        if element.tag == "maintainer" and not element.attributes.get("email"):
            other = next((n for n, v in element.attributes.items() if "@" in v), "")
            known = [*element.attributes]
            close = other or nearest("email", known, cutoff=0.6)
            variant = "attribute_name" if close and close != "email" else "no_email"
            return RuleFault(variant, element.line, element.tag, found=close, wanted="email")
    return None


def _people(manifest: Manifest) -> list[Element]:
    return sorted(
        (*manifest.all("maintainer"), *manifest.all("author")), key=lambda element: element.line
    )


def _tags(manifest: Manifest, match: re.Match[str]) -> RuleFault | None:
    names = [name.strip() for name in match["tags"].split(",")]
    wrong = [e for e in manifest.elements if e.within == "package" and e.tag in names]
    root = next((e for e in manifest.elements if not e.within), None)
    if not wrong or root is None:
        return None
    if int(match["format"]) < 3 and all(e.tag in TAGS for e in wrong):
        return RuleFault(
            "format", root.line, found=root.attributes.get("format", ""), first=wrong[0].line,
            tag=wrong[0].tag,
        )  # fmt: skip
    element = wrong[0]
    close = (
        "exec_depend" if element.tag == "run_depend" else nearest(element.tag, TAGS, cutoff=0.75)
    )
    inside = [e.tag for e in manifest.elements if e.within == element.tag]
    holds = bool(inside) and all(tag in TAGS for tag in inside)
    return RuleFault(
        "container" if holds else "tag" if close else "unknown_tag", element.line, element.tag,
        found=element.tag, wanted=close,
    )  # fmt: skip


def _attributes(manifest: Manifest, match: re.Match[str]) -> RuleFault | None:
    name = match["names"].split(",")[0].strip()
    element = next((e for e in manifest.all(match["tag"]) if name in e.attributes), None)
    root = next((e for e in manifest.elements if not e.within), None)
    if element is None and root is not None and match["tag"] == root.tag:
        element = root
    if element is None:
        return None
    free = [a for a in NEEDS.get(element.tag, ()) if a not in element.attributes]
    close = nearest(name, free, cutoff=0.6)
    if not close and element is not root and _is_empty(manifest, element):
        return _content(element, [n.strip() for n in match["names"].split(",")])
    return RuleFault(
        "attribute_name" if close else "attribute", element.line, element.tag, found=name,
        wanted=close,
    )  # fmt: skip


def _content(element: Element, unknown: list[str]) -> RuleFault:
    """Return how an empty tag is written whose content is the value of an attribute."""
    given = [n for n in unknown if n in element.attributes]
    name = next((n for n in given if n in HOLD_CONTENT), given[0])
    value = element.attributes[name].strip()
    if not value or (name not in HOLD_CONTENT and len(given) > 1):
        return RuleFault("attribute", element.line, element.tag, found=name)
    kept = {n: v for n, v in element.attributes.items() if n not in given}
    head = "".join(f" {n}={quoteattr(v)}" for n, v in kept.items())
    wanted = f"<{element.tag}{head}>{escape(value)}</{element.tag}>"
    return RuleFault("content", element.line, element.tag, found=name, wanted=wanted)


def _children(manifest: Manifest, match: re.Match[str]) -> RuleFault | None:
    child = match["names"].split(",")[0].strip()
    inside = next((e for e in manifest.all(child, match["tag"])), None)
    outside = next((e for e in manifest.all(match["tag"])), None)
    if inside is None or outside is None:
        return None
    return RuleFault("child", inside.line, match["tag"], found=child, first=outside.line)


def _version(manifest: Manifest, match: re.Match[str]) -> RuleFault | None:
    del match
    element = manifest.first("version")
    return RuleFault("version", element.line, "version") if element is not None else None


def _itself(manifest: Manifest, match: re.Match[str]) -> RuleFault | None:
    del match
    same = [e for e in manifest.depends if e.text == manifest.name]
    return RuleFault("itself", same[0].line, same[0].tag, found=manifest.name) if same else None


def _name(manifest: Manifest, match: re.Match[str]) -> RuleFault | None:
    del match
    element = manifest.first("name")
    return RuleFault("name", element.line, "name", manifest.name) if element is not None else None


def _format(manifest: Manifest, match: re.Match[str]) -> RuleFault | None:
    del match
    root = next((e for e in manifest.elements if not e.within), None)
    given = root.attributes.get("format", "") if root is not None else ""
    return RuleFault("format", root.line, found=given) if root is not None else None


def _empty(manifest: Manifest, match: re.Match[str]) -> RuleFault | None:
    tag = match["tag"]
    empty = [e for e in manifest.all(tag) if not e.text]
    if not empty:
        return None
    several = len(manifest.all(tag)) > 1
    return RuleFault("second_empty" if several else "empty", empty[0].line, tag)


LOOKS: tuple[tuple[str, Callable[[Manifest, re.Match[str]], RuleFault | None]], ...] = (
    (r'must contain exactly one "(?P<tag>\w{1,40})" tag', _twice),
    (r'must not contain more than one "(?P<tag>\w{1,40})" tag', _twice),
    (
        r"The generic dependency on '(?P<name>[^']{1,200})' is redundant with: (?P<tag>\w{1,40})",
        _redundant,
    ),
    (r'The "maintainer" tag must have the attribute "email"', _no_email),
    (r"Maintainers must have an email address", _no_email),
    (r'Invalid email ""', _no_email),
    (r'Invalid email "(?P<email>[^"]{1,300})" for person', _email),
    (
        r"\(with format version (?P<format>\d)\) must not contain the following tags: "
        r"(?P<tags>[\w.:-]{1,80}(?:, [\w.:-]{1,80})*)",
        _tags,
    ),
    (
        r'The "(?P<tag>\w{1,40})" tag must not have the following attributes: '
        r"(?P<names>[\w.:-]{1,80}(?:, [\w.:-]{1,80})*)",
        _attributes,
    ),
    (
        r'The "(?P<tag>\w{1,40})" tag must not contain the following children: '
        r"(?P<names>[\w.:-]{1,80}(?:, [\w.:-]{1,80})*)",
        _children,
    ),
    (r"does not follow version conventions", _version),
    (r"with the same name as this package", _itself),
    (r'Package name "[^"]{0,200}" does not follow naming conventions', _name),
    (r"Unable to handle package\.xml format version", _format),
    (r"^ValueError: invalid literal for int", _format),
    (r'^"?The "format" attribute', _format),
    (r"Package (?P<tag>description) must not be empty", _empty),
    (r"The (?P<tag>license) tag must neither be empty", _empty),
)
"""The messages of catkin_pkg that a package of the lesson can reach, and what they mean."""
