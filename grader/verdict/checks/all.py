"""All built-in checks in the order of evaluation: each after those that it depends on."""

from __future__ import annotations

from grader.verdict.checks import (
    build,
    counting,
    installed,
    package,
    source,
    spinning,
    starting,
    timing,
)
from grader.verdict.checks.declare import Check

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
        spinning.spins,
        starting.node_name,
        counting.output,
        counting.logger,
        timing.period,
        starting.interrupt,
    )
}
