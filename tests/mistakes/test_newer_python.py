"""F-strings that only Python 3.12 and later can read: what is told on each distro."""

from __future__ import annotations

from pathlib import Path

import pytest

from grader.package.source.newer_python import with_older_quotes
from grader.package.source.python import can_parse
from grader.ros.distro import find_distro
from grader.verdict.checks import source
from grader.verdict.evidence import Evidence
from grader.verdict.outcome import Failed
from tests.static_bench import NODE, Bench


@pytest.mark.parametrize(
    ("text", "older"),
    [
        ("f'a {b['c']}'\n", "f'a {b[\"c\"]}'\n"),
        ('f"{a["b"]} {c["d"]:>3}"\n', "f\"{a['b']} {c['d']:>3}\"\n"),
        ("# f'\nf'{{ {a('b')} }}'\n", "# f'\nf'{{ {a(\"b\")} }}'\n"),
        ("rf'{a['b']}'\n", "rf'{a[\"b\"]}'\n"),
    ],
)
def test_the_quotes_in_the_values_are_changed(text: str, older: str) -> None:
    assert with_older_quotes(text) == older
    assert can_parse(text.encode())
    assert len(older) == len(text)


@pytest.mark.parametrize(
    "text",
    [
        "f'a {b[\"c\"]}'\n",
        "'{b['c']}'\n",
        "f'a {b['c'}'\n",
        "f'a {b['c\"']}'\n",
        "f'a {b\n",
        "f'{a[f'{b}']}'\n",
        "f'''{a['b']}'''\n",
    ],
)
def test_other_texts_stay(text: str) -> None:
    assert with_older_quotes(text) is None


QUOTED = """\
#!/usr/bin/env python3
import os


def main(args=None):
    print(f'{os.environ['HOME']}')
"""


def evidence(folder: Path, distro: str) -> Evidence:
    bench = Bench(folder / "my_robot_controller")
    bench.write(NODE, QUOTED)
    found = bench.evidence()
    found.distro = find_distro(distro)
    return found


def test_jazzys_python_reads_them(tmp_path: Path) -> None:
    assert source.node_file.function(evidence(tmp_path, "jazzy"))


def test_humbles_python_does_not(tmp_path: Path) -> None:
    found = evidence(tmp_path, "humble")
    with pytest.raises(Failed) as told:
        source.node_file.function(found)
    assert told.value.variant == "write"
    assert told.value.where is not None
    assert told.value.where.line == 6
    assert told.value.words["wanted"] == "print(f'{os.environ[\"HOME\"]}')"
