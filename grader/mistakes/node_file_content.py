"""The catalogue: a node's file that Python cannot read."""

from __future__ import annotations

import re

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.encodings import DECLARED, ENCODINGS, NOT_UTF8
from grader.mistakes.example import LOG, NODE, UNSTARTED, example
from grader.mistakes.fixes import first_line, syntax
from grader.mistakes.kind import Kind
from grader.mistakes.recognised import NAME_ERROR, Raised, RecognisedMistake
from grader.mistakes.slips import (
    DOCUMENTS,
    LANGUAGE,
    OTHER_LANGUAGE,
    PASTED,
    PASTED_WHYS,
    SIGNS,
    WEB,
)
from grader.package.edit.tree import Replace, Write
from grader.package.source.pasted import labels_in


def _label(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """Recognise a label of a web page that Python takes for a name."""
    data = raised.module.text.spliced([]) or b""
    label = next((p for p in labels_in(data) if p.line == raised.line), None)
    if label is None or label.word != match["name"]:
        return None
    return RecognisedMistake(
        kind="source.pasted",
        params={"what": label.variant},
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
            example(
                "not_utf8",
                Write(
                    NODE, b"#!/usr/bin/env python3\n\n\ndef main():\n    print('f\xfcr den Kurs')\n"
                ),
                fails="source.node_file",
                blocks=UNSTARTED,
                note="latin-1 from an old editor",
            ),
            example(
                "korean_in_cp949",
                Write(
                    NODE,
                    (
                        "#!/usr/bin/env python3\n\n\ndef main():\n"
                        '    """1초마다 시간을 출력한다."""\n'
                    ).encode("cp949"),
                ),
                fails="source.node_file",
                blocks=UNSTARTED,
                note="saved by an editor on Korean Windows",
            ),
        ),
    ),
    Kind(
        id="source.pasted",
        stage="file",
        title=msg("A file of the node contains characters or lines that are not Python code"),
        why=WEB,
        whys=PASTED_WHYS,
        fix=msg("Remove what does not belong to the code, or type that line again."),
        fixes={**PASTED, **DOCUMENTS},
        link=links.PYTHON_SYNTAX,
        raised={NAME_ERROR: _label},
        fixed_by=(syntax.node, first_line.shebang),
        examples=(
            example(
                "typographic_quotes",
                Replace(NODE, "'Hello time: '", "\u2018Hello time: \u2019"),
                fails="source.node_file",
                blocks=UNSTARTED,
                note="copied from a word processor",
            ),
            example(
                "indentation_of_an_input_method",
                Replace(NODE, "        self.counter_ += 1", "\u3000" * 4 + "self.counter_ += 1"),
                fails="source.node_file",
                blocks=UNSTARTED,
            ),
            example(
                "no_break_spaces",
                Replace(NODE, "        self.counter_ += 1", "\u00a0" * 8 + "self.counter_ += 1"),
                fails="source.node_file",
                blocks=UNSTARTED,
            ),
            example(
                "accents_for_quotes",
                Replace(NODE, "'my_first_node'", "\u00b4my_first_node\u00b4"),
                Replace(NODE, "'Hello time: '", "\u00b4Hello time: \u00b4"),
                fails="source.node_file",
                blocks=UNSTARTED,
            ),
            example(
                "full_width_bracket",
                Replace(NODE, "super().__init__(", "super().__init__\uff08"),
                fails="source.node_file",
                blocks=UNSTARTED,
                note="a Korean or Chinese input method",
            ),
            example(
                "html_line_break",
                Replace(NODE, "import rclpy\n", "import rclpy<br>\n"),
                fails="source.node_file",
                blocks=UNSTARTED,
            ),
            example(
                "page_label",
                Replace(NODE, "#!/usr/bin/env python3\n", "Python\n#!/usr/bin/env python3\n"),
                fails="source.shebang",
                also={"run.starts": "source.pasted"},
                note="NameError: name 'Python' is not defined",
            ),
            example(
                "code_fence",
                Replace(NODE, "#!/usr/bin/env", "```python\n#!/usr/bin/env"),
                Replace(NODE, "    main()\n", "    main()\n```\n"),
                fails="source.node_file",
                also={"source.shebang": "source.pasted"},
                blocks=UNSTARTED,
            ),
            example(
                "answer_below_the_code",
                Replace(
                    NODE,
                    "    main()\n",
                    "    main()\n```\n\n### How it works\n- The node spins until Ctrl+C.\n",
                ),
                fails="source.node_file",
                blocks=UNSTARTED,
            ),
            example(
                "answer_around_the_code",
                Replace(
                    NODE, "#!/usr/bin/env", "Here's the full node:\n\n```python\n#!/usr/bin/env"
                ),
                Replace(NODE, "    main()\n", "    main()\n```\nRun it with `ros2 run`!\n"),
                fails="source.node_file",
                also={"source.shebang": "source.pasted"},
                blocks=UNSTARTED,
            ),
            example(
                "rich_text",
                Write(
                    NODE,
                    "{\\rtf1\\ansi\\ansicpg1252\\cocoartf2761\n"
                    "\\f0\\fs24 #!/usr/bin/env python3\\\n"
                    "import rclpy\\\n"
                    "}\n",
                ),
                fails="source.node_file",
                blocks=("source.shebang", *UNSTARTED),
            ),
            example(
                "word_document",
                Write(NODE, b"PK\x03\x04\x14\x00\x06\x00\x08\x00\x00\x00!\x00[Content_Types].xml"),
                fails="source.node_file",
                blocks=("source.shebang", *UNSTARTED),
            ),
            example(
                "node_as_notebook",
                Write(NODE, NOTEBOOK),
                fails="source.node_file",
                blocks=("source.shebang", *UNSTARTED),
            ),
            example(
                "notebook_below_a_shebang",
                Write(NODE, f"#!/usr/bin/env python3\n{NOTEBOOK}"),
                fails="source.node_file",
                blocks=UNSTARTED,
            ),
            example(
                "command_of_a_notebook",
                Replace(NODE, "import rclpy\n", "%load_ext autoreload\nimport rclpy\n"),
                fails="source.node_file",
                blocks=UNSTARTED,
            ),
            example(
                "shell_line_of_a_notebook",
                Replace(NODE, "import rclpy\n", "!pip install rclpy\nimport rclpy\n"),
                fails="source.node_file",
                blocks=UNSTARTED,
            ),
            example(
                "python_prompt",
                Replace(NODE, "import rclpy\n", ">>> import rclpy\n"),
                fails="source.node_file",
                blocks=UNSTARTED,
            ),
            example(
                "shell_line_without_prompt",
                Replace(NODE, "import rclpy\n", "chmod +x my_first_node.py\nimport rclpy\n"),
                fails="source.node_file",
                blocks=UNSTARTED,
            ),
            example(
                "shell_line_that_is_python",
                Replace(NODE, "import rclpy\n", "ls -l\nimport rclpy\n"),
                fails="run.starts",
                note="NameError: name 'ls' is not defined",
            ),
            example(
                "shell_command",
                Replace(NODE, "import rclpy\n", "$ chmod +x my_first_node.py\nimport rclpy\n"),
                fails="source.node_file",
                blocks=UNSTARTED,
            ),
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
            example(
                "plus_plus",
                Replace(NODE, "self.counter_ += 1", "self.counter_++"),
                fails="source.node_file",
                blocks=UNSTARTED,
            ),
            example(
                "slashes_comment",
                Replace(NODE, "self.counter_ = 0", "self.counter_ = 0  // it doesn't count yet"),
                fails="source.node_file",
                blocks=UNSTARTED,
            ),
            example(
                "ampersands",
                Replace(
                    NODE,
                    f"        {LOG}",
                    f"        if self.counter_ >= 0 && True:\n            {LOG}",
                ),
                fails="source.node_file",
                blocks=UNSTARTED,
            ),
            example(
                "exclamation_mark",
                Replace(
                    NODE, f"        {LOG}", f"        if !self.counter_ < 0:\n            {LOG}"
                ),
                fails="source.node_file",
                blocks=UNSTARTED,
            ),
            example(
                "braces",
                Replace(NODE, "def main(args=None):", "def main(args=None) {"),
                Replace(
                    NODE, "        rclpy.try_shutdown()\n", "        rclpy.try_shutdown()\n}\n"
                ),
                fails="source.node_file",
                blocks=UNSTARTED,
            ),
            example(
                "arrow_after_call",
                Replace(NODE, "self.get_logger().info", "self.get_logger()->info"),
                fails="source.node_file",
                blocks=UNSTARTED,
            ),
            example(
                "typed_variable",
                Replace(
                    NODE,
                    "        self.counter_ = 0",
                    "        int start = 0\n        self.counter_ = start",
                ),
                fails="source.node_file",
                blocks=UNSTARTED,
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
            example(
                "try_without_except",
                Replace(NODE, "    except KeyboardInterrupt:\n        pass\n    finally:\n", ""),
                Replace(
                    NODE,
                    "        node.destroy_node()\n        rclpy.try_shutdown()\n",
                    "    node.destroy_node()\n    rclpy.try_shutdown()\n",
                ),
                fails="source.node_file",
                blocks=UNSTARTED,
            ),
            example(
                "plus_between_texts_missing",
                Replace(NODE, "'Hello time: ' + str", "'Hello time: ' str"),
                fails="source.node_file",
                blocks=UNSTARTED,
            ),
            example(
                "break_without_loop",
                Replace(NODE, "        pass\n", "        break\n"),
                fails="source.node_file",
                blocks=UNSTARTED,
                note="only the compiler refuses it",
            ),
            example(
                "windows_path_in_docstring",
                Replace(
                    NODE, "import rclpy\n", '"""Saved in C:\\Users\\kim\\ros."""\nimport rclpy\n'
                ),
                fails="source.node_file",
                blocks=UNSTARTED,
            ),
            example(
                "bracket_missing",
                Replace(NODE, "str(self.counter_))", "str(self.counter_)"),
                fails="source.node_file",
                blocks=UNSTARTED,
            ),
            example(
                "colon_missing",
                Replace(NODE, "def timer_callback(self):", "def timer_callback(self)"),
                fails="source.node_file",
                blocks=UNSTARTED,
            ),
            example(
                "indentation",
                Replace(NODE, "        self.counter_ += 1", "      self.counter_ += 1"),
                fails="source.node_file",
                blocks=UNSTARTED,
            ),
            example(
                "tabs_and_spaces",
                Replace(NODE, "        self.counter_ += 1", "\tself.counter_ += 1"),
                fails="source.node_file",
                blocks=UNSTARTED,
            ),
            example(
                "two_commas",
                Replace(NODE, "self.create_timer(1.0, self", "self.create_timer(1.0,, self"),
                fails="source.node_file",
                blocks=UNSTARTED,
            ),
            example(
                "quote_missing",
                Replace(
                    NODE, "super().__init__('my_first_node')", "super().__init__('my_first_node)"
                ),
                fails="source.node_file",
                blocks=UNSTARTED,
            ),
            example(
                "bracket_too_many",
                Replace(NODE, "str(self.counter_))", "str(self.counter_)))"),
                fails="source.node_file",
                blocks=UNSTARTED,
            ),
            example(
                "colon_after_super",
                Replace(NODE, "__init__('my_first_node')", "__init__('my_first_node'):"),
                fails="source.node_file",
                blocks=UNSTARTED,
            ),
            example(
                "missing_colon_in_another_file",
                Write(
                    "my_robot_controller/words.py",
                    "def hello(number)\n    return 'Hello time: ' + str(number)\n",
                ),
                Replace(
                    NODE,
                    "import rclpy\n",
                    "import rclpy\n\nfrom my_robot_controller.words import hello\n",
                ),
                Replace(NODE, "'Hello time: ' + str(self.counter_)", "hello(self.counter_)"),
                fails="run.starts",
            ),
            example(
                "one_equals_sign",
                Replace(NODE, "__name__ == '", "__name__ = '"),
                fails="source.node_file",
                blocks=UNSTARTED,
            ),
            example(
                "body_not_indented",
                Replace(NODE, "    rclpy.init(args=args)\n", "rclpy.init(args=args)\n"),
                fails="source.node_file",
                blocks=UNSTARTED,
            ),
            example(
                "docstring_not_closed",
                Replace(NODE, 'the node spins."""', "the node spins."),
                fails="source.node_file",
                blocks=UNSTARTED,
            ),
            example(
                "python_2_print",
                Replace(NODE, "        pass\n", "        print 'bye'\n"),
                fails="source.node_file",
                blocks=UNSTARTED,
            ),
            example(
                "null_bytes",
                Write(NODE, b"#!/usr/bin/env python3\n\x00\x00\x00\x00"),
                fails="source.node_file",
                blocks=UNSTARTED,
                note="UTF-16, or a damaged copy",
            ),
        ),
    ),
)
