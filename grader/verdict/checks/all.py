"""Every built-in check, in the order in which they are asked (a cause before what it causes)."""

from __future__ import annotations

from grader.verdict.checks import build, counting, installed, package, source, starting, timing
from grader.verdict.registry import Check

CHECKS: dict[str, Check] = {
    declared.id: declared
    for declared in (
        package.found,
        package.manifest,
        package.marker,
        package.setup_cfg,
        source.node_file,
        source.exec_bit,
        source.shebang,
        installed.mapping,
        build.colcon_builds,
        installed.executable,
        starting.starts,
        starting.node_name,
        counting.output,
        counting.logger,
        timing.period,
        starting.interrupt,
    )
}
