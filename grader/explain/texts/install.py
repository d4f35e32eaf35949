"""Installing: apt and its keys, rosdep, sudo."""

from __future__ import annotations

from grader.base.i18n.message import msg
from grader.explain import looks
from grader.explain.terminal_text import Case, TerminalText
from grader.mistakes import links

KINDS = (
    TerminalText(
        id="lab.apt_key", link=links.INSTALLATION,
        title=msg("apt does not trust the packages of ROS"),
        why=msg("The packages of ROS are signed. The key on this computer is missing or has expired: the "
                "old one ended in 2025."),
        fix=msg("Install the package that brings the key and renews it:\n"
                "sudo rm -f /etc/apt/sources.list.d/ros2.list\n"
                "R=ros-infrastructure/ros-apt-source\n"
                "V=$(curl -s https://api.github.com/repos/$R/releases/latest |\n"
                "grep -F tag_name | cut -d'\"' -f4)\n"
                "F=ros2-apt-source_$V.$(lsb_release -cs)_all.deb\n"
                "curl -LO https://github.com/$R/releases/download/$V/$F\n"
                "sudo dpkg -i $F && sudo apt-get update"),  # (no line is so long that it is broken)
        seen=r"(?:EXPKEYSIG|NO_PUBKEY|KEYEXPIRED)[^\n]{0,200}"
             r"|repository '[^'\n]{0,80}ros\.org[^'\n]{0,120}' is not signed",
    ),
    TerminalText(
        id="lab.apt_package", link=links.INSTALLATION,
        title=msg("apt does not know the package"),
        why=msg("apt knows the packages of its sources. A release of ROS has packages for one or two "
                "releases of Ubuntu only: humble for 22.04, jazzy and kilted for 24.04."),
        fix=msg("Run lsb_release -ds to see your Ubuntu, and take the ROS that is made for it. If it is "
                "right, run sudo apt-get update; if that does not help, do the step Setup Sources of the "
                "installation page. Names have dashes: ros-{distro}-demo-nodes-py"),
        cases=(
            Case(r"locate package ros-humble-[\s\S]*(?:24\.04|24\.10|noble)|(?:24\.04|noble)[\s\S]*locate package ros-humble-",
                 why=msg("humble has packages for Ubuntu 22.04 only, and this is a newer Ubuntu."),
                 fix=msg("Install the ROS of Ubuntu 24.04: sudo apt-get install ros-jazzy-desktop. If it "
                         "has to be humble, use its container: docker run -it ros:humble")),
            Case(r"locate package ros-(?:jazzy|kilted)-[\s\S]*(?:22\.04|jammy)",
                 why=msg("This ROS has packages for Ubuntu 24.04, and this is an older Ubuntu."),
                 fix=msg("Install the ROS of Ubuntu 22.04: sudo apt-get install ros-humble-desktop, or "
                         "install Ubuntu 24.04.")),
            Case(r"locate package (?P<name>python3?-\S{1,100})",
                 why=msg("None of apt's sources has a package {name}."),
                 fix=msg("apt calls a package like the module that Python imports, and not like pip's "
                         "package: pyserial is python3-serial. Run sudo apt-get update, then look for it: "
                         "apt-cache search python3 | grep <part of the name>")),
            Case(r"locate package (?!ros-)(?P<name>\S{1,100})",
                 why=msg("None of apt's sources has a package {name}."),
                 fix=msg("Run sudo apt-get update, then look for its name: apt-cache search {name}")),
        ),
        seen=r"Unable to locate package (?P<name>\S{1,100})", values={"name": "my-package"},
        look=(looks.ubuntu,),
    ),
    TerminalText(
        id="lab.apt_depends", link=links.INSTALLATION,
        title=msg("apt cannot install the package together with what is installed"),
        why=msg("The package needs other packages in certain versions, and apt has or finds others: the "
                "system is not up to date, some sources are switched off, or a package is from another "
                "source (a PPA)."),
        fix=msg("Run sudo apt-get update && sudo apt-get dist-upgrade, and the command again. Do not let apt "
                "remove packages that you did not name. If it stays, look at the first line below unmet "
                "dependencies: apt-cache policy <package> shows where its versions are from; a version of a "
                "PPA goes back with sudo ppa-purge."),
        seen=r"have unmet dependencies|[Uu]nable to correct problems, you have held broken packages"
             r"|pkgProblemResolver::Resolve generated breaks",
    ),
    TerminalText(
        id="lab.apt_lock", link=links.INSTALLATION,
        title=msg("Another program installs packages at this moment"),
        why=msg("Only one program at a time may install packages. Often it is the automatic update."),
        fix=msg("Wait some minutes, then run the command again. If it stays, restart the computer."),
        seen=r"Could not get lock /var/lib/(?:dpkg|apt)/\S{1,60}",
    ),
    TerminalText(
        id="lab.rosdep_start", link=links.ROSDEP,
        title=msg("rosdep is not ready"),
        why=msg("rosdep needs a list of sources, made once for the computer, and a copy of what they "
                "say, made for each user."),
        fix=msg("Run sudo rosdep init, then rosdep update (without sudo), and the command again. If "
                "rosdep is not there: sudo apt-get install python3-rosdep"),
        cases=(
            Case(r"default sources list file already exists",
                 why=msg("rosdep init was done on this computer before. It is done once."),
                 fix=msg("Run rosdep update, and go on.")),
        ),
        seen=r"rosdep installation has not been initialized|default sources list file already exists"
             r"|rosdep: (?:command )?not found|Command 'rosdep' not found"
             r"|no sources directory exists on the system meaning rosdep",
    ),
    TerminalText(
        id="lab.rosdep_key", link=links.ROSDEP,
        title=msg("rosdep does not know a dependency of package.xml"),
        why=msg("rosdep looks for {key} among the packages of this ROS and in its own list of names. "
                "Names of pip are not in it: what pip calls pyserial, rosdep calls python3-serial."),
        fix=msg("Look for the name in rosdep db | grep {key}, and write it into package.xml: of a Python "
                "module it begins with python3-. If {key} is a package of yours, put it into src and "
                "use --ignore-src. Then run rosdep update and the command again."),
        cases=(
            Case(r"rosdep definition for \[(?P<key>ament_python)\]",
                 why=msg("ament_python is a build type, and no package that can be installed."),
                 fix=msg("Delete the line <buildtool_depend>ament_python</buildtool_depend> in "
                         "package.xml. <build_type>ament_python</build_type> below export stays.")),
            Case(r"rosdep definition for \[(?P<key>rospy|roscpp|catkin|message_generation|message_runtime|"
                 r"dynamic_reconfigure|rostest)\]",
                 why=msg("{key} belongs to ROS 1. ROS 2 has no such package."),
                 fix=msg("Take the branch of the package that is made for ROS 2, or write the one of "
                         "ROS 2 into package.xml: rclpy for rospy, rclcpp for roscpp, "
                         "rosidl_default_generators for message_generation.")),
        ),
        seen=r"Cannot locate rosdep definition for \[(?P<key>[^\]\n]{1,100})\]",
        values={"key": "pyserial"},
    ),
    TerminalText(
        id="lab.sudo", link=links.ENVIRONMENT,
        title=msg("sudo does not see ROS"),
        why=msg("sudo starts the command as root, in a new environment: what you have sourced is not "
                "there. Sourcing again does not change that."),
        fix=msg("Run the command without sudo. If it needs a device, give your user the right to it: sudo "
                "usermod -aG dialout $USER for a serial port, then log out and in."),
        in_lab=msg("Run the command without sudo."),
        seen=r"sudo: (?:ros2|colcon|rosdep): command not found",
    ),
)  # fmt: skip
