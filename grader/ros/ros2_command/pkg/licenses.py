"""The licenses that ament knows, and their texts.

The texts are the standard ones without a copyright line, as in ament: Apache-2.0, GPL-3 and
LGPL-3 from Debian's ``/usr/share/common-licenses``, the rest from the SPDX list (PyPI's
``spdx`` 2.5.1), wrapped as in ament. BSD-2.0 is ament's name for the three-clause text with a title.
"""

from pathlib import Path

LICENSES = (
    "Apache-2.0",
    "BSL-1.0",
    "BSD-2.0",
    "BSD-2-Clause",
    "BSD-3-Clause",
    "GPL-3.0-only",
    "LGPL-3.0-only",
    "MIT",
    "MIT-0",
)


def license_text(identifier: str) -> str:
    """Return the text of one of `LICENSES`.

    Raises OSError if its data file is missing.
    """
    path = Path(__file__).parent.parent / "licenses" / f"{identifier}.txt"
    return path.read_text(encoding="utf-8")
