"""No package, the wrong package, or a package whose parts do not match."""

from __future__ import annotations

from grader.validate.tree import Copy, Delete, Edit, Move, Nest, Replace, Write

from .model import (
    BUILT,
    CFG,
    FOUND,
    INNER,
    INSTALLED,
    MANIFEST,
    MARKER,
    NODE,
    PACKAGE,
    SETUP,
    broken,
)

ALL = tuple(Delete(path) for path in (INNER, "resource", MANIFEST, SETUP, CFG))
MARKER_LINES = """\
        ('share/ament_index/resource_index/packages',
            ['resource/' + package_name]),
"""
OTHER = "my_controller"
CMAKE = """\
cmake_minimum_required(VERSION 3.8)
project(my_robot_controller)
find_package(ament_cmake REQUIRED)
ament_package()
"""
NAME_LINE = f"<name>{PACKAGE}</name>"
TYPE = "<build_type>ament_python</build_type>"
MISSPELT = "my_robot_conroller"


def _called(other: str) -> tuple[Edit, ...]:
    """Return the edits that give the package another name, except to its inner folder."""
    return (
        Replace(MANIFEST, NAME_LINE, f"<name>{other}</name>"),
        Replace(SETUP, f"package_name = '{PACKAGE}'", f"package_name = '{other}'"),
        Write(CFG, f"[develop]\nscript_dir=$base/lib/{other}\n[install]\n"
                   f"install_scripts=$base/lib/{other}\n"),
        Move(MARKER, f"resource/{other}"),
    )  # fmt: skip


def _folder(other: str) -> tuple[Edit, ...]:
    return Replace(SETUP, f"test_node = {PACKAGE}.", f"test_node = {other}."), Move(INNER, other)


PACKAGES = (
    broken("empty_folder", *ALL, failed={"package.found": "package.empty"}, skipped=FOUND, score=0),
    broken("only_a_text", *ALL, Write("submission.txt", "see my repository\n"),
           failed={"package.found": "package.no_manifest"}, skipped=FOUND, score=0),
    broken("only_the_node", *(e for e in ALL if e.path != INNER), Delete(f"{INNER}/__init__.py"),
           Move(NODE, "my_first_node.py"),
           failed={"package.found": "package.only_node"}, skipped=FOUND, score=0,
           note="only the node's file"),
    broken("manifest_and_setup_missing", Delete(MANIFEST), Delete(SETUP),
           failed={"package.found": "package.no_manifest"}, skipped=FOUND, score=0),
    broken("no_manifest", Delete(MANIFEST), failed={"package.manifest": "package.no_manifest"},
           skipped=BUILT, score=45, note="colcon takes the folder for plain Python"),
    broken("two_of_one_name", Nest(f"src/{PACKAGE}"), Copy(f"src/{PACKAGE}", "src/first_try"),
           failed={"package.found": "package.duplicate"}, skipped=FOUND, score=0,
           note="which of the two is meant is unknown"),
    *(
        broken(name, Nest(f"src/{PACKAGE}"), Copy(f"src/{PACKAGE}", f"src/{copy}"),
               Replace(f"src/{copy}/{NODE}", "import rclpy\n", "import rclpi\n"),
               failed={"build.colcon": "package.duplicate"}, score=95,
               note="colcon refuses both, but which one is meant is clear")
        for name, copy in (("backup_beside", "backup"), ("old_beside", f"{PACKAGE}_old"),
                           ("copy_beside", f"{PACKAGE} copy"))
    ),
    broken("unfinished_beside", Nest(f"src/{PACKAGE}"), Copy(f"src/{PACKAGE}", "src/first_try"),
           Delete(f"src/first_try/{NODE}"), failed={"build.colcon": "package.duplicate"}, score=95,
           note="the other one lacks the node"),
    *(
        broken(name, *_called(other), *more, failed={"package.manifest": "package.name_mismatch"},
               score=95, note=note)
        for name, other, more, note in (
            ("other_name_throughout", OTHER, _folder(OTHER), "builds and runs under its own name"),
            ("name_misspelt_throughout", MISSPELT, _folder(MISSPELT), ""),
            ("name_misspelt_but_the_folder", MISSPELT, (), "the inner folder has the right name"),
        )
    ),
    broken("cmake_package", *(Delete(p) for p in (SETUP, CFG, "resource", INNER)),
           Write("CMakeLists.txt", CMAKE), Replace(MANIFEST, "ament_python", "ament_cmake"),
           failed={"package.manifest": "package.build_type",
                   "package.marker": "package.marker_missing",
                   "package.setup_cfg": "package.setup_cfg_missing", "source.node_file": "source.no_node_file",
                   "entry_point.mapping": "setup.missing"},
           skipped=BUILT | {"source.exec_bit", "source.shebang"}, score=5,
           note="--build-type forgotten"),
    broken("manifest_not_xml", Replace(MANIFEST, "</description>", "</decription>"),
           failed={"package.manifest": "package.broken_xml"}, skipped=BUILT, score=45,
           note="colcon takes it for plain Python: it builds, and ros2 run does not find it"),
    broken("manifest_empty", Write(MANIFEST, ""),
           failed={"package.manifest": "package.broken_xml"}, skipped=BUILT, score=45),
    broken("manifest_not_utf8", Write(MANIFEST, b'<?xml version="1.0"?>\n<package format="3">'
           b"<name>my_robot_controller</name><version>0.0.0</version><description>f\xfcr"
           b"</description></package>\n"),
           failed={"package.manifest": "package.broken_xml"}, skipped=BUILT, score=45),
    broken("manifest_other_name", Replace(MANIFEST, NAME_LINE, "<name>my_robot_controler</name>"),
           failed={"package.manifest": "package.name_mismatch"}, score=95,
           note="runs anyway: marker, setup.cfg and setup.py have the right name"),
    broken("setup_other_name",
           Replace(SETUP, "name=package_name", "name='my_robot'"),
           failed={"package.manifest": "package.name_mismatch"}, score=95),
    broken("setup_variable_other_name",
           Replace(SETUP, f"package_name = '{PACKAGE}'", "package_name = 'robot_controller'"),
           failed={"package.manifest": "package.name_mismatch",
                   "package.marker": "package.marker_missing"}, skipped=BUILT, score=40),
    broken("build_type_missing", Replace(MANIFEST, f"    {TYPE}\n", ""),
           failed={"package.manifest": "package.build_type"}, skipped=BUILT, score=45),
    broken("build_type_cmake", Replace(MANIFEST, "ament_python", "ament_cmake"),
           failed={"package.manifest": "package.build_type"}, skipped=BUILT, score=45),
    broken("build_type_misspelt", Replace(MANIFEST, "ament_python", "ament_pyton"),
           failed={"package.manifest": "package.build_type"}, skipped=BUILT, score=45),
    broken("marker_missing", Delete(MARKER), failed={"package.marker": "package.marker_missing"},
           skipped=BUILT, score=45),
    broken("marker_folder_missing", Delete("resource"),
           failed={"package.marker": "package.marker_missing"}, skipped=BUILT, score=45,
           note="git keeps no empty folders, and some tools drop empty files"),
    broken("marker_misnamed", Move(MARKER, "resource/my_robot_controler"),
           failed={"package.marker": "package.marker_missing"}, skipped=BUILT, score=45),
    broken("marker_not_installed", Replace(SETUP, MARKER_LINES, ""),
           failed={"package.marker": "package.marker_not_installed"}, score=95,
           note="colcon warns and makes one itself"),
    broken("setup_cfg_missing", Delete(CFG),
           failed={"package.setup_cfg": "package.setup_cfg_missing"},
           skipped=INSTALLED, score=50, note="the script lands in bin"),
    broken("setup_cfg_empty", Write(CFG, ""),
           failed={"package.setup_cfg": "package.setup_cfg_wrong"}, skipped=INSTALLED, score=50),
    broken("setup_cfg_not_ini", Replace(CFG, "[develop]", "[develop"),
           failed={"package.setup_cfg": "package.setup_cfg_syntax"}, skipped=BUILT, score=45),
    broken("setup_cfg_other_package",
           Write(CFG, "[develop]\nscript_dir=$base/lib/my_robot\n"
                      "[install]\ninstall_scripts=$base/lib/my_robot\n"),
           failed={"package.setup_cfg": "package.setup_cfg_wrong"}, skipped=INSTALLED, score=50),
    broken("setup_cfg_without_develop",
           Write(CFG, f"[install]\ninstall_scripts=$base/lib/{PACKAGE}\n"),
           failed={"package.setup_cfg": "package.setup_cfg_wrong"}, score=95,
           note="colcon 0.21 does not need it"),
    broken("setup_cfg_without_install",
           Write(CFG, f"[develop]\nscript_dir=$base/lib/{PACKAGE}\n"),
           failed={"package.setup_cfg": "package.setup_cfg_wrong"}, score=95,
           note="works with --symlink-install; without, the script lands in bin"),
    broken("setup_cfg_bin", Write(CFG, "[develop]\nscript_dir=$base/bin\n"
                                       "[install]\ninstall_scripts=$base/bin\n"),
           failed={"package.setup_cfg": "package.setup_cfg_wrong"}, skipped=INSTALLED, score=50),
)  # fmt: skip
