"""Remembers what was read from the last few files: checks, diagnosis and fixes read the same."""

from __future__ import annotations

from collections.abc import Callable
from functools import lru_cache, wraps
from typing import ParamSpec, TypeVar, cast

Arguments = ParamSpec("Arguments")
Result = TypeVar("Result")

MOST_BYTES = 20_000
"""What was read from larger files is not kept: a tree needs up to 300 bytes for one of text."""
FILES = 16


def keep_small(read: Callable[Arguments, Result]) -> Callable[Arguments, Result]:
    """Return `read`, remembering its last results; its last argument is a file's bytes.

    The result is shared: nobody may change it.
    """
    kept = cast(Callable[Arguments, Result], lru_cache(maxsize=FILES)(read))

    @wraps(read)
    def reading(*arguments: Arguments.args, **named: Arguments.kwargs) -> Result:
        small = len(cast(bytes, arguments[-1])) <= MOST_BYTES
        return kept(*arguments, **named) if small else read(*arguments, **named)

    return reading
