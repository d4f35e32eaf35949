# Before each prompt: keep the history, tell `lab watch` what this terminal has sourced and how the
# last `ros2 run` ended, and say which step of the lesson is done since the last time.
if [ -z "${LAB_HOME_KEPT:-}" ]; then
  HISTFILE=~/ros2_ws/.lab/bash_history
fi

# PS0 is expanded when a command begins: this prints nothing and keeps the time (in microseconds)
_lab_nothing=x  # (of an empty text bash would not look at the place)
PS0='${_lab_nothing:$((_lab_began=${EPOCHREALTIME/[.,]/}, 0)):0}'

_lab_before_prompt() {
  local status=$? first=${PIPESTATUS[0]} kept=~/ros2_ws/.lab
  history -a 2> /dev/null
  [ -d ~/ros2_ws ] || return "$status"
  if [ "${_lab_sourced-none}" != "${AMENT_PREFIX_PATH:-}" ]; then
    _lab_sourced=${AMENT_PREFIX_PATH:-}
    { mkdir -p "$kept" && printf '%s\n' "$_lab_sourced" > "$kept/terminal"; } 2> /dev/null
    _lab_look=1
  fi
  if [ -n "${_lab_began:-}" ]; then
    _lab_keep_run "$first"
    _lab_began=
  elif [ ! -e "$kept/ran" ]; then
    { mkdir -p "$kept" && : > "$kept/ran"; } 2> /dev/null
  fi
  if [ -n "${_lab_look:-}" ] || _lab_has_changed; then
    _lab_look=
    : > "$kept/looked" 2> /dev/null
    lab notice
  fi
  return "$status"
}

# Keeps when a `ros2 run` began and ended, its exit status, and the line; if it failed, says whether the
# workspace was built for another ROS.
_lab_keep_run() {
  local line
  line=$(HISTTIMEFORMAT='' builtin history 1)
  line=${line#*[0-9]  }
  case "$line" in
    *"ros2 run "*) ;;
    *) return ;;
  esac
  printf '%s\t%s\t%s\t%s\n' "$_lab_began" "${EPOCHREALTIME/[.,]/}" "$1" "$line" \
    2> /dev/null > "$kept/ran" && _lab_look=1
  case "$1 $line" in
    0\ * | 130\ * | 254\ * | *explain*) return ;;  # ended well, by Ctrl+C, or explained
  esac
  # the wheels' ros2 names a script whose Python is gone itself, the real one shows a traceback
  [ -d "/opt/ros/$ROS_DISTRO/share/ros2cli" ] && set -- '' || set -- told
  . /opt/ros2_teaching_lab/lab/shell/other_ros.bash "$1"
}

# Whether a file of the packages or of the build is newer than the last look.
_lab_has_changed() {
  [ -e ~/ros2_ws/.lab/looked ] || return 0
  local found
  found=$(find ~/ros2_ws/src ~/ros2_ws/install -maxdepth 5 -newer ~/ros2_ws/.lab/looked \
    -not -name '__pycache__' -print -quit 2> /dev/null)
  [ -n "$found" ]
}

case "${PROMPT_COMMAND:-}" in
  *_lab_before_prompt*) ;;
  *) PROMPT_COMMAND="_lab_before_prompt${PROMPT_COMMAND:+; $PROMPT_COMMAND}" ;;
esac
