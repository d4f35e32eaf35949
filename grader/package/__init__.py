"""What was handed in, as values: intake, source, edits."""
