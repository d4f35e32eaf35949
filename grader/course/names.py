"""The forms of the names in an assignment."""

from __future__ import annotations

# REP 144 for packages; the ROS design article "Topic and Service name mapping" for nodes.
NAMES = {  # key: its pattern, and the pattern in words
    "id": (r"[a-z][a-z0-9_]*", "lower case letters, digits and _, starting with a letter"),
    "package": (r"[a-z][a-z0-9_]*", "lower case letters, digits and _, starting with a letter"),
    "node_name": (r"[A-Za-z_][A-Za-z0-9_]*", "letters, digits and _, not starting with a digit"),
    "executable": (
        r"[A-Za-z_][A-Za-z0-9_.-]*",
        "letters, digits, _, - and ., starting with a letter",
    ),
    "node_file": (
        r"[A-Za-z_][A-Za-z0-9_]*\.py",
        "the name of a Python file without a folder, such as my_node.py",
    ),
    "target": (
        r"[A-Za-z_]\w*(\.[A-Za-z_]\w*)*:[A-Za-z_]\w*",
        "module.path:function, such as my_package.my_node:main",
    ),
}
