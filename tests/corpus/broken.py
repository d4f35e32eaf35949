"""Packages with mistakes that beginners make, by the stage at which they show."""

from __future__ import annotations

from .broken_build import BUILD
from .broken_callback import CALLBACK
from .broken_entry import ENTRY_POINT
from .broken_output import OUTPUT
from .broken_package import PACKAGES
from .broken_source import SOURCE
from .broken_spin import SPIN
from .broken_start import START
from .model import Package

BROKEN: tuple[Package, ...] = (
    *PACKAGES,
    *SOURCE,
    *BUILD,
    *ENTRY_POINT,
    *START,
    *SPIN,
    *CALLBACK,
    *OUTPUT,
)
