"""The checks: one module for each stage. This one is light to import: it only knows their ids."""

from __future__ import annotations

_IDS = (
    "package.found",
    "package.manifest",
    "package.marker",
    "package.setup_cfg",
    "source.node_file",
    "source.exec_bit",
    "source.shebang",
    "build.colcon",
    "entry_point.mapping",
    "entry_point.executable",
    "run.starts",
    "run.node_name",
    "run.output",
    "run.logger",
    "run.period",
    "run.interrupt",
)


def known_ids() -> tuple[str, ...]:
    """Return the ids of the built-in checks, in the order of the course's exercise."""
    return _IDS
