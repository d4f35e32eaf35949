"""What is in the braces of an f-string and is no value: the slip, and the file after the fix."""

from __future__ import annotations

import pytest

from grader.package.source.python import can_parse
from grader.package.source.slips import slip_of

FIELDS = [
    ("def a(self):\n    b(f'x {self.n += 1}')\n", "field_changes",
     "def a(self):\n    b(f'x {self.n}')\n    self.n += 1\n"),
    ("b(f'x {n++}')\n", "field_changes", "b(f'x {n}')\nn += 1\n"),
    ("b(f'x {n = n + 1}')\r\nc()\r\n", "field_changes", "b(f'x {n}')\r\nn = n + 1\r\nc()\r\n"),
    ("b(f'x {n += 1}')\nn += 1\n", "field_sets", "b(f'x {n}')\nn += 1\n"),
    ("b(f'x {n = 1}')\n", "field_sets", ""),
    ("b(f'x {n += 1}',\n  c)\n", "field_changes", ""),
    ("b(f'x {}')\n", "field_empty", ""),
    ("b(f'x {}'.format(n))\n", "field_format", "b('x {}'.format(n))\n"),
    ("b(f'x {n)')\n", "brace_kind", "b(f'x {n}')\n"),
    ("b(f'x {n}}')\n", "brace_twice", "b(f'x {n}')\n"),
    ("b(f'x {n')\n", "brace", "b(f'x {n}')\n"),
]  # fmt: skip


@pytest.mark.parametrize(("text", "variant", "fixed"), FIELDS)
def test_what_is_no_value_in_braces_is_named(text: str, variant: str, fixed: str) -> None:
    slip = slip_of(text.encode())
    assert slip is not None
    assert (slip.variant, (slip.fixed or b"").decode()) == (variant, fixed)
    assert not fixed or can_parse(fixed.encode())


@pytest.mark.parametrize("text", ["f'{n=}'\n", "f'{(n := 1)}'\n", "f'{n:=+4}'\n", "'{n += 1}'\n"])
def test_right_braces_have_no_slip(text: str) -> None:
    assert slip_of(text.encode()) is None


def test_a_late_import_of_the_future_is_moved_above_the_others() -> None:
    head, future = '#!/usr/bin/env python3\n"""Doc."""\n\n', "from __future__ import annotations\n"
    slip = slip_of(f"{head}import a\n{future}b = a\n".encode())
    assert slip is not None
    assert (slip.variant, slip.line) == ("future_late", 5)
    assert (slip.fixed or b"").decode() == f"{head}{future}import a\nb = a\n"
