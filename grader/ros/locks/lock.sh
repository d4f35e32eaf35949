#!/bin/sh
# Rewrites every lock file: one resolution for all supported Pythons, with hashes.
set -eu
cd "$(dirname "$0")/../../.."
compile() {
  uv pip compile -q --universal --python-version 3.10 --generate-hashes --no-annotate --no-header \
    --no-emit-index-url --allow-unsafe "$1" -o "$2"
}
for distro in jazzy kilted; do
  compile "grader/ros/locks/$distro.in" "grader/ros/locks/$distro.txt"
done
compile grader/requirements.in grader/requirements.txt
compile grader/requirements-cluster.in grader/requirements-cluster.txt
compile tests/requirements.in tests/requirements.txt
