"""The ids of the built-in checks, in the order of the course's exercise.

The checks themselves are in grader/verdict/checks, which this package may not import.
"""

from __future__ import annotations

CHECK_IDS = (
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
    "run.spins",
    "run.node_name",
    "run.output",
    "run.logger",
    "run.period",
    "run.interrupt",
)
