# Where only the workspace is kept (docker compose, the dev container), the files that a student
# makes in the rest of the home are copied into the workspace when a terminal ends, and back when the
# next lab begins. Caches are not.
_lab_kept=~/ros2_ws/.lab/home

_lab_restore_home() {
  [ ! -e ~/.lab_opened ] || return 0  # by the first terminal of this lab
  [ ! -d "$_lab_kept" ] || cp -a "$_lab_kept/." ~/
  : > ~/.lab_opened || return
  # The student's files are those that are newer. Time stamps advance in steps of some milliseconds,
  # so the terminal waits for the next step: a file that is made at once is newer, too.
  until ! : > ~/.lab_step || [ ~/.lab_step -nt ~/.lab_opened ]; do :; done
  rm -f ~/.lab_step
}

# Prints the files to keep, each ended by a null byte: changed ones, and those kept last time.
_lab_own_files() {
  local file
  {
    find . \( -path ./ros2_ws -o -path ./.cache -o -path ./.ros -o -path './.*-server' \) -prune \
      -o -type f -newer .lab_opened -print0
    [ ! -d "$_lab_kept" ] || (cd "$_lab_kept" && find . -type f -print0)
  } | sort -zu | while IFS= read -r -d '' file; do
    [ ! -f "$file" ] || printf '%s\0' "$file"
  done
}

# (one terminal at a time: two that end together would put one's copy into the other's; copies that
# a killed terminal has not finished are removed)
_lab_keep_home() {
  local new names lock
  mkdir -p ~/ros2_ws/.lab && exec {lock}> ~/ros2_ws/.lab/home.lock && flock -w 20 "$lock" || return
  rm -rf ~/ros2_ws/.lab/home.?????? && new=$(mktemp -d ~/ros2_ws/.lab/home.XXXXXX) || return
  if (cd ~ && set -o pipefail && _lab_own_files | tar -c --null -T - | tar -x -C "$new"); then
    rm -rf "$_lab_kept"
    mv -T "$new" "$_lab_kept"
    names=$(cd "$_lab_kept" && find . -type f -not -path './.*' -printf '%P\n' | sort | head -n 5 |
      paste -sd ' ')
    [ -z "$names" ] || (
      . /opt/ros2_teaching_lab/lab/shell/words/load.sh
      lab_say "$lab_home_is_kept" "$names"
    )
  else
    rm -rf "$new"
  fi
  exec {lock}>&-
}

_lab_restore_home
trap _lab_keep_home EXIT
