"""Packages with a wrong node file: its folder, syntax, encoding, mode or first line."""

from __future__ import annotations

from grader.validate.tree import Chmod, Crlf, Delete, Edit, Move, Replace, Write

from .model import AFTER_START, INIT, INNER, NODE, RUN, SETUP, Package, broken

SHEBANG = "#!/usr/bin/env python3\n"
LATIN = b"#!/usr/bin/env python3\n\n\ndef main():\n    print('f\xfcr den Kurs')\n"
ENTRY = "            'test_node = my_robot_controller.my_first_node:main',\n"


def _unreadable(name: str, *edits: Edit, mistake: str, note: str = "") -> Package:
    return broken(
        name, *edits, failed={"source.node_file": mistake}, skipped=RUN, score=55, note=note
    )


SOURCE = (
    broken("as_created", Delete(NODE), Replace(SETUP, ENTRY, ""),
           failed={"source.node_file": "source.no_node_file",
                   "entry_point.mapping": "setup.no_entry"},
           skipped=RUN | {"source.exec_bit", "source.shebang", "entry_point.executable"}, score=25,
           note="only ros2 pkg create and a build"),
    broken("node_not_written", Delete(NODE), failed={"source.node_file": "source.no_node_file"},
           skipped=RUN | {"source.exec_bit", "source.shebang"}, score=40,
           note="the entry point exists, its file does not"),
    broken("node_in_package_root", Move(NODE, "my_first_node.py"),
           failed={"source.node_file": "source.misplaced_node_file"},
           skipped=RUN | {"source.exec_bit", "source.shebang"}, score=40),
    broken("node_in_scripts", Move(NODE, "scripts/my_first_node.py"),
           failed={"source.node_file": "source.misplaced_node_file"},
           skipped=RUN | {"source.exec_bit", "source.shebang"}, score=40),
    broken("node_misnamed", Move(NODE, f"{INNER}/my_frist_node.py"),
           failed={"source.node_file": "source.misnamed_node_file"},
           skipped=RUN | {"source.exec_bit", "source.shebang"}, score=40),
    broken("inner_folder_misnamed", Move(INNER, "my_robot_controler"),
           failed={"source.node_file": "source.misplaced_node_file"},
           skipped=RUN | {"source.exec_bit", "source.shebang"}, score=40),
    broken("node_empty", Write(NODE, b""), failed={"source.node_file": "source.empty_node_file",
           "source.shebang": "source.no_shebang"}, skipped=RUN, score=50,
           note="not saved in VS Code"),
    _unreadable("bracket_missing", Replace(NODE, "str(self.counter_))", "str(self.counter_)"),
                mistake="source.syntax_error"),
    _unreadable("colon_missing", Replace(NODE, "def timer_callback(self):",
                "def timer_callback(self)"), mistake="source.syntax_error"),
    _unreadable("indentation",
                Replace(NODE, "        self.counter_ += 1", "      self.counter_ += 1"),
                mistake="source.syntax_error"),
    _unreadable("tabs_and_spaces", Replace(NODE, "        self.counter_ += 1",
                "\tself.counter_ += 1"), mistake="source.syntax_error"),
    _unreadable("python_2_print", Replace(NODE, "        pass\n", "        print 'bye'\n"),
                mistake="source.syntax_error"),
    _unreadable("not_utf8", Write(NODE, LATIN), mistake="source.not_utf8",
                note="latin-1 from an old editor"),
    _unreadable("null_bytes", Write(NODE, SHEBANG.encode() + b"\0\0\0\0"),
                mistake="source.syntax_error", note="UTF-16, or a damaged copy"),
    broken("word_document", Write(NODE, b"PK\3\4\x14\0\6\0\x08\0\0\0!\0"),
           failed={"source.node_file": "source.syntax_error",
                   "source.shebang": "source.no_shebang"}, skipped=RUN, score=50),
    broken("exec_bit_missing", Chmod(NODE, 0o644),
           failed={"source.exec_bit": "source.not_executable"}, score=90,
           note="37 of 147 public packages; ros2 run works anyway"),
    broken("shebang_missing", Replace(NODE, SHEBANG, ""),
           failed={"source.shebang": "source.no_shebang"}, score=95),
    broken("shebang_second_line", Replace(NODE, SHEBANG, "# my first node\n" + SHEBANG),
           failed={"source.shebang": "source.shebang_not_first"}, score=95),
    broken("shebang_crlf", Crlf(NODE), failed={"source.shebang": "source.crlf"}, score=95,
           note="/usr/bin/env: 'python3\\r': No such file or directory"),
    broken("shebang_python2", Replace(NODE, SHEBANG, "#!/usr/bin/python2\n"),
           failed={"source.shebang": "source.wrong_shebang"}, score=95),
    broken("shebang_without_slash", Replace(NODE, SHEBANG, "#!usr/bin/env python3\n"),
           failed={"source.shebang": "source.wrong_shebang"}, score=95),
    broken("shebang_bash", Replace(NODE, SHEBANG, "#!/bin/bash\n"),
           failed={"source.shebang": "source.wrong_shebang"}, score=95),
    broken("init_missing", Delete(INIT), failed={"run.starts": None}, skipped=AFTER_START, score=60,
           note="find_packages finds nothing; builds, then fails with ModuleNotFoundError"),
)  # fmt: skip
