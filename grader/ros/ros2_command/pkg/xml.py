"""Output the XML of the package manifest or a specific tag."""

import xml.etree.ElementTree as ET
from argparse import Namespace
from pathlib import Path

from ..ament_index import share_directory
from ..parsing import Parser


def add_arguments(parser: Parser) -> None:
    """Declare the arguments of `ros2 pkg xml`."""
    parser.add_argument("package_name", help="The package name")
    parser.add_argument("-t", "--tag", help="The XML tag to output, e.g. version")


def main(args: Namespace) -> str | None:
    """Print the installed package.xml, or the texts of its elements with the tag.

    Returns the message for a missing package, manifest or tag.

    Raises OSError if no ROS environment was sourced, ET.ParseError for broken XML.
    """
    share = share_directory(args.package_name)
    if share is None:
        return "Package not found"
    manifest = Path(share, "package.xml")
    if not manifest.is_file():
        return "Package XML manifest not found"
    tree = ET.parse(manifest)  # noqa: S314 (a locally installed manifest)
    if args.tag is None:
        ET.dump(tree)
        return None
    elements = tree.getroot().findall(args.tag)
    if not elements:
        return "XML tag not found"
    for element in elements:
        print(element.text)
    return None
