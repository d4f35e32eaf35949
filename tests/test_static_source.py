"""The static checks of the node's file: each mistake and its report."""

from __future__ import annotations

import os
import shlex
from pathlib import Path

import pytest

from grader.package.submission import take_in
from grader.report.model import Where
from grader.verdict.checks import source
from grader.verdict.checks.faults import node_file
from grader.verdict.fix import fix_files
from grader.verdict.node_files import source_of_node
from grader.verdict.outcome import Blocked
from tests.marking import ASSIGNMENT

from .static_bench import NAME, NODE, Bench, line, mistake


@pytest.fixture
def bench(tmp_path: Path) -> Bench:
    return Bench(tmp_path / "jane")


@pytest.mark.parametrize(
    ("code", "at", "kind"),
    [
        (b"def main()\n    pass\n", 1, "syntax"),
        (b"print('a'\n", 1, "syntax"),
        (b"if 1:\nprint()\n", 2, "indentation"),
        (b"if 1:\n        a = 1\n\tb = 1\n", 3, "tabs"),
        (b"print 'a'\n", 1, "syntax"),
        (b"return 1\n", 1, "syntax"),
        (b"a = 1\nb = '\xfc'\n", 2, "encoding"),
        (b"# coding: latin-2000\n", 1, "encoding"),
        (b"# coding: punycode\n", 1, "encoding"),
        ("a = 1\n".encode("utf-16"), 1, "encoding"),
        (b"a = 1\nb\0\n", 2, "null"),
        (b"a = 1\r\nb = (\r\n", 2, "syntax"),
        (b"(" * 90_000, None, "syntax"),
        (b"-" * 90_000 + b"1", None, "syntax"),
        (b"a" + b".a" * 45_000, None, "syntax"),
        (b"a = 1\n" * 20_000, None, "size"),
    ],
)
def test_a_node_with_a_syntax_error_is_reported_with_its_line(
    bench: Bench, code: bytes, at: int | None, kind: str
) -> None:
    bench.write(NODE, code)
    failed = bench.fails(source.node_file)
    assert mistake(failed) == "source." + ("not_utf8" if kind == "encoding" else "syntax_error")
    assert failed.mistakes[0].params["kind"] == kind
    if at is not None:
        assert line(failed) == at
    bench.passes(source.exec_bit)


@pytest.mark.parametrize(
    "code",
    [
        b"\xef\xbb\xbfa = 1\n",
        b"# -*- coding: latin-1 -*-\na = '\xfc'\n",
        b"a = 1\r\nif a:\r\n    b = 2\r\n",
        b"a = '\\d'\n",
        b"\x0ca = 1",
    ],
)
def test_any_encoding_that_python_reads_is_right(bench: Bench, code: bytes) -> None:
    bench.write(NODE, code)
    bench.passes(source.node_file)


def test_an_empty_node_has_the_hint_to_save_it(bench: Bench) -> None:
    bench.write(NODE, " \n")
    failed = bench.fails(source.node_file)
    assert mistake(failed) == "source.empty_node_file"
    assert "Ctrl+S" in failed.fix


@pytest.mark.parametrize("other", ["my_first_node_final.py", "node.py", "Copy of node.py"])
def test_an_empty_node_has_its_code_in_the_file_beside_it(bench: Bench, other: str) -> None:
    code = (
        "from rclpy.node import Node\n\n\nclass Hello(Node):\n    def __init__(self):\n"
        "        super().__init__('my_first_node')\n"
    )
    bench.write(NODE, "")
    bench.write(f"{NAME}/{other}", code)
    failed = bench.fails(source.node_file)
    assert mistake(failed) == "source.empty_node_file"
    assert f"cp {shlex.quote(f'{NAME}/{other}')} {NODE} && rm" in failed.fix
    first = bench.fails(source.shebang)
    assert first.where == Where(file=f"{NAME}/{other}", line=1)
    bench.write(f"{NAME}/{other}", f"#!/usr/bin/env python3\n{code}")
    bench.passes(source.shebang)
    bench.write(f"{NAME}/second.py", code)
    assert "Ctrl+S" in bench.fails(source.node_file).fix


def test_the_node_in_a_file_of_another_name_is_recognised(bench: Bench) -> None:
    (bench.root / NODE).unlink()
    bench.write(
        f"{NAME}/hello.py",
        "from rclpy.node import Node\n\n\nclass Hello(Node):\n    def __init__(self):\n"
        "        super().__init__('my_first_node')\n",
    )
    failed = bench.fails(source.node_file)
    assert mistake(failed) == "source.misnamed_node_file"
    assert f"mv {NAME}/hello.py {NODE}" in failed.fix


@pytest.mark.parametrize(
    ("to", "wanted"),
    [
        ("my_first_node.py", "misplaced_node_file"),
        ("scripts/my_first_node.py", "misplaced_node_file"),
        ("my_robot_controler/my_first_node.py", "misplaced_node_file"),
        (f"{NAME}/my_frist_node.py", "misnamed_node_file"),
        (f"{NAME}/My_First_Node.py", "misnamed_node_file"),
        (f"{NAME}/my_first_node", "misnamed_node_file"),
        (f"{NAME}/my_first_node.py.txt", "misnamed_node_file"),
        (f"{NAME}/talker.py", "no_node_file"),
    ],
)
def test_a_node_in_the_wrong_folder_is_named(bench: Bench, to: str, wanted: str) -> None:
    (bench.root / to).parent.mkdir(exist_ok=True)
    (bench.root / NODE).rename(bench.root / to)
    failed = bench.fails(source.node_file)
    assert mistake(failed) == f"source.{wanted}"
    assert to.rpartition("/")[2] in failed.actual
    for check in (source.exec_bit, source.shebang):
        if wanted != "no_node_file":
            assert f"{to}: " in bench.passes(check).actual
            continue
        with pytest.raises(Blocked) as caught:
            check.function(bench.evidence())
        assert caught.value.by == "source.node_file"


RIGHT = (
    "#!/usr/bin/env python3\nfrom rclpy.node import Node\n\n\nclass Hello(Node):\n"
    "    def __init__(self):\n        super().__init__('my_first_node')\n\n\n"
    "def main(args=None):\n    pass\n"
)


def moved(bench: Bench, to: str, code: str = RIGHT, module: str = "") -> None:
    """Put the node in another file, which the entry point names too if `module` is given."""
    (bench.root / NODE).unlink(missing_ok=True)
    bench.write(to, code)
    if module:
        bench.change("setup.py", f"{NAME}.my_first_node:main", f"{NAME}.{module}:main")


@pytest.mark.parametrize(
    ("to", "module"),
    [
        (f"{NAME}/hello.py", "hello"),
        (f"{NAME}/hello.py", ""),
        (f"{NAME}/My_first_node.py", ""),
        (f"{NAME}/my_first_node (1).py", ""),
        (f"{NAME}/nodes/hello.py", "nodes.hello"),
        (f"{NAME}/nodes/my_first_node.py", ""),
        ("scripts/hello.py", ""),
        ("my_first_node.py", ""),
        (f"{NAME}/__init__.py", ""),
    ],
)
def test_a_node_elsewhere_is_judged_and_fixed_where_it_is(
    bench: Bench, to: str, module: str
) -> None:
    moved(bench, to, RIGHT.partition("\n")[2], module)
    bench.write(f"{NAME}/helpers.py", "def main():\n    pass\n")
    bit, first = bench.fails(source.exec_bit), bench.fails(source.shebang)
    assert (mistake(bit), mistake(first)) == ("source.not_executable", "source.no_shebang")
    assert (bit.where, first.where) == (Where(file=to), Where(file=to, line=1))
    assert f"chmod +x {shlex.quote(to)}" in bit.fix
    told = bench.fails(source.node_file)
    assert f"mv {shlex.quote(to)} {NODE}" in told.fix
    assert told.where == Where(file=to)
    (bench.root / to).chmod(0o755)
    assert bench.passes(source.exec_bit).actual == f"{to}: mode 0755"
    (bench.root / to).chmod(0o644)

    submission = take_in(bench.root, package=NAME, node_file=ASSIGNMENT.node_file)
    alone = fix_files(submission, ASSIGNMENT, only="source.exec_bit").new
    assert alone.by_path[to].mode & 0o111 == 0o111
    plan = fix_files(submission, ASSIGNMENT)
    assert not plan.left
    assert plan.new.data(NODE) == RIGHT.encode()
    assert plan.new.by_path[NODE].mode & 0o111 == 0o111


@pytest.mark.parametrize("places", [("node_a.py", "node_b.py"), ("a/my_first_node.py", "b.py")])
def test_of_several_files_with_the_node_none_is_judged(
    bench: Bench, places: tuple[str, str]
) -> None:
    for place in places:
        moved(bench, f"{NAME}/{place}")
    failed = bench.fails(source.node_file)
    assert mistake(failed) == "source.no_node_file"
    for place in places:
        assert f"{NAME}/{place}" in failed.actual
        assert f"{NAME}/{place}" in failed.rationale
    for check in (source.exec_bit, source.shebang):
        with pytest.raises(Blocked) as caught:
            check.function(bench.evidence())
        assert caught.value.by == "source.node_file"


def test_the_entry_point_tells_which_of_several_files_is_the_node(bench: Bench) -> None:
    moved(bench, f"{NAME}/old.py")
    moved(bench, f"{NAME}/start.py", f"#!/usr/bin/python\nfrom {NAME}.new import main\n", "start")
    moved(bench, f"{NAME}/new.py")
    assert bench.fails(source.shebang).where == Where(file=f"{NAME}/start.py", line=1)
    assert mistake(bench.fails(source.node_file)) == "source.misnamed_node_file"
    assert node_file(bench.evidence()) == Where(file=f"{NAME}/start.py")
    read = source_of_node(bench.evidence())
    assert read is not None
    assert read.paths == [f"{NAME}/new.py", f"{NAME}/start.py"]


def test_an_entry_of_another_node_does_not_tell_it(bench: Bench) -> None:
    other = RIGHT.replace("'my_first_node'", "'talker'")
    moved(bench, f"{NAME}/talker.py", other, "talker")
    bench.fails(source.exec_bit)
    bench.change(
        "setup.py",
        f"'test_node = {NAME}.talker:main',",
        f"'test_node = {NAME}.talker:main', 'talk = {NAME}.talker:main',",
    )
    with pytest.raises(Blocked):
        source.exec_bit.function(bench.evidence())


def test_a_node_in_a_folder_of_its_name_is_moved(bench: Bench) -> None:
    (bench.root / NODE).unlink()
    (bench.root / NODE.removesuffix(".py")).mkdir()
    bench.write(
        f"{NODE.removesuffix('.py')}/__init__.py",
        "from rclpy.node import Node\n\n\nclass Hello(Node):\n    def __init__(self):\n"
        "        super().__init__('my_first_node')\n\n\ndef main():\n    Hello()\n",
    )
    failed = bench.fails(source.node_file)
    assert mistake(failed) == "source.misplaced_node_file"


def test_a_node_outside_the_package_is_found(tmp_path: Path) -> None:
    bench = Bench(tmp_path / "ws/src" / NAME)
    (bench.root / NODE).rename(tmp_path / "ws/src/my_first_node.py")
    bench.root = tmp_path / "ws"
    failed = bench.fails(source.node_file)
    assert mistake(failed) == "source.misplaced_node_file"
    assert "src/my_first_node.py, outside" in failed.actual


def test_a_linked_node_is_followed_inside_and_reported_outside(bench: Bench) -> None:
    (bench.root / NODE).rename(bench.root / "my_first_node.py")
    (bench.root / NODE).symlink_to("../my_first_node.py")
    for check in (source.node_file, source.exec_bit, source.shebang):
        bench.passes(check)
    (bench.root / NODE).unlink()
    (bench.root / NODE).symlink_to("/etc/hostname")
    assert mistake(bench.fails(source.node_file)) == "source.node_file_is_link"


def test_a_folder_or_fifo_with_the_nodes_name_is_not_a_node(bench: Bench) -> None:
    (bench.root / NODE).unlink()
    os.mkfifo(bench.root / NODE)
    assert mistake(bench.fails(source.node_file)) == "source.no_node_file"
    (bench.root / NODE).unlink()
    (bench.root / NODE).mkdir()
    assert mistake(bench.fails(source.node_file)) == "source.no_node_file"


def test_a_node_that_is_too_large_is_reported(bench: Bench) -> None:
    bench.write(NODE, b"#" * 6_000_000)
    failed = bench.fails(source.node_file)
    assert mistake(failed) == "source.unreadable_node_file"
    assert "larger than 5 MB" in failed.actual
    with pytest.raises(Blocked):
        source.shebang.function(bench.evidence())


def test_a_missing_init_file_is_advice(bench: Bench) -> None:
    (bench.root / NAME / "__init__.py").unlink()
    assert "__init__.py" in bench.passes(source.node_file).advice[0]


def test_a_misnamed_init_file_is_to_be_renamed_and_not_made(bench: Bench) -> None:
    (bench.root / NAME / "__init__.py").rename(bench.root / NAME / "_init_.py")
    advice = bench.passes(source.node_file).advice[0]
    assert f"mv {NAME}/_init_.py {NAME}/__init__.py" in advice
    assert "Make it" not in advice


@pytest.mark.parametrize("above", ["Python\n", "```python\n", "Bash\n\n", "$ code .\n"])
def test_what_a_page_has_above_the_shebang_is_removed(bench: Bench, above: str) -> None:
    right = (bench.root / NODE).read_bytes()
    bench.write(NODE, above.encode() + right)
    failed = bench.fails(source.shebang)
    assert mistake(failed) == "source.pasted"
    assert line(failed) == 1
    fixed = fix_files(bench.evidence().submission, ASSIGNMENT).new.data(NODE) or b""
    assert fixed.split() == right.split()
    assert fixed.startswith(b"#!")


def test_a_label_without_a_shebang_below_it_is_replaced(bench: Bench) -> None:
    right = (bench.root / NODE).read_bytes()
    bench.write(NODE, b"Python\n" + right.partition(b"\n")[2])
    fixed = fix_files(bench.evidence().submission, ASSIGNMENT).new.data(NODE)
    assert fixed == right


# source.exec_bit


def test_a_node_without_exec_bit_has_an_accurate_explanation(bench: Bench) -> None:
    (bench.root / NODE).chmod(0o644)
    failed = bench.fails(source.exec_bit)
    assert mistake(failed) == "source.not_executable"
    assert "0644" in failed.actual
    assert "ros2 run does not need it" in failed.rationale
    assert failed.fix == f"In the package's folder, run: chmod +x {NODE}"
    (bench.root / NODE).chmod(0o655)
    bench.fails(source.exec_bit)
    (bench.root / NODE).chmod(0o700)
    bench.passes(source.exec_bit)


def test_unknown_exec_bits_cost_what_the_assignment_says(bench: Bench) -> None:
    (bench.root / NODE).chmod(0o644)
    (bench.root / ".git").mkdir()
    (bench.root / ".git/config").write_text("[core]\n\tfilemode = false\n")
    assert bench.passes(source.exec_bit).advice
    bench.assignment = ASSIGNMENT.model_copy(update={"modes": "require"})
    assert mistake(bench.fails(source.exec_bit)) == "source.exec_bit_unknown"


# source.shebang


@pytest.mark.parametrize(
    ("start", "wanted"),
    [
        ("", "no_shebang"),
        ("# my node\n#!/usr/bin/env python3\n", "shebang_not_first"),
        ("\n#!/usr/bin/env python3\n", "shebang_not_first"),
        ("#!/usr/bin/env python3\r\n", "crlf"),
        ("\ufeff#!/usr/bin/env python3\n", "byte_order_mark"),
        ("#!/usr/bin/env python\n", "wrong_shebang"),
        ("#!/usr/bin/python2\n", "wrong_shebang"),
        ("#!/bin/bash\n", "wrong_shebang"),
        ("#!usr/bin/env python3\n", "wrong_shebang"),
        ("#/usr/bin/env python3\n", "wrong_shebang"),
        ("# !/usr/bin/env python3\n", "wrong_shebang"),
        (" #!/usr/bin/env python3\n", "wrong_shebang"),
        ("#!/usr/bin/env python3 -u\n", "wrong_shebang"),
        ("#!/usr/bin/python3 -w\n", "wrong_shebang"),
        ("#!/usr/bin/env -S python3 -uw\n", "wrong_shebang"),
        ("#!/home/jane/miniconda3/bin/python3\n", "wrong_shebang"),
    ],
)
def test_a_first_line_without_python_is_reported(bench: Bench, start: str, wanted: str) -> None:
    bench.write(NODE, start + "def main():\n    pass\n")
    failed = bench.fails(source.shebang)
    assert mistake(failed) == f"source.{wanted}"
    assert failed.where is not None
    assert failed.where.file == NODE


def test_lines_that_end_with_cr_alone_are_changed_to_lf(bench: Bench) -> None:
    bench.write(NODE, "#!/usr/bin/env python3\rdef main():\r    pass\r")
    failed = bench.fails(source.shebang)
    assert mistake(failed) == "source.crlf"
    assert "CRLF" not in failed.actual
    assert "LF alone" in failed.fix


@pytest.mark.parametrize(
    "start",
    [
        "#!/usr/bin/python3",
        "#!/usr/bin/env -S python3 -u",
        "#! /usr/bin/env python3",
        "#!/usr/bin/env python3.12",
        "#!/usr/bin/python3 -u",
        "#!/bin/python3",
    ],
)
def test_any_shebang_of_python_3_is_accepted(bench: Bench, start: str) -> None:
    bench.write(NODE, start + "\nx = (\n")
    bench.passes(source.shebang)
