#!/bin/bash
# Makes an image's ROS available to every command, however it is started; the build runs it as root.
#
#   docker run IMAGE COMMAND       the image's ENV, and the entry point, which adds the overlay
#   docker exec CONTAINER COMMAND  the image's ENV
#   bash -c, scripts               BASH_ENV
#   bash -lc, sh -l, ssh           /etc/profile.d
#   an interactive bash            /etc/bash.bashrc
#
# ENV can only have constants, but ROS' folders depend on its Python and its machine: ENV names links
# to them (SLOTS of each), and environment.sh puts the folders themselves in their place.
set -euo pipefail
distro=$1 made=/opt/ros/image
declare -A slots=([PYTHONPATH]=3 [LD_LIBRARY_PATH]=9)

mkdir -p "$made"
install -m 755 "$(dirname "$0")/entrypoint" "$made/entrypoint"
{
  cat "$(dirname "$0")/environment.sh.in"
  while IFS='=' read -r -d '' name value; do
    case $name in
      PATH) printf '_ros_first PATH "" "%s"\n' "${value%:$PATH}" ;;
      _ | PWD | OLDPWD | SHLVL) ;;
      *"PATH")
        links=
        if [ -n "${slots[$name]:-}" ]; then
          IFS=: read -ra folders <<< "$value"
          [ "${#folders[@]}" -le "${slots[$name]}" ]  # else the Dockerfile's ENV needs more of them
          for ((n = 1; n <= slots[$name]; n++)); do
            links+=":$made/$name/$n"
            mkdir -p "$made/$name"
            [ "$n" -gt "${#folders[@]}" ] || ln -s "${folders[n - 1]}" "$made/$name/$n"
          done
        fi
        printf '_ros_first %s "%s" "%s"\n' "$name" "${links#:}" "$value"
        ;;
      *) printf 'export %s="${%s:-%s}"\n' "$name" "$name" "$value" ;;
    esac
  done < <(env -i PATH="$PATH" bash -c '. "/opt/ros/$0/setup.bash" && env -0' "$distro")
  echo 'unset -f _ros_first'
} > "$made/environment.sh"
grep -q '^_ros_first AMENT_PREFIX_PATH ' "$made/environment.sh"
ln -s "$made/environment.sh" /etc/profile.d/ros.sh
printf '. %s/environment.sh\n' "$made" >> /etc/bash.bashrc
