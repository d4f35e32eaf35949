"""The environment: another Python, packages that are missing or too new, what is not sourced."""

from __future__ import annotations

from grader.base.i18n.message import msg
from grader.explain.terminal_text import TerminalText
from grader.mistakes import links

CONDA = r"(?i:/(?:ana|mini)conda3?/|/mini(?:forge|mamba)3?/|/mambaforge/|micromamba/|^\(base\) )"
VENV = r"/\.?v?env\w{0,20}/(?:bin|lib)/|/pyenv/|/\.virtualenvs/|^\(\.?v?env\w{0,20}\) "
OWN_PYTHON = r"/opt/ros/(?P<distro>[a-z]{1,20})/(?:local/)?lib/python(?P<own>3\.\d{1,2})/(?:dist|site)-packages"
BUILD_TOOLS = "ament_cmake|rosidl_default_generators|rclcpp|std_msgs|geometry_msgs|sensor_msgs"
ROS_INTERFACES = (
    r"(?:std|geometry|sensor|nav|trajectory|visualization|diagnostic|shape|stereo|action|lifecycle"
    r"|turtlesim|tf2|nav2|control|moveit|vision|rosgraph|statistics|composition|unique_identifier)"
    r"_(?:msgs|srvs|interfaces)|turtlesim|rcl_interfaces|builtin_interfaces|example_interfaces"
)
OWN_INTERFACES = r"\w{1,100}_(?:interfaces?|msgs?|srvs?|actions?)"
IMPORT = r"(?:from|import) (?P<imported>\w{1,100})\.(?:msg|srv|action)\b[^\n]{0,200}\n(?:[ ~^]{1,200}\n)?"

KINDS = (
    TerminalText(
        id="lab.other_python", stage="environment", link=links.PYTHON_PACKAGES,
        title=msg("Another Python runs than the one of ROS"),
        why=msg(
            "Parts of ROS are compiled for the system's Python and its libraries. The Python of conda, or "
            "of a venv with another version, cannot load them."
        ),
        fix=msg(
            "Run which python3 and python3 --version. Start the node with the system's Python: with "
            "ros2 run, or with /usr/bin/python3."
        ),
        fixes={
            "conda": msg(
                "Run conda deactivate, then which python3: it must show /usr/bin/python3. Run the "
                "command again. If you built with conda active, delete the folders build and install "
                "first and build again. For all new terminals: conda config --set "
                "auto_activate_base false"
            ),
            "venv": msg(
                "Run deactivate, then which python3: it must show /usr/bin/python3. Run the command "
                "again. A venv for ROS is made with the system's Python: /usr/bin/python3 -m venv "
                "--system-site-packages <folder>"
            ),
        },
        seen=r"(?:No module named 'rclpy\._rclpy_pybind11'|_rclpy_pybind11\.cpython-3\d{1,2}-)"
             r"[\s\S]{0,300}?isn't present on the system"
             r"|No module named 'rclpy\._rclpy_pybind11'"
             rf"|{CONDA}[^\n]{{0,200}}libstdc\+\+[^\n]{{0,80}}version `(?:GLIBCXX|CXXABI)_",
        # (the same version: the file is missing for another reason)
        unless=r"/python3\.(\d{1,2})/[\s\S]{0,3000}pybind11\.cpython-3\1-",
        chosen={"conda": CONDA, "venv": VENV},
        shown={
            r"\.cpython-3(?P<minor>\d{1,2})-": msg("Python 3.{minor} runs."),
            OWN_PYTHON: msg("ROS 2 {distro} has its modules for Python {own}."),
            CONDA: msg("conda is active in this terminal."),
        },
    ),
    TerminalText(
        id="lab.build_python", stage="environment", link=links.PYTHON_PACKAGES,
        title=msg("The build uses a Python without the modules of the build tools"),
        why=msg(
            "CMake takes the first python3 of the terminal, and keeps its path in the folder build. "
            "The module {module} is installed for the system's Python, not for that of conda or a venv."
        ),
        fix=msg(
            "Run which python3. If it is not /usr/bin/python3, deactivate conda or the venv, delete "
            "the folders build and install, and build again. If it is: sudo apt-get install "
            "python3-catkin-pkg python3-empy python3-lark"
        ),
        fixes={
            "conda": msg(
                "Run conda deactivate, delete the folders build and install, and build again in this "
                "terminal. which python3 must show /usr/bin/python3 before."
            ),
            "venv": msg(
                "Run deactivate, delete the folders build and install, and build again in this "
                "terminal. which python3 must show /usr/bin/python3 before."
            ),
            "system": msg(
                "Run: sudo apt-get install python3-catkin-pkg python3-empy python3-lark. Then build "
                "again."
            ),
        },
        seen=r"ModuleNotFoundError: No module named '(?P<module>catkin_pkg|em|empy|lark|ament_package)'",
        chosen={"conda": CONDA, "venv": VENV, "system": r"execute_process\(/usr/bin/python3\b"},
        shown={
            r"(?:execute_process\(|Python3_EXECUTABLE[:=]\S{0,20})(?P<python>/[^\s)]{1,200})":
                msg("CMake runs {python}."),
        },
        values={"module": "catkin_pkg"},
    ),
    TerminalText(
        id="lab.empy", stage="environment", link=links.TROUBLESHOOTING,
        title=msg("The wrong version of empy is installed"),
        why=msg(
            "The build creates the code of interfaces with the module em of empy 3.3.4. pip has "
            "installed empy 4, or another package that is called em, in its place."
        ),
        fix=msg(
            "Run pip uninstall em empy: the system's python3-empy stays (sudo apt-get install "
            "python3-empy). In conda or a venv, also: pip install empy==3.3.4. Then delete the folders "
            "build and install, and build again."
        ),
        seen=r"AttributeError: module 'em' has no attribute '\w{1,60}'"
             r"|cannot import name '\w{1,60}' from 'em'",
    ),
    TerminalText(
        id="lab.dashed_key", stage="environment", link=links.SETUP_CFG,
        title=msg("setup.cfg has a key with a dash"),
        why=msg(
            "setuptools accepts only underscores in the keys of setup.cfg. Up to version 77 it printed "
            "a warning; from version 78 on it is an error."
        ),
        fix=msg(
            "Write underscores in setup.cfg: script_dir in [develop], install_scripts in [install]. "
            "Then build again."
        ),
        seen=r"Invalid dash-separated key '(?P<key>[\w-]{1,80})'|Usage of dash-separated '[\w-]{1,80}'",
        shown={
            r"dash-separated (?:key )?'(?P<key>[\w-]{1,80})'[^\n]{0,200}underscore name "
            r"'(?P<wanted>\w{1,80})'": msg("{key} has to be {wanted}."),
        },
    ),
    TerminalText(
        id="lab.managed_python", stage="environment", link=links.PYTHON_PACKAGES,
        title=msg("pip may not change the system's Python"),
        why=msg(
            "Ubuntu's own programs, ROS among them, need the modules of the system's Python in the "
            "versions of apt. pip installs there no longer."
        ),
        fix=msg(
            "Install the package with apt: its name begins with python3- (search: apt-cache search "
            "python3-). If apt does not have it, make a venv that sees the modules of ROS: python3 -m "
            "venv --system-site-packages ~/ros2_ws/venv && touch ~/ros2_ws/venv/COLCON_IGNORE, then "
            "source ~/ros2_ws/venv/bin/activate and use pip."
        ),
        fixes={
            "named": msg(
                "Try apt first: sudo apt-get install python3-{name} (search: apt-cache search "
                "{name}). If apt does not have it, make a venv that sees the modules of ROS: python3 -m "
                "venv --system-site-packages ~/ros2_ws/venv && touch ~/ros2_ws/venv/COLCON_IGNORE, "
                "then source ~/ros2_ws/venv/bin/activate and use pip."
            ),
        },
        seen=r"externally-managed-environment",
        chosen={"named": r"pip3? install (?:-\S{1,40} ){0,4}(?!\S{1,90}\.txt)(?P<name>[A-Za-z][\w.-]{0,80})(?=\s|$|[=<>~!\[])"},
    ),
    TerminalText(
        id="lab.no_screen", stage="environment", link=links.INSTALLATION,
        title=msg("There is no screen for the program's window"),
        why=msg(
            "A program with a window needs a display. A container, a remote terminal or a server has "
            "none of its own. Installing the program again does not change that."
        ),
        fix=msg(
            "In the lab, run window: the browser shows the turtle. In a container of your own, give "
            "it the screen: docker run -e DISPLAY -v /tmp/.X11-unix:/tmp/.X11-unix …, after xhost "
            "+local: on your computer. Over ssh: ssh -X. In WSL: wsl --update in Windows."
        ),
        fixes={
            "opencv": msg(
                "The Qt of pip's opencv-python is in the way. Run pip uninstall opencv-python, and sudo "
                "apt-get install python3-opencv."
            ),
        },
        whys={
            "opencv": msg(
                "opencv-python brings a Qt library of its own, which does not fit the system's programs."
            ),
        },
        seen=r"could not connect to display|[Cc]an(?:no|')t open display|Unable to open display"
             r"|Could not load the Qt platform plugin \"(?:xcb|wayland)\"",
        chosen={"opencv": r"Could not load the Qt platform plugin \"xcb\" in \"[^\"\n]{0,200}/cv2/"},
    ),
    TerminalText(
        id="lab.colcon_not_found", stage="environment", link=links.COLCON,
        title=msg("colcon is not installed, or not in PATH"),
        why=msg(
            "colcon is not part of ROS's own packages: it is installed beside them, and does not need "
            "to be sourced."
        ),
        fix=msg(
            "Run: sudo apt-get install python3-colcon-common-extensions. If pip installed it, it is in "
            "~/.local/bin: run export PATH=$PATH:$HOME/.local/bin"
        ),
        seen=r"colcon: (?:command )?not found|command not found: colcon|[Cc]ommand 'colcon' not found",
    ),
    TerminalText(
        id="lab.left_over", stage="environment", link=links.WORKSPACE,
        title=msg("The folder install has the rest of a package that is gone"),
        why=msg(
            "The setup file of the workspace sources every package that was built once. The files of "
            "{package} are not there any more: it was renamed, deleted, or its build failed."
        ),
        fix=msg(
            "Delete the folders build, install and log of the workspace (not src), open a new terminal, "
            "and build again."
        ),
        seen=r"^(?:\S{1,200}: )?not found: \"?/[^\"\n]{1,300}/install/(?P<package>[^/\"\n]{1,100})/"
             r"share/[^\"\n]{1,200}/(?:local_setup|package)\.\w{2,4}",
    ),
    TerminalText(
        id="lab.prefix_gone", stage="environment", link=links.WORKSPACE,
        title=msg("This terminal still has the path of a folder that is gone"),
        why=msg(
            "The terminal was sourced while {path} was there. The warning itself is harmless: colcon "
            "leaves the path out."
        ),
        fix=msg("Open a new terminal, or build the package again if it should be there."),
        seen=r"[Tt]he path '(?P<path>[^'\n]{1,300})' in the environment variable "
             r"\w{0,40}PREFIX_PATH doesn't exist",
    ),
    TerminalText(
        id="lab.underlay", stage="environment", link=links.ENVIRONMENT,
        title=msg("CMake does not find ROS"),
        why=msg(
            "{package} is a package of ROS. CMake finds it only if ROS is sourced in the terminal of "
            "the build."
        ),
        fix=msg(
            "Run source /opt/ros/{distro}/setup.bash, delete the folder build, and build again. If that "
            "does not help, the package is not installed: sudo apt-get install ros-{distro}-{debian}"
        ),
        seen=r"By not providing \"Find(?P<package>(?:ament|rosidl|rclcpp|rcl|rmw)(?:_\w{1,60})?|"
             rf"{ROS_INTERFACES})\.cmake\"",
        values={"package": "ament_cmake", "debian": "ament-cmake"},
    ),
    TerminalText(
        id="lab.cmake_package", stage="environment", link=links.INTERFACES,
        title=msg("CMake does not find a package"),
        why=msg(
            "{package} has to be built before the package that needs it, in this workspace or in one "
            "that this terminal has sourced. colcon takes the order from package.xml."
        ),
        fix=msg(
            "If {package} is a package of yours: write <depend>{package}</depend> in package.xml of the "
            "package that needs it, check that colcon list shows both, and build again. If it is a "
            "package of ROS: sudo apt-get install ros-{distro}-{debian}"
        ),
        seen=r"By not providing \"Find(?P<package>\w{1,100})\.cmake\"",
    ),
    TerminalText(
        id="lab.interface_unknown", stage="environment", link=links.INTERFACES,
        title=msg("This terminal does not know the interface"),
        why=msg(
            "The ros2 command reads the type of a message from the package that defines it. This "
            "terminal finds no such package, or no such type in it."
        ),
        fix=msg(
            "Source the workspace that has it in this terminal: cd ~/ros2_ws && source "
            "install/local_setup.bash. Then ros2 interface list has to show it. If it does not, build "
            "the package with the interface first, and compare the names."
        ),
        seen=r"The (?:message|service|action) type '[^'\n]{1,200}' is invalid"
             r"|The passed (?:message|service|action) type is invalid|^Unknown package '[^'\n]{1,100}'",
    ),
    TerminalText(
        id="lab.interface_not_built", stage="environment", link=links.INTERFACES,
        title=msg("Python does not find the interface package"),
        why=msg(
            "The Python modules of {package} are created when {package} is built. They are found "
            "only in a terminal that has sourced its workspace."
        ),
        fix=msg(
            "Check in this order: colcon list shows {package}; package.xml of the package with the node "
            "has <depend>{package}</depend>; colcon build has built it without an error; this "
            "terminal has sourced the workspace after that: source install/local_setup.bash"
        ),
        fixes={
            "ros": msg(
                "{package} is a package of ROS. Run source /opt/ros/{distro}/setup.bash. If that does "
                "not help, it is not installed: sudo apt-get install ros-{distro}-{debian}"
            ),
            "name": msg(
                "The package {package} is there, without this interface. Check its name (also upper "
                "and lower case), that its file is a line of rosidl_generate_interfaces in "
                "CMakeLists.txt, then build again and source the workspace again."
            ),
        },
        seen=rf"{IMPORT}ModuleNotFoundError: No module named '(?P<package>(?P=imported))(?:\.\w{{1,9}})?'"
             rf"|ModuleNotFoundError: No module named '(?P<package_2>{OWN_INTERFACES})(?:\.(?:msg|srv|action))?'"
             r"|cannot import name '\w{1,100}' from '(?P<package_3>\w{1,100})\.(?:msg|srv|action)' "
             r"\((?!/opt/ros/|/usr/)",
        values={"package": "my_robot_interfaces", "debian": "my-robot-interfaces"},
        chosen={
            "name": r"cannot import name '\w{1,100}' from '\w{1,100}\.(?:msg|srv|action)'",
            "ros": rf"No module named '(?:{ROS_INTERFACES})(?:\.\w{{1,9}})?'",
        },
    ),
)  # fmt: skip
