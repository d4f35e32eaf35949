"""The catalogue: the exec bit of the node's file and its first line."""

from __future__ import annotations

from typing import TYPE_CHECKING

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.example import NODE, example
from grader.mistakes.fixes import first_line, layout
from grader.mistakes.kind import Kind, Variants
from grader.package.edit.tree import Chmod, Crlf, Replace

if TYPE_CHECKING:
    from typing_extensions import Unpack

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
        id="source.not_executable",
        stage="exec bit",
        title=msg("The node's file is not executable"),
        why=EXEC,
        fix=msg("In the package's folder, run: chmod +x {there}"),
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
        link=links.FIRST_NODE,
    ),
    _first_line(
        "byte_order_mark",
        msg("There is a byte order mark before line 1"),
        msg(
            "Save the file as UTF-8, not as 'UTF-8 with BOM' (in VS Code: at the bottom right). Or "
            "run: sed -i '1s/^\\xEF\\xBB\\xBF//' {there}"
        ),
        fixed_by=(first_line.byte_order_mark,),
    ),
    _first_line(
        "crlf",
        msg("The lines have Windows line endings (CRLF)"),
        msg(
            "Let each line end with LF alone (in VS Code: at the bottom right). Or run, in the package's "
            "folder: sed -i 's/\\r$//' {there}"
        ),
        CRLF,
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
        fixed_by=(first_line.shebang,),
        examples=(
            example(
                "shebang_python2",
                Replace(NODE, "#!/usr/bin/env python3\n", "#!/usr/bin/python2\n"),
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
