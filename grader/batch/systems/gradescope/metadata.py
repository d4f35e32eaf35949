"""Reads Gradescope's `submission_metadata.yml`, most of which are results that are not needed."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from datetime import datetime, timezone
from typing import Any

import yaml

Record = Mapping[str, Any]

STAMP = re.compile(
    r"(?P<day>\d{4}-\d\d-\d\d)[T ](?P<time>\d\d:\d\d:\d\d)(?:\.\d+)?"
    r"\s*(?P<zone>Z|UTC|[+-]\d\d:?\d\d)?"
)
KEY = re.compile(r"  (:\w+):")
WHOLE = (":submitters", ":created_at")


def read_metadata(content: bytes) -> dict[str, Record]:
    """Return each submission's record by the name of its folder; raise ValueError if invalid.

    Results and histories can be megabytes. If the file is laid out as Ruby writes it, they are
    skipped before the rest is parsed.
    """
    lean = "".join(_lean(content.decode("utf-8", "replace")))
    try:
        found = _records(_load(lean.encode()))
        if all(isinstance(record.get(":submitters"), list) for record in found.values()):
            return found
    except ValueError:
        pass  # an anchor that was skipped, for example
    return _records(_load(content))


def _lean(text: str) -> Iterator[str]:
    """Yield the lines of submitters and times, and the first line of each earlier attempt."""
    key = ""
    for line in text.split("\n"):
        if line.strip() and not line.startswith(" "):
            key = ""
        elif match := KEY.match(line):
            key = match[1]
        if key in ("", *WHOLE) or (key == ":history" and line.startswith(("  :", "  - :id:"))):
            yield f"{line}\n"


def _records(loaded: object) -> dict[str, Record]:
    if not isinstance(loaded, dict):
        raise ValueError("it lists no submissions")
    return {
        name: value
        for name, value in loaded.items()
        # (a name with a path would lead out of the folder)
        if isinstance(name, str) and name not in ("", ".", "..") and not set(name) & set("/\0")
        if isinstance(value, dict)
    }


def _load(content: bytes) -> object:
    """Parse YAML; a Ruby object becomes its plain data. Raise ValueError if it is not YAML."""
    base = getattr(yaml, "CSafeLoader", yaml.SafeLoader)
    loader = type("Loader", (base,), {})

    def ruby(loader: Any, suffix: str, node: Any) -> Any:
        del suffix
        if isinstance(node, yaml.MappingNode):
            return loader.construct_mapping(node, deep=True)
        if isinstance(node, yaml.SequenceNode):
            return loader.construct_sequence(node, deep=True)
        return loader.construct_scalar(node)

    yaml.add_multi_constructor("!ruby/", ruby, Loader=loader)
    try:
        return yaml.load(content, Loader=loader)  # noqa: S506 - a SafeLoader
    except yaml.YAMLError as error:
        raise ValueError(str(error)) from None


def instant(value: object) -> datetime | None:
    """Return a time stamp in UTC, None if it is not one; without a zone it is UTC, as in Rails."""
    if isinstance(value, dict):  # ActiveSupport::TimeWithZone
        value = value.get("utc")
    if isinstance(value, str):
        match = STAMP.match(value)
        if match is None:
            return None
        zone = (match["zone"] or "Z").replace(":", "")
        zone = "+0000" if zone in ("Z", "UTC") else zone
        try:
            value = datetime.strptime(
                f"{match['day']} {match['time']}{zone}", "%Y-%m-%d %H:%M:%S%z"
            )
        except ValueError:
            return None
    if not isinstance(value, datetime):
        return None
    if value.tzinfo is None:
        return value.replace(tzinfo=timezone.utc)
    try:
        return value.astimezone(timezone.utc)
    except (ValueError, OverflowError):
        return None
