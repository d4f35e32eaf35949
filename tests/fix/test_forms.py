"""Mistakes in package forms that occur in practice: each is fixed, and nothing else changes."""

from __future__ import annotations

from pathlib import Path

import pytest

from grader.package.edit.tree import Delete, Edit, Move, Replace, Write
from tests.corpus.model import CFG, INNER, MANIFEST, MARKER, NODE, SETUP
from tests.fix.corpus_fixes import contents, edited, plan_of

ENTRY = "'test_node = my_robot_controller.my_first_node:main'"
POINTS = f"""\
    entry_points={{
        'console_scripts': [
            {ENTRY},
        ],
    }},
"""
DATA_FILES = """\
    data_files=[
        ('share/ament_index/resource_index/packages',
            ['resource/' + package_name]),
        ('share/' + package_name, ['package.xml']),
    ],
"""
EXPORT = """\
  <export>
    <build_type>ament_python</build_type>
  </export>
"""
OTHER = "'other = my_robot_controller.my_first_node:other'"
BAD = "'test_node = my_robot_controller.my_frist_node:main'"


def points(new: str) -> Edit:
    return Replace(SETUP, POINTS, new)


def data_files(new: str) -> Edit:
    return Replace(SETUP, DATA_FILES, new)


def export(new: str) -> Edit:
    return Replace(MANIFEST, EXPORT, new)


FORMS: dict[str, tuple[Edit, tuple[str, str]]] = {
    "entries on one line": (
        points(f"    entry_points={{'console_scripts': [{OTHER}]}},\n"),
        (SETUP, f"entry_points={{'console_scripts': [{OTHER}, {ENTRY}]}},"),
    ),
    "entries on one line with a comma": (
        points(f"    entry_points={{'console_scripts': [{OTHER},]}},\n"),
        (SETUP, f"[{OTHER}, {ENTRY},]"),
    ),
    "no entry yet": (
        points("    entry_points={'console_scripts': []},\n"),
        (SETUP, f"{{'console_scripts': [{ENTRY}]}}"),
    ),
    "no entry yet on two lines": (
        points("    entry_points={\n        'console_scripts': [\n        ],\n    },\n"),
        (SETUP, f"[\n            {ENTRY},\n        ],"),
    ),
    "no group": (
        points("    entry_points={},\n"),
        (SETUP, f"entry_points={{'console_scripts': [{ENTRY}]}},"),
    ),
    "last entry without comma and with a comment": (
        points(POINTS.replace(f"{ENTRY},", f"{OTHER}  # mine")),
        (SETUP, f"{OTHER},  # mine\n            {ENTRY},\n"),
    ),
    "entries as a text": (
        points(f"    entry_points='''\n[console_scripts]\n{BAD[1:-1]}\n''',\n"),
        (SETUP, f"[console_scripts]\n{ENTRY[1:-1]}\n"),
    ),
    "entries in setup.cfg": (
        points(""),
        (SETUP, POINTS),
    ),
    "an entry with a blank in its name": (
        points(POINTS.replace("test_node =", "test node =")),
        (SETUP, POINTS),
    ),
    "a group in the other number": (
        points(POINTS.replace("console_scripts", "console_script")),
        (SETUP, POINTS),
    ),
    "three entries without commas": (
        points(POINTS.replace(f"{ENTRY},", f"{ENTRY}\n            {OTHER}\n            "
                              f"{OTHER.replace('other =', 'third =')}")),
        (SETUP, f"{ENTRY},\n            {OTHER},\n"),
    ),
    "no data_files": (
        data_files(""),
        (SETUP, "    data_files=[\n        ('share/ament_index/resource_index/packages', "
                "['resource/' + package_name]),\n    ],\n"),
    ),
    "empty data_files": (
        data_files("    data_files=[],\n"),
        (SETUP, "data_files=[('share/ament_index/resource_index/packages', "
                "['resource/' + package_name])],"),
    ),
    "a marker of another name in data_files": (
        data_files(DATA_FILES.replace("'resource/' + package_name", "'resource/my_robot'")),
        (SETUP, "['resource/my_robot_controller']"),
    ),
    "no export": (export(""), (MANIFEST, f"{EXPORT}</package>")),
    "an empty export": (export("  <export/>\n"),
                        (MANIFEST, "<export><build_type>ament_python</build_type></export>")),
    "an export with nothing in it": (export("  <export>\n  </export>\n"), (MANIFEST, EXPORT)),
    "a build type without export": (
        export("  <build_type>ament_python</build_type>\n"),
        (MANIFEST, "  <export><build_type>ament_python</build_type></export>\n"),
    ),
    "no version": (
        Replace(MANIFEST, "  <version>0.0.0</version>\n", ""),
        (MANIFEST, "  <version>0.0.0</version>\n"),
    ),
    "a tag that is closed under another name": (
        Replace(MANIFEST, "</maintainer>", "</maintaner>"),
        (MANIFEST, "</maintainer>"),
    ),
    "a tag that is not closed": (
        Replace(MANIFEST, "</license>", ""), (MANIFEST, "Apache-2.0</license>\n"),
    ),
    "a package that is not closed": (
        Replace(MANIFEST, "</package>", ""), (MANIFEST, "</export>\n</package>"),
    ),
    "a tag with another name": (
        Replace(MANIFEST, "<build_type>ament_python</build_type>",
                "<build_typ>ament_python</build_typ>"),
        (MANIFEST, EXPORT),
    ),
    "a dependency that is misspelt": (
        Replace(MANIFEST, "<depend>rclpy</depend>", "<depend>rclpyy</depend>"),
        (MANIFEST, "\n  <depend>rclpy</depend>\n"),
    ),
    "a misspelt argument of setup": (
        Replace(SETUP, "    entry_points={", "    entry_point={"), (SETUP, "    entry_points={"),
    ),
    "a manifest with a capital": (Move(MANIFEST, "Package.xml"), (MANIFEST, "<package")),
    "a setup.cfg with a capital": (Move(CFG, "Setup.cfg"), (CFG, "[develop]")),
    "a misspelt section": (Replace(CFG, "[install]", "[instal]"), (CFG, "\n[install]\n")),
    "a misspelt key": (Replace(CFG, "script_dir", "scripts_dir"), (CFG, "\nscript_dir=$base")),
    "blanks around =": (
        Write(CFG, f"[develop]\nscript_dir = $base/bin\n[install]\ninstall_scripts = $base/lib/{INNER}\n"),
        (CFG, f"script_dir=$base/lib/{INNER}\n"),
    ),
    "a section without its key": (
        Write(CFG, f"[develop]\n\n[install]\ninstall_scripts=$base/lib/{INNER}"),
        (CFG, f"[develop]\nscript_dir=$base/lib/{INNER}\n[install]"),
    ),
    "a section at the end, without a last line end": (
        Write(CFG, f"[develop]\nscript_dir=$base/lib/{INNER}"),
        (CFG, f"{INNER}\n[install]\ninstall_scripts=$base/lib/{INNER}"),
    ),
    "keys with a dash": (
        Write(CFG, f"[develop]\nscript-dir=$base/lib/{INNER}\n[install]\n"
                   f"install-scripts=$base/lib/{INNER}\n"),
        (CFG, f"[install]\ninstall_scripts=$base/lib/{INNER}\n"),
    ),
    "a section not closed": (Replace(CFG, "[install]", "[install"), (CFG, "\n[install]\n")),
    "a marker of nearly the name": (Move(MARKER, "resource/My_robot_controller"), (MARKER, "")),
    "a node with a capital": (Move(NODE, f"{INNER}/My_First_Node.py"), (NODE, "class")),
    "a node beside the package's folder": (Move(NODE, "src/my_first_node.py"), (NODE, "class")),
    "no __init__.py": (Delete(f"{INNER}/__init__.py"), (f"{INNER}/__init__.py", "")),
    "no rclpy in the manifest": (
        Replace(MANIFEST, "\n  <depend>rclpy</depend>\n", ""),
        (MANIFEST, "</license>\n  <depend>rclpy</depend>\n"),
    ),
    "a shebang with a blank in front": (
        Replace(NODE, "#!/usr", " #!/usr"), (NODE, "#!/usr/bin/env python3\n\"\"\""),
    ),
    "a shebang without #!": (
        Replace(NODE, "#!/usr", "/usr"), (NODE, "#!/usr/bin/env python3\n\"\"\""),
    ),
    "a shebang after the docstring": (
        Replace(NODE, "#!/usr/bin/env python3\n", "# a node\n#\n#!/usr/bin/env python3\n"),
        (NODE, "#!/usr/bin/env python3\n# a node\n#\n\"\"\""),
    ),
    "a bracket not closed": (
        Replace(NODE, "str(self.counter_))", "str(self.counter_)"),
        (NODE, "str(self.counter_))\n"),
    ),
}  # fmt: skip
MORE: dict[str, tuple[Edit, ...]] = {
    "entries in setup.cfg": (
        Write(CFG, f"[develop]\nscript_dir=$base/lib/{INNER}\n[install]\ninstall_scripts=$base/lib/"
                   f"{INNER}\n[options.entry_points]\nconsole_scripts =\n    {BAD[1:-1]}\n"),
    ),
}  # fmt: skip


@pytest.mark.parametrize("form", FORMS)
def test_the_mistake_is_fixed(form: str, tmp_path: Path) -> None:
    edit, (path, wanted) = FORMS[form]
    plan = plan_of(edited(tmp_path, edit, *MORE.get(form, ())))
    assert not plan.left, plan.left
    if form == "entries in setup.cfg":
        assert BAD[1:-1] not in contents(plan.new)[CFG].decode()
        assert ENTRY[1:-1] in contents(plan.new)[CFG].decode()
        return
    assert wanted in contents(plan.new)[path].decode(), plan.patch.decode()
    changed = [p for p, data in contents(plan.new).items() if contents(plan.old).get(p) != data]
    assert changed == [path]


# Computed values, and mistakes with two possible fixes, are left to the student.
UNCERTAIN: dict[str, tuple[Edit, ...]] = {
    "entries by a function": (points("    entry_points={'console_scripts': entries()},\n"),
                              Replace(SETUP, "\nsetup(", "\ndef entries():\n    return []\n\n\nsetup(")),
    "arguments from elsewhere": (points("    **dict(entry_points={'console_scripts': []}),\n"),),
    "another entry that nobody can read": (points(POINTS.replace(ENTRY, f"{ENTRY}, 'x y z'")),),
    "a CMake package": (Replace(MANIFEST, "ament_python", "ament_cmake"),
                        Write("CMakeLists.txt", "project(x)\n")),
    "two files of the node's name": (Move(NODE, "a/my_first_node.py"),
                                     Write("b/my_first_node.py", "x = 1\n")),
    "no licence": (Replace(MANIFEST, "  <license>Apache-2.0</license>\n", ""),),
    "a document type": (Replace(MANIFEST, "<package ", "<!DOCTYPE a>\n<package "),),
    "a marker that is a folder": (Delete(MARKER), Write(f"{MARKER}/x", "")),
    "a misspelt heading that is indented": (
        Write(CFG, f"  [develp]\nscript_dir=$base/lib/{INNER}\n[install]\n"
                   f"install_scripts=$base/lib/{INNER}\n"),
    ),
}  # fmt: skip


@pytest.mark.parametrize("form", UNCERTAIN)
def test_an_uncertain_fix_is_left_to_the_student(form: str, tmp_path: Path) -> None:
    root = edited(tmp_path, *UNCERTAIN[form])
    plan = plan_of(root)
    assert contents(plan.new) == contents(plan.old), plan.patch.decode()


def test_an_entry_that_exists_twice_is_not_added_again(tmp_path: Path) -> None:
    """Two on one line without a comma between them (found by fuzzing)."""
    entry = "'test_node = my_robot_controller.my_first_node:main'"
    wrong = entry.replace("first", "frist")
    old = plan_of(edited(tmp_path, Replace(SETUP, f"{entry},", f"{entry} {wrong},")))
    assert contents(old.new)[SETUP].count(b"test_node") == 2


def test_a_moved_node_is_named_by_its_entry_at_once(tmp_path: Path) -> None:
    nodes, below = f"{INNER}/nodes", "my_robot_controller.nodes.my_first_node"
    root = edited(
        tmp_path,
        Move(NODE, f"{nodes}/my_first_node.py"),
        Write(f"{nodes}/__init__.py", ""),
        Replace(SETUP, "my_robot_controller.my_first_node", below),
    )
    plan = plan_of(root)
    new = contents(plan.new)
    assert (NODE in new, f"{nodes}/my_first_node.py" in new) == (True, False)
    assert ENTRY in new[SETUP].decode()
    assert below not in new[SETUP].decode()
