"""Create a new ROS 2 package."""

from __future__ import annotations

import os
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from .. import distro
from . import maintainer
from .cmake_package import populate_ament_cmake, populate_cmake
from .cpp_sources import write_library, write_node
from .licenses import LICENSES, license_text
from .manifest import PackageDescription, manifest
from .python_package import populate_ament_python
from .writing import create_folder, write_file

if TYPE_CHECKING:
    from argparse import Namespace

    from ..parsing import Parser


def add_arguments(parser: Parser) -> None:
    """Declare the arguments of `ros2 pkg create`."""
    add = parser.add_argument
    add("package_name", help="The package name")
    add(
        "--package-format",
        "--package_format",
        type=int,
        default=3,
        choices=[2, 3],
        help="The package.xml format.",
    )
    add(
        "--description",
        default="TODO: Package description",
        help="The description given in the package.xml",
    )
    add(
        "--license",
        default="TODO: License declaration",
        help="The license attached to this package; this can be an arbitrary string, but a LICENSE "
        "file will only be generated if it is one of the supported licenses (pass '?' to get a "
        "list)",
    )
    add(
        "--destination-directory",
        default=os.curdir,
        help="Directory where to create the package directory",
    )
    add(
        "--build-type",
        default="ament_cmake",
        choices=["cmake", "ament_cmake", "ament_python"],
        help="The build type to process the package with",
    )
    add("--dependencies", nargs="+", default=[], help="list of dependencies")
    add("--maintainer-email", help="email address of the maintainer of this package")
    add("--maintainer-name", help="name of the maintainer of this package")
    add("--node-name", help="name of the empty executable")
    add("--library-name", help="name of the empty library")


def main(args: Namespace) -> str | None:
    """Write the package's files and print their names; return an error message or None.

    Like ros2, this does not check the name: `My Robot` is created.

    Raises OSError if a file cannot be written.
    """
    if args.license == "?":
        print("Supported licenses:", *LICENSES, sep="\n")
        return None
    package = _describe(args)
    if package.build_type == "ament_python" and package.name == "test":
        return (
            "Aborted since 'ament_python' packages can't be named 'test'. Please choose a "
            "different package name."
        )
    folder = os.path.join(args.destination_directory, package.name)  # noqa: PTH118 (keeps "./")
    if Path(folder).exists():
        return (
            f"\nAborted!\nThe directory already exists: {folder}\nEither remove the directory or "
            "choose a different destination directory or package name"
        )
    _announce(package, args.destination_directory)
    create_folder(folder)
    write_file(f"{folder}/package.xml", manifest(package))
    if package.build_type == "ament_python":
        populate_ament_python(package, folder)
    else:
        _populate_cpp(package, folder)
    _license(package.license, folder)
    return None


def _describe(args: Namespace) -> PackageDescription:
    name = args.maintainer_name or maintainer.default_name()
    node_name = args.node_name
    if node_name and node_name == args.library_name:
        node_name = f"{node_name}_node"
        print("[WARNING] node name can not be equal to the library name", file=sys.stderr)
        print(f"[WARNING] renaming node to {node_name}", file=sys.stderr)
    return PackageDescription(
        name=args.package_name,
        format=args.package_format,
        description=args.description,
        maintainer=name,
        email=args.maintainer_email or maintainer.default_email(name),
        license=args.license,
        build_type=args.build_type,
        dependencies=tuple(args.dependencies),
        node_name=node_name or None,
        library_name=args.library_name or None,
        kilted=distro.is_kilted(),
    )


def _announce(package: PackageDescription, destination: str) -> None:
    print("going to create a new package")
    print("package name:", package.name)
    print("destination directory:", os.path.abspath(destination))  # noqa: PTH100 (links kept)
    print("package format:", package.format)
    print("version: 0.0.0")
    print("description:", package.description)
    print("maintainer:", [f"{package.maintainer} <{package.email}>"])
    print("licenses:", [package.license])
    print("build type:", package.build_type)
    print("dependencies:", list(package.dependencies))
    if package.node_name:
        print("node_name:", package.node_name)
    if package.library_name:
        print("library_name:", package.library_name)


def _populate_cpp(package: PackageDescription, folder: str) -> None:
    print("creating source and include folder")
    source = create_folder(f"{folder}/src")
    include = create_folder(f"{folder}/include/{package.name}")
    if package.build_type == "cmake":
        populate_cmake(package, folder)
    else:
        populate_ament_cmake(package, folder)
    if package.node_name:
        write_node(package, source, package.node_name)
    if package.library_name:
        write_library(package, source, include, package.library_name)


def _license(identifier: str, folder: str) -> None:
    if identifier in LICENSES:
        Path(folder, "LICENSE").write_text(license_text(identifier), encoding="utf-8")
        return
    print(
        f"\n[WARNING]: Unknown license '{identifier}'.  This has been set in the package.xml, but "
        "no LICENSE file has been created.\n"
        "It is recommended to use one of the ament license identifiers:",
        *LICENSES,
        sep="\n",
    )
