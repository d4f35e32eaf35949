#!/usr/bin/env bash
# Makes a base image without a registry: debootstrap and `docker import`.
#
#   docker/make_base.sh SUITE IMAGE [MIRROR]
#   docker/make_base.sh trixie ros2-teaching-lab:base
#   docker/make_base.sh noble my-ubuntu:noble http://archive.ubuntu.com/ubuntu
#
# Debian's suites (bookworm, trixie) are sufficient for the wheels images; the official ROS packages
# need Ubuntu's (jammy, noble) and a mirror of Ubuntu. An existing image is kept: remove it first
# (`docker rmi IMAGE`) to make it again. Needs root.
set -euo pipefail

if [ $# -lt 2 ] || [ $# -gt 3 ]; then
  sed -n '2,/^set/s/^# \{0,1\}//p' "$0"
  exit 2
fi
suite=$1 image=$2
case $suite in
  jammy | noble | resolute) mirror=${3:-http://archive.ubuntu.com/ubuntu} components=main,universe ;;
  *) mirror=${3:-http://deb.debian.org/debian} components=main ;;
esac

missing() {
  echo "make_base.sh: $1" >&2
  echo "  $2" >&2
  exit 3
}
[ "$(id -u)" = 0 ] || missing "debootstrap needs root" "Run it with sudo."
command -v debootstrap > /dev/null || missing "debootstrap is missing" "apt-get install debootstrap"
command -v docker > /dev/null || missing "the docker command is missing" "apt-get install docker.io"
docker info > /dev/null 2>&1 || missing "the Docker daemon does not answer" "Start it: systemctl start docker"

if [ -n "$(docker image ls -q "$image")" ]; then
  echo "make_base.sh: $image exists already"
  exit 0
fi

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
script=$suite
# an old debootstrap does not know the name of a new suite; all use the same script
[ -e "/usr/share/debootstrap/scripts/$suite" ] || script=sid
echo "make_base.sh: fetching $suite from $mirror (a minute or two)"
debootstrap --variant=minbase --components="$components" "$suite" "$folder/root" "$mirror" \
  "/usr/share/debootstrap/scripts/$script" > "$folder/log" 2>&1 ||
  missing "debootstrap failed: $(tail -n 3 "$folder/log")" "Is $mirror the right mirror, and can it be reached?"
rm -rf "$folder"/root/var/cache/apt/archives/*.deb "$folder"/root/var/lib/apt/lists/* \
  "$folder"/root/var/log/*.log "$folder"/root/usr/share/{doc,man,info,locale}/*
tar --numeric-owner -C "$folder/root" -c . |
  docker import --change 'CMD ["bash"]' --message "debootstrap $suite" - "$image" > /dev/null
echo "make_base.sh: made $image"
