"""Packages that deserve full marks, written in different ways."""

from __future__ import annotations

from .model import Package
from .right_node import COUNTING
from .right_package import PACKAGING
from .right_style import STYLE
from .right_timing import TIMING

RIGHT: tuple[Package, ...] = (*COUNTING, *TIMING, *PACKAGING, *STYLE)
