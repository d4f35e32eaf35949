"""A submitted package: intake, source analysis and edits."""
