"""Interfaces: their packages, their files, their fields, and who does not find them."""

from __future__ import annotations

from grader.base.i18n.message import msg
from grader.explain import looks
from grader.explain.frames import packages_with
from grader.explain.terminal_text import Case, TerminalText
from grader.explain.texts.names import CONDA, IMPORT, OWN_INTERFACES, ROS_INTERFACES
from grader.mistakes import links

KINDS = (
    TerminalText(
        id="lab.interface_group", link=links.INTERFACES,
        title=msg("package.xml does not say that the package has interfaces"),
        why=msg("A package with interfaces is a member of the group rosidl_interface_packages. Others find "
                "its interfaces by that."),
        fix=msg("Write these lines above <export> in package.xml, then build again:\n"
                "<buildtool_depend>rosidl_default_generators</buildtool_depend>\n"
                "<exec_depend>rosidl_default_runtime</exec_depend>\n"
                "<member_of_group>rosidl_interface_packages</member_of_group>"),
        seen=r"Packages installing interfaces must include\s{1,20}"
             r"'<member_of_group>rosidl_interface_packages",
    ),
    TerminalText(
        id="lab.interface_dependency", link=links.INTERFACES,
        title=msg("CMakeLists.txt uses the interfaces of a package that it has not found before"),
        why=msg("DEPENDENCIES of rosidl_generate_interfaces names {package}. CMake needs find_package for "
                "it before that line, and colcon a line in package.xml."),
        fix=msg("Write find_package({package} REQUIRED) above rosidl_generate_interfaces in CMakeLists.txt "
                "and <depend>{package}</depend> in package.xml, then build again."),
        cases=(
            Case(r"undefined symbol: _ZNK?\d{1,3}(?P<package>[a-z][a-z_]{1,80})\d{1,3}(?:msg|srv|action)\d",
                 why=msg("A type of {package} is in your interfaces, and CMakeLists.txt does not say so. The "
                         "build goes well, and the program lacks a part of it when it starts."),
                 fix=msg("Write DEPENDENCIES {package} at the end of rosidl_generate_interfaces(…) in "
                         "CMakeLists.txt, find_package({package} REQUIRED) above it, and "
                         "<depend>{package}</depend> in package.xml. Delete the folders build and install, "
                         "and build again.")),
        ),
        seen=r"the passed dependency '(?P<package>\w{1,100})' has not\s{1,20}been found before"
             r"|undefined symbol: _ZNK?\d{1,3}(?P<package_2>[a-z][a-z_]{1,80})\d{1,3}(?:msg|srv|action)\d\w{1,200}",
        values={"package": "geometry_msgs"},
    ),
    TerminalText(
        id="lab.interface_type_unknown", link=links.INTERFACES,
        title=msg("A field has a type that is not known"),
        why=msg("The type of a field is a basic one (float64, string, …), or package/Name with the package "
                "in DEPENDENCIES of rosidl_generate_interfaces. In the same package, the name alone is "
                "enough, and its file has to be a line there too."),
        fix=msg("Compare the type with ros2 interface list: upper and lower case count, and msg/ is left "
                "out, as in geometry_msgs/Point. Then name the package in CMakeLists.txt (find_package and "
                "DEPENDENCIES) and in package.xml (<depend>), and build again."),
        seen=r"contains an unknown field type: [^\n]{1,200}|[Uu]nknown (?:named )?type '?\S{1,120}"
             r"|fatal error: (?P<package>\w{1,100})/(?:msg|srv|action)/\S{1,100}\.h(?:pp)?: No such file",
    ),
    TerminalText(
        id="lab.interface_name", link=links.INTERFACES,
        title=msg("A name in an interface breaks ROS's rules"),
        why=msg("Code for C++ and Python is made from the names, so they have a form: files are called "
                "like Sphere.msg (capital letters, no underscore), fields like max_speed (lower case), "
                "constants like MAX_SPEED."),
        fix=msg("{name} does not have that form. Rename it in the .msg, .srv or .action file, in "
                "CMakeLists.txt and in the code that uses it, then build again."),
        cases=(
            Case(r"'(?P<name>[^'\n]{1,120})' is an invalid (?:message|service|action|interface) name",
                 fix=msg("Rename the file {name}.msg (or .srv, .action): it begins with a capital letter "
                         "and has no underscore, like Sphere.msg. Write the new name in CMakeLists.txt "
                         "and in the import of the node, then build again.")),
            Case(r"'(?P<name>[^'\n]{1,120})' is an invalid field name",
                 fix=msg("Write the field {name} in lower case with underscores, like max_speed: in the "
                         ".msg, .srv or .action file and in the node. Then build again.")),
            Case(r"'(?P<name>[^'\n]{1,120})' is an invalid constant name",
                 fix=msg("Write the constant {name} in capital letters with underscores, like MAX_SPEED: "
                         "in the .msg, .srv or .action file and in the node. Then build again.")),
            Case(r"'(?P<name>[^'\n]{1,120})' is an invalid package name",
                 fix=msg("Package names have lower case letters, digits and underscores. Compare {name} "
                         "in the .msg, .srv or .action file with ros2 pkg list, then build again.")),
        ),
        seen=r"'(?P<name>[^'\n]{1,120})' is an invalid \w{1,20} name\. It should have the pattern",
        values={"name": "maxSpeed"},
    ),
    TerminalText(
        id="lab.interface_line", link=links.INTERFACES,
        title=msg("A line of an interface file cannot be read"),
        why=msg("A line is a type and a name, as in float64 speed; a default value follows after a space, "
                "a constant has a =. Comments begin with #. A service has one line ---, an action two."),
        fix=msg("Correct the line that the message names (if it names none, compare all lines), then build "
                "again."),
        seen=r"InvalidFieldDefinition|InvalidServiceSpecification|InvalidActionSpecification"
             r"|InvalidDefaultValue|Could not find (?:unique )?separator '---'"
             r"|Number of '---' separators nonconformant",
    ),
    TerminalText(
        id="lab.interface_cmake", link=links.INTERFACES,
        title=msg("rosidl_generate_interfaces is not called as it has to be"),
        why=msg("rosidl_generate_interfaces gets a target, usually ${{PROJECT_NAME}}, and the files, with "
                "paths from the folder of CMakeLists.txt: \"msg/Sphere.msg\". What uses the interfaces in "
                "the same package comes after it."),
        fix=msg("Write find_package(rosidl_default_generators REQUIRED) and, below it, "
                "rosidl_generate_interfaces(${{PROJECT_NAME}} \"msg/Sphere.msg\") with your files in "
                "CMakeLists.txt. Check that the files are there, then build again."),
        seen=r"CMake Error at \S{1,300}/rosidl_\w{1,60}\.cmake:\d{1,5} \((?:list|message)\):\s{1,20}[^\n]{1,200}"
             r"|Unknown CMake command \"rosidl_generate_interfaces\""
             r"|Cannot find source file:\s{1,20}\S{1,200}\.(?:msg|srv|action)",
        unless=r"rosidl_adapter\.parser|is an invalid \w{1,20} name|error: |No module named|has no attribute",
    ),
    TerminalText(
        id="lab.interface_part", link=links.INTERFACES,
        title=msg("The compiled part of the interfaces is not found"),
        why=msg("Python finds {package}, but not its compiled part: it was not built, was built by another "
                "Python, or belongs to a terminal that was sourced before the build."),
        fix=msg("Delete the folders build and install of the workspace, run colcon build "
                "--symlink-install, and source install/local_setup.bash in the terminal of the node."),
        cases=(
            Case(CONDA,
                 fix=msg("Run conda deactivate, delete the folders build and install of the workspace, run "
                         "colcon build --symlink-install, and source install/local_setup.bash. Start the "
                         "node in that terminal.")),
        ),
        seen=r"Could not import 'rosidl_typesupport_c' for package '(?P<package>\w{1,100})'"
             r"|No module named '(?P<package_2>\w{1,100})\.\w{1,100}_s__rosidl_typesupport_\w{1,40}'"
             r"|(?P<package_3>\w{1,100})__rosidl_\w{1,60}\.so: cannot open shared object file",
        values={"package": "my_robot_interfaces"}, look=(looks.python, looks.package_built),
    ),
    TerminalText(
        id="lab.other_release", link=links.COLCON,
        title=msg("Parts of two releases of ROS are mixed"),
        why=msg("What was built, or the package itself, is made for another ROS or middleware than the one "
                "that is sourced: the one looks for something that the other does not have."),
        fix=msg("Run printenv ROS_DISTRO, and take the branch of the package that is made for it. Delete the "
                "folders build and install, open a new terminal, source one ROS only, and build again."),
        seen=r"[Tt]ype ?support not from this implementation|undefined symbol: \S{1,300}|module 'rclpy\._rclpy\w{0,20}' has no attribute '\w{1,80}'"
             r"|ImportError: cannot import name '\w{1,80}' from '(?:launch|launch_ros|rclpy|rosidl\w{0,40})\.[\w.]{1,80}'"
             r" \(/opt/ros/[^\n]{1,200}"
             r"|No module named 'rclpy\.(?!_)\w{1,60}'",
        cases=(
            Case(CONDA,
                 why=msg("Libraries of the conda environment do not fit together: one was updated without "
                         "the others, or those of the system come in between."),
                 fix=msg("Open a new terminal, activate the environment and source nothing else. Run conda "
                         "update --all in it, delete the folders build and install of your workspace, and "
                         "build again.")),
        ),
        look=(looks.ros_sourced,),
    ),
    TerminalText(
        id="lab.not_a_type", link=links.INTERFACES,
        title=msg("What is passed as the type is no interface of that kind"),
        why=msg("create_publisher and create_subscription get the class of a message, create_client and "
                "create_service that of a service: the class itself, no module, no text, no object, and "
                "not Request or Response."),
        fix=msg("Look at the line of your file in the traceback. Write, for example, from std_msgs.msg "
                "import String and create_publisher(String, 'topic', 10); for a service, from "
                "std_srvs.srv import Trigger and create_client(Trigger, 'name')."),
        seen=r"has no attribute '_TYPE_SUPPORT'|This might be a ROS 1 message type"
             r"|The (?:message|service|action) type provided is not valid"
             r"|has no attribute '_CREATE_ROS_MESSAGE'",
        cases=(
            Case(r"ROS_DISTRO was set to|/opt/ros/(?:noetic|melodic|kinetic)/",
                 why=msg("Two releases of ROS are sourced in this terminal. Python finds the class of a message "
                         "of the other one first."),
                 fix=msg("Open a new terminal in which only one ROS is sourced, and start the node there.")),
        ),
    ),
    TerminalText(
        id="lab.interface_elsewhere", link=links.INTERFACES,
        title=msg("The interface is in another package"),
        why=msg("{package} has no {name}. Each package has its own interfaces, and an import line is for one "
                "package."),
        fix=msg("Run ros2 interface list | grep {name} to see the package, and import the name from that one, "
                "in a line of its own. Name the package in package.xml too (<depend>). If the list does not "
                "have it, compare the spelling."),
        facts=(packages_with,),
        seen=r"cannot import name '(?P<name>[A-Z]\w{1,80})' from '(?P<package>\w{1,80})\.(?:msg|srv|action)' \(/opt/ros/",
        values={"package": "geometry_msgs", "name": "LaserScan"},
    ),
    TerminalText(
        id="lab.interface_not_rebuilt", link=links.INTERFACES,
        title=msg("The interface as it was built does not have the field"),
        why=msg("The build makes Python code of each interface, also with --symlink-install. {type}, as it was "
                "built last, has no field {name}."),
        fix=msg("If {name} is in the file of {type}: build its package again (colcon build, without "
                "--packages-select), source install/local_setup.bash, and start all nodes again. ros2 "
                "interface show shows the fields as they are built. If it is not in the file, compare the "
                "spelling."),
        seen=r"/(?:msg|srv|action)/(?P<type>[A-Z]\w{1,80})\b[\s\S]{0,8000}?"
             r"(?P<told>AttributeError: '(?P=type)(?:_\w{1,12})?' object has no attribute '(?P<name>\w{1,80})')",
        values={"type": "Distance"},
    ),
    TerminalText(
        id="lab.interface_unknown", link=links.INTERFACES,
        title=msg("This terminal does not know the interface"),
        why=msg("The ros2 command reads the type of a message from the package that defines it. This "
                "terminal finds no such package, or no such type in it."),
        fix=msg("Source the workspace that has it in this terminal: cd ~/ros2_ws && source "
                "install/local_setup.bash. Then ros2 interface list has to show it. If it does not, build "
                "the package with the interface first, and compare the names."),
        seen=r"The (?:message|service|action) type '[^'\n]{1,200}' is invalid"
             r"|The passed (?:message|service|action) type is invalid|^Unknown package '[^'\n]{1,100}'",
    ),
    TerminalText(
        id="lab.interface_not_built", link=links.INTERFACES,
        title=msg("Python does not find the interface package"),
        why=msg("The Python modules of {package} are created when {package} is built. They are found "
                "only in a terminal that has sourced its workspace."),
        fix=msg("Check in this order: colcon list shows {package}; package.xml of the package with the node "
                "has <depend>{package}</depend>; colcon build has built it without an error; this "
                "terminal has sourced the workspace after that: source install/local_setup.bash"),
        cases=(
            Case(r"cannot import name '\w{1,100}' from '\w{1,100}\.(?:msg|srv|action)'",
                 fix=msg("The package {package} is there, without this interface. Check its name (also "
                         "upper and lower case), that its file is a line of rosidl_generate_interfaces in "
                         "CMakeLists.txt, then build again and source the workspace again.")),
            Case(rf"No module named '(?:{ROS_INTERFACES})(?:\.\w{{1,9}})?'",
                 fix=msg("{package} is a package of ROS. Run source /opt/ros/{distro}/setup.bash. If that "
                         "does not help, it is not installed: sudo apt-get install "
                         "ros-{distro}-{debian}")),
        ),
        seen=rf"{IMPORT}ModuleNotFoundError: No module named '(?P<package>(?P=imported))(?:\.\w{{1,9}})?'"
             rf"|ModuleNotFoundError: No module named '(?P<package_2>{OWN_INTERFACES})(?:\.(?:msg|srv|action))?'"
             r"|cannot import name '\w{1,100}' from '(?P<package_3>\w{1,100})\.(?:msg|srv|action)' "
             r"\((?!/opt/ros/|/usr/)",
        values={"package": "my_robot_interfaces", "debian": "my-robot-interfaces"},
        look=(looks.package_built,),
    ),
    TerminalText(
        id="lab.field_type", stage="terminal", link=links.INTERFACES,
        title=msg("A field of a message gets a value of another type"),
        why=msg("A field of a ROS message accepts only its own type. For Python, 2 is an int and 2.0 is "
                "a float."),
        fix=msg("Give the field {field} a value of the type {type}. If the value is in a variable: "
                "{type}(…)"),
        cases=(
            Case(r"\.(?P<field>\w{1,80}) = (?P<value>-?\d{1,9})\n(?:[ ~^]{1,200}\n)?[^\n]*\n[^\n]*\n"
                 r"(?:[ ~^]{1,200}\n)?AssertionError: The '(?P=field)' field must be of type 'float'",
                 fix=msg("Write {field} = {value}.0 instead of {field} = {value}.")),
        ),
        seen=r"AssertionError: The '(?P<field>\w{1,80})' (?:numpy array |array |\w{0,20} ?)field must be of "
             r"type '(?P<type>int|float|str|bool)'",
        values={"field": "x", "type": "float", "value": "2"},
    ),
    TerminalText(
        id="lab.field_object", link=links.INTERFACES,
        title=msg("A field of a message gets a value of another type"),
        why=msg("The field {field} accepts only this: {type}"),
        fix=msg("Make such a value and give it to {field}: for a message field, an object of its class, as "
                "in msg.header = Header(); for a list, [ … ] with values of that type. For the time: "
                "self.get_clock().now().to_msg()"),
        seen=r"AssertionError: The '(?P<field>\w{1,80})' field must be (?:a )?"
             r"(?P<type>(?!of type)[^\n]{1,200}|of type (?!'(?:int|float|str|bool)')[^\n]{1,200})",
        values={"field": "header", "type": "a sub message of type 'Header'"},
    ),
)  # fmt: skip
