"""A diff as people read it: changes of line ends alone are one remark."""

from __future__ import annotations

from pathlib import Path

from grader.package.edit.tree import Crlf, Replace
from grader.report.shown_patch import COMMAND, LINE_ENDS, shown_patch
from grader.verdict.static import static_results
from tests.fix.corpus_fixes import NODE, edited
from tests.fixing import patch_for
from tests.marking import ASSIGNMENT, taken_in


def patch_of(path: Path) -> str:
    submission = taken_in(path)
    result = static_results(submission, ASSIGNMENT)["source.shebang"]
    return patch_for(result, submission, ASSIGNMENT)


def test_windows_line_ends_are_one_line_of_the_diff(tmp_path: Path) -> None:
    patch = patch_of(edited(tmp_path, Crlf(NODE)))
    assert patch.count("\r\n") > 30
    head, remark, command = shown_patch(patch).rstrip().rsplit("\n", 2)
    assert remark == COMMAND
    assert command == f"sed -i 's/\\r$//' {NODE}"
    assert head.splitlines()[0].startswith("diff --git a/")
    assert not [line for line in head.splitlines() if line[:1] == "-" and line[:3] != "---"]


def test_another_change_beside_the_line_ends_is_shown(tmp_path: Path) -> None:
    shebang = Replace(NODE, "#!/usr/bin/env python3\n", "#!/usr/bin/python2\n")
    lines = shown_patch(patch_of(edited(tmp_path, shebang, Crlf(NODE)))).splitlines()
    assert [line for line in lines if line[:1] in "+-" and line[:3] not in ("+++", "---")] == [
        "-#!/usr/bin/python2",
        "+#!/usr/bin/env python3",
    ]
    assert lines.count(COMMAND) == 1


def test_a_diff_without_windows_line_ends_is_shown_as_it_is(tmp_path: Path) -> None:
    patch = patch_of(edited(tmp_path, Replace(NODE, "#!/usr/bin/env python3\n", "")))
    assert "+#!/usr/bin/env python3" in patch
    assert shown_patch(patch) == patch


def test_many_lines_are_compared_at_once() -> None:
    old = "".join(f"-{n}\r\n" for n in range(1_000))
    new = "".join(f"+{n}\n" for n in range(1_000))
    assert shown_patch(f"@@ -1,1000 +1,1000 @@\n{old}{new}").splitlines()[1:] == [LINE_ENDS]
