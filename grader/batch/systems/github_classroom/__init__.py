"""GitHub Classroom: its clones, and the results for its reporter."""
