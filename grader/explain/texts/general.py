"""What can be said of any other error: which part says it, where, and in which words."""

from __future__ import annotations

from grader.base.i18n.message import msg
from grader.explain import looks
from grader.explain.frames import from_pip, where_it_failed
from grader.explain.terminal_text import Case, TerminalText
from grader.mistakes import links

KINDS = (
    TerminalText(
        id="lab.traceback", stage="general", link=links.PYTHON_ERRORS,
        title=msg("A Python program ended with an error"),
        why=msg("The last line of a traceback is the error: {error}. The lines above it are the way there, "
                "from the start of the program to the line that failed."),
        fix=msg("If a line of yours is on the way, open that file at that line: the mistake is there, or in "
                "what the line is given or imports. If none is: what pip installed below your home comes before apt's "
                "packages, so run pip uninstall if the file is in ~/.local; for one of colcon or ROS, "
                "sudo apt-get update && sudo apt-get upgrade."),
        in_lab=msg("If a line of yours is on the way, open that file at that line: the mistake is there, or "
                   "in what the line is given or imports."),
        facts=(where_it_failed, from_pip),
        seen=r"^Traceback \(most recent call last\):\n(?:(?![A-Za-z_][\w.]{0,120}(?:: |$))[^\n]{0,500}\n){1,200}?"
             r"(?P<error>[A-Za-z_][\w.]{0,120}(?:Error|Exception|Failure|Fault|Iteration|Warning)(?:: [^\n]{0,300})?)$",
        values={"error": "ValueError: …"},
    ),
    TerminalText(
        id="lab.error_line", stage="general", link=links.PYTHON_ERRORS,
        title=msg("A Python program ended with an error"),
        why=msg("This is the last line of a traceback, the error: {error}. The lines above it say in which "
                "file and line it happened."),
        fix=msg("Run the command again, and give all of its output to explain: put 2>&1 | explain - at its "
                "end."),
        seen=r"^(?!Traceback)(?P<error>[A-Za-z_][\w.]{0,100}(?:Error|Exception): [^\n]{1,300})$",
        values={"error": "ValueError: …"},
    ),
    TerminalText(
        id="lab.terminated", stage="general", link=links.TROUBLESHOOTING,
        title=msg("A C++ program ended with an error"),
        why=msg("The program says: {error}"),
        fix=msg("Look at what it is given: its parameters, files and arguments. Start it alone to see more: "
                "ros2 run <package> <executable>"),
        seen=r"terminate called after throwing an instance of '[^'\n]{1,200}'\s{1,20}what\(\): +(?P<error>[^\n]{1,300})",
        values={"error": "…"},
    ),
    TerminalText(
        id="lab.apt", stage="general", link=links.INSTALLATION,
        title=msg("apt stopped"),
        why=msg("apt says: {error}"),
        fix=msg("Run sudo apt-get update, then sudo apt-get --fix-broken install, and the command again."),
        seen=r"^E: (?P<error>[^\n]{1,200})", values={"error": "…"},
    ),
    TerminalText(
        id="lab.compiler", stage="general", link=links.COLCON,
        title=msg("A C++ file cannot be compiled"),
        why=msg("The compiler stopped in {file}, line {line}: {error}"),
        fix=msg("Correct that line first: later errors are often its consequences. If a header (.hpp, .h) "
                "is missing, name its package in find_package and ament_target_dependencies in "
                "CMakeLists.txt and in package.xml. If the package is not yours, take its branch for your "
                "ROS, or install it with apt."),
        seen=r"^(?P<file>/?[\w./+-]{1,300}\.[ch](?:pp|xx|c|h)?):(?P<line>\d{1,6}):\d{1,5}: (?:fatal )?error: "
             r"(?P<error>[^\n]{1,200})",
        values={"file": "src/node.cpp", "line": "7", "error": "expected ';'"},
    ),
    TerminalText(
        id="lab.cmake", stage="general", link=links.COLCON,
        title=msg("CMake stopped"),
        why=msg("CMake says in {file}, line {line}: {error}"),
        fix=msg("Look at that line if the file is yours, else at the line of your CMakeLists.txt that is "
                "listed below Call Stack. Correct it, delete the folder build, and build again."),
        seen=r"CMake Error at (?P<file>\S{1,300}?):(?P<line>\d{1,6})[^\n]{0,80}:\s{1,9}(?P<error>[^\n]{1,200})",
        values={"file": "CMakeLists.txt", "line": "9", "error": "…"},
    ),
    TerminalText(
        id="lab.launch", stage="general", link=links.LAUNCH,
        title=msg("ros2 launch stopped"),
        why=msg("ros2 launch says: {error}"),
        fix=msg("Look at what the launch file gives for the names in it (package, executable, file). Correct "
                "it, build and source the workspace again. ros2 launch -d … shows the whole traceback."),
        cases=(
            Case(r"executable '[^\n]{1,200}' not found on the PATH",
                 why=msg("The launch file starts a program, often xacro, that is not installed."),
                 fix=msg("Look in the launch file for FindExecutable or Command: it names the program. "
                         "Install it, for example: sudo apt-get install ros-{distro}-xacro")),
        ),
        seen=r"Caught exception in launch \(see debug for traceback\): (?P<error>[^\n]{1,300})",
        values={"error": "…"},
    ),
    TerminalText(
        id="lab.library",
        stage="general",
        link=links.TROUBLESHOOTING,
        title=msg("A library is not found"),
        why=msg("The program needs the library {name}, and Linux does not find it: its package is not "
                "installed, its workspace is not sourced, or a file of parameters is for another release."),
        fix=msg("Source ROS and the workspace in this terminal, then run it again. If that does not help, "
                "look for its package: apt-cache search ros-{distro} | grep <part of the name>"),
        seen=r"(?P<name>lib[\w.+-]{1,120}\.so[\d.]{0,20}): cannot open shared object file",
        values={"name": "libmy_package.so"},
    ),
    TerminalText(
        id="lab.node_error",
        stage="general",
        link=links.LOGGING,
        title=msg("A node logs an error"),
        why=msg("The node {name} says: {error}"),
        fix=msg("Look at what that node is given: its parameters, its files, and the nodes that it needs. "
                "ros2 node info /{name} shows its topics and services while it runs."),
        seen=r"^\[(?:ERROR|FATAL)\] \[\d{1,12}\.\d{1,9}\] \[(?P<name>[\w./]{1,100})\]: (?P<error>[^\n]{1,300})",
        values={"name": "my_node", "error": "…"},
    ),
    TerminalText(
        id="lab.process_died", stage="general", link=links.LAUNCH,
        title=msg("A program of the launch file has ended with an error"),
        why=msg("{name} ended with exit code {code}. The error itself stands above, in the lines that begin "
                "with [{name}]."),
        fix=msg("Read the lines above that begin with [{name}], or start it alone: ros2 run <package> "
                "<executable>."),
        cases=(
            Case(r"exit code -11\b",
                 why=msg("A program ended with a segmentation fault: its C++ part used memory that is not "
                         "its own, often because libraries of two versions are mixed."),
                 fix=msg("Delete the folders build and install and build again, in a terminal without conda "
                         "in which only one ROS is sourced. Start it alone to see more: ros2 run <package> "
                         "<executable>")),
            Case(r"exit code -9\b",
                 why=msg("A program was killed: by kill -9, or by Linux because the memory was full."),
                 fix=msg("Run free -h while it runs, and start fewer programs.")),
            Case(r"exit code 127\b",
                 why=msg("The program, or a library that it needs, was not found."),
                 fix=msg("Source the workspace again, delete build and install, and build again.")),
        ),
        seen=r"\[(?P<name>[\w.+-]{1,80}-\d{1,4})\]: process has died \[pid \d{1,9}, exit code (?P<code>-?\d{1,4})",
        values={"name": "my_node-1", "code": "1"},
    ),
    TerminalText(
        id="lab.command_not_found", stage="general", link=links.ENVIRONMENT,
        title=msg("The command does not exist here"),
        why=msg("The shell finds no program {name}: it is misspelt, not installed, or in a folder that is "
                "not in PATH."),
        fix=msg("Compare the spelling. Programs of ROS are found after source "
                "/opt/ros/{distro}/setup.bash. Others: apt-cache search {name}"),
        in_lab=msg("Compare the spelling. lab --help lists the lab's commands, ros2 --help those of ROS."),
        seen=r"(?:bash|zsh|sh): (?:line \d{1,6}: |\d{1,6}: )?(?P<name>[\w.+-]{1,60}): (?:command )?not found"
             r"|command not found: (?P<name_2>[\w.+-]{1,60})|[Cc]ommand '(?P<name_3>[\w.+-]{1,60})' not found"
             r"|sudo: (?P<name_4>[\w.+-]{1,60}): command not found",
        values={"name": "rviz"}, look=(looks.ros_sourced,),
    ),
    TerminalText(
        id="lab.colcon_failed", stage="general", link=links.COLCON,
        title=msg("The build of a package failed"),
        why=msg("{package} was not built. Its errors stand between --- stderr: {package} and Failed."),
        fix=msg("Read the first line with error there. To see everything: colcon build --packages-select "
                "{package} --event-handlers console_direct+"),
        seen=r"^Failed +<<< (?P<package>[\w-]{1,120})",
    ),
    TerminalText(
        id="lab.no_permission", stage="general", link=links.WORKSPACE,
        title=msg("Your user may not do that with the file"),
        why=msg("{path} belongs to another user, or lacks the right that was needed (x to start it)."),
        fix=msg("Run ls -l {path}. A program is made startable with chmod +x {path}. A file of your "
                "workspace that belongs to root becomes yours with sudo chown -R $USER: ~/ros2_ws"),
        in_lab=msg("Run ls -l {path}. A program is made startable with chmod +x {path}."),
        seen=r"(?:bash|zsh|sh): (?:line \d{1,6}: )?(?P<path>[^\s:]{1,300}): Permission denied"
             r"|permission denied: (?P<path_2>[^\s:]{1,300})",
    ),
    TerminalText(
        id="lab.no_file", stage="general", link=links.WORKSPACE,
        title=msg("The file or folder is not there"),
        why=msg("There is no {path}, seen from the folder in which the command runs."),
        fix=msg("Run pwd to see the folder, ls to see what is there, and compare the spelling (also upper "
                "and lower case). cd ~/ros2_ws leads to the workspace."),
        seen=r"(?:bash|zsh|sh|cd|ls|cp|mv|cat|rm|touch|chmod|python3): (?:[\w ]{0,30}: |cannot \w{1,20} |"
             r"can't open file )?['‘]?(?P<path>[^\s:'’]{1,300})['’]?: (?:\[Errno 2\] )?No such file or directory"
             r"|no such file or directory: (?P<path_2>[^\s:]{1,300})",
        values={"path": "src/my_package"},
    ),
)  # fmt: skip
