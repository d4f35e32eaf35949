"""`python -m grader.gradebook COMMAND`: the commands of this room, beside the grader's own."""

import sys

from grader.cli import commands
from grader.cli import main
from grader.gradebook.commands import COMMANDS

for command in COMMANDS:
    commands.add_command(command)
sys.exit(main())
