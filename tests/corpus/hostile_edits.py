"""Edits that the hostile packages share: where in the solution their code is put."""

from __future__ import annotations

from grader.package.edit.tree import Edit, Replace

from .model import NODE, SETUP
from .right_node import LINE, STEP

MADE = "    node = MyFirstNode()\n"
INIT = "    rclpy.init(args=args)\n"
CALL = "\nsetup(\n"


def imports(*names: str) -> Edit:
    """Import modules in the node's file."""
    lines = "".join(f"import {name}\n" for name in names)
    return Replace(NODE, "import rclpy\nfrom", f"{lines}import rclpy\nfrom")


def first(code: str) -> Edit:
    """Run the code before rclpy.init."""
    return Replace(NODE, INIT, code + INIT)


def made(code: str) -> Edit:
    """Run the code when the node is made."""
    return Replace(NODE, MADE, MADE + code)


def third(code: str) -> Edit:
    """Run one line of code after the third tick."""
    return Replace(NODE, STEP, f"{STEP}\n        if self.counter_ == 3:\n            {code}")


def only_if(condition: str, before: str = "") -> Edit:
    """Log only if the condition holds; `before` are lines of the callback."""
    log = f"        {LINE}\n"
    return Replace(NODE, log, f"{before}        if {condition}:\n    {log}")


def in_setup(code: str) -> Edit:
    """Run the code in setup.py, before it calls setup."""
    return Replace(SETUP, CALL, code + CALL)
