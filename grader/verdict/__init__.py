"""Marks one submission: from the order through the checks to the report."""
