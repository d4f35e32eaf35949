"""Programs that the probe runs under the prefix's Python; they import nothing of the grader."""
