# What the lab's shell says, in English. Each language has the same names with the same %-places.
lab_welcome='  ROS 2 %s. Your workspace is ~/ros2_ws; it stays when you leave.\n'
lab_on_your_machine='  On your machine it is %q\n'
lab_guide='    guide   what to do next, step by step\n'
lab_check="    check   is it right? the same checks as your instructor's\n"
lab_fix="    fix     shows the change that fixes what check has found\n"
lab_exit='    exit    leave the lab\n'
lab_no_editor='  There is no editor here: write your files from outside the lab, or install nano.\n'
lab_code_outside='VS Code runs outside of the lab. Open this folder in it, on your machine:\n  %s\n'
lab_some_folder='the folder of your workspace'
lab_edit_here='Or edit here, for example: %s my_node.py\n'
