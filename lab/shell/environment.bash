# Sets up ROS and the lab's commands for every shell and every command of the lab (any sh can read it).
# It does not source the overlay, because students learn to do that themselves.

# By default nodes stay on their own machine, so that the nodes of a class do not find each other.
if [ "$ROS_DISTRO" = humble ]; then
  export ROS_LOCALHOST_ONLY="${ROS_LOCALHOST_ONLY:-1}"
else
  export ROS_AUTOMATIC_DISCOVERY_RANGE="${ROS_AUTOMATIC_DISCOVERY_RANGE:-LOCALHOST}"
fi

# in a function, because a sourced file would otherwise see the caller's arguments
_lab_source_ros() {
  if [ -r /opt/ros/image/environment.sh ]; then  # an image has the variables ready
    . /opt/ros/image/environment.sh
    case $- in
      *i*) ;;  # setup.bash adds completion
      *) return 0 ;;
    esac
  fi
  [ -z "${BASH_VERSION:-}" ] || . "/opt/ros/$ROS_DISTRO/setup.bash"
}
_lab_source_ros
unset -f _lab_source_ros

# `ros2 lab` and `ros2 grade` for the real ros2cli; that of the wheels has them
if [ -d "/opt/ros/$ROS_DISTRO/share/ros2cli" ]; then
  case ":${PYTHONPATH:-}:" in
    *:/opt/ros2_teaching_lab/lab/shell/ros2cli:*) ;;
    *) export PYTHONPATH="${PYTHONPATH:+$PYTHONPATH:}/opt/ros2_teaching_lab/lab/shell/ros2cli" ;;
  esac
fi

# without a screen the real turtlesim draws nowhere; the window shows what its topics say
if [ -z "${DISPLAY:-}${WAYLAND_DISPLAY:-}" ]; then
  export QT_QPA_PLATFORM="${QT_QPA_PLATFORM:-offscreen}"
fi

export LAB_PROGRAMS=/opt/ros2_teaching_lab/lab/shell/bin
case ":$PATH:" in
  *":$LAB_PROGRAMS:"*) ;;
  *) export PATH="$PATH:$LAB_PROGRAMS" ;;
esac

if [ -z "${EDITOR:-}" ]; then
  for _lab_editor in nano vim vi; do
    if type "$_lab_editor" > /dev/null 2>&1; then
      export EDITOR="$_lab_editor"
      break
    fi
  done
  unset _lab_editor
fi
