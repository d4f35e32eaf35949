"""Windows, graphics and devices: what a program needs besides the terminal."""

from __future__ import annotations

from grader.base.i18n.message import msg
from grader.explain import looks
from grader.explain.terminal_text import Case, TerminalText
from grader.mistakes import links

KINDS = (
    TerminalText(
        id="lab.no_screen", link=links.INSTALLATION,
        title=msg("There is no screen for the program's window"),
        why=msg("A program with a window needs a display. A container, a remote terminal or a server has "
                "none of its own. Installing the program again does not change that."),
        fix=msg("In a container of your own, give it the screen: docker run -e DISPLAY -v "
                "/tmp/.X11-unix:/tmp/.X11-unix …, after xhost +local: on your computer. Over ssh: ssh -X. "
                "In WSL: wsl --update in Windows."),
        in_lab=msg("Run window: the browser shows the turtle, the graph, the log, plots and parameters."),
        cases=(
            Case(r"Could not load the Qt platform plugin \"xcb\" in \"[^\"\n]{0,200}/cv2/",
                 why=msg("opencv-python brings a Qt library of its own, which does not fit the system's "
                         "programs."),
                 fix=msg("The Qt of pip's opencv-python is in the way. Run pip uninstall opencv-python, "
                         "and sudo apt-get install python3-opencv.")),
            Case(r"Authorization required, but no authorization|No protocol specified"
                 r"|Invalid MIT-MAGIC-COOKIE",
                 why=msg("The screen is there, but it refuses this user: the one in a container, or root, "
                         "is not the one who is logged in."),
                 fix=msg("Run xhost +local: in a terminal of your desktop, then start the program again. "
                         "Do not start it with sudo.")),
            Case(r"could not connect to display (?P<display>(?!localhost)[\w.-]{1,80}:\d\S{0,10})",
                 why=msg("DISPLAY names an X server at {display}, and none answers there: it is not started, "
                         "it refuses, or the address is an old one."),
                 fix=msg("Run grep -n DISPLAY ~/.bashrc. In WSL, delete that line, run wsl --update and wsl "
                         "--shutdown in Windows, and open a new terminal: it has a screen of its own, and "
                         "DISPLAY is :0. With an X server of your own in Windows, start it without access "
                         "control, and let the firewall pass it.")),
            Case(r"libxcb-cursor0|xcb-cursor",
                 why=msg("Qt needs the library libxcb-cursor0, which is not installed."),
                 fix=msg("Run: sudo apt-get install libxcb-cursor0")),
        ),
        seen=r"could not connect to display|[Cc]an(?:no|')t open display|Unable to open display"
             r"|no display name and no \$DISPLAY"
             r"|Could not load the Qt platform plugin \"(?:xcb|wayland)\""
             r"|Authorization required, but no authorization protocol specified",
        look=(looks.screen,),
    ),
    TerminalText(
        id="lab.graphics", link=links.TROUBLESHOOTING,
        title=msg("The graphics driver does not do what the program needs"),
        why=msg("RViz and Gazebo draw with OpenGL. In WSL, a virtual machine or a container, the driver "
                "of the graphics card is often missing or breaks off."),
        fix=msg("Let the processor draw: run export LIBGL_ALWAYS_SOFTWARE=1, then start the program in the "
                "same terminal. If that helps, write the line at the end of ~/.bashrc."),
        cases=(
            Case(r"Invalid parentWindowHandle|^wayland$|XDG_SESSION_TYPE=wayland",
                 why=msg("RViz draws in a window of X11. Your desktop runs Wayland, and Qt has made a window of "
                         "that."),
                 fix=msg("Run export QT_QPA_PLATFORM=xcb, then start the program in the same terminal; or choose "
                         "Ubuntu on Xorg when you log in. If it is the same there, try export "
                         "LIBGL_ALWAYS_SOFTWARE=1.")),
        ),
        seen=r"D3D12: Removing Device|libGL error: [^\n]{1,120}|Failed to create (?:an )?OpenGL context"
             r"|[Uu]nable to create (?:a suitable |the )?(?:GLXContext|rendering window|glx visual)"
             r"|Invalid parentWindowHandle|MESA(?:-LOADER)?: (?:error|failed)[^\n]{0,120}"
             r"|OGRE EXCEPTION[^\n]{0,200}GL[^\n]{0,100}|GLXBadContext|GLXBadFBConfig",
    ),
    TerminalText(
        id="lab.device", link=links.INSTALLATION,
        title=msg("Your user may not use the device"),
        why=msg("{path} belongs to the group dialout, and a program may open it only if its user is in "
                "that group."),
        fix=msg("Run sudo usermod -aG dialout $USER, then log out and in again (in WSL: wsl --shutdown in "
                "Windows). groups must show dialout. For a container, add: --device {path}"),
        seen=r"(?i:permission denied)[^\n]{0,80}(?P<path>/dev/tty(?:USB|ACM|AMA|S|THS)\d{1,3})\b"
             r"|(?P<path_2>/dev/tty(?:USB|ACM|AMA|S|THS)\d{1,3})\b[^\n]{0,80}(?i:permission denied|errno: 13)",
        values={"path": "/dev/ttyUSB0", "group": "dialout"}, look=(looks.groups_of_user,),
    ),
    TerminalText(
        id="lab.docker_user", link=links.INSTALLATION,
        title=msg("Your user may not talk to Docker"),
        why=msg("Only root and the group docker may talk to the Docker daemon."),
        fix=msg("Run sudo usermod -aG docker $USER, then log out and in again. groups must show docker."),
        cases=(
            Case(r"Is the docker daemon running",
                 why=msg("The Docker daemon does not run."),
                 fix=msg("Run sudo systemctl start docker. With Docker Desktop, start that program and "
                         "wait until it is ready.")),
        ),
        seen=r"permission denied while trying to connect to the [Dd]ocker[^\n]{0,200}"
             r"|Cannot connect to the Docker daemon[^\n]{0,200}",
        values={"group": "docker"}, look=(looks.groups_of_user,),
    ),
    TerminalText(
        id="lab.device_gone", link=links.INSTALLATION,
        title=msg("The device is not there"),
        why=msg("Linux makes {path} when the device is plugged in, and may give it another number each "
                "time. A container or WSL sees only what is passed to it."),
        fix=msg("Run ls /dev/tty* with and without the device plugged in: the one that comes is its name. "
                "Give the node that name. In WSL: usbipd attach --wsl --busid <id> in Windows; for a "
                "container: --device {path}"),
        seen=r"[Nn]o such file or directory: '?(?P<path>/dev/(?:tty|video)\w{1,20})"
             r"|could not open port '?(?P<path_2>/dev/\w{1,20})'?: \[Errno 2\]",
        values={"path": "/dev/ttyUSB0"},
    ),
)  # fmt: skip
