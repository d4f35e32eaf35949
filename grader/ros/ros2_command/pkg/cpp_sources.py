"""The C++ files of a new package: an empty node and an empty library."""

from .manifest import PackageDescription
from .writing import write_file

_NODE = """\
#include <cstdio>

int main(int argc, char ** argv)
{{
  (void) argc;
  (void) argv;

  printf("hello world {package} package\\n");
  return 0;
}}
"""
_HEADER = """\
#ifndef {guard}
#define {guard}

#include "{package}/visibility_control.h"

namespace {package}
{{

class {type}
{{
public:
  {type}();

  virtual ~{type}();
}};

}}  // namespace {package}

#endif  // {guard}
"""
_SOURCE = """\
#include "{package}/{library}.hpp"

namespace {package}
{{

{type}::{type}()
{{
}}

{type}::~{type}()
{{
}}

}}  // namespace {package}
"""
_VISIBILITY = """\
#ifndef {PACKAGE}__VISIBILITY_CONTROL_H_
#define {PACKAGE}__VISIBILITY_CONTROL_H_

// Which symbols the library shows to others; see https://gcc.gnu.org/wiki/Visibility

#if defined _WIN32 || defined __CYGWIN__
  #ifdef {PACKAGE}_BUILDING_LIBRARY
    #define {PACKAGE}_PUBLIC __declspec(dllexport)
  #else
    #define {PACKAGE}_PUBLIC __declspec(dllimport)
  #endif
  #define {PACKAGE}_LOCAL
#else
  #define {PACKAGE}_PUBLIC __attribute__ ((visibility("default")))
  #define {PACKAGE}_LOCAL __attribute__ ((visibility("hidden")))
#endif

#endif  // {PACKAGE}__VISIBILITY_CONTROL_H_
"""


def write_node(package: PackageDescription, source: str, node: str) -> None:
    """Write the source of an executable that prints a greeting.

    Raises OSError if it cannot be written.
    """
    write_file(f"{source}/{node}.cpp", _NODE.format(package=package.name))


def write_library(package: PackageDescription, source: str, include: str, library: str) -> None:
    """Write a library with one empty class named after it (`my_lib`: `MyLib`).

    Raises OSError if a file cannot be written.
    """
    words = {
        "package": package.name,
        "library": library,
        "type": "".join(library.replace("_", " ").title().split()),
        "guard": f"{package.name.upper()}__{library.upper()}_HPP_",
    }
    write_file(f"{include}/{library}.hpp", _HEADER.format(**words))
    write_file(f"{source}/{library}.cpp", _SOURCE.format(**words))
    visibility = _VISIBILITY.format(PACKAGE=package.name.upper())
    write_file(f"{include}/visibility_control.h", visibility)
