"""Nodes in the style of strangers, each a file in `strangers/`: threads, executors, clocks.

They were written without looking at the checks, and deserve full marks. The lines with which nearly
all of them begin and end are here.
"""

from __future__ import annotations

import re
from pathlib import Path

from grader.package.edit.tree import Write

from .model import NODE, Package, right
from .right_node import CATCH

FIRST = "#!/usr/bin/env python3\n"
MAIN = f"""

def main(args=None):
    rclpy.init(args=args)
    node = {{node}}()
{CATCH}"""
LAST = "\n\nif __name__ == '__main__':\n    main()\n"


def stranger(file: Path) -> Package:
    """Return the package with the node in a file; its last class is spun if it has no main."""
    text = file.read_text(encoding="utf-8")
    if "def main(" not in text:
        text += MAIN.format(node=re.findall(r"^class (\w+)", text, re.MULTILINE)[-1])
    return right(f"stranger_{file.stem}", Write(NODE, FIRST + text + LAST, 0o755))


FILES = sorted(Path(__file__).with_name("strangers").glob("*.py"))
STRANGERS = tuple(stranger(file) for file in FILES)
