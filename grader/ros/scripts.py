"""Makes the Python programs of a prefix run with the `python3` in their own folder.

pip writes the path of its own Python into them, which belongs to the checkout's environment; the
prefix outlives that. The path of the base interpreter does not work either: a `#!` line ends at the
first space and after 127 bytes (255 since Linux 5.1), so pip writes three lines of shell if the
path does not fit. In addition, setuptools writes the path by which its Python was started into the
`#!` line of the student's executables, and colcon writes it, unquoted, into
`install/local_setup.sh`. So the path must be short and plain: it is the one in the prefix, which is
`/opt/ros/<distro>` for students.
"""

from __future__ import annotations

import os
import re
from pathlib import Path

HEADER = b"""\
#!/bin/sh
'''exec' "${0%/*}/python3" "$0" "$@"
' '''
"""
"""For sh, line 2 executes Python; for Python, lines 2 and 3 are a string."""

OWN = HEADER.partition(b'" ')[0]
"""How a program begins that runs with that Python, whatever options Python is given."""

SHELL_FORM = re.compile(rb"#!/bin/sh\n'''exec' .*?\n' '''\n", re.DOTALL)
LINE_FORM = re.compile(rb'#(?=!)[^\n]*[!/ "]python[\d.]*"?(?:[ \t][^\n]*)?\n')


def use_own_python(folder: Path, installer: str) -> None:
    """Make the Python programs in a folder run with the `python3` in it.

    `installer` is the Python that installed them, whose path pip has written into them.
    """
    for script in folder.iterdir():
        if script.is_file() and not script.is_symlink():
            text = script.read_bytes()
            if text.startswith(OWN):
                continue  # done before; the file may be a hard link to that of another prefix
            code = without_header(text, installer)
            if code is not None:
                script.write_bytes(HEADER + code)


def without_header(script: bytes, installer: str) -> bytes | None:
    """Return a Python program without the lines that name its Python, None if it is not Python.

    (The installer's path is tried first: a newline in it splits the `#!` line in two.)
    """
    named = re.compile(rb"#!" + re.escape(os.fsencode(installer)) + rb"[^\n]*\n")
    for form in (named, SHELL_FORM, LINE_FORM):
        found = form.match(script)
        if found:
            return script[found.end() :]
    return None
