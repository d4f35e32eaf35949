"""The folders of the project's own files: in a checkout, or installed as a ROS package."""

from __future__ import annotations

from pathlib import Path

PACKAGE = Path(__file__).resolve().parents[1]
"""The folder of the Python package `grader`."""

CHECKOUT = PACKAGE.parent
"""The parent folder: the checkout, or `site-packages`."""

SHARES = [parent / "share" / "ros2_teaching_lab" for parent in PACKAGE.parents]
"""Where the installed package's data files may be (`share` of its prefix)."""
