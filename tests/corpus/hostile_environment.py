"""Packages whose environment, not whose entry point, decides what runs.

What runs is what the sources say: colcon and ament make the environment, and `ros2 run` starts the
program that answers.
"""

from __future__ import annotations

from grader.package.edit.tree import Copy, Edit, Replace, Write

from .hostile_edits import first
from .model import AFTER_START, NODE, RUN, SETUP, Package, hostile

SHARE = "share/my_robot_controller"
REAL = "resource/real.txt"
GOODBYE = Replace(NODE, "'Hello time: '", "'Goodbye: '")
WITH_REAL: tuple[Edit, ...] = (Copy(NODE, REAL), GOODBYE)
HERE = "os.path.expanduser('~/ros2_ws/src/my_robot_controller/resource/real.txt')"
PREFIX = f"""
import os
for name, text in (
    ('share/ament_index/resource_index/packages/my_robot_controller', ''),
    ('share/colcon-core/packages/aaa', ''),
    ('share/aaa/package.dsv', 'prepend-non-duplicate;AMENT_PREFIX_PATH;\\n'),
    ('lib/my_robot_controller/test_node', '#!/bin/sh\\nexec python3 ' + {HERE} + ' "$@"\\n'),
):
    path = '../../install/aaa/' + name
    os.makedirs(os.path.dirname(path), exist_ok=True)
    with open(path, 'w') as file:
        file.write(text)
    os.chmod(path, 0o755)
"""


def _installs(folder: str, *files: str) -> Edit:
    """Install files of the package below its prefix."""
    line = f"        ({folder!r}, {list(files)!r}),\n"
    return Replace(SETUP, "    data_files=[\n", f"    data_files=[\n{line}")


def _environment(name: str, *edits: Edit, note: str = "") -> Package:
    return hostile(
        name,
        *edits,
        failed={"entry_point.executable": "entry_point.other_installed"},
        skipped=RUN,
        note=note,
    )


ENVIRONMENTS = (
    _environment(
        "hook_that_is_sourced",
        *WITH_REAL,
        Write("colcon.pkg", f'{{"hooks": ["{SHARE}/hook/x.sh"]}}\n'),
        Write("hook/x.sh", f'exec python3 "$PWD/src/my_robot_controller/{REAL}"\n'),
        _installs(f"{SHARE}/hook", "hook/x.sh"),
    ),
    _environment(
        "hook_that_sets_a_variable",
        Write("colcon.pkg", f'{{"hooks": ["{SHARE}/hook/x.dsv"]}}\n'),
        Write("hook/x.dsv", "set;PYTHONSTARTUP;share/x.py\n"),
        _installs(f"{SHARE}/hook", "hook/x.dsv"),
    ),
    _environment(
        "module_that_python_imports_at_start",
        Write("sitecustomize.py", "print('first')\n"),
        Replace(SETUP, "    zip_safe", "    py_modules=['sitecustomize'],\n    zip_safe"),
    ),
    _environment(
        "ros2_of_its_own",
        Write("bin/ros2", "#!/bin/sh\necho mine\n", 0o755),
        _installs("bin", "bin/ros2"),
    ),
    _environment("package_in_a_second_prefix", *WITH_REAL, Replace(SETUP, "setup(\n", f"{PREFIX}\nsetup(\n")),
    hostile(
        "another_program_in_its_place",
        *WITH_REAL,
        first(f"    import os, sys\n    os.execv(sys.executable, [sys.executable, {HERE}, *sys.argv[1:]])\n"),
        failed={"run.starts": "entry_point.other_installed"},
        skipped=AFTER_START,
    ),
)  # fmt: skip
