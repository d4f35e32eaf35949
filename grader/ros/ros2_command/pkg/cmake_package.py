"""The CMake files of a new ament_cmake or plain cmake package.

They do the same as those of ros2 but are worded differently. In kilted they link modern targets,
since ament_target_dependencies is deprecated there (ros2cli#973), and require CMake 3.20 (#969).
"""

from .manifest import PackageDescription
from .writing import write_file

_WARNINGS = """\
if(CMAKE_COMPILER_IS_GNUCXX OR CMAKE_CXX_COMPILER_ID MATCHES "Clang")
  add_compile_options(-Wall -Wextra -Wpedantic)
endif()
"""
_NO_DEPENDENCIES = """\
# add a line like this for each package that yours needs:
# find_package(<dependency> REQUIRED)
"""
_TARGET = """\
target_compile_features({target} PUBLIC c_std_99 cxx_std_17)
target_include_directories({target} PUBLIC
  $<BUILD_INTERFACE:${{CMAKE_CURRENT_SOURCE_DIR}}/include>
  $<INSTALL_INTERFACE:{include}>)
"""
_INSTALL_LIBRARY = """\
target_compile_definitions({target} PRIVATE "{macro}_BUILDING_LIBRARY")

install(DIRECTORY include/ DESTINATION {include})
install(TARGETS {target}
  EXPORT export_${{PROJECT_NAME}}
  ARCHIVE DESTINATION lib
  LIBRARY DESTINATION lib
  RUNTIME DESTINATION bin)
"""
_LINT = """\
if(BUILD_TESTING)
  find_package(ament_lint_auto REQUIRED)
  # remove this line once every file has a copyright and a license
  set(ament_cmake_copyright_FOUND TRUE)
  # remove this line once the package is in a git repository
  set(ament_cmake_cpplint_FOUND TRUE)
  ament_lint_auto_find_test_dependencies()
endif()
"""
_EXPORT_AMENT = """\
ament_export_include_directories("include/${{PROJECT_NAME}}")
ament_export_libraries({library})
ament_export_targets(export_${{PROJECT_NAME}})
"""
_EXPORT_CMAKE = """\
export(EXPORT export_${PROJECT_NAME}
  FILE "${PROJECT_BINARY_DIR}/export_${PROJECT_NAME}.cmake")
set(CONF_INCLUDE_DIRS "${CMAKE_INSTALL_PREFIX}/include")
configure_file(${PROJECT_NAME}Config.cmake.in
  "${PROJECT_BINARY_DIR}/${CMAKE_FILES_DIRECTORY}/${PROJECT_NAME}Config.cmake" @ONLY)
configure_file(${PROJECT_NAME}ConfigVersion.cmake.in
  "${PROJECT_BINARY_DIR}/${PROJECT_NAME}ConfigVersion.cmake" @ONLY)
install(FILES
  "${PROJECT_BINARY_DIR}/${CMAKE_FILES_DIRECTORY}/${PROJECT_NAME}Config.cmake"
  "${PROJECT_BINARY_DIR}/${PROJECT_NAME}ConfigVersion.cmake"
  DESTINATION "share/${PROJECT_NAME}/cmake" COMPONENT dev)
install(EXPORT export_${PROJECT_NAME}
  DESTINATION "share/${PROJECT_NAME}/cmake"
  FILE export_${PROJECT_NAME}.cmake COMPONENT dev)
"""
_CONFIG = """\
# Read by find_package({name}): where its headers are, and its targets
set({name}_INCLUDE_DIRS "@CONF_INCLUDE_DIRS@")
include("${{{name}_DIR}}/export_{name}.cmake")
"""
_CONFIG_VERSION = """\
# Read by find_package({name} <version>): is this version compatible?
set(PACKAGE_VERSION "@{name}_VERSION@")
if(PACKAGE_VERSION VERSION_LESS PACKAGE_FIND_VERSION)
  set(PACKAGE_VERSION_COMPATIBLE FALSE)
else()
  set(PACKAGE_VERSION_COMPATIBLE TRUE)
  if(PACKAGE_VERSION VERSION_EQUAL PACKAGE_FIND_VERSION)
    set(PACKAGE_VERSION_EXACT TRUE)
  endif()
endif()
"""


def populate_ament_cmake(package: PackageDescription, folder: str) -> None:
    """Write CMakeLists.txt.

    Raises OSError if it cannot be written.
    """
    include = "include/${PROJECT_NAME}"
    ament = ["ament_cmake", *(["ament_cmake_ros"] if package.library_name else [])]
    parts = [
        _project(package),
        _WARNINGS,
        "# find dependencies\n" + _find(ament) + (_find(package.dependencies) or _NO_DEPENDENCIES),
        *_targets(package, include),
        _LINT,
    ]
    if package.library_name:
        parts.append(_EXPORT_AMENT.format(library=package.library_name))
    write_file(f"{folder}/CMakeLists.txt", "\n".join([*parts, "ament_package()\n"]))


def populate_cmake(package: PackageDescription, folder: str) -> None:
    """Write CMakeLists.txt and the two files that find_package() needs.

    Raises OSError if a file cannot be written.
    """
    parts = [
        _project(package, " VERSION 0.0.0"),
        _WARNINGS,
        "# find dependencies\n" + (_find(package.dependencies) or _NO_DEPENDENCIES),
        *_targets(package, "include"),
    ]
    if package.library_name or package.node_name:
        parts.append(_EXPORT_CMAKE)
    name = package.name
    write_file(f"{folder}/CMakeLists.txt", "\n".join(parts))
    write_file(f"{folder}/{name}Config.cmake.in", _CONFIG.format(name=name))
    write_file(f"{folder}/{name}ConfigVersion.cmake.in", _CONFIG_VERSION.format(name=name))


def _project(package: PackageDescription, version: str = "") -> str:
    minimum = "3.20" if package.kilted else "3.8"
    return f"cmake_minimum_required(VERSION {minimum})\nproject({package.name}{version})\n"


def _find(names: tuple[str, ...] | list[str]) -> str:
    return "".join(f"find_package({name} REQUIRED)\n" for name in names)


def _targets(package: PackageDescription, include: str) -> list[str]:
    library, node = package.library_name, package.node_name
    exported = "  EXPORT export_${PROJECT_NAME}\n" if package.build_type == "cmake" else ""
    shared = "SHARED " if package.build_type == "cmake" else ""
    parts = []
    if library:
        parts.append(
            f"add_library({library} {shared}src/{library}.cpp)\n"
            f"add_library({package.name}::{library} ALIAS {library})\n"
            + _TARGET.format(target=library, include=include)
            + _link(package, library)
            + _INSTALL_LIBRARY.format(target=library, include=include, macro=package.name.upper())
        )
    if node:
        parts.append(
            f"add_executable({node} src/{node}.cpp)\n"
            + _TARGET.format(target=node, include=include)
            + (f"target_link_libraries({node} {library})\n" if library else _link(package, node))
            + f"\ninstall(TARGETS {node}\n{exported}  DESTINATION lib/${{PROJECT_NAME}})\n"
        )
    return parts


def _link(package: PackageDescription, target: str) -> str:
    names = package.dependencies
    if not names:
        return ""
    if package.build_type == "cmake":
        return _call("target_link_libraries", target, [f"${{{name}_LIBRARIES}}" for name in names])
    if package.kilted:
        targets = [f"${{{name}_TARGETS}}" for name in names]
        return _call("target_link_libraries", f"{target} PUBLIC", targets)
    return _call("ament_target_dependencies", target, [f'"{name}"' for name in names])


def _call(function: str, first: str, others: list[str]) -> str:
    return f"{function}({first}\n" + "\n".join(f"  {other}" for other in others) + ")\n"
