# Tab completion of colcon, and of ros2 if ROS has none itself (the wheels prefix).

for _lab_hook in "/opt/ros/$ROS_DISTRO" /usr; do
  _lab_hook="$_lab_hook/share/colcon_argcomplete/hook/colcon-argcomplete.bash"
  if [ -r "$_lab_hook" ]; then
    . "$_lab_hook"
    break
  fi
done
unset _lab_hook

_lab_ros2() {
  local words=""
  case $COMP_CWORD in
    1) words="node pkg run topic" ;;
    2)
      case ${COMP_WORDS[1]} in
        node | topic) words="list" ;;
        pkg) words="create executables list prefix xml" ;;
        run) words="$(ros2 pkg list 2> /dev/null)" ;;
      esac
      ;;
    3)
      case ${COMP_WORDS[1]}:${COMP_WORDS[2]} in
        run:*) words="$(ros2 pkg executables "${COMP_WORDS[2]}" 2> /dev/null | cut -d' ' -f2)" ;;
        pkg:executables | pkg:prefix | pkg:xml) words="$(ros2 pkg list 2> /dev/null)" ;;
      esac
      ;;
  esac
  mapfile -t COMPREPLY < <(compgen -W "$words" -- "${COMP_WORDS[COMP_CWORD]}")
}
complete -p ros2 > /dev/null 2>&1 || complete -o default -F _lab_ros2 ros2
