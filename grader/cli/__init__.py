"""The `grader` command: one module for each of its subcommands."""
