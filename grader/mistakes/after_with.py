"""The mistake of a node that spins below the `with` block at whose end ROS is shut down."""

from __future__ import annotations

NO_CONTEXT = (
    r"'NoneType' object does not support the context manager protocol|AttributeError: __enter__"
    r"|RuntimeError: Context must be initialized"
)
