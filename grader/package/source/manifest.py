"""package.xml: its name, its build type and its faults, each with its line.

colcon-ros accepts what catkin_pkg accepts (REP 149), so catkin_pkg validates; expat gives the
lines. A document type is refused before catkin_pkg sees it: entities could expand a few bytes to
gigabytes, or name files of the grader's machine.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from xml.parsers import expat

from grader.base.i18n.message import say
from grader.base.nearest import nearest

MOST_BYTES = 50_000
MOST_LEVELS = 20
MOST_ELEMENTS = 500
"""catkin_pkg compares each dependency with every other."""
REQUIRED = ("name", "version", "description", "maintainer", "license")
DEPENDS = re.compile(r"(?:\w+_)?depend")
RUNTIME = ("depend", "exec_depend", "run_depend")
"""The tags of what a package needs when it runs (`run_depend` in format 1)."""
KNOWN_PACKAGES = (
    *("rclpy", "rclcpp", "std_msgs", "std_srvs", "geometry_msgs", "sensor_msgs", "nav_msgs"),
    *("visualization_msgs", "trajectory_msgs", "action_msgs", "builtin_interfaces"),
    *("example_interfaces", "rcl_interfaces", "rosgraph_msgs", "turtlesim", "tf2_ros", "tf2_py"),
    *("launch", "launch_ros", "ros2launch", "cv_bridge", "image_transport"),
    *("ament_copyright", "ament_flake8", "ament_pep257", "ament_xmllint", "ament_mypy"),
    *("ament_lint_auto", "ament_lint_common", "ament_index_python", "ament_python"),
    *("ament_cmake", "ament_cmake_python", "ament_cmake_auto", "rviz2", "xacro"),
    *("robot_state_publisher", "joint_state_publisher", "python3-pytest", "python3-setuptools"),
)
CONTEXT = {"ROS_VERSION": "2", "ROS_PYTHON_VERSION": "3"}  # what ROS 2's setup files set


class ManifestError(Exception):
    """A package.xml that cannot be used: `kind` is `xml`, `doctype`, `size`, `root` or `rules`."""

    def __init__(self, kind: str, text: str, line: int | None = None) -> None:
        super().__init__(text)
        self.kind = kind
        self.text = text
        self.line = line


@dataclass(frozen=True)
class Element:
    """An element: its tag, its text and its line; `within` is the tag of its parent."""

    tag: str
    within: str
    line: int
    text: str
    attributes: dict[str, str]


@dataclass(frozen=True)
class Manifest:
    """A package.xml that is XML; `fault` is the reason why catkin_pkg rejects it, if it does."""

    elements: tuple[Element, ...]
    fault: str = ""
    warnings: tuple[str, ...] = ()

    def all(self, tag: str, within: str = "package") -> list[Element]:
        """Return the elements of a tag directly within another."""
        return [e for e in self.elements if e.tag == tag and e.within == within]

    def effective(self, tag: str, within: str = "package") -> list[Element]:
        """Return those of them whose condition holds in a terminal with ROS 2."""
        return [e for e in self.all(tag, within) if _holds(e.attributes.get("condition", ""))]

    def first(self, tag: str, within: str = "package") -> Element | None:
        """Return the first of them, or None."""
        return next(iter(self.all(tag, within)), None)

    @property
    def name(self) -> str:
        """The package's name; empty if there is none."""
        element = self.first("name")
        return element.text if element else ""

    @property
    def depends(self) -> list[Element]:
        """Every dependency, of any kind."""
        return [e for e in self.elements if DEPENDS.fullmatch(e.tag) and e.within == "package"]


def meant_package(name: str) -> str:
    """Return the known package whose name is nearly that of a dependency; "" if there is none."""
    return "" if name in KNOWN_PACKAGES else nearest(name, KNOWN_PACKAGES, cutoff=0.8)


def _holds(condition: str) -> bool:
    """Whether a condition of a tag (REP 149) holds; colcon takes it from the environment."""
    if not condition:
        return True
    from catkin_pkg.condition import evaluate_condition  # noqa: PLC0415 - see _judge

    try:
        return bool(evaluate_condition(condition[:200], CONTEXT))
    except ValueError:
        return True


def read_manifest(found: bytes) -> Manifest:
    """Read a package.xml; ManifestError if it is not XML, too large, or has a document type."""
    if len(found) > MOST_BYTES:
        raise ManifestError("size", say("it is larger than {size} kB", size=MOST_BYTES // 1000))
    elements = _elements(found)
    root = next((e for e in elements if not e.within), None)
    if root is None or root.tag != "package":
        tag = root.tag if root else ""
        said = say("its outermost tag is <{tag}>, not <package>", tag=tag)
        raise ManifestError("root", said, root.line if root else 1)
    warnings: list[str] = []
    return Manifest(elements, _judge(found, warnings), tuple(warnings))


def _judge(found: bytes, warnings: list[str]) -> str:
    """Return why catkin_pkg rejects a manifest, on one line; empty if it does not."""
    # imported only when a package is graded: 43 ms of CPU time on top of pydantic's
    from catkin_pkg.package import InvalidPackage, parse_package_string  # noqa: PLC0415

    try:
        parse_package_string(found, warnings=warnings)
    except InvalidPackage as error:
        text = str(error).removeprefix("Error(s):")
        lines = [" ".join(line.split()) for line in re.split(r"\n-?\s*", text)]
        return "; ".join(line.rstrip(".") for line in lines if line)[:500]
    except Exception as error:  # colcon would meet the same exception
        return f"{type(error).__name__}: {error}"[:500]
    return ""


class _Reader:
    """Collects elements while expat parses."""

    def __init__(self) -> None:
        self.parser = expat.ParserCreate()
        self.found: list[Element] = []
        self._open: list[tuple[str, int, dict[str, str], list[str]]] = []
        self.parser.StartElementHandler = self._start
        self.parser.EndElementHandler = self._end
        self.parser.CharacterDataHandler = self._text
        self.parser.StartDoctypeDeclHandler = self._doctype

    def _start(self, tag: str, attributes: dict[str, str]) -> None:
        line = self.parser.CurrentLineNumber
        if len(self._open) >= MOST_LEVELS:
            raise ManifestError(
                "rules",
                say("tags nested more than {count} deep", count=MOST_LEVELS),
                line,
            )
        if len(self.found) >= MOST_ELEMENTS:
            raise ManifestError("rules", say("more than {count} tags", count=MOST_ELEMENTS), line)
        self._open.append((tag, line, attributes, []))

    def _text(self, text: str) -> None:
        if self._open:
            self._open[-1][3].append(text)

    def _end(self, tag: str) -> None:
        _, line, attributes, text = self._open.pop()
        within = self._open[-1][0] if self._open else ""
        self.found.append(Element(tag, within, line, "".join(text).strip(), attributes))

    def _doctype(self, *_: object) -> None:
        raise ManifestError(
            "doctype",
            say("it declares a document type (<!DOCTYPE>)"),
            self.parser.CurrentLineNumber,
        )


def _elements(found: bytes) -> tuple[Element, ...]:
    reader = _Reader()
    try:
        reader.parser.Parse(found, True)
    except expat.ExpatError as error:
        text = expat.ErrorString(error.code) or "not XML"
        lines = max(1, len(found.splitlines()))  # (expat counts the end of the file as a line)
        raise ManifestError("xml", text, min(error.lineno, lines)) from None
    except (ValueError, LookupError) as error:  # an encoding that expat or Python does not know
        raise ManifestError("xml", str(error), 1) from None
    return tuple(reader.found)


def name_in(found: bytes) -> str | None:
    """Return the text of the first <name>, even if the package.xml is not valid XML."""
    encoding = "utf-16" if found[:2] in (b"\xff\xfe", b"\xfe\xff") else "utf-8"
    text = _without_comments(found.decode(encoding, "replace"))
    match = re.search(r"<name(?:\s[^<>]{0,200})?>\s{0,50}([^<>]{1,200}?)\s{0,50}</name", text)
    return match.group(1).strip() or None if match else None


def _without_comments(text: str) -> str:
    kept = []
    while True:
        before, opened, rest = text.partition("<!--")
        kept.append(before)
        if not opened:
            return "".join(kept)
        text = rest.partition("-->")[2]
