"""The parameters of a kind of check, as an assignment gives them."""

from __future__ import annotations

from grader.base.part import Part

EDGE = 1e-6  # s by which an instant may be outside a window


class Parameters(Part):
    """The parameters of a kind of check: the keys of its `with:`."""
