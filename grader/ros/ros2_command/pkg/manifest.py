"""The package.xml of a new package (format: REP 149)."""

from dataclasses import dataclass

_SCHEMA = "http://download.ros.org/schema/package_format{format}.xsd"


@dataclass(frozen=True, kw_only=True)
class PackageDescription:
    """The values for the files of a new package; `kilted` selects the newer templates."""

    name: str
    format: int
    description: str
    maintainer: str
    email: str
    license: str
    build_type: str
    dependencies: tuple[str, ...]
    node_name: str | None
    library_name: str | None
    kilted: bool

    @property
    def buildtool_depends(self) -> tuple[str, ...]:
        """The packages that build it."""
        if self.build_type != "ament_cmake":
            return ()
        return ("ament_cmake_ros",) if self.library_name else ("ament_cmake",)

    @property
    def test_depends(self) -> tuple[str, ...]:
        """The packages that its generated tests need."""
        if self.build_type == "ament_cmake":
            return ("ament_lint_auto", "ament_lint_common")
        if self.build_type == "ament_python":
            xmllint = ("ament_xmllint",) if self.kilted else ()
            return ("ament_copyright", "ament_flake8", "ament_pep257", *xmllint, "python3-pytest")
        return ()


def manifest(package: PackageDescription) -> str:
    """Return the text of package.xml; nothing is escaped, as in ros2."""
    schema = _SCHEMA.format(format=package.format)
    lines = [
        '<?xml version="1.0"?>',
        f'<?xml-model href="{schema}" schematypens="http://www.w3.org/2001/XMLSchema"?>',
        f'<package format="{package.format}">',
        f"  <name>{package.name}</name>",
        "  <version>0.0.0</version>",
        f"  <description>{package.description}</description>",
        f'  <maintainer email="{package.email}">{package.maintainer}</maintainer>',
        f"  <license>{package.license}</license>",
        "",
        *_dependencies("buildtool_depend", package.buildtool_depends),
        *_dependencies("depend", package.dependencies),
        *_dependencies("test_depend", package.test_depends),
        "  <export>",
        f"    <build_type>{package.build_type}</build_type>",
        "  </export>",
        "</package>",
    ]
    return "\n".join(lines) + "\n"


def _dependencies(tag: str, names: tuple[str, ...]) -> list[str]:
    return [*(f"  <{tag}>{name}</{tag}>" for name in names), ""] if names else []
