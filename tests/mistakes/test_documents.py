"""A notebook, a web page or an archive under the name of a Python file."""

from __future__ import annotations

import json

import pytest

from grader.package.source.documents import code_cells, document_of, script_of


def notebook(*cells: str) -> bytes:
    """Return a notebook with these cells."""
    made = [{"cell_type": "code", "source": cell.splitlines(keepends=True)} for cell in cells]
    text = {"cell_type": "markdown", "source": ["# My node"]}
    return json.dumps({"cells": [text, *made], "nbformat": 4}, indent=1).encode()


@pytest.mark.parametrize(
    ("found", "variant"),
    [
        (notebook("a = 1"), "notebook"),
        (b"#!/usr/bin/env python3\n" + notebook("a = 1"), "notebook"),
        (b'{"metadata": null, "cells": []}', "notebook"),
        (b"<!-- saved from -->\n<html><body>", "document"),
        (b" {\\rtf1 a", "document"),
        (b"PK\x03\x04....[Content_Types].xml", "document"),
        (b"PK\x03\x04....my_node.py", "document"),
        (b"%PDF-1.7\n", "document"),
        (b"\xcb\r\r\n\0\0\0\0\0", "document"),
    ],
)
def test_a_file_of_another_kind_is_recognised(found: bytes, variant: str) -> None:
    document = document_of(found)
    assert document is not None and document.variant == variant


@pytest.mark.parametrize(
    "found",
    [
        b"",
        b"import json\nnotebook = {'cells': []}\n",
        b'{"cells": 1}\n',
        b'{"cells": [1]}\n',
        b'{"speed": 1.0}\n',
        b"# <html>\na = 1\n",
        b"{" * 60_000,
        b'{"cells": [' + b"[" * 60_000,
    ],
)
def test_code_and_other_data_are_no_documents(found: bytes) -> None:
    assert document_of(found) is None


def test_a_notebooks_code_becomes_a_file_with_a_shebang() -> None:
    assert script_of(notebook("import rclpy\n", "rclpy.init()")) == (
        b"#!/usr/bin/env python3\nimport rclpy\n\n\nrclpy.init()\n"
    )
    assert script_of(notebook("#!/usr/bin/python3\na = 1")) == b"#!/usr/bin/python3\na = 1\n"
    assert script_of(notebook("!pip install a\nb = 1\n%time b")) == (
        b"#!/usr/bin/env python3\nb = 1\n"
    )


@pytest.mark.parametrize("cells", [(), ("  \n",), ("a = (",), ("a = !ls",), ("a = '\udc80'",)])
def test_a_notebook_without_code_that_python_reads_is_not_fixed(cells: tuple[str, ...]) -> None:
    assert script_of(notebook(*cells)) is None


def test_cells_of_other_forms_are_read() -> None:
    assert code_cells(b'{"cells": [{"cell_type": "code", "source": "a"}, {}]}') == ["a"]
    assert code_cells(b'{"cells": [{"cell_type": "code"}]}') == [""]
