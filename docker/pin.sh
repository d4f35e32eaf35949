#!/usr/bin/env bash
# Prints the current digests of the official images, for grader/ros/distros.toml.
# Needs access to the registry:  docker/pin.sh [DISTRO...]
set -euo pipefail
cd "$(dirname "$0")/.."
[ $# -gt 0 ] || set -- $(sed -n 's/^\[\([a-z]*\)\]$/\1/p' grader/ros/distros.toml)
for distro in "$@"; do
  image="ros:$distro-ros-base"
  docker pull -q "$image" > /dev/null
  echo "[$distro]"
  docker image inspect --format '{{index .RepoDigests 0}}' "$image" | sed 's/.*@/digest = "/; s/$/"/'
done
