"""Installs turtlesim's programs into a wheels prefix with interfaces, where `ros2 run` finds them.

The package `turtlesim` has them in every distro, also where the interfaces are in another package.
"""

from __future__ import annotations

import shutil
import subprocess
from pathlib import Path

from grader.ros.distro import HERE
from grader.ros.interface_package import MANIFEST

PACKAGE = "turtlesim"
PROGRAMS = HERE / "turtlesim_programs"
WORLD = HERE.parent / "run" / "in_probe" / "turtlesim.py"  # the marking's
MODULE = "wheels_turtlesim"
EXECUTABLES = {
    "draw_square": "draw_square",
    "mimic": "mimic",
    "turtle_teleop_key": "teleop",
    "turtlesim_node": "node",
}
"""The module of each executable."""

SCRIPT = """\
#!/bin/sh
'''exec' "${{0%/*}}/../../bin/python3" "$0" "$@"
' '''
import signal

signal.pthread_sigmask(signal.SIG_BLOCK, (signal.SIGINT, signal.SIGTERM))  # see program.End
from {package}.{module} import main

raise SystemExit(main())
"""
"""For sh, line 2 runs the prefix's Python (see `scripts`); for Python, lines 2 and 3 are a string."""


def program_sources() -> list[Path]:
    """Return the files of which the programs are made."""
    return [*sorted(PROGRAMS.glob("*.py")), WORLD]


def install_programs(prefix: Path, interpreter: Path) -> None:
    """Install the programs and, if the prefix has none, the package `turtlesim`."""
    site = next((prefix / "lib").glob("python3*/site-packages"))
    target = site / MODULE
    target.mkdir()
    for source in program_sources():
        shutil.copy(source, target / ("world.py" if source == WORLD else source.name))
    compile_ = [str(interpreter), "-I", "-m", "compileall", "-q", str(target)]
    subprocess.run(compile_, check=False)  # only saves time
    folder = prefix / "lib" / PACKAGE
    folder.mkdir()
    for name, module in EXECUTABLES.items():
        script = folder / name
        script.write_text(SCRIPT.format(package=MODULE, module=module), encoding="utf-8")
        script.chmod(0o755)
    _add_package(prefix)


def _add_package(prefix: Path) -> None:
    share = prefix / "share"
    manifest = share / PACKAGE / "package.xml"
    if manifest.exists():
        return
    manifest.parent.mkdir()
    manifest.write_text(MANIFEST.format(name=PACKAGE), encoding="utf-8")
    (share / "ament_index" / "resource_index" / "packages" / PACKAGE).touch()
