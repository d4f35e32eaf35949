# A base for machines that cannot pull the official ROS images: Python of Debian (or of another
# base), and /opt/ros/<distro> made from PyPI's ROS wheels by the same code as the local prefix, but for
# our own programs (`ros2`), which docker/Dockerfile adds. For jazzy and kilted. Builds with and without BuildKit.
#
#   docker build -f docker/wheels.Dockerfile --build-arg DISTRO=jazzy -t ros2-teaching-lab:base-jazzy-wheels .
#
# APT_MIRROR, PIP_INDEX_URL, HTTP_PROXY, HTTPS_PROXY adapt the build to the network. An extra CA
# certificate is a file docker/ca/*.crt; it stays in the builder stage, which is discarded.
ARG WHEELS_BASE=debian:trixie-slim

FROM ${WHEELS_BASE} AS python
ARG APT_MIRROR=
COPY docker/apt_install.sh /usr/local/sbin/
COPY docker/base.dpkg.cfg /etc/dpkg/dpkg.cfg.d/base
# a compiler and Python's headers: students build interfaces of their own
RUN apt_install.sh python3 libatomic1 g++ make python3-dev

FROM python AS prefix
ARG APT_MIRROR=
RUN apt_install.sh python3-venv ca-certificates
COPY docker/ca/ /usr/local/share/ca-certificates/
RUN update-ca-certificates > /dev/null 2>&1
ENV PIP_CERT=/etc/ssl/certs/ca-certificates.crt PIP_DISABLE_PIP_VERSION_CHECK=1 PIP_NO_CACHE_DIR=1
ARG PIP_INDEX_URL=
WORKDIR /src
COPY grader/requirements.txt grader/
RUN if [ -z "$PIP_INDEX_URL" ]; then unset PIP_INDEX_URL; fi \
 && python3 -m venv .venv \
 && .venv/bin/pip install -q --require-hashes --only-binary :all: -r grader/requirements.txt
# only what the packages depend on: other code is added by docker/Dockerfile, without these minutes
COPY grader/__init__.py grader/
COPY grader/ros/__init__.py grader/ros/wheels_tree.py grader/ros/scripts.py grader/ros/setup.bash.in \
     grader/ros/interface_package.py grader/ros/interfaces.cmake.in grader/ros/ament_lint_auto.cmake \
     grader/ros/distros.toml grader/ros/
COPY grader/ros/interface_texts/turtlesim grader/ros/interface_texts/turtlesim
COPY grader/ros/locks grader/ros/locks
ARG DISTRO=jazzy
RUN if [ -z "$PIP_INDEX_URL" ]; then unset PIP_INDEX_URL; fi \
 && turtlesim="$(sed -n "/^\[$DISTRO\]/,/^\[/s/^turtlesim = \"\(.*\)\"/\1/p" grader/ros/distros.toml)" \
 && .venv/bin/python -m grader.ros.wheels_tree "$DISTRO" "$(readlink -f "$(command -v python3)")" \
      "${turtlesim:-turtlesim_msgs}"

FROM python AS wheels
COPY --from=prefix /opt/ros /opt/ros
ARG DISTRO=jazzy
# test that the programs run in this image
RUN bash -c ". /opt/ros/$DISTRO/setup.bash && colcon build --help && python3 -c 'import rclpy.node; rclpy.init'" \
      > /dev/null
ENV ROS_DISTRO=${DISTRO} LANG=C.UTF-8
LABEL ros2-teaching-lab.distro="${DISTRO}" \
      ros2-teaching-lab.ros="wheels" \
      ros2-teaching-lab.stage="base"
CMD ["bash"]
