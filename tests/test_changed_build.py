"""A package of which only modules change is not built again, and is what colcon would make."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import pytest

from grader.package.edit.files import Files
from grader.package.submission import Submission
from grader.ros.prefix import Ros
from grader.run.changed_build import BuiltPackage, _copies, changed_modules, with_changes
from grader.run.workspace import Build, Installed, build, save
from grader.sandbox.base import Sandbox
from grader.sandbox.bubblewrap import Bubblewrap
from grader.sandbox.limits import Limits
from tests.marking import taken_in
from tests.processes import ROOT

SOLUTION = ROOT / "grader/keys/hello_time/solution/my_robot_controller"
PACKAGE, NODE = "my_robot_controller", "my_robot_controller/my_first_node.py"
SEEN = (
    "import my_robot_controller.my_first_node as m, pathlib; "
    "print(pathlib.Path(m.__file__).read_text())"
)


def submission(changes: dict[str, bytes] | None = None) -> Submission:
    """Return the solution with other files."""
    taken = taken_in(SOLUTION)
    files = Files.of(taken)
    for path, data in (changes or {}).items():
        files = files.with_data(path, data)
    return files.put_into(taken)


def built(*, made: Build | None = None, setup: bytes = b"") -> BuiltPackage:
    """Return a package that colcon has linked into the workspace."""
    linked = {
        f"build/{PACKAGE}/{PACKAGE}": Installed("l", 0o777, 1, f"/ws/src/{PACKAGE}/{PACKAGE}")
    }
    made = made or Build("colcon build", 0, "", 1.0, files=linked)
    return BuiltPackage(submission({"setup.py": setup} if setup else {}), made, b"tar", "", "/ws")


@pytest.fixture
def sandboxes(ros_jazzy: Ros) -> Iterator[list[Sandbox]]:
    opened = [Bubblewrap(ros_jazzy, Limits()).__enter__() for _ in range(2)]
    yield list(opened)
    for sandbox in opened:
        sandbox.close()


@pytest.mark.prefix
@pytest.mark.full
def test_the_workspace_is_the_one_that_colcon_makes(sandboxes: list[Sandbox]) -> None:
    code = Path(SOLUTION / NODE).read_bytes().replace(b"Hello time", b"Changed")
    changed = submission({NODE: code})
    one, other = sandboxes
    made = build(one, submission(), package=PACKAGE)
    kept = BuiltPackage(submission(), made, save(one), one.overlay, one.workspace)
    quick = with_changes(kept, changed, one, package=PACKAGE)
    whole = build(other, changed, package=PACKAGE)
    assert quick is not None
    assert quick.seconds < whole.seconds
    assert quick.status == whole.status == 0
    assert quick.files.keys() == whole.files.keys()
    assert {p: (f.kind, f.target) for p, f in quick.files.items()} == {
        p: (f.kind, f.target) for p, f in whole.files.items()
    }
    for sandbox in sandboxes:
        command = sandbox.in_workspace(f"python3 -c '{SEEN}'")
        seen = sandbox.run(["bash", "-c", command], seconds=20)
        assert b"Changed: " in seen.output, seen.output


def test_a_copied_module_is_put_where_the_copy_is() -> None:
    place = f"install/{PACKAGE}/lib/python3.12/site-packages/{NODE}"
    (file,) = [one for one in submission().files if one.path == NODE]
    copy = Installed("f", 0o644, len(file.data))
    of_copy = built(made=Build("", 0, "", 1.0, files={place: copy}))
    assert _copies(of_copy, file, PACKAGE) == [place]
    other = built(made=Build("", 0, "", 1.0, files={place: replace(copy, size=1)}))
    assert _copies(other, file, PACKAGE) is None


@pytest.mark.parametrize(
    ("changes", "setup", "paths"),
    [
        ({NODE: b"x = 1\n"}, b"", [NODE]),
        ({NODE: b"x = 1\n", "setup.py": b"\n"}, b"", []),
        ({NODE: b"x = 1\n"}, b"text = open('my_robot_controller/my_first_node.py').read()\n", []),
        ({NODE: b"x = 1\n"}, b"from my_robot_controller import __version__\n", []),
        ({f"{PACKAGE}/more.py": b"x = 1\n"}, b"", []),
        ({}, b"", []),
    ],
)
def test_colcon_builds_what_setup_py_may_have_decided(
    changes: dict[str, bytes], setup: bytes, paths: list[str]
) -> None:
    new = submission({**({"setup.py": setup} if setup else {}), **changes})
    assert [file.path for _, file in changed_modules(built(setup=setup), new)] == paths


def test_a_package_that_did_not_build_or_changed_itself_is_built_again() -> None:
    new = submission({NODE: b"x = 1\n"})
    for made in (Build("", 1, "", 1.0), Build("", 0, "", 1.0, altered=(NODE,))):
        assert changed_modules(built(made=made), new) == []
