"""The check `package.manifest`: package.xml, and whether setup.py has the same name."""

from __future__ import annotations

import re
import shlex
import sys
from collections.abc import Mapping
from typing import TYPE_CHECKING

from grader.base.i18n.message import Message, Value, joined, say
from grader.base.nearest import meant, nearest, there_is, with_difference
from grader.base.shown import shown
from grader.package.source.broken_xml import TAGS, XmlFault, xml_fault
from grader.package.source.manifest import (
    DEPENDS,
    REQUIRED,
    Element,
    Manifest,
    ManifestError,
    meant_package,
    read_manifest,
)
from grader.package.source.manifest_rules import RuleFault, rule_fault
from grader.report.model import Where
from grader.verdict.checks.parsed import (
    file_of,
    in_inner_folder,
    names_in,
    printable_reason,
    setup_py_of,
)
from grader.verdict.outcome import Failed, Passed

if TYPE_CHECKING:
    from grader.verdict.evidence import Evidence

FILE = "package.xml"
OF_ROS_1 = {"rospy": "rclpy", "roscpp": "rclcpp"}
BUILD_TYPE = "<export><build_type>ament_python</build_type></export>"
XML_FAULTS = {  # expat's most frequent messages, so that they can be translated
    str(fault): fault
    for fault in (
        say("mismatched tag"),
        say("not well-formed (invalid token)"),
        say("no element found"),
        say("unclosed token"),
        say("undefined entity"),
        say("junk after document element"),
        say("duplicate attribute"),
        say("XML or text declaration not at start of entity"),
    )
}


def check_manifest(evidence: Evidence) -> Passed:
    """Check package.xml; raise Failed for the first fault."""
    manifest = _read(evidence)
    _check_build_type_place(manifest)
    _check_rules(evidence, manifest)
    _check_name(evidence, manifest)
    _check_setup_name(evidence)
    _check_build_type(evidence, manifest)
    asked = any(use.kind == "package.depends" for use in evidence.assignment.checks)
    return Passed(actual=f"{manifest.name}, ament_python", advice=_advice(manifest, asked=asked))


def _failed(
    mistake: str,
    actual: str,
    line: int | None,
    *,
    expected: str = "",
    variant: str = "",
    params: Mapping[str, str | int | float] | None = None,
    words: Mapping[str, Value] | None = None,
    file: str = FILE,
) -> Failed:
    return Failed(
        mistake,
        expected=expected or say("a valid package.xml"),
        actual=actual,
        where=Where(file=file, line=line),
        variant=variant,
        params=params,
        words=words,
    )


def _read(evidence: Evidence) -> Manifest:
    file = file_of(evidence, FILE)
    if file is None:
        inner = in_inner_folder(evidence, FILE)
        if inner:
            raise _failed(
                "package.no_manifest",
                say("there is no {path}, but {there}", path=FILE, there=shown(inner)),
                None,
                variant="inner",
                params={"there": shown(inner)},
                words={"there": shlex.quote(shown(inner)), "close": ""},
                file=shown(inner),
            )
        close = nearest(FILE, names_in(evidence, ""), cutoff=0.75)
        raise _failed(
            "package.no_manifest",
            with_difference(say("there is no package.xml") + there_is(close), close, FILE),
            None,
            variant="capitals" if close.lower() == FILE else "renamed" if close else "",
            words={
                "close": shlex.quote(shown(close)),
                "there": "",
                "package": evidence.assignment.package,
            },
            file=shown(close) or FILE,
        )
    if file.unreadable:
        reason = printable_reason(file.reason)
        raise _failed(
            "package.manifest_unreadable",
            say("package.xml cannot be read: {reason}", reason=reason),
            None,
        )
    try:
        found = read_manifest(file.data)
    except ManifestError as error:
        raise _unusable(error, file.data) from None
    try:
        file.data.decode("utf-8")
    except UnicodeDecodeError:
        raise _failed(
            "package.manifest_unreadable",
            say("package.xml cannot be read: {reason}", reason=say("not UTF-8 text")),
            1,
            variant="encoding",
        ) from None
    return found


def _unusable(error: ManifestError, found: bytes) -> Failed:
    text = XML_FAULTS.get(error.text) or printable_reason(error.text)
    if error.kind == "doctype":
        actual: str = say("{text}: the rest of the file is not read", text=text)
        return _failed("package.manifest_doctype", actual, error.line)
    if error.kind != "xml":
        variant = "root" if error.kind == "root" else ""
        return _failed("package.manifest_rules", text, error.line, variant=variant)
    fault, params = xml_fault(found), {"error": str(text)}
    if not found.strip():
        said, variant = say("package.xml is empty"), "empty"
        return _failed("package.broken_xml", said, error.line, variant=variant, params=params)
    if fault is None:
        known = {
            "undefined entity": "entity",
            "duplicate attribute": "attribute_twice",
            "encoding specified in XML declaration is incorrect": "encoding_declared",
            "unknown encoding": "encoding_declared",
            "XML declaration not well-formed": "first_line",
        }
        variant = known.get(error.text, "")
        return _failed("package.broken_xml", text, error.line, variant=variant, params=params)
    return _failed(
        "package.broken_xml",
        _described(fault),
        fault.line,
        variant=fault.variant,
        params=params,
        words=_words(fault),
    )


def _words(fault: XmlFault) -> dict[str, str]:
    tag = shown(fault.tag)
    return {"tag": tag, "name": tag.removeprefix("/"), "wanted": shown(fault.wanted)}


def _described(fault: XmlFault) -> Message:
    words = _words(fault)
    texts = {
        "unclosed": say("<{tag}> is not closed: its </{tag}> is missing", **words),
        "again": say("<{tag}> is opened twice: the second should be </{tag}>", **words),
        "closed_twice": say("<{tag}> is there twice", **words),
        "unopened": say("<{tag}> closes nothing: its <{name}> is missing", **words),
        "misspelt": say("<{tag}> should be <{wanted}>", **words),
        "unfinished": say("<{tag} has no > at its end", **words),
        "quotes": say("<{tag} …> has typographic quotes", **words),
        "ampersand": say("there is a bare &"),
        "before": say("there is something before the first tag"),
        "after": say("there is something after the last tag"),
        "package_twice": say("<package> is in the file twice"),
        "no_tags": say("the file has no tag"),
        "typed": say("a sign of a tag is missing or wrong"),
        "typed_lines": say("signs of tags are missing or wrong"),
        "line_twice": say("a line is in the file twice"),
        "lines_swapped": say("two lines are in the wrong order"),
        "end_twice": say("</package> is in the file twice"),
        "root_first": say("there is a tag above <package>"),
        "outside": say("there is a tag below </{name}>", **words),
        "bare": say("<{tag} …> has a value without quotes", **words),
        "comment": say("a comment that begins with <!-- has no end"),
        "hyphens": say("two hyphens (--) are inside of a comment"),
        "hyphens_lines": say("two hyphens (--) are inside of a comment"),
        "comment_start": say("{tag} does not begin a comment: a comment begins with <!--", **words),
        "less": say("there is a bare <"),
        "version": say("a version with < is inside of a tag for a dependency"),
        "declaration": say(
            "there is something above <?xml …?>, which is in line {wanted}", **words
        ),
        "blank": say("there is an empty line or a space above <?xml …?>"),
        "declared_twice": say("<?xml …?> is in the file twice"),
    }
    return texts[fault.variant]


def _tag_fault(manifest: Manifest, tag: str) -> tuple[str, Message]:
    """Return the variant of a required tag that is missing or has no text, and what is there."""
    if any(inside.within == tag for inside in manifest.elements):
        variant = "tags_maintainer" if tag == "maintainer" else "tags"
        return variant, say("<{tag}> contains only other tags", tag=tag)
    if manifest.first(tag) is not None:
        return "empty", say("<{tag}> is empty", tag=tag)
    variant = tag if tag in ("version", "maintainer", "name") else ""
    return variant, say("<{tag}> is missing", tag=tag)


def _check_rules(evidence: Evidence, manifest: Manifest) -> None:
    rule = rule_fault(manifest, evidence.asked.package) if manifest.fault else None
    for tag in REQUIRED:
        element = manifest.first(tag)
        in_attribute = rule is not None and rule.variant == "content" and rule.tag == tag
        if in_attribute:
            continue  # the rule says more than that the tag is empty
        if element is None:
            _check_tag_name(manifest, tag, within="package")
        if element is None or (not element.text and tag != "description"):
            comment = 0 if element else _line_of_comment(evidence, tag)
            variant, actual = _tag_fault(manifest, tag)
            raise _failed(
                "package.manifest_tag",
                actual,
                element.line if element else comment or None,
                expected=say("<{tag}> that is not empty", tag=tag),
                variant="commented" if comment else variant,
                params={"tag": tag},
                words={"package": evidence.asked.package},
            )
    if not manifest.fault:
        return
    params = {"error": shown_long(manifest.fault)}
    package = evidence.asked.package
    fault = rule_fault(manifest, package)
    if fault is None:
        told = re.search(r"\bline (\d{1,6})\b", manifest.fault)
        line = int(told[1]) if told is not None else None
        raise _failed("package.manifest_rules", params["error"], line, params=params)
    words = _rule_words(fault, package)
    raise _failed(
        "package.manifest_rules",
        _rule_found(fault, params["error"], words),
        fault.line,
        variant=_rule_variant(fault),
        params=params,
        words=words,
    )


def _line_of_comment(evidence: Evidence, tag: str) -> int:
    """Return the line of the one comment that contains only tags, and this tag; 0 if none does."""
    file = file_of(evidence, FILE)
    text = file.data.decode("utf-8", "replace") if file is not None else ""
    lines = []
    for match in re.finditer(r"<!--(.*?)-->", text, re.DOTALL):
        inside = match[1].strip()
        closed = f"<{tag}>" in inside and f"</{tag}>" in inside
        whole = all(f"<{name}" in inside for name in REQUIRED)
        few = whole or inside.count("<") < 9
        if closed and few and inside.startswith("<") and inside.endswith(">"):
            lines.append(text.count("\n", 0, match.start()) + 1)
    return lines[0] if len(lines) == 1 else 0


def _rule_words(fault: RuleFault, package: str) -> dict[str, Value]:
    return {
        "tag": shown(fault.tag),
        "found": shown(fault.found),
        "wanted": shown(fault.wanted),
        "line": str(fault.line),
        "first": str(fault.first),
        "package": package,
    }


def _rule_variant(fault: RuleFault) -> str:
    """Return the name of the fix's text."""
    if fault.variant == "email":
        return "email" if fault.wanted else "email_parts"
    return fault.variant


def _rule_found(fault: RuleFault, error: str, words: Mapping[str, Value]) -> str:
    """Return what was found, in other words than catkin_pkg's if they say more."""
    first, last = sorted((fault.first, fault.line))
    twice = say(
        "there is more than one <{tag}>: in lines {first} and {last}",
        tag=words["tag"],
        first=first,
        last=last,
    )
    texts = {
        "twice": twice,
        "export_twice": twice,
        "redundant": say(
            "line {first} has <depend>{found}</depend>, and line {line} has <{tag}>{found}</{tag}> "
            "too",
            **words,
        ),
        "email": say('"{found}" is not an email address', **words),
        "no_email": say("<{tag}> has no email address", **words),
        "format": say('the tag <package> does not have format="3"', **words),
        "child": say("<{found}> is inside of <{tag}>, which begins in line {first}", **words),
        "empty": say("<{tag}> is empty", **words),
        "content": say("<{tag}> is empty, and has the attribute {found}", **words),
        "second_empty": say("<{tag}> is empty", **words),
    }
    return texts.get(fault.variant, error)


def _check_tag_name(manifest: Manifest, tag: str, *, within: str) -> None:
    """Raise Failed if an unknown tag's name is nearly that of a missing tag."""
    unknown = {e.tag: e for e in manifest.elements if e.within == within and e.tag not in TAGS}
    close = nearest(tag, unknown, cutoff=0.75)
    if not close:
        return
    missing = say("<{tag}> is missing", tag=tag) + there_is(close)
    raise _failed(
        "package.build_type" if tag == "build_type" else "package.manifest_tag",
        with_difference(missing, close, tag),
        unknown[close].line,
        expected=BUILD_TYPE if tag == "build_type" else say("<{tag}> that is not empty", tag=tag),
        variant="renamed",
        params={"tag": tag, "close": shown(close)},
    )


def shown_long(text: str) -> str:
    """Return a message in printable form; unlike `shown`, it may be longer than a name."""
    return " ".join(shown(part) for part in text.split()[:60])


def _check_name(evidence: Evidence, manifest: Manifest) -> None:
    package = evidence.asked.package
    if manifest.name == package:
        return
    element = manifest.first("name")
    name = shown(manifest.name)
    throughout = evidence.assignment.package != package
    raise _failed(
        "package.name_mismatch",
        with_difference(Message("<name>{name}</name>", {"name": name}), name, package),
        element.line if element else None,
        expected=f"<name>{package}</name>",
        variant="throughout" if throughout else "",
        params={"name": name, "file": FILE},
        words={"package": package},
    )


def _check_setup_name(evidence: Evidence) -> None:
    package = evidence.assignment.package
    setup = setup_py_of(evidence)
    name = setup.name if setup is not None else None
    if name is None or name.value == package:
        return
    found = shown(name.value)
    raise Failed(
        "package.name_mismatch",
        expected=say("setup.py: name='{package}', as in package.xml", package=package),
        actual=with_difference(f"setup.py: name='{found}'", found, package),
        where=Where(file="setup.py", line=name.line),
        variant="setup",
        params={"name": found, "file": "setup.py"},
        words={"package": package},
    )


def _check_build_type_place(manifest: Manifest) -> None:
    """Raise Failed for a <build_type> that is not in <export>."""
    there = manifest.effective("build_type", within="export")
    for element in manifest.elements:
        if element.tag != "build_type" or element.within == "export":
            continue
        if element.within not in TAGS and nearest("export", [element.within], cutoff=0.75):
            continue  # the name of the tag around it is wrong
        outside = say("<build_type> is outside of <export>")
        if element.within != "package":
            outside = say(
                "<build_type> is in <{within}>, and not directly in <export>", within=element.within
            )
        exports = manifest.all("export")
        variant = "outside_too" if there else "into" if exports else "outside"
        if element.within != "package" and not exports:
            variant = "out_of_other"
        line = (there or exports)[0].line if there or exports else 0
        raise _build_type(element, outside, variant, first=line)


def _check_build_type(evidence: Evidence, manifest: Manifest) -> None:
    elements = manifest.effective("build_type", within="export")
    if not elements:
        _check_tag_name(manifest, "build_type", within="export")
        export, missing = manifest.first("export"), say("there is no <build_type>")
        if left_out := manifest.all("build_type", within="export"):
            named = min(left_out, key=lambda element: element.text != "ament_python")
            condition = shown(named.attributes.get("condition", ""))
            never = say("the condition {condition} is not true in ROS 2", condition=condition)
            raise _build_type(named, never, "condition")
        if comment := _line_of_comment(evidence, "build_type"):
            found = Element("build_type", "", comment, "", {})
            raise _build_type(found, missing, "commented")
        if export is None:
            raise _build_type(None, missing)
        raise _build_type(export, missing, "in_export", first=export.line)
    if len(elements) > 1:
        many = say("there are {count} <build_type> tags", count=len(elements))
        raise _build_type(elements[1], many, "several")
    if elements[0].text != "ament_python":
        _check_created(evidence, elements[0])
        said = f"<build_type>{shown(elements[0].text)}</build_type>"
        differs = with_difference(said, elements[0].text, "ament_python")
        created = "cmake" in elements[0].text and bool(_not_there(evidence))
        raise _build_type(elements[0], differs, "cmake" if created else "line")


def _check_created(evidence: Evidence, element: Element) -> None:
    """Raise Failed if the whole package was created for C++, and not only this line is wrong."""
    assignment = evidence.assignment
    missing = _not_there(evidence)
    has_cmake = evidence.submission.file("CMakeLists.txt") is not None
    if not missing or not has_cmake or "cmake" not in element.text:
        return
    raise _failed(
        "package.created_as_cmake",
        joined(
            f"<build_type>{shown(element.text)}</build_type>",
            say("there is a CMakeLists.txt, but no {files}", files=", ".join(missing)),
            by=", ",
        ),
        element.line,
        expected=BUILD_TYPE,
        params={"missing": missing[0]},
        words={
            "package": assignment.package,
            "node_file": assignment.node_file,
            "entry": f"{assignment.executable} = {assignment.target}",
        },
    )


def _not_there(evidence: Evidence) -> list[str]:
    """Return the files of a Python package that are missing."""
    files = ("setup.py", "setup.cfg", f"resource/{evidence.assignment.package}")
    return [path for path in files if evidence.submission.file(path) is None]


def _build_type(
    element: Element | None, actual: str, variant: str = "", *, first: int = 0
) -> Failed:
    return _failed(
        "package.build_type",
        actual,
        element.line if element else None,
        expected=BUILD_TYPE,
        variant=variant,
        params={"build_type": element.text[:80] if element and element.text.isprintable() else ""},
        words={"first": str(first), "within": shown(element.within) if element else ""},
    )


def _of_ros_1(names: Mapping[str, int]) -> list[str]:
    """Return advice on dependencies that only ROS 1 has."""
    return [
        say(
            "package.xml, line {line}: '{name}' belongs to ROS 1. Delete each line with {name}: the "
            "package depends on {wanted} already.",
            line=names[name],
            name=name,
            wanted=wanted,
        )
        if wanted in names
        else say(
            "package.xml, line {line}: '{name}' belongs to ROS 1. Write {wanted} instead.",
            line=names[name],
            name=name,
            wanted=wanted,
        )
        for name, wanted in OF_ROS_1.items()
        if name in names
    ]


def _misplaced_depend(manifest: Manifest) -> Message | None:
    """Return advice on a dependency on rclpy that is inside of another tag."""
    inside = (e for e in manifest.elements if DEPENDS.fullmatch(e.tag) and e.within != "package")
    element = next((e for e in inside if e.text == "rclpy"), None)
    if element is None:
        return None
    return say(
        "package.xml, line {line}: <{tag}>{name}</{tag}> does not count inside of <{within}>. Move "
        "it out of that tag, so that it is directly inside of <package>. It runs here because "
        "rclpy is installed anyway.",
        line=element.line,
        tag=shown(element.tag),
        name=element.text,
        within=shown(element.within),
    )


def _cpp_library(names: Mapping[str, int]) -> Message | None:
    """Return advice on a dependency on ROS's library for C++, if there is none on Python's."""
    if "rclcpp" not in names:
        return None
    return say(
        "package.xml, line {line}: '{name}' is the library of ROS for C++. A node in Python needs "
        "rclpy: write <depend>rclpy</depend> instead. It runs here because rclpy is installed anyway.",
        line=names["rclcpp"],
        name="rclcpp",
    )


def _advice(manifest: Manifest, *, asked: bool) -> list[str]:
    """Return advice that costs no points; `asked`: a check asks for the dependencies."""
    names = {element.text: element.line for element in manifest.depends}
    advice = _of_ros_1(names)
    parts = {part for name in names for part in re.split(r"[\s,;]+", name)}
    is_named = "rclpy" in parts or any(meant_package(name) == "rclpy" for name in names)
    if not is_named and not asked and not advice:
        advice.append(
            _misplaced_depend(manifest)
            or _cpp_library(names)
            or say(
                "package.xml does not say that the package needs rclpy: add "
                "<depend>rclpy</depend>. It runs here because rclpy is installed anyway."
            )
        )
    for name, line in sorted(names.items()):
        close = meant_package(name)
        if re.search(r"\s", name) and not all(
            re.match("[A-Za-z]", part) for part in re.split(r"[\s,;]+", name)
        ):
            advice.append(
                say(
                    "package.xml, line {line}: '{name}' is not the name of a package: a name has no "
                    "spaces and begins with a letter. Delete this line if the package needs no other "
                    "one.",
                    line=line,
                    name=shown(name),
                )
            )
        elif re.search(r"\S[\s,;]+\S", name):
            advice.append(
                say(
                    "package.xml, line {line}: '{name}' is more than one name. Write a <depend> of "
                    "its own for each package.",
                    line=line,
                    name=shown(name),
                )
            )
        elif close:
            unknown = say(
                "package.xml, line {line}: the dependency '{name}' is not known",
                line=line,
                name=shown(name),
            )
            advice.append(with_difference(unknown + meant(close), name, close))
        elif name in sys.stdlib_module_names:
            advice.append(
                say(
                    "package.xml, line {line}: '{name}' is part of Python and needs no dependency.",
                    line=line,
                    name=name,
                )
            )
    return advice[:5]
