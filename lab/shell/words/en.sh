# The texts of the lab's shell in English. Every language has the same names and %-placeholders.
lab_welcome='  ROS 2 %s. Your workspace is ~/ros2_ws; it is kept when you leave.\n'
lab_on_your_machine='  On your machine: %q\n'
lab_lab='    lab     watches your work and takes you through the lesson (in a second terminal)\n'
lab_guide='    guide   shows what to do next, step by step\n'
lab_check="    check   runs the same checks as your instructor\n"
lab_fix="    fix     shows how to fix what check has found\n"
lab_exit='    exit    leaves the lab\n'
lab_home_is_kept='Your files outside ~/ros2_ws (%s) are kept in ~/ros2_ws/.lab/home and come back in the next lab.\n'
lab_no_editor='  There is no editor here: edit your files outside the lab, or install nano.\n'
lab_code_outside='VS Code runs outside the lab. Open this folder in VS Code on your machine:\n  %s\n'
lab_some_folder='your workspace folder'
lab_edit_here='You can also edit here, for example: %s my_node.py\n'
lab_window_program='%s has a window, and the lab has no screen for it. Use lab window: it shows the turtle, the graph, the log, plots and parameters in your browser. A desktop installation of ROS 2 has the program itself (ros-%s-desktop).\n'
lab_installs='%s installs packages as root, which the lab does not allow. All that the lessons need is installed; if you need more, ask your instructor.\n'
