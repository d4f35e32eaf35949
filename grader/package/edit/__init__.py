"""Changes of a package's files: texts, diffs, and writing them to disk."""
