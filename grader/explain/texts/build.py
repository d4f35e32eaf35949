"""Building and creating packages: colcon, setup.py, CMake, the compiler."""

from __future__ import annotations

from grader.base.i18n.message import msg
from grader.explain import looks
from grader.explain.terminal_text import Case, TerminalText
from grader.explain.texts.names import OWN_INTERFACES, ROS_INTERFACES
from grader.mistakes import links

KINDS = (
    TerminalText(
        id="lab.manifest", link=links.MANIFEST,
        title=msg("package.xml has a mistake"),
        why=msg("colcon reads package.xml before it builds. It says: {problem}"),
        fix=msg("Correct it in {path}, then build again."),
        seen=r"Error\(s\) in package '(?P<path>[^'\n]{1,300})':\s{1,40}(?P<problem>[^\n]{1,300}(?:(?<=:)\n[^\n]{1,100})?)"
             r"|Failed to parse (?:potential )?(?:ROS )?package(?: manifest)? (?:in )?"
             r"'(?P<path_2>[^'\n]{1,300})':? (?P<problem_2>[^\n]{1,300})",
        values={"problem": "The manifest must contain exactly one 'version' tags",
                "path": "src/my_package/package.xml"},
    ),
    TerminalText(
        id="lab.dashed_key", link=links.SETUP_CFG,
        title=msg("setup.cfg has a key with a dash"),
        why=msg("setuptools accepts only underscores in the keys of setup.cfg. Up to version 77 it printed "
                "a warning; from version 78 on it is an error."),
        fix=msg("Write underscores in setup.cfg: script_dir in [develop], install_scripts in [install]. "
                "Then build again."),
        seen=r"Invalid dash-separated key '(?P<key>[\w-]{1,80})'|Usage of dash-separated '[\w-]{1,80}'",
        shown={
            r"dash-separated (?:key )?'(?P<key>[\w-]{1,80})'[^\n]{0,200}underscore name "
            r"'(?P<wanted>\w{1,80})'": msg("{key} has to be {wanted}."),
        },
    ),
    TerminalText(
        id="lab.file_to_install", link=links.DEVELOPING,
        title=msg("setup.py names a file that is not there"),
        why=msg("data_files in setup.py lists the files to install. Paths begin in the folder of setup.py, "
                "and there is no {file}."),
        fix=msg("Run ls in the folder of setup.py and compare: folder, name and ending have to be the "
                "same. For all files of a folder, write glob('launch/*') with from glob import glob at the "
                "top. Then build again."),
        seen=r"can't copy '(?P<file>(?!\S{0,300}resource/)[^'\n]{1,300})': doesn't exist or not a regular",
        values={"file": "launch/robot.launch.py"},
    ),
    TerminalText(
        id="lab.package_folder", link=links.PACKAGE,
        title=msg("The package's folder with the Python code is not there"),
        why=msg("packages in setup.py names the folder {folder}. It has to be beside setup.py, with an "
                "__init__.py in it."),
        fix=msg("Run ls in the folder of setup.py. If the folder has another name, rename it or write its "
                "name into packages. If it is missing: mkdir {folder} && touch {folder}/__init__.py, and "
                "put your node there. Then build again."),
        seen=r"error: package directory '(?P<folder>[^'\n]{1,200})' does not exist",
        values={"folder": "my_package"},
    ),
    TerminalText(
        id="lab.memory", link=links.COLCON,
        title=msg("The computer ran out of memory during the build"),
        why=msg("Linux ended the compiler because there was no memory left: several files are compiled at "
                "the same time."),
        fix=msg("Run MAKEFLAGS=-j1 colcon build --executor sequential, which compiles one file at a time. "
                "If that is not enough, add swap, or install the package with apt instead of building "
                "it."),
        seen=r"(?:fatal|internal compiler) error: Killed[^\n]{0,80}|virtual memory exhausted"
             r"|cc1plus: out of memory",
    ),
    TerminalText(
        id="lab.overridden", link=links.WORKSPACE,
        title=msg("A package is in your workspace and in ROS"),
        why=msg("This is a warning. There are two of {package} now: the one of ROS, and yours, which is "
                "used after you source the workspace."),
        fix=msg("If you want that, add --allow-overriding {package}. If not, delete the package from src, "
                "or give yours another name."),
        seen=r"already built in one or more underlay workspaces:(?:\s{1,20}'(?P<package>[\w-]{1,120})')?",
        values={"package": "turtlesim"},
    ),
    TerminalText(
        id="lab.cmake_version", link=links.COLCON,
        title=msg("The package is made for an older CMake"),
        why=msg("CMake 4 does not read packages that are made for versions before 3.5."),
        fix=msg("Write cmake_minimum_required(VERSION 3.8) in the first line of the package's "
                "CMakeLists.txt. If it is not your package: pip uninstall cmake, so that apt's CMake is "
                "used, or colcon build --cmake-args -DCMAKE_POLICY_VERSION_MINIMUM=3.5"),
        seen=r"Compatibility with CMake < 3\.5 has been removed",
    ),
    TerminalText(
        id="lab.underlay", link=links.ENVIRONMENT,
        title=msg("CMake does not find ROS"),
        why=msg("{package} is a package of ROS. CMake finds it only if ROS is sourced in the terminal of "
                "the build."),
        fix=msg("Run source /opt/ros/{distro}/setup.bash, delete the folder build, and build again. If that "
                "does not help, the package is not installed: sudo apt-get install ros-{distro}-{debian}"),
        seen=r"By not providing \"Find(?P<package>(?:ament|rosidl|rclcpp|rcl|rmw)(?:_\w{1,60})?|"
             rf"{ROS_INTERFACES})\.cmake\"",
        values={"package": "ament_cmake", "debian": "ament-cmake"}, look=(looks.ros_sourced,),
    ),
    TerminalText(
        id="lab.cmake_package", link=links.INTERFACES,
        title=msg("CMake does not find a package"),
        why=msg("{package} is not installed in ROS, and not in a workspace that this terminal has sourced. A "
                "package of this workspace is built before another one only if package.xml of that one names "
                "it."),
        fix=msg("If {package} is a package of ROS, install it: sudo apt-get install ros-{distro}-{debian}. If "
                "it is one of yours: write <depend>{package}</depend> in package.xml of the package that needs "
                "it, check that colcon list shows both, and build again."),
        seen=r"By not providing \"Find(?P<package>\w{1,100})\.cmake\"",
        look=(looks.package_built,),
    ),
    TerminalText(
        id="lab.copied", stage="terminal", link=links.COLCON,
        title=msg("--symlink-install has copied the files"),
        why=msg("A setuptools of version 80 or newer cannot make links to your files. colcon then copies "
                "them, without a message: a change has no effect until the next build."),
        fix=msg("Run colcon build after every change. Or, so that links are made again: pip install "
                "'setuptools<80' (pip uninstall setuptools if pip put a new one over the system's), delete "
                "the folders build and install, and build again."),
        in_lab=msg("Run colcon build --symlink-install after every change."),
        # a file with a mode, not a link, in a folder into which links should lead
        seen=r"--symlink-install[\s\S]{0,3000}?^-rw\S{6,9} [^\n]{0,120}\.py$", look=(looks.setuptools,),
    ),
    TerminalText(
        id="lab.copied_here", stage="general", link=links.COLCON,
        title=msg("--symlink-install has copied the files"),
        why=msg("A setuptools of version 80 or newer cannot make links to your files. colcon then copies "
                "them, without a message: a change has no effect until the next build."),
        fix=msg("Run colcon build after every change. Or, so that links are made again: pip install "
                "'setuptools<80' (pip uninstall setuptools if pip put a new one over the system's), delete "
                "the folders build and install, and build again."),
        in_lab=msg("Run colcon build --symlink-install after every change."),
        seen=r"colcon build [^\n]{0,80}--symlink-install", look=(looks.copied,), only_if_found=True,
    ),
    TerminalText(
        id="lab.built_both_ways", stage="terminal", link=links.COLCON,
        title=msg("The workspace was built with and without --symlink-install"),
        why=msg("Without --symlink-install, colcon copies the files of an interface package into build/; "
                "with it, colcon makes links there. It does not replace a folder by a link."),
        fix=msg("Delete the folders build and install of the workspace, and build again, from now on "
                "always with: colcon build --symlink-install"),
        seen=r"failed to create symbolic link '?(?P<path>[^'\n]{1,300}?)'? because existing path "
             r"cannot be removed",
    ),
    TerminalText(
        id="lab.old_build", stage="terminal", link=links.COLCON,
        title=msg("The node still does what it did before the change"),
        why=msg("Without --symlink-install, colcon copies the files: a change has no effect until "
                "the next build."),
        fix=msg("Run colcon build --symlink-install, also after every change of setup.py."),
    ),
    TerminalText(
        id="lab.other_build_folder", link=links.WORKSPACE,
        title=msg("The folder build is of another place or computer"),
        why=msg("CMake keeps whole paths in the folder build. The workspace was moved, renamed or copied, "
                "and they are not right any more."),
        fix=msg("Delete the folders build, install and log of the workspace, and build again."),
        seen=r"The current CMakeCache\.txt directory \S{1,300} is different"
             r"|The source \"\S{1,300}\" does not match the source \"\S{1,300}\" used to generate cache",
    ),
    TerminalText(
        id="lab.nothing_built", stage="terminal", link=links.COLCON,
        title=msg("colcon found no package"),
        why=msg("colcon looks for packages below the folder in which you run it, and skips folders "
                "with a file COLCON_IGNORE."),
        fix=msg("Run cd ~/ros2_ws, then colcon list, and check that the package is in src."),
        # (of a failed build, the next line says: 1 package failed)
        seen=r"Summary: 0 packages finished[^\n]{0,40}$"
             r"(?!\n +\d+ packages? (?:failed|aborted|not processed))",
        unless="ignoring unknown package|Duplicate package names not supported",
    ),
    TerminalText(
        id="lab.build_in_src", stage="terminal", link=links.WORKSPACE,
        title=msg("colcon build was run in src or in the package"),
        why=msg("colcon creates build, install and log where you run it; a second install folder "
                "confuses the terminal."),
        fix=msg("Delete build, install and log there (not src itself), and build in ~/ros2_ws."),
        seen=r"/(?:home|root|Users|workspaces?)/[^\s:]{0,200}/src/(?:[^\s/:]{1,100}/){0,3}(?:install|build)/",
    ),
    TerminalText(
        id="lab.unknown_select", stage="terminal", link=links.COLCON,
        title=msg("--packages-select names a package that does not exist"),
        why=msg("colcon ignores a name that it does not know, and builds nothing."),
        fix=msg("Compare '{package}' with the names that colcon list shows."),
        seen=r"ignoring unknown package '(?P<package>[^'\n]{1,120})' in --packages-(?:select|up-to)",
    ),
    TerminalText(
        id="lab.colcon_arguments", stage="terminal", link=links.COLCON,
        title=msg("colcon does not know this argument"),
        why=msg("Options have dashes, not underscores, and verbs are written in full."),
        fix=msg("Run: colcon build --symlink-install"),
        seen=r"colcon: error: (?:unrecognized arguments: (?P<argument>[^\n]{1,120})"
             r"|argument verb_name: invalid choice[^\n]{0,200})",
        cases=(
            Case(r"colcon: error: unrecognized arguments: --(?:cmake|ament|packages|event|mixin)",
                 why=msg("Parts of colcon are packages of their own, and the one with this option is not "
                         "installed."),
                 fix=msg("Run: sudo apt-get install python3-colcon-common-extensions. If colcon is of pip: "
                         "pip install -U colcon-common-extensions")),
        ),
    ),
    TerminalText(
        id="lab.build_type_misspelt", stage="terminal", link=links.PACKAGE,
        title=msg("ros2 pkg create does not know this build type"),
        why=msg("There are three build types: ament_python, ament_cmake and cmake."),
        fix=msg("Run: ros2 pkg create --build-type ament_python <package>"),
        seen=r"argument --build-type: invalid choice: '(?P<build_type>[^'\n]{0,80})'",
    ),
    TerminalText(
        id="lab.build_type_forgotten", stage="terminal", link=links.PACKAGE,
        title=msg("A C++ package was created"),
        why=msg("Without --build-type, ros2 pkg create creates a package for CMake."),
        fix=msg("Delete the folder, then run: ros2 pkg create --build-type ament_python <package>"),
        seen=r"creating \S{0,200}CMakeLists\.txt",
        unless=rf"--build-type|creating \S{{0,100}}{OWN_INTERFACES}/",
    ),
    TerminalText(
        id="lab.package_exists", stage="terminal", link=links.PACKAGE,
        title=msg("There is a folder with the package's name already"),
        why=msg("ros2 pkg create does not write into a folder that exists."),
        fix=msg("Run ls to see it. Take another name, or remove the folder if it is empty or of an earlier "
                "try: rm -r <package>"),
        seen=r"Aborted!\s{1,40}The (?:directory|package)[^\n]{0,40} already exists[^\n]{0,200}",
    ),
    TerminalText(
        id="lab.package_name", stage="terminal", link=links.PACKAGE_NAMES,
        title=msg("The package's name breaks ROS's naming rules"),
        why=msg("Package names contain only lowercase letters, digits and underscores, and begin with "
                "a letter. A Python module's name cannot contain a dash."),
        fix=msg("Delete the folder and create the package again with a name such as my_package."),
        seen=r"does not follow (?:the )?naming conventions",
    ),
    TerminalText(
        id="lab.nested_package", stage="terminal", link=links.PACKAGE,
        title=msg("A package is inside another package"),
        why=msg("colcon stops at the first package.xml on its way down: it never builds the inner "
                "package, and prints no message about it."),
        fix=msg("Put the packages side by side in src."),
    ),
    TerminalText(
        id="lab.setuptools_warning", stage="terminal", link=links.COLCON,
        title=msg("setuptools prints a warning"),
        why=msg("The build did not fail: the warning is for developers of setuptools and tells them "
                "what will change."),
        fix=msg("You do not have to fix anything. Look at the last line, Summary."),
        seen=r"SetuptoolsDeprecationWarning|EasyInstallDeprecationWarning|PkgResourcesDeprecationWarning",
        unless=r"^Failed +<<<",
    ),
    TerminalText(
        id="lab.owned_by_root", stage="terminal", link=links.WORKSPACE,
        title=msg("Files of the workspace belong to root"),
        why=msg("A program that ran as root (sudo, a container) created them; your editor may not "
                "change them."),
        fix=msg("Run sudo chown -R $USER: ~/ros2_ws, and never run colcon build with sudo."),
        in_lab=msg("Leave the lab with exit, and run sudo chown -R $USER: on the folder of the workspace "
                   "on your own machine."),
        seen=r"EACCES: permission denied|(?:PermissionError|error): \[Errno 13\] Permission denied: "
             r"'(?:(?:log|build|install|src)/|/(?:home|root|workspaces?|ws)/|[^/'\n]{1,100}')",
        look=(looks.not_own_files,),
    ),
)  # fmt: skip
