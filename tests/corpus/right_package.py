"""The same node in other packages: manifests, entry points, layouts, extra files."""

from __future__ import annotations

from grader.package.edit.tree import Chmod, Copy, Crlf, Nest, Replace, Write

from .model import CFG, INNER, MANIFEST, NODE, PACKAGE, SETUP, right

ENTRY = "            'test_node = my_robot_controller.my_first_node:main',\n"
POINTS = f"    entry_points={{\n        'console_scripts': [\n{ENTRY}        ],\n    }},\n"
INI = """\
    entry_points='''
        [console_scripts]
        test_node = my_robot_controller.my_first_node:main
    ''',
"""
OPTIONS = """
[options.entry_points]
console_scripts =
    test_node = my_robot_controller.my_first_node:main
"""
SCRIPTS = """\
scripts = ['test_node = ' + package_name + '.my_first_node:main']

setup(
"""
SECOND = """\
#!/usr/bin/env python3
def main():
    print('not a node')
"""
README = "# Week 1\n\nMy first node.\n"
DEPENDS = "  <depend>rclpy</depend>\n"
DASHED = """\
[develop]
script-dir=$base/lib/my_robot_controller
[install]
install-scripts=$base/lib/my_robot_controller
"""
ONLY_INSTALL = "[install]\ninstall_scripts=$base/lib/my_robot_controller\n"
FORMAT_2 = """\
<?xml version="1.0"?>
<package format="2">
  <name>my_robot_controller</name>
  <version>1.2.3</version>
  <description>TODO: Package description</description>
  <maintainer email="a@b.example">A &amp; B</maintainer>
  <license>TODO: License declaration</license>
  <exec_depend>rclpy</exec_depend>
  <!-- <build_type>ament_cmake</build_type> -->
  <export>
    <build_type>ament_python</build_type>
  </export>
</package>
"""
STALE = "import os\n\nraise SystemExit('an old copy that nobody may run')\n"

PACKAGING = (
    right("setup_cfg_without_develop", Write(CFG, ONLY_INSTALL)),
    right("two_entries", Write(f"{INNER}/second.py", SECOND, 0o755),
          Replace(SETUP, ENTRY, ENTRY + ENTRY.replace("test_node", "other")
                  .replace("my_first_node", "second"))),
    right("other_entry_misses_its_module",
          Replace(SETUP, ENTRY, ENTRY + "            'other = my_robot_controller.gone:main',\n"),
          note="8 of 147 public packages; not part of the assignment"),
    right("entry_without_blanks", Replace(SETUP, "test_node = my", "test_node=my")),
    right("entry_double_quotes", Replace(SETUP, ENTRY, ENTRY.replace("'", '"'))),
    right("entry_without_last_comma", Replace(SETUP, ENTRY, ENTRY.replace(",", ""))),
    right("entry_points_ini", Replace(SETUP, POINTS, INI)),
    right("entry_points_in_setup_cfg", Replace(SETUP, POINTS, ""),
          Write(CFG, "[develop]\nscript_dir=$base/lib/my_robot_controller\n[install]\n"
                "install_scripts=$base/lib/my_robot_controller\n" + OPTIONS)),
    right("entry_points_computed", Replace(SETUP, "setup(\n", SCRIPTS),
          Replace(SETUP, f"[\n{ENTRY}        ]", "scripts"), note="known only by running setup.py"),
    right("packages_listed", Replace(SETUP, "find_packages(exclude=['test'])", "[package_name]")),
    right("names_spelled_out", Replace(SETUP, "name=package_name", f"name='{PACKAGE}'"),
          Replace(SETUP, "'resource/' + package_name", f"'resource/{PACKAGE}'"),
          Replace(SETUP, "'share/' + package_name", f"f'share/{PACKAGE}'"),
          Replace(SETUP, f"package_name = '{PACKAGE}'\n\n", "")),
    right("setup_by_distutils_habit", Replace(SETUP, "from setuptools import setup\n",
          "import setuptools\n"), Replace(SETUP, "\nsetup(\n", "\nsetuptools.setup(\n")),
    right("launch_and_config", Write("launch/hello.launch.py", "# later\n"),
          Replace(SETUP, "        ('share/' + package_name, ['package.xml']),\n",
                  "        ('share/' + package_name, ['package.xml']),\n"
                  "        ('share/' + package_name + '/launch', ['launch/hello.launch.py']),\n")),
    right("setup_cfg_dashed", Write(CFG, DASHED), note="5 of 147; setuptools warns"),
    right("setup_cfg_blanks", Replace(CFG, "install_scripts=", "install_scripts = "),
          Replace(CFG, "script_dir=", "script_dir = ")),
    right("setup_cfg_with_more", Replace(CFG, "[develop]", "[metadata]\nurl = x\n\n[develop]")),
    right("extra_dependencies",
          Replace(MANIFEST, DEPENDS, DEPENDS + "  <depend>std_msgs</depend>\n"
                  "  <depend>geometry_msgs</depend>\n  <depend>turtlesim</depend>\n")),
    right("no_rclpy_dependency", Replace(MANIFEST, DEPENDS, ""),
          note="what `ros2 pkg create` makes without --dependencies; it runs"),
    right("manifest_format_2", Write(MANIFEST, FORMAT_2)),
    right("manifest_crlf", Crlf(MANIFEST)),
    right("setup_crlf", Crlf(SETUP), Crlf(CFG), note="Windows editor; Python accepts it"),
    right("shebang_usr_bin_python3",
          Replace(NODE, "#!/usr/bin/env python3", "#!/usr/bin/python3")),
    right("shebang_env_with_flag",
          Replace(NODE, "#!/usr/bin/env python3", "#!/usr/bin/env -S python3 -u")),
    right("mode_0775", Chmod(NODE, 0o775)),
    right("mode_0700", Chmod(NODE, 0o700)),
    right("workspace", Nest(f"src/{PACKAGE}"), note="the whole workspace is submitted"),
    right("workspace_with_neighbour", Nest(f"src/{PACKAGE}"),
          Copy(f"src/{PACKAGE}", "src/my_other_package"),
          Replace(f"src/my_other_package/{MANIFEST}", f"<name>{PACKAGE}<",
                  "<name>my_other_package<"),
          Replace(f"src/my_other_package/{SETUP}", f"package_name = '{PACKAGE}'",
                  "package_name = 'my_other_package'"),
          note="another, unfinished package beside it (whether it builds does not matter)"),
    right("repository", Nest(f"ros2/week_1/{PACKAGE}"), Write("README.md", README),
          Write("docs/notes.md", README), note="the package deep in a repository"),
    right("folder_only", Nest(PACKAGE), note="a folder with the package in it, as archives have"),
    right("readme_crlf", Write("README.md", README), Crlf("README.md")),
    right("built_in_package", Write("build/x.log", "x\n"), Write("install/setup.bash", "exit 1\n"),
          Write("log/latest/events.log", "x\n"), note="colcon was run in the package; 47 of 147"),
    right("built_workspace", Nest(f"src/{PACKAGE}"),
          Copy(f"src/{PACKAGE}/{INNER}", f"build/{PACKAGE}/{INNER}"),
          Write(f"build/{PACKAGE}/setup.py", STALE),
          Write(f"install/{PACKAGE}/lib/{PACKAGE}/test_node", STALE, 0o755),
          Write(f"install/{PACKAGE}/share/ament_index/resource_index/packages/{PACKAGE}", ""),
          Copy(f"src/{PACKAGE}/{MANIFEST}", f"install/{PACKAGE}/share/{PACKAGE}/package.xml"),
          Write("install/.colcon_install_layout", "merged\n"), Write("log/COLCON_IGNORE", ""),
          note="committed build, install and log of another machine, with stale copies"),
    right("compiled", Write(f"{INNER}/__pycache__/my_first_node.cpython-312.pyc", b"\0\1\2stale"),
          note="105 of 147 committed __pycache__"),
    right("egg_info",
          Write(f"{PACKAGE}.egg-info/entry_points.txt", "[console_scripts]\nold = a:b\n"),
          Write(f"{PACKAGE}.egg-info/PKG-INFO", "Metadata-Version: 2.1\nName: old\nVersion: 0\n")),
    right("editor_and_system_files", Write(".vscode/settings.json", "{}\n"),
          Write(".DS_Store", b"\0\0\0\1Bud1"), Write(f"{INNER}/.my_first_node.py.swp", b"b0VIM\0\xff")),
    right("tests_of_the_template", Write("test/test_flake8.py", "def test_nothing():\n    pass\n"),
          Replace(SETUP, "    license=", "    tests_require=['pytest'],\n    license=")),
    right("no_license_text", Replace(MANIFEST, "Apache-2.0", "TODO: License declaration"),
          Replace(SETUP, "'Apache-2.0'", "'TODO: License declaration'")),
    right("draft_beside", Write("drafts/my_first_node.py", "def broken(:\n"),
          note="a draft that nothing uses"),
)  # fmt: skip
