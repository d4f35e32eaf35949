"""The programs of a prefix run wherever it is; in these tests the real pip writes them."""

from __future__ import annotations

import os
import subprocess
import sys
import sysconfig
import zipfile
from pathlib import Path

import pytest

from grader.ros.prefix import base_interpreter
from grader.ros.scripts import HEADER, use_own_python, without_header

CODE = "def main():\n    import sys\n    print([sys.executable, *sys.argv])\n"
SCRIPT = "import sys\nprint([sys.executable, *sys.argv])\n"
SHELL = "#!/bin/sh\necho shell\n"
WHEEL = {
    "tiny.py": CODE,
    "tiny-1.data/scripts/plain": f"#!python\n{SCRIPT}",
    "tiny-1.data/scripts/isolated": f"#!python -I\n{SCRIPT}",
    "tiny-1.data/scripts/shell": SHELL,
    "tiny-1.dist-info/entry_points.txt": "[console_scripts]\ntiny = tiny:main\n"
    "[gui_scripts]\ntinier = tiny:main\n",
    "tiny-1.dist-info/METADATA": "Metadata-Version: 2.1\nName: tiny\nVersion: 1\n",
    "tiny-1.dist-info/WHEEL": "Wheel-Version: 1.0\nRoot-Is-Purelib: true\nTag: py3-none-any\n",
    "tiny-1.dist-info/RECORD": "",
}
PROGRAMS = ("tiny", "tinier", "plain", "isolated")
FOLDERS = [
    "s",
    "some path ü",
    "l" * 150,
    "it's",
    'a "b"',
    "$HOME `id`",
    "new\nline",
    "new line\nand spaces",
]
HEADER_OF_SETUPTOOLS = (
    "from setuptools.command.easy_install import ScriptWriter; print(end=ScriptWriter.get_header())"
)


@pytest.fixture(scope="module")
def wheel(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("w") / "tiny-1-py3-none-any.whl"
    with zipfile.ZipFile(path, "w") as archive:
        for name, text in WHEEL.items():
            entry = zipfile.ZipInfo(name)
            entry.external_attr = 0o100755 << 16  # pip keeps a script's mode
            archive.writestr(entry, text)
    return path


def environment(folder: Path) -> Path:
    """Return the Python of a virtual environment, made of two files (PEP 405)."""
    python = folder / "bin" / "python"
    python.parent.mkdir(parents=True)
    python.symlink_to(base_interpreter())
    (folder / "pyvenv.cfg").write_text(f"home = {base_interpreter().parent}\n")
    return python


def output_of(command: list[str | Path], *, path: str = "", **variables: str) -> str:
    done = subprocess.run(
        command,
        env={"PATH": f"{path}:/usr/bin:/bin", "LANG": "C.UTF-8", **variables},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


def installed(folder: Path, wheel: Path) -> tuple[Path, Path]:
    """Install the wheel like those of a prefix; return the prefix and the Python used."""
    python = environment(folder / ".venv")
    words = ["--quiet", "--no-index", "--no-deps", "--no-warn-script-location", "--prefix"]
    ours = sysconfig.get_path("purelib")
    output_of([python, "-m", "pip", "install", *words, folder / "prefix", wheel], PYTHONPATH=ours)
    return folder / "prefix", python


@pytest.mark.parametrize(
    "name",
    [
        pytest.param(name, id=str(n), marks=() if n < 2 else pytest.mark.long)
        for n, name in enumerate(FOLDERS)
    ],
)
def test_programs_written_by_pip_run_wherever_the_prefix_is(
    name: str, tmp_path: Path, wheel: Path
) -> None:
    made, python = installed(tmp_path / name, wheel)
    # an interpreter whose path does not fit into a `#!` line
    other = tmp_path / "my pythons" / "python3"
    other.parent.mkdir()
    other.symlink_to(base_interpreter())
    (made / "bin" / "python3").symlink_to(other)
    (made / "bin" / "data").write_bytes(b"\x7fELF\xff")

    use_own_python(made / "bin", str(python))

    assert (made / "bin" / "shell").read_text() == SHELL
    assert (made / "bin" / "data").read_bytes() == b"\x7fELF\xff"
    prefix = tmp_path / 'where it\'s "seen" $later'
    made.rename(prefix)
    (tmp_path / name / ".venv").rename(tmp_path / "gone")
    version = f"python{sys.version_info.major}.{sys.version_info.minor}"
    packages = str(prefix / "lib" / version / "site-packages")
    words = ["a b", "$HOME", ""]
    for program in PROGRAMS:
        script = prefix / "bin" / program
        wanted = f"{[str(prefix / 'bin' / 'python3'), str(script), *words]}\n"
        assert output_of([script, *words], PYTHONPATH=packages) == wanted
    by_name = ["sh", "-c", f'exec {script.name} "$@"', "sh"]
    for start in (by_name, ["python3", script]):  # (it is still a Python program)
        assert output_of([*start, *words], path=str(script.parent), PYTHONPATH=packages) == wanted


def test_pip_writes_more_than_one_form(tmp_path: Path, wheel: Path) -> None:
    """Otherwise the test above would prove little."""
    short, long = (
        (installed(tmp_path / name, wheel)[0] / "bin" / "tiny").read_text()
        for name in ("s", "l" * 150)
    )
    assert short.startswith(f"#!{tmp_path}/s/.venv/bin/python\n")
    assert long.startswith(f"#!/bin/sh\n'''exec' {tmp_path}/l")


@pytest.mark.parametrize("name", ["s", "some path", "some path ü", "l" * 150])
def test_the_header_that_setuptools_writes_is_recognised(name: str, tmp_path: Path) -> None:
    python = environment(tmp_path / name)
    ours = sysconfig.get_path("purelib")
    header = output_of([python, "-c", HEADER_OF_SETUPTOOLS], PYTHONPATH=ours)
    assert str(python) in header
    script = os.fsencode(header + SCRIPT)
    for installer in (str(python), "/another/python"):
        assert without_header(script, installer) == SCRIPT.encode()


@pytest.mark.parametrize(
    ("header", "is_python"),
    [
        (b"#!/usr/bin/env python3\n", True),
        (b"#!/usr/bin/python3.12 -sP\n", True),
        (b"#! /usr/bin/python\n", True),
        (b"#!python\n", True),
        (HEADER, True),
        # uv's header, which finds its Python in the same way
        (
            b'#!/bin/sh\n\'\'\'exec\' "$(dirname -- "$(realpath -- "$0")")"/\'python\' "$0" "$@"\n'
            b"' '''\n",
            True,
        ),
        (b"#!/bin/sh\n", False),
        (b"#!/usr/bin/env bash\n", False),
        (b"#!/opt/python/bin/bash\n", False),
        (b"#!/usr/bin/pythonic\n", False),
        (b"\x7fELF\n", False),
        (b"", False),
    ],
)
def test_only_python_programs_are_changed(header: bytes, is_python: bool) -> None:
    code = b"print('python')\n"
    assert without_header(header + code, "/a/python") == (code if is_python else None)
