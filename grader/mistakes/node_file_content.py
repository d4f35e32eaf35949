"""The catalogue: a node's file that Python cannot read."""

from __future__ import annotations

import re
from collections.abc import Mapping

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.encodings import DECLARED, ENCODINGS, NOT_UTF8
from grader.mistakes.example import NODE, UNSTARTED, Example, example
from grader.mistakes.fixes import first_line, syntax
from grader.mistakes.kind import Kind
from grader.mistakes.recognised import NAME_ERROR, Raised, RecognisedMistake
from grader.mistakes.slips import LANGUAGE, OTHER_LANGUAGE, PASTED, SIGNS, SLIP_WHYS, WEB
from grader.package.edit.tree import Edit, Replace, Write
from grader.package.source.pasted import labels_in


def _label(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """Recognise a label of a web page that Python takes for a name."""
    data = raised.module.text.spliced([]) or b""
    label = next((p for p in labels_in(data) if p.line == raised.line), None)
    if label is None or label.word != match["name"]:
        return None
    return RecognisedMistake(
        kind="source.pasted",
        words={"found": label.found},
        variant=label.variant,
        where=raised.where,
    )


NOTEBOOK = """{
 "cells": [
  {
   "cell_type": "code",
   "execution_count": null,
   "outputs": [],
   "source": [
    "import rclpy\\n",
    "from rclpy.node import Node\\n",
    "\\n",
    "def main(args=None):\\n",
    "    rclpy.init(args=args)\\n",
    "    rclpy.spin(Node('my_first_node'))\\n"
   ]
  }
 ],
 "nbformat": 4,
 "nbformat_minor": 5
}
"""
STEP = "        self.counter_ += 1"
FIRST = "#!/usr/bin/env python3\n"


def _example(
    name: str, *edits: Edit, also: Mapping[str, str] | None = None, first: bool = True
) -> Example:
    """Return a node's file that Python cannot read; without `first`, its line 1 is not judged."""
    blocks = UNSTARTED if first else ("source.shebang", *UNSTARTED)
    return example(name, *edits, fails="source.node_file", also=also, blocks=blocks)


def _line(name: str, old: str, new: str) -> Example:
    return _example(name, Replace(NODE, old, new))


KINDS = (
    Kind(
        id="source.not_utf8",
        stage="file",
        title=msg("A file of the node is not UTF-8 text"),
        why=NOT_UTF8,
        fix=ENCODINGS["other_encoding"],
        fixes={kind: fix for kind, fix in ENCODINGS.items() if kind != "other_encoding"},
        whys={"declared": DECLARED},
        link=links.PYTHON_SYNTAX,
        seen=r"SyntaxError: \(unicode error\)|SyntaxError: Non-UTF-8 code",
        fixed_by=(syntax.node,),
        examples=(
            _example(
                "not_utf8",
                Write(
                    NODE, b"#!/usr/bin/env python3\n\n\ndef main():\n    print('f\xfcr den Kurs')\n"
                ),
            ),
            _example(
                "korean_in_cp949",
                Write(
                    NODE,
                    f'{FIRST}\n\ndef main():\n    """1초마다 시간을 출력한다."""\n'.encode("cp949"),
                ),
            ),
        ),
    ),
    Kind(
        id="source.pasted",
        stage="file",
        title=msg("A file of the node contains characters or lines that are not Python code"),
        why=WEB,
        whys=SLIP_WHYS,
        fix=msg("Remove what does not belong to the code, or type that line again."),
        fixes=PASTED,
        link=links.PYTHON_SYNTAX,
        raised={NAME_ERROR: _label},
        fixed_by=(syntax.node, first_line.shebang),
        examples=(
            _line("typographic_quotes", "'Hello time: '", "\u2018Hello time: \u2019"),
            _line("no_break_spaces", STEP, "\u00a0" * 8 + "self.counter_ += 1"),
            _line("full_width_bracket", "super().__init__(", "super().__init__\uff08"),
            example(
                "page_label",
                Replace(NODE, FIRST, f"Python\n{FIRST}"),
                fails="source.shebang",
                also={"run.starts": "source.pasted"},
                note="NameError: name 'Python' is not defined",
            ),
            _example(
                "code_fence",
                Replace(NODE, "#!/usr/bin/env", "```python\n#!/usr/bin/env"),
                Replace(NODE, "    main()\n", "    main()\n```\n"),
                also={"source.shebang": "source.pasted"},
            ),
            _example(
                "answer_around_the_code",
                Replace(
                    NODE, "#!/usr/bin/env", "Here's the full node:\n\n```python\n#!/usr/bin/env"
                ),
                Replace(NODE, "    main()\n", "    main()\n```\nRun it with `ros2 run`!\n"),
                also={"source.shebang": "source.pasted"},
            ),
            _example(
                "word_document",
                Write(NODE, b"PK\x03\x04\x14\x00\x06\x00\x08\x00\x00\x00!\x00[Content_Types].xml"),
                first=False,
            ),
            _example("node_as_notebook", Write(NODE, NOTEBOOK), first=False),
            _line("shell_command", "import rclpy\n", "$ chmod +x my_first_node.py\nimport rclpy\n"),
        ),
    ),
    Kind(
        id="source.other_language",
        stage="file",
        title=msg("A line of the node's code is written as in another language"),
        why=OTHER_LANGUAGE,
        fix=msg("Write that line in Python."),
        fixes=LANGUAGE,
        link=links.PYTHON_SYNTAX,
        fixed_by=(syntax.node,),
        examples=(
            _line("plus_plus", "self.counter_ += 1", "self.counter_++"),
            _line("slashes_comment", "counter_ = 0", "counter_ = 0  // it doesn't count yet"),
            _example(
                "braces",
                Replace(NODE, "def main(args=None):", "def main(args=None) {"),
                Replace(
                    NODE, "        rclpy.try_shutdown()\n", "        rclpy.try_shutdown()\n}\n"
                ),
            ),
        ),
    ),
    Kind(
        id="source.syntax_error",
        stage="file",
        title=msg("Python cannot read a file of the node"),
        why=msg(
            "Python reads the whole file before it runs any of it. If it cannot read a line, "
            "nothing runs."
        ),
        fix=msg(
            "Go to the line that the message names. The mistake is at the place that Python shows "
            "or before it, in this line or at the end of the line above. Compare both lines with "
            "lines of the same kind that work."
        ),
        fixes={
            "tabs": msg("Indent with spaces only. In VS Code: 'Convert Indentation to Spaces'."),
            "indentation": msg(
                "Indent that line like the other lines of its block, with 4 spaces per level."
            ),
            "null": msg("Save the file as UTF-8 text, or write it again: this copy is damaged."),
            "size": msg("Keep the node's file small: it contains the code of one node."),
            **SIGNS,
        },
        whys={
            "size": msg(
                "The grader reads a file only up to a limit, so that no file takes it minutes. A node "
                "needs a small part of that."
            ),
        },
        link=links.PYTHON_SYNTAX,
        seen=r"^(?P<error>(?:Syntax|Indentation|Tab)Error: .{1,300})",
        fixed_by=(syntax.node,),
        examples=(
            _line("plus_between_texts_missing", "'Hello time: ' + str", "'Hello time: ' str"),
            _line("bracket_missing", "str(self.counter_))", "str(self.counter_)"),
            _line("colon_missing", "def timer_callback(self):", "def timer_callback(self)"),
            _line("indentation", STEP, "      self.counter_ += 1"),
            _line("tabs_and_spaces", STEP, "\tself.counter_ += 1"),
            _line("quote_missing", "__init__('my_first_node')", "__init__('my_first_node)"),
            _line("bracket_too_many", "str(self.counter_))", "str(self.counter_)))"),
            _line("colon_after_super", "__init__('my_first_node')", "__init__('my_first_node'):"),
            _line("one_equals_sign", "__name__ == '", "__name__ = '"),
            _line("body_not_indented", "    rclpy.init(args", "rclpy.init(args"),
            _line("docstring_not_closed", 'the node spins."""', "the node spins."),
            _example("null_bytes", Write(NODE, b"#!/usr/bin/env python3\n\x00\x00\x00\x00")),
        ),
    ),
)
