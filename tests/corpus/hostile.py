"""Hostile packages: they need a sandbox, and must harm nothing and gain nothing."""

from __future__ import annotations

from .hostile_environment import ENVIRONMENTS
from .hostile_node import NODES
from .hostile_points import POINTS_ATTACKS
from .hostile_setup import SETUPS
from .hostile_world import WORLD
from .model import Package

HOSTILE: tuple[Package, ...] = (*NODES, *SETUPS, *POINTS_ATTACKS, *WORLD, *ENVIRONMENTS)
WAITED_FOR = (
    *("sleeps_twice", "stops_itself", "setup_makes_unreadable_folders"),
    *("forged_lines", "setup_deaf", "deaf_for_fifteen_seconds"),
)
"""Packages whose verdict is waited for, ten seconds and more: `make test-long`, not CI."""
