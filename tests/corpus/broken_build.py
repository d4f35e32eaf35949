"""Packages whose setup.py fails when colcon runs it."""

from __future__ import annotations

from grader.validate.tree import Delete, Edit, Replace

from .model import BUILT, INSTALLED, SETUP, Package, broken

CALL = "\nsetup(\n"


def _stops(name: str, *edits: Edit, mistake: str, mapping: bool = True, note: str = "") -> Package:
    """Return a package whose setup.py fails; `mapping`: its entry point can still be read."""
    blocked = INSTALLED if mapping else INSTALLED | {"entry_point.mapping"}
    return broken(
        name,
        *edits,
        failed={"build.colcon": mistake},
        skipped=blocked,
        score=50 if mapping else 40,
        note=note,
    )


BUILD = (
    _stops("setup_syntax_error", Replace(SETUP, "    version='0.0.0',", "    version='0.0.0'"),
           mistake="build.setup_error", mapping=False),
    _stops("setup_indentation", Replace(SETUP, "    zip_safe=True,\n", "    zip_safe=True,\n  )\n"),
           mistake="build.setup_error", mapping=False),
    _stops("setup_name_error", Replace(SETUP, CALL, "\nprint(pakage_name)\nsetup(\n"),
           mistake="build.setup_error"),
    _stops("setup_import_error",
           Replace(SETUP, "from setuptools import setup", "from setuptool import setup"),
           mistake="build.setup_error"),
    _stops("setup_raises", Replace(SETUP, CALL, "\nraise RuntimeError('not today')\nsetup(\n"),
           mistake="build.setup_error"),
    _stops("setup_exits", Replace(SETUP, CALL, "\nimport sys\nsys.exit(0)\nsetup(\n"),
           mistake="build.exited"),
    _stops("setup_never_called", Replace(SETUP, CALL, "\ndict(\n"), mistake="build.exited",
           mapping=False),
    _stops("setup_prints", Replace(SETUP, CALL, "\nprint('building')\nsetup(\n"),
           mistake="build.setup_prints", note="colcon reads what setup.py prints as its answer"),
    _stops("setup_loops", Replace(SETUP, CALL, "\nwhile True:\n    pass\n\nsetup(\n"),
           mistake="build.timeout"),
    broken("setup_missing", Delete(SETUP), failed={"entry_point.mapping": "setup.missing"},
           skipped=BUILT, score=40),
    _stops("setup_data_file_missing",
           Replace(SETUP, "['package.xml']", "['package.xml', 'launch/hello.launch.py']"),
           mistake="build.failed", note="error: can't copy 'launch/hello.launch.py'"),
)  # fmt: skip
