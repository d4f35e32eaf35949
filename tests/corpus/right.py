"""Packages that deserve full marks, written in different ways."""

from __future__ import annotations

from .model import Package
from .right_node import COUNTING
from .right_nodes import NODES
from .right_package import PACKAGING
from .right_strangers import STRANGERS
from .right_style import STYLE
from .right_timing import TIMING

RIGHT: tuple[Package, ...] = (*COUNTING, *NODES, *TIMING, *PACKAGING, *STYLE, *STRANGERS)
