# Before each prompt: keep the history, tell `lab watch` what this terminal has sourced, and say which
# step of the lesson is done since the last time.
if [ -z "${LAB_HOME_KEPT:-}" ]; then
  HISTFILE=~/ros2_ws/.lab/bash_history
fi

_lab_before_prompt() {
  local status=$? kept=~/ros2_ws/.lab
  history -a 2> /dev/null
  [ -d ~/ros2_ws ] || return "$status"
  if [ "${_lab_sourced-none}" != "${AMENT_PREFIX_PATH:-}" ]; then
    _lab_sourced=${AMENT_PREFIX_PATH:-}
    { mkdir -p "$kept" && printf '%s\n' "$_lab_sourced" > "$kept/terminal"; } 2> /dev/null
    _lab_look=1
  fi
  if [ -n "${_lab_look:-}" ] || _lab_has_changed; then
    _lab_look=
    : > "$kept/looked" 2> /dev/null
    lab notice
  fi
  return "$status"
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
