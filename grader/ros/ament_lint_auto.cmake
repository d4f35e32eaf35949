# Installed as the package ament_lint_auto, of which PyPI has no wheel: a CMakeLists.txt that
# `ros2 pkg create` wrote asks for it. The linters are tests; `colcon build` runs none of them.
macro(ament_lint_auto_find_test_dependencies)
  message(STATUS "PyPI's wheels have no linters for CMake: none is run")
endmacro()
