"""The Python programs of a prefix: each is run by the `python3` beside it, wherever both are seen.

pip names the Python that it ran on, which is one of the checkout's environment: the prefix outlives
it. The base interpreter cannot be named either. A `#!` line ends at the first space and after 127
bytes (255 from Linux 5.1 on), so pip itself writes three lines of shell instead if that Python's
path does not fit. And the path by which a program's Python was started is what setuptools writes
into the `#!` line of the student's own executables, and what colcon writes, without quotes, into
`install/local_setup.sh`. So it has to be a path that fits: the one below the prefix, which students
see at `/opt/ros/<distro>`.
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
"""sh replaces itself by Python; Python reads the lines below the first as a string."""

SHELL_FORM = re.compile(rb"#!/bin/sh\n'''exec' .*?\n' '''\n", re.DOTALL)
LINE_FORM = re.compile(rb'#(?=!)[^\n]*[!/ "]python[\d.]*"?(?:[ \t][^\n]*)?\n')


def use_own_python(folder: Path, installer: str) -> None:
    """Have the Python programs in a folder run by the `python3` in it.

    `installer` is the Python that has installed them; pip names it in every form that it writes.
    """
    for script in folder.iterdir():
        if script.is_file() and not script.is_symlink():
            code = without_header(script.read_bytes(), installer)
            if code is not None:
                script.write_bytes(HEADER + code)


def without_header(script: bytes, installer: str) -> bytes | None:
    """Return a Python program without the lines that name its Python, None for any other program.

    (The installer's own name comes first: a newline in it makes two lines of the `#!` line.)
    """
    named = re.compile(rb"#!" + re.escape(os.fsencode(installer)) + rb"[^\n]*\n")
    for form in (named, SHELL_FORM, LINE_FORM):
        found = form.match(script)
        if found:
            return script[found.end() :]
    return None
