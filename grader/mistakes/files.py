"""The catalogue: the node's file, its exec bit and its first line."""

from __future__ import annotations

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.kind import Kind

PLACE = msg(
    "Python imports the node as module <package>.<file>, so the file must lie in the inner folder "
    "that has the package's name and the __init__.py."
)
EXEC = msg(
    "The exec bit (chmod +x) lets you start the file itself: ./{file}. ros2 run does not need it: "
    "it starts a small script that colcon makes in install/. The exercise asks for the bit, and "
    "so it is marked here, but a node that does not run has another cause."
)
SHEBANG = msg(
    "The first line tells Linux which program reads the file when you start it as ./{file}. "
    "Without it the shell takes the Python code for its own. (ros2 run does not need it.)"
)
FIRST = msg("Write as line 1: #!/usr/bin/env python3")


def _first_line(slug: str, title: str, fix: str, seen: str = "") -> Kind:
    return Kind(
        id=f"source.{slug}",
        stage="first line",
        title=title,
        why=SHEBANG,
        fix=fix,
        link=links.FIRST_NODE,
        seen=seen,
    )


KINDS = (
    Kind(
        id="source.no_node_file",
        stage="file",
        title=msg("The node's file is not there"),
        why=PLACE,
        fix=msg("Make the file {path} and write the node in it."),
        link=links.FIRST_NODE,
    ),
    Kind(
        id="source.misplaced_node_file",
        stage="file",
        title=msg("The node's file lies in another folder"),
        why=PLACE,
        fix=msg("Move it into the inner folder, so that it is {wanted} in the package."),
        link=links.PACKAGE,
    ),
    Kind(
        id="source.misnamed_node_file",
        stage="file",
        title=msg("The node's file has another name"),
        why=msg("The entry point names the file, letter by letter, and so does the exercise; "
                "capitals count."),
        fix=msg("Rename it: mv {there} {path}"),
        link=links.FIRST_NODE,
    ),
    Kind(
        id="source.node_file_is_link",
        stage="file",
        title=msg("The node's file is a link that leads out of the package"),
        why=msg("What a link leads to is not handed in with it."),
        fix=msg("Put the file itself in the link's place."),
        link=links.FIRST_NODE,
    ),
    Kind(
        id="source.no_init_file",
        stage="file",
        title=msg("The inner folder has no __init__.py"),
        why=msg("find_packages() in setup.py takes a folder for a Python package by its "
                "__init__.py; without it nothing of the folder is installed."),
        fix=msg("Make the empty file: touch {path}"),
        link=links.PACKAGE,
    ),
    Kind(
        id="source.unreadable_node_file",
        stage="file",
        title=msg("The node's file cannot be read"),
        why=msg("What cannot be read can be neither marked nor run."),
        fix=msg("Hand in a file with your code in it, readable and of ordinary size."),
        link=links.FIRST_NODE,
    ),
    Kind(
        id="source.empty_node_file",
        stage="file",
        title=msg("The node's file is empty"),
        why=msg("What is in the editor's window is in the file only once it is saved."),
        fix=msg("Save the file in your editor (Ctrl+S), then look at it with: cat {path}"),
        link=links.FIRST_NODE,
    ),
    Kind(
        id="source.not_utf8",
        stage="file",
        title=msg("The node's file is not UTF-8 text"),
        why=msg("Python reads source files as UTF-8; one byte that is none stops all."),
        fix=msg("Save the file as UTF-8. In VS Code: click the encoding at the bottom right."),
        link=links.PYTHON_SYNTAX,
        seen=r"SyntaxError: \(unicode error\)|SyntaxError: Non-UTF-8 code",
    ),
    Kind(
        id="source.syntax_error",
        stage="file",
        title=msg("Python cannot read the node's file"),
        why=msg("Python reads the whole file before it runs any of it; one line that it cannot "
                "read stops all."),
        fix=msg("Look at that line and the one above it: a bracket, a quote or a colon is often "
                "missing there."),
        fixes={
            "tabs": msg("Indent with spaces only. In VS Code: 'Convert Indentation to Spaces'."),
            "indentation": msg("Indent that line like the other lines of its block, by 4 spaces a "
                               "level."),
            "null": msg("Save the file as UTF-8 text, or write it anew: this copy is damaged."),
            "size": msg("Keep the node's file small: it is the code of one node."),
        },
        link=links.PYTHON_SYNTAX,
        seen=r"^(?P<error>(?:Syntax|Indentation|Tab)Error: .{1,300})",
    ),
    Kind(
        id="source.not_executable",
        stage="exec bit",
        title=msg("The node's file is not executable"),
        why=EXEC,
        fix=msg("chmod +x {path}"),
        link=links.FIRST_NODE,
        seen=r"(?:^|[\s:])\./(?P<path>[\w./-]{0,200}\.py): Permission denied",
    ),
    Kind(
        id="source.exec_bit_unknown",
        stage="exec bit",
        title=msg("The exec bit was not handed in"),
        why=EXEC,
        fix=msg("Hand in a git repository or a tar archive: both record the bit. In git: "
                "git update-index --chmod=+x {path}"),
        link=links.FIRST_NODE,
    ),
    _first_line("byte_order_mark", msg("There is a byte order mark in front of line 1"),
                msg("Save the file as UTF-8, not as 'UTF-8 with BOM' (in VS Code at the bottom "
                    "right).")),
    _first_line("crlf", msg("The lines end as Windows ends them (CRLF)"),
                msg("Change CRLF to LF (in VS Code at the bottom right), or run: "
                    "sed -i 's/\\r$//' {path}"),
                seen=r"python3(?:\\r|\r|\^M)['\u2019]?: No such file or directory"),
    _first_line("shebang_not_first", msg("The shebang is not on line 1"),
                msg("Move it up: it counts only as the very first line.")),
    _first_line("wrong_shebang", msg("Line 1 names another program than Python 3"), FIRST),
    _first_line("no_shebang", msg("Line 1 is no shebang"),
                msg("Put this line before all others: #!/usr/bin/env python3"),
                seen=r"(?:^|[\s:])(?:import|from): (?:command )?not found"),
)  # fmt: skip
