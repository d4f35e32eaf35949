# For the commands of a full ROS 2 that the lab has not: runs the real one if there is one after all,
# otherwise says in one line what it is and what to use instead. $1 names the text, see words/en.sh.
lab_text="$1"
shift
IFS=:
for folder in $PATH; do
  if [ -x "$folder/${0##*/}" ] && ! [ "$folder/${0##*/}" -ef "$0" ]; then
    unset IFS
    exec "$folder/${0##*/}" "$@"
  fi
done
unset IFS
. /opt/ros2_teaching_lab/lab/shell/words/load.sh
case $lab_text in
  window) lab_say "$lab_window_program" "${0##*/}" "$ROS_DISTRO" ;;
  install) lab_say "$lab_installs" "${0##*/}" ;;
esac >&2
exit 127
