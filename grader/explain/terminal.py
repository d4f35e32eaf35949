"""Mistakes at the student's own terminal, recognised by what it shows."""

from __future__ import annotations

from types import MappingProxyType
from typing import TYPE_CHECKING

from grader.base.i18n.message import msg
from grader.explain.environment import CONDA, OWN_INTERFACES, VENV
from grader.explain.terminal_text import TerminalText
from grader.mistakes import links

if TYPE_CHECKING:
    from collections.abc import Mapping

FRESH = msg("A terminal knows a workspace only after you source its setup file in that terminal.")

OF_ROS = (  # packages of ROS that tutorials run, and that a small installation lacks
    r"turtlesim|turtle_tf2_\w{1,20}|demo_nodes_(?:cpp|py)|examples_rclpy_\w{1,40}|image_tools"
    r"|rviz2|rqt(?:_\w{1,40})?|tf2_(?:tools|ros)|joint_state_publisher(?:_gui)?"
    r"|robot_state_publisher|xacro|teleop_twist_(?:keyboard|joy)|joy|gazebo_ros|ros_gz_\w{1,20}"
    r"|nav2_\w{1,40}|slam_toolbox|usb_cam|cv_bridge"
)


NONE: Mapping[str, str] = MappingProxyType({})


def _lab(
    slug: str,
    title: str,
    why: str,
    fix: str,
    link: str = links.COLCON,
    *,
    seen: str = "",
    unless: str = "",
    values: Mapping[str, str] = NONE,
    chosen: Mapping[str, str] = NONE,
    fixes: Mapping[str, str] = NONE,
) -> TerminalText:
    return TerminalText(
        id=f"lab.{slug}", stage="terminal", title=title, why=why, fix=fix, link=link, seen=seen,
        unless=unless, values=values, chosen=chosen, fixes=fixes,
    )  # fmt: skip


KINDS = (
    _lab("ros_not_sourced", msg("ROS is not sourced in this terminal"),
         msg("The ros2 command is found only after you source ROS's own setup file in this "
             "terminal."),
         msg("Run: source /opt/ros/{distro}/setup.bash"),
         links.ENVIRONMENT, seen=r"ros2: (?:command )?not found|command not found: ros2|[Cc]ommand 'ros2' not found"),
    _lab("wrong_folder", msg("The workspace's setup file is not in this folder"),
         msg("colcon build creates install/ in the folder in which you run it. So install/ exists "
             "only after a build, and only in the workspace's root."),
         msg("Run cd ~/ros2_ws, then colcon build --symlink-install, then source "
             "install/local_setup.bash"),
         links.WORKSPACE,
         seen=r"install/(?:local_)?setup\.(?:bash|sh|zsh): No such file or directory"),
    _lab("setup_executed", msg("The setup file is executed instead of sourced"),
         msg("An executed file changes only its own process; source changes this terminal."),
         msg("Run: source install/local_setup.bash"), links.WORKSPACE,
         seen=r"install/(?:local_)?setup\.(?:bash|sh|zsh): Permission denied"),
    _lab("no_rclpy", msg("Python cannot find rclpy"),
         msg("rclpy is part of ROS. Python finds it only in a terminal in which ROS is sourced, "
             "and only the system's own Python does (not that of conda, a venv or an editor's "
             "button)."),
         msg("Run source /opt/ros/{distro}/setup.bash, and start the node with ros2 run."),
         links.ENVIRONMENT, seen=r"ModuleNotFoundError: No module named 'rclpy'",
         chosen={"conda": CONDA, "venv": VENV},
         fixes={
             "conda": msg("Run conda deactivate and source /opt/ros/{distro}/setup.bash, and start the "
                          "node with ros2 run."),
             "venv": msg("Run deactivate and source /opt/ros/{distro}/setup.bash, and start the node "
                         "with ros2 run."),
         }),
    _lab("not_installed", msg("This package of ROS is not installed here"),
         msg("{package} is a package of ROS, not one of your workspace. A small installation of ROS, "
             "such as the lab's, has only what the lessons need. Building or sourcing your "
             "workspace does not add it."),
         msg("Ask your instructor if a lesson needs it. On a machine of your own, install it: sudo "
             "apt-get install ros-{distro}-{debian}"),
         links.INSTALLATION, seen=rf"^Package '(?P<package>{OF_ROS})' not found"),
    _lab("overlay_not_sourced", msg("The package is not found in this terminal"), FRESH,
         msg("Source the workspace in every new terminal: cd ~/ros2_ws && source "
             "install/local_setup.bash. If that does not help, build first, and compare the "
             "package's name."),
         links.WORKSPACE, seen=r"^Package '(?P<package>[^'\n]{1,120})' not found"),
    _lab("no_executable", msg("The package has no executable with that name"),
         msg("ros2 run looks in install/{package}/lib/{package} for an executable file with the name to "
             "the left of the = in console_scripts in setup.py. The file's name does not count."),
         msg("Run ros2 pkg executables {package} and ls -l install/{package}/lib/{package} "
             "install/{package}/bin in the workspace, and compare:\n"
             "- setup.py has no entry with the name: add it to console_scripts, and build.\n"
             "- setup.py has it, install has it nowhere: it was not built since. Run colcon build "
             "--symlink-install and source the workspace again.\n"
             "- It is in bin: setup.cfg lacks script_dir and install_scripts with "
             "$base/lib/{package}.\n"
             "- It is in lib/{package} without an x: delete build and install, and build again."),
         links.DEVELOPING, seen=r"^No executable found",
         chosen={"ros": rf"ros2 run (?P<package>{OF_ROS}) ", "named": r"ros2 run (?P<package>\w{1,100}) "},
         fixes={"ros": msg("Run ros2 pkg executables {package} to see the names, and compare.")}),
    _lab("launch_not_installed", msg("The launch file is not installed"),
         msg("ros2 launch looks in install/{package}/share/{package}, and not in src. setup.py installs "
             "only the files that data_files names."),
         msg("Add this line to data_files in setup.py, then build and source the workspace again: "
             "('share/' + package_name + '/launch', glob('launch/*')). At the top of setup.py: from "
             "glob import glob. In a package with CMakeLists.txt: install(DIRECTORY launch DESTINATION "
             "share/${{PROJECT_NAME}}). If it is installed, compare the name with {file}"),
         links.LAUNCH,
         seen=r"file '(?P<file>[^'\n]{1,200})' was not found in the share directory of package "
              r"'(?P<package>[^'\n]{1,120})'(?! which is at '/opt/ros/)",
         values={"file": "my_robot.launch.py"}),
    _lab("exec_format", msg("The installed file is no program of this computer"),
         msg("Linux starts a file by its first line, such as #!/usr/bin/env python3, or by its format. "
             "{path} has neither for this computer."),
         msg("If it is a Python file: write #!/usr/bin/env python3 as the first line of its source, "
             "before everything else. If it was compiled on another computer: delete the folders build "
             "and install. Then build again."),
         seen=r"OSError: \[Errno 8\] Exec format error: '(?P<path>[^'\n]{1,300})'"),
    _lab("field_type", msg("A field of a message gets a value of another type"),
         msg("A field of a ROS message accepts only its own type. For Python, 2 is an int and 2.0 is "
             "a float."),
         msg("Give the field {field} a value of the type {type}. If the value is in a variable: "
             "{type}(…)"),
         links.INTERFACES,
         seen=r"AssertionError: The '(?P<field>\w{1,80})' (?:numpy array |array |\w{0,20} ?)field must be of type "
              r"'(?P<type>int|float|str|bool)'",
         chosen={"number": r"\.(?P<field>\w{1,80}) = (?P<value>-?\d{1,9})\n(?:[ ~^]{1,200}\n)?[^\n]*\n[^\n]*\n"
                           r"(?:[ ~^]{1,200}\n)?AssertionError: The '(?P=field)' field must be of type 'float'"},
         fixes={"number": msg("Write {field} = {value}.0 instead of {field} = {value}.")},
         values={"field": "x", "type": "float", "value": "2"}),
    _lab("no_module", msg("Python does not find the module"),
         msg("Python looks for {module} in its own modules, in those of ROS, and in the packages of the "
             "workspaces that this terminal has sourced."),
         msg("If {module} is a file of your package, import it with the package's name: from "
             "my_package.{module} import …. If it is a package of yours, build it and source the "
             "workspace. If it is from the internet, install it with apt: its name begins with "
             "python3-. Otherwise compare the spelling."),
         links.PYTHON_MODULES,
         seen=r"ModuleNotFoundError: No module named '(?P<module>(?!rclpy['.])[\w.]{1,200})'",
         chosen={"entry": r"^  File \"<frozen importlib\._bootstrap>\", line \d{1,6}, in \w{1,60}\n"
                          r"ModuleNotFoundError: No module named '(?P<module>\w{1,200})'"},
         fixes={
             "entry": msg("An entry of console_scripts in setup.py names it: write name = "
                          "package.module:function there, with the package's name first. If {module} "
                          "is the package: the folder {module} with an __init__.py has to be beside "
                          "setup.py. Then build again."),
         },
         values={"module": "my_module"}),
    _lab("stale_script", msg("The installed script is older than setup.py"),
         msg("The script of a renamed entry stays in install/, but no longer finds its entry."),
         msg("Delete the folders build and install of the workspace, and build again."),
         seen=r"^StopIteration$"),
    _lab("built_both_ways", msg("The workspace was built with and without --symlink-install"),
         msg("Without --symlink-install, colcon copies the files of an interface package into build/; "
             "with it, colcon makes links there. It does not replace a folder by a link."),
         msg("Delete the folders build and install of the workspace, and build again, from now on "
             "always with: colcon build --symlink-install"),
         seen=r"failed to create symbolic link '?(?P<path>[^'\n]{1,300}?)'? because existing path "
              r"cannot be removed"),
    _lab("old_build", msg("The node still does what it did before the change"),
         msg("Without --symlink-install, colcon copies the files: a change has no effect until "
             "the next build."),
         msg("Run colcon build --symlink-install, also after every change of setup.py.")),
    _lab("nothing_built", msg("colcon found no package"),
         msg("colcon looks for packages below the folder in which you run it, and skips folders "
             "with a file COLCON_IGNORE."),
         msg("Run cd ~/ros2_ws, then colcon list, and check that the package is in src."),
         # (of a failed build, the next line says: 1 package failed)
         seen=r"Summary: 0 packages finished[^\n]{0,40}$"
              r"(?!\n +\d+ packages? (?:failed|aborted|not processed))",
         unless="ignoring unknown package|Duplicate package names not supported"),
    _lab("build_in_src", msg("colcon build was run in src or in the package"),
         msg("colcon creates build, install and log where you run it; a second install folder "
             "confuses the terminal."),
         msg("Delete build, install and log there (not src itself), and build in ~/ros2_ws."),
         links.WORKSPACE, seen=r"/src/(?:[^\s/:]{1,100}/){0,3}(?:install|build)/"),
    _lab("unknown_select", msg("--packages-select names a package that does not exist"),
         msg("colcon ignores a name that it does not know, and builds nothing."),
         msg("Compare '{package}' with the names that colcon list shows."),
         seen=r"ignoring unknown package '(?P<package>[^'\n]{1,120})' in --packages-select"),
    _lab("colcon_arguments", msg("colcon does not know this argument"),
         msg("Options have dashes, not underscores, and verbs are written in full."),
         msg("Run: colcon build --symlink-install"),
         seen=r"colcon: error: (?:unrecognized arguments: (?P<argument>[^\n]{1,120})"
              r"|argument verb_name: invalid choice[^\n]{0,200})"),
    _lab("build_type_misspelt", msg("ros2 pkg create does not know this build type"),
         msg("There are three build types: ament_python, ament_cmake and cmake."),
         msg("Run: ros2 pkg create --build-type ament_python <package>"), links.PACKAGE,
         seen=r"argument --build-type: invalid choice: '(?P<build_type>[^'\n]{0,80})'"),
    _lab("build_type_forgotten", msg("A C++ package was created"),
         msg("Without --build-type, ros2 pkg create creates a package for CMake."),
         msg("Delete the folder, then run: ros2 pkg create --build-type ament_python <package>"),
         links.PACKAGE, seen=r"creating \S{0,200}CMakeLists\.txt",
         unless=rf"--build-type|creating \S{{0,100}}{OWN_INTERFACES}/"),
    _lab("package_name", msg("The package's name breaks ROS's naming rules"),
         msg("Package names contain only lowercase letters, digits and underscores, and begin with "
             "a letter. A Python module's name cannot contain a dash."),
         msg("Delete the folder and create the package again with a name such as my_package."),
         links.PACKAGE_NAMES, seen=r"does not follow (?:the )?naming conventions"),
    _lab("nested_package", msg("A package is inside another package"),
         msg("colcon stops at the first package.xml on its way down: it never builds the inner "
             "package, and prints no message about it."),
         msg("Put the packages side by side in src."), links.PACKAGE),
    _lab("editable", msg("setuptools is too new for colcon"),
         msg("From version 80 on, setuptools has no setup.py develop, which --symlink-install "
             "needs. pip installed this version over the system's."),
         msg("Run pip uninstall setuptools (the system's version stays), or pip install "
             "'setuptools<80'"),
         seen=r"option --editable not recognized"),
    _lab("setuptools_warning", msg("setuptools prints a warning"),
         msg("The build did not fail: the warning is for developers of setuptools and tells them "
             "what will change."),
         msg("You do not have to fix anything. Look at the last line, Summary."),
         seen=r"SetuptoolsDeprecationWarning|EasyInstallDeprecationWarning"),
    _lab("two_nodes", msg("Two nodes run at the same time"),
         msg("A node that still runs in another terminal keeps counting: the lines of two counters "
             "are mixed."),
         msg("Press Ctrl+C in the other terminal. ros2 node list shows what still runs."),
         links.NODES, seen=r"nodes in the graph that share an exact name"),
    _lab("owned_by_root", msg("Files of the workspace belong to root"),
         msg("A program that ran as root (sudo, a container) created them; your editor may not "
             "change them."),
         msg("Run sudo chown -R $USER: ~/ros2_ws, and never run colcon build with sudo."),
         links.WORKSPACE,
         seen=r"EACCES: permission denied|PermissionError: \[Errno 13\] Permission denied: '(?!/dev/)"),
)  # fmt: skip
