"""Hostile packages: they need a sandbox, and must harm nothing and gain nothing."""

from __future__ import annotations

from .hostile_node import NODES
from .hostile_points import POINTS_ATTACKS
from .hostile_setup import SETUPS
from .hostile_world import WORLD
from .model import Package

HOSTILE: tuple[Package, ...] = (*NODES, *SETUPS, *POINTS_ATTACKS, *WORLD)
WAITED_FOR = ("sleeps_twice", "stops_itself", "setup_makes_unreadable_folders")
"""Packages whose verdict is waited for, half a minute and more: `make test-long`, not CI."""
