"""A package.xml that breaks a rule of its format: the line, what to write, and the patch."""

from __future__ import annotations

from pathlib import Path

import pytest

from grader.package.source.broken_xml import xml_fault
from grader.verdict.checks import package, source
from grader.verdict.static import static_results
from grader.verdict.take_in import take_in_for
from tests.fixing import patch_for

from .static_bench import FILES, NODE, Bench, line, mistake

DEPEND = "  <depend>rclpy</depend>\n"
XML = '<?xml version="1.0"?>\n'
EMAIL = 'email="jane@todo.todo"'


@pytest.fixture
def bench(tmp_path: Path) -> Bench:
    return Bench(tmp_path / "jane")


def patched(bench: Bench) -> str:
    """Return the patch of package.manifest in the bench's package."""
    submission = take_in_for(bench.assignment, bench.root)
    found = static_results(submission, bench.assignment)["package.manifest"]
    return patch_for(found, submission, bench.assignment)


@pytest.mark.parametrize(
    ("old", "new", "at", "said"),
    [
        (DEPEND, DEPEND + "  <exec_depend>rclpy</exec_depend>\n", 10, "redundant"),
        ("  <desc", "  <description>Mine</description>\n  <desc", 7, "exactly one"),
        ("</version>\n", "</version>\n  <version>1.0.0</version>\n", 6, "exactly one"),
        ("jane@todo.todo", "jane(at)uni.de", 7, "jane(at)uni.de"),
        (EMAIL, "", 7, "email"),
        (' format="3"', "", 3, "format"),
        ('format="3"', 'format="4"', 3, "format"),
        ("depend>", "run_depend>", 9, "run_depend"),
        (DEPEND, DEPEND + "  <course>ROS</course>\n", 10, "course"),
        ("<depend>", '<depend version="1">', 9, "version"),
        (DEPEND, DEPEND + "  <license></license>\n", 10, "license"),
        (XML, "<!-- Jane -->\n" + XML, 2, "declaration not at start"),
    ],
)
def test_the_line_is_named_with_the_reason(
    bench: Bench, old: str, new: str, at: int, said: str
) -> None:
    text = FILES["package.xml"]
    assert old == "depend>" or text.count(old) == 1
    bench.write("package.xml", text.replace(old, new))
    found = bench.fails(package.manifest)
    assert mistake(found) in ("package.manifest_rules", "package.broken_xml")
    assert line(found) == at
    assert said in found.actual
    assert "Error(s)" not in found.actual


@pytest.mark.parametrize(
    ("old", "new"),
    [("</license>", ""), ("</description>", "</decription>"), ("  <version>0.0.0</version>\n", "")],
)
def test_a_certain_change_is_a_patch(bench: Bench, old: str, new: str) -> None:
    bench.write("package.xml", FILES["package.xml"].replace(old, new))
    assert patched(bench)


def test_a_byte_order_mark_alone_is_right(bench: Bench) -> None:
    bench.write("package.xml", "\ufeff" + FILES["package.xml"])
    assert bench.passes(package.manifest)


def test_a_build_type_outside_is_to_be_in_export(bench: Bench) -> None:
    text = FILES["package.xml"].replace("  <export>\n", "").replace("  </export>\n", "")
    bench.write("package.xml", text)
    assert "<export><build_type>" in bench.fails(package.manifest).fix


@pytest.mark.parametrize(
    ("depends", "advice"),
    [
        ("  <exec_depend>rospy</exec_depend>\n", "Write rclpy instead."),
        (
            DEPEND + "  <build_depend>rospy</build_depend>\n  <exec_depend>rospy</exec_depend>\n",
            "Delete each line with rospy: the package depends on rclpy already.",
        ),
    ],
)
def test_a_dependency_of_ros_1_is_replaced_once(depends: str, advice: str, bench: Bench) -> None:
    bench.write("package.xml", FILES["package.xml"].replace(DEPEND, depends))
    found = bench.passes(package.manifest)
    assert [text for text in found.advice if str(text).endswith(advice)]


def test_a_misnamed_manifest_is_the_place(bench: Bench) -> None:
    (bench.root / "package.xml").rename(bench.root / "Package.xml")
    found = bench.fails(package.manifest)
    assert found.where is not None
    assert found.where.file == "Package.xml"
    assert "capitals" in found.fix
    assert "mv Package.xml package.xml" in found.fix
    assert "reports success" not in found.rationale


def test_the_quotes_of_setup_cfg_are_named(bench: Bench) -> None:
    text = FILES["setup.cfg"].replace(
        "=$base/lib/my_robot_controller", "='$base/lib/my_robot_controller'"
    )
    bench.write("setup.cfg", text)
    found = bench.fails(package.setup_cfg)
    assert "no quotes around the path" in found.fix
    assert line(found) == 2


def test_a_misnamed_setup_cfg_is_renamed(bench: Bench) -> None:
    (bench.root / "setup.cfg").rename(bench.root / "setup.cfg.txt")
    found = bench.fails(package.setup_cfg)
    assert "mv setup.cfg.txt setup.cfg" in found.fix
    assert found.where is not None
    assert found.where.file == "setup.cfg.txt"


def test_the_command_that_moves_the_node_is_told(bench: Bench) -> None:
    (bench.root / NODE).rename(bench.root / "my_first_node.py")
    found = bench.fails(source.node_file)
    assert f"In the package's folder, run: mv my_first_node.py {NODE}" in found.fix


@pytest.mark.parametrize(
    ("line", "tag", "wanted"),
    [
        ("<depend>turtlesim</turtlesim>", "/turtlesim", "/depend"),
        ("<exec_depend>std_msgs</std_msgs>", "/std_msgs", "/exec_depend"),
        ("<license>MIT</version>", "/version", "/license"),
        ("<rclpy>rclpy</depend>", "rclpy", "depend"),
    ],
)
def test_of_two_tags_that_do_not_match_the_one_is_kept_that_package_xml_has(
    line: str, tag: str, wanted: str
) -> None:
    found = f'<package format="3">\n  <name>a</name>\n  {line}\n</package>\n'.encode()
    fault = xml_fault(found)
    assert fault is not None
    assert (fault.variant, fault.tag, fault.wanted) == ("misspelt", tag, wanted)
    right = line.replace(f"<{tag}>", f"<{wanted}>").encode()
    assert fault.fixed == found.replace(line.encode(), right)


def test_a_tag_around_the_text_is_missing_where_both_tags_are_known() -> None:
    line = "<export>ament_python</build_type></export>"
    fault = xml_fault(f"<package>\n  {line}\n</package>\n".encode())
    assert fault is not None
    assert (fault.variant, fault.tag) == ("unopened", "/build_type")
