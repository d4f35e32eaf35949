"""Packages that need a sandbox: what they may do is survive, what they may not is win."""

from __future__ import annotations

from .hostile_node import NODES
from .hostile_setup import SETUPS
from .model import Package

HOSTILE: tuple[Package, ...] = (*NODES, *SETUPS)
