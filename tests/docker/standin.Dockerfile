# Stands in for ros:jazzy-ros-base where no registry can be reached: ROS at /opt/ros/jazzy, the
# entry point of the official image, and Noble's user `ubuntu` with the id 1000. BASE is the base on
# wheels, GRADE the image on it, which has ros2.
ARG BASE
ARG GRADE
FROM ${GRADE} AS grade
FROM ${BASE}
# hadolint ignore=DL3002
USER 0
COPY --from=grade /opt/ros/jazzy /opt/ros/jazzy
# hadolint ignore=SC2016
RUN rm /opt/ros/jazzy/wheels-prefix.json \
 && useradd -m -u 1000 -s /bin/bash ubuntu \
 && printf '%s\n' '#!/bin/bash' 'set -e' 'source "/opt/ros/$ROS_DISTRO/setup.bash" --' 'exec "$@"' \
      > /ros_entrypoint.sh \
 && chmod +x /ros_entrypoint.sh
ENTRYPOINT ["/ros_entrypoint.sh"]
CMD ["bash"]
