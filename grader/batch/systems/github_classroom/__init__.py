"""GitHub Classroom: its clones and the results of its reporter."""
