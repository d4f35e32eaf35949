# Stands in for ros:jazzy-ros-base where no registry can be reached: ROS at /opt/ros/jazzy, the
# entry point of the official image, and Noble's user `ubuntu` with the id 1000.
ARG BASE
FROM ${BASE}
# hadolint ignore=DL3002
USER 0
# hadolint ignore=SC2016
RUN rm /opt/ros/jazzy/wheels-prefix.json \
 && useradd -m -u 1000 -s /bin/bash ubuntu \
 && printf '%s\n' '#!/bin/bash' 'set -e' 'source "/opt/ros/$ROS_DISTRO/setup.bash" --' 'exec "$@"' \
      > /ros_entrypoint.sh \
 && chmod +x /ros_entrypoint.sh
ENTRYPOINT ["/ros_entrypoint.sh"]
CMD ["bash"]
