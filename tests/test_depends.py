"""The check `package.depends`: package.xml names the packages that the code imports."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from grader.course.find import KEYS, assignment_file
from grader.course.load import load_assignment
from grader.report.model import CheckResult
from grader.verdict.checks.all import CHECKS
from grader.verdict.fix import fix_files
from grader.verdict.static import evaluate_static
from grader.verdict.take_in import take_in_for

ASSIGNMENT = load_assignment(assignment_file("draw_circle"), known_checks=CHECKS)
NODE = "my_robot_controller/draw_circle.py"
IMPORT = "from geometry_msgs.msg import Twist\n"
DEPEND = "  <depend>geometry_msgs</depend>\n"
BOTH = """\
try:
    from turtlesim.msg import Pose
except ImportError:
    from turtlesim_msgs.msg import Pose
"""


@pytest.fixture
def package(tmp_path: Path) -> Path:
    made = tmp_path / "my_robot_controller"
    shutil.copytree(KEYS / "draw_circle" / "solution" / "my_robot_controller", made)
    return made


def change(file: Path, old: str, new: str) -> None:
    text = file.read_text()
    assert text.count(old) == 1
    file.write_text(text.replace(old, new))


def judged(package: Path) -> CheckResult:
    submission = take_in_for(ASSIGNMENT, package)
    results = evaluate_static(submission, ASSIGNMENT)
    return next(result for result in results if result.id == "package.depends")


@pytest.mark.parametrize(
    ("manifest", "imports"),
    [
        (DEPEND, IMPORT),
        (DEPEND.replace("depend>", "exec_depend>"), IMPORT),
        (DEPEND, "import geometry_msgs.msg\n"),
        (DEPEND, "from geometry_msgs import msg\n"),
        (f"{DEPEND}  <depend>turtlesim</depend>\n", IMPORT + BOTH),
        (f"{DEPEND}  <depend>turtlesim_msgs</depend>\n", IMPORT + BOTH),
        (DEPEND, f"{IMPORT}import math, numpy\nfrom . import helper\n"),
        ("", "import my_robot_controller.msg\n"),
        (DEPEND, f"{IMPORT}from std_msgs.msg import Sring\n"),
        (DEPEND, f"{IMPORT}from turtlsim.msg import Pose\n"),
    ],
    ids=[
        "depend",
        "exec",
        "import",
        "module",
        "turtlesim",
        "kilted",
        "no ROS package",
        "itself",
        "type",
        "package",
    ],
)
def test_a_package_that_names_what_it_imports_passes(
    package: Path, manifest: str, imports: str
) -> None:
    change(package / "package.xml", DEPEND, manifest)
    change(package / NODE, IMPORT, imports)
    assert judged(package).status == "passed"


@pytest.mark.parametrize(
    ("manifest", "imports", "wanted", "variant"),
    [
        ("", IMPORT, "geometry_msgs", "Add"),
        ("  <test_depend>geometry_msgs</test_depend>\n", IMPORT, "geometry_msgs", "Add"),
        ("  <build_depend>geometry_msgs</build_depend>\n", IMPORT, "geometry_msgs", "Add"),
        ("  <depend>geometry_msg</depend>\n", IMPORT, "geometry_msgs", "Write"),
        (DEPEND, f"{IMPORT}from turtlesim.srv import SetPen\n", "turtlesim", "Add"),
    ],
    ids=["missing", "test only", "build only", "misspelt", "in a second line"],
)
def test_a_package_that_does_not_is_told_the_line_to_add(
    package: Path, manifest: str, imports: str, wanted: str, variant: str
) -> None:
    """The patch adds it, or corrects the name, and then the check passes."""
    change(package / "package.xml", DEPEND, manifest)
    change(package / NODE, IMPORT, imports)
    found = judged(package)
    assert (found.status, found.mistakes[0].id) == ("failed", "package.depend_missing")
    tag = "exec_depend" if "_depend" in manifest else "depend"
    assert found.expected == f"<{tag}>{wanted}</{tag}>"
    assert found.fix.startswith(variant)
    line = (package / NODE).read_text().splitlines().index(imports.splitlines()[-1]) + 1
    assert f"{NODE}, line {line}, imports {wanted}" in found.actual
    plan = fix_files(take_in_for(ASSIGNMENT, package), ASSIGNMENT, only="package.depends")
    assert not [one for one in plan.left if one.check == "package.depends"]
    data = plan.new.data("package.xml") or b""
    assert data.count(f"<{tag}>{wanted}</{tag}>".encode()) == 1


def test_a_module_beside_the_node_counts_too(package: Path) -> None:
    (package / "my_robot_controller" / "helper.py").write_text("from std_msgs.msg import String\n")
    found = judged(package)
    assert "helper.py, line 1, imports std_msgs" in found.actual


def test_what_python_cannot_read_is_the_business_of_another_check(package: Path) -> None:
    """It is skipped with the node's file, and passes over a broken module beside it."""
    (package / "my_robot_controller" / "broken.py").write_text("from std_msgs.msg import (\n")
    assert judged(package).status == "passed"
    (package / NODE).write_text("from std_msgs.msg import (\n")
    assert judged(package).status == "skipped"


def test_a_missing_rclpy_is_told_once(package: Path) -> None:
    change(package / "package.xml", "  <depend>rclpy</depend>\n", "")
    results = evaluate_static(take_in_for(ASSIGNMENT, package), ASSIGNMENT)
    assert [found.id for found in judged(package).mistakes] == ["package.depend_missing"]
    assert [advice for result in results for advice in result.advice] == []


@pytest.mark.parametrize("place", ["my_robot_controller/circle.py", "scripts/draw_circle.py"])
def test_a_node_elsewhere_is_read_where_it_is(package: Path, place: str) -> None:
    (package / place).parent.mkdir(exist_ok=True)
    (package / NODE).rename(package / place)
    assert judged(package).status == "passed"
    change(package / "package.xml", DEPEND, "")
    assert place in judged(package).actual
    shutil.copy(package / place, package / "my_robot_controller/again.py")
    assert judged(package).blocked_by == "source.node_file"
