"""The static checks of the package: each mistake and its report."""

from __future__ import annotations

from pathlib import Path

import pytest

from grader.mistakes.catalogue import CATALOGUE
from grader.verdict.checks import package, source
from grader.verdict.checks.all import CHECKS
from grader.verdict.checks.declare import INTAKE, Check

from .static_bench import FILES, MARKER, NAME, NODE, Bench, line, mistake


@pytest.fixture
def bench(tmp_path: Path) -> Bench:
    return Bench(tmp_path / "jane")


LOOKED_AT = [
    check for check in CHECKS.values() if check.stage is INTAKE and check.parameters is None
]


def test_a_right_package_passes_without_advice(bench: Bench) -> None:
    for check in LOOKED_AT:
        assert not bench.passes(check).advice, check.id
    passed = bench.maps()
    assert passed is not None
    assert not passed.advice


def test_every_check_of_the_files_depends_on_the_package() -> None:
    assert package.found is LOOKED_AT[0]
    assert not package.found.depends
    assert all(check.depends == ("package.found",) for check in LOOKED_AT[1:])
    assert all(check.title and not check.title.endswith(".") for check in LOOKED_AT)


# package.found


def test_a_missing_package_is_reported_with_the_problem(tmp_path: Path) -> None:
    bench = Bench(tmp_path / "jane")
    for path in FILES:
        (bench.root / path).unlink()
    assert mistake(bench.fails(package.found)) == "package.empty"


def test_a_package_inside_another_passes_with_advice(bench: Bench) -> None:
    bench.write("old/package.xml", "<package><name>old</name></package>")
    assert "side by side" in bench.passes(package.found).advice[0]


# package.manifest


@pytest.mark.parametrize(
    ("old", "new", "wanted", "at", "words"),
    [
        (
            "</description>",
            "</decription>",
            "broken_xml",
            6,
            "</decription> should be </description>",
        ),
        ("</package>", "", "broken_xml", 3, "</package> is missing"),
        ("jane</m", "Jane & co</m", "broken_xml", 7, "not well-formed"),
        (f"<name>{NAME}", "<name>my_robot", "name_mismatch", 4, "my_robot"),
        ("  <version>0.0.0</version>\n", "", "manifest_tag", None, "<version> is missing"),
        ("0.0.0", "", "manifest_tag", 5, "<version> is empty"),
        ("0.0.0", "one", "manifest_rules", None, "version"),
        ('email="jane@todo.todo"', "", "manifest_rules", 7, "email"),
        ("<depend>rclpy</depend>", "<dependd>x</dependd>", "manifest_rules", 9, "dependd"),
        ('format="3"', 'format="9"', "manifest_rules", None, "format"),
        (">rclpy</depend>", f">{NAME}</depend>", "manifest_rules", 9, "the same name"),
        (">ament_python<", ">ament_cmake<", "build_type", 11, "ament_cmake"),
        (">ament_python<", ">ament_pyton<", "build_type", 11, "ament_pyton"),
        ("<build_type>ament_python</build_type>", "", "build_type", 10, "no <build_type>"),
        ("  <export>", "  <build_type>x</build_type><export>", "build_type", 10, "outside"),
        ("</license>", "", "broken_xml", 8, "</license> is missing"),
        ("</license>", "<license>", "broken_xml", 8, "is not closed"),
        ("</license>", "</license", "broken_xml", None, "not well-formed"),
        ("<license>", "", "broken_xml", 8, "its <license> is missing"),
        ("<license>", "<licence>", "broken_xml", 8, "<licence> should be <license>"),
        ("</export>\n", "", "broken_xml", 10, "</export> is missing"),
        ("</depend>", "", "broken_xml", 9, "</depend> is missing"),
        ("</maintainer>", "", "broken_xml", 7, "</maintainer> is missing"),
        ('"3"', "\u201c3\u201d", "broken_xml", 3, "not well-formed"),
        ("<?xml version", "XML\n<?xml version", "broken_xml", 1, "syntax error"),
        ("</package>", "</package>\n```", "broken_xml", 14, "not well-formed"),
        (
            "<build_type>ament_python</build_type>",
            "<build_typ>ament_python</build_typ>",
            "build_type",
            11,
            "there is 'build_typ'",
        ),
        (
            "<version>0.0.0</version>",
            "<verson>0.0.0</verson>",
            "manifest_tag",
            5,
            "(there is 'verson')",
        ),
        ("<package format", "<pakage format", "broken_xml", 3, "<pakage> should be <package>"),
        ("<?xml-model", "<!DOCTYPE package>\n<?xml-model", "manifest_doctype", 2, "document type"),
    ],
)
def test_a_wrong_manifest_is_reported_with_its_line(
    bench: Bench, old: str, new: str, wanted: str, at: int | None, words: str
) -> None:
    bench.change("package.xml", old, new)
    failed = bench.fails(package.manifest)
    assert mistake(failed) == f"package.{wanted}"
    assert words in failed.actual
    assert failed.where is not None
    assert failed.where.file == "package.xml"
    if at is not None:
        assert line(failed) == at


def test_a_build_type_counts_only_if_its_condition_holds_under_ros_2(bench: Bench) -> None:
    both = (
        '<build_type condition="$ROS_VERSION == 1">catkin</build_type>'
        '<build_type condition="$ROS_VERSION == 2">ament_python</build_type>'
    )
    bench.change("package.xml", "<build_type>ament_python</build_type>", both)
    bench.passes(package.manifest)
    bench.change("package.xml", "$ROS_VERSION == 2", "$ROS_VERSION == 3")
    found = bench.fails(package.manifest)
    assert found.actual == "the condition $ROS_VERSION == 3 is not true in ROS 2"


def test_a_missing_empty_or_binary_manifest_is_reported(bench: Bench) -> None:
    for content, wanted in [
        (b"", "package.broken_xml"),
        (b"PK\x03\x04\0\0", "package.broken_xml"),
        (b"<a/>", "package.manifest_rules"),
        (b"<package>" + b"<a>" * 5_000, "package.manifest_rules"),
        (b"<package>" + b" " * 300_000, "package.manifest_rules"),
        (b"<?xml version='1.0' encoding='nonsense'?><package/>", "package.broken_xml"),
    ]:
        bench.write("package.xml", content)
        assert mistake(bench.fails(package.manifest)) == wanted
    (bench.root / "package.xml").rename(bench.root / "package.xlm")
    failed = bench.fails(package.manifest)
    assert mistake(failed) == "package.no_manifest"
    assert "package.xlm" in failed.fix


def test_entities_are_refused_before_they_are_expanded(bench: Bench) -> None:
    bomb = '<!DOCTYPE package [<!ENTITY a "' + "x" * 1000 + '">'
    bomb += "".join(f'<!ENTITY b{n} "{"&a;" * 100}">' for n in range(100)) + "]>"
    outside = '<!DOCTYPE package [<!ENTITY a SYSTEM "file:///etc/passwd">]>'
    for declaration in (bomb, outside):
        bench.write("package.xml", declaration + f"<package><name>{NAME}&a;</name></package>")
        failed = bench.fails(package.manifest)
        assert mistake(failed) == "package.manifest_doctype"
        assert "root:" not in failed.actual


def test_the_name_in_setup_py_must_match_the_manifest(bench: Bench) -> None:
    bench.change("setup.py", "package_name = 'my_robot_controller'", "package_name = 'robot'")
    failed = bench.fails(package.manifest)
    assert (mistake(failed), line(failed)) == ("package.name_mismatch", 3)
    assert failed.mistakes[0].params == {"name": "robot", "file": "setup.py"}


def test_an_unparsable_setup_py_does_not_fail_the_manifest(bench: Bench) -> None:
    bench.change("setup.py", "setup(\n", "setup((\n")
    bench.passes(package.manifest)
    bench.passes(package.marker)
    assert bench.maps() is None


def test_missing_dependencies_are_only_advice(bench: Bench) -> None:
    bench.change("package.xml", "  <depend>rclpy</depend>\n", "  <depend>std_msg</depend>\n")
    first, second = bench.passes(package.manifest).advice
    assert "<depend>rclpy</depend>" in first
    assert "did you mean 'std_msgs'?" in second
    bench.change("package.xml", "std_msg<", "random<")
    assert "part of Python" in bench.passes(package.manifest).advice[1]


# package.marker


def test_a_missing_marker_is_reported(bench: Bench) -> None:
    (bench.root / MARKER).rename(bench.root / "resource/my_robot_controler")
    failed = bench.fails(package.marker)
    assert mistake(failed) == "package.marker_missing"
    assert "mv resource/my_robot_controler resource/" in failed.fix
    (bench.root / "resource/my_robot_controler").unlink()
    assert "touch" in bench.fails(package.marker).fix
    (bench.root / MARKER).mkdir()
    assert "is a folder" in bench.fails(package.marker).actual


INDEX_LINE = """\
        ('share/ament_index/resource_index/packages',
            ['resource/' + package_name]),
"""


def test_the_marker_and_its_line_are_both_named(bench: Bench) -> None:
    (bench.root / MARKER).unlink()
    alone = bench.fails(package.marker)
    assert "the build stops" in alone.rationale
    assert "data_files" not in alone.fix
    bench.change("setup.py", INDEX_LINE, "")
    failed = bench.fails(package.marker)
    assert mistake(failed) == "package.marker_missing"
    assert "no line for it" in failed.actual
    assert "data_files in setup.py have this line" in failed.fix
    bench.change("setup.py", "data_files=[", "data_files=OTHERS + [")
    assert "data_files" not in bench.fails(package.marker).fix


@pytest.mark.parametrize("there", [f"{MARKER}.txt", f"resources/{NAME}"])
def test_the_place_of_a_marker_of_another_name_is_the_file_that_is_there(
    bench: Bench, there: str
) -> None:
    (bench.root / there).parent.mkdir(exist_ok=True)
    (bench.root / MARKER).rename(bench.root / there)
    failed = bench.fails(package.marker)
    assert failed.where is not None
    assert failed.where.file == there


def test_a_marker_that_setup_py_does_not_install_is_reported(bench: Bench) -> None:
    bench.change("setup.py", "            ['resource/' + package_name]),", "            []),")
    failed = bench.fails(package.marker)
    assert (mistake(failed), line(failed)) == ("package.marker_not_installed", 9)


def test_a_marker_with_another_name_is_reported(bench: Bench) -> None:
    bench.change("setup.py", "'resource/' + package_name", "'resource/robot'")
    failed = bench.fails(package.marker)
    assert (mistake(failed), line(failed)) == ("package.marker_missing", 11)
    bench.write("resource/robot", "")
    assert mistake(bench.fails(package.marker)) == "package.marker_not_installed"


def test_computed_values_in_setup_py_do_not_fail_the_marker(bench: Bench) -> None:
    bench.change("setup.py", "        ('share/ament_index", "    ] + more() + [\n        ('share/x")
    bench.passes(package.marker)


@pytest.mark.parametrize(
    "written",
    [
        "f'resource/{package_name}'",
        "'resource/%s' % package_name",
        "'resource/{}'.format(package_name)",
        "os.path.join('resource', package_name)",
        "'resource/my_robot_' 'controller'",
    ],
)
def test_the_marker_may_be_written_in_any_plain_way(bench: Bench, written: str) -> None:
    bench.change("setup.py", "'resource/' + package_name", written)
    assert "installed in" in bench.passes(package.marker).actual


# package.setup_cfg


def test_install_alone_is_enough_and_a_misspelt_develop_is_advice(bench: Bench) -> None:
    bench.change("setup.cfg", "[develop]", "[devlop]")
    assert "[devlop]" in bench.passes(package.setup_cfg).advice[0]


@pytest.mark.parametrize(
    ("old", "new", "wanted", "at", "words"),
    [
        ("[install]", "[instal]", "wrong", 3, "there is 'instal'"),
        ("[install]\ninstall_scripts=$base/lib/my_robot_controller\n", "", "wrong", None, "[ins"),
        ("script_dir=", "script_dirs=", "wrong", 2, "there is 'script_dirs'"),
        ("install_scripts=", "install_script = ", "wrong", 4, "there is 'install_script'"),
        ("install_scripts=$base/lib/my", "install_scripts=$base/lib/your", "wrong", 4, "your"),
        ("install_scripts=$base/lib", "install_scripts=base/lib", "wrong", 4, "base/lib"),
        ("[develop]", "develop", "syntax", 1, "before the first"),
        ("[develop]", "[develop", "syntax", 1, "before the first"),
        ("[install]", "[develop]", "syntax", 3, "twice"),
        ("[install]", "[install]\ninstall_scripts\n", "syntax", 4, "neither"),
        ("[develop]", "\ufeff[develop]", "syntax", 1, "byte order mark"),
    ],
)
def test_a_wrong_setup_cfg_is_reported_with_its_line(
    bench: Bench, old: str, new: str, wanted: str, at: int | None, words: str
) -> None:
    bench.change("setup.cfg", old, new)
    failed = bench.fails(package.setup_cfg)
    assert mistake(failed) == f"package.setup_cfg_{wanted}"
    assert words in failed.actual
    if at is not None:
        assert line(failed) == at


def test_a_missing_setup_cfg_is_reported(bench: Bench) -> None:
    (bench.root / "setup.cfg").unlink()
    assert mistake(bench.fails(package.setup_cfg)) == "package.setup_cfg_missing"
    bench.write("setup.cfg", b"\xff\xfe")
    assert mistake(bench.fails(package.setup_cfg)) == "package.setup_cfg_syntax"


def test_dashes_in_setup_cfg_pass_with_advice_and_spaces_and_crlf_without(bench: Bench) -> None:
    text = FILES["setup.cfg"]
    bench.write("setup.cfg", text.replace("t_d", "t-d").replace("l_s", "l-s"))
    assert len(bench.passes(package.setup_cfg).advice) == 2
    bench.write("setup.cfg", text.replace("=", " = ").replace("\n", "\r\n"))
    assert not bench.passes(package.setup_cfg).advice


# source.node_file


def test_another_version_of_the_node_beside_one_without_a_timer_is_advice(bench: Bench) -> None:
    bench.write(f"{NAME}/my_first_node_final.py", FILES[NODE])
    (advice,) = bench.passes(source.node_file).advice
    bench.change(NODE, "pass", "node.create_timer(1.0, print)")
    assert not bench.passes(source.node_file).advice
    assert advice.startswith(f"{NAME}/my_first_node_final.py has a node too")


@pytest.mark.parametrize(
    ("path", "check", "wanted", "command"),
    [
        ("package.xml", package.manifest, "package.no_manifest", "package.xml"),
        ("setup.cfg", package.setup_cfg, "package.setup_cfg_missing", "setup.cfg"),
        (MARKER, package.marker, "package.marker_missing", "resource"),
    ],
)
def test_a_file_in_the_inner_folder_is_to_be_moved_out(
    bench: Bench, path: str, check: Check, wanted: str, command: str
) -> None:
    (bench.root / NAME / path).parent.mkdir(exist_ok=True)
    (bench.root / path).rename(bench.root / NAME / path)
    if path == MARKER:
        (bench.root / "resource").rmdir()
    failed = bench.fails(check)
    assert mistake(failed) == wanted
    assert f"mv {NAME}/{command}" in failed.fix
    assert failed.where is not None
    assert (bench.root / failed.where.file).is_file()
    assert not bench.evidence().submission.hints


def test_setup_py_in_the_inner_folder_is_to_be_moved_out(bench: Bench) -> None:
    (bench.root / "setup.py").rename(bench.root / NAME / "setup.py")
    assert f"mv {NAME}/setup.py setup.py" in bench.misses().fix


def test_the_files_of_a_package_inside_are_not_to_be_moved_out(bench: Bench) -> None:
    (bench.root / "setup.cfg").rename(bench.root / NAME / "setup.cfg")
    for path in ("package.xml", "setup.py"):
        bench.write(f"{NAME}/{path}", (bench.root / path).read_bytes())
    assert "mv " not in bench.fails(package.setup_cfg).fix


def test_a_wrong_build_type_alone_is_one_line_to_change(bench: Bench) -> None:
    bench.change("package.xml", "ament_python", "ament_cmake")
    failed = bench.fails(package.manifest)
    assert "<export><build_type>ament_python</build_type></export>" in failed.fix
    (bench.root / "setup.cfg").unlink()
    assert "create a new package" in bench.fails(package.manifest).fix


@pytest.mark.parametrize(
    ("kind", "variant"),
    [
        ("source.no_init_file", "misnamed"),
        ("source.misnamed_node_file", ""),
        ("package.marker_missing", "rename"),
        ("package.name_mismatch", "setup"),
        ("setup.misplaced_entry", ""),
    ],
)
def test_what_only_a_build_installs_is_to_be_built_again(kind: str, variant: str) -> None:
    mistake = CATALOGUE[kind]
    assert "build again" in mistake.fixes.get(variant, mistake.fix)


def test_a_wrong_path_in_setup_cfg_is_not_said_to_be_bin(bench: Bench) -> None:
    bench.change("setup.cfg", "script_dir=$base/lib/my_robot_controller", "script_dir=$base/lib/x")
    assert "get into another folder" in bench.fails(package.setup_cfg).rationale
