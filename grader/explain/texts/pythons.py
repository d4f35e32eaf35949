"""Which Python runs, and which modules it has: conda, venv, pip, setuptools, NumPy, empy."""

from __future__ import annotations

from grader.base.i18n.message import msg
from grader.explain import looks
from grader.explain.terminal_text import Case, TerminalText
from grader.explain.texts.names import CONDA, OF_ROS, OWN_PYTHON, VENV
from grader.mistakes import links

KINDS = (
    TerminalText(
        id="lab.other_python", link=links.PYTHON_PACKAGES,
        title=msg("Another Python runs than the one of ROS"),
        why=msg("Parts of ROS are compiled for the system's Python and its libraries. The Python of conda, "
                "or of a venv with another version, cannot load them."),
        fix=msg("Run which python3 and python3 --version. Start the node with the system's Python: with "
                "ros2 run, or with /usr/bin/python3."),
        cases=(
            Case(CONDA,
                 fix=msg("Run conda deactivate, then which python3: it must show /usr/bin/python3. Run the "
                         "command again. If you built with conda active, delete the folders build and "
                         "install first and build again. For all new terminals: conda config --set "
                         "auto_activate_base false")),
            Case(r"/\.pyenv/",
                 fix=msg("Run pyenv shell system, then which python3: it must show /usr/bin/python3. Run the "
                         "command again. For all new terminals: pyenv global system. If you built with the "
                         "other Python, delete the folders build and install first and build again.")),
            Case(VENV,
                 fix=msg("Run deactivate, then which python3: it must show /usr/bin/python3. Run the "
                         "command again. A venv for ROS is made with the system's Python: "
                         "/usr/bin/python3 -m venv --system-site-packages <folder>")),
        ),
        seen=r"(?:No module named 'rclpy\._rclpy_pybind11'|_rclpy_pybind11\.cpython-3\d{1,2}-)"
             r"[\s\S]{0,300}?isn't present on the system"
             r"|No module named 'rclpy\._rclpy(?:_pybind11)?'"
             rf"|{CONDA}[^\n]{{0,200}}libstdc\+\+[^\n]{{0,80}}version `(?:GLIBCXX|CXXABI)_",
        # (the same version: the file is missing for another reason)
        unless=r"/opt/ros/\S{1,80}/python3\.(\d{1,2})/[\s\S]{0,3000}pybind11\.cpython-3\1-",
        shown={
            r"\.cpython-3(?P<minor>\d{1,2})-": msg("Python 3.{minor} runs."),
            OWN_PYTHON: msg("ROS 2 {distro} has its modules for Python {own}."),
            CONDA: msg("conda is active in this terminal."),
        },
        look=(looks.python,),
    ),
    TerminalText(
        id="lab.python_2", link=links.PYTHON_PACKAGES,
        title=msg("Python 2 runs the file"),
        why=msg("ROS 2 is for Python 3. The first line of the file, or the command, says python."),
        fix=msg("Write #!/usr/bin/env python3 as the first line of the file, and start it with ros2 run, or "
                "a launch file with ros2 launch."),
        seen=r"^ImportError: No module named [\w.]{1,120}$|/lib/python2\.\d/",
    ),
    TerminalText(
        id="lab.ros2_modules", link=links.PYTHON_PACKAGES,
        title=msg("The ros2 command runs with a Python that lacks modules"),
        why=msg("ros2 does not find {module}. Its modules are installed for the system's Python; "
                "another one, or one of its packages by pip, comes first here."),
        fix=msg("Run which python3: it must show /usr/bin/python3. If it does not, run conda deactivate or "
                "deactivate. If it does: sudo apt-get install python3-yaml python3-catkin-pkg python3-lark"),
        seen=r"Failed to load entry point '\w{1,60}': No module named '(?P<module>[\w.]{1,120})'"
             r"|PackageNotFoundError: (?:No package metadata was found for )?(?P<module_2>ros2cli)",
        values={"module": "yaml"}, look=(looks.python,),
    ),
    TerminalText(
        id="lab.build_python", link=links.PYTHON_PACKAGES,
        title=msg("The build uses a Python without the modules of the build tools"),
        why=msg("CMake takes the first python3 of the terminal, and keeps its path in the folder build. "
                "The module {module} is installed for the system's Python, not for that of conda or a "
                "venv."),
        fix=msg("Run which python3. If it is not /usr/bin/python3, deactivate conda or the venv, delete "
                "the folders build and install, and build again. If it is: sudo apt-get install "
                "python3-catkin-pkg python3-empy python3-lark"),
        cases=(
            Case(CONDA,
                 fix=msg("Run conda deactivate, delete the folders build and install, and build again in "
                         "this terminal. which python3 must show /usr/bin/python3 before.")),
            Case(VENV,
                 fix=msg("Run deactivate, delete the folders build and install, and build again in this "
                         "terminal. which python3 must show /usr/bin/python3 before.")),
            Case(r"execute_process\(/usr/bin/python3\b",
                 fix=msg("Run: sudo apt-get install python3-catkin-pkg python3-empy python3-lark. Then "
                         "build again.")),
        ),
        seen=r"ModuleNotFoundError: No module named '(?P<module>catkin_pkg|em|empy|lark|ament_package)'",
        shown={
            r"(?:execute_process\(|Python3_EXECUTABLE[:=]\S{0,20})(?P<python>/[^\s)]{1,200})":
                msg("CMake runs {python}."),
        },
        values={"module": "catkin_pkg"}, look=(looks.python,),
    ),
    TerminalText(
        id="lab.empy", link=links.TROUBLESHOOTING,
        title=msg("The wrong version of empy is installed"),
        why=msg("The build creates the code of interfaces with the module em of empy 3.3.4. pip has "
                "installed empy 4, or another package that is called em, in its place."),
        fix=msg("Run pip uninstall em empy: the system's python3-empy stays (sudo apt-get install "
                "python3-empy). In conda or a venv, also: pip install empy==3.3.4. Then delete the folders "
                "build and install, and build again."),
        seen=r"AttributeError: module 'em' has no attribute '\w{1,60}'"
             r"|cannot import name '\w{1,60}' from 'em'",
    ),
    TerminalText(
        id="lab.numpy", link=links.PYTHON_PACKAGES,
        title=msg("pip's NumPy is too new for a module of the system"),
        why=msg("apt's modules, cv_bridge among them, are made for the NumPy of apt. pip has installed a "
                "newer one in ~/.local, and Python takes that one first."),
        fix=msg("Run pip uninstall numpy: the system's NumPy stays. If a package of pip needs its own, run "
                "pip install 'numpy<2'. In a venv, run the same there."),
        seen=r"compiled using NumPy 1\.x cannot be run in|AttributeError: _ARRAY_API not found"
             r"|numpy\.core\.multiarray failed to import|numpy\.dtype size changed"
             # (in a library: in the student's own file, that is a name to replace)
             r"|/dist-packages/\S{1,200}\", line \d{1,6}, in [^\n]{1,120}\n[^\n]{0,200}\n"
             r"AttributeError: module 'numpy' has no attribute '\w{1,40}'",
        look=(looks.python,),
    ),
    TerminalText(
        id="lab.managed_python", link=links.PYTHON_PACKAGES,
        title=msg("pip may not change the system's Python"),
        why=msg("Ubuntu's own programs, ROS among them, need the modules of the system's Python in the "
                "versions of apt. pip installs there no longer."),
        fix=msg("Look for it in apt first: apt-cache search python3 | grep -i <part of the name>. apt's name "
                "is python3- and the name that Python imports, as python3-serial for pyserial: sudo apt-get "
                "install that. If apt does not have it, make a venv that sees the modules of ROS: python3 -m "
                "venv --system-site-packages ~/ros2_ws/venv && touch ~/ros2_ws/venv/COLCON_IGNORE, then "
                "source ~/ros2_ws/venv/bin/activate and use pip."),
        in_lab=msg("Make a venv that sees the modules of ROS: python3 -m venv --system-site-packages "
                   "~/ros2_ws/venv && touch ~/ros2_ws/venv/COLCON_IGNORE, then source "
                   "~/ros2_ws/venv/bin/activate and use pip."),
        cases=(
            Case(r"No module named '(?P<module>[a-z]\w{1,80})'",
                 fix=msg("Try apt first, whose package is often called like the module that you import: sudo "
                         "apt-get install python3-{module}. If apt does not have it, make a venv that sees the "
                         "modules of ROS: python3 -m venv --system-site-packages ~/ros2_ws/venv && touch "
                         "~/ros2_ws/venv/COLCON_IGNORE, then source ~/ros2_ws/venv/bin/activate and use "
                         "pip.")),
        ),
        seen=r"externally-managed-environment",
    ),
    TerminalText(
        id="lab.setuptools", link=links.PYTHON_PACKAGES,
        title=msg("setuptools and colcon do not fit together"),
        why=msg("colcon builds a Python package with the setuptools of its Python. pip or conda has "
                "installed a version that lacks what this colcon uses."),
        fix=msg("Run python3 -m pip install 'setuptools<71' in the same environment, then build again. If "
                "pip has put it over the system's, run pip uninstall setuptools: apt's version stays."),
        seen=r"No module named '(?:setuptools\.(?:extern|config)\S{0,40}|pkg_resources|setuptools|distutils)'"
             r"|canonicalize_version\(\) got an unexpected keyword argument 'strip_trailing_zero'"
             r"|option --(?:uninstall|script-dir|install-layout) not recognized"
             r"|module 'setuptools' has no attribute '\w{1,40}'"
             r"|colcon_python_setup_py/\S{1,80}\.py\"[\s\S]{0,2000}?^(?:Syntax|Value|Type|Attribute)Error: [^\n]{1,200}",
        cases=(
            Case(r"literal_eval",
                 why=msg("colcon runs setup.py and reads what it prints. A setuptools of pip prints more than "
                         "colcon expects; so does a print( in setup.py."),
                 fix=msg("Delete every print( in setup.py. If there is none, run pip uninstall setuptools: "
                         "apt's version stays. Then build again.")),
        ),
        look=(looks.setuptools, looks.python),
    ),
    TerminalText(
        id="lab.editable", link=links.COLCON,
        title=msg("setuptools is too new for colcon"),
        why=msg("From version 80 on, setuptools has no setup.py develop, which --symlink-install "
                "needs. pip installed this version over the system's."),
        fix=msg("Run pip uninstall setuptools (the system's version stays), or pip install "
                "'setuptools<80'"),
        seen=r"option --editable not recognized", look=(looks.setuptools,),
    ),
    TerminalText(
        id="lab.no_rclpy", stage="terminal", link=links.ENVIRONMENT,
        title=msg("Python cannot find rclpy"),
        why=msg("rclpy is part of ROS. Python finds it only in a terminal in which ROS is sourced, "
                "and only the system's own Python does (not that of conda, a venv or an editor's "
                "button)."),
        fix=msg("Run source /opt/ros/{distro}/setup.bash, and start the node with ros2 run."),
        cases=(
            Case(CONDA, fix=msg("Run conda deactivate and source /opt/ros/{distro}/setup.bash, and start "
                                "the node with ros2 run.")),
            Case(VENV, fix=msg("Run deactivate and source /opt/ros/{distro}/setup.bash, and start the node "
                               "with ros2 run.")),
        ),
        seen=r"ModuleNotFoundError: No module named 'rclpy'", look=(looks.ros_sourced, looks.python),
    ),
    TerminalText(
        id="lab.no_module", stage="terminal", link=links.PYTHON_MODULES,
        title=msg("Python does not find the module"),
        why=msg("Python looks for {module} in its own modules, in those of ROS, and in the packages of the "
                "workspaces that this terminal has sourced."),
        fix=msg("If {module} is a file of your package, import it with the package's name: from "
                "my_package.{module} import …. If it is a package of yours, build it and source the "
                "workspace. If it is from the internet, install it with apt, where it is often called "
                "python3-{module}. Otherwise compare the spelling."),
        cases=(
            Case(r"\b(?P<module>[a-z]\w{1,80})\.py\b[\s\S]{0,6000}/(?P<package>\w{1,80})/[\w/]{1,120}\.py\", line \d{1,6}, "
                 r"in <module>\n +(?:from|import) (?P=module)\b[^\n]{0,120}\n(?:[ ^~]{1,120}\n)?"
                 r"ModuleNotFoundError: No module named '(?P=module)'",
                 why=msg("{module}.py is a file of your package {package}. python3 finds it beside the file "
                         "that it starts; ros2 run starts a script that is installed somewhere else."),
                 fix=msg("Write the package's name before it, also in the files that {module} imports: from "
                         "{package}.{module} import …. Then build again.")),
            Case(rf"(?:{VENV}|^\((?!base\))[\w.-]{{1,40}}\) \S+@)[\s\S]*/install/",
                 why=msg("A venv is active, but ros2 run starts the node with the Python in the first line of "
                         "the installed script: the one with which colcon was started, usually "
                         "/usr/bin/python3. It does not see what pip installed in the venv."),
                 fix=msg("Build with the Python of the venv, while it is active: python3 -m pip install "
                         "colcon-common-extensions, then python3 -m colcon build, and source the workspace. "
                         "The venv has to be made with --system-site-packages. Compare the name too: pip "
                         "show -f <package> lists what can be imported.")),
            Case(r"^  File \"<frozen importlib\._bootstrap>\", line \d{1,6}, in \w{1,60}\n"
                 r"ModuleNotFoundError: No module named '(?P<module>\w{1,200})'",
                 fix=msg("An entry of console_scripts in setup.py names it: write name = "
                         "package.module:function there, with the package's name first. If {module} "
                         "is the package: the folder {module} with an __init__.py has to be beside "
                         "setup.py. Then build again.")),
            Case(rf"No module named '(?P<package>{OF_ROS}|launch|launch_ros|ament_index_python|tf_transformations)'",
                 why=msg("{package} is a package of ROS."),
                 fix=msg("Run source /opt/ros/{distro}/setup.bash. If that does not help, it is not installed: "
                         "sudo apt-get install ros-{distro}-{debian}")),
            Case(r"No module named '(?P<package>\w{1,120})\.(?P<name>[\w.]{1,120})'",
                 why=msg("Python finds {package}, but nothing with the name {name} in it, as it is "
                         "installed."),
                 fix=msg("Run ls install/{package}/lib/python3*/site-packages/{package} in the workspace. If "
                         "{name} is missing there: its file has to be in the inner folder {package}, each "
                         "folder needs an __init__.py, and packages in setup.py has to list it (packages="
                         "find_packages() lists all). Then build, and source the workspace.")),
        ),
        seen=r"ModuleNotFoundError: No module named '(?P<module>(?!rclpy['.])[\w.]{1,200})'",
        values={"module": "my_module", "name": "helpers", "package": "my_package", "debian": "my-package"},
    ),
    TerminalText(
        id="lab.python_gone", stage="terminal", link=links.PYTHON_PACKAGES,
        title=msg("The installed script names a Python that is not here"),
        why=msg("The first line of {path} names the Python with which the workspace was built. In another "
                "lab, image or release of ROS, Python is another one or in another folder."),
        fix=msg("Delete the folders build and install of the workspace, and build again."),
        # (not of a program that opens a file: only of one that ros2 run or launch starts)
        seen=r"(?:(?:os\.posix_spawn|_fork_exec|raise child_exception_type|execve)[^\n]{0,300}\n[ ~^]{0,200}\n?)"
             r"FileNotFoundError: \[Errno 2\] No such file or directory: "
             r"'(?P<path>[^'\n]{0,300}/lib/[^'/\n]{1,120}/[^'/\n]{1,120})'"
             r"|^(?P<path_2>/[^\n]{1,300}/lib/[^'/\n]{1,120}/[^'/\n ]{1,120}) cannot start: its first line "
             r"names|(?P<path_3>/[^\s:]{1,300}/lib/[^\s/:]{1,120}/[^\s/:]{1,120}): (?:cannot execute: required "
             r"file not found|\S{1,300}: bad interpreter)",
    ),
    TerminalText(
        id="lab.exec_format", stage="terminal", link=links.COLCON,
        title=msg("The installed file is no program of this computer"),
        why=msg("Linux starts a file by its first line, such as #!/usr/bin/env python3, or by its format. "
                "{path} has neither for this computer."),
        fix=msg("If it is a Python file: write #!/usr/bin/env python3 as the first line of its source, "
                "before everything else. If it was compiled on another computer: delete the folders build "
                "and install. Then build again."),
        seen=r"OSError: \[Errno 8\] Exec format error: '(?P<path>[^'\n]{1,300})'"
             r"|(?P<path_2>/\S{1,300}): cannot execute binary file: Exec format error",
    ),
    TerminalText(
        id="lab.stale_script", stage="terminal", link=links.COLCON,
        title=msg("The installed script is older than setup.py"),
        why=msg("The script of a renamed entry stays in install/, but no longer finds its entry."),
        fix=msg("Delete the folders build and install of the workspace, and build again."),
        seen=r"File \"\S{1,300}/lib/[^/\s]{1,120}/[^/\s\"]{1,120}\", line \d{1,5}[\s\S]{0,1500}?^StopIteration$"
             r"|PackageNotFoundError: No package metadata was found for \S{1,120}",
    ),
)  # fmt: skip
