"""Use `wtf` as alias to `doctor`."""

from .doctor import add_arguments, main

__all__ = ["add_arguments", "main"]
