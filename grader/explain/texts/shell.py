"""The terminal itself: what is sourced, in which folder, in which shell, with which line ends."""

from __future__ import annotations

from grader.base.i18n.message import msg
from grader.explain import looks
from grader.explain.terminal_text import Case, TerminalText
from grader.explain.texts.names import OF_ROS
from grader.mistakes import links

KINDS = (
    TerminalText(
        id="lab.line_ends", link=links.WORKSPACE,
        title=msg("A file of commands has Windows line endings (CRLF)"),
        why=msg("Windows ends a line with two characters, Linux with one. The shell takes the other one "
                "as part of the command, which then does not exist."),
        fix=msg("Run sed -i 's/\\r$//' {file}, then the command again. So that git keeps Linux's line "
                "ends: git config --global core.autocrlf input"),
        seen=r"(?:(?P<file>[\w./~-]{1,200}): (?:line )?\d{1,6}: )?\$'\\r': command not found"
             r"|syntax error near unexpected token `(?:\$'\S{0,20}\\r'|\S{0,20}\\r)",
        values={"file": "setup_env.sh"},
    ),
    TerminalText(
        id="lab.other_distro", link=links.ENVIRONMENT,
        title=msg("The ROS of this command is not installed here"),
        why=msg("Each ROS 2 is in a folder of its own below /opt/ros. There is no {wanted} here, or it "
                "has no setup file because its installation ended too early."),
        fix=msg("Run ls /opt/ros to see what there is, and source that: source "
                "/opt/ros/{distro}/setup.bash. If the message comes in every new terminal, write the "
                "same name into the last lines of ~/.bashrc. If there is nothing, install ROS first."),
        in_lab=msg("ROS is sourced in every terminal of the lab. Leave the line out."),
        # (what ls shows below it)
        cases=(Case(r"ls /opt/ros/?\n(?P<distro>humble|iron|jazzy|kilted|lyrical|rolling)\b"),),
        seen=r"/opt/ros/(?P<wanted>[a-z]{1,20})/(?:local_)?setup\.(?:bash|sh|zsh)\s{0,3}: No such file"
             r"|no such file or directory: /opt/ros/(?P<wanted_2>[a-z]{1,20})/(?:local_)?setup\.",
        unless=r"\$'\\r'",  # (then the name of the file ends in it)
        values={"wanted": "humble"}, look=(looks.ros_sourced,),
    ),
    TerminalText(
        id="lab.two_releases", link=links.ENVIRONMENT,
        title=msg("Two releases of ROS are sourced in one terminal"),
        why=msg("The second one comes first from then on, and programs find parts of both: a message of ROS 1 "
                "in ROS 2, or a library of another release."),
        fix=msg("Keep one of the lines source /opt/ros/… in ~/.bashrc, and open a new terminal: the old one "
                "stays mixed. If you have built in it, delete the folders build, install and log of the "
                "workspace, and build again."),
        seen=r"ROS_DISTRO was set to '(?P<name>\w{1,20})' before\. Please make sure"
             r"|/opt/ros/(?:noetic|melodic|kinetic)/setup[\s\S]{0,9000}?(?=has no attribute '_TYPE_SUPPORT)",
        values={"name": "noetic"},
    ),
    TerminalText(
        id="lab.other_shell", link=links.ENVIRONMENT,
        title=msg("The setup file is for another shell"),
        why=msg("setup.bash is for bash. In zsh, it does not find its own folder, and looks in yours."),
        fix=msg("Source the file of your shell: source install/setup.zsh, and before it source "
                "/opt/ros/{distro}/setup.zsh. echo $0 shows which shell it is."),
        cases=(
            Case(r"source: (?:command )?not found",
                 why=msg("sh does not know source: it is a word of bash and zsh."),
                 fix=msg("Run bash, then the command again. In a script, write #!/bin/bash as the first "
                         "line.")),
        ),
        seen=r"setup\.bash:\.?:\d{1,4}: no such file or directory: \S{1,300}"
             r"|(?:sh|dash)\b[^\n]{0,20}: source: (?:command )?not found",
    ),
    TerminalText(
        id="lab.ros_not_sourced", stage="terminal", link=links.ENVIRONMENT,
        title=msg("ROS is not sourced in this terminal"),
        why=msg("The ros2 command is found only after you source ROS's own setup file in this "
                "terminal."),
        fix=msg("Run: source /opt/ros/{distro}/setup.bash"),
        seen=r"(?<!sudo: )ros2: (?:command )?not found|command not found: ros2"
             r"|[Cc]ommand 'ros2' not found",
        look=(looks.ros_sourced,),
    ),
    TerminalText(
        id="lab.colcon_not_found", link=links.COLCON,
        title=msg("colcon is not installed, or not in PATH"),
        why=msg("colcon is not part of ROS's own packages: it is installed beside them, and does not need "
                "to be sourced."),
        fix=msg("Run: sudo apt-get install python3-colcon-common-extensions. If pip installed it, it is in "
                "~/.local/bin: run export PATH=$PATH:$HOME/.local/bin"),
        in_lab=msg("Open a new terminal of the lab: colcon is in its PATH."),
        seen=r"(?<!sudo: )colcon: (?:command )?not found|command not found: colcon"
             r"|[Cc]ommand 'colcon' not found",
    ),
    TerminalText(
        id="lab.python_not_found", link=links.PYTHON_PACKAGES,
        title=msg("The command is called python3"),
        why=msg("Ubuntu has no command python: it could be Python 2 or 3."),
        fix=msg("Write python3 instead of python. A node is started with ros2 run."),
        seen=r"(?:^|[\s:/])python: (?:command )?not found|[Cc]ommand 'python' not found"
             r"|env: ['‘]python['’]: No such file",
    ),
    TerminalText(
        id="lab.wrong_folder", stage="terminal", link=links.WORKSPACE,
        title=msg("The workspace's setup file is not in this folder"),
        why=msg("colcon build creates install/ in the folder in which you run it. So install/ exists "
                "only after a build, and only in the workspace's root."),
        fix=msg("Run cd ~/ros2_ws, then colcon build --symlink-install, then source "
                "install/local_setup.bash"),
        seen=r"install/(?:local_)?setup\.(?:bash|sh|zsh): No such file or directory"
             r"|no such file or directory: (?:\./)?install/(?:local_)?setup\.",
    ),
    TerminalText(
        id="lab.setup_executed", stage="terminal", link=links.WORKSPACE,
        title=msg("The setup file is executed instead of sourced"),
        why=msg("An executed file changes only its own process; source changes this terminal."),
        fix=msg("Run: source install/local_setup.bash"),
        seen=r"install/(?:local_)?setup\.(?:bash|sh|zsh): Permission denied",
    ),
    TerminalText(
        id="lab.left_over", link=links.WORKSPACE,
        title=msg("The folder install has the rest of a package that is gone"),
        why=msg("The setup file of the workspace sources every package that was built once. The files of "
                "{package} are not there any more: it was renamed, deleted, or its build failed."),
        fix=msg("Delete the folders build, install and log of the workspace (not src), open a new "
                "terminal, and build again."),
        seen=r"^(?:\S{1,200}: )?not found: \"?/[^\"\n]{1,300}/install/(?P<package>[^/\"\n]{1,100})/"
             r"share/[^\"\n]{1,200}/(?:local_setup|package)\.\w{2,4}",
    ),
    TerminalText(
        id="lab.prefix_gone", link=links.WORKSPACE,
        title=msg("This terminal still has the path of a folder that is gone"),
        why=msg("The terminal was sourced while {path} was there. The warning itself is harmless: colcon "
                "leaves the path out."),
        fix=msg("Open a new terminal, or build the package again if it should be there."),
        seen=r"[Tt]he path '(?P<path>[^'\n]{1,300})' in the environment variable "
             r"\w{0,40}PREFIX_PATH doesn't exist",
    ),
    TerminalText(
        id="lab.not_installed", stage="terminal", link=links.INSTALLATION,
        title=msg("This package of ROS is not installed here"),
        why=msg("{package} is a package of ROS, not one of your workspace. A small installation of ROS, "
                "such as the lab's, has only what the lessons need. Building or sourcing your "
                "workspace does not add it."),
        fix=msg("Ask your instructor if a lesson needs it. On a machine of your own, install it: sudo "
                "apt-get install ros-{distro}-{debian}"),
        in_lab=msg("Ask your instructor if a lesson needs it."),
        seen=rf"^Package '(?P<package>{OF_ROS})' not found", values={"package": "turtlesim"},
    ),
    TerminalText(
        id="lab.overlay_not_sourced", stage="terminal", link=links.WORKSPACE,
        title=msg("The package is not found in this terminal"),
        why=msg("A terminal knows a workspace only after you source its setup file in that terminal."),
        fix=msg("Source the workspace in every new terminal: cd ~/ros2_ws && source "
                "install/local_setup.bash. If that does not help, build first, and compare the "
                "package's name."),
        seen=r"^Package '(?P<package>[^'\n]{1,120})' not found"
             r"|[Pp]ackage '(?P<package_2>[^'\n]{1,120})' not found, searching: ",
        unless=r"The manifest contains invalid XML",  # (then colcon builds it as any package of Python)
        look=(looks.package_built,),
    ),
    TerminalText(
        id="lab.no_executable", stage="terminal", link=links.DEVELOPING,
        title=msg("The package has no executable with that name"),
        why=msg("ros2 run looks in install/{package}/lib/{package} for an executable file with the name to "
                "the left of the = in console_scripts in setup.py. The file's name does not count."),
        fix=msg("Run ros2 pkg executables {package} and ls -l install/{package}/lib/{package} "
                "install/{package}/bin in the workspace, and compare:\n"
                "- setup.py has no entry with the name: add it to console_scripts, and build.\n"
                "- setup.py has it, install has it nowhere: it was not built since. Run colcon build "
                "--symlink-install and source the workspace again.\n"
                "- It is in bin: setup.cfg lacks script_dir and install_scripts with "
                "$base/lib/{package}.\n"
                "- It is in lib/{package} without an x: delete build and install, and build again."),
        seen=r"^No executable found"
             r"|executable '[^'\n]{1,120}' not found on the libexec directory "
             r"'[^'\n]{0,300}/(?P<package>[^'/\n]{1,120})'"
             r"|package '(?P<package_2>[^'\n]{1,120})' found at '[^'\n]{1,300}', but libexec directory",
        cases=(
            Case(rf"ros2 run (?P<package>{OF_ROS}) ",
                 fix=msg("Run ros2 pkg executables {package} to see the names, and compare.")),
            Case(r"executable '(?P<name>[^'\n]{1,120})' not found on the libexec directory",
                 why=msg("executable= in the launch file is the name to the left of the = in "
                         "console_scripts in setup.py. {package} has executables, and none with the "
                         "name {name}."),
                 fix=msg("Run ros2 pkg executables {package}, and write one of these names as "
                         "executable= in the launch file. If {name} is new: add it to console_scripts "
                         "in setup.py, run colcon build --symlink-install, and source the workspace.")),
            Case(r"found at '[^'\n]{1,300}', but libexec directory",
                 why=msg("{package} is built, without any executable in install/{package}/lib/{package}. "
                         "setup.cfg says that they go there, console_scripts in setup.py names them."),
                 fix=msg("Check that setup.py has an entry in console_scripts, and that setup.cfg has "
                         "script_dir=$base/lib/{package} below [develop] and "
                         "install_scripts=$base/lib/{package} below [install]. Then delete the folders "
                         "build and install, build again, and source the workspace.")),
            Case(r"ros2 run (?P<package>\w{1,100}) "),
        ),
        values={"name": "my_node"}, look=(looks.executables,),
    ),
)  # fmt: skip
