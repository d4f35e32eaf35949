"""The catalogue: the node's file, its exec bit and its first line."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.example import (
    INIT,
    INNER,
    LOG,
    NO_FILE,
    NODE,
    PACKAGE,
    SETUP,
    UNINSTALLED,
    UNSTARTED,
    example,
)
from grader.mistakes.fixes import first_line, layout, syntax
from grader.mistakes.kind import Kind, Variants
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
from grader.package.edit.tree import Chmod, Crlf, Delete, Move, Replace, Write
from grader.package.source.pasted import labels_in

if TYPE_CHECKING:
    from typing_extensions import Unpack

PLACE = msg(
    "Python imports the node as the module <package>.<file>, so the file must be in the inner "
    "folder, which has the package's name and contains __init__.py."
)
MOVE = msg(
    "Move it into the inner folder, then build again. In the package's folder, run: mv {there} {wanted}"
)
OWN_COPIES = msg(
    "A build copies your files into build and install. Only the files in src are yours: each build "
    "overwrites the copies."
)
BUILT = msg("Copy your code from {copy} into {path}, and edit only that file from now on.")
EXEC = msg(
    "The exec bit (chmod +x) lets you start the file itself: ./{file}. ros2 run does not need it: "
    "it starts a small script that colcon creates in install/. The exercise asks for the exec "
    "bit, so it is marked here; a node that does not run has another cause."
)
SHEBANG = msg(
    "The first line tells Linux which program reads the file when you start it as ./{file}. "
    "Without it, the shell tries to run the Python code itself. (ros2 run does not need it.)"
)
CRLF = msg(
    "The first line tells Linux which program reads the file when you start it as ./{file}. The "
    "Windows line end is read as part of the program's name, and the start fails: "
    "/usr/bin/env: 'python3\\r': No such file or directory. (ros2 run does not need this line.)"
)
OTHER_PROGRAM = msg(
    "The first line tells Linux which program reads the file when you start it as ./{file}. "
    "A program that is not installed, or that is not Python 3, cannot: for example "
    "/usr/bin/env: 'python': No such file or directory. (ros2 run does not need this line.)"
)
FIRST = msg("Write as line 1: #!/usr/bin/env python3")


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


def _first_line(
    slug: str, title: str, fix: str, why: str = SHEBANG, **parts: Unpack[Variants]
) -> Kind:
    return Kind(
        id=f"source.{slug}",
        stage="first line",
        title=title,
        why=why,
        fix=fix,
        link=links.FIRST_NODE,
        **parts,
    )


KINDS = (
    Kind(
        id="source.no_node_file",
        stage="file",
        title=msg("The node's file is missing"),
        why=PLACE,
        fix=msg("Create the file {path} and write the node in it."),
        whys={
            "several": msg(
                "Each of these files has a node: {files}. Which of them is to be marked is not certain."
            )
        },
        fixes={
            "built": BUILT,
            "several": msg("Keep the one that is to be marked, and give it the path {path} (mv)."),
            "notebook": msg("Write the code of the notebook's cells into a new file {path}."),
        },
        link=links.FIRST_NODE,
        fixed_by=(
            layout.node_file,
            layout.node_name,
        ),
        examples=(
            example(
                "as_created",
                Delete(NODE),
                Replace(
                    SETUP, "            'test_node = my_robot_controller.my_first_node:main',\n", ""
                ),
                fails="source.node_file",
                also={"entry_point.mapping": "setup.no_entry"},
                blocks=(*NO_FILE, *UNINSTALLED),
                note="only ros2 pkg create and a build",
            ),
            example(
                "node_not_written",
                Delete(NODE),
                fails="source.node_file",
                blocks=(*NO_FILE, *UNSTARTED),
                note="the entry point exists, its file does not",
            ),
        ),
    ),
    Kind(
        id="source.hidden_by_folder",
        stage="file",
        title=msg("A folder hides the node's file"),
        why=msg(
            "A folder with an __init__.py is a package. Of a package and a file of the same name, "
            "Python imports the package."
        ),
        fix=msg("Delete the folder {folder}, or give it another name."),
        link=links.FIRST_NODE,
        examples=(
            example(
                "node_hidden_by_folder",
                Write(f"{NODE.removesuffix('.py')}/__init__.py", ""),
                fails="source.node_file",
                blocks=UNSTARTED,
            ),
        ),
    ),
    Kind(
        id="source.misplaced_node_file",
        stage="file",
        title=msg("The node's file is in another folder"),
        why=PLACE,
        fix=msg("Move it into the inner folder: its path in the package must be {wanted}."),
        fixes={
            "init": msg(
                "Give this file the node's name, and make an empty __init__.py. In the package's "
                "folder, run: mv {init} {wanted} && touch {init}"
            ),
            "init_empty": msg(
                "Move the code from {init} into {wanted}, and leave __init__.py empty."
            ),
            "inside": MOVE,
            "entry": MOVE,
            "folder": msg("Rename the folder {folder} to {inner}, to the letter: case matters."),
        },
        whys={
            "entry": msg(
                "The exercise asks for the node in {wanted}. The entry point must name that file."
            )
        },
        link=links.PACKAGE,
        fixed_by=(
            layout.inner_folder,
            layout.node_file,
            layout.out_of_init,
        ),
        examples=(
            example(
                "node_in_init",
                Delete(INIT),
                Move(NODE, INIT),
                fails="source.node_file",
                blocks=UNSTARTED,
            ),
            example(
                "node_in_init_and_empty_file",
                Delete(INIT),
                Move(NODE, INIT),
                Write(NODE, b""),
                Chmod(NODE, 0o755),
                fails="source.node_file",
                blocks=UNSTARTED,
            ),
            example(
                "inner_folder_with_capitals",
                Move(INNER, "My_Robot_Controller"),
                fails="source.node_file",
                blocks=UNSTARTED,
            ),
            example(
                "node_in_package_root",
                Move(NODE, "my_first_node.py"),
                fails="source.node_file",
                blocks=UNSTARTED,
            ),
            example(
                "node_in_scripts",
                Move(NODE, "scripts/my_first_node.py"),
                fails="source.node_file",
                blocks=UNSTARTED,
            ),
            example(
                "inner_folder_misnamed",
                Move(INNER, "my_robot_controler"),
                fails="source.node_file",
                blocks=UNSTARTED,
            ),
        ),
    ),
    Kind(
        id="source.misnamed_node_file",
        stage="file",
        title=msg("The node's file has a different name"),
        why=msg(
            "The exercise asks for a file of this name. Every letter counts, and case matters."
        ),
        fix=msg("Rename it, then build again. In the package's folder, run: mv {there} {path}"),
        link=links.FIRST_NODE,
        fixed_by=(layout.node_name,),
        examples=(
            example(
                "node_misnamed",
                Move(NODE, "my_robot_controller/my_frist_node.py"),
                fails="source.node_file",
                blocks=UNSTARTED,
            ),
            example(
                "node_misnamed_in_entry_too",
                Move(NODE, f"{INNER}/first_node.py"),
                Replace(SETUP, f"{PACKAGE}.my_first_node:main", f"{PACKAGE}.first_node:main"),
                fails="source.node_file",
                also={"entry_point.mapping": "setup.other_module"},
                note="the node runs: it is read and judged under its own name",
            ),
            example(
                "node_misnamed_without_exec_bit",
                Move(NODE, f"{INNER}/hello.py"),
                Chmod(f"{INNER}/hello.py", 0o644),
                Crlf(f"{INNER}/hello.py"),
                fails="source.node_file",
                also={
                    "source.exec_bit": "source.not_executable",
                    "source.shebang": "source.crlf",
                },
                blocks=UNSTARTED,
            ),
        ),
    ),
    Kind(
        id="source.node_file_is_link",
        stage="file",
        title=msg("The node's file is a link that leads out of the package"),
        why=msg("The submission contains the link, but not the file that it leads to."),
        fix=msg("Replace the link with the file itself."),
        link=links.FIRST_NODE,
    ),
    Kind(
        id="source.no_init_file",
        stage="file",
        title=msg("The inner folder has no __init__.py"),
        why=msg(
            "find_packages() in setup.py recognises a Python package by its __init__.py. "
            "Without it, nothing in the folder is installed."
        ),
        fix=msg(
            "Create the empty file, then build again. In the package's folder, run: touch {path}"
        ),
        fixes={
            "misnamed": msg(
                "Its name must be exactly __init__.py, with two underscores on both sides. "
                "Rename it, then build again. In the package's folder, run: mv {there} {path}"
            )
        },
        link=links.PACKAGE,
        fixed_by=(layout.init_file,),
        examples=(
            example(
                "init_missing",
                Delete(INIT),
                fails="run.starts",
                note="find_packages finds nothing; builds, then fails with ModuleNotFoundError",
            ),
            example(
                "init_with_single_underscores",
                Move(INIT, f"{INNER}/_init_.py"),
                fails="run.starts",
            ),
        ),
    ),
    Kind(
        id="source.unreadable_node_file",
        stage="file",
        title=msg("The node's file cannot be read"),
        why=msg("A file that cannot be read can be neither marked nor run."),
        fix=msg("Hand in a readable file of ordinary size with your code in it."),
        link=links.FIRST_NODE,
    ),
    Kind(
        id="source.empty_node_file",
        stage="file",
        title=msg("The node's file is empty"),
        why=msg("What you type in the editor is in the file only after you save it."),
        fix=msg("Save the file in your editor (Ctrl+S), then look at it with: cat {path}"),
        whys={
            "built": OWN_COPIES,
            "beside": msg("The exercise asks for the node in {path}. That file is empty."),
        },
        fixes={
            "built": BUILT,
            "beside": msg(
                "Copy your node into the empty file, and delete the other one. In the package's "
                "folder, run: cp {there} {path} && rm {there}. Then build again."
            ),
        },
        link=links.FIRST_NODE,
        fixed_by=(layout.node_beside,),
        examples=(
            example(
                "node_empty",
                Write(NODE, b""),
                fails="source.node_file",
                also={"source.shebang": "source.no_shebang"},
                blocks=UNSTARTED,
                note="not saved in VS Code",
            ),
        ),
    ),
    Kind(
        id="source.not_utf8",
        stage="file",
        title=msg("The node's file is not UTF-8 text"),
        why=msg(
            "Python reads source files as UTF-8; a single invalid byte makes the file unreadable."
        ),
        fix=msg(
            "In VS Code, click the encoding (UTF-8) at the bottom right. Choose 'Reopen with "
            "Encoding' first, and the encoding in which the text is readable, such as 'Western "
            "(Windows 1252)' or 'Korean (EUC-KR)'. Then click it again, and choose 'Save with "
            "Encoding' and 'UTF-8'. If you save before you reopen, the text is lost."
        ),
        fixes={
            "declared": msg(
                "The file is UTF-8, but line {line} declares the encoding {found}. Delete that line: "
                "Python expects UTF-8 without it."
            ),
            "korean": msg(
                "In VS Code, click the encoding (UTF-8) at the bottom right. Choose 'Reopen with "
                "Encoding' first, and 'Korean (EUC-KR)': the text is readable again. Then click it "
                "again, and choose 'Save with Encoding' and 'UTF-8'. If you save before you "
                "reopen, the text is lost. Korean text itself is fine in a UTF-8 file."
            ),
            "saved": msg(
                "Save the file as UTF-8. In VS Code: click the encoding at the bottom right, then "
                "choose 'Save with Encoding' and 'UTF-8'."
            ),
        },
        whys={
            "declared": msg(
                "Python reads a source file in the encoding that a comment in line 1 or 2 declares."
            ),
        },
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
        title=msg("The node's file contains characters or lines that are not Python code"),
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
                "no_break_spaces",
                Replace(NODE, "        self.counter_ += 1", "\u00a0" * 8 + "self.counter_ += 1"),
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
        title=msg("A line of the node's file is written as in another language"),
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
                "class_with_capital",
                Replace(NODE, "class MyFirstNode", "Class MyFirstNode"),
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
        title=msg("Python cannot read the node's file"),
        why=msg(
            "Python reads the whole file before it runs any of it. If it cannot read a line, "
            "nothing runs."
        ),
        fix=msg(
            "Look at that line and the line above it: often a bracket, a quote or a colon is "
            "missing."
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
            example(
                "word_document",
                Write(NODE, b"PK\x03\x04\x14\x00\x06\x00\x08\x00\x00\x00!\x00"),
                fails="source.node_file",
                also={"source.shebang": "source.no_shebang"},
                blocks=UNSTARTED,
            ),
        ),
    ),
    Kind(
        id="source.not_executable",
        stage="exec bit",
        title=msg("The node's file is not executable"),
        why=EXEC,
        fix=msg("In the package's folder, run: chmod +x {path}"),
        fixes={
            "elsewhere": msg(
                "In the package's folder, run: chmod +x {there} (or, if you have already moved or "
                "renamed the file: chmod +x {path})"
            )
        },
        link=links.FIRST_NODE,
        seen=r"(?:^|[\s:])\./(?P<path>[\w./-]{0,200}\.py): Permission denied",
        fixed_by=(layout.exec_bit,),
        examples=(
            example(
                "exec_bit_missing",
                Chmod(NODE, 0o644),
                fails="source.exec_bit",
                note="37 of 147 public packages; ros2 run works anyway",
            ),
        ),
    ),
    Kind(
        id="source.exec_bit_unknown",
        stage="exec bit",
        title=msg("The submission does not record the exec bit"),
        why=EXEC,
        fix=msg(
            "Hand in a git repository or a tar archive: both record the exec bit. In git: "
            "git update-index --chmod=+x {path}"
        ),
        fixes={
            "elsewhere": msg(
                "Give the file its right name and place first. Then hand in a git repository or a "
                "tar archive: both record the exec bit. In git: git update-index --chmod=+x {path}"
            )
        },
        link=links.FIRST_NODE,
    ),
    _first_line(
        "byte_order_mark",
        msg("There is a byte order mark before line 1"),
        msg(
            "Save the file as UTF-8, not as 'UTF-8 with BOM' (in VS Code: at the bottom right). Or "
            "run: sed -i '1s/^\\xEF\\xBB\\xBF//' {path}"
        ),
        fixed_by=(first_line.byte_order_mark,),
    ),
    _first_line(
        "crlf",
        msg("The lines have Windows line endings (CRLF)"),
        msg(
            "Change CRLF to LF (in VS Code: at the bottom right). Or run, in the package's folder: "
            "sed -i 's/\\r$//' {path}"
        ),
        CRLF,
        fixes={
            "elsewhere": msg(
                "Change CRLF to LF (in VS Code: at the bottom right). Or run, in the package's "
                "folder: sed -i 's/\\r$//' {there} (or, if you have already moved or renamed the "
                "file: sed -i 's/\\r$//' {path})"
            )
        },
        seen=r"python3(?:\\r|\r|\^M)['\u2019]?: No such file or directory",
        fixed_by=(first_line.line_ends,),
        examples=(
            example(
                "shebang_crlf",
                Crlf(NODE),
                fails="source.shebang",
                note="/usr/bin/env: 'python3\\r': No such file or directory",
            ),
        ),
    ),
    _first_line(
        "shebang_not_first",
        msg("The shebang is not on line 1"),
        msg("Move it to line 1: anywhere else it has no effect."),
        fixed_by=(first_line.shebang,),
        examples=(
            example(
                "shebang_second_line",
                Replace(
                    NODE, "#!/usr/bin/env python3\n", "# my first node\n#!/usr/bin/env python3\n"
                ),
                fails="source.shebang",
            ),
        ),
    ),
    _first_line(
        "wrong_shebang",
        msg("Line 1 names a program other than Python 3"),
        FIRST,
        OTHER_PROGRAM,
        whys={
            "first_sign": msg(
                "A comment begins with #. Here another sign is before it, or # is missing: Python "
                "takes the line for code and stops at it, and Linux finds no program for the file."
            )
        },
        fixed_by=(first_line.shebang,),
        examples=(
            example(
                "shebang_python2",
                Replace(NODE, "#!/usr/bin/env python3\n", "#!/usr/bin/python2\n"),
                fails="source.shebang",
            ),
            example(
                "shebang_without_slash",
                Replace(NODE, "#!/usr/bin/env python3\n", "#!usr/bin/env python3\n"),
                fails="source.shebang",
            ),
            example(
                "shebang_bash",
                Replace(NODE, "#!/usr/bin/env python3\n", "#!/bin/bash\n"),
                fails="source.shebang",
            ),
        ),
    ),
    _first_line(
        "no_shebang",
        msg("Line 1 is not a shebang"),
        msg("Add this as the first line: #!/usr/bin/env python3"),
        seen=r"(?:^|[\s:])(?:import|from): (?:command )?not found",
        fixed_by=(first_line.shebang,),
        examples=(
            example(
                "shebang_missing",
                Replace(NODE, "#!/usr/bin/env python3\n", ""),
                fails="source.shebang",
            ),
        ),
    ),
)
