"""Changes to a package's files: as text, as a diff and on disk."""
