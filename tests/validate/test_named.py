"""mutants.yaml: its format, and errors with file and line."""

from __future__ import annotations

import textwrap
from pathlib import Path

import pytest

from grader.base.errors import AssignmentError
from grader.mistakes.catalogue import CATALOGUE
from grader.package.edit.tree import Chmod, Copy, Delete, Move, Replace, Write
from grader.ros.distro import find_distro
from grader.validate.named import MutantsFile, read_mutants

JAZZY = find_distro("jazzy")
CHECKS = ("package.found", "source.exec_bit")
MISTAKES = {name: CATALOGUE[name] for name in ("package.empty", "source.not_executable")}
GOOD = """\
schema: 1
mutants:
  - name: no_bit
    check: source.exec_bit
    mistake: source.not_executable
    edits:
      - {chmod: a/b.py, mode: "0644"}
"""


def read(folder: Path, text: str) -> MutantsFile:
    path = folder / "mutants.yaml"
    path.write_text(text)
    return read_mutants(path, checks=CHECKS, kinds=MISTAKES, distro=JAZZY)


def edits(*lines: str) -> str:
    return GOOD.replace(
        '      - {chmod: a/b.py, mode: "0644"}\n', "".join(f"      - {x}\n" for x in lines)
    )


def test_a_mutant_is_read_with_its_place(tmp_path: Path) -> None:
    (mutant,) = read(tmp_path, GOOD).mutants
    assert mutant.name == "no_bit"
    assert mutant.families == ("source.exec_bit",)
    assert mutant.mistake == "source.not_executable"
    assert mutant.edits == (Chmod("a/b.py", 0o644),)
    assert mutant.where == f"{tmp_path}/mutants.yaml:3"


def test_every_edit_can_be_written_down(tmp_path: Path) -> None:
    text = edits(
        "{replace: f, old: x, new: ''}",
        '{write: f, text: "t\\n", mode: "0755"}',
        "{write: f, base64: AAE=}",
        "{delete: f}",
        "{rename: f, to: g}",
        "{copy: f, to: g}",
    )
    assert read(tmp_path, text).mutants[0].edits == (
        Replace("f", "x", ""),
        Write("f", b"t\n", 0o755),
        Write("f", b"\0\1"),
        Delete("f"),
        Move("f", "g"),
        Copy("f", "g"),
    )


def test_survivors_are_explained_by_name(tmp_path: Path) -> None:
    text = GOOD + "equivalent:\n  - {mutant: drop x, why: nobody reads it}\n"
    written = read(tmp_path, text)
    assert written.explained(["drop x", "drop y"]) == {"drop x": "nobody reads it"}


@pytest.mark.parametrize(
    ("automatic", "line", "says"),
    [
        (["drop xy"], 9, "no automatic mutant 'drop x': did you mean 'drop xy'?"),
        (["drop x", "no_bit"], 3, "an automatic mutant has the same name"),
    ],
)
def test_unknown_names_of_automatic_mutants_are_reported_with_their_line(
    automatic: list[str], line: int, says: str, tmp_path: Path
) -> None:
    written = read(tmp_path, GOOD + "equivalent:\n  - {mutant: drop x, why: nobody reads it}\n")
    with pytest.raises(AssignmentError) as caught:
        written.explained(automatic)
    assert str(caught.value).startswith(f"{tmp_path}/mutants.yaml:{line}: ")
    assert says in str(caught.value)


def test_all_unknown_names_are_reported_at_once(tmp_path: Path) -> None:
    more = "equivalent:\n  - {mutant: drop x, why: a}\n  - {mutant: drop y, why: b}\n"
    with pytest.raises(AssignmentError) as caught:
        read(tmp_path, GOOD + more).explained(["no_bit"])
    places = [line.partition(": ")[0] for line in str(caught.value).splitlines()]
    assert places == [f"{tmp_path}/mutants.yaml:{line}" for line in (9, 10, 3)]


@pytest.mark.parametrize(
    ("text", "line", "says"),
    [
        (GOOD.replace("schema: 1", "schema: 2"), 1, "schema"),
        (GOOD.replace("mutants:", "mutant:"), 2, "did you mean 'mutants'"),
        (GOOD.replace("source.exec_bit", "source.exec_bti"), 4, "did you mean 'source.exec_bit'"),
        (GOOD.replace("not_executable", "not_executabel"), 5, "'source.not_executable'"),
        (GOOD.replace("    name", "    nam").replace("- name", "- nam"), 3, "did you mean 'name'"),
        (GOOD + GOOD[GOOD.index("  - ") :], 8, "two mutants"),
        (GOOD[: GOOD.index("    edits")], 3, "edit"),
        (edits("{chmdo: f}"), 7, "did you mean 'chmod'"),
        (edits("{delete: f}", "{chmod: f}"), 8, "mode"),
        (edits('{chmod: f, mode: "9"}'), 7, "octal"),
        (edits("{chmod: f, mode: 420}"), 7, "text (put it in quotes), not 420"),
        (edits("chmod: f\n        mod: '0644'"), 8, "did you mean 'mode'"),
        (edits("{chmod: '', mode: '0644'}"), 7, "chmod must not be empty"),
        (edits("{chmod: f, mode: '0644', to: g}"), 7, "unknown key 'to'; known: chmod, mode"),
        (edits("{write: f, text: x, base64: AAE=}"), 7, "'text' or 'base64'"),
        (edits(), 6, "edits must be a list"),
        (GOOD[: GOOD.index("    edits")] + "    edits: []\n", 6, "at least one edit"),
        (edits("{delete: ../f}"), 7, "inside"),
        (edits("{delete: /etc/passwd}"), 7, "inside"),
        (edits("{rename: f, to: ../g}"), 7, "inside"),
        (edits("{write: f}"), 7, "'text' or 'base64'"),
        (edits("{write: f, base64: '%'}"), 7, "base64"),
        (edits("delete"), 7, "mapping"),
        (GOOD + "equivalent:\n  - {mutant: x}\n", 9, "why"),
        (GOOD + "equivalent:\n" + 2 * "  - {mutant: x, why: y}\n", 10, "twice"),
    ],
)
def test_an_error_is_reported_with_file_and_line(
    text: str, line: int, says: str, tmp_path: Path
) -> None:
    with pytest.raises(AssignmentError) as caught:
        read(tmp_path, textwrap.dedent(text))
    assert str(caught.value).startswith(f"{tmp_path}/mutants.yaml:{line}:")
    assert says in str(caught.value)


def test_all_errors_are_reported_at_once(tmp_path: Path) -> None:
    text = edits("{delete: ../f}", "{chmod: f, mode: 420}", "{chmdo: f}")
    with pytest.raises(AssignmentError) as caught:
        read(tmp_path, text + "equivalent:\n  - {mutant: x}\n")
    lines = [
        line.removeprefix(f"{tmp_path}/mutants.yaml:") for line in str(caught.value).split("\n")
    ]
    assert lines == [
        "7:10: not a path inside the package: ../f",
        "8:20: mutants.0.edits.1.mode must be text (put it in quotes), not 420",
        "9:9: no such edit: chmdo: did you mean 'chmod'?",
        "11:5: missing key 'why'",
    ]


def test_examples_of_the_catalogue_are_mutants_too(tmp_path: Path) -> None:
    mutants = read(tmp_path, GOOD + "catalogue: true\n").mutants
    assert [mutant.name for mutant in mutants] == ["empty_folder", "exec_bit_missing", "no_bit"]
    assert mutants[1].mistake == "source.not_executable"
    assert mutants[1].families == ("source.exec_bit",)


def test_examples_for_a_check_that_the_assignment_lacks_are_left_out(tmp_path: Path) -> None:
    path = tmp_path / "mutants.yaml"
    path.write_text(GOOD + "catalogue: true\n")
    mutants = read_mutants(path, checks=["source.exec_bit"], kinds=MISTAKES, distro=JAZZY).mutants
    assert [mutant.name for mutant in mutants] == ["exec_bit_missing", "no_bit"]


def test_a_mutant_has_no_name_of_the_catalogue(tmp_path: Path) -> None:
    text = GOOD.replace("no_bit", "exec_bit_missing") + "catalogue: true\n"
    with pytest.raises(AssignmentError, match="two mutants 'exec_bit_missing'"):
        read(tmp_path, text)


@pytest.mark.parametrize(("distro", "right"), [("jazzy", False), ("kilted", True)])
def test_what_is_right_on_a_distro_is_equivalent_there(
    distro: str, right: bool, tmp_path: Path
) -> None:
    path = tmp_path / "mutants.yaml"
    path.write_text("schema: 1\ncatalogue: true\n")
    read = read_mutants(path, checks=["run.starts"], kinds=CATALOGUE, distro=find_distro(distro))
    (mutant,) = (one for one in read.mutants if one.name == "node_in_with")
    assert bool(mutant.equivalent) is right
    assert mutant.named
