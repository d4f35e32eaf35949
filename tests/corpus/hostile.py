"""Hostile packages: they need a sandbox, and must harm nothing and gain nothing."""

from __future__ import annotations

from .hostile_node import NODES
from .hostile_points import POINTS_ATTACKS
from .hostile_setup import SETUPS
from .hostile_world import WORLD
from .model import Package

HOSTILE: tuple[Package, ...] = (*NODES, *SETUPS, *POINTS_ATTACKS, *WORLD)
