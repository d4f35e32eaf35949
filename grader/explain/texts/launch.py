"""Launch files: where they are, what they say, what they start."""

from __future__ import annotations

from grader.base.i18n.message import msg
from grader.explain.terminal_text import Case, TerminalText
from grader.mistakes import links

KINDS = (
    TerminalText(
        id="lab.launch_not_installed", stage="terminal", link=links.LAUNCH,
        title=msg("The launch file is not installed"),
        why=msg("ros2 launch looks in install/{package}/share/{package}, and not in src. setup.py installs "
                "only the files that data_files names."),
        fix=msg("Add this line to data_files in setup.py, then build and source the workspace again: "
                "('share/' + package_name + '/launch', glob('launch/*')). At the top of setup.py: from "
                "glob import glob. In a package with CMakeLists.txt: install(DIRECTORY launch DESTINATION "
                "share/${{PROJECT_NAME}}). If it is installed, compare the name with {file}"),
        seen=r"file '(?P<file>[^'\n]{1,200})' was not found in the share directory of package "
             r"'(?P<package>[^'\n]{1,120})'",
        cases=(
            Case(r"of package '[^'\n]{1,120}' which is at '(?P<path>(?![^'\n]{0,300}/install/)[^'\n]{1,300})'",
                 why=msg("{package} is no package of your workspace, and it has no launch file {file}. Names "
                         "differ between releases: talker_listener.launch.py is talker_listener_launch.py in "
                         "another one."),
                 fix=msg("Run ls {path}/launch, and take a name from there.")),
        ),
        values={"file": "my_robot.launch.py", "path": "/opt/ros/jazzy/share/demo_nodes_cpp"},
    ),
    TerminalText(
        id="lab.launch_file", link=links.LAUNCH,
        title=msg("The launch file has a mistake"),
        why=msg("A launch file is a program that ros2 launch runs. It ended with: {problem}. (That the "
                "file may have a syntax error or its format is unknown is said of every such end.)"),
        fix=msg("Run python3 on the file in src to see the line of a syntax error, correct it, build and "
                "source the workspace again. ros2 launch -d … shows the whole traceback."),
        cases=(
            Case(r"PackageNotFoundError: \"?package '(?P<package>[^'\n]{1,100})' not found",
                 why=msg("The launch file uses the package {package}, and this terminal does not find it. (That "
                         "the file may have a syntax error is said of every such end.)"),
                 fix=msg("If {package} is yours, build it and source the workspace. If it is from others, install "
                         "it: sudo apt-get install ros-{distro}-{debian}. A line "
                         "<exec_depend>{package}</exec_depend> in package.xml lets rosdep install it.")),
            Case(r"keyword-only argument: 'node_(?:executable|name)'",
                 why=msg("The launch file is made for a newer ROS than this one: before Foxy, Node wanted "
                         "node_executable, node_name and node_namespace."),
                 fix=msg("Run printenv ROS_DISTRO, and take the branch of the package that is made for it. "
                         "In a file of yours, write node_executable and node_name.")),
            Case(r"keyword-only argument: 'executable'|unexpected keyword argument 'node_(?:executable|name|namespace)'",
                 why=msg("Node in the launch file lacks executable=. Older tutorials write node_executable, "
                         "node_name and node_namespace: these names are gone."),
                 fix=msg("Write Node(package='my_package', executable='my_node', name='my_node') in the "
                         "launch file, with the name from console_scripts, then build and source the "
                         "workspace again.")),
            Case(r"does not contain the required function 'generate_launch_description",
                 why=msg("ros2 launch calls the function generate_launch_description of the file, and the "
                         "file has none."),
                 fix=msg("Write def generate_launch_description(): in the launch file (without indentation, "
                         "spelt so), with return LaunchDescription([…]) in it. Then build and source the "
                         "workspace again.")),
            Case(r"- ModuleNotFoundError: No module named '(?P<module>[\w.]{1,120})'",
                 why=msg("The launch file imports {module}, which Python does not find."),
                 fix=msg("Compare the import of {module} with launch's own: from launch import "
                         "LaunchDescription and from launch_ros.actions import Node. Then build and source "
                         "the workspace again.")),
            Case(r"'NoneType' object has no attribute|expected an? \w{1,40} instance, got 'None|got 'None'",
                 why=msg("generate_launch_description returned nothing, or the list has something that is "
                         "no action."),
                 fix=msg("End generate_launch_description with return LaunchDescription([…]), and look at "
                         "the commas in the list. Then build and source the workspace again.")),
        ),
        seen=r"when trying to load file of format \[(?:py|xml|yaml|yml)\]:\s{1,9}(?:- )?(?P<problem>[^\n]{1,300})"
             r"(?:\n - Invalid\w{0,20}LaunchFileError[^\n]{0,300}){0,3}"
             r"|Invalid(?:Python|Frontend)?LaunchFileError[:(]\s{0,2}(?P<problem_2>[^\n]{1,300})"
             r"|Caught exception in launch \(see debug for traceback\): "
             r"(?P<problem_4>(?:Node\.)?__init__\(\) [^\n]{1,200})"
             r"|Caught exception in launch \(see debug for traceback\): "
             r"(?P<problem_3>The launch file may have a syntax error[^\n]{0,100})",
        values={"problem": "SyntaxError: invalid syntax", "module": "launch_ros"},
    ),
    TerminalText(
        id="lab.robot_description", link=links.LAUNCH,
        title=msg("robot_description is not given as the robot's text"),
        why=msg("The parameter robot_description is the text of the URDF, all of it: not the path of the "
                "file, and no YAML."),
        fix=msg("Write it so in the launch file, with the imports Command from launch.substitutions and "
                "ParameterValue from launch_ros.parameter_descriptions: parameters=[{{'robot_description': "
                "ParameterValue(Command(['xacro ', path]), value_type=str)}}]. Check the file with check_urdf "
                "or xacro <file> in a terminal."),
        seen=r"Unable to parse the value of parameter robot_description as yaml"
             r"|Unable to initialize urdf::model from robot description|Failed to parse robot description"
             r"|parameter override rule: '-p robot_description:=",
    ),
    TerminalText(
        id="lab.launch_argument", link=links.LAUNCH,
        title=msg("An argument of the launch file is missing or written in another way"),
        why=msg("Arguments of a launch file are given as name:=value, without spaces, and only those that "
                "DeclareLaunchArgument declares have a default."),
        fix=msg("Run the same command with --show-args at its end: it lists the arguments. Give each one "
                "without a default: ros2 launch <package> <file> name:=value. In the file, declare it "
                "before it is used."),
        cases=(
            Case(r"malformed launch argument '(?P<file>[^'\n]{1,120}\.(?:py|xml|yaml))'",
                 why=msg("ros2 launch did not find the package, and so took {file} for an argument."),
                 fix=msg("Source the workspace in this terminal: cd ~/ros2_ws && source "
                         "install/local_setup.bash, then run it again. If that does not help, compare the "
                         "package's name with ros2 pkg list.")),
        ),
        values={"file": "robot.launch.py"},
        seen=r"launch configuration '[^'\n]{1,120}' does not exist|[Mm]issing required argument '[^'\n]{1,120}'"
             r"|malformed launch argument '[^'\n]{1,120}', expected format '<name>:=<value>'"
             r"|Included launch description missing required argument[^\n]{0,200}",
    ),
    TerminalText(
        id="lab.parameter_file", link=links.PARAMETER_FILES,
        title=msg("The file of parameters has another form than ROS reads"),
        why=msg("A YAML file of parameters has the node's name, below it ros__parameters (with two "
                "underscores), and below that the parameters. It says: {problem}"),
        fix=msg("Write the file so, with spaces and no tabs, then build again if it is installed:\n"
                "my_node:\n"
                "  ros__parameters:\n"
                "    speed: 1.0"),
        seen=r"Couldn't parse params file: '[^\n]{0,300}?'\. Error: (?P<problem>[^\n]{1,200}?)(?:, at \S{1,120}|$)"
             r"|(?P<problem_2>The substituted parameter file is not a valid yaml file)"
             r"|(?P<problem_3>Cannot have a value before ros__parameters[^\n,]{0,40})"
             r"|(?P<problem_4>Error opening YAML file)|(?P<problem_5>Sequence should be of same type[^\n,]{0,80})",
        cases=(
            Case(r"Error opening YAML file",
                 why=msg("There is no such file, or it may not be read."),
                 fix=msg("Run ls on the path. In a package, the file has to be installed: a line of "
                         "data_files in setup.py for config/*.yaml. Then build and source the workspace "
                         "again.")),
            Case(r"Sequence should be of same type",
                 why=msg("All values of a list have to be of one type: 1.0 and 2 are two."),
                 fix=msg("Write all values in the same way, such as [1.0, 2.0].")),
        ),
        values={"problem": "Cannot have a value before ros__parameters at line 2"},
    ),
)  # fmt: skip
