"""The catalogue: mistakes at the student's own terminal, known by what it shows."""

from __future__ import annotations

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.kind import Kind

FRESH = msg(
    "A terminal knows of a workspace only after its setup file was sourced in this very terminal."
)


def _lab(
    slug: str, title: str, why: str, fix: str, link: str = links.COLCON, *, seen: str = ""
) -> Kind:
    return Kind(
        id=f"lab.{slug}", stage="terminal", title=title, why=why, fix=fix, link=link, seen=seen
    )


KINDS = (
    _lab("ros_not_sourced", msg("ROS is not sourced in this terminal"),
         msg("The ros2 command is found only after ROS's own setup file was sourced in this "
             "terminal."),
         msg("source /opt/ros/{distro}/setup.bash"),
         links.ENVIRONMENT, seen=r"ros2: (?:command )?not found"),
    _lab("wrong_folder", msg("The workspace's setup file is not in this folder"),
         msg("install/ is made by colcon build in the folder in which it was called: it is there "
             "only after a build, and only in the workspace's root."),
         msg("cd ~/ros2_ws, colcon build --symlink-install, then source install/local_setup.bash"),
         links.WORKSPACE,
         seen=r"install/(?:local_)?setup\.(?:bash|sh|zsh): No such file or directory"),
    _lab("setup_executed", msg("The setup file is executed and not sourced"),
         msg("An executed file changes only its own process; source changes this terminal."),
         msg("source install/local_setup.bash"), links.WORKSPACE,
         seen=r"install/(?:local_)?setup\.(?:bash|sh|zsh): Permission denied"),
    _lab("no_rclpy", msg("Python cannot find rclpy"),
         msg("rclpy is part of ROS: Python sees it only in a terminal in which ROS was sourced, and "
             "only the system's own Python does (not that of conda, a venv or an editor's button)."),
         msg("source /opt/ros/{distro}/setup.bash, and start the node with ros2 run."),
         links.ENVIRONMENT, seen=r"ModuleNotFoundError: No module named 'rclpy'"),
    _lab("overlay_not_sourced", msg("The package is not found in this terminal"), FRESH,
         msg("cd ~/ros2_ws && source install/local_setup.bash (in every new terminal). If that "
             "changes nothing: build first, and compare the package's name."),
         links.WORKSPACE, seen=r"^Package '(?P<package>[^'\n]{1,120})' not found"),
    _lab("no_executable", msg("The package has no such executable"),
         msg("ros2 run looks for the name left of the = in setup.py's console_scripts, in what was "
             "built last. The file's name does not count."),
         msg("ros2 pkg executables shows the names. Is yours missing: add the entry to "
             "console_scripts, build again and source again."),
         links.DEVELOPING, seen=r"^No executable found"),
    _lab("stale_script", msg("The installed script is older than setup.py"),
         msg("The script of an entry that was renamed stays in install/ and finds its entry no "
             "more."),
         msg("Delete the folders build and install of the workspace, and build again."),
         seen=r"^StopIteration$"),
    _lab("old_build", msg("The node still does what it did before the change"),
         msg("Without --symlink-install colcon copies the files: a change is not seen before the "
             "next build."),
         msg("colcon build --symlink-install, after every change of setup.py, too.")),
    _lab("nothing_built", msg("colcon found no package"),
         msg("colcon looks for packages below the folder in which it is called, and leaves out "
             "what holds a file COLCON_IGNORE."),
         msg("cd ~/ros2_ws, and see that the package is in src: colcon list"),
         seen=r"Summary: 0 packages finished"),
    _lab("build_in_src", msg("colcon build was called in src or in the package"),
         msg("colcon makes build, install and log where it is called; a second install tree "
             "confuses the terminal."),
         msg("Delete build, install and log there (not src itself), and build in ~/ros2_ws."),
         links.WORKSPACE, seen=r"/src/(?:[^\s/:]{1,100}/){0,3}(?:install|build)/"),
    _lab("unknown_select", msg("--packages-select names a package that is not there"),
         msg("colcon leaves out a name that it does not know, and builds nothing."),
         msg("Compare '{package}' with the names that colcon list shows."),
         seen=r"ignoring unknown package '(?P<package>[^'\n]{1,120})' in --packages-select"),
    _lab("colcon_arguments", msg("colcon does not know this argument"),
         msg("Options have dashes and no underscores, and verbs are spelt out."),
         msg("colcon build --symlink-install"),
         seen=r"colcon: error: (?:unrecognized arguments: (?P<argument>[^\n]{1,120})"
              r"|argument verb_name: invalid choice[^\n]{0,200})"),
    _lab("build_type_misspelt", msg("ros2 pkg create does not know this build type"),
         msg("There are three build types: ament_python, ament_cmake and cmake."),
         msg("ros2 pkg create --build-type ament_python <package>"), links.PACKAGE,
         seen=r"argument --build-type: invalid choice: '(?P<build_type>[^'\n]{0,80})'"),
    _lab("build_type_forgotten", msg("A C++ package was made"),
         msg("Without --build-type ros2 pkg create makes a package for CMake."),
         msg("Delete the folder, and: ros2 pkg create --build-type ament_python <package>"),
         links.PACKAGE, seen=r"creating \S{0,200}CMakeLists\.txt"),
    _lab("package_name", msg("The package's name is not as ROS wants it"),
         msg("Names of packages have small letters, digits and underscores, and begin with a "
             "letter; a dash cannot be in the name of a Python module."),
         msg("Delete the folder and make the package again with a name such as my_package."),
         links.PACKAGE_NAMES, seen=r"does not follow (?:the )?naming conventions"),
    _lab("nested_package", msg("A package lies inside another one"),
         msg("colcon stops at the first package.xml on its way down: the inner package is never "
             "built, and nothing is said of it."),
         msg("Put the packages side by side into src."), links.PACKAGE),
    _lab("editable", msg("setuptools is too new for colcon"),
         msg("From version 80 on, setuptools has no setup.py develop, which --symlink-install "
             "needs. It was installed by pip over the system's."),
         msg("pip uninstall setuptools (the system's stays), or pip install 'setuptools<80'"),
         seen=r"option --editable not recognized"),
    _lab("setuptools_warning", msg("A warning of setuptools"),
         msg("The build has not failed: setuptools tells its own developers of what will change."),
         msg("Nothing has to be fixed: look at the last line, Summary."),
         seen=r"SetuptoolsDeprecationWarning|EasyInstallDeprecationWarning"),
    _lab("two_nodes", msg("Two nodes run at once"),
         msg("A node that still runs in another terminal goes on counting: two counters come one "
             "between the other."),
         msg("Press Ctrl+C in the other terminal; ros2 node list shows what still runs."),
         links.NODES, seen=r"nodes in the graph that share an exact name"),
    _lab("owned_by_root", msg("Files of the workspace belong to root"),
         msg("A program that ran as root (sudo, a container) made them; your editor may not change "
             "them."),
         msg("sudo chown -R $USER: ~/ros2_ws, and never colcon build with sudo."),
         links.WORKSPACE, seen=r"EACCES: permission denied|PermissionError: \[Errno 13\]"),
)  # fmt: skip
