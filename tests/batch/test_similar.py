"""Submissions that are equal apart from white space and comments: which are found."""

from __future__ import annotations

import io
import time
import tokenize
from dataclasses import replace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from grader.batch.similar import fingerprint, groups
from grader.package.submission import SourceFile, Submission, take_in
from tests.marking import ASSIGNMENT
from tests.processes import ROOT

SOLUTION = ROOT / "grader/keys/hello_time/solution/my_robot_controller"
NODE = "my_robot_controller/my_first_node.py"


def solution() -> Submission:
    return take_in(SOLUTION, package=ASSIGNMENT.package, node_file=ASSIGNMENT.node_file)


def submission_with(files: dict[str, bytes]) -> Submission:
    own = tuple(SourceFile(path, "file", data=data) for path, data in files.items())
    return replace(solution(), files=own)


def changed(path: str, old: str, new: str) -> Submission:
    """Return the solution with one text replaced in one file."""
    files = []
    for file in solution().files:
        text = file.data.decode()
        if file.path == path:
            assert old in text
            text = text.replace(old, new)
        files.append(replace(file, data=text.encode()))
    return replace(solution(), files=tuple(files))


@pytest.mark.parametrize(
    ("path", "old", "new"),
    [
        (NODE, "import rclpy\n", "import rclpy  # ROS for Python\n\n\n# more\n"),
        (NODE, "\n", "\r\n"),
        (NODE, "    ", "  "),
        (NODE, " = ", "="),
        ("setup.py", "\n", "\n\n"),
        ("package.xml", "<name>", "<!-- mine -->\n   <name>"),
        ("setup.cfg", "[install]", "# where to\n\n[install]"),
    ],
)
def test_white_space_and_comments_do_not_count(path: str, old: str, new: str) -> None:
    assert fingerprint(changed(path, old, new)) == fingerprint(solution())


@pytest.mark.parametrize(
    ("path", "old", "new"),
    [
        (NODE, "counter", "number"),
        (NODE, "Hello time", "Hello  time"),
        ("package.xml", "maintainer", "author"),
        ("setup.py", "test_node", "my_node"),
    ],
)
def test_other_content_counts(path: str, old: str, new: str) -> None:
    assert fingerprint(changed(path, old, new)) != fingerprint(solution())


def test_indentation_that_changes_a_block_counts() -> None:
    one = submission_with({NODE: b"if a:\n    b()\n    c()\n"})
    other = submission_with({NODE: b"if a:\n    b()\nc()\n"})
    assert fingerprint(one) != fingerprint(other)


def test_a_freshly_created_package_has_no_fingerprint() -> None:
    created = {"setup.py": b"setup()", "my_robot_controller/__init__.py": b"# empty\n"}
    created["test/test_flake8.py"] = b"def test(): pass"
    assert fingerprint(submission_with(created)) == ""
    assert groups({"a": "", "b": ""}) == ()


def test_groups_have_at_least_two_members() -> None:
    found = groups({"d": "2", "b": "1", "c": "3", "a": "1", "e": "2", "f": "2"})
    assert found == (("a", "b"), ("d", "e", "f"))


@given(st.dictionaries(st.sampled_from([NODE, "a.xml", "b.cfg", "c"]), st.binary(max_size=200)))
def test_any_file_has_a_fingerprint(files: dict[str, bytes]) -> None:
    assert fingerprint(submission_with(files)) == fingerprint(submission_with(files))


@pytest.mark.parametrize(
    ("path", "data"),
    [
        ("package.xml", b"<!--" * 50_000),
        ("setup.cfg", b"\n" * 200_000),
        ("setup.cfg", b" \t" * 100_000),
        (NODE, b"a\n" * 2_000_000),
        (NODE, b"(" * 4_000_000),
        (NODE, b"'''" + b"\\\n" * 2_000_000),
    ],
)
def test_a_hostile_file_takes_bounded_time(path: str, data: bytes) -> None:
    before = time.process_time()
    assert fingerprint(submission_with({NODE: b"print()", path: data}))
    assert time.process_time() - before < 5, "seconds of processor time; this is not linear"


def test_long_code_is_compared_without_blanks_and_comments() -> None:
    code = b"count = 1\n" * 50_000
    plain, remarked = submission_with({NODE: code}), submission_with({NODE: b"# mine\n\n" + code})
    assert fingerprint(plain) == fingerprint(remarked)
    assert fingerprint(plain) != fingerprint(submission_with({NODE: code + b"print()\n"}))


def test_an_unterminated_comment_hides_nothing() -> None:
    one = submission_with({NODE: b"print()", "package.xml": b"<a><!-- b"})
    other = submission_with({NODE: b"print()", "package.xml": b"<a><!-- c"})
    assert fingerprint(one) != fingerprint(other)


NAMES = st.sampled_from(["a", "b", "count", "self", "print", "7", "'t'"])


@given(st.lists(st.tuples(NAMES, st.sampled_from([" ", "  ", "\t"]), st.booleans()), max_size=12))
def test_blanks_between_tokens_never_count(parts: list[tuple[str, str, bool]]) -> None:
    plain = "x = [" + ", ".join(word for word, _, _ in parts) + "]\n"
    wide = "x = [" + ",".join(
        f"{blank}{word}{'  # why' + chr(10) if remark else blank}" for word, blank, remark in parts
    )
    wide += "\n]\n"
    assert _tokens(plain) == _tokens(wide)
    assert fingerprint(submission_with({NODE: plain.encode()})) == fingerprint(
        submission_with({NODE: wide.encode()})
    )


def _tokens(text: str) -> list[str]:
    tokens = tokenize.generate_tokens(io.StringIO(text).readline)
    skipped = (tokenize.COMMENT, tokenize.NL)
    return [token.string for token in tokens if token.type not in skipped]


def test_a_file_with_another_name_counts() -> None:
    one = submission_with({NODE: b"print(1)\n"})
    other = submission_with({"my_robot_controller/other.py": b"print(1)\n"})
    assert fingerprint(one) != fingerprint(other)
