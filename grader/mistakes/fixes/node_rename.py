"""Fixes of a variable that hides the class of the object that it gets."""

from __future__ import annotations

import keyword
import re

from grader.package.source.module import Module

VARIABLES = ("node", "my_node")
"""Names for the variable of a node; the first one that the file does not use is proposed."""


def free_variable(module: Module, name: str) -> str:
    """Return a name for a variable that the file does not use yet; "" if there is none."""
    small = "_".join(re.findall(r"[A-Z]+[a-z0-9]*|[a-z0-9]+", name)).lower()
    tries = [*VARIABLES, small]
    taken = {*module.names, *keyword.kwlist}
    return next((t for t in tries if t.isidentifier() and t not in taken), "")
