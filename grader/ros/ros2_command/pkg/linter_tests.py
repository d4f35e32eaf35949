"""The tests of a new ament_python package: ament's linters, run by pytest.

Names and purpose are those of ros2's own tests; the texts are ours, so their sizes differ.
"""

_SKIP = """\
# Remove the next line once every file has a copyright header.
@pytest.mark.skip(reason='No copyright header has been placed in the generated source file.')
"""
_CHECK = """\
\"\"\"Check this package with {linter}.\"\"\"

from {linter}.main import {function}
import pytest


{skip}{marks}def test_{short}():
{body}"""
_MAIN = """\
    assert main(argv={argv}) == 0, '{linter} found problems'
"""
_FLAKE8 = """\
    status, messages = main_with_errors(argv=[])
    assert status == 0, '\\n'.join(messages)
"""


def linter_tests(*, kilted: bool) -> dict[str, str]:
    """Return the texts by file name; kilted checks package.xml as well (ros2cli#957)."""
    tests = {
        "test_copyright.py": _main("copyright", ["copyright", "linter"], "['.', 'test']", _SKIP),
        "test_flake8.py": _check("flake8", "main_with_errors", ["flake8", "linter"], _FLAKE8),
        "test_pep257.py": _main("pep257", ["linter", "pep257"], "['.', 'test']"),
    }
    if kilted:
        tests["test_xmllint.py"] = _main("xmllint", ["linter", "xmllint"], "[]")
    return tests


def _main(short: str, marks: list[str], argv: str, skip: str = "") -> str:
    body = _MAIN.format(argv=argv, linter=f"ament_{short}")
    return _check(short, "main", marks, body, skip)


def _check(short: str, function: str, marks: list[str], body: str, skip: str = "") -> str:
    return _CHECK.format(
        linter=f"ament_{short}",
        function=function,
        skip=skip,
        marks="".join(f"@pytest.mark.{mark}\n" for mark in marks),
        short=short,
        body=body,
    )
