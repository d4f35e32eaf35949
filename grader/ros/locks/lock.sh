#!/bin/sh
# Rewrites every lock file: one resolution for all supported Pythons, with hashes.
set -eu
cd "$(dirname "$0")/../../.."
compile() {
  input=$1 output=$2
  shift 2
  uv pip compile -q --universal --python-version 3.10 --generate-hashes --no-annotate --no-header \
    --no-emit-index-url --allow-unsafe "$@" "$input" -o "$output"
}
for distro in jazzy kilted; do
  compile "grader/ros/locks/$distro.in" "grader/ros/locks/$distro.txt"
  compile "grader/ros/locks/$distro-interfaces.in" "grader/ros/locks/$distro-interfaces.txt" --no-deps
done
compile grader/requirements.in grader/requirements.txt
compile grader/requirements-cluster.in grader/requirements-cluster.txt
compile tests/requirements.in tests/requirements.txt
