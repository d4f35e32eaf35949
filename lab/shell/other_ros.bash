# Says that the workspace was built for another ROS than the lab's, with what to do. `$1` is `told` if a
# script whose Python is gone has been named already, else empty.
[ ! -d ~/ros2_ws/install ] || (  # a subshell, so that its variables do not stay
  mapfile -t ros < <(/opt/ros2_teaching_lab/.venv/bin/python -I -S \
    /opt/ros2_teaching_lab/grader/ros/built_for.py ~/ros2_ws/install "$ROS_DISTRO" 2> /dev/null)
  . /opt/ros2_teaching_lab/lab/shell/words/load.sh
  case "${ros[0]:-} $1" in
    other\ *) lab_say "$lab_other_ros" "${ros[@]:1}" ;;
    "gone ") lab_say "$lab_python_gone" "${ros[@]:1}" ;;
  esac
)
