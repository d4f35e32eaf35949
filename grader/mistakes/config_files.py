"""The mistake of a configuration file that is not there, which ConfigParser leaves out in silence."""

from __future__ import annotations

import ast
import re

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.example import NODE, example
from grader.mistakes.kind import Family
from grader.mistakes.recognised import Raised, RecognisedMistake
from grader.package.edit.tree import Replace
from grader.package.source.names import last_part

MOST_CODE = 60  # characters of a path that a text shows


def _not_read(raised: Raised, match: re.Match[str]) -> RecognisedMistake | None:
    """The only call that reads a configuration file, if the error comes from the parser."""
    source = raised.source
    parsers = [c for c, name in source.calls if last_part(name).endswith("ConfigParser")]
    reads = [c for c, name in source.calls if name.endswith(".read") and len(c.args) == 1]
    if not raised.inside or not parsers or len(reads) != 1:
        return None
    if "__file__" in source.module_of(reads[0]).text.text:
        return None  # (a path that begins at the node's own file is right on each computer)
    code = _path(raised, reads[0].args[0])
    params = {"name": code if len(code) <= MOST_CODE else "…"}
    return raised.finding("config_not_read", at=reads[0], params=params, text=match["text"])


def _path(raised: Raised, given: ast.expr) -> str:
    return raised.source.module_of(given).text.code(given)


_node = Family("node", links.PYTHON_ERRORS)
KINDS = (
    _node(
        "config_not_read",
        "start",
        msg("A configuration file is read that is not there"),
        msg(
            "read() of a ConfigParser leaves out a file that is not there, without an error. The parser "
            "then has no section {text}. The folders of one computer do not exist on another one, and a "
            "path that does not begin with / begins in the folder in which ros2 run is started."
        ),
        msg(
            "Write the values that the program takes from {name} into the program, in place of what "
            "reads the file. If it must be a file, let setup.py install it: add it to the list with "
            "'package.xml' in data_files, and build again. Then read it from the folder that "
            "get_package_share_directory('{package}') returns (from ament_index_python.packages)."
        ),
        raised={
            r"^KeyError: (?P<text>'[^'\n]{1,60}')$": _not_read,
            r"NoSectionError: No section: (?P<text>'[^'\n]{1,60}')": _not_read,
        },
        examples=(
            example(
                "config_of_another_computer",
                Replace(NODE, "import rclpy\n", "import configparser\n\nimport rclpy\n"),
                Replace(
                    NODE,
                    "        self.counter_ = 0\n",
                    "        settings = configparser.ConfigParser()\n"
                    "        settings.read('/home/me/hello.ini')\n"
                    "        self.counter_ = int(settings['hello']['start'])\n",
                ),
                fails="run.starts",
            ),
            example(
                "section_of_no_file",
                Replace(NODE, "import rclpy\n", "import configparser\n\nimport rclpy\n"),
                Replace(
                    NODE,
                    "        self.counter_ = 0\n",
                    "        settings = configparser.ConfigParser()\n"
                    "        settings.read('hello.ini')\n"
                    "        self.counter_ = settings.getint('hello', 'start')\n",
                ),
                fails="run.starts",
            ),
        ),
    ),
)
