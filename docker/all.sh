#!/usr/bin/env bash
# Builds and tests all distros and bases on a machine with access to a registry, and prints the table
# for the README:  docker/all.sh [DISTRO...]
# For each: builds both images, marks the solutions of all lessons in a container (they must get full
# marks), and runs `ros2 pkg prefix`, `ros2 lab` and `ros2 grade` in the lab. WHEELS_BASE names
# another image for the base `wheels`.
set -uo pipefail
cd "$(dirname "$0")/.."
python3 grader/bootstrap.py || exit 3
[ $# -gt 0 ] || set -- $(sed -n 's/^\[\([a-z]*\)\]$/\1/p' grader/ros/distros.toml)
repository=${GRADER_IMAGES:-ros2-teaching-lab}
lessons=$(sed -n 's/^lessons: *\[\(.*\)\]$/\1/p' lab/course/course.yaml | tr -d ,)
log=$(mktemp -d)
failed=0
printf '| distro | base | built | marked | lab | grade image | lab image |\n|---|---|---|---|---|---|---|\n'
for distro in "$@"; do
  for base in ros wheels; do
    if [ $base = wheels ] && ! grep -q "^\[$distro.wheels\]" grader/ros/distros.toml; then continue; fi
    suffix=$([ $base = wheels ] && echo -wheels || true)
    built=no marked=no lab=no
    # another repository for each row, so that the row's own image is used
    export GRADER_IMAGES="$repository-row-$distro-$base"
    image=$([ $base = wheels ] && echo "${WHEELS_BASE:-}" || true)
    if .venv/bin/python -m grader images --distro "$distro" --base $base \
      ${image:+--base-image "$image"} \
      ${EXTRA_CA:+--extra-ca "$EXTRA_CA"} ${APT_MIRROR:+--apt-mirror "$APT_MIRROR"} \
      ${PIP_INDEX_URL:+--pip-index "$PIP_INDEX_URL"} > "$log/$distro-$base.log" 2>&1; then
      built=yes
      marked=yes
      for lesson in $lessons; do
        .venv/bin/python -m grader grade "grader/keys/$lesson/solution" --assignment "$lesson" \
          --sandbox docker --distro "$distro" --out "$log/reports-$base" \
          >> "$log/$distro-$base.log" 2>&1 || marked=no
      done
      docker run --rm "$GRADER_IMAGES:lab-$distro$suffix" bash -c \
        'ros2 pkg prefix rclpy && ros2 lab --help && ros2 grade --help' >> "$log/$distro-$base.log" 2>&1 &&
        lab=yes
    fi
    size() { docker image inspect --format '{{.Size}}' "$1" 2> /dev/null | awk '$1 {printf "%.0f MB", $1 / 1e6}'; }
    printf '| %s | %s | %s | %s | %s | %s | %s |\n' "$distro" $base $built $marked $lab \
      "$(size "$GRADER_IMAGES:grade-$distro$suffix")" "$(size "$GRADER_IMAGES:lab-$distro$suffix")"
    [ $built$marked$lab = yesyesyes ] || failed=1
  done
done
echo "logs: $log" >&2
exit $failed
