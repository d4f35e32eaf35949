# Tab completion of colcon, and of ros2 if ROS has none itself (the wheels prefix).

for _lab_hook in "/opt/ros/$ROS_DISTRO" /usr; do
  _lab_hook="$_lab_hook/share/colcon_argcomplete/hook/colcon-argcomplete.bash"
  if [ -r "$_lab_hook" ]; then
    . "$_lab_hook"
    break
  fi
done
unset _lab_hook

# The wheels' ros2 knows what can follow: commands, options, and names on the graph.
_lab_ros2() {
  local words
  words="$(ros2 _complete "${COMP_WORDS[@]:1:COMP_CWORD-1}" 2> /dev/null)"
  # options only where one is begun, or where nothing else can stand
  case ${COMP_WORDS[COMP_CWORD]} in
    -*) ;;
    *) words="$(grep -v '^-' <<< "$words")" ;;
  esac
  mapfile -t COMPREPLY < <(compgen -W "$words" -- "${COMP_WORDS[COMP_CWORD]}")
}
complete -p ros2 > /dev/null 2>&1 || complete -o default -F _lab_ros2 ros2
