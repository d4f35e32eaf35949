"""The command that explains a mistake."""

from __future__ import annotations

import os
import sys

import click

from grader import options
from grader.locale.message import msg
from grader.locale.speaker import chosen_language


@click.command(
    help=msg(
        "Explain a mistake of the catalogue, or what a terminal shows (-: read from standard "
        "input).\n\n"
        "For example: ros2 run my_robot_controller test_node 2>&1 | grader explain -"
    )
)
@click.argument("mistake", metavar="[MISTAKE-ID | -]", required=False)
@options.lang
def explain(mistake: str | None, lang: str | None) -> int:
    """Explain an entry of the catalogue, or a terminal's text."""
    from grader.mistakes import explain as texts  # noqa: PLC0415

    lang = lang or chosen_language(os.environ)
    if mistake is None:
        texts.print_list(file=sys.stdout, lang=lang)
        return 0
    if mistake == "-":
        text = sys.stdin.buffer.read(texts.MOST_BYTES).decode("utf-8", "replace")
        return 0 if texts.print_recognised(text, file=sys.stdout, lang=lang) else 1
    texts.print_entry(mistake, file=sys.stdout, lang=lang)
    return 0


COMMANDS = (explain,)
